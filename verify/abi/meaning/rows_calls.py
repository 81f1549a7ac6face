# SPDX-License-Identifier: BSD-3-Clause
"""Calls out of order, what a call replaces, states of earlier versions, cancellation."""
import glob
import math
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


@row("bodies that solvers share", tells=["solver_shares_bodies shares"])
def shared_bodies(host, see):
    """Another law and another adhesion leave the bodies as they are; another modulus, another option and another
    operator of the first solver do not. What is shared is condensed once, and outlives the solver that made it."""
    bar = scenes.Bar(host, scenes.strong(host, 10.0, 1.0), bulk=10.0)
    bar.step(0.5)
    shares, counts, works = [], [], []

    def follow():
        shares.append(host("solver_shares_bodies", bar.solver, bar.problem, Out()))
        other = host("solver_create_like", bar.problem, bar.solver, 0.0, Out())
        counts.append(value(host, other, "bulk_factorisations"))
        host("solver_advance", other, 0.5)
        works.append(value(host, other, "work"))
        return other

    first = follow()
    host("problem_set_law", bar.problem, 0, scenes.strong(host, 30.0, 1.0))
    host("solver_destroy", bar.solver)
    bar.solver = first
    follow()
    host("problem_set_adhesion", bar.problem, 0, 2, [0, 1], [0.5, 0.5], 0)
    follow()
    scenes.give(host, bar.problem, "reduction", "iterated")
    follow()
    scenes.give(host, bar.problem, "reduction", "auto")
    host("problem_set_elastic", bar.problem, -1, 20.0, 0.0)
    follow()
    see.equal("shares", shares, [1, 1, 1, 0, 0])
    see.equal("condensations", counts[:3] + counts[4:], [0, 0, 0, 1])
    # Springs in series: 10 and 10, 10 and 30, 10 and 15, the same, 20 and 15; pulled by .5.
    series = [a * b / (a + b) for a, b in ((10, 10), (10, 30), (10, 15), (10, 15), (20, 15))]
    see.near("work", works, [0.125 * k for k in series], "F L")


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
    host("problem_set_formulation", problem, -1, "standard")
    law = scenes.bilinear(host, (125e9, 125e9), (100.0, 100.0), (250.0, 500.0))
    host("problem_set_law", problem, 0, law)
    scenes.hold(host, problem, [0, 1, 2], [[1.0, 0.0], [0.0, 1.0]])
    scenes.drive(host, problem, [9, 10, 11], [1.0, 0.0], scenes.ramp(host, problem, "shear", values=(0.0, 4e-5)), [1.0] * 3)
    scenes.drive(host, problem, [9, 10, 11], [0.0, 1.0], scenes.ramp(host, problem, "pull", values=(0.0, 8e-5)),
                 [1.0, 0.9, 0.8])
    for key, text in (("reduction", "condensed"), ("solution", "local"), ("mixity_rule", "frozen")):
        host("problem_set_text", problem, key, text)
    return host("solver_create", problem, 0.0, Out())


@row("states of earlier versions")
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


def bytes_of(host, solver):
    size = host("solver_save", solver, 0, None, Out())[1]
    return host("solver_save", solver, size, Out(size), Out())[0]


@row("what a rollback restores")
def rollback(host, see):
    """Every byte of the state, and the state described."""
    law = scenes.bilinear(host, (10.0, 10.0), (0.05, 0.05), (0.6, 0.6))
    bar = scenes.Bar(host, law, bulk=10.0, options=[("backtracking", "on")])
    bar.step(0.3)
    bar.step(0.5)
    before = bytes_of(host, bar.solver)
    for step in ("solver_advance", "solver_equilibrate"):
        host(step, bar.solver, 0.7, *([None] if step == "solver_equilibrate" else []))
        host("solver_look", bar.solver, 1)
        host("solver_rollback", bar.solver)
        see.that(f"the bytes after {step} and rollback", bytes_of(host, bar.solver) == before)
        see.near(f"time after {step} and rollback", bar.value("time"), 0.5, "t")
    bar.step(0.9, commit=False)
    see.that("a pending step is not saved", bytes_of(host, bar.solver) == before)


