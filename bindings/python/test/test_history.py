# SPDX-License-Identifier: BSD-3-Clause
"""Histories: names and aliases, what remains when a run is stopped, closing lines, pictures without the solver, and the
warnings that a program sees without asking for them."""
import importlib.util
import os
import signal
import subprocess
import sys
import threading
import time
import unittest

import support
import numpy as np

import delam
from delam._base.closing import lines

if importlib.util.find_spec("matplotlib"):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
COARSE = """
import logging, support
logging.getLogger("delam").handlers.clear()
import delam
problem = support.double_cantilever(divisions=20)
problem.options["step_control"] = "fixed"
delam.Solver(problem).history([1.0], ())
"""


class Names(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.solver = delam.Solver(support.double_cantilever())
        cls.history = cls.solver.history(np.linspace(0.1, 1.0, 10))

    def test_names_of_the_command_line(self):
        for short, name in (("load", "load:opening"), ("reaction", "reaction:opening"),
                            ("dissipated_linear", "dissipated_slides")):
            np.testing.assert_array_equal(self.history[short], self.history[name])
            self.assertIn(short, self.history)
            self.assertEqual(self.solver.values[short], self.history[name][-1])
            self.assertNotIn(short, self.history.names)
        asked = delam.Solver(support.double_cantilever()).history([0.5], values=["reaction", "load:opening"])
        self.assertEqual((asked.names, asked.array.dtype.names), (("reaction", "load:opening"),) * 2)
        np.testing.assert_array_equal(asked["reaction"], asked["reaction:opening"])
        self.assertEqual(asked.row(-1), {"reaction": asked["reaction"][1], "load:opening": 3e-3})
        recording = delam.Solver(support.double_cantilever())
        recording.record("reaction")
        np.testing.assert_array_equal(recording.recorded("reaction"), recording.recorded("reaction:opening"))

    def test_two_patterns_have_no_short_names(self):
        problem = support.double_cantilever()
        problem.prescribe(problem.mesh.find_node((0.1, 0)), "y", problem.add_pattern("other", [0, 1], [0, 1e-6]))
        history = delam.Solver(problem).history([0.5])
        with self.assertRaisesRegex(KeyError, "did you mean 'reaction:opening' or 'reaction:other'"):
            history["reaction"]

    def test_unknown_names(self):
        short = delam.Solver(support.double_cantilever()).history([], values=["time"])
        for use, words in (
                (lambda: self.history["reactoin:opening"], "did you mean 'reaction:opening'"),
                (lambda: short["zzz"], "'zzz' is no value; this history has time"),
                (lambda: short["work"], "'work' is not in this history, which has time; name it in values="),
                (lambda: self.solver.values["disipated"], "did you mean 'dissipated'"),
                (lambda: self.solver.history([], values=["reacton"]), "did you mean 'reaction'"),
                (lambda: self.solver.values["zzz"], r"'zzz' is not known; there are step, time, .* \(\d+ in all")):
            with self.assertRaisesRegex(KeyError, words) as caught:
                use()
            self.assertLess(len(str(caught.exception)), 300)
        with self.assertRaisesRegex(delam.ArgumentError, r"values = 'time' is a str, expected names in a list"):
            self.solver.history([], values="time")


class Times(unittest.TestCase):
    def test_the_committed_time_comes_first(self):
        whole = delam.Solver(support.double_cantilever()).history(np.linspace(0, 1, 11))
        without = delam.Solver(support.double_cantilever()).history(np.linspace(0, 1, 11)[1:])
        np.testing.assert_array_equal(whole.array, without.array)
        solver = delam.Solver(support.double_cantilever())
        self.assertEqual([row["step"] for row in solver.march([0.0, 0.5], ["step"])], [0, 1])
        self.assertEqual([row["step"] for row in solver.march([0.5, 1.0], ["step"])], [1, 2])
        for times in ([0.5], [1.0, 1.0]):
            with self.assertRaisesRegex(delam.ArgumentError, "not after the committed time"):
                solver.history(times)
        self.assertFalse(solver.pending)


class Stopped(unittest.TestCase):
    def test_control_c_keeps_the_rows(self):
        grid = np.linspace(0, 1, 4001)
        expected = delam.Solver(support.double_cantilever()).history(grid[:400], ("time", "reaction"))

        def times(outside):
            for i, at in enumerate(grid):
                if i == 10:
                    outside.start()
                yield at

        for delay in (0.0, 0.001, 0.003, 0.01, 0.03):
            solver = delam.Solver(support.double_cantilever())
            outside = threading.Thread(target=lambda: (time.sleep(delay), os.kill(os.getpid(), signal.SIGINT)))
            with self.assertRaises(KeyboardInterrupt) as caught:
                solver.history(times(outside), ("time", "reaction"))
            outside.join()
            history = caught.exception.history
            self.assertGreaterEqual(len(history), 10)
            self.assertEqual((len(history), history["time"][-1]), (solver.values["step"] + 1, solver.time))
            self.assertIn(f"The {len(history)} rows up to time", caught.exception.__notes__[0])
            rows = min(len(history), len(expected))
            np.testing.assert_array_equal(history.array[:rows], expected.array[:rows])
            # It goes on where it stopped.
            rest = solver.history([solver.time, 1.0], ("time", "reaction"))
            self.assertEqual((rest["time"][0], rest["time"][-1]), (history["time"][-1], 1.0))

    def test_other_ends(self):
        problem = support.double_cantilever()
        solver = delam.Solver(problem)

        steps = []

        def times():
            for at in (0.2, 0.4, 0.6, 0.8):
                steps.append(at)
                yield at

        problem.progress = lambda stage, done, total: len(steps) > 2
        with self.assertRaises(delam.Cancelled) as caught:
            solver.history(times())
        self.assertEqual(caught.exception.history["time"].tolist(), [0.0, 0.2, 0.4])
        problem.progress = None
        with self.assertRaises(delam.ArgumentError) as caught:
            solver.history([0.6, 0.5])
        self.assertEqual(caught.exception.history["time"].tolist(), [0.4, 0.6])
        self.assertIsNone(delam.ArgumentError("without").history)


class Closing(unittest.TestCase):
    def test_balance(self):
        for control in ("fixed", "auto"):
            self.expect_balance(control)

    def expect_balance(self, control):
        problem = support.double_cantilever()
        problem.options["step_control"] = control
        history = delam.Solver(problem).history(np.linspace(0.1, 1.0, 10), ["time"])
        full = delam.Solver(problem).history(np.linspace(0.1, 1.0, 10))
        defect = (full["stored_bulk"] + full["stored_interface"] + full["dissipated"] + np.cumsum(full["released"])
                  - full["work"])
        at = int(np.abs(defect).argmax())
        self.assertEqual(history.closing, full.closing)
        (line,) = [line for line in history.closing if "energy balance" in line]
        if control == "auto":
            share = 100 * abs(defect[at]) / full["dissipated"][-1]
            self.assertIn(f"work {full['work'][-1]:.3g} = stored ", line)
            self.assertIn(f"dissipated {full['dissipated'][-1]:.3g} + released", line)
            self.assertIn(f" {full['released'].sum():.3g} + open {-defect[-1]:.3g}; open is {share:.2g} % of the "
                          f"dissipated energy at most ({-defect[at]:.3g} in step {at}, ", line)
            return
        share = 100 * abs(defect[at]) / full["work"].max()
        self.assertIn(f"off by {share:.2g} % of the work", line)
        self.assertIn(f"is {defect[at]:.3g} in step {at}, time {full['time'][at]:g};", line)

    def test_jumps(self):
        problem = support.double_cantilever()
        problem.set_law(0, support.bilinear(normal_onset=279.0, tangential_onset=279.0))
        problem.options["jump_tolerance"] = 1e-3
        solver = delam.Solver(problem)
        history = solver.history([0.5, 1.0], ())
        released = sum(jump.released for jump in solver.jumps)
        self.assertEqual(history.closing[0].split(" released")[0], f"{len(solver.jumps)} jumps, the first at time "
                                                                   f"{solver.jumps[0].time:.6g}: {released:.3g}")
        # A later row reads the jumps of its own steps alone.
        self.assertEqual([repr(jump) for jump in history._jumps], [repr(jump) for jump in solver.jumps])

    def test_jumps_of_replaced_steps_go(self):
        problem = support.brittle_flexure()
        problem.options["backtracking"] = "on"
        solver = delam.Solver(problem, not_converged="ignore")
        history, seen = delam.History(solver, ()), []
        for _ in solver.march(np.linspace(0.05, 0.5, 10), ()):
            history.record()
            seen.append(repr(history._jumps))
            self.assertEqual(seen[-1], repr(solver.jumps))
        self.assertGreater(len(history._jumps), 0)

    def test_steps_outside_their_bounds(self):
        columns = {name: np.zeros(5) for name in ("stored_bulk", "stored_interface", "load_potential", "defect")}
        columns |= {"step": np.arange(5.0), "time": np.arange(5.0) / 4, "work": np.array([0.0, 1, 2, 3, 4]),
                    "lower": np.full(5, 0.9), "upper": np.full(5, 1.1),
                    "increment": np.array([9, 1.0, 0.8, 1.2, np.nan])}
        said = lines(columns, [], {"step_control": "fixed", "mixity_rule": "converged",
                                    "backtracking_tolerance": 1e-3})
        self.assertEqual(said[1:], ["two-sided estimate violated in steps: 2, 3, 4 (tolerance eta = 0.001)"])

    def test_estimate(self):
        problem = support.double_cantilever()
        problem.options["step_control"] = "fixed"
        history = delam.Solver(problem).history([1.0])
        outside = history["increment"][1] > history["upper"][1] or history["increment"][1] < history["lower"][1]
        hollow = history["upper"][1] - history["lower"][1] > history["work"][1]
        said = "\n".join(history.closing)
        self.assertEqual("violated in steps: 1 " in said, outside)
        self.assertEqual("says nothing in 1 step (the first is step 1)" in said, hollow)
        self.assertTrue(outside or hollow)

    def test_warnings_are_seen_by_default(self):
        done = subprocess.run([sys.executable, "-c", COARSE], cwd=support.HERE, capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout), (0, ""), done.stderr)
        for words in ("the process zone, about", "differ from the work of the loads"):
            self.assertIn(words, done.stderr)


