# SPDX-License-Identifier: BSD-3-Clause
"""The defaults of options of energetic solutions and of returns, as those of rows_options."""
import math

import scenes
from host import Out
from rows_options import observe, straddle
from scenes import Bar, TYPES, value
from table import row


def brittle_bar(host, bulk, stiffness, toughness, openings, options, longest=1.0):
    """The bar at these openings, up to the longest, with a law that breaks at once; the last step is pending."""
    law = scenes.bilinear(host, (stiffness,) * 2, None, (toughness,) * 2, "griffith")
    bar = Bar(host, law, bulk=bulk, options=options, times=(0.0, longest), values=(0.0, longest))
    for opening in openings[:-1]:
        bar.step(opening)
    bar.step(openings[-1], commit=False)
    return bar


@row("solution", options=["solution", "backtracking"])
def solution(host, see):
    """A bar that breaks at once, at an opening of 1, is lower in energy when broken from sqrt(1/(1 + stiffness/bulk))
    on: the local solution stays whole in between, and does not return from the break; the energetic one does neither.
    By default the local solution does not return to earlier steps, and the energetic one does."""
    bulk = stiffness = 2.0
    whole = bulk * stiffness / (bulk + stiffness)
    toughness = 0.5 * stiffness * (whole / stiffness) ** 2  # breaks where the driving energy reaches it
    broken_from = math.sqrt(2 * toughness / whole)
    openings = [0.5, 0.9 * broken_from, 0.5 * (1 + broken_from)]

    def run(options):
        bar = brittle_bar(host, bulk, stiffness, toughness, openings, options)
        return [bar.value("dissipated"), bar.value("reaction:pull")]

    observe(see, "solution", run, ["energetic"], [0.0, whole * openings[-1]], "F L")
    see.near("solution = energetic", run([("solution", "energetic")]), [toughness, 0.0], "F L", scale=1.0)

    def returns(options):
        bar = brittle_bar(host, bulk, stiffness, toughness, [0.5, 0.6, *openings[2:], 1.01], options, 1.01)
        return [int(bar.value("backtracks"))]

    observe(see, "backtracking", returns, ["on"], [0])
    see.equal("backtracking = off", returns([("backtracking", "off")]), [0])
    kept = []
    for options in ([], [("backtracking", "off")], [("solution", "energetic")],
                    [("solution", "energetic"), ("backtracking", "off")]):
        bar = brittle_bar(host, bulk, stiffness, toughness, [0.1, 0.2, 0.3], options)
        kept.append(host.status("solver_look", bar.solver, 0))
    see.equal("status of selecting earlier steps, local, off, energetic, off", kept, [-1, -1, 0, -1])


@row("steps that a return replaces")
def replaced_steps(host, see):
    """The same bar, with a return: what replaces the earlier step is selected while the last one is pending. It is not
    divided, and its jump is not located, which the last step's is without a return."""
    bulk = stiffness = 2.0
    toughness, broken_from = 0.25, math.sqrt(0.5)
    openings = [0.5, 0.9 * broken_from, 0.85, 1.01]
    options = [("jump_tolerance", 1e-6), ("mixity_rule", "frozen")]
    alone = brittle_bar(host, bulk, stiffness, toughness, openings, options, 2.0)
    see.equal("without a return: first step that is replaced, jumps",
              [alone.value("revised_from"), host("solver_jump_count", alone.solver, Out())], [4, 1])
    see.that("the last step is divided", alone.value("substeps") > 1)
    before, time = host("solver_jump", alone.solver, 0, None, *[Out() for _ in range(2)], *[None] * 7)[1:3]
    see.near("the jump is located", [before, time], [1.0, 1.0], "t", rel=1e-6)
    bar = brittle_bar(host, bulk, stiffness, toughness, openings, [("backtracking", "on"), *options], 2.0)
    see.equal("first step that is replaced", bar.value("revised_from"), 3)
    found = host("solver_jump", bar.solver, 0, *[Out() for _ in range(3)], *[None] * 7)[:3]
    see.near("step and instants of the jump", found, [3, 0.9 * broken_from, 0.85])
    seen = []
    for step in (2, 3, 4, -1):
        host("solver_look", bar.solver, step)
        seen += [bar.value(key) for key in ("step", "dissipated", "revisions", "substeps", "jumps")]
    see.near("step, dissipated, revisions, substeps and jumps of steps 2, 3, 4 and the pending one", seen,
             [2, 0, 0, 1, 0, 3, toughness, 1, 1, 1, 4, toughness, 0, 1, 0, 4, toughness, 0, 1, 0])
    host("solver_rollback", bar.solver)
    host("solver_look", bar.solver, 3)
    see.near("dissipated in step 3 after a rollback", bar.value("dissipated"), 0.0, "F L", scale=1.0)


@row("instant of a jump")
def instant(host, see):
    """The same bar, whose steps are followed in parts: the jump has one instant, and its reactions are those of this
    instant, however long the step is in which it lies."""
    toughness, broken_from = 0.25, math.sqrt(0.5)  # the bar has the stiffness 1
    for openings in ([0.5, 0.6, 0.9 * broken_from, 0.85, 1.01], [0.3, 0.95, 1.01], [0.5, 0.99, 1.05]):
        bar = brittle_bar(host, 2.0, 2.0, toughness, openings, [("backtracking", "on")], 2.0)
        see.equal("jumps", host("solver_jump_count", bar.solver, Out()), 1)
        found = host("solver_jump", bar.solver, 0, *[Out() for _ in range(3)], *[None] * 7)[1:3]
        see.near(f"before and time with openings {openings}", found, [broken_from] * 2, "t")
        see.near("reactions", host("solver_jump_reactions", bar.solver, 0, 1, Out(1), Out(1)), [broken_from, 0.0], "F L")


