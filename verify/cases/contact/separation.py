# SPDX-License-Identifier: BSD-3-Clause
"""Bodies pulled off each other until nothing holds them, closed again and pulled again.

Crosses of four blocks, one of them pulled away across two interfaces or along both, and strips peeled to their end.
Each scene with every reduction, local and energetic. After each step

- it has converged, its contact set after few changes, its damage after few iterations;
- energies and dissipation are those of the other reductions, and for local strips of plain alternate minimisation;
- an analysis that goes on from a saved state takes the same step.

    separation.py [--whole] [--only WORDS]
"""
import argparse
import logging
import sys

import numpy as np

import delam

REDUCTIONS = ("condensed", "iterated", "feti")
PLAIN = "plain"
# Damage is told apart to 1e-10 of the toughness: what reductions differ by is theirs.
TOLERANCES = {"damage_tolerance": 1e-10, "linear_tolerance": 1e-13}


def block(corner, size, cells):
    """Nodes and quadrilaterals of a rectangle."""
    x, y = (corner[k] + size[k] * np.arange(cells[k] + 1) / cells[k] for k in (0, 1))
    nodes = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1).reshape(-1, 2)
    at = np.arange(nodes.shape[0]).reshape(cells[0] + 1, cells[1] + 1)
    return nodes, np.stack([at[:-1, :-1], at[1:, :-1], at[1:, 1:], at[:-1, 1:]], axis=-1).reshape(-1, 4)


def problem_of(blocks, poisson):
    nodes, cells, bodies = [], [], []
    for body, (points, quads) in enumerate(blocks):
        cells.append(quads + sum(len(n) for n in nodes))
        nodes.append(points)
        bodies.append(np.full(len(quads), body, np.int32))
    mesh = delam.Mesh(np.vstack(nodes))
    mesh.add_cells("quad4", np.vstack(cells), np.concatenate(bodies))
    mesh.add_all_interfaces()
    problem = delam.Problem(mesh, plane="plane-strain")
    problem.options["kinematics"] = "linear"
    for body in range(len(blocks)):
        problem.set_elastic(1000.0, poisson, body)
    strength, stiffness, toughness = 1.0, 1e5, 0.002
    onset = strength ** 2 / (2.0 * stiffness)
    law = delam.Law("piecewise-linear", normal_stiffness=stiffness, tangential_stiffness=stiffness, normal_onset=onset,
                    tangential_onset=onset, normal_toughness=toughness, tangential_toughness=toughness,
                    criterion="benzeggagh-kenane")  # at equal toughnesses the mode does not matter: one solution a step
    for interface in mesh.interfaces:
        problem.set_law(interface, law)
    return problem


# Pulled off, closed, pressed, pulled again.
TIMES = [0.0, 1.0, 2.0, 2.5, 3.5]
FACTORS = [0.0, 1.0, 0.0, -0.02, 0.5]


def cross(cells, way):
    blocks = [block(corner, (1.0, 1.0), (cells, cells)) for corner in [(0, 0), (1, 0), (0, 1), (1, 1)]]
    problem = problem_of(blocks, 0.3)
    bodies = problem.mesh.node_bodies
    for axis in "xy":
        problem.prescribe(np.flatnonzero(bodies == 0), axis)
    pull = problem.add_pattern("pull", TIMES, FACTORS)
    for axis, part in zip("xy", way):
        problem.prescribe(np.flatnonzero(bodies == 3), axis, {pull: 0.05 * part})
    return problem


def strip(cells, offset, poisson):
    blocks = [block((offset, y), (10.0, 1.0), (cells, 2)) for y in (0.0, 1.0)]
    problem = problem_of(blocks, poisson)
    places, bodies = problem.mesh.nodes, problem.mesh.node_bodies
    for axis in "xy":
        problem.prescribe(np.flatnonzero((bodies == 0) & (places[:, 1] == 0.0)), axis)
    corner = np.flatnonzero((places[:, 0] == offset) & (places[:, 1] == 2.0))
    pull = problem.add_pattern("pull", TIMES, FACTORS)
    problem.prescribe(corner, "x")
    problem.prescribe(corner, "y", {pull: 0.5})
    return problem


