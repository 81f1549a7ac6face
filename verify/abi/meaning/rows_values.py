# SPDX-License-Identifier: BSD-3-Clause
"""Values by key, and what the callbacks of a context are told."""
import ctypes
import math

import forms
import keys
import scenes
from host import Out
from scenes import TYPES, value
from table import row

# Rounding, or effort, which any version may change.
NO_MEASURE = keys.ROUNDING | {
    "field_recoveries", "linear_iterations", "am_iterations", "displacement_solves", "contact_iterations",
    "contact_iterations_first", "contact_iterations_max", "contact_fallbacks", "debond_moves"}


@row("values of a bar")
def bar_values(host, see):
    """A bar that softens, by hand: bulk 60, and the law falls from a traction of 2 at 0.02 to 0 at 0.1."""
    bulk, k, onset, toughness, opening = 60.0, 100.0, 0.02, 0.1, 0.07
    law = scenes.bilinear(host, (k, k), (onset, onset), (toughness, toughness))
    bar = scenes.Bar(host, law, bulk=bulk, options=[("damage_tolerance", 1e-12)])
    bar.step(opening)
    jump = (bulk * opening - 2.5) / (bulk - 25.0)
    zeta, pull = 25.0 * (0.1 - jump) / (k * jump), bulk * (opening - jump)
    stored, held = 0.5 * bulk * (opening - jump) ** 2, 0.5 * zeta * k * jump * jump
    dissipated = forms.bilinear_dissipated(onset, toughness, zeta)
    slides = dissipated - toughness * (1 - zeta)
    # From no load on, the jumps that would be held shrink to nothing: the lower bound is the whole energy.
    lower, upper = stored + held, 0.5 * bulk * opening ** 2
    work, sum_ = 0.5 * opening * pull, stored + held + dissipated
    expected = {
        "step": 1, "time": opening, "stored_bulk": stored, "stored_interface": held, "dissipated": dissipated,
        "stored_interface_slides": held + slides, "dissipated_slides": toughness * (1 - zeta), "load_potential": 0,
        "work": work, "lower": lower, "increment": sum_, "upper": upper, "increment_lower": sum_, "defect": sum_ - work,
        "defect_slides": sum_ - work, "contact_pairs": 0, "debonded_length": 0, "front": 1 - zeta, "process_zone": 1,
        "crack_length": 1 - zeta, "crack_length:0": 1 - zeta, "load:pull": opening, "reaction:pull": pull,
        "substeps": 1, "refused_steps": 0, "jumps": 0, "backtracks": 0, "revisions": 0, "revised_from": 1,
        "bulk_factorisations": 1, "released": 0, "search_candidates": 0, "rotation_max": 0,
    }
    for key, number in expected.items():
        see.near(key, bar.value(key), number, rel=1e-9, scale=max(abs(number), 1e-3))


@row("two-sided estimate of a bar")
def estimate(host, see):
    """The bar once more, from one softened state to the next, by hand. Loads in one proportion: with the first a times
    the second, the bounds are (1 - a^2) times the energy after the step and (1/a^2 - 1) times that before."""
    bulk, k, onset, toughness, openings = 60.0, 100.0, 0.02, 0.1, (0.07, 0.072)
    law = scenes.bilinear(host, (k, k), (onset, onset), (toughness, toughness))
    bar = scenes.Bar(host, law, bulk=bulk, options=[("damage_tolerance", 1e-12)])
    energies, pulls, dissipated, before = [], [], [], 0.0
    for opening in openings:
        before = bar.value("work")
        bar.step(opening)
        jump = (bulk * opening - 2.5) / (bulk - 25.0)
        zeta, pull = 25.0 * (0.1 - jump) / (k * jump), bulk * (opening - jump)
        energies.append(0.5 * bulk * (opening - jump) ** 2 + 0.5 * zeta * k * jump * jump)
        pulls.append(pull)
        dissipated.append(forms.bilinear_dissipated(onset, toughness, zeta))
    share = openings[0] / openings[1]
    expected = {"lower": (1 - share ** 2) * energies[1], "upper": (1 / share ** 2 - 1) * energies[0],
                "increment": energies[1] - energies[0] + dissipated[1] - dissipated[0],
                "work": before + 0.5 * sum(pulls) * (openings[1] - openings[0]), "released": 0, "jumps": 0}
    for key, number in expected.items():
        see.near(key, bar.value(key), number, rel=1e-8, scale=max(abs(number), 1e-3))