@unittest.skipUnless(importlib.util.find_spec("matplotlib"), "matplotlib is not installed")
class Pictures(unittest.TestCase):
    def test_after_the_solver(self):
        with delam.Solver(support.double_cantilever()) as solver:
            history = solver.history(np.linspace(0.1, 1.0, 10))
        for kind in ("load", "energies"):
            figure = history.plot(kind)
            self.assertIn("local solution, converged mixity, 10 steps", figure._suptitle.get_text())
            figure.canvas.draw()
            plt.close(figure)
        with self.assertRaisesRegex(ValueError, "no picture of bodies: .*the solver, which is closed"):
            history.plot("bodies")

    def test_a_load_curve_needs_no_energies(self):
        history = delam.Solver(support.double_cantilever()).history([0.5, 1.0], values=["reaction:opening"])
        figure = history.plot()
        x, y = figure.axes[0].lines[0].get_xydata().T
        np.testing.assert_allclose(x, [0, 3e-3, 6e-3])
        np.testing.assert_array_equal(y, history["reaction:opening"])
        plt.close(figure)

    def test_units(self):
        history = delam.Solver(support.double_cantilever()).history([0.5], ())
        for units, kind, words in (
                ({"lenght": "mm"}, delam.ArgumentError,
                 "units: 'lenght' is no quantity .did you mean 'length'..; these are length, force, time"),
                ("mm", TypeError, "units = 'mm' is a str, expected a mapping such as {'length': 'mm'"),
                ({"length": 1}, TypeError, r"units\['length'\] = 1 is a int, expected a str")):
            with self.assertRaisesRegex(kind, words):
                history.plot(units=units)


if __name__ == "__main__":
    support.main()
