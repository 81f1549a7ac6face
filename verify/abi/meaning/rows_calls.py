# SPDX-License-Identifier: BSD-3-Clause
"""Calls out of order, what a call replaces, states of earlier versions, cancellation."""
import glob
import os

import scenes
from host import Out
from scenes import TYPES, field, value
from table import row

OK, CANCELLED, ARGUMENT, STATE, SNAPSHOT = 0, 2, -1, -5, -8
GOLDEN = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "cases", "golden")


@row("commit and rollback without a step")
def without_a_step(host, see):
    bar = scenes.Bar(host, scenes.strong(host, 10.0, 1.0), bulk=10.0)
    for call in ("solver_commit", "solver_rollback"):
        see.equal(f"{call} before a step", host.status(call, bar.solver), STATE)
    bar.step(0.1)
    for call in ("solver_commit", "solver_rollback"):
        see.equal(f"{call} after commit", host.status(call, bar.solver), STATE)
    host("solver_advance", bar.solver, 0.2)
    host("solver_rollback", bar.solver)
    for call in ("solver_commit", "solver_rollback"):
        see.equal(f"{call} after rollback", host.status(call, bar.solver), STATE)
    see.near("time", bar.value("time"), 0.1, "t")
    see.near("step", bar.value("step"), 1)


@row("time of a step")
def time_of_a_step(host, see):
    """A step is after the committed time: a time that is not is a wrong argument, a step that is pending a call out of
    order. A displacement step may have any time."""
    bar = scenes.Bar(host, scenes.strong(host, 10.0, 1.0), bulk=10.0)
    bar.step(0.5)
    for time in (0.25, 0.5, -1.0, float("nan"), float("inf")):
        see.equal(f"advance to {time}", host.status("solver_advance", bar.solver, time), ARGUMENT)
    host("solver_advance", bar.solver, 0.75)
    for call in (("solver_advance", 0.9), ("solver_equilibrate", 0.9, None), ("solver_set_history", 0, 1, [1.0], [2.0]),
                 ("solver_record", "time")):
        see.equal(f"{call[0]} while a step is pending", host.status(call[0], bar.solver, *call[1:]), STATE)
    host("solver_rollback", bar.solver)
    host("solver_equilibrate", bar.solver, 0.25, None)
    see.near("time of a displacement step in the past", bar.value("time"), 0.25, "t")


@row("adhesion after contact and bonds")
def after_contact(host, see):
    """What delam_problem_set_contact, _set_law and _set_bonded do to the initial adhesion, in any order."""
    def build(*calls):
        mesh = host("mesh_create_layers", host.context, 2, [2.0], [2], 2, [1.0, 1.0], [1, 1], TYPES["quad4"], Out())
        host("mesh_add_interface", mesh, 0, 1, 0.0, Out())
        problem = host("problem_create", host.context, mesh, Out())
        host("problem_set_elastic", problem, -1, 1.0, 0.0)
        law = scenes.strong(host, 10.0, 10.0)
        for call in calls:
            if call == "law":
                host("problem_set_law", problem, 0, law)
            elif call in ("contact", "bonded"):
                host(f"problem_set_{call}", problem, 0)
            else:
                host("problem_set_adhesion", problem, 0, 3, [0, 1, 2], call, 0)
        scenes.hold(host, problem, list(range(12)), [[1.0, 0.0], [0.0, 1.0]])
        return [a[0] for a in field(host, host("solver_create", problem, 0.0, Out()), "adhesion")]

    notch = [0.0, 0.5, 1.0]
    see.near("law", build("law"), [1.0] * 3)
    see.near("contact", build("contact"), [0.0] * 3)
    see.near("contact, then law", build("contact", "law"), [1.0] * 3)
    see.near("contact, then bonded", build("contact", "bonded"), [1.0] * 3)
    see.near("notch, then law", build(notch, "law"), notch)
    see.near("law, notch, then law", build("law", notch, "law"), notch)
    see.near("notch, contact, then law", build(notch, "contact", "law"), [1.0] * 3)
    see.near("contact, law, then notch", build("contact", "law", notch), notch)