@row("what loading replaces")
def loading(host, see):
    """A loaded state brings its history and its record, and ends a pending step and a selection of an earlier step."""
    law = scenes.strong(host, 10.0, 1.0)
    one, other = (scenes.Bar(host, law, bulk=10.0, options=[("backtracking", "on")]) for _ in range(2))
    host("solver_record", one.solver, "time")
    one.step(0.1)
    host("solver_set_history", one.solver, 0, 2, [0.2, 0.4], [0.5, 0.3])
    state = bytes_of(host, one.solver)
    host("solver_record", other.solver, "work")
    for time in (0.3, 0.6):
        other.step(time)
    host("solver_look", other.solver, 1)
    other.step(0.8, commit=False)
    host("solver_load", other.solver, len(state), state)
    see.equal("pending", host("solver_pending", other.solver, Out()), 0)
    see.near("time", other.value("time"), 0.1, "t")
    see.equal("first and steps of the record", host("solver_recorded_size", other.solver, Out(), Out()), [0, 2])
    see.near("record", host("solver_recorded", other.solver, "time", 2, Out(2)), [0.0, 0.1], "t")
    see.equal("status of a key of the replaced record",
              host.status("solver_recorded", other.solver, "work", 2, Out(2)), ARGUMENT)
    factors = []
    for time in (0.15, 0.2, 0.3, 0.5):
        other.step(time)
        factors.append(other.value("load:pull"))
    see.near("factor", factors, [0.3, 0.5, 0.4, 0.3])


@row("a record of steps that are set")
def recorded_again(host, see):
    """A displacement step keeps the number of the committed step, whose entry it replaces; a key is recorded once."""
    bar = scenes.Bar(host, scenes.strong(host, 10.0, 1.0), bulk=10.0)
    host("solver_record", bar.solver, "time")
    once = bytes_of(host, bar.solver)
    host("solver_record", bar.solver, "time")
    see.that("a second request has no effect", bytes_of(host, bar.solver) == once)
    bar.step(0.2)
    bar.step(0.4)
    host("solver_equilibrate", bar.solver, 0.3, None)
    see.near("step", bar.value("step"), 2)
    host("solver_commit", bar.solver)
    bar.step(0.7)
    see.near("step after it", bar.value("step"), 3)
    see.equal("first and steps", host("solver_recorded_size", bar.solver, Out(), Out()), [0, 4])
    see.near("time", host("solver_recorded", bar.solver, "time", 4, Out(4)), [0.0, 0.2, 0.3, 0.7], "t")
    kept = scenes.Bar(host, scenes.strong(host, 10.0, 1.0), bulk=10.0, options=[("backtracking", "on")])
    kept.step(0.2)
    see.equal("an earlier step is kept", host.status("solver_look", kept.solver, 0), OK)
    host("solver_equilibrate", kept.solver, 0.3, None)
    host("solver_commit", kept.solver)
    see.equal("and not after a state was set", host.status("solver_look", kept.solver, 0), ARGUMENT)


@row("jumps of a pending step")
def pending_jumps(host, see):
    """A soft bar on a brittle bond: its only jump breaks both pairs at once (rows_values.py)."""
    bar = scenes.Bar(host, scenes.bilinear(host, (100.0, 100.0), (0.02, 0.02), (0.1, 0.1)), bulk=8.0)
    counts = [host("solver_jump_count", bar.solver, Out())]
    for time in (0.26, 0.3):
        host("solver_advance", bar.solver, time)
        counts.append(host("solver_jump_count", bar.solver, Out()))
        if time == 0.3:
            host("solver_rollback", bar.solver)
            counts.append(host("solver_jump_count", bar.solver, Out()))
            host("solver_advance", bar.solver, time)
        host("solver_commit", bar.solver)
    counts.append(host("solver_jump_count", bar.solver, Out()))
    see.equal("jumps before, pending, rolled back and committed", counts, [0, 0, 1, 0, 1])


