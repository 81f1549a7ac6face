#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""provoked.py LIBRARY HEADER: every status that a line in brackets lists is provoked once, by name.

A row of ROWS says how a function is brought to a status; it fails if another one comes back. DELAM_ERROR_ARGUMENT is
provoked by the calls of test_contract.py. PLACES names other tests that provoke a status, where that takes an engine of
the host or a scene of many cells; the test's file has to name the function. UNSEEN has the statuses that no scene is
known for, each with what the status guards against. A request to cancel that came before a call stops it where the
comment of delam_context_cancel says so, and else waits.
"""
import ctypes
import os
import struct
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE]
import contract_lint as lint  # noqa: E402
import test_contract as contract  # noqa: E402
from ctypes import c_double, c_int32, c_uint8, c_void_p  # noqa: E402
from test_contract import CODES, bare, call, fine, full, loose, made, real, room, short, whole, words  # noqa: E402

VERIFY = os.path.dirname(HERE)
CELLS = os.path.join(VERIFY, "cases", "test_cancelled_calls.cpp")
ENGINE = os.path.join(HERE, "callback_statuses.cpp")
QUAD4 = CODES["DELAM_QUAD4"]


# ---- scenes ----
def squares(shift=(0.0, 1.0), labels=(0, 1)):
    """Two unit squares, the second one shifted."""
    s = loose()
    x, y = shift
    s.mesh = made("mesh_create", s.context, 2, 9,
                  real(0, 0, 1, 0, 1, 1, 0, 1, x, y, x + 1, y, x + 1, y + 1, x, y + 1, 9, 9))
    fine("mesh_add_cells", s.mesh, QUAD4, 2, whole(0, 1, 2, 3, 4, 5, 6, 7), short(*labels), 0)
    return s


def folded():
    """Two cells of one body on the same side of the edge that they share."""
    s = loose()
    s.mesh = made("mesh_create", s.context, 2, 6, real(0, 0, 1, 0, 1, 1, 0, 1, 1, 2, 0, 2))
    fine("mesh_add_cells", s.mesh, QUAD4, 2, whole(0, 1, 2, 3, 0, 1, 4, 5), None, 0)
    s.problem = made("problem_create", s.context, s.mesh)
    fine("problem_set_elastic", s.problem, -1, 1.0, 0.0)
    for axis in (real(1, 0), real(0, 1)):
        fine("problem_prescribe_nodes", s.problem, 2, whole(0, 1), axis, 0, None, None, 0)
    return s


def without_material():
    s = bare()
    s.problem = made("problem_create", s.context, s.mesh)
    fine("problem_add_pattern", s.problem, words("heat"), 1, real(0), real(1), whole(0))
    fine("problem_add_eigenstrain", s.problem, 0, -1, real(1, 0, 0, 0, 0, 0))
    return s


fails = [False]


@ctypes.CFUNCTYPE(c_int32, c_double, c_double, contract.PLACE, contract.PLACE, c_void_p)
def adhesion(_mixity, driving, zeta, slope, _user):
    first, last, root = 10.0, 250.0 / 10.0, max(driving, 0.0) ** 0.5
    inside = driving > 100.0 and root < last
    zeta[0] = 1.0 if driving <= 100.0 else 0.0 if root >= last else (1 / root - 1 / last) / (1 / first - 1 / last)
    slope[0] = -0.5 / (root * driving) / (1 / first - 1 / last) if inside else 0.0
    return int(fails[0])


@ctypes.CFUNCTYPE(c_int32, c_double, c_double, contract.PLACE, contract.PLACE, contract.PLACE, c_void_p)
def dissipation(_mixity, zeta, dissipated, slope, mixity_slope, _user):
    a, b = 0.1, 10.0 / 250.0
    root = zeta * a + (1 - zeta) * b
    dissipated[0], slope[0], mixity_slope[0] = (1 / root - 1 / a) / (a - b), -1 / (root * root), 0.0
    return int(fails[0])


def of_host(steps=0):
    """A scene whose law is the host's, analysed, and then fails."""
    fails[0] = False
    s = bare()
    s.law = made("law_create_host", s.context, words("host"), adhesion, dissipation, None)
    for key in ("normal_stiffness", "tangential_stiffness"):
        fine("law_set", s.law, words(key), 1e6)
    fine("problem_set_law", s.problem, 0, s.law)
    fine("problem_set_adhesion", s.problem, 0, 1, whole(0), real(0.0), 0)
    supports(s)
    s.solver = made("solver_create", s.problem, 0.0)
    if steps:
        fine("solver_advance", s.solver, 0.35)
        fine("solver_commit", s.solver)
        if steps > 1:
            fine("solver_record", s.solver, words("energy_release_rate"))
            fine("solver_advance", s.solver, 0.4)
        else:  # of a state that is loaded nothing is known yet
            data = s.saved()
            fine("solver_load", s.solver, len(data), data)
    return s


