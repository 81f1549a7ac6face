# SPDX-License-Identifier: BSD-3-Clause
"""The quick start of the README runs, and is quick to read."""
import contextlib
import io
import re
import unittest

import support
import numpy as np


class QuickStart(unittest.TestCase):
    def test_runs(self):
        text = (support.HERE.parent / "README.md").read_text(encoding="utf-8")
        (code,) = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
        self.assertLessEqual(len([line for line in code.splitlines() if line.strip()]), 22)
        out, names = io.StringIO(), {}
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(io.StringIO()):
            exec(compile(code, "README.md", "exec"), names)
        self.assertRegex(out.getvalue(), r"^peak load \d+\.\d+ N/m; crack 0\.05\d+ m\n$")
        # Beam theory: the crack of 30 mm grows where P^2 a^2 12 / (E' h^3) = Gc; arms not clamped at the tip give less.
        beam = np.sqrt(280.0 * 135e9 / (1 - 0.3 ** 2) * 1.5e-3 ** 3 / 12) / 0.03
        peak = names["history"]["reaction:opening"].max()
        self.assertTrue(0.85 * beam < peak < beam, (peak, beam))
        self.assertEqual(names["traction"].shape, (201, 2))


if __name__ == "__main__":
    support.main()
