# SPDX-License-Identifier: BSD-3-Clause
"""The default of each option, seen in a result. Every row computes a scene with the option left alone, with the default
of this table set, and with neighbours of it: the first two agree, and each neighbour gives something else. What the
library says about its own options is never read. Scenes that leave an option alone have the same hash as those in which
its default is set; hash_of_defaults compares that too, for numbers between the neighbours of a row."""
import math

import forms
import scenes
from host import Out
from scenes import Bar, TYPES, field, value
from table import row

# key -> default. A new option needs a row of its own.
DEFAULTS = {
    "solution": "local", "backtracking": "auto", "backtracking_limit": 100, "backtracking_depth": 1000,
    "search_limit": 100000, "search_tolerance": 1e-2, "step_control": "auto", "step_tolerance": 1e-2,
    "mixity_step_tolerance": 0, "smallest_step": 1e-4, "jump_tolerance": 0, "jump_size": 0.5, "damage_tolerance": 1e-5,
    "minimisation_limit": 5000, "backtracking_tolerance": 1e-3, "minimisation": "auto", "reduction": "auto",
    "contact": "auto", "mixity": "auto", "mixity_rule": "converged", "path_step": 0.15, "accuracy": 3e-3,
    "contact_limit": 200, "kinematics": "auto",
    "subdomains": 0, "gluing": "orthonormal", "preconditioner": "series", "scaling": "stiffness",
    "linear_tolerance": 1e-13, "linear_limit": 2000, "threads": 1, "memory_limit": 0,
}
OUTSIDE_THE_HASH = ("threads", "memory_limit")


def observe(see, key, run, others, expected=None, unit="-", rel=1e-9):
    """run(options) -> numbers, options: [(key, value)]. expected: of the default, from elsewhere; None: the numbers are
    an effort, which any version may change."""
    found = run([])
    if expected is None:
        pass
    elif unit == "-":
        see.equal("by default", found, expected)
    else:
        see.near("by default", found, expected, unit, rel)
    given = run([(key, DEFAULTS[key])])
    if given != found:
        see.equal(f"{key} left alone, against {DEFAULTS[key]}", found, given)
    for other in others:
        see.differ(f"{key} left alone and {key} = {other}", found, run([(key, other)]))


@row("hash of the defaults")
def hash_of_defaults(host, see):
    mesh = host("mesh_create_layers", host.context, 2, [1.0], [1], 1, [1.0], [1], TYPES["quad4"], Out())

    def hashed(options):
        problem = host("problem_create", host.context, mesh, Out())
        for key, setting in options:
            scenes.give(host, problem, key, setting)
        return host("problem_hash", problem, Out(17))

    untouched = hashed([])
    for key, default in DEFAULTS.items():
        if not known(host, key):
            continue
        see.that(f"{key} = {default} is another scene than {key} left alone", hashed([(key, default)]) == untouched)
        other = {"local": "energetic", "fixed": "adaptive", "converged": "frozen", "orthonormal": "redundant",
                 "series": "none", "stiffness": "multiplicity"}.get(default, "always")
        if default == "auto" and key in ("backtracking", "minimisation", "reduction", "step_control", "kinematics"):
            other = {"backtracking": "on", "minimisation": "alternate", "reduction": "feti",
                     "step_control": "adaptive", "kinematics": "corotational"}[key]
        near = other if isinstance(default, str) else default + 1 if isinstance(default, int) and key not in (
            "jump_tolerance", "mixity_step_tolerance") else 1.001 * default if default else 1e-9
        if key not in OUTSIDE_THE_HASH:
            see.that(f"{key} = {near} is the same scene as {key} left alone", hashed([(key, near)]) != untouched)


def known(host, key):
    return key in {host("option_info", k, Out(), *[None] * 5)[0] for k in range(host("option_count"))}


# ---- the minimisation of a bar that softens ----
def alternation(bulk, stiffness, onset, toughness, opening, tolerance, limit):
    """Plain alternate minimisation of a Bar, by hand: (number of iterations, last change, adhesion)."""
    zeta = 1.0
    for count in range(1, limit + 1):
        jump = opening * bulk / (bulk + zeta * stiffness)
        driving = 0.5 * stiffness * jump * jump
        new = min(1.0, forms.bilinear(onset, toughness, driving))
        # Of the traction, relative to its peak.
        change, zeta = abs(new - zeta) * math.sqrt(max(1.0, driving / onset)), new
        if change <= tolerance:
            return count, change, zeta
    return limit, change, zeta


