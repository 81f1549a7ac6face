#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The bound of an energetic search in mixed mode against a scan of all positions of the front.

    scan.py

A position has the energy of the bodies with the pairs up to it debonded, each computed by an equilibrium of its own, and
what these pairs have dissipated: along an analysis of the local solution in many steps, in which a load that grows has
taken the front past them, integrated here from jumps and adhesions. No position may lie below the state that the search
has kept by more than `search_gap`, and the search gives no more than 5 % of the energy for it."""
import itertools
import sys

import delam
import numpy as np
import energetic

NORMAL, SHEAR_OVER_NORMAL = 100.0, {"off centre, modes mix": 4.0, "opened, modes mix": 3.0}
EXPONENT, STIFFNESS = 1.5, 1e14
STEPS, FINE, FARTHER = 8, 320, 1.6
TOLERANCE = 1e-3  # of the energy: what the integral of the path, and the mesh of its steps, leave
failures = 0


def expect(condition, what):
    global failures
    print(("ok    " if condition else "FAIL  ") + what)
    failures += 0 if condition else 1


def dissipated(name, mixity, adhesion):
    """g(B, zeta) of Benzeggagh and Kenane's criterion, per area."""
    onset_normal = {"off centre, modes mix": 0.5, "opened, modes mix": 0.2}[name] * NORMAL
    share = 1.0 + (SHEAR_OVER_NORMAL[name] - 1.0) * mixity ** EXPONENT
    onset, total = onset_normal * share, NORMAL * share
    return total * onset * (1.0 - adhesion) / (onset + (total - onset) * adhesion)


def mixity_of(jump):
    normal, tangential = max(jump[0], 0.0) ** 2, jump[1] ** 2
    return tangential / (normal + tangential) if normal + tangential > 0.0 else 0.0


def fields(solver):
    return solver.field("adhesion"), solver.field("jump")


def costs_of_growth(name, make, weight):
    """What each pair dissipates until it is debonded, none where it is not; and the sum over what the analysis records."""
    problem = make()
    problem.options["solution"] = "local"
    solver = delam.Solver(problem)
    adhesion, jump = fields(solver)
    cost = [0.0] * len(adhesion)
    for step in range(1, FINE + 1):
        solver.advance(FARTHER * step / FINE)
        solver.commit()
        after, moved = fields(solver)
        for p, (old, new) in enumerate(zip(adhesion, after)):
            if new < old:
                ends = [mixity_of(j) for j in ((moved[p],) if old == 1.0 else (jump[p], moved[p]))]
                cost[p] += weight[p] * sum(dissipated(name, b, new) - dissipated(name, b, old) for b in ends) / len(ends)
        adhesion, jump = after, moved
    known = sum(cost) / solver.values["dissipated"]
    return [c if z == 0.0 else None for c, z in zip(cost, adhesion)], known


def scan(scene, make, few):
    """few: candidates to which the search is limited, so that it keeps states that are not the lowest; 0: it is not."""
    problem = make()
    interface = problem.mesh.interfaces[0]
    place = interface.places[:, 0]
    weight = np.gradient(place)  # trapezoidal: half a cell at the ends
    weight[0] *= 0.5
    weight[-1] *= 0.5
    cost, known = costs_of_growth(scene, make, weight)
    name = scene
    expect(abs(known - 1.0) < 0.01, f"{name}: growth dissipates what the analysis records, times {known:.4f}")
    problem.options["solution"] = "energetic"
    if few:
        problem.options["search_limit"] = few
        name += f", {few} candidates"
    solver = delam.Solver(problem)
    worst = {"gap": 0.0, "least": np.inf, "below": 0.0, "positions": 0}
    for step in range(1, STEPS + 1):
        before, begun = solver.field("adhesion"), solver.values["dissipated"]
        spent = {p: begun_of(scene, solver, p, weight) for p in range(len(before)) if 0.0 < before[p] < 1.0}
        solver.advance(step / STEPS)
        solver.commit()
        values = solver.values
        kept = values["stored_bulk"] + values["stored_interface"] + values["dissipated"]
        scale, gap = max(kept, values["work"]), values["search_gap"]
        reached = solver.field("adhesion")
        other = delam.Solver(problem)
        adhesion, total = before.copy(), begun
        for p in np.argsort(place):
            if before[p] == 0.0:
                continue
            if cost[p] is None:
                break
            total += cost[p] - spent.get(p, 0.0)
            adhesion[p] = 0.0
            other.equilibrate(step / STEPS, adhesion)
            stored = other.values["stored_bulk"] + other.values["stored_interface"]
            other.rollback()
            worst["least"] = min(worst["least"], (stored + total - (kept - gap)) / scale)
            worst["below"] = max(worst["below"], (kept - stored - total) / scale)
            worst["positions"] += 1
        worst["gap"] = max(worst["gap"], gap / scale)
        print(f"      step {step}: gap {100 * gap / scale:.2f} % of the energy, {int((reached < 1e-3).sum())} pairs debonded")
    expect(worst["positions"] > 40, f"{name}: {worst['positions']} positions")
    expect(worst["least"] > -TOLERANCE, f"{name}: no position lies lower than bounded, by {worst['least']:.4f} of the energy")
    if few:
        expect(worst["below"] > 0.01, f"{name}: a position lies lower than the state kept, by {worst['below']:.4f} of the energy")
    else:
        expect(worst["gap"] < 0.05, f"{name}: gap {100 * worst['gap']:.2f} % of the energy")


def begun_of(scene, solver, pair, weight):
    """What a pair has dissipated so far, at the mixity of the state."""
    return weight[pair] * dissipated(scene, solver.field("mixity")[pair], solver.field("adhesion")[pair])


def main():
    for scene, few in itertools.product(SHEAR_OVER_NORMAL, (0, 3)):
        scan(scene, energetic.SCENES[scene], few)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
