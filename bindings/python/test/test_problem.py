# SPDX-License-Identifier: BSD-3-Clause
"""Scenes: options as a mapping, loads by pattern, what the library assembled, errors."""
import unittest

import support
import numpy as np

import delam


class Options(unittest.TestCase):
    def setUp(self):
        self.problem = support.double_cantilever()

    def test_mapping(self):
        options = self.problem.options
        self.assertEqual(set(options), set(delam.options()))
        self.assertEqual(options["solution"], "local")
        options["solution"] = "energetic"
        options["minimisation_limit"] = 100
        options["damage_tolerance"] = 1e-6
        self.assertEqual(dict(self.problem.options)["solution"], "energetic")
        self.assertEqual((options["minimisation_limit"], options["damage_tolerance"]), (100, 1e-6))
        self.assertIsInstance(options["minimisation_limit"], int)
        del options["solution"]
        self.assertEqual(options["solution"], "local")
        self.assertEqual(delam.Solver(self.problem).option("minimisation_limit"), "100")
        self.assertIn("minimisation_limit = 100  (1 <= value", options.describe())
        self.assertEqual(options.info("solution").type, "text")

    def test_mistakes(self):
        options = self.problem.options
        for change, kind, words in (
                (("solutions", "local"), KeyError, "did you mean 'solution'"),
                (("solution", "best"), delam.ArgumentError, "best"),
                (("solution", 1), delam.ArgumentError, "solution = 1 is a int, expected a str"),
                (("minimisation_limit", 1.5), delam.ArgumentError, "minimisation_limit"),
                (("damage_tolerance", 2.0), delam.ArgumentError, "damage_tolerance"),
                (("damage_tolerance", "small"), delam.ArgumentError, "is no number")):
            before = dict(options)
            with self.assertRaisesRegex(kind, words):
                options.__setitem__(*change)
            self.assertEqual(dict(options), before)


class Scene(unittest.TestCase):
    def test_adhesion_by_mask_and_by_index(self):
        hashes = set()
        for select in (lambda mask: mask, np.flatnonzero, lambda mask: np.flatnonzero(mask).tolist()):
            problem = support.double_cantilever()
            interface = problem.mesh.interfaces[0]
            problem.set_adhesion(interface, select(interface.places[:, 0] < 0.04), 0.25)
            hashes.add(problem.hash)
        self.assertEqual(len(hashes), 1)
        self.assertRegex(hashes.pop(), "^[0-9a-f]{16}$")
        with self.assertRaisesRegex(delam.ArgumentError, r"pairs is a mask of shape \(3,\), expected \(51,\)"):
            problem.set_adhesion(0, [True, False, True])

    def test_patterns(self):
        problem = support.double_cantilever()
        heat = problem.add_pattern("heat", [0, 1], [0, -100])
        problem.add_eigenstrain("heat", [1e-5, 1e-5, 1e-5, 0, 0, 0])
        self.assertEqual(problem.patterns, ["opening", "heat"])
        np.testing.assert_allclose(problem.factors(0.5), [3e-3, -50])
        self.assertEqual(problem.forces(heat).shape, (problem.mesh.node_count, 2))
        self.assertGreater(problem.eigenstrain_energy()[1, 1], 0.0)
        with self.assertRaisesRegex(delam.ArgumentError, "'cold' is not known; known are opening, heat"):
            problem.prescribe(0, "x", "cold")
        with self.assertRaisesRegex(delam.ArgumentError, "must be finite"):
            problem.prescribe_mean([0], [1.0], "x", {"opening": np.inf})

    def test_assembled(self):
        problem = support.double_cantilever()
        stiffness = problem.body_matrix(0).toarray()
        self.assertEqual(len(stiffness), problem.dofs[0] // 2)
        np.testing.assert_allclose(stiffness, stiffness.T, atol=1e-9 * abs(stiffness).max())
        along_x = np.tile([1.0, 0.0], len(stiffness) // 2)
        self.assertLess(abs(stiffness @ along_x).max(), 1e-9 * abs(stiffness).max())
        rows, coefficients = problem.constraints()
        self.assertEqual((rows.shape[0], coefficients.shape), (6, (6, 1)))
        np.testing.assert_allclose(coefficients[:2, 0], 0.5)

    def test_equations_and_drives_are_the_same(self):
        reactions = []
        for way in ("prescribe", "equation", "mean"):
            problem = support.double_cantilever()
            side = problem.mesh.find_node((0.1, 0.0))
            if way == "prescribe":
                problem.prescribe(side, "y", {"opening": 0.5})
            elif way == "equation":
                problem.add_equation([side], [[0.0, 1.0]], {"opening": 0.5})
            else:
                problem.prescribe_mean([side], [3.0], (0.0, 2.0), {"opening": 0.5})
            solver = delam.Solver(problem)
            solver.advance(0.1)
            reactions.append(solver.values["reaction:opening"])
        np.testing.assert_allclose(reactions, reactions[0], rtol=1e-10)

    def test_incomplete_scenes_are_named(self):
        mesh = delam.Mesh.layers(1.0, 2, [1.0], [1])
        problem = delam.Problem(mesh)
        with self.assertRaisesRegex(delam.ProblemError, "material|elastic"):
            problem.check()
        with self.assertRaises(delam.ProblemError):
            delam.Solver(problem)
        problem.set_elastic(1.0, 0.3)
        problem.prescribe([0, 3], "x")
        with self.assertRaisesRegex(delam.ProblemError, "held|support|rigid|motion"):
            delam.Solver(problem)
        problem.prescribe([0], "y")
        self.assertEqual(delam.Solver(problem).field("displacement").shape, (6, 2))

    def test_dead_forces_and_limit(self):
        problem = support.double_cantilever()
        problem.add_pattern("dead", [0, 1], [0, 1])
        problem.add_forces("dead", problem.mesh.find_node((0.05, 3e-3)), (0.0, 10.0))
        solver = delam.Solver(problem)
        solver.advance(0.1)
        self.assertLess(solver.values["load_potential"], 0.0)
        self.assertAlmostEqual(solver.tangent()[0, 1], solver.tangent()[1, 0])


if __name__ == "__main__":
    support.main()