SOFT = dict(stiffness=100.0, onset=0.02, toughness=0.1)  # softens with 25 per jump, from 0.02 to 0.1


def soft_bar(host, bulk, opening, options):
    law = scenes.bilinear(host, (100.0, 100.0), (0.02, 0.02), (0.1, 0.1))
    bar = Bar(host, law, bulk=bulk, values=(0.0, opening), options=options)
    return bar, bar.step(1.0)


@row("damage_tolerance", options=["damage_tolerance"])
def damage_tolerance(host, see):
    """The number of alternations, each of which reduces the change by 2 %, against the same iteration by hand; the step
    is not followed in parts."""
    def run(options):
        bar, status = soft_bar(host, 26.0, 0.0985, [("minimisation", "alternate"), ("mixity_rule", "frozen"), *options])
        return [status, int(bar.value("am_iterations"))]

    observe(see, "damage_tolerance", run, [0.9e-5, 1.1e-5], [0, alternation(26.0, opening=0.0985, tolerance=1e-5,
                                                                            limit=5000, **SOFT)[0]])
    bar, status = soft_bar(host, 60.0, 0.08, [("minimisation", "alternate"), ("damage_tolerance", 0)])
    see.equal("damage_tolerance 0: status", status, 0)
    see.equal("damage_tolerance 0: change of the last iteration", bar.value("damage_change"), 0.0)


@row("minimisation_limit", options=["minimisation_limit"])
def minimisation_limit(host, see):
    """An iteration that needs more than 5000: it ends there."""
    def run(options):
        bar, status = soft_bar(host, 25.012, 0.0999808, [("minimisation", "alternate"), *options])
        return [status, int(bar.value("am_iterations"))]

    see.that("it takes longer", alternation(25.012, opening=0.0999808, tolerance=1e-5, limit=5100, **SOFT)[1] > 1e-5)
    observe(see, "minimisation_limit", run, [4999, 5001], [1, 5000])


@row("minimisation", options=["minimisation"])
def minimisation(host, see):
    """Alternation takes hundreds of iterations, Newton's method a few; Newton's solves are none with alternation."""
    def run(options):
        bar, status = soft_bar(host, 26.0, 0.0985, options)
        return [status, int(bar.value("am_iterations") < 20), int(bar.value("newton_solves") > 0)]

    observe(see, "minimisation", run, ["alternate"], [0, 1, 1])
    see.equal("minimisation = accelerated", run([("minimisation", "accelerated")]), [0, 1, 1])


@row("kinematics", options=["kinematics"])
def kinematics(host, see):
    """A square whose lower edge turns by 0.5 rad. With linear strains the edge shortens by s = 1 - cos(0.5), by an axial
    strain a and a bending b of the square, a + b = s, with the least energy 1/2 a^2 + 1/6 b^2 = s^2/8. A square that may
    turn stores nothing. One whose upper edge moves by g = 0.01 sideways stores 1/4 g^2 with small rotations, and
    differs by its square with large ones."""
    shortening = 1.0 - math.cos(0.5)
    sheared = 0.01

    def run(options):
        return [max(turned(options), 1e-20), of_shear(options)]

    def of_shear(options):
        mesh = host("mesh_create_layers", host.context, 2, [1.0], [1], 1, [1.0], [1], TYPES["quad4"], Out())
        problem = host("problem_create", host.context, mesh, Out())
        host("problem_set_elastic", problem, -1, 1.0, 0.0)
        for key, setting in options:
            scenes.give(host, problem, key, setting)
        scenes.hold(host, problem, [0, 1], [[1.0, 0.0], [0.0, 1.0]])
        scenes.hold(host, problem, [2, 3], [[0.0, 1.0]])
        scenes.drive(host, problem, [2, 3], [1.0, 0.0], scenes.ramp(host, problem, "sideways", (0.0, 1.0), (0.0, sheared)),
                     [1.0, 1.0])
        solver = host("solver_create", problem, 0.0, Out())
        host("solver_advance", solver, 1.0)
        return value(host, solver, "stored_bulk")

    def turned(options):
        nodes, cells = scenes.unit_cells(1)
        mesh = host("mesh_create", host.context, 2, len(nodes), [x for node in nodes for x in node], Out())
        host("mesh_add_cells", mesh, TYPES["quad4"], 1, cells[0], [0], 0)
        problem = host("problem_create", host.context, mesh, Out())
        host("problem_set_elastic", problem, -1, 1.0, 0.0)
        for key, setting in options:
            scenes.give(host, problem, key, setting)
        scenes.hold(host, problem, [0], [[1.0, 0.0], [0.0, 1.0]])
        scenes.drive(host, problem, [1], [1.0, 0.0], scenes.ramp(host, problem, "back", (0.0, 1.0), (0.0, -shortening)),
                     [1.0])
        scenes.drive(host, problem, [1], [0.0, 1.0],
                     scenes.ramp(host, problem, "up", (0.0, 1.0), (0.0, math.sin(0.5))), [1.0])
        solver = host("solver_create", problem, 0.0, Out())
        host("solver_advance", solver, 1.0)
        return value(host, solver, "stored_bulk")

    observe(see, "kinematics", run, ["corotational", "linear"], [1e-20, 0.25 * sheared ** 2], "J/m", 1e-9)
    see.near("kinematics = linear", run([("kinematics", "linear")]), [shortening ** 2 / 8.0, 0.25 * sheared ** 2], "J/m", 1e-9)


