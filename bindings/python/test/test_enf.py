# SPDX-License-Identifier: BSD-3-Clause
"""The end-notched flexure test of examples/enf: the Python host writes the history that the C host writes."""
import io
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import support
import numpy as np

sys.path.insert(0, str(support.ROOT / "examples" / "enf"))

import enf  # noqa: E402


class TwoHosts(unittest.TestCase):
    def test_one_history(self):
        program = os.environ.get("DELAM_ENF")
        if not program:
            self.skipTest("the C host of the examples is not built")
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "enf.csv"
            subprocess.run([program, str(file)], check=True)
            c = file.read_text(encoding="utf-8")
        out = io.StringIO()
        history = enf.march()
        history.write_csv(out, [name.split(":")[0] for name in enf.VALUES])
        self.assertEqual(out.getvalue().splitlines()[0], c.splitlines()[0])
        ours, theirs = (np.loadtxt(io.StringIO(text), delimiter=",", skiprows=1) for text in (out.getvalue(), c))
        self.assertEqual(ours.shape, (41, len(enf.VALUES)))
        scale = np.abs(theirs).max(axis=0)
        self.assertLessEqual((np.abs(ours - theirs) / np.where(scale > 0, scale, 1)).max(), 1e-12)
        np.testing.assert_array_equal(history["step"], np.arange(41))
        self.assertGreater(history["dissipated"][-1], 0.0)


if __name__ == "__main__":
    support.main()
