# SPDX-License-Identifier: BSD-3-Clause
"""Results of the command line, and histories of solvers: numbers as they are in the files, pictures as plot.py draws
them. Skipped without the program, h5py or matplotlib."""
import csv
import importlib.util
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import support
import numpy as np

import delam
from delam._base.closing import lines

PROGRAM = os.environ.get("DELAM", "")
HAVE = {name: importlib.util.find_spec(name) is not None for name in ("h5py", "matplotlib", "meshio", "pandas")}
if HAVE["matplotlib"]:
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt


def run(folder, *settings, scene=support.ROOT / "examples" / "enf" / "enf.toml"):
    words = [word for setting in settings for word in ("--set", setting)]
    subprocess.run([PROGRAM, "run", str(scene), "--out", str(folder), *words], check=True, capture_output=True)


def in_joules(found):
    return f"{float(found[1]) * {'n': 1e-9, 'µ': 1e-6, 'm': 1e-3, 'k': 1e3, '': 1}[found[2]]:.3g}"


@unittest.skipUnless(PROGRAM, "the program delam is not built")
@unittest.skipUnless(HAVE["h5py"], "h5py is not installed")
class OfTheCommandLine(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name) / "enf"
        run(cls.folder, "geometry.h=0.003", "time.steps=10")
        cls.result = delam.Result(cls.folder)

    def test_history(self):
        history = self.result.history
        with open(self.folder / "history.csv", encoding="utf-8") as file:
            titles, *rows = csv.reader(file)
        self.assertEqual(list(history.dtype.names), titles)
        self.assertEqual(history.shape, (11,))
        for column, title in enumerate(titles):
            texts = [row[column] for row in rows]
            if title in ("solution", "mixity_rule"):
                self.assertEqual(history[title].tolist(), texts)
            else:
                self.assertEqual(history[title].tolist(), [float(text) for text in texts], title)
        self.assertGreater(history["reaction"].max(), 0)
        self.assertTrue(self.result.complete)
        self.assertEqual(self.result.closing, json.loads((self.folder / "result.json").read_text())["closing"])
        self.assertIn("complete, 10 steps", repr(self.result))

    def test_closing_lines_of_histories_are_the_same(self):
        examples, said = support.ROOT / "examples", ""
        for scene, steps, control in (("enf", 1, "auto"), ("enf", 1, "fixed"), ("enf-brittle-local", 12, "auto")):
            folder = self.folder.parent / f"closing-{scene}-{control}"
            run(folder, "geometry.h=0.003", f"time.steps={steps}", f'solver.step_control="{control}"',
                "solver.kinematics=linear", scene=examples / scene / f"{scene}.toml")
            result = delam.Result(folder)
            table = result.history
            columns = {name: table[name] for name in table.dtype.names if name not in ("solution", "mixity_rule")}
            columns["load_potential"] = np.zeros(len(table))
            ours = lines(columns, [], result.about["options"])
            theirs = [re.sub(r"([-\d.e]+) ([nµmk]?)J/m", in_joules, line) for line in result.closing]
            self.assertEqual(ours, [line for line in theirs if "balance" in line or "two-sided" in line])
            said += "\n".join(ours)
        for words in ("energy balance: work 202 = stored", "warning: energy balance: off", "less than 0.001 %",
                      "violated in steps: 3, 4", "nothing in 1 step"):
            self.assertIn(words, said)

    @unittest.skipUnless(HAVE["pandas"], "pandas is not installed")
    def test_pandas(self):
        frame = self.result.to_pandas()
        self.assertEqual(list(frame.columns), list(self.result.history.dtype.names))
        np.testing.assert_array_equal(frame["reaction"].to_numpy(), self.result.history["reaction"])

    def test_fields(self):
        import h5py
        steps = self.result.steps
        last = max(steps)
        fields = self.result.fields()
        self.assertEqual((fields.step, fields.time), (last, steps[last]))
        with h5py.File(self.folder / "fields.h5", "r") as file:
            group = file["steps"][f"{last:08d}"]
            self.assertEqual(set(fields), set(group))
            np.testing.assert_array_equal(fields["displacement"], group["displacement"][()])
            np.testing.assert_array_equal(fields["interface_0"]["zeta"], group["interface_0/zeta"][()])
            np.testing.assert_array_equal(self.result.nodes, file["mesh/points"][()])
        first = self.result.fields(min(steps))
        self.assertLess(fields["interface_0"]["zeta"].sum(), first["interface_0"]["zeta"].sum())
        self.assertEqual(self.result.fields(-len(steps)).step, min(steps))
        with self.assertRaisesRegex(KeyError, f"step 1000 has no fields; those are .*{last}"):
            self.result.fields(1000)

    def test_no_result(self):
        with self.assertRaisesRegex(FileNotFoundError, "holds no result: a file is missing: .*result.json"):
            delam.Result(self.folder.parent)

    def test_jumps(self):
        brittle = self.folder.parent / "brittle"
        name = "enf-brittle-energetic"
        run(brittle, "time.steps=10", scene=support.ROOT / "examples" / name / f"{name}.toml")
        jumps = delam.Result(brittle).jumps
        with open(brittle / "jumps.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertGreater(len(rows), 0)
        self.assertEqual(jumps["time"].tolist(), [float(row["time"]) for row in rows])
        self.assertEqual(jumps["name"].tolist(), [row["name"] for row in rows])
        (brittle / "jumps.csv").unlink()
        self.assertEqual(delam.Result(brittle).jumps.shape, (0,))

    @unittest.skipUnless(HAVE["meshio"], "meshio is not installed")
    def test_meshio(self):
        import meshio
        result, fields = self.result, self.result.fields()
        file = self.folder.parent / "last.vtu"
        result.to_meshio().write(file)
        back = meshio.read(file)
        np.testing.assert_array_equal(back.points, result.nodes)
        np.testing.assert_array_equal(back.point_data["displacement"], fields["displacement"])
        np.testing.assert_array_equal(np.concatenate(back.cell_data["stress"]), fields["stress"])
        np.testing.assert_array_equal(np.concatenate(back.cell_data["bodies"]), result.bodies)
        faces = result.to_meshio(interface=0)
        self.assertEqual([block.type for block in faces.cells], ["line"])
        np.testing.assert_array_equal(faces.point_data["zeta"], fields["interface_0"]["zeta"])
        # The lines are the interface: all of the beam's 120 mm.
        ends = faces.points[faces.cells[0].data]
        self.assertAlmostEqual(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).sum(), 0.12, 12)
        with self.assertRaisesRegex(KeyError, "interface_7 is not in the result; there are interface_0"):
            result.to_meshio(interface=7)

    @unittest.skipUnless(HAVE["matplotlib"], "matplotlib is not installed")
    def test_pictures_are_those_of_the_command_line(self):
        subprocess.run([sys.executable, os.environ["DELAM_PLOT"], str(self.folder)], check=True)
        style = dict(plt.rcParams)
        for kind, name in (("load", "load-displacement"), ("energies", "energies"), ("snapshots", "snapshots")):
            figure = self.result.plot(kind)
            self.assertEqual(dict(plt.rcParams), style, "the user's style is left alone")
            figure.savefig(self.folder / "ours.png", dpi=150)
            plt.close(figure)
            ours, theirs = (plt.imread(self.folder / file) for file in ("ours.png", f"{name}.png"))
            self.assertEqual(ours.shape, theirs.shape, kind)
            self.assertLess(np.abs(ours - theirs).max(), 1e-6, kind)

    @unittest.skipUnless(HAVE["matplotlib"], "matplotlib is not installed")
    def test_what_is_drawn(self):
        figure = self.result.plot()
        line, dots = (one.get_xydata() for one in figure.axes[0].lines)
        rows = np.column_stack([self.result.history["load"], self.result.history["reaction"]])
        np.testing.assert_array_equal(dots, rows)
        # The line goes through the points between which it jumps as well.
        self.assertEqual(len(line), len(rows) + 2 * len(self.result.jumps))
        plt.close(figure)
        for kind, options, error, words in (
                ("loads", {}, delam.ArgumentError, "kind = 'loads' is no picture; known are load, energies"),
                ("fronts", {}, ValueError, "no picture of fronts: fronts are drawn of scenes in space"),
                ("cut", {}, ValueError, "plane bodies are not cut"),
                ("cut", {"cut": "y"}, delam.ArgumentError, "takes x, y or z"),
                ("load", {"cut": "y=0"}, delam.ArgumentError, "belongs to kind 'cut'")):
            with self.subTest(kind), self.assertRaisesRegex(error, words):
                self.result.plot(kind, **options)