# ---- steps that are divided ----
@row("step_control", options=["step_control", "smallest_step"])
def step_control(host, see):
    """A bar that snaps through. Fixed steps are not divided. Adaptive ones are halved until a part is shorter than the
    smallest step: 2^-14 of the whole is the first such. By default, steps follow their load where there is a path to
    follow: they end at the onset first; and energetic ones are whole."""
    def run(options):
        bar, _ = soft_bar(host, 8.0, 0.3, [("step_control", None), *options])
        return [int(bar.value("substeps")), int(bar.value("refused_steps"))]

    see.that("steps follow their load by default", run([])[0] > 1 and run([]) == run([("step_control", "load")]))
    see.equal("substeps of an energetic step", run([("solution", "energetic")]), [1, 0])
    see.equal("substeps of a fixed step", run([("step_control", "fixed")]), [1, 0])
    observe(see, "step_control", run, ["adaptive", "fixed"])
    adaptive = lambda options: run([("step_control", "adaptive"), ("step_tolerance", 1e-9), *options])
    see.that("smallest_step left alone is smallest_step = 1e-4", adaptive([]) == adaptive([("smallest_step", 1e-4)]))
    for other in (1.3e-4, 0.6e-4):
        see.differ(f"smallest_step left alone and smallest_step = {other}", adaptive([]),
                   adaptive([("smallest_step", other)]))


def last_step(host, length, options):
    """A stable bar that softens from an opening of 0.07, and one step of this length: the width of the two-sided
    estimate relative to the larger of energy and work, and the substeps."""
    bulk, start = 60.0, 0.07
    jump = (bulk * start - 2.5) / (bulk - 25.0)
    law = scenes.bilinear(host, (100.0, 100.0), (0.02, 0.02), (0.1, 0.1))
    bar = Bar(host, law, bulk=bulk, options=options)
    host("solver_equilibrate", bar.solver, start, [forms.bilinear(0.02, 0.1, 50.0 * jump * jump)] * 2)
    host("solver_commit", bar.solver)
    bar.step(start + length)
    energy = bar.value("stored_bulk") + bar.value("stored_interface") + bar.value("load_potential")
    return ((bar.value("upper") - bar.value("lower")) / max(abs(energy), abs(bar.value("work"))),
            int(bar.value("substeps")))


def straddle(measure, level, low, high):
    """Two arguments at which `measure` is just below and just above the level: within half a per cent."""
    for _ in range(60):
        middle = 0.5 * (low + high)
        if measure(middle) > level:
            high = middle
        else:
            low = middle
        if measure(high) - measure(low) < 0.005 * level:
            break
    return low, high


@row("step_tolerance", options=["step_tolerance"])
def step_tolerance(host, see):
    """Adaptive steps whose estimate is just narrower and just wider than a hundredth."""
    lengths = straddle(lambda length: last_step(host, length, [])[0], 1e-2, 1e-5, 1e-2)

    def run(options):
        return [last_step(host, length, [("step_control", "adaptive"), *options])[1] for length in lengths]

    found = run([])
    see.near("width at which steps are divided", [last_step(host, length, [])[0] for length in lengths], [1e-2] * 2,
             rel=6e-3)
    see.equal("whether the step just below and just above is divided", [int(n > 1) for n in found], [0, 1])
    observe(see, "step_tolerance", run, [0.98e-2, 1.02e-2])


@row("jump_tolerance", options=["jump_tolerance"],
     tells=["solver_jump_count count"] + [f"solver_jump {p}" for p in (
         "step", "before", "time", "stored", "dissipated", "released", "debonded", "interface_index", "first_pair",
         "last_pair")])