@row("what the last call replaces")
def last_call(host, see):
    """Materials, plane assumptions and stiffnesses are replaced; forces and eigenstrains add up."""
    def block(*calls):
        mesh = host("mesh_create_layers", host.context, 2, [1.0], [1], 1, [1.0], [1], TYPES["quad4"], Out())
        problem = host("problem_create", host.context, mesh, Out())
        host("problem_set_elastic", problem, -1, 1.0, 0.25)
        for call in calls:
            host(call[0], problem, *call[1:])
        scenes.hold(host, problem, [0, 1, 2, 3], [[1.0, 0.0]])
        scenes.hold(host, problem, [0, 1], [[0.0, 1.0]])
        return problem

    def pulled(*calls):
        problem = block(*calls)
        scenes.drive(host, problem, [2, 3], [0.0, 1.0], scenes.ramp(host, problem), [1.0, 1.0])
        solver = host("solver_create", problem, 1.0, Out())
        return value(host, solver, "reaction:load")

    strain, stress = 0.75 / (1.25 * 0.5), 1.0 / (1.0 - 0.0625)
    see.near("plane strain by default", pulled(), strain, "F L")
    see.near("plane stress", pulled(("problem_set_plane", "plane-stress")), stress, "F L")
    see.near("plane strain again", pulled(("problem_set_plane", "plane-stress"), ("problem_set_plane", "plane-strain")),
             strain, "F L")
    see.near("the second material", pulled(("problem_set_elastic", 0, 2.0, 0.25)), 2 * strain, "F L")
    plain = block()
    starts, columns, values = host("problem_body_matrix", plain, 0, None, None, Out(9), Out(64), Out(64))[2:]
    twice = [[factor * k for k in values] for factor in (5.0, 3.0)]
    see.near("the second stiffness", pulled(*[("problem_set_stiffness", 4, [0, 1, 2, 3], None, starts, columns, own, -1,
                                               None, 0) for own in twice]), 3 * strain, "F L")
    problem = block()
    push, warm = scenes.ramp(host, problem, "push"), scenes.ramp(host, problem, "warm")
    for force in (0.5, 1.0):
        host("problem_add_forces", problem, push, 2, [2, 3], [0.0, force, 0.0, force], 0)
    for yy in (0.1, 0.3):
        host("problem_add_eigenstrain", problem, warm, 0, [0.0, yy, 0.0, 0.0, 0.0, 0.0])
    see.near("forces", host("problem_forces", problem, push, 8, Out(8))[5::2], [1.5, 1.5], "F")
    # With the sides held, eps_yy is free: that of the eigenstrain, and of the force 3 over C_yyyy.
    solver = host("solver_create", problem, 1.0, Out())
    see.near("displacement", [u[1] for u in field(host, solver, "displacement")[2:]], [0.4 + 3.0 / strain] * 2, "L")
    for key, whole in (("threads", 1.5), ("path_step", 0.25)):
        see.equal(f"status of {key} = {whole}", host.status("problem_set_number", plain, key, whole),
                  ARGUMENT if key == "threads" else OK)
    for index in range(host("option_count")):
        key, kind = host("option_info", index, Out(), Out(), None, None, None, None)[:2]
        if kind == "integer":
            lower, upper = host("option_bounds", index, Out(), Out(), None, None)[:2]
            see.that(f"{key} is whole", host.status("problem_set_number", plain, key,
                                                    lower + 0.5 if math.isfinite(lower) else upper - 0.5) == ARGUMENT)


