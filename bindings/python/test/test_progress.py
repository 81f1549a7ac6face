# SPDX-License-Identifier: BSD-3-Clause
"""Progress: a bar of tqdm where it is installed, else a counter; on standard error either way."""
import contextlib
import importlib.util
import io
import sys
import unittest
from unittest import mock

import support
import numpy as np

import delam

TIMES = np.linspace(0.1, 0.5, 5)


def marched(progress):
    out, error = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(error):
        history = delam.Solver(support.double_cantilever()).history(TIMES, progress=progress)
    return len(history), out.getvalue(), error.getvalue()


class Bars(unittest.TestCase):
    def test_silence_unless_asked(self):
        self.assertEqual(marched(False), (6, "", ""))

    def test_counter_without_tqdm(self):
        with mock.patch.dict(sys.modules, {"tqdm": None, "tqdm.auto": None}):
            rows, out, error = marched(True)
        self.assertEqual((rows, out), (6, ""))
        self.assertTrue(error.endswith("step 5/5, to time 0.5 \n"))

    @unittest.skipUnless(importlib.util.find_spec("tqdm"), "tqdm is not installed")
    def test_bar(self):
        rows, out, error = marched(True)
        self.assertEqual((rows, out), (6, ""))
        self.assertIn("5/5", error)

    def test_stages(self):
        stages = []
        problem = support.double_cantilever(progress=lambda stage, done, total: stages.append(stage))
        solver = delam.Solver(problem)
        self.assertIn("factor", stages)
        solver.advance(1.0)
        self.assertIn("minimise", stages)
        before = len(stages)
        problem.progress = None
        solver.rollback()
        solver.advance(1.0)
        self.assertEqual(len(stages), before)


if __name__ == "__main__":
    support.main()