def scenes(whole):
    for cells in range(1, 13) if whole else (1, 4, 6):
        # Not along the diagonal: a symmetric scene has two solutions, which need not have the same energy.
        yield f"cross {cells}, across", lambda: cross(cells, (1.0, 0.9))
        yield f"cross {cells}, along", lambda: cross(cells, (0.7, -0.72))
    # A pair that has nearly broken holds the front back in a strip of 20 cells without contraction.
    several = [(cells, part) for cells in range(10, 61, 10) for part in range(8)]
    for cells, part in several if whole else [(10, 3), (20, 0)]:
        for poisson in (0.0, 0.3):
            yield f"strip {cells}, {part}/8, nu {poisson}", lambda: strip(cells, part * 0.7071 / 8.0, poisson)


KEYS = ("stored_bulk", "stored_interface", "dissipated", "work", "released")


def analyse(problem, steps):
    """The values of each step, and what is wrong with it."""
    solver, rows, wrong = delam.Solver(problem, not_converged="raise"), [], []
    resumed = delam.Solver(problem)
    for time in steps:
        before = solver.save()
        try:
            solver.advance(time)
        except delam.DelamError as error:
            wrong.append(f"time {time:g}: {error}")
            return rows, wrong
        values = dict(solver.values)
        solver.commit()
        rows.append(values)
        resumed.load(before)
        resumed.advance(time)
        again = dict(resumed.values)
        for key in KEYS:
            if again[key] != values[key]:
                wrong.append(f"time {time:g}: {key} {values[key]!r}, after a saved state {again[key]!r}")
        resumed.commit()
    return rows, wrong


def compare(name, builder, solution, steps):
    wrong, by = [], {}
    ways = {reduction: {"reduction": reduction} for reduction in REDUCTIONS}
    # A cross breaks as a whole within two steps: from seven cells on, plain steps come by other states on the way.
    if solution == "local" and name.startswith("strip"):
        ways[PLAIN] = {"reduction": "condensed", "minimisation": "alternate"}
    for way, options in ways.items():
        problem = builder()
        # The iterations are those of one minimisation.
        for key, value in {**TOLERANCES, **options, "solution": solution, "step_control": "fixed"}.items():
            problem.options[key] = value
        rows, failed = analyse(problem, steps)
        by[way] = rows
        wrong += [f"{name}, {solution}, {way}: {words}" for words in failed]
        for time, row in zip(steps, rows):
            changes, iterations = row["contact_iterations_max"], row["am_iterations"]
            if changes > 40 or (iterations > 40 and way != PLAIN):
                wrong.append(f"{name}, {solution}, {way}: time {time:g}: {changes:.0f} active-set steps in one solve, "
                             f"{iterations:.0f} iterations")
    scale = max((row["stored_bulk"] + row["dissipated"] for row in by["condensed"]), default=1.0)
    worst = {}
    for other in [way for way in ways if way != "condensed"]:
        apart = [(abs(a[key] - b[key]) / scale, time, key, a[key], b[key])
                 for time, a, b in zip(steps, by["condensed"], by[other]) for key in KEYS]
        worst[other] = max((off for off, *_ in apart), default=0.0)
        for _, time, key, a, b in [words for words in apart if words[0] > 1e-8][:1]:
            wrong.append(f"{name}, {solution}: time {time:g}: {key} {a:.10g} condensed, {b:.10g} {other}")
    most = {way: max((row["am_iterations"] for row in rows), default=0) for way, rows in by.items()}
    print(f"{name}, {solution}:", ", ".join(f"{way} {most[way]:.0f} iterations" for way in ways), "; apart by",
          ", ".join(f"{way} {off:.1e}" for way, off in worst.items()), flush=True)
    return wrong


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--whole", action="store_true")
    parser.add_argument("--only", default="")
    arguments = parser.parse_args()
    logging.disable(logging.WARNING)  # that zones are short, that a step jumps: so they are, and do
    steps = np.linspace(0.0, TIMES[-1], 71)[1:]
    wrong = []
    for name, builder in scenes(arguments.whole):
        if not name.startswith(arguments.only):
            continue
        for solution in ("local", "energetic"):
            wrong += compare(name, builder, solution, steps)
    for words in wrong:
        print(words)
    print(f"{len(wrong)} failures")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
