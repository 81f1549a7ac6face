#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Plane laminates whose interfaces soften at once, and a beam that turns: what constants of their solvers cost.

    laminates.py [--instructions] [SCENE ..]        SCENE: two, eight, turned, turned-in-space

Prints the energies of each step, and the solves, factors and linearisations as `cost` lines, which constants.py compares.
With --instructions, valgrind counts the instructions of each scene, beyond those that the interpreter takes to start: they
do not depend on what else the machine does."""
import re
import subprocess
import sys

import delam


def laminate(interfaces):
    """Plies of 60 mm in cells of 1 mm, held at the right end, bent at the left one."""
    plies, ply, length = interfaces + 1, 1.5e-3, 0.06
    mesh = delam.Mesh.layers(length, 60, [ply] * plies, [2] * plies, "quad4")
    bonds = [mesh.add_interface(i, i + 1) for i in range(interfaces)]
    problem = delam.Problem(mesh, plane="plane-strain")
    problem.options["kinematics"] = "linear"
    problem.set_elastic(70e9, 0.3)
    for bond in bonds:
        problem.set_law(bond, delam.Law("piecewise-linear", normal_stiffness=1e12, tangential_stiffness=1e12,
                                        normal_toughness=2500.0, tangential_toughness=2500.0, normal_onset=20.0, tangential_onset=20.0))
    for axis in "xy":
        problem.prescribe(mesh.find_nodes((length, 0.0), (length, ply * plies)), axis)
    bend = problem.add_pattern("bend", [0, 1], [0, 3e-3])
    top = (0.0, ply * plies)
    problem.prescribe(mesh.find_nodes(top, top, body=plies - 1), "-y", drive=bend)
    problem.options["reduction"] = "condensed"
    return problem


def turned(dimension):
    """Two slender arms that open until they turn."""
    if dimension == 2:
        mesh = delam.Mesh.layers(0.12, 120, [0.001, 0.001], [1, 1], "quad4")
    else:
        mesh = delam.Mesh.layers((0.12, 0.012), (40, 2), [0.001, 0.001], [1, 1], "hex8")
    interface, up = mesh.add_interface(0, 1), "xyz"[dimension - 1]
    problem = delam.Problem(mesh, plane="plane-strain") if dimension == 2 else delam.Problem(mesh)
    problem.options["kinematics"] = "linear"
    problem.set_elastic(70e9, 0.3)
    problem.set_law(interface, delam.Law("piecewise-linear", normal_stiffness=1e13, tangential_stiffness=1e13,
                                         normal_toughness=250.0, tangential_toughness=250.0, normal_onset=25.0, tangential_onset=25.0))
    problem.set_adhesion(interface, interface.places[:, 0] < 0.06 - 1e-6, 0.0)
    pull = problem.add_pattern("pull", [0, 1], [0, 0.02])
    low, high = ([0.0], [0.012]) if dimension == 3 else ([], [])
    for axis in "xyz"[:dimension]:
        problem.prescribe(mesh.find_nodes((0.12, *low, 0.0), (0.12, *high, 0.002)), axis)
    problem.prescribe(mesh.find_nodes((0.0, *low, 0.002), (0.0, *high, 0.002), body=1), up, drive=pull)
    problem.prescribe(mesh.find_nodes((0.0, *low, 0.0), (0.0, *high, 0.0), body=0), "-" + up, drive=pull)
    problem.options["kinematics"] = "corotational"
    return problem


SCENES = {"two": lambda: laminate(2), "eight": lambda: laminate(8), "turned": lambda: turned(2), "turned-in-space": lambda: turned(3)}
COSTS = ("displacement_solves", "newton_solves", "bulk_factorisations", "linearisations")


def analyse(name, steps=8):
    problem = SCENES[name]()
    problem.options["step_control"] = "fixed"
    solver = delam.Solver(problem)
    costs = dict.fromkeys(COSTS, 0.0)
    for step in range(1, steps + 1):
        solver.advance(step / steps)
        solver.commit()
        for cost in costs:
            costs[cost] += solver.values[cost] if cost in solver.values else 0.0
        print(f"{name}, step {step}: stored {solver.values['stored_bulk']:.7g}, dissipated {solver.values['dissipated']:.7g}")
    for cost, count in costs.items():
        print(f"cost {name}, {cost}: {count:.0f}")


def counted(*words):
    """What a run prints, and its instructions."""
    made = subprocess.run(["valgrind", "--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null", sys.executable,
                           __file__, *words], capture_output=True, text=True, check=True)
    return made.stdout, int(re.search("I *refs: *([0-9,]+)", made.stderr).group(1).replace(",", ""))


def instructions(name):
    _, start = counted("--nothing")
    said, count = counted(name)
    print(f"{said}cost {name}, instructions: {count - start}")


if __name__ == "__main__":
    CHOSEN = [word for word in sys.argv[1:] if not word.startswith("--")] or ([] if "--nothing" in sys.argv else list(SCENES))
    for chosen in CHOSEN:
        (instructions if "--instructions" in sys.argv else analyse)(chosen)