def jump_tolerance(host, see):
    """A bar that snaps through within a step: its jump is located only when it is asked for. Its energies by hand."""
    def run(options):
        bar, _ = soft_bar(host, 8.0, 0.3, options)
        return [host("solver_jump_count", bar.solver, Out())]

    observe(see, "jump_tolerance", run, [1e-9, 1e-2], [0])
    bar, _ = soft_bar(host, 8.0, 0.3, [("jump_tolerance", 1e-6)])
    step, before, time, stored, dissipated, released, debonded, interface, first, last = host(
        "solver_jump", bar.solver, 0, *[Out() for _ in range(10)])
    see.equal("step, interface, first and last pair", [step, interface, first, last], [1, 0, 0, 1])
    snap = 0.27 / 0.3  # the jump of the onset, 0.02, has the traction 2
    see.near("instant", [before, time], [snap, snap], "t", rel=2e-5)
    see.that("the instant is located to a millionth of the step", 0 < time - before <= 1e-6)
    energy = 0.5 * 2.0 * 0.27
    see.near("stored, dissipated, released", [stored, dissipated, released], [-energy, 0.1, energy - 0.1], "F L",
             rel=3e-5)
    see.near("debonded", debonded, 1.0, "L", rel=1e-5)


def two_bars(host, narrow, options):
    """Two bars of different width beside each other, of which the narrow one is pulled until it snaps."""
    xs = [0.0, narrow, 5.0, 6.0]
    nodes = [(x, y) for y in (0.0, 0.5) for x in xs] + [(x, y) for y in (0.5, 1.0) for x in xs]
    mesh = host("mesh_create", host.context, 2, 16, [c for n in nodes for c in n], Out())
    cells = [[first + 8 * layer + n for n in (0, 1, 5, 4)] for layer in (0, 1) for first in (0, 2)]
    host("mesh_add_cells", mesh, TYPES["quad4"], 4, [n for cell in cells for n in cell], [0, 0, 1, 1], 0)
    host("mesh_add_interface", mesh, 0, 1, 0.0, Out())
    problem = host("problem_create", host.context, mesh, Out())
    host("problem_set_elastic", problem, -1, 8.0, 0.0)
    host("problem_set_law", problem, 0, scenes.bilinear(host, (100.0, 100.0), (0.02, 0.02), (0.1, 0.1)))
    pull = scenes.ramp(host, problem, "pull")
    scenes.hold(host, problem, list(range(16)), [[1.0, 0.0]])
    scenes.hold(host, problem, [0, 1, 2, 3, 14, 15], [[0.0, 1.0]])
    scenes.drive(host, problem, [12, 13], [0.0, 1.0], pull, [0.3, 0.3])
    for left in (4, 8):
        host("problem_add_equation", problem, 2, [left, left + 1], [0.0, 1.0, 0.0, -1.0], 0, None, None, 0)
    for key, setting in options:
        scenes.give(host, problem, key, setting)
    solver = host("solver_create", problem, 0.0, Out())
    host("solver_advance", solver, 1.0)
    return host("solver_jump_count", solver, Out())


@row("jump_size", options=["jump_size"])
def jump_size(host, see):
    """A bar of width a beside one of width 1 snaps: 4 a / (1 + a) mean weights of a pair, 1/2 at a = 1/7."""
    widths = [1 / 7.07, 1 / 6.93]

    def run(options):
        return [two_bars(host, width, [("jump_tolerance", 1e-3), *options]) for width in widths]

    observe(see, "jump_size", run, [0.49, 0.51], [0, 1])


@row("mixity_step_tolerance", options=["mixity_step_tolerance"])
def mixity_step_tolerance(host, see):
    """A stack whose mode turns within a step: the step is divided only when it is asked for."""
    def run(options):
        problem, solver = turning(host, [("step_control", "fixed"), *options])
        del problem
        host("solver_advance", solver, 2.0)
        return [int(value(host, solver, "substeps")), int(value(host, solver, "mixity_error") > 0)]

    observe(see, "mixity_step_tolerance", run, [1e-3], [1, 1])