@row("adhesion in a box again")
def box_again(host, see):
    """The last call counts, whether it raises the adhesion or lowers it."""
    mesh = host("mesh_create_layers", host.context, 2, [2.0], [2], 2, [1.0, 1.0], [1, 1], TYPES["quad4"], Out())
    host("mesh_add_interface", mesh, 0, 1, 0.0, Out())
    seen = []
    for adhesions in ([0.25, 0.75], [0.75, 0.25], [0.0, 1.0]):
        problem = host("problem_create", host.context, mesh, Out())
        host("problem_set_elastic", problem, -1, 1.0, 0.0)
        host("problem_set_law", problem, 0, scenes.strong(host, 10.0, 10.0))
        for adhesion in adhesions:
            host("problem_set_adhesion_box", problem, 0, [-1.0, 0.0], [3.0, 2.0], adhesion, Out())
        scenes.hold(host, problem, list(range(12)), [[1.0, 0.0], [0.0, 1.0]])
        seen.append([a[0] for a in field(host, host("solver_create", problem, 0.0, Out()), "adhesion")])
    see.near("adhesion", seen, [[0.75] * 3, [0.25] * 3, [1.0] * 3])


@row("rows of the step tangent", tells=["solver_step_tangent matrix"])
def step_tangent(host, see):
    """Row p is the derivative of reaction p: by differences of steps from the same state. The mixity changes within the
    step and the toughness with it, so that the tangent is not symmetric."""
    law = scenes.bilinear(host, (200.0, 200.0), (0.3, 0.6), (1.2, 4.0))
    ends = [0.1, 0.06]

    def solver_to(end):
        mesh = host("mesh_create_layers", host.context, 2, [1.0], [1], 2, [1.0, 1.0], [1, 1], TYPES["quad4"], Out())
        host("mesh_add_interface", mesh, 0, 1, 0.0, Out())
        problem = host("problem_create", host.context, mesh, Out())
        host("problem_set_elastic", problem, -1, 1e3, 0.25)
        host("problem_set_law", problem, 0, law)
        host("problem_set_text", problem, "mixity_rule", "converged")
        host("problem_set_number", problem, "path_step", 1.0)
        patterns = [scenes.ramp(host, problem, name, [0.0, 1.0, 2.0], [0.0, own, last])
                    for name, own, last in zip(("open", "slide"), (0.06, 0.06), end)]
        scenes.hold(host, problem, [0, 1, 2, 3], [[1.0, 0.0], [0.0, 1.0]])
        for k, pattern in enumerate(patterns):
            scenes.drive(host, problem, [4, 5, 6, 7], scenes.axis(2, 1 - k), pattern, [1.0] * 4)
        solver = host("solver_create", problem, 0.0, Out())
        host("solver_advance", solver, 1.0)
        host("solver_commit", solver)
        host("solver_advance", solver, 2.0)
        return solver

    def reactions(end):
        solver = solver_to(end)
        return [value(host, solver, f"reaction:{name}") for name in ("open", "slide")]

    matrix = host("solver_step_tangent", solver_to(ends), 4, Out(4))
    h = 1e-5
    columns = []
    for q in range(2):
        one, other = list(ends), list(ends)
        one[q], other[q] = ends[q] + h, ends[q] - h
        columns.append([(a - b) / (2 * h) for a, b in zip(reactions(one), reactions(other))])
    see.near("step tangent", matrix, [columns[q][p] for p in range(2) for q in range(2)], "F L", rel=1e-4)
    see.that(f"the tangent is not symmetric: {matrix}", abs(matrix[1] - matrix[2]) > 1e-2 * max(map(abs, matrix)))