@unittest.skipUnless(PROGRAM, "the program delam is not built")
@unittest.skipUnless(HAVE["h5py"] and HAVE["matplotlib"], "h5py or matplotlib is not installed")
class InSpace(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        run(cls.folder, "geometry.divisions=[34, 4]", "time.steps=4",
            scene=support.ROOT / "examples" / "enf-3d" / "enf-3d.toml")
        cls.result = delam.Result(cls.folder)

    def test_pictures(self):
        for kind, options, said in (("fronts", {}, "fronts in plan"), ("cut", {"cut": "y=0.005"}, "cut at y = 0.005 m"),
                                    ("snapshots", {}, "displacements × 1")):
            with self.subTest(kind):
                figure = self.result.plot(kind, **options)
                self.assertIn(said, figure._suptitle.get_text())
                figure.canvas.draw()
                plt.close(figure)
        with self.assertRaisesRegex(ValueError, "the cut at y = 7 m meets no cell"):
            self.result.plot("cut", cut="y=7")

    @unittest.skipUnless(HAVE["meshio"], "meshio is not installed")
    def test_meshio(self):
        mesh = self.result.to_meshio()
        self.assertEqual([block.type for block in mesh.cells], ["hexahedron"])
        self.assertEqual(len(mesh.cells[0].data), len(self.result.bodies))
        faces = self.result.to_meshio(interface=0)
        corners = faces.points[faces.cells[0].data]
        sides = corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]
        # The whole interface: length times width.
        self.assertAlmostEqual(0.5 * np.linalg.norm(np.cross(*sides), axis=1).sum(), 0.102 * 0.0127, 12)
        self.assertEqual(faces.point_data["traction"].shape, (len(faces.points), 3))