@row("what a bar releases")
def snap(host, see):
    """A bar that snaps through between two states: the work of its reactions by the trapezoidal rule, less what is
    stored and dissipated, is released, and the step is a jump without having been located."""
    bulk, k, onset, toughness, openings = 8.0, 100.0, 0.02, 0.1, (0.26, 0.3)
    law = scenes.bilinear(host, (k, k), (onset, onset), (toughness, toughness))
    bar = scenes.Bar(host, law, bulk=bulk)
    for opening in openings:
        bar.step(opening)
    pull = openings[0] / (1 / bulk + 1 / k)
    stored, work = 0.5 * pull * openings[0], 0.5 * pull * (openings[1] - openings[0])
    released = stored + work - toughness
    see.near("released", bar.value("released"), released)
    see.near("work", bar.value("work"), stored + work)
    see.near("defect", bar.value("defect"), 0.0, scale=stored)
    see.equal("jumps", [bar.value("jumps"), host("solver_jump_count", bar.solver, Out())], [1, 1])
    jump = host("solver_jump", bar.solver, 0, *[Out() for _ in range(10)])
    see.near("step, instants and energies of the jump", jump[:6], [2, *openings, -stored, toughness, released])


@row("reactions of a jump", tells=["solver_jump_reactions before", "solver_jump_reactions after"])
def reactions_of_a_jump(host, see):
    """A bar whose bottom moves by a quarter of the factor of a second pattern has two reactions, the second a quarter
    of the first. It snaps onto the flat end of a softening curve, which carries the rest."""
    bulk, k, onset, toughness, openings, corner, low = 8.0, 100.0, 0.02, 0.2, (0.2, 0.25), 0.05, 0.3
    law = scenes.bilinear(host, (k, k), (onset, onset), (toughness, toughness), "tabulated")
    host("law_set_table", law, 3, [0.0, corner, 1.0], [1.0, low, 0.0])
    bar = scenes.Bar(host, law, bulk=bulk, base=0.25)
    for opening in openings:
        bar.step(opening)
    first = math.sqrt(2 * onset / k)
    peak = k * first
    longest = (toughness / peak - first / 2) / ((corner * (1 + low) + (1 - corner) * low) / 2)
    # On the flat end the traction is slope (1 - xi) at a jump of first + longest xi, in series with the bodies.
    slope = peak * low / (1 - corner)
    xi = (1.25 * openings[1] - first - slope / bulk) / (longest - slope / bulk)
    before, after = host("solver_jump_reactions", bar.solver, 0, 2, Out(2), Out(2))
    pull, rest = 1.25 * openings[0] / (1 / bulk + 1 / k), slope * (1 - xi)
    see.near("before", before, [pull, 0.25 * pull], "F L")
    see.near("after", after, [rest, 0.25 * rest], "F L", rel=1e-5)