def supports(s):
    for axis in (real(1, 0), real(0, 1)):
        fine("problem_prescribe_nodes", s.problem, 2, whole(0, 1), axis, 0, None, None, 0)
    fine("problem_prescribe_nodes", s.problem, 2, whole(6, 7), real(0, 1), 1, whole(0), real(0.05, 0.05), 0)
    fine("problem_prescribe_nodes", s.problem, 1, whole(6), real(1, 0), 0, None, None, 0)
    fine("problem_add_forces", s.problem, 1, 1, whole(7), real(1, 0), 0)
    fine("problem_add_eigenstrain", s.problem, 2, -1, real(1e-9, 0, 0, 0, 0, 0))


def failing(steps=0):
    s = of_host(steps)
    fails[0] = True
    return s


def loose_part(time=None):
    """The upper square is held by the interface alone, and a dead force pulls at it."""
    s = bare()
    fine("problem_prescribe_nodes", s.problem, 2, whole(0, 1), real(1, 0), 0, None, None, 0)
    fine("problem_prescribe_nodes", s.problem, 2, whole(0, 1), real(0, 1), 1, whole(0), real(0, 0), 0)
    fine("problem_add_forces", s.problem, 1, 2, whole(6, 7), real(0, 1e7, 0, 1e7), 0)
    fine("problem_add_eigenstrain", s.problem, 2, -1, real(1e-9, 0, 0, 0, 0, 0))
    if time is not None:
        s.solver = made("solver_create", s.problem, time)
    return s


def floating():
    """As loose_part, without the bond and without the load."""
    s = loose_part(0.0)
    fine("solver_equilibrate", s.solver, 0.0, real(0, 0))
    return s


def with_options(*options, time=None):
    s = full()
    for key, setting in options:
        if isinstance(setting, str):
            fine("problem_set_text", s.problem, words(key), words(setting))
        else:
            fine("problem_set_number", s.problem, words(key), setting)
    if time is not None:
        s.solver = made("solver_create", s.problem, time)
    return s


def cancelled(make):
    def scene():
        s = make()
        fine("context_cancel", s.context)
        return s
    return scene


def stopping(make):
    """The progress callback asks the running call to stop."""
    def scene():
        s = make()
        s.stop = contract.on_progress.__class__(lambda *_: int(call("context_cancel", s.context) == 0))
        fine("context_set_progress", s.context, s.stop, None)
        return s
    return scene


def usual(name):
    return lambda s: contract.CALLS[name][1](s)


def number(s, key):
    return [s.solver, words(key), real(0)]


LAW_ROWS = {"law_check": lambda s: [s.law], "law_toughness": usual("law_toughness"), "law_respond": usual("law_respond")}


def incomplete():
    s = loose()
    s.law = made("law_create", s.context, words("griffith"))
    return s


def interface_of(s):
    return [s.mesh, 0, 1, 0.0, whole(0)]


def cells_of_0(s):
    return [s.mesh, QUAD4, 1, whole(0, 1, 2, 3), None, 0]


def garbage(s):
    return [s.solver, 64, room(c_uint8, 64)]


def garbage_file(s):
    path = contract.STATE_FILE + ".garbage"
    with open(path, "wb") as file:
        file.write(b"\0" * 64)
    return [s.solver, words(path)]


def apart():
    return squares((0.0, 5.0))


def askew():
    return squares((0.5, 1.0))


def overlapping():
    s = squares((0.0, 0.75))
    fine("mesh_add_mortar_interface", s.mesh, 0, 1, 0.5, whole(0))
    s.problem = made("problem_create", s.context, s.mesh)
    fine("problem_add_pattern", s.problem, words("fit"), 1, real(0), real(1), whole(0))
    return s


def twice(s):
    return [s.problem, 1, whole(0), real(1, 0), 0, None, None, 0]


def front(s):
    return [s.solver, 0, 4, 4, None, None, real(*[0] * 8), None, None, None, None, None]


