# SPDX-License-Identifier: BSD-3-Clause
"""The end-notched flexure test with a ductile interface (Zeman, Kruzik, Gruber, PANM 15, 2010), from Python.

    python3 enf.py [history.csv]        without an argument the history goes to standard output

Two arms of 120 mm x 3 mm lie on each other, bonded by an interface but for a notch of 30 mm at the left end. The bottom
corners are held, the top of mid-span is pressed down to 6 mm in 40 steps. SI units, per metre of width.
"""
import sys

import delam

LENGTH = 120e-3  # span, m
HEIGHT = 3e-3  # of an arm, m
NOTCH = 30e-3  # m
STEPS = 40

VALUES = ("step", "time", "load:load", "reaction:load", "stored_bulk", "stored_interface", "dissipated",
          "stored_interface_slides", "dissipated_slides", "work", "lower", "increment", "upper", "increment_lower",
          "am_iterations", "linear_iterations", "contact_pairs", "debonded_length", "backtracks")


def make_problem():
    mesh = delam.Mesh.layers(LENGTH, 240, [HEIGHT, HEIGHT], [6, 6], "quad4")
    interface = mesh.add_interface(0, 1)
    law = delam.Law("piecewise-linear", normal_stiffness=125e9, tangential_stiffness=125e9, normal_onset=100.0,
                    tangential_onset=100.0, normal_toughness=250.0, tangential_toughness=250.0, onset_exponent_1=2.0,
                    onset_exponent_2=2.0, toughness_exponent_1=2.0, toughness_exponent_2=2.0)

    problem = delam.Problem(mesh, plane="plane-strain")
    problem.set_elastic(75e9, 0.3)
    problem.set_law(interface, law)
    # The notch has no adhesion from the start; the pair at its tip, on the side of the box, is bonded.
    problem.set_adhesion_box(interface, (0.0, 0.0), (NOTCH, 2.0 * HEIGHT))

    load = problem.add_pattern("load", [0.0, 2.0], [0.0, 6e-3])
    left, right = mesh.find_node((0.0, 0.0), body=0), mesh.find_node((LENGTH, 0.0), body=0)
    problem.prescribe(left, "y")
    problem.prescribe(right, "x")
    problem.prescribe(right, "y")
    problem.prescribe(mesh.find_node((0.5 * LENGTH, 2.0 * HEIGHT), body=1), "-y", drive=load)
    problem.check()
    return problem


def march():
    solver = delam.Solver(make_problem())
    return solver.history([2.0 * step / STEPS for step in range(1, STEPS + 1)], VALUES)


if __name__ == "__main__":
    titles = [name.split(":")[0] for name in VALUES]
    march().write_csv(sys.argv[1] if len(sys.argv) > 1 else sys.stdout, titles)
