# SPDX-License-Identifier: BSD-3-Clause
"""GetFEM as the host (examples/host-getfem): its bodies give what the library's own do, and what it computes from the
displacements is what the library says. Prints the figures. Skipped without GetFEM."""
import importlib.util
import pathlib
import sys
import tempfile
import unittest

import support

HAVE = importlib.util.find_spec("getfem") is not None
if HAVE:
    sys.path.insert(0, str(support.ROOT / "examples" / "host-getfem"))
    import host_getfem
    import numpy as np

# Two assemblies of one body differ in rounding alone; slender arms and softening amplify it.
SAME = 1e-8


@unittest.skipUnless(HAVE, "GetFEM is not there (package python3-getfem)")
class GetFem(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.clock = host_getfem.Clock()

    def check_same(self, scene, steps, contracts):
        hosted, found = scene(self.folder, self.clock)
        print(f"\n{scene.__name__}: {host_getfem.sizes(hosted)}")
        for name, difference in found.items():
            print(f"    {name:22}{difference:8.1e}")
            with self.subTest(difference=name):
                self.assertLessEqual(difference, SAME)
        self.assertLessEqual(contracts, set(found))
        self.assertEqual(len(hosted.steps), steps)
        grown = [values["debonded_length"] for values, _ in hosted.steps]
        self.assertGreaterEqual(len(set(grown)), steps // 2, "the crack is to grow in half of the steps at least")
        return hosted

    def check_file(self, name, cells):
        """A picture with points of each cell's own, so that the two sides of the crack are two."""
        lines = (self.folder / f"{name}.vtu").read_text().splitlines()
        piece = next(line for line in lines if line.startswith("<Piece"))
        self.assertIn(f'NumberOfCells="{cells}"', piece)
        for field in ("displacement", "von_Mises_stress"):
            self.assertTrue(any(f'Name="{field}"' in line for line in lines), field)

    def test_enf(self):
        """Bodies of nodes and pairs alone."""
        hosted = self.check_same(host_getfem.enf, 20, {"reaction:press", "stored_bulk", "displacement", "adhesion",
                                                       "energy by the host", "reaction by the host",
                                                       "unbalanced forces"})
        self.assertEqual(hosted.problem.mesh.cell_count, 0)
        self.check_file("enf", 2 * 120 * 6)

    def test_dcb_in_space(self):
        """Cells are the library's too, rows are in the host's order."""
        hosted = self.check_same(host_getfem.dcb_3d, 12, {"reaction:open", "stored_bulk", "displacement", "adhesion",
                                                          "energy by the host", "reaction by the host",
                                                          "unbalanced forces", "stresses by the host"})
        self.assertFalse(np.array_equal(hosted.nodes, np.arange(len(hosted.nodes))), "no order was put to the test")
        self.check_file("dcb-3d", 6 * 45 * 6 * 4)

    def test_graded(self):
        """Cubic triangles with a graded modulus approach fracture mechanics."""
        # Arms of their mean modulus would grow the crack at a curvature 4 % lower.
        errors = []
        for cell, hosted, curvatures, growth in host_getfem.graded(self.folder, self.clock):
            plateau = curvatures[-5:]
            print(f"\ngraded, cells of {1e3 * cell:g} mm, {host_getfem.sizes(hosted)}: curvature over the exact one "
                  f"{plateau.min():.4f} to {plateau.max():.4f}, growth {growth[-5:].min():.4f} to "
                  f"{growth[-5:].max():.4f}")
            self.assertLess(np.ptp(plateau), 1e-3)
            self.assertLess(np.abs(growth[-5:] - 1.0).max(), 5e-3)
            errors.append(np.abs(plateau - 1.0).max())
            for values, fields in hosted.steps:
                self.assertLess(hosted.unbalanced(fields), SAME)
                self.assertAlmostEqual(hosted.arms.energy() / values["stored_bulk"], 1.0, delta=SAME)
        self.assertLess(errors[0], 8e-3)
        self.assertLess(errors[1], 2e-3)
        self.check_file("graded", 2 * 160 * 4 * 9)


if __name__ == "__main__":
    support.main()