def many_cells():
    s = loose()
    s.mesh = made("mesh_create_layers", s.context, 2, real(1), whole(600), 2, real(1e-2, 1e-2), whole(1, 1), QUAD4)
    fine("mesh_add_interface", s.mesh, 0, 1, 0.0, whole(0))
    s.problem = made("problem_create", s.context, s.mesh)
    fine("problem_set_elastic", s.problem, -1, 1.0, 0.0)
    fine("problem_set_law", s.problem, 0, s.law)
    return s


def many_solved():
    s = many_cells()
    fine("problem_add_pattern", s.problem, words("pull"), 2, real(0, 1), real(0, 1), whole(0))
    for axis in (real(1, 0), real(0, 1)):
        fine("problem_prescribe_nodes", s.problem, 2, whole(0, 601), axis, 0, None, None, 0)
    fine("problem_prescribe_nodes", s.problem, 1, whole(4 * 601 - 1), real(1, 0), 1, whole(0), real(1e-6), 0)
    s.solver = made("solver_create", s.problem, 0.0)
    return s


def unbalanced(time=None):
    """The faces meet askew, so that the set of contacts takes more than the one step that it may have."""
    s = loose()
    s.mesh = made("mesh_create_layers", s.context, 2, real(4), whole(8), 2, real(1, 1), whole(1, 1), QUAD4)
    fine("mesh_add_interface", s.mesh, 0, 1, 0.0, whole(0))
    s.problem = made("problem_create", s.context, s.mesh)
    fine("problem_set_elastic", s.problem, -1, 1e3, 0.3)
    fine("problem_set_contact", s.problem, 0)
    fine("problem_add_pattern", s.problem, words("press"), 2, real(0, 1), real(0, 1), whole(0))
    for axis in (real(1, 0), real(0, 1)):
        fine("problem_prescribe_nodes", s.problem, 9, whole(*range(9)), axis, 0, None, None, 0)
    top = range(27, 36)
    fine("problem_prescribe_nodes", s.problem, 9, whole(*top), real(1, 0), 0, None, None, 0)
    fine("problem_prescribe_nodes", s.problem, 9, whole(*top), real(0, 1), 1, whole(0),
         real(*[0.3 * (k - 3.3) * (-1) ** (k // 2) for k in range(9)]), 0)
    fine("problem_set_number", s.problem, words("contact_limit"), 1.0)
    if time is not None:
        s.solver = made("solver_create", s.problem, time)
    return s


SPRING = struct.pack("<d", 5e5)  # of a pair of `unsprung`: its stiffness times its weight


def unsprung():
    """The upper square is held by the interface alone; the iterated operator saves the springs of its factor."""
    s = bare()
    fine("problem_prescribe_nodes", s.problem, 2, whole(0, 1), real(1, 0), 0, None, None, 0)
    fine("problem_prescribe_nodes", s.problem, 2, whole(0, 1), real(0, 1), 1, whole(0), real(0, 0), 0)
    fine("problem_add_forces", s.problem, 1, 2, whole(6, 7), real(0, 1e3, 0, 1e3), 0)
    fine("problem_add_eigenstrain", s.problem, 2, -1, real(1e-9, 0, 0, 0, 0, 0))
    fine("problem_set_text", s.problem, words("reduction"), words("iterated"))
    s.solver = made("solver_create", s.problem, 0.0)
    fine("solver_advance", s.solver, 0.5)
    fine("solver_commit", s.solver)
    return s


def no_springs(s):
    """Bytes of the solver with springs of 0, which no analysis has, and the checksum (FNV-1a) of these bytes."""
    data = bytes(s.saved())[:-8]
    if SPRING not in data:
        raise SystemExit("solver_load: the bytes of a saved state hold no springs")
    data, total = data.replace(SPRING, bytes(8)), 14695981039346656037
    for byte in data:
        total = (total ^ byte) * 1099511628211 % 2 ** 64
    data += struct.pack("<Q", total)
    return [s.solver, len(data), (c_uint8 * len(data))(*data)]


def no_springs_file(s):
    path = contract.STATE_FILE + ".springs"
    with open(path, "wb") as file:
        file.write(bytes(no_springs(s)[2]))
    return [s.solver, words(path)]


# (function, status) -> (scene, arguments)
ROWS = {
    ("mesh_create_layers", "mesh"): (loose, lambda s: [s.context, 2, real(1e-200), whole(1), 1, real(1e-200), whole(1),
                                                       QUAD4, c_void_p()]),
    ("mesh_add_cells", "mesh"): (loose, lambda s: [s.mesh, QUAD4, 1, whole(0, 3, 2, 1), short(0), 0]),
    ("mesh_add_cells", "state"): (bare, cells_of_0),
    ("mesh_add_conforming_cells", "mesh"): (loose, lambda s: [s.mesh, QUAD4, 1, whole(0, 3, 2, 1), short(0), 0]),
    ("mesh_add_conforming_cells", "state"): (bare, cells_of_0),
    ("mesh_add_interface", "mesh"): (apart, interface_of),
    ("mesh_add_all_interfaces", "mesh"): (askew, lambda s: [s.mesh, 0.0, whole(0)]),
    ("mesh_add_seams", "mesh"): (lambda: squares((0.0, 0.0), (0, 0)), lambda s: [s.mesh, 0.0, whole(0)]),
    ("mesh_add_self_contact", "mesh"): (lambda: squares((0.5, 1.1), (0, 0)), lambda s: [s.mesh, 0.2, whole(0)]),
    **{(f"mesh_add_{kind}_interface", "mesh"): (apart, interface_of) for kind in ("projected", "mortar")},
    ("mesh_add_obstacle", "mesh"): (loose, lambda s: [s.mesh, 1, whole(0), real(0, -1), None, 8, 0, whole(0)]),
    ("mesh_add_host_body", "mesh"): (loose, lambda s: [s.mesh, 7, 1, whole(0), 0]),
    ("mesh_find_patch", "mesh"): (folded, lambda s: [s.mesh, 0, real(0, 0), real(1, 2), real(0, -1), 0, None, None,
                                                     whole(0)]),
    ("problem_set_law", "problem"): (lambda: with_law(incomplete()), usual("problem_set_law")),
    ("problem_prescribe_nodes", "problem"): (full, twice),
    ("problem_prescribe_mean", "problem"): (full, lambda s: [s.problem, 1, whole(4), real(1), real(1, 0), 1, whole(1),
                                                             real(1), 0]),
    ("problem_add_equation", "problem"): (full, lambda s: [s.problem, 1, whole(4), real(1, 0), 1, whole(1), real(1), 0]),
    **{(f"problem_{w}_constraints", "problem"): (full, lambda s: [s.problem, 0, 1, 0.5, 2]) for w in ("begin", "end")},
    ("problem_add_periodic", "mesh"): (bare, lambda s: [s.problem, 1, real(1, 1), whole(8), 0.0, 0]),
    ("problem_add_forces", "problem"): (full, lambda s: [s.problem, 0, 1, whole(4), real(1, 0), 0]),
    ("problem_add_eigenstrain", "problem"): (full, lambda s: [s.problem, 0, 0, real(1, 0, 0, 0, 0, 0)]),
    ("problem_set_gaps", "problem"): (full, lambda s: [s.problem, 0, 0, None, 0.0]),
    ("problem_set_gaps", "mesh"): (overlapping, lambda s: [s.problem, 0, 0, None, 0.0]),
    ("problem_check", "mesh"): (folded, lambda s: [s.problem]),
    ("problem_check", "problem"): (bare, lambda s: [s.problem]),
    ("problem_process_zone", "problem"): (failing, usual("problem_process_zone")),
    ("problem_propose", "problem"): (failing, usual("problem_propose")),
    ("problem_propose", "cancelled"): (stopping(many_cells), usual("problem_propose")),
    ("solver_look", "argument"): (full, lambda s: [s.solver, 99]),
    ("problem_body_matrix", "problem"): (without_material, usual("problem_body_matrix")),
    ("problem_forces", "problem"): (without_material, lambda s: [s.problem, 0, 18, room(c_double, 18)]),
    ("problem_eigenstrain_energy", "problem"): (without_material, lambda s: [s.problem, 1, real(0)]),
    ("problem_plan", "cancelled"): (stopping(full), usual("problem_plan")),
    ("problem_plan", "mesh"): (folded, usual("problem_plan")),
    ("problem_plan", "problem"): (bare, usual("problem_plan")),
    ("problem_set_stiffness", "cancelled"): (cancelled(bare), usual("problem_set_stiffness")),
    **{("solver_create" + like, status): (make, lambda s, o=other, time=time: [s.problem, *o, time, c_void_p()])
       for like, other in (("", ()), ("_like", (None,)))
       for status, make, time in (("not_converged", unbalanced, 1.0), ("mesh", folded, 0.0), ("problem", bare, 0.0))},
    ("solver_advance", "not_converged"): (lambda: with_options(("minimisation_limit", 1.0), time=0.0),
                                          lambda s: [s.solver, 0.5]),
    ("solver_advance", "limit"): (lambda: loose_part(0.0), lambda s: [s.solver, 1.0]),
    ("solver_advance", "problem"): (failing, lambda s: [s.solver, 0.5]),
    ("solver_advance", "state"): (lambda: full().analysed(), lambda s: [s.solver, 0.9]),
    ("solver_commit", "problem"): (lambda: failing(2), lambda s: [s.solver]),
    ("solver_commit", "state"): (full, lambda s: [s.solver]),
    ("solver_rollback", "state"): (full, lambda s: [s.solver]),
    ("solver_set_history", "state"): (lambda: full().analysed(), usual("solver_set_history")),
    ("solver_equilibrate", "not_converged"): (lambda: unbalanced(0.0), lambda s: [s.solver, 1.0, None]),
    ("solver_equilibrate", "cancelled"): (cancelled(full), usual("solver_equilibrate")),
    ("solver_equilibrate", "limit"): (lambda: loose_part(0.0), lambda s: [s.solver, 1.0, real(0, 0)]),
    ("solver_equilibrate", "problem"): (failing, usual("solver_equilibrate")),
    ("solver_equilibrate", "state"): (lambda: full().analysed(), usual("solver_equilibrate")),
    ("solver_value", "cancelled"): (stopping(many_solved), lambda s: number(s, "rotation_max")),
    ("solver_field", "cancelled"): (stopping(many_solved), lambda s: [s.solver, words("stress"), -1, 4800,
                                                                      room(c_double, 4800)]),
    ("solver_value", "problem"): (lambda: failing(1), lambda s: number(s, "energy_release_rate")),
    ("solver_record", "problem"): (lambda: failing(1), lambda s: [s.solver, words("energy_release_rate")]),
    ("solver_record", "state"): (lambda: full().analysed(), lambda s: [s.solver, words("time")]),
    ("solver_front_count", "problem"): (lambda: failing(1), usual("solver_front_count")),
    ("solver_front", "problem"): (lambda: failing(1), front),
    ("solver_tangent", "cancelled"): (cancelled(full), usual("solver_tangent")),
    ("solver_tangent", "state"): (floating, usual("solver_tangent")),
    ("solver_step_tangent", "cancelled"): (cancelled(lambda: full().analysed()), usual("solver_step_tangent")),
    ("solver_step_tangent", "state"): (full, usual("solver_step_tangent")),
    ("solver_condensed_size", "state"): (lambda: with_options(("reduction", "feti"), time=0.0),
                                         usual("solver_condensed_size")),
    ("solver_condensed", "state"): (lambda: with_options(("reduction", "feti"), time=0.0), usual("solver_condensed")),
    ("solver_load", "cancelled"): (cancelled(full), usual("solver_load")),
    ("solver_load", "numerical"): (unsprung, no_springs),
    ("solver_load", "snapshot"): (full, garbage),
    ("solver_save_file", "file"): (full, lambda s: [s.solver, words("/nowhere/at/all")]),
    ("solver_load_file", "cancelled"): (cancelled(full), contract.saved_file),
    ("solver_load_file", "numerical"): (unsprung, no_springs_file),
    ("solver_load_file", "snapshot"): (full, garbage_file),
    ("solver_load_file", "file"): (full, lambda s: [s.solver, words("/nowhere/at/all")]),
    **{(name, "problem"): (incomplete, arguments) for name, arguments in LAW_ROWS.items()},
}


def with_law(s):
    other = bare()
    s.problem = made("problem_create", s.context, other.mesh)
    return s


# Status -> test that provokes it for functions without a row.
PLACES = {"cancelled": CELLS, "numerical": ENGINE, "problem": ENGINE}
UNSEEN = {
    ("mesh_add_pairs", "mesh"): "pairs that the host gives are wrong arguments; the list is older and may only shrink",
    ("problem_set_stiffness", "numerical"): "it guards against a factorisation that breaks down after the checks of the "
                                            "matrix, which name the argument",
    **{("solver_create" + like, "limit"): "it guards against dead loads on a part that only contact holds; what "
       "delam_problem_check sees beforehand is DELAM_ERROR_PROBLEM" for like in ("", "_like")},
    ("solver_recorded_size", "argument"): "both outputs may be NULL; the list is older and may only shrink",
    ("solver_condensed_size", "argument"): "both outputs may be NULL; the list is older and may only shrink",
}


# A request to cancel that found nothing to stop waits for the next of these calls; all other calls let it wait.
STOPPED = {"problem_set_stiffness", "solver_create", "solver_create_like", "solver_advance", "solver_equilibrate", "solver_tangent",
           "solver_step_tangent", "solver_load", "solver_load_file"}


def wrong_wait(name):
    """Describes what a call does with a request to cancel that came before it, or returns None."""
    make, arguments = contract.CALLS[name]
    scene = make()
    right = arguments(scene)
    fine("context_cancel", scene.context)
    got = call(name, *right)
    if name in STOPPED:
        return None if got == CODES["DELAM_CANCELLED"] else f"delam_{name}: {got} after a request to cancel"
    if got != contract.OK:
        return f"delam_{name}: {got} after a request to cancel, which does not concern it"
    scene.mesh = made("mesh_create_layers", scene.context, 2, real(1), whole(1), 1, real(1), whole(1), QUAD4)
    scene.problem = made("problem_create", scene.context, scene.mesh)
    fine("problem_set_elastic", scene.problem, -1, 1.0, 0.0)
    for axis in (real(1, 0), real(0, 1)):
        fine("problem_prescribe_nodes", scene.problem, 2, whole(0, 1), axis, 0, None, None, 0)
    got = call("solver_create", scene.problem, 0.0, c_void_p())
    return None if got == CODES["DELAM_CANCELLED"] else f"delam_{name} uses up a request to cancel that came before it"


def provoke(name, status, row):
    """Describes the fault of a row, or returns None."""
    make, arguments = row
    scene = make()
    right = arguments(scene)
    code = CODES.get("DELAM_ERROR_" + status.upper(), CODES.get("DELAM_" + status.upper()))
    got = call(name, *right)
    message = ctypes.string_at(call("context_message", scene.context)).decode()
    fails[0] = False
    if got != code:
        return f"delam_{name}: {status}: the row gives {got}, expected {code}; {message}"
    if not message:
        return f"delam_{name}: {status}: there is no message"
    return None


def main():
    failures, pairs = [], 0
    seen = set()
    own_attempt = contract.attempt

    def attempt(function, what, expected, change, named=None):
        status = own_attempt(function, what, expected, change, named)
        seen.add((function.name, status))
        return status

    contract.attempt = attempt
    listed_pairs = set()
    for function in contract.header.functions.values():
        name = function.name[len("delam_"):]
        fields, _ = lint.fields_of(function.comment)
        status_line = fields["status"].removeprefix("only ")
        for status in lint.split(status_line):
            if status in ("usual", "-", "memory", "handle") or function.result != "int32_t":
                continue
            pairs += 1
            listed_pairs.add((name, status))
            if (name, status) in ROWS:
                wrong = provoke(name, status, ROWS[(name, status)])
                if wrong:
                    failures.append(wrong)
            elif (name, status) in UNSEEN:
                print(f"{function.name}: {status}: not provoked; {UNSEEN[(name, status)]}")
            elif status == "argument":
                if (function.name, CODES["DELAM_ERROR_ARGUMENT"]) not in seen and name in contract.CALLS:
                    contract.probe(function)
                if (function.name, CODES["DELAM_ERROR_ARGUMENT"]) not in seen:
                    failures.append(f"{function.name}: argument: no call of test_contract.py gives it")
            elif status in PLACES:
                with open(PLACES[status], encoding="utf-8") as file:
                    if f'"{function.name}"' not in file.read():
                        failures.append(f"{function.name}: {status}: no row, and {os.path.basename(PLACES[status])} "
                                        "does not name the function")
            else:
                failures.append(f"{function.name}: {status}: no row of provoked.py gives this status")
        if name in contract.CALLS and name != "context_cancel":
            wrong = wrong_wait(name)
            failures += [wrong] if wrong else []
    for name, status in sorted((set(ROWS) | set(UNSEEN)) - listed_pairs):
        failures.append(f"delam_{name}: {status}: in the table, not listed in the header")
    for failure in failures + contract.failures:
        print(failure)
    print(f"{pairs} listed statuses, {len(ROWS)} rows, {len(UNSEEN)} not provoked, {len(failures)} failures")
    sys.exit(1 if failures or contract.failures else 0)


if __name__ == "__main__":
    main()
