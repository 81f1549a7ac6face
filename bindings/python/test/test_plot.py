# SPDX-License-Identifier: BSD-3-Clause
"""Pictures: what is drawn is what was computed. Skipped without matplotlib."""
import importlib.util
import subprocess
import sys
import unittest

import support
import numpy as np

import delam

if importlib.util.find_spec("matplotlib"):
    import matplotlib
    matplotlib.use("Agg")


class Lazy(unittest.TestCase):
    def test_nothing_is_imported_before_it_is_needed(self):
        code = "import sys, support, delam; print({'matplotlib', 'meshio', 'tqdm'} & set(sys.modules))"
        done = subprocess.run([sys.executable, "-c", code], cwd=support.HERE, capture_output=True, text=True)
        self.assertEqual((done.stdout, done.stderr), ("set()\n", ""))
        with self.assertRaises(AttributeError):
            delam.nothing


@unittest.skipUnless(importlib.util.find_spec("matplotlib"), "matplotlib is not installed")
class Pictures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.solver = delam.Solver(support.double_cantilever())
        cls.history = cls.solver.history(np.linspace(0.1, 1.0, 10))

    def test_history(self):
        ax = delam.plot.history(self.history, "reaction:opening", x="load:opening")
        np.testing.assert_array_equal(ax.lines[0].get_xydata(), np.column_stack([self.history["load:opening"],
                                                                                self.history["reaction:opening"]]))
        self.assertEqual((ax.get_xlabel(), ax.get_ylabel()), ("load:opening", "reaction:opening"))
        same = delam.plot.history(self.history, ["dissipated", "work"], ax=ax)
        self.assertIs(same, ax)
        self.assertEqual(len(ax.lines), 3)
        ax.figure.canvas.draw()

    def test_interface_in_the_plane(self):
        interface = self.solver.problem.mesh.interfaces[0]
        ax = delam.plot.interface(self.solver, "traction", interface)
        x, y = ax.lines[0].get_xydata().T
        np.testing.assert_allclose(np.sort(x), np.linspace(0, 0.1, 51), atol=1e-15)
        np.testing.assert_array_equal(y[np.argsort(x)], self.solver.field("traction", 0)[:, 0])
        ax.figure.canvas.draw()

    def test_bodies(self):
        ax = delam.plot.bodies(self.solver, scale=2.0)
        cells, lines = ax.collections
        self.assertEqual(len(cells.get_paths()), 100)
        self.assertEqual(len(lines.get_array()), 50)
        ax.figure.canvas.draw()

    def test_space(self):
        mesh = delam.Mesh.layers((1.0, 1.0), (3, 2), [0.2, 0.2], [1, 1], "hex20")
        mesh.add_interface(0, 1)
        problem = delam.Problem(mesh)
        problem.set_elastic(1e3, 0.3)
        problem.set_law(0, support.bilinear(normal_stiffness=1e5, tangential_stiffness=1e5))
        for axis in "xyz":
            problem.prescribe(mesh.find_nodes((0, 0, 0), (1, 1, 0)), axis)
        solver = delam.Solver(problem)
        ax = delam.plot.interface(solver)
        self.assertEqual(len(ax.collections[0].get_array()), 6)
        ax.figure.canvas.draw()
        with self.assertRaises(ValueError):
            delam.plot.bodies(solver)


if __name__ == "__main__":
    support.main()
