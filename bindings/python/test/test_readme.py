# SPDX-License-Identifier: BSD-3-Clause
"""The first scene of the manual runs, and is quick to read; so does what it says of pictures and files."""
import contextlib
import importlib.util
import io
import os
import re
import tempfile
import unittest

import support
import numpy as np

READY = all(map(importlib.util.find_spec, ("matplotlib", "meshio")))


class FirstScene(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        text = (support.HERE.parent / "MANUAL.md").read_text(encoding="utf-8")
        cls.scene, cls.more = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
        out, cls.names = io.StringIO(), {}
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(io.StringIO()):
            exec(compile(cls.scene, "MANUAL.md", "exec"), cls.names)
        cls.printed = out.getvalue()

    def test_runs(self):
        self.assertLessEqual(len([line for line in self.scene.splitlines() if line.strip()]), 17)
        self.assertRegex(self.printed, r"^peak load \d+\.\d+ N/m; crack 0\.05\d+ m\n$")
        # Beam theory: the crack of 30 mm grows where P^2 a^2 12 / (E' h^3) = Gc; arms not clamped at the tip give less.
        beam = np.sqrt(280.0 * 135e9 / (1 - 0.3 ** 2) * 1.5e-3 ** 3 / 12) / 0.03
        peak = self.names["history"]["reaction:opening"].max()
        self.assertTrue(0.85 * beam < peak < beam, (peak, beam))

    @unittest.skipUnless(READY, "matplotlib or meshio is not installed")
    def test_pictures_and_files(self):
        import matplotlib
        matplotlib.use("Agg")
        before = os.getcwd()
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            try:
                exec(compile(self.more, "MANUAL.md", "exec"), self.names)
                self.assertEqual(sorted(os.listdir()), ["beam.png", "beam.vtu", "load.png"])
            finally:
                os.chdir(before)
        self.assertEqual(self.names["traction"].shape, (201, 2))
        self.assertEqual(len(self.names["table"]), 61)


if __name__ == "__main__":
    support.main()