@row("backtracking_limit", options=["backtracking_limit"])
def backtracking_limit(host, see):
    """A bar that is lower when broken from step 121 of 240 on and breaks in the last one: 100 returns, or 119."""
    bulk, stiffness = 1.0, 3.0
    whole = bulk * stiffness / (bulk + stiffness)
    toughness = 0.5 * stiffness * (whole / stiffness) ** 2
    openings = [k / 239.5 for k in range(1, 241)]  # lower when broken from an opening of 1/2 on
    possible = sum(1 for o in openings[:-1] if 0.5 * whole * o * o > toughness * (1 + 1e-2))

    def run(options):
        bar = brittle_bar(host, bulk, stiffness, toughness, openings, [("backtracking", "on"), *options])
        return [int(bar.value("backtracks"))]

    observe(see, "backtracking_limit", run, [99, 101], [100])
    found = run([("backtracking_limit", 1000)])[0]
    see.that(f"{found} returns without a limit, about {possible} by energy", abs(found - possible) <= 3)


@row("backtracking_tolerance", options=["backtracking_tolerance"])
def backtracking_tolerance(host, see):
    """A bar on a soft interface, whose energy at the break is `stiffness`/`bulk` above that of the broken bar:
    stiffnesses at which the lower bound fails by just less and just more than a thousandth of the energy."""
    def excess(stiffness):
        bar = broken(stiffness, [("backtracking", "off")])
        energy = sum(bar.value(key) for key in ("stored_bulk", "stored_interface", "load_potential"))
        return (bar.value("lower") - bar.value("increment")) / max(abs(energy), abs(bar.value("work")))

    def broken(stiffness, options):
        whole = stiffness / (1.0 + stiffness)
        toughness = 0.5 * stiffness * (whole / stiffness) ** 2
        return brittle_bar(host, 1.0, stiffness, toughness, [0.5, 0.999, 0.9999, 1.00001], options)

    ends = straddle(excess, 1e-3, 1e-5, 1e-2)

    def run(options):
        return [int(broken(stiffness, [("backtracking", "on"), *options]).value("backtracks") > 0)
                for stiffness in ends]

    see.near("excess of the lower bound", [excess(s) for s in ends], [1e-3] * 2, rel=6e-3)
    observe(see, "backtracking_tolerance", run, [0.98e-3, 1.02e-3], [0, 1])


@row("backtracking_depth", options=["backtracking_depth"])
def backtracking_depth(host, see):
    """After 1002 steps the first that can be selected is 2."""
    def run(options, steps=1002):
        bar = Bar(host, scenes.strong(host, 1.0, 1.0), options=[("backtracking", "on"), *options])
        for step in range(steps):
            bar.step((step + 1) / steps)
        return [next(k for k in range(steps + 1) if host.status("solver_look", bar.solver, k) == 0)]

    see.equal("first step that is kept", run([]), [2])
    see.equal("first step that is kept with a depth of 3", run([("backtracking_depth", 3)], 7), [4])


def cantilevers(host, opening, options):
    """Two beams on a brittle interface of 60 pairs, opened at their ends: (states compared, advance of the front)."""
    columns, notch = 60, 10
    mesh = host("mesh_create_layers", host.context, 2, [0.25 * columns], [columns], 2, [0.5] * 2, [1] * 2,
                TYPES["quad4"], Out())
    host("mesh_add_interface", mesh, 0, 1, 0.0, Out())
    problem = host("problem_create", host.context, mesh, Out())
    host("problem_set_elastic", problem, -1, 1e3, 0.0)
    host("problem_set_formulation", problem, -1, "incompatible")
    host("problem_set_law", problem, 0, scenes.bilinear(host, (1e4, 1e4), None, (0.05, 0.05), "griffith"))
    host("problem_set_adhesion", problem, 0, notch + 1, list(range(notch + 1)), [0.0] * (notch + 1), 0)
    load, n = scenes.ramp(host, problem), columns + 1
    scenes.hold(host, problem, [n - 1, 2 * n - 1, 3 * n - 1, 4 * n - 1], [[1.0, 0.0], [0.0, 1.0]])
    scenes.drive(host, problem, [0, 3 * n], [0.0, 1.0], load, [-opening, opening])
    for key, setting in [("solution", "energetic"), *options]:
        scenes.give(host, problem, key, setting)
    solver = host("solver_create", problem, 0.0, Out())
    host("solver_advance", solver, 1.0)
    return [int(value(host, solver, "search_candidates")), value(host, solver, "front")]


@row("search_tolerance", options=["search_tolerance"])
def search_tolerance(host, see):
    """The number of states that the search of four openings compares."""
    observe(see, "search_tolerance",
            lambda options: [cantilevers(host, opening, options)[0] for opening in (0.5, 0.8, 1.0, 1.3)],
            [0.5e-2, 2e-2])


@row("search_limit", options=["search_limit"])
def search_limit(host, see):
    """A search compares as many states as it is told to, and all 42 by default. It cannot be seen here where the
    default ends, since 100,000 states take minutes; hash_of_defaults tells 100,000 from any other number."""
    def run(options):
        return [cantilevers(host, 1.0, options)[0]]

    found = run([])
    see.that("search_limit left alone is search_limit = 100000", found == run([("search_limit", 100000)]))
    see.differ("search_limit left alone and search_limit = 20", found, run([("search_limit", 20)]))