@row("stiffness of one of two bodies")
def one_of_two(host, see):
    """Two blocks, stiffened together by 5, and then the second alone by 3: the first keeps its 5."""
    mesh = host("mesh_create_layers", host.context, 2, [1.0], [1], 2, [1.0, 1.0], [1, 1], TYPES["quad4"], Out())
    problem = host("problem_create", host.context, mesh, Out())
    host("problem_set_elastic", problem, -1, 1.0, 0.25)
    starts, columns, values = host("problem_body_matrix", problem, 0, None, None, Out(9), Out(64), Out(64))[2:]
    count = starts[8]
    both = (starts + [count + n for n in starts[1:]], columns[:count] + [8 + c for c in columns[:count]],
            [5.0 * k for k in values[:count]] * 2)
    host("problem_set_stiffness", problem, 8, list(range(8)), None, *both, -1, None, 0)
    host("problem_set_stiffness", problem, 4, [4, 5, 6, 7], None, starts, columns, [3.0 * k for k in values], -1, None,
         0)
    loads = []
    for body, name in enumerate(("lower", "upper")):
        low, high = ([4 * body + n for n in pair] for pair in ((0, 1), (2, 3)))
        scenes.hold(host, problem, low + high, [[1.0, 0.0]])
        scenes.hold(host, problem, low, [[0.0, 1.0]])
        loads.append(scenes.ramp(host, problem, name))
        scenes.drive(host, problem, high, [0.0, 1.0], loads[body], [1.0, 1.0])
    solver = host("solver_create", problem, 1.0, Out())
    strain = 0.75 / (1.25 * 0.5)
    see.near("reactions", [value(host, solver, f"reaction:{name}") for name in ("lower", "upper")],
             [5 * strain, 3 * strain], "F L")
    # Cells and material still give the stresses.
    see.near("stress across the bodies", [s[1] for s in field(host, solver, "stress")], [strain] * 2, "F/L2")


@row("adhesion never heals", tells=["law_respond adhesion", "law_respond traction"])
def no_healing(host, see):
    """A jump that has damaged nothing new keeps the old adhesion, and the traction is that of what is left. A criterion
    that changes takes its exponents back to 2, and of onset and strength the last one counts."""
    def law():
        return scenes.bilinear(host, (10.0, 10.0), (0.05, 0.1), (0.6, 1.2))

    own = law()
    adhesion, traction = host("law_respond", own, 2, 2, [0.01, 0.0, 0.05, 0.0], [0.0, 0.0], [0.5, 0.25], Out(2), Out(4))
    see.near("adhesion", adhesion, [0.5, 0.25])
    see.near("traction", traction, [0.05, 0.0, 0.125, 0.0], "F/L2")
    host("law_set_text", own, "criterion", "power")
    quadratic = host("law_toughness", own, 1, [0.5], Out(1), Out(1))
    host("law_set", own, "toughness_exponent", 1.0)
    host("law_set", own, "onset_exponent", 1.0)
    linear = host("law_toughness", own, 1, [0.5], Out(1), Out(1))
    host("law_set_text", own, "criterion", "benzeggagh-kenane")
    host("law_set_text", own, "criterion", "power")
    see.near("exponents after a change of the criterion", host("law_toughness", own, 1, [0.5], Out(1), Out(1)), quadratic,
             "F/L")
    see.differ("exponents 1 and 2", linear, quadratic)
    host("law_set", own, "normal_strength", 2.0)
    see.near("onset of a strength", host("law_toughness", own, 1, [0.0], Out(1), None)[0], 0.2, "F/L")
    host("law_set", own, "normal_onset", 0.07)
    see.near("onset that was set last", host("law_toughness", own, 1, [0.0], Out(1), None)[0], 0.07, "F/L")


@row("interfaces that are there already", tells=["mesh_node_bodies bodies", "mesh_find_nodes nodes"])
def there_already(host, see):
    """Labels of bodies that are no indices; a closed box has its corners; no two bodies are joined twice."""
    nodes = [0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 1.0, 1.0, 2.0, 0.0, 2.0]
    mesh = host("mesh_create", host.context, 2, 6, nodes, Out())
    host("mesh_add_conforming_cells", mesh, TYPES["quad4"], 2, [0, 1, 2, 3, 3, 2, 4, 5], [7, 3], 0)
    see.equal("labels", host("mesh_node_bodies", mesh, 8, Out(8)), [7, 7, 7, 7, 3, 3, 3, 3])
    see.equal("nodes at a corner", host("mesh_find_nodes", mesh, 7, [1.0, 1.0], [5.0, 5.0], 1, Out(1), Out())[0], [2])
    see.equal("interfaces", [host("mesh_add_all_interfaces", mesh, 0.0, Out()) for _ in range(2)], [1, 0])