class OfASolver(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.solver = delam.Solver(support.double_cantilever())
        cls.history = cls.solver.history(np.linspace(0.1, 1.0, 10))

    def test_array(self):
        table = self.history.array
        self.assertEqual(table.dtype.names, self.history.names)
        self.assertEqual(len(table), 11)
        np.testing.assert_array_equal(table["reaction:opening"], self.history["reaction:opening"])

    @unittest.skipUnless(HAVE["pandas"], "pandas is not installed")
    def test_pandas(self):
        frame = self.history.to_pandas()
        np.testing.assert_array_equal(frame["dissipated"].to_numpy(), self.history["dissipated"])

    @unittest.skipUnless(HAVE["matplotlib"], "matplotlib is not installed")
    def test_load(self):
        figure = self.history.plot(units={"length": "m", "force": "N"}, title="two arms")
        axes = figure.axes[0]
        np.testing.assert_array_equal(axes.lines[0].get_xydata(), np.column_stack(
            [self.history["load:opening"], self.history["reaction:opening"]]))
        self.assertEqual((axes.get_xlabel(), axes.get_ylabel()), ("prescribed displacement [m]", "reaction [N/m]"))
        self.assertEqual(figure._suptitle.get_text().splitlines(),
                         ["two arms – load and displacement", "local solution, converged mixity, 10 steps"])
        figure.canvas.draw()
        plt.close(figure)

    @unittest.skipUnless(HAVE["matplotlib"], "matplotlib is not installed")
    def test_energies(self):
        figure = self.history.plot("energies")
        lines = {line.get_label(): line.get_ydata() for line in figure.axes[0].lines}
        np.testing.assert_array_equal(lines["stored, bodies"], self.history["stored_bulk"])
        np.testing.assert_array_equal(lines["dissipated"], self.history["dissipated"])
        # The work of the loads is the area under the load curve.
        load, reaction = self.history["load:opening"], self.history["reaction:opening"]
        area = np.concatenate([[0.0], np.cumsum(0.5 * (reaction[1:] + reaction[:-1]) * np.diff(load))])
        # Within the first step with damage, the reaction is the elastic one up to the onset.
        np.testing.assert_allclose(lines["work"], area, rtol=0.01, atol=0)
        steps, damages = np.diff(lines["work"]) - np.diff(area), np.diff(self.history["dissipated"]) > 0
        np.testing.assert_allclose(np.delete(steps, np.argmax(damages)), 0, atol=1e-12 * area[-1])
        figure.canvas.draw()
        plt.close(figure)

    @unittest.skipUnless(HAVE["matplotlib"], "matplotlib is not installed")
    def test_dead_forces(self):
        mesh = delam.Mesh.layers(0.1, 10, [2e-3], [2])
        problem = delam.Problem(mesh)
        problem.set_elastic(70e9, 0.3)
        problem.set_formulation("standard")  # of slender cells that bend, rounding is a little larger than below
        for axis in "xy":
            problem.prescribe(mesh.find_nodes((0, 0), (0, 2e-3)), axis)
        weight = problem.add_pattern("weight", [0, 1], [0, 1])
        problem.add_forces(weight, mesh.find_node((0.1, 0)), (0.0, -10.0))
        solver = delam.Solver(problem)
        figure = solver.history([0.5, 1.0]).plot()
        x, y = figure.axes[0].lines[0].get_xydata().T
        np.testing.assert_array_equal(y, [0, 0.5, 1.0])
        tip = solver.field("displacement")[mesh.find_node((0.1, 0)), 1]
        self.assertAlmostEqual(x[-1], -10.0 * tip, delta=1e-9 * abs(10.0 * tip))
        self.assertEqual(figure.axes[0].get_ylabel(), "load factor")
        plt.close(figure)

    @unittest.skipUnless(HAVE["matplotlib"], "matplotlib is not installed")
    def test_what_is_missing(self):
        with self.assertRaisesRegex(ValueError, "no picture of load: the problem has no load pattern"):
            problem = delam.Problem(delam.Mesh.layers(1.0, 2, [1.0], [1]))
            problem.set_elastic(1.0, 0.3)
            for axis in "xy":
                problem.prescribe([0, 1], axis)
            delam.Solver(problem).history([]).plot()
        with self.assertRaisesRegex(delam.ArgumentError, "'snapshots' is no picture; known are load, energies, bodies"):
            self.history.plot("snapshots")

    @unittest.skipUnless(HAVE["matplotlib"], "matplotlib is not installed")
    def test_bodies(self):
        figure = self.history.plot("bodies", title="two arms")
        self.assertIn("two arms – bodies at time 1\n", figure._suptitle.get_text())
        cells = figure.axes[0].collections[0]
        corners = np.concatenate([path.vertices for path in cells.get_paths()])
        tip = self.solver.problem.mesh.nodes + self.solver.field("displacement")
        np.testing.assert_allclose((corners.min(0), corners.max(0)), (tip.min(0), tip.max(0)), atol=1e-15)
        plt.close(figure)


if __name__ == "__main__":
    support.main()
