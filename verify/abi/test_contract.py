#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""test_contract.py LIBRARY HEADER: is what the lines in brackets say true? Each function is called once as it should
be, then once for each thing that its line and the head of the header forbid or allow:

    a pointer that may be NULL      the same status as before
    any other pointer NULL          DELAM_ERROR_ARGUMENT, and the message names it
    a handle NULL or foreign        DELAM_ERROR_HANDLE
    a number not finite             DELAM_ERROR_ARGUMENT (inputs alone)
    an index, a label, a type, a count or a capacity outside of its range: DELAM_ERROR_ARGUMENT
    any call                        a status that the line lists; after an error *out is NULL and nothing has changed

The calls are a table (CALLS); a function of the header that is missing there is a failure, so that a new one gets its
line.
"""
import ctypes
import functools
import math
import os
import re
import sys
import tempfile
from ctypes import c_double, c_int32, c_int64, c_uint8, c_void_p

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import contract_lint as lint  # noqa: E402
import header as headers  # noqa: E402

LIBRARY, HEADER = sys.argv[1:3]
header = headers.read(HEADER)
library = ctypes.CDLL(LIBRARY)
CODES = {name: int(value) for name, value in header.constants.items() if re.fullmatch(r"-?\d+", value)}
OK, ARGUMENT, HANDLE = 0, CODES["DELAM_ERROR_ARGUMENT"], CODES["DELAM_ERROR_HANDLE"]
SCALARS = {"int32_t": c_int32, "int64_t": c_int64, "double": c_double, "uint8_t": c_uint8}
PLACE = ctypes.POINTER(c_double)
FOLDER = tempfile.TemporaryDirectory(prefix="delam-contract-")
STATE_FILE = os.path.join(FOLDER.name, "state")
failures = []
calls_made = 0

for function in header.functions.values():
    symbol = getattr(library, function.name)
    symbol.argtypes = [SCALARS.get(p.type, c_void_p) for p in function.parameters]
    symbol.restype = c_void_p if "*" in function.result else SCALARS.get(function.result)


def real(*values):
    return (c_double * max(1, len(values)))(*values)


def whole(*values):
    return (c_int64 * max(1, len(values)))(*values)


def short(*values):
    return (c_int32 * max(1, len(values)))(*values)


def words(text):
    return ctypes.create_string_buffer(text.encode())


def room(kind, count):
    return (kind * count)()


@ctypes.CFUNCTYPE(None, c_int32, ctypes.c_char_p, c_void_p)
def on_log(level, text, user):
    del level, text, user


@ctypes.CFUNCTYPE(c_int32, ctypes.c_char_p, c_int64, c_int64, c_void_p)
def on_progress(stage, done, total, user):
    del stage, done, total, user
    return 0


@ctypes.CFUNCTYPE(c_int32, c_double, c_double, PLACE, PLACE, c_void_p)
def on_adhesion(mixity, driving, adhesion, slope, user):
    del mixity, driving, user
    adhesion[0], slope[0] = 1.0, 0.0
    return 0


@ctypes.CFUNCTYPE(c_int32, c_double, c_double, PLACE, PLACE, PLACE, c_void_p)
def on_dissipation(mixity, adhesion, dissipated, slope, mixity_slope, user):
    del mixity, user
    dissipated[0], slope[0], mixity_slope[0] = 250.0 * (1.0 - adhesion), -250.0, 0.0
    return 0


def is_object(parameter):
    return lint.is_handle(parameter.type, header) and parameter.type.count("*") == 1


def raw(value):
    if isinstance(value, (ctypes.Array, ctypes._SimpleCData)):
        return ctypes.addressof(value)
    if isinstance(value, ctypes._CFuncPtr):
        return ctypes.cast(value, c_void_p).value
    return value


def call(name, *arguments):
    global calls_made
    calls_made += 1
    return getattr(library, "delam_" + name)(*[raw(a) for a in arguments])


def fine(name, *arguments):
    status = call(name, *arguments)
    if status != OK:
        raise SystemExit(f"delam_{name}: {status}: {ctypes.string_at(call('context_message', Scene.last)).decode()}")


def made(name, *arguments):
    out = c_void_p()
    fine(name, *arguments, out)
    return out.value


class Scene:
    """Two unit squares on each other, a node without cells beside them; made as far as a call needs it."""

    last = None

    def __init__(self, joined=True, complete=True, brittle=False):
        self.context = made("context_create")
        Scene.last = self.context
        self.nodes = real(0, 0, 1, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 2, 0, 2, 2, 2)
        self.mesh = made("mesh_create", self.context, 2, 9, self.nodes)
        fine("mesh_add_cells", self.mesh, CODES["DELAM_QUAD4"], 2, whole(0, 1, 2, 3, 4, 5, 6, 7), short(0, 1), 0)
        self.law = made("law_create", self.context, words("griffith" if brittle else "piecewise-linear"))
        for key, value in (("normal_stiffness", 1e6), ("tangential_stiffness", 1e6), ("normal_toughness", 250.0),
                           ("tangential_toughness", 250.0)):
            fine("law_set", self.law, words(key), value)
        for key in () if brittle else ("normal_onset", "tangential_onset"):
            fine("law_set", self.law, words(key), 100.0)
        self.problem = self.solver = None
        if not joined:
            return
        fine("mesh_add_interface", self.mesh, 0, 1, 0.0, whole(0))
        self.problem = made("problem_create", self.context, self.mesh)
        fine("problem_set_elastic", self.problem, -1, 1e9, 0.3)
        fine("problem_set_law", self.problem, 0, self.law)
        for name in ("open", "push", "heat"):
            fine("problem_add_pattern", self.problem, words(name), 2, real(0, 1), real(0, 1), whole(0))
        if not complete:
            return
        for axis in (real(1, 0), real(0, 1)):
            fine("problem_prescribe_nodes", self.problem, 2, whole(0, 1), axis, 0, None, None, 0)
        fine("problem_prescribe_nodes", self.problem, 2, whole(6, 7), real(0, 1), 1, whole(0), real(0.05, 0.05), 0)
        fine("problem_prescribe_nodes", self.problem, 1, whole(6), real(1, 0), 0, None, None, 0)
        fine("problem_add_forces", self.problem, 1, 1, whole(7), real(1, 0), 0)
        fine("problem_add_eigenstrain", self.problem, 2, -1, real(1e-9, 0, 0, 0, 0, 0))
        if brittle:
            fine("problem_set_number", self.problem, words("jump_tolerance"), 0.1)
        self.solver = made("solver_create", self.problem, 0.0)

    def analysed(self):
        fine("solver_advance", self.solver, 0.5)
        return self

    def committed(self):
        self.analysed()
        fine("solver_commit", self.solver)
        return self

    def recorded(self):
        fine("solver_record", self.solver, words("time"))
        return self

    def saved(self):
        needed = whole(0)
        fine("solver_save", self.solver, 0, None, needed)
        data = room(c_uint8, needed[0])
        fine("solver_save", self.solver, needed[0], data, needed)
        return data

    def values(self):
        """The data that an error must leave unchanged: sizes of the mesh, hash of the problem, state of the solver."""
        sizes = [short(0)] + [whole(0) for _ in range(4)]
        fine("mesh_size", self.mesh, *sizes)
        seen = [size[0] for size in sizes]
        if self.problem:
            text = room(c_uint8, 17)
            fine("problem_hash", self.problem, text)
            seen.append(bytes(text))
        if self.solver:
            seen.append(bytes(self.saved()))
        return seen

    def end(self):
        for kind in ("solver", "problem", "law", "mesh", "context"):
            call(kind + "_destroy", c_void_p(getattr(self, kind)))


loose, bare, full = functools.partial(Scene, joined=False), functools.partial(Scene, complete=False), Scene


def table_law(s):
    s.law = made("law_create", s.context, words("tabulated"))
    return [s.law, 2, real(0, 1), real(1, 0)]


def more_nodes(s):
    s.mesh = made("mesh_create", s.context, 2, 9, s.nodes)
    return [s.mesh, CODES["DELAM_QUAD4"], 1, whole(0, 1, 2, 3), short(0), 0]


def stiffness(s):
    """The stiffness of body 0 as arguments: its nodes are 0 to 3, and its free motions are the rigid ones."""
    starts, columns, values = room(c_int64, 9), room(c_int64, 64), room(c_double, 64)
    fine("problem_body_matrix", s.problem, 0, None, None, starts, columns, values)
    kernel = real(*[1, 0] * 4, *[0, 1] * 4, 0, 0, 0, 1, -1, 1, -1, 0)
    return [s.problem, 4, whole(0, 1, 2, 3), whole(*range(8)), starts, columns, values, 3, kernel, 0]


def saved_file(s):
    fine("solver_save_file", s.solver, words(STATE_FILE))
    return [s.solver, words(STATE_FILE)]


def number_option(_):
    texts = [c_void_p() for _ in range(6)]
    index = 0
    while call("option_info", index, *texts) == OK and ctypes.string_at(texts[1].value) == b"text":
        index += 1
    return [index, real(0), real(0), short(0), short(0)]


def plan_item(s):
    return [s.solver, 0] + [c_void_p() for _ in range(3)] + [real(0), real(0), c_void_p()]


# function -> (scene, arguments of a call as it should be)
CALLS = {
    "context_set_log": (loose, lambda s: [s.context, on_log, None]),
    "context_set_progress": (loose, lambda s: [s.context, on_progress, None]),
    "context_cancel": (loose, lambda s: [s.context]),
    "context_create": (loose, lambda s: [c_void_p()]),
    "mesh_create": (loose, lambda s: [s.context, 2, 4, s.nodes, c_void_p()]),
    "mesh_create_layers": (loose, lambda s: [s.context, 2, real(1), whole(1), 1, real(1), whole(1),
                                              CODES["DELAM_QUAD4"], c_void_p()]),
    **dict.fromkeys(("mesh_add_cells", "mesh_add_conforming_cells"), (loose, more_nodes)),
    **dict.fromkeys(("mesh_add_interface", "mesh_add_projected_interface", "mesh_add_mortar_interface"),
                    (loose, lambda s: [s.mesh, 0, 1, 0.0, whole(0)])),
    **dict.fromkeys(("mesh_add_all_interfaces", "mesh_add_seams"), (loose, lambda s: [s.mesh, 0.0, whole(0)])),
    "mesh_add_self_contact": (loose, lambda s: [s.mesh, 0.5, whole(0)]),
    "mesh_add_obstacle": (loose, lambda s: [s.mesh, 2, whole(0, 1), real(0, 1, 0, 1), real(0.5, 0.5), 8, 0, whole(0)]),
    "mesh_add_host_body": (loose, lambda s: [s.mesh, 7, 1, whole(8), 0]),
    "mesh_add_pairs": (loose, lambda s: [s.mesh, 0, 1, 2, whole(3, 2), whole(4, 5), real(0, 1, 0, 1), real(0.5, 0.5), 1,
                                         2, whole(0, 1), 0, whole(0)]),
    "mesh_size": (bare, lambda s: [s.mesh, short(0), whole(0), whole(0), whole(0), whole(0)]),
    "mesh_nodes": (bare, lambda s: [s.mesh, 18, room(c_double, 18)]),
    "mesh_node_bodies": (bare, lambda s: [s.mesh, 9, room(c_int32, 9)]),
    "mesh_node_origins": (bare, lambda s: [s.mesh, 9, room(c_int64, 9)]),
    "mesh_node_ties": (bare, lambda s: [s.mesh, whole(0), whole(0), room(c_int64, 9), room(c_int64, 9),
                                        room(c_int64, 9), room(c_double, 9)]),
    "mesh_cells": (bare, lambda s: [s.mesh, room(c_int32, 2), room(c_int32, 2), room(c_int64, 3), 8, room(c_int64, 8),
                                    whole(0)]),
    "mesh_interface_size": (bare, lambda s: [s.mesh, 0, short(0), short(0), whole(0), whole(0), short(0)]),
    "mesh_interface_pairs": (bare, lambda s: [s.mesh, 0, room(c_int64, 2), room(c_int64, 2), room(c_double, 2),
                                              room(c_double, 8)]),
    "mesh_interface_faces": (bare, lambda s: [s.mesh, 0, room(c_int64, 2)]),
    "mesh_find_nodes": (bare, lambda s: [s.mesh, 0, real(0, 0), real(1, 1), 4, room(c_int64, 4), whole(0)]),
    "mesh_find_patch": (bare, lambda s: [s.mesh, 0, real(0, 0), real(1, 0), real(0, -1), 4, room(c_int64, 4),
                                         room(c_double, 4), whole(0)]),
    "law_create": (loose, lambda s: [s.context, words("griffith"), c_void_p()]),
    "law_set": (loose, lambda s: [s.law, words("normal_stiffness"), 1.0]),
    "law_set_text": (loose, lambda s: [s.law, words("criterion"), words("power")]),
    "law_set_table": (loose, table_law),
    "law_parameter_info": (loose, lambda s: [words("griffith"), 0] + [c_void_p() for _ in range(6)]),
    "law_parameter_bounds": (loose, lambda s: [words("griffith"), 1, real(0), real(0), short(0), short(0)]),
    "law_kind_info": (bare, lambda s: [0, c_void_p(), c_void_p(), short(0)]),
    "law_create_host": (loose, lambda s: [s.context, words("host"), on_adhesion, on_dissipation, None, c_void_p()]),
    "law_check": (loose, lambda s: [s.law]),
    "law_toughness": (loose, lambda s: [s.law, 1, real(0.5), real(0), real(0)]),
    "law_respond": (loose, lambda s: [s.law, 2, 1, real(1e-3, 0), real(0.5), real(1), real(0), real(0, 0)]),
    "problem_create": (loose, lambda s: [s.context, s.mesh, c_void_p()]),
    "problem_set_plane": (bare, lambda s: [s.problem, words("plane-stress")]),
    "problem_set_elastic": (bare, lambda s: [s.problem, 0, 1e9, 0.3]),
    "problem_set_orthotropic": (bare, lambda s: [s.problem, 0, real(1e9, 1e9, 1e9, 0.3, 0.3, 0.3, 4e8, 4e8, 4e8)]),
    "problem_set_orientation": (bare, lambda s: [s.problem, 0, 1, whole(0), real(1, 1, 0, -1, 1, 0), 0]),
    "problem_set_formulation": (bare, lambda s: [s.problem, 0, words("incompatible")]),
    "problem_set_stiffness": (bare, stiffness),
    "problem_set_law": (bare, lambda s: [s.problem, 0, s.law]),
    **dict.fromkeys(("problem_set_bonded", "problem_set_contact"), (bare, lambda s: [s.problem, 0])),
    "problem_set_adhesion": (bare, lambda s: [s.problem, 0, 1, whole(0), real(0.0), 0]),
    "problem_set_adhesion_box": (bare, lambda s: [s.problem, 0, real(-9, -9), real(9, 9), 1.0, whole(0)]),
    "problem_add_pattern": (bare, lambda s: [s.problem, words("more"), 1, real(0), real(1), whole(0)]),
    "problem_prescribe_nodes": (bare, lambda s: [s.problem, 1, whole(0), real(1, 0), 1, whole(0), real(1), 0]),
    "problem_prescribe_mean": (bare, lambda s: [s.problem, 1, whole(0), real(1), real(1, 0), 1, whole(0), real(1), 0]),
    "problem_add_equation": (bare, lambda s: [s.problem, 1, whole(0), real(1, 0), 1, whole(0), real(1), 0]),
    **{f"problem_{w}_constraints": (full, lambda s, p=p: [s.problem, 0, 1, 0.5, p]) for p, w in enumerate(("begin", "end"))},
    "problem_add_periodic": (bare, lambda s: [s.problem, 1, real(1, 0), whole(8), 0.0, 0]),
    "problem_add_forces": (bare, lambda s: [s.problem, 1, 1, whole(0), real(1, 0), 0]),
    "problem_add_eigenstrain": (bare, lambda s: [s.problem, 2, 0, real(1, 0, 0, 0, 0, 0)]),
    "problem_set_gaps": (bare, lambda s: [s.problem, 0, 2, real(1e-3, 0), 0.0]),
    "problem_set_number": (bare, lambda s: [s.problem, words("damage_tolerance"), 1e-6]),
    "problem_set_text": (bare, lambda s: [s.problem, words("solution"), words("local")]),
    "cell_type_info": (bare, lambda s: [0, c_void_p()] + [short(0) for _ in range(7)]),
    "cell_type_topology": (bare, lambda s: [0, room(c_int32, 6), room(c_int32, 2)]),
    "option_info": (bare, lambda s: [0] + [c_void_p() for _ in range(6)]),
    "option_alias": (bare, lambda s: [0, c_void_p()]), "option_bounds": (bare, number_option),
    "problem_check": (full, lambda s: [s.problem]),
    "problem_hash": (full, lambda s: [s.problem, room(c_uint8, 17)]),
    "problem_dofs": (full, lambda s: [s.problem, whole(0), whole(0)]),
    "problem_process_zone": (full, lambda s: [s.problem, 0, real(0), real(0)]),
    "problem_propose": (full, lambda s: [s.problem, 0, 3.0, real(0), real(0), real(0), real(0)]),
    "problem_body_matrix": (full, lambda s: [s.problem, 0, whole(0), whole(0), room(c_int64, 9), room(c_int64, 64),
                                             room(c_double, 64)]),
    "problem_constraints": (full, lambda s: [s.problem, whole(0), whole(0), whole(0), room(c_int64, 8),
                                             room(c_int64, 16), room(c_double, 16), room(c_double, 32)]),
    "problem_forces": (full, lambda s: [s.problem, 1, 18, room(c_double, 18)]),
    "problem_eigenstrain_energy": (full, lambda s: [s.problem, 9, room(c_double, 9)]),
    "problem_factors": (full, lambda s: [s.problem, 0.5, 3, room(c_double, 3)]),
    **dict.fromkeys(("problem_pattern_count", "problem_value_count"), (full, lambda s: [s.problem, whole(0)])),
    "problem_value_info": (full, lambda s: [s.problem, 0, c_void_p(), c_void_p()]),
    "problem_plan": (full, lambda s: [s.problem, c_void_p(), real(0), real(0)]),
    "solver_create": (full, lambda s: [s.problem, 0.0, c_void_p()]),
    "solver_create_like": (full, lambda s: [s.problem, s.solver, 0.0, c_void_p()]),
    "solver_shares_bodies": (full, lambda s: [s.solver, s.problem, short(0)]),
    "solver_advance": (full, lambda s: [s.solver, 0.5]),
    "solver_commit": (lambda: full().analysed(), lambda s: [s.solver]),
    "solver_rollback": (lambda: full().analysed(), lambda s: [s.solver]),
    "solver_pending": (full, lambda s: [s.solver, short(0)]),
    "solver_set_history": (full, lambda s: [s.solver, 0, 2, real(0.5, 1), real(0.1, 0.2)]),
    "solver_equilibrate": (full, lambda s: [s.solver, 0.5, real(1, 1)]),
    "solver_value": (full, lambda s: [s.solver, words("kkt_gap"), real(0)]),
    "solver_value_count": (full, lambda s: [s.solver, whole(0)]),
    "solver_value_info": (full, lambda s: [s.solver, 0] + [c_void_p() for _ in range(5)] + [short(0)]),
    "solver_record": (lambda: full().committed(), lambda s: [s.solver, words("time")]),
    "solver_recorded_size": (full, lambda s: [s.solver, whole(0), whole(0)]),
    "solver_recorded": (lambda: full().recorded(), lambda s: [s.solver, words("time"), 1, real(0)]),
    "solver_field_shape": (full, lambda s: [s.solver, words("jump"), 0, whole(0), whole(0)]),
    "solver_field": (full, lambda s: [s.solver, words("jump"), 0, 4, room(c_double, 4)]),
    "solver_average": (full, lambda s: [s.solver, -1, real(0), room(c_double, 6), room(c_double, 6)]),
    "solver_front_count": (full, lambda s: [s.solver, 0, whole(0), whole(0)]),
    "solver_front": (full, lambda s: [s.solver, 0, 4, 4, room(c_int64, 5), room(c_int32, 4), room(c_double, 8),
                                      room(c_double, 8), room(c_double, 4), room(c_double, 12), room(c_double, 4),
                                      room(c_double, 4)]),
    "solver_tangent": (full, lambda s: [s.solver, 9, room(c_double, 9)]),
    "solver_step_tangent": (lambda: full().analysed(), lambda s: [s.solver, 9, room(c_double, 9)]),
    "solver_condensed_size": (full, lambda s: [s.solver, whole(0), whole(0)]),
    "solver_condensed": (full, lambda s: [s.solver, 16, room(c_double, 16), room(c_double, 12), room(c_double, 9),
                                          room(c_int64, 5), room(c_int64, 16), room(c_double, 16), room(c_double, 12)]),
    "solver_plan_count": (full, lambda s: [s.solver, whole(0)]),
    "solver_plan_item": (full, plan_item),
    "solver_look": (full, lambda s: [s.solver, -1]),
    "solver_jump_count": (full, lambda s: [s.solver, whole(0)]),
    "solver_jump": (lambda: Scene(brittle=True).committed(),
                    lambda s: [s.solver, 0, whole(0)] + [real(0) for _ in range(6)] + [whole(0) for _ in range(3)]),
    "solver_jump_reactions": (lambda: Scene(brittle=True).committed(),
                              lambda s: [s.solver, 0, 9, room(c_double, 9), room(c_double, 9)]),
    "solver_save": (full, lambda s: [s.solver, len(s.saved()), s.saved(), whole(0)]),
    "solver_load": (lambda: full().committed(), lambda s: [s.solver, len(s.saved()), s.saved()]),
    "solver_save_file": (full, lambda s: [s.solver, words(STATE_FILE)]),
    "solver_load_file": (lambda: full().committed(), saved_file),
}
# Functions that return no status: what they give for the right call and for a wrong one.
TEXTS = {
    "version": lambda: [], "commit": lambda: [], "status_name": lambda: [99], "abi": lambda: [],
    "option_count": lambda: [], "cell_type_count": lambda: [], "blas_threads": lambda: [],
    "law_parameter_count": lambda: [None], "law_kind_count": lambda: [], "context_message": None,
    "problem_pattern_name": None, "problem_option": None, "solver_value_name": None, "solver_plan": None, "solver_option": None,
    "solver_searched": None,
}


def listed(function):
    fields, _ = lint.fields_of(function.comment)
    status = fields["status"]
    only = status.startswith("only ")
    names = set(lint.split(status[5:] if only else status)) - {"usual"}
    if not only:
        names |= lint.USUAL
    codes = {CODES.get("DELAM_ERROR_" + n.upper(), CODES.get("DELAM_" + n.upper())) for n in names}
    return codes | {OK}, lint.split(fields.get("null", ""))


def attempt(function, what, expected, change, named=None):
    """One call on a new scene with the right arguments but for `change`."""
    short_name = function.name[len("delam_"):]
    make, arguments = CALLS[short_name]
    scene = make()
    right = arguments(scene)
    keep = list(right)
    before = scene.values()
    if change:
        change(right)
    status = call(short_name, *right)
    message = ctypes.string_at(call("context_message", scene.context)).decode()
    allowed, _ = listed(function)
    if status not in allowed:
        failures.append(f"{function.name}: {what}: status {status} is not listed")
    if expected is not None and status != expected:
        failures.append(f"{function.name}: {what}: status {status}, expected {expected}; {message}")
    elif named and status == ARGUMENT and is_object(function.parameters[0]):
        if not re.search(rf"\b{named}\b", message):
            failures.append(f"{function.name}: {what}: the message does not name it: '{message}'")
    last = function.parameters[-1]
    makes = last.name == "out" and last.type.endswith("**")
    if status < 0 and scene.values() != before:
        failures.append(f"{function.name}: {what}: status {status}, but the object has changed")
    if makes and status < 0 and right[-1] is not None and right[-1].value is not None:
        failures.append(f"{function.name}: {what}: *out is not NULL")
    if makes and status == OK:
        call(last.type.rstrip("*")[len("delam_"):] + "_destroy", c_void_p(right[-1].value))
    del keep
    scene.end()
    return status


def probe(function):
    short_name = function.name[len("delam_"):]
    _, nullable = listed(function)
    right = attempt(function, "the right call", OK, None)
    if right != OK:
        return
    foreign = whole(*[0] * 8)
    for place, p in enumerate(function.parameters):
        def put(value, place=place):
            def change(arguments):
                arguments[place] = value
            return change

        if is_object(p):
            attempt(function, f"{p.name} NULL", OK if p.name in nullable else HANDLE, put(None))
            attempt(function, f"{p.name} foreign", HANDLE, put(foreign))
        elif "*" in p.type or p.type in header.callbacks:
            if p.name in nullable:
                # No kind is a kind of no parameters.
                of_no_kind = short_name.startswith("law_parameter_") and p.name == "kind"
                expected = ARGUMENT if of_no_kind else OK
                attempt(function, f"{p.name} NULL, as it may be", expected, put(None))
            elif not any(entry.startswith(f"{p.name} at ") for entry in nullable):
                attempt(function, f"{p.name} NULL", ARGUMENT, put(None), named=p.name)
        if p.type == "double":
            for bad in (math.nan, math.inf, -math.inf):
                attempt(function, f"{p.name} {bad}", ARGUMENT, put(bad), named=None)
        if p.type == "const double*":
            for bad in (math.nan, math.inf):
                def spoil(arguments, place=place, bad=bad):
                    arguments[place][0] = bad
                attempt(function, f"{p.name}[0] {bad}", ARGUMENT, spoil)
        if p.name == "index_base":
            attempt(function, "index_base 2", ARGUMENT, put(2), named="index_base")
        if p.name == "capacity":
            attempt(function, "capacity -1", ARGUMENT, put(-1))
        if p.type == "int64_t" and (p.name == "size" or p.name.endswith("count")):
            bad = -2 if p.name == "kernel_count" else -1  # -1: find it
            attempt(function, f"{p.name} {bad}", ARGUMENT, put(bad))
        if p.type == "int32_t" and (p.name in ("cell_type", "dimension") or p.name.startswith("body")):
            for bad in (-7, 99):
                if (short_name, bad) != ("mesh_add_host_body", 99):  # a new label
                    attempt(function, f"{p.name} {bad}", ARGUMENT, put(bad))
        if p.name in ("interface_index", "index", "pattern") and p.type == "int64_t":
            for bad in (-1, 1 << 40):
                attempt(function, f"{p.name} {bad}", ARGUMENT, put(bad))


def main():
    for function in header.functions.values():
        short_name = function.name[len("delam_"):]
        if short_name in CALLS:
            probe(function)
        elif short_name.endswith("_destroy"):
            call(short_name, None)
            call(short_name, c_void_p())
            kept = whole(*[0] * 8)
            foreign = c_void_p(ctypes.addressof(kept))
            call(short_name, foreign)
            if foreign.value is not None:
                failures.append(f"{function.name}: a foreign handle is not set to NULL")
        elif short_name in TEXTS:
            arguments = TEXTS[short_name]
            if arguments is not None:
                call(short_name, *arguments())
                continue
            # With a handle: never NULL, or NULL where the line says so, for a NULL handle.
            _, nullable = listed_text(function)
            result = call(short_name, None, *[None if "*" in p.type else 0 for p in function.parameters[1:]])
            if ("result" in nullable) != (result is None):
                failures.append(f"{function.name}: NULL handle: result {result}, NULL allowed: {'result' in nullable}")
        else:
            failures.append(f"{function.name}: no call in the table of verify/abi/test_contract.py")
    for failure in failures:
        print(failure)
    print(f"{len(header.functions)} functions, {calls_made} calls, {len(failures)} failures")
    sys.exit(1 if failures else 0)


def listed_text(function):
    fields, _ = lint.fields_of(function.comment)
    return fields["status"], [w.split(" ")[0] for w in lint.split(fields.get("null", ""))]


if __name__ == "__main__":
    main()
