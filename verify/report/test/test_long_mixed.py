# SPDX-License-Identifier: BSD-3-Clause
"""Analyses of the library: the claims of chapter (h) hold for mixed-mode bending, and fail if the scene has a wrong
toughness in one mode."""
import os
import sys
import unittest

import planted

sys.path.insert(0, str(planted.REPORT / "cases"))
sys.path.insert(0, str(planted.REPORT.parent.parent / "bindings" / "python" / "src"))
import bending  # noqa: E402
import h_mixed  # noqa: E402
from test_mixed import RECORDED, HIGH, LOW, failed  # noqa: E402


@unittest.skipUnless(os.environ.get("DELAM_LIBRARY"), "DELAM_LIBRARY names no library")
class Analysed(unittest.TestCase):
    def judged(self, **more):
        import delam

        analyses = {}
        for steps in (100, 400):
            analyses[f"{steps} steps"] = bending.analyse(delam, bending.SPECIMENS["0.8"], 0.2e-3, steps, **more)
        return failed(h_mixed.judged("0.8", analyses, jumps=True))

    def test_the_right_scene_passes(self):
        self.assertEqual(self.judged(), set())

    def test_a_wrong_toughness_in_shear(self):
        for factor, side in ((1.2, HIGH), (0.8, LOW)):
            with self.subTest(factor=factor):
                self.assertEqual(self.judged(second=factor * bending.MODE_II), {side, RECORDED})

    def test_a_mixity_held_through_each_step(self):
        self.assertLessEqual({HIGH, RECORDED}, self.judged(mixity_rule="frozen"))

    def test_a_path_that_is_not_resolved(self):
        self.assertEqual(self.judged(path_step=1.0), {RECORDED})


if __name__ == "__main__":
    unittest.main()
