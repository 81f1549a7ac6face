# SPDX-License-Identifier: BSD-3-Clause
"""What the tests share: where the package is, the exit code of a skipped test, the end-notched flexure scene."""
import logging
import os
import pathlib
import signal
import sys
import unittest

HERE = pathlib.Path(__file__).resolve().parent
SOURCES = HERE.parent / "src"
ROOT = HERE.parents[2]
SKIPPED = 77

# One thread of the linear algebra in all hosts: only then are equal digits a claim about the hosts.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
if not os.environ.get("DELAM_TEST_INSTALLED"):
    sys.path.insert(0, str(SOURCES))

# A shell starts what runs in the background with this signal ignored, and Python then raises no KeyboardInterrupt.
signal.signal(signal.SIGINT, signal.default_int_handler)

# What the library notes about coarse scenes belongs to no test but the one that asks.
logging.getLogger("delam").addHandler(logging.NullHandler())


def main():
    """Runs the tests of the calling file; exit code 77 where one was skipped and none failed, with the reason."""
    program = unittest.main(exit=False)
    if not program.result.wasSuccessful():
        sys.exit(1)
    if program.result.skipped:
        for test, reason in program.result.skipped:
            print(f"skipped: {test}: {reason}")
        sys.exit(SKIPPED)


def double_cantilever(divisions=50, steps_to=6e-3, **options):
    """A small scene whose crack grows steadily: 100 mm x 3 mm, a notch of 30 mm, opened at the left end."""
    import delam
    mesh = delam.Mesh.layers(0.1, divisions, [1.5e-3, 1.5e-3], [1, 1])
    interface = mesh.add_interface(0, 1)
    problem = delam.Problem(mesh, plane="plane-strain", **options)
    problem.set_elastic(135e9, 0.3)
    problem.set_formulation("incompatible")
    problem.set_law(interface, bilinear())
    problem.set_adhesion(interface, interface.places[:, 0] < 0.03, 0.0)
    opening = problem.add_pattern("opening", [0, 1], [0, steps_to])
    problem.prescribe(mesh.find_node((0, 3e-3)), "y", {opening: 0.5})
    problem.prescribe(mesh.find_node((0, 0)), "-y", {opening: 0.5})
    problem.prescribe(mesh.find_nodes((0.1, 0), (0.1, 3e-3)), "x")
    return problem


def bilinear(**changes):
    import delam
    parameters = dict(normal_stiffness=1e12, tangential_stiffness=1e12, normal_onset=50.0, tangential_onset=50.0,
                      normal_toughness=280.0, tangential_toughness=280.0)
    return delam.Law("piecewise-linear", **{**parameters, **changes})


def host_bilinear(onset=50.0, toughness=280.0, stiffness=1e12, spy=None):
    """The same law by Python functions: g(zeta) is quadratic, so that the traction falls on a straight line."""
    import delam
    # Secant law: zeta(Y) from Y = Go Gc^2 / (Gc zeta + Go (1 - zeta))^2, the bilinear law's driving energy.
    span = toughness - onset

    def adhesion(mixity, driving):
        if spy is not None:
            spy("adhesion")
        if driving <= onset:
            return 1.0, 0.0
        root = toughness * (onset / driving) ** 0.5
        zeta = (root - onset) / span
        if zeta <= 0.0:
            return 0.0, 0.0
        return zeta, -0.5 * root / (driving * span)

    def dissipation(mixity, zeta):
        if spy is not None:
            spy("dissipation")
        within = onset + span * zeta
        energy = onset * toughness ** 2 / span * (1.0 / within - 1.0 / toughness)
        return energy, -onset * toughness ** 2 / within ** 2, 0.0

    return delam.Law.host("bilinear by hand", adhesion, dissipation, normal_stiffness=stiffness,
                          tangential_stiffness=stiffness)


def brittle_flexure(divisions=60):
    """End-notched flexure with a brittle interface (Zeman, Kruzik, Gruber, PANM 15, 2010): its crack jumps."""
    import delam
    mesh = delam.Mesh.layers(0.12, divisions, [3e-3, 3e-3], [2, 2])
    interface = mesh.add_interface(0, 1)
    problem = delam.Problem(mesh)
    problem.set_elastic(75e9, 0.3)
    problem.set_law(interface, delam.Law("piecewise-linear", normal_stiffness=125e15, tangential_stiffness=125e15,
                                         normal_onset=0.01, tangential_onset=0.01, normal_toughness=25.0,
                                         tangential_toughness=25.0))
    problem.set_adhesion(interface, interface.places[:, 0] < 0.0299, 0.0)
    press = problem.add_pattern("press", [0.0, 2.0], [0.0, 6e-3])
    right = mesh.find_node((0.12, 0.0))
    problem.prescribe([mesh.find_node((0.0, 0.0)), right], "y")
    problem.prescribe(right, "x")
    problem.prescribe(mesh.find_node((0.06, 6e-3)), "-y", press)
    return problem
