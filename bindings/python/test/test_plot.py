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
    import matplotlib.figure
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


@unittest.skipUnless(importlib.util.find_spec("matplotlib"), "matplotlib is not installed")
class Units(unittest.TestCase):
    """Quantities that are compared have one unit in the pictures of a result, whatever part of them a picture shows."""

    def result(self, dimension, drives):
        from delam._pictures.result import Result
        of = Result.__new__(Result)
        powers = [{"factor": factor, "name": name} for factor, name in ((1e6, "u"), (1e3, "m"), (1, ""), (1e-3, "k"))]
        keys = ("length", "area", "force", "line_force", "energy", "line_energy", "release_rate", "stress")
        scales = {key: [{**one, "name": one["name"] + key} for one in powers] for key in keys}
        of.about = {"units": {"scales": scales, "time": "s"}, "scene": {"dimension": dimension},
                    "patterns": [{"name": name, "drives": kind} for name, kind in drives.items()]}
        of.cell, suffix = None, {name: f"_{name}" if len(drives) > 1 else "" for name in drives}
        of.history = {"stored_bulk": np.array([0.0, 5e3]), "stored_interface": np.array([0.0, 2e-5]),
                      "dissipated": np.array([0.0, 1.0]), "work": np.array([0.0, 4e3]),
                      "energy_release_rate": np.array([0.0, 0.01])}
        for (name, kind), largest in zip(drives.items(), (3e4, 1e7)):
            of.history["reaction" + suffix[name]] = np.array([0.0, -largest])
        of.name_units()
        return of

    def test_one_unit(self):
        for dimension, line in ((2, "line_"), (3, "")):
            of = self.result(dimension, {"pull": "displacement", "swell": "strain"})
            self.assertEqual([of.text(value, "force") for value in (3e4, 20.0)],
                             [f"30 k{line}force", f"0.02 k{line}force"])
            self.assertEqual([of.unit("energy", value) for value in (1e-9, 1.0, 1e9)], [f"k{line}energy"] * 3)
            self.assertEqual(of.text(1e7, "energy"), f"10000 k{line}energy")
            self.assertEqual(of.text(0.002, "release_rate"), "2 mrelease_rate")
            self.assertEqual([of.unit("length", value) for value in (0.01, 1.0)], ["mlength", "length"])
            self.assertEqual(of.text(0.01, "length", largest=1.0), "0.01 length")

    def test_axes_have_a_prefix_and_no_power_of_ten(self):
        from delam._pictures.result import name_axis
        for largest, unit, shown in ((8e6, "kN", "8000"), (8e-3, "mN", "8")):
            ax = matplotlib.figure.Figure().add_subplot()
            ax.plot([0.0, 1.0], [0.0, largest])
            ax.set_yticks([0.0, largest])
            name_axis(ax.yaxis, "reaction", [(1e3, "mN"), (1.0, "N"), (1e-3, "kN")])
            ax.figure.draw_without_rendering()
            self.assertEqual(ax.get_ylabel(), f"reaction [{unit}]")
            self.assertEqual([text.get_text() for text in ax.get_yticklabels()], ["0", shown])
            self.assertEqual(ax.yaxis.get_offset_text().get_text(), "")


if __name__ == "__main__":
    support.main()
