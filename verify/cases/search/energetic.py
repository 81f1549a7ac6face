#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Energetic analyses whose searches have fronts on several interfaces, none at all, mixed modes, and a third dimension.

    energetic.py

Prints, for each analysis, the energies after each step, its jumps, and its cost in solves and candidates; it judges
nothing. verify/bench/constants.py compares these lines when it varies the constants of the search."""
import itertools
import sys

import delam


def law(onset, toughness=100.0, shear=1.0, stiffness=1e14):
    return delam.Law("piecewise-linear", criterion="benzeggagh-kenane", normal_stiffness=stiffness, tangential_stiffness=stiffness,
                     normal_toughness=toughness, tangential_toughness=shear * toughness, normal_onset=onset * toughness,
                     tangential_onset=onset * shear * toughness, onset_exponent=1.5, toughness_exponent=1.5)


def pressed(layers, notches, the_law, press, columns=80, bent_at=0.06):
    """A beam of layers over 120 mm, supported at its ends and pressed down in between. notches: (interface, from, to)."""
    mesh = delam.Mesh.layers(0.12, columns, [0.003] * layers, [2] * layers, "quad4")
    interfaces = [mesh.add_interface(i, i + 1) for i in range(layers - 1)]
    problem = delam.Problem(mesh, plane="plane-strain")
    problem.options["kinematics"] = "linear"
    problem.set_elastic(75e9, 0.3)
    for interface in interfaces:
        problem.set_law(interface, the_law)
    for i, low, high in notches:
        x = interfaces[i].places[:, 0]
        problem.set_adhesion(interfaces[i], (x > low - 1e-6) & (x < high + 1e-6), 0.0)
    drive = problem.add_pattern("press", [0, 1], [0, press])
    for axis in "xy":
        problem.prescribe(mesh.find_nodes((0.0, 0.0), (0.0, 0.0), body=0), axis)
    problem.prescribe(mesh.find_nodes((0.12, 0.0), (0.12, 0.0), body=0), "y")
    top = 0.003 * layers
    problem.prescribe(mesh.find_nodes((bent_at, top), (bent_at, top), body=layers - 1), "-y", drive=drive)
    return problem


def opened(dimension, onset, shear=1.0, offset=0.0):
    """Two arms opened, by different displacements where the modes shall mix."""
    if dimension == 2:
        mesh = delam.Mesh.layers(0.06, 120, [0.0015, 0.0015], [2, 2], "quad4")
    else:
        mesh = delam.Mesh.layers((0.06, 0.012), (40, 4), [0.0015, 0.0015], [1, 1], "hex8")
    interface = mesh.add_interface(0, 1)
    problem = delam.Problem(mesh, plane="plane-strain") if dimension == 2 else delam.Problem(mesh)
    problem.options["kinematics"] = "linear"
    problem.set_elastic(70e9, 0.3)
    problem.set_law(interface, law(onset, 100.0, shear))
    problem.set_adhesion(interface, interface.places[:, 0] < 0.02 - 1e-6, 0.0)
    far = [10.0] * (dimension - 2)
    low, up = [-v for v in far], far
    for axis in "xyz"[:dimension]:
        problem.prescribe(mesh.find_nodes((0.06, *low, 0.0), (0.06, *up, 0.003)), axis)
    axis = "xyz"[dimension - 1]
    pull = problem.add_pattern("pull", [0, 1], [0, 1e-3])
    turn = problem.add_pattern("turn", [0, 1], [0, 1e-3 * (1.0 - offset)])
    problem.prescribe(mesh.find_nodes((0.0, *low, 0.003), (0.0, *up, 0.003), body=1), axis, drive=pull)
    problem.prescribe(mesh.find_nodes((0.0, *low, 0.0), (0.0, *up, 0.0), body=0), "-" + axis, drive=turn)
    return problem


SCENES = {
    "two fronts": lambda: pressed(2, [(0, 0.0, 0.03), (0, 0.096, 0.12)], law(0.95), 4e-3),
    "three interfaces": lambda: pressed(4, [(0, 0.0, 0.03), (2, 0.05, 0.07)], law(0.9), 4e-3),
    "no crack": lambda: pressed(2, [], law(0.9, 300.0), 6e-3),
    "off centre, modes mix": lambda: pressed(2, [(0, 0.0, 0.03)], law(0.5, 100.0, 4.0), 4e-3, bent_at=0.045),
    "opened": lambda: opened(2, 0.5),
    "opened, modes mix": lambda: opened(2, 0.2, 3.0, 0.5),
    "opened in space": lambda: opened(3, 0.5),
}


def analyse(name, problem, steps, **options):
    problem.options["solution"] = "energetic"
    for key, value in options.items():
        problem.options[key] = value
    solver = delam.Solver(problem)
    solves = candidates = 0
    for step in range(1, steps + 1):
        solver.advance(step / steps)
        solver.commit()
        solves += solver.values["displacement_solves"] + solver.values["contact_iterations"]
        candidates += solver.values["search_candidates"]
        stored = solver.values["stored_bulk"] + solver.values["stored_interface"]
        print(f"{name}, step {step}: stored {stored:.6g}, dissipated {solver.values['dissipated']:.6g}")
    for jump in solver.jumps:
        print(f"{name}: jump at {jump.time:.4g} over {jump.debonded:.4g}, released {jump.released:.4g}")
    print(f"cost {name}, solves: {solves:.0f}")
    print(f"cost {name}, candidates: {candidates:.0f}")


def main():
    only = sys.argv[1:]
    for (name, make), reduction in itertools.product(SCENES.items(), ("condensed", "iterated")):
        if (not only or name in only) and not (reduction == "iterated" and name != "two fronts"):
            analyse(f"{name}, {reduction}", make(), 6, reduction=reduction)
    return 0


if __name__ == "__main__":
    sys.exit(main())