def turning(host, options, toughness=(0.1, 0.6)):
    """Rigid layers, opened first and sheared afterwards; the solver at time 1, where the mode is I."""
    law = scenes.bilinear(host, (100.0, 100.0), (0.02, 0.05), toughness)
    mesh = host("mesh_create_layers", host.context, 2, [1.0], [1], 2, [1.0, 1.0], [1, 1], TYPES["quad4"], Out())
    host("mesh_add_interface", mesh, 0, 1, 0.0, Out())
    problem = host("problem_create", host.context, mesh, Out())
    host("problem_set_elastic", problem, -1, 1e3, 0.25)
    host("problem_set_law", problem, 0, law)
    up = scenes.ramp(host, problem, "up", (0.0, 1.0), (0.0, 0.018))
    across = scenes.ramp(host, problem, "across", (1.0, 2.0), (0.0, 0.05))
    scenes.hold(host, problem, [0, 1, 2, 3], [[1.0, 0.0], [0.0, 1.0]])
    scenes.drive(host, problem, [4, 5, 6, 7], [0.0, 1.0], up, [1.0] * 4)
    scenes.drive(host, problem, [4, 5, 6, 7], [1.0, 0.0], across, [1.0] * 4)
    for key, setting in options:
        scenes.give(host, problem, key, setting)
    solver = host("solver_create", problem, 0.0, Out())
    host("solver_advance", solver, 1.0)
    host("solver_commit", solver)
    return problem, solver


@row("mixity_rule", options=["mixity_rule"], tells=["solver_field values mixity"])
def mixity_rule(host, see):
    """The same scene: the mixity is that of the step's own jumps, and so is the toughness. The frozen mixity is that of
    mode I before the step."""
    def run(options, time=2.0, **law):
        _, solver = turning(host, options, **law)
        host("solver_advance", solver, time)
        return [field(host, solver, "mixity")[0][0], field(host, solver, "adhesion")[0][0]]

    driving = 0.5 * 100.0 * (0.018 ** 2 + 0.05 ** 2)
    tangential = 0.05 ** 2 / (0.018 ** 2 + 0.05 ** 2)
    weak = {"time": 1.3, "toughness": (0.05, 0.06)}  # the variational rule refuses more
    see.differ("mixity_rule left alone and mixity_rule = variational", run([], **weak),
               run([("mixity_rule", "variational")], **weak))
    observe(see, "mixity_rule", run, ["frozen"],
            [tangential, forms.bilinear(forms.toughness(0.02, 0.05, tangential),
                                        forms.toughness(0.1, 0.6, tangential), driving)], "1", rel=1e-5)
    see.near("mixity_rule = frozen", run([("mixity_rule", "frozen")]), [0.0, forms.bilinear(0.02, 0.1, driving)])
    # The first loaded step: that of the elastic solution, whose jumps are not in proportion to those of the damaged one.
    for rule in ("frozen", "converged"):
        solver, elastic = leaning(host, rule)
        mixities = [m[0] for m in field(host, solver, "mixity")]
        if rule == "frozen":
            see.near("mixity of the first step, frozen", mixities, elastic)
        else:
            see.that(f"it is another one with converged: {mixities}, {elastic}",
                     all(abs(m - e) > 1e-3 for m, e in zip(mixities, elastic)))
            see.that(f"the point with more of the second mode still has more: {mixities}, {elastic}",
                     (mixities[0] > mixities[1]) == (elastic[0] > elastic[1]))
    # The increment at the mixities of the step before: what the damage of this step would have dissipated at those.
    solver = turning(host, [("mixity_rule", "frozen")])[1]
    shown = []
    for time in (1.5, 2.0):
        host("solver_advance", solver, time)
        shown.append([field(host, solver, key)[0][0] for key in ("mixity", "adhesion")])
        host("solver_commit", solver)
    (before, old), (now, new) = shown
    spent = [forms.bilinear_dissipated(forms.toughness(0.02, 0.05, b), forms.toughness(0.1, 0.6, b), zeta)
             for b, zeta in ((now, new), (now, old), (before, new), (before, old))]
    see.that(f"the mixity has changed: {before}, {now}", now - before > 0.5)
    see.near("increment - increment_lower", value(host, solver, "increment") - value(host, solver, "increment_lower"),
             spent[0] - spent[1] - spent[2] + spent[3], "F L", rel=1e-8)