@row("error of a mesh", tells=["solver_field values mesh_error"])
def mesh_error(host, see):
    """A bar of two cells, stretched by a and by b: nodal means leave a hat of stress, of height E (a - b)/2 in the middle.
    And a square that is bent, u = x y, of which incompatible modes would take the shear y."""
    young, a, b = 30.0, 0.01, 0.04
    nodes, cells = scenes.unit_cells(2)
    mesh = host("mesh_create", host.context, 2, 6, [c for p in nodes for c in p], Out())
    host("mesh_add_cells", mesh, TYPES["quad4"], 2, [n for cell in cells for n in cell], None, 0)
    problem = host("problem_create", host.context, mesh, Out())
    host("problem_set_elastic", problem, 0, young, 0.0)
    scenes.fill(host, problem, list(range(6)), lambda n: [[0.0, a, a + b][n % 3], 0.0], scenes.ramp(host, problem))
    solver = host("solver_create", problem, 1.0, Out())
    hat, stored = young * (a - b) ** 2 / 24, 0.5 * young * (a * a + b * b)
    see.near("errors of two cells", scenes.field(host, solver, "mesh_error"), [hat, hat], "F L")
    for key, share in ("mesh_error", 2 * hat / stored), ("mesh_error_fronts", 0.0), ("mesh_excess", 0.0):
        see.near(f"{key} of two cells", value(host, solver, key), share, scale=1.0)
    for formulation, excess in ("standard", 0.5), ("incompatible", 0.0):
        mesh = host("mesh_create", host.context, 2, 4, [-0.5, -0.5, 0.5, -0.5, 0.5, 0.5, -0.5, 0.5], Out())
        host("mesh_add_cells", mesh, TYPES["quad4"], 1, [0, 1, 2, 3], None, 0)
        problem = host("problem_create", host.context, mesh, Out())
        host("problem_set_elastic", problem, 0, 24.0, 0.0)
        host("problem_set_formulation", problem, 0, formulation)
        scenes.fill(host, problem, [0, 1, 2, 3], lambda n: [0.25 - 0.5 * (n % 2), 0.0], scenes.ramp(host, problem))
        solver = host("solver_create", problem, 1.0, Out())
        see.near(f"error of a square, {formulation}", scenes.field(host, solver, "mesh_error"), [excess], "F L", scale=1.0)
        for key in ("mesh_error", "mesh_excess"):
            see.near(f"{key} of a square, {formulation}", value(host, solver, key), excess / (1.0 + excess), scale=1.0)


@row("error at a front")
def error_at_a_front(host, see):
    """Two beams that are peeled apart, of 24 columns of cells: the errors of all cells are those at the front and those
    away from it, and none of the former is farther than three columns from the front."""
    columns, notch = 24, 12
    mesh = host("mesh_create_layers", host.context, 2, [12.0], [columns], 2, [0.5, 0.5], [1, 1], TYPES["quad4"], Out())
    host("mesh_add_interface", mesh, 0, 1, 0.0, Out())
    problem = host("problem_create", host.context, mesh, Out())
    host("problem_set_elastic", problem, -1, 1e5, 0.3)
    host("problem_set_law", problem, 0, scenes.strong(host, 1e4, 1e4))
    host("problem_set_adhesion", problem, 0, notch, list(range(notch)), [0.0] * notch, 0)
    load, row_of = scenes.ramp(host, problem), columns + 1
    scenes.hold(host, problem, [row_of - 1, 4 * row_of - 1], [[1.0, 0.0], [0.0, 1.0]])
    scenes.drive(host, problem, [0, 3 * row_of], [0.0, 1.0], load, [-0.1, 0.1])
    solver = host("solver_create", problem, 1.0, Out())
    errors = [e[0] for e in scenes.field(host, solver, "mesh_error")]
    stored, away, fronts = (value(host, solver, key) for key in ("stored_bulk", "mesh_error", "mesh_error_fronts"))
    see.near("error of all cells", (away + fronts) * stored, sum(errors), "F L")
    near = sum(e for c, e in enumerate(errors) if abs(c % columns + 0.5 - notch) < 4)
    see.that(f"the error at the front is of cells there: {fronts * stored}, of {near}",
             0.1 * near < fronts * stored <= near * (1 + 1e-9))
    see.that(f"there is error elsewhere: {away}", away > 1e-6)


