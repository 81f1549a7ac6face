# SPDX-License-Identifier: BSD-3-Clause
"""A double cantilever beam in space whose interface obeys a law of the host's own, from Python.

    python3 dcb_host_law.py [history.csv]        without an argument the history goes to standard output

Two arms of 60 mm x 8 mm x 1.5 mm, bonded but for a notch of 20 mm at the left end, held at the right end and pulled
apart to 1.6 mm at the left one, in 16 steps. The law is the bilinear one by two functions of this program: traction
falls on a straight line, onset and toughness are the same in every mode. SI units.
"""
import math
import sys

import delam

LENGTH = 60e-3  # m
WIDTH = 8e-3  # m
HEIGHT = 1.5e-3  # of an arm, m
NOTCH = 20e-3  # m
STEPS = 16
ONSET = 5.0  # energy at which the traction begins to fall, J/m2
TOUGHNESS = 250.0  # J/m2

VALUES = ("step", "time", "load:opening", "reaction:opening", "stored_bulk", "stored_interface", "dissipated", "work",
          "front")


def adhesion(mixity, driving):
    """The minimiser of adhesion * driving + dissipated, and its slope by the driving energy."""
    r = TOUGHNESS / ONSET
    if driving >= ONSET * r * r:
        return 0.0, 0.0
    if driving <= ONSET:
        return 1.0, 0.0
    root = math.sqrt(ONSET / driving)
    return (r * root - 1.0) / (r - 1.0), -0.5 * r / (r - 1.0) * root / driving


def dissipation(mixity, zeta):
    """The energy spent down to an adhesion, and its slopes by adhesion and mixity."""
    r = TOUGHNESS / ONSET
    below = 1.0 + zeta * (r - 1.0)
    return TOUGHNESS - ONSET * r * r * zeta / below, -ONSET * (r / below) * (r / below), 0.0


def make_problem():
    mesh = delam.Mesh.layers([LENGTH, WIDTH], [60, 4], [HEIGHT, HEIGHT], [2, 2], "hex8")
    interface = mesh.add_interface(0, 1)
    law = delam.Law.host("bilinear by hand", adhesion, dissipation, normal_stiffness=1e13, tangential_stiffness=1e13)

    problem = delam.Problem(mesh)
    problem.set_elastic(120e9, 0.3)
    problem.set_formulation("incompatible")
    problem.set_law(interface, law)
    # The notch has no adhesion from the start; the pairs at its tip, on the side of the box, are bonded.
    problem.set_adhesion_box(interface, (0.0, 0.0, 0.0), (NOTCH, WIDTH, 2.0 * HEIGHT))

    opening = problem.add_pattern("opening", [0.0, 1.0], [0.0, 1.6e-3])
    right = mesh.find_nodes((LENGTH, 0.0, 0.0), (LENGTH, WIDTH, 2.0 * HEIGHT))
    for axis in ("x", "y", "z"):
        problem.prescribe(right, axis)
    top = mesh.find_nodes((0.0, 0.0, 2.0 * HEIGHT), (0.0, WIDTH, 2.0 * HEIGHT))
    problem.prescribe(top, "z", {opening: 0.5})
    problem.prescribe(mesh.find_nodes((0.0, 0.0, 0.0), (0.0, WIDTH, 0.0)), "-z", {opening: 0.5})
    problem.check()
    return problem


def march():
    solver = delam.Solver(make_problem())
    return solver.history([step / STEPS for step in range(1, STEPS + 1)], VALUES)


if __name__ == "__main__":
    titles = [name.split(":")[0] for name in VALUES]
    march().write_csv(sys.argv[1] if len(sys.argv) > 1 else sys.stdout, titles)