def leaning(host, rule):
    """Two soft layers pulled up and across at once: the solver at the end of its first step, and the mixities of its
    elastic solution."""
    springs = (100.0, 30.0)
    mesh = host("mesh_create_layers", host.context, 2, [1.0], [1], 2, [1.0, 1.0], [1, 1], TYPES["quad4"], Out())
    host("mesh_add_interface", mesh, 0, 1, 0.0, Out())
    problem = host("problem_create", host.context, mesh, Out())
    host("problem_set_elastic", problem, -1, 10.0, 0.0)
    host("problem_set_law", problem, 0, scenes.bilinear(host, springs, (0.02, 0.03), (0.2, 0.6)))
    scenes.give(host, problem, "mixity_rule", rule)
    load = scenes.ramp(host, problem)
    scenes.hold(host, problem, [0, 1], [[1.0, 0.0], [0.0, 1.0]])
    for direction, amount in (([0.0, 1.0], 0.75), ([1.0, 0.0], 1.2)):
        scenes.drive(host, problem, [6, 7], direction, load, [amount] * 2)
    solver = host("solver_create", problem, 0.0, Out())
    host("solver_equilibrate", solver, 1.0, [1.0, 1.0])
    parts = [[k * u * u for k, u in zip(springs, jump)] for jump in field(host, solver, "jump")]
    host("solver_rollback", solver)
    host("solver_advance", solver, 1.0)
    return solver, [tangential / (normal + tangential) for normal, tangential in parts]


@row("path_step", options=["path_step", "accuracy"])
def path_step(host, see):
    """Eight pairs, in turn in mode I and II, with every node prescribed: at onset + s (end - onset) of its jump, a pair
    has dissipated the share s of its toughness. Steps from 0.3 to a share just below and just above 0.45: one part, and
    more, each with alternations of its own."""
    columns, ratio = 7, 2.0  # of the jumps in mode II and I
    onset, end = 0.02, 0.1   # jumps of mode I, for the onset 0.02 and the toughness 0.1

    def run(options):
        law = scenes.bilinear(host, (100.0, 100.0), (0.02, 0.02 * ratio ** 2), (0.1, 0.1 * ratio ** 2))
        found = []
        for share in (0.1495, 0.1505):
            mesh = host("mesh_create_layers", host.context, 2, [float(columns)], [columns], 2, [1.0, 1.0], [1, 1],
                        TYPES["quad4"], Out())
            host("mesh_add_interface", mesh, 0, 1, 0.0, Out())
            problem = host("problem_create", host.context, mesh, Out())
            host("problem_set_elastic", problem, -1, 1e3, 0.25)
            host("problem_set_law", problem, 0, law)
            row_of = columns + 1
            scenes.fill(host, problem, list(range(4 * row_of)),
                        lambda n: [0.0, 0.0] if n < 2 * row_of else [[0.0, 1.0], [ratio, 0.0]][n % row_of % 2],
                        scenes.ramp(host, problem))
            for key, setting in [("step_control", "fixed"), *options]:
                scenes.give(host, problem, key, setting)
            solver = host("solver_create", problem, 0.0, Out())
            for total in (0.3, 0.3 + share):
                host("solver_advance", solver, onset + total * (end - onset))
                host("solver_commit", solver)
            found.append(value(host, solver, "am_iterations"))
        return [int(found[1] > found[0])]

    observe(see, "path_step", run, [0.1485, 0.1515], [1])
    observe(see, "accuracy", run, [2.94e-3, 3.06e-3], [1])


@row("mixity", options=["mixity"])
def mixity(host, see):
    """A law with one toughness for all modes, sheared and opened alike: the mixity is left out, and 1/2 if computed."""
    def run(options):
        mesh = host("mesh_create_layers", host.context, 2, [1.0], [1], 2, [1.0, 1.0], [1, 1], TYPES["quad4"], Out())
        host("mesh_add_interface", mesh, 0, 1, 0.0, Out())
        problem = host("problem_create", host.context, mesh, Out())
        host("problem_set_elastic", problem, -1, 1e3, 0.25)
        law = scenes.bilinear(host, (100.0, 100.0), (0.02, 0.02), (0.1, 0.1))
        host("law_set_text", law, "criterion", "power")
        host("law_set", law, "onset_exponent", 1.0)
        host("law_set", law, "toughness_exponent", 1.0)
        host("problem_set_law", problem, 0, law)
        load = scenes.ramp(host, problem)
        scenes.fill(host, problem, list(range(8)), lambda n: [0.01, 0.01] if n > 3 else [0.0, 0.0], load)
        for key, setting in options:
            scenes.give(host, problem, key, setting)
        solver = host("solver_create", problem, 0.0, Out())
        for time in (0.5, 1.0):
            host("solver_advance", solver, time)
            host("solver_commit", solver)
        return [field(host, solver, "mixity")[0][0]]

    observe(see, "mixity", run, ["always"], [0.0], "1")
    see.near("mixity = always", run([("mixity", "always")]), [0.5])