@row("values and fields of an analysis")
def analyse(host, see):
    """For the baseline alone: values and fields of two beams that are peeled apart, in the plane and in space."""
    for d in (2, 3):
        mesh = host("mesh_create_layers", host.context, d, [4.0] + [1.0] * (d - 2), [8] + [1] * (d - 2), 2, [0.5, 0.75],
                    [1, 1], TYPES["quad4" if d == 2 else "hex8"], Out())
        host("mesh_add_interface", mesh, 0, 1, 0.0, Out())
        problem = host("problem_create", host.context, mesh, Out())
        host("problem_set_elastic", problem, -1, 1e5, 0.3)
        host("problem_set_law", problem, 0, scenes.bilinear(host, (1e4, 8e3), (0.1, 0.2), (1.0, 1.7)))
        load = scenes.ramp(host, problem)
        count = host("mesh_size", mesh, None, Out(), None, None, None)[1]
        points = host("mesh_nodes", mesh, d * count, Out(d * count))
        place = [points[d * n:d * n + d] for n in range(count)]
        scenes.give(host, problem, "damage_tolerance", 1e-12)
        scenes.give(host, problem, "mixity_rule", "frozen")
        scenes.give(host, problem, "kinematics", "linear")
        scenes.hold(host, problem, [n for n in range(count) if place[n][0] == 4.0],
                    [scenes.axis(d, k) for k in range(d)])
        up, free = scenes.axis(d, d - 1), [n for n in range(count) if place[n][0] == 0.0]
        scenes.hold(host, problem, [n for n in free if place[n][-1] == 0.0], [up])
        top = [n for n in free if place[n][-1] == 1.25]
        scenes.drive(host, problem, top, up, load, [0.3] * len(top))
        solver = host("solver_create", problem, 0.0, Out())
        for time in (0.4, 0.7, 1.0):
            host("solver_advance", solver, time)
            host("solver_commit", solver)
        for index in range(host("solver_value_count", solver, Out())):
            key = host("solver_value_name", solver, index)
            if key not in NO_MEASURE:
                see.recorded(f"{key} in {d}D", value(host, solver, key), "1")
        for key in keys.fields_of(host.header):
            see.recorded(f"field {key} in {d}D", scenes.field(host, solver, key)[:6], "1")


@row("callbacks of a context", tells=["delam_log_callback", "delam_progress_callback"])
def callbacks(host, see):
    """Levels of the log: 0 an error, 1 a warning, about a cell that rotates by half. What the progress returns: 0 goes
    on, another number stops the step and leaves no step pending."""
    levels, stages, stop = [], [], [0]

    def log(level, text, _user):
        levels.append((level, bool(text)))

    def progress(stage, done, total, user):
        stages.append((stage, done >= 0 and total >= 0, user))
        return stop[0]

    told = ctypes.CFUNCTYPE(None, ctypes.c_int32, ctypes.c_char_p, ctypes.c_void_p)(log)
    asked = ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_char_p, ctypes.c_int64, ctypes.c_int64, ctypes.c_void_p)(progress)
    host.kept += [told, asked]
    host("context_set_log", host.context, told, None)
    mesh = host("mesh_create_layers", host.context, 2, [1.0], [1], 1, [1.0], [1], TYPES["quad4"], Out())
    problem = host("problem_create", host.context, mesh, Out())
    see.equal("status without a material", host.status("problem_check", problem), -4)
    see.equal("level of an error", levels, [0, 1])
    host("problem_set_elastic", problem, 0, 1.0, 0.0)
    scenes.fill(host, problem, [0, 1, 2, 3], lambda n: [[0, 0], [0, 0.5], [-0.5, 0], [-0.5, 0.5]][n],
                scenes.ramp(host, problem))
    solver = host("solver_create", problem, 0.0, Out())
    del levels[:]
    host("solver_advance", solver, 1.0)
    see.near("rotation_max", value(host, solver, "rotation_max"), 0.5, "rad")
    host("solver_rollback", solver)
    see.that(f"a rotation by 1/2 is a warning: {levels}", (1, True) in levels and (0, True) not in levels)
    host("context_set_progress", host.context, asked, 17)
    see.equal("status of a step that goes on", host.status("solver_advance", solver, 1.0), 0)
    see.that("stages have a name, work is counted, user is passed on",
             bool(stages) and all(stage and counted and user == 17 for stage, counted, user in stages))
    host("solver_rollback", solver)
    stop[0] = 1
    see.equal("status of a step that is stopped", host.status("solver_advance", solver, 1.0), 2)
    see.equal("pending", host("solver_pending", solver, Out()), 0)
    host("context_set_progress", host.context, None, None)
    host("context_set_log", host.context, None, None)