def golden_bar(host):
    """The scene of the states in cases/golden (test_golden.cpp), `recorded` and `told`."""
    mesh = host("mesh_create_layers", host.context, 2, [1.0], [2], 2, [1.0, 1.0], [1, 1], TYPES["quad4"], Out())
    host("mesh_add_interface", mesh, 0, 1, 0.0, Out())
    problem = host("problem_create", host.context, mesh, Out())
    host("problem_set_elastic", problem, -1, 1e12, 0.25)
    law = scenes.bilinear(host, (125e9, 125e9), (100.0, 100.0), (250.0, 500.0))
    host("problem_set_law", problem, 0, law)
    scenes.hold(host, problem, [0, 1, 2], [[1.0, 0.0], [0.0, 1.0]])
    scenes.drive(host, problem, [9, 10, 11], [1.0, 0.0], scenes.ramp(host, problem, "shear", values=(0.0, 4e-5)), [1.0] * 3)
    scenes.drive(host, problem, [9, 10, 11], [0.0, 1.0], scenes.ramp(host, problem, "pull", values=(0.0, 8e-5)),
                 [1.0, 0.9, 0.8])
    for key, text in (("reduction", "condensed"), ("solution", "local"), ("mixity_rule", "frozen")):
        host("problem_set_text", problem, key, text)
    return host("solver_create", problem, 0.0, Out())


@row("states of earlier versions", tells=["solver_load bytes"])
def earlier_states(host, see):
    """Bytes that earlier libraries saved, of each version since 6, have the values that these libraries showed; the
    versions before the first and after the last that is read are refused."""
    read, wrong = [], []
    for path in sorted(glob.glob(os.path.join(GOLDEN, "v*-told.state")) +
                       glob.glob(os.path.join(GOLDEN, "v*-recorded.state"))):
        with open(path, "rb") as file:
            data = list(file.read())
        with open(path.replace(".state", ".txt"), encoding="utf-8") as file:
            wanted = dict(line.split(" ", 1) for line in file.read().splitlines() if line)
        solver = golden_bar(host)
        host("solver_load", solver, len(data), data)
        read.append(os.path.basename(path))
        for key in ("step", "time", "stored_bulk", "stored_interface", "dissipated", "work", "reaction:pull",
                    "reaction:shear"):
            own, old = value(host, solver, key), float(wanted[key])
            if not abs(own - old) <= 1e-9 * max(abs(old), 1e-12):
                wrong.append(f"{read[-1]}: {key} is {own}, not {old}")
        # The next step needs what is behind the values: adhesion, mixity, histories.
        host("solver_advance", solver, 0.75)
    see.that(f"the values are those of the time: {wrong[:2]}", not wrong)
    see.that(f"states of versions 6 to 11 at least: {read}", len(read) >= 11)
    solver = golden_bar(host)
    size = host("solver_save", solver, 0, None, Out())[1]
    own, _ = host("solver_save", solver, size, Out(size), Out())
    for version in (4, own[8] + 1):
        other = own[:8] + [version] + own[9:]
        see.equal(f"version {'before' if version == 4 else 'after'} those that are read",
                  host.status("solver_load", solver, size, other), SNAPSHOT)


@row("a cancel before a call")
def cancel_before(host, see):
    """A request that found nothing to stop waits for the next call that solves; calls that build or read let it wait."""
    bar = scenes.Bar(host, scenes.strong(host, 10.0, 1.0), bulk=10.0)
    host("context_cancel", host.context)
    mesh = host("mesh_create_layers", host.context, 2, [1.0], [2], 1, [1.0], [2], TYPES["quad4"], Out())
    see.that("a mesh is built", mesh is not None)
    see.near("a value is read", bar.value("time"), 0.0, "t")
    see.equal("status of the step", bar.step(0.5), CANCELLED)
    see.equal("pending", host("solver_pending", bar.solver, Out()), 0)
    see.equal("status of the same step again", bar.step(0.5), OK)
    data = host("solver_save", bar.solver, 0, None, Out())[1]
    state, _ = host("solver_save", bar.solver, data, Out(data), Out())
    calls = [("solver_create", bar.problem, 0.0, Out()), ("solver_equilibrate", bar.solver, 0.6, None),
             ("solver_tangent", bar.solver, 1, Out(1)), ("solver_load", bar.solver, data, state)]
    for call in calls:
        host("context_cancel", host.context)
        host("context_cancel", host.context)
        see.equal(f"{call[0]} after two requests", host.status(*call), CANCELLED)
        see.equal(f"{call[0]} again", host.status(*call), OK)
        if call[0] == "solver_equilibrate":
            host("solver_rollback", bar.solver)
