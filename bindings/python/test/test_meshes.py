# SPDX-License-Identifier: BSD-3-Clause
"""Meshes through meshio. Skipped without it."""
import importlib.util
import pathlib
import sys
import tempfile
import unittest
from unittest import mock

import support
import numpy as np

import delam

HAVE = importlib.util.find_spec("meshio") is not None
if HAVE:
    import meshio

POINTS = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [1, 2, 0], [0, 2, 0]], float)
GMSH = """$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
3
1 5 "edge"
2 7 "lower"
2 9 "upper"
$EndPhysicalNames
$Nodes
6
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
5 1 2 0
6 0 2 0
$EndNodes
$Elements
4
1 1 2 5 1 1 2
2 3 2 7 1 1 2 3 4
3 2 2 9 2 4 3 5
4 2 2 9 2 4 5 6
$EndElements
"""


class Without(unittest.TestCase):
    def test_it_is_named(self):
        with mock.patch.dict(sys.modules, {"meshio": None}), self.assertRaisesRegex(ImportError, "python3-meshio"):
            delam.Mesh.from_meshio("mesh.msh")


@unittest.skipUnless(HAVE, "meshio is not installed")
class Reading(unittest.TestCase):
    def test_gmsh(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "two.msh"
            file.write_text(GMSH, encoding="utf-8")
            for source in (file, str(file)):
                mesh = delam.Mesh.from_meshio(source)
        self.assertEqual((mesh.dimension, mesh.node_count, mesh.cell_count, mesh.body_count), (2, 8, 3, 2))
        self.assertEqual(mesh.body_names, {7: "lower", 9: "upper"})
        self.assertEqual([(i.body_a, i.body_b, i.pair_count) for i in mesh.interfaces], [(7, 9, 2)])

    def test_what_is_not_ours_is_refused(self):
        tilted = POINTS.copy()
        tilted[4, 2] = 0.1
        quads = [("quad", [[0, 1, 2, 3], [3, 2, 4, 5]])]
        for source, options, words in (
                (meshio.Mesh(POINTS, [("line", [[0, 1]])]), {}, "no cells of a known type; there are line"),
                (meshio.Mesh(POINTS, quads + [("triangle10", [[0, 1, 2, 3, 4, 5, 0, 1, 2, 3]])]), {}, "triangle10"),
                (meshio.Mesh(tilted, quads), {}, "shells"),
                (meshio.Mesh(POINTS, quads), {"bodies": "parts"}, "'parts' is no cell data")):
            with self.assertRaisesRegex((delam.MeshError, delam.ArgumentError), words):
                delam.Mesh.from_meshio(source, **options)

    def test_labels_by_name(self):
        source = meshio.Mesh(POINTS, [("quad", [[0, 1, 2, 3], [3, 2, 4, 5]])],
                             cell_data={"parts": [[3, 4]], "gmsh:physical": [[1, 1]]})
        self.assertEqual(delam.Mesh.from_meshio(source).body_count, 1)
        mesh = delam.Mesh.from_meshio(source, bodies="parts", interfaces=False)
        self.assertEqual((mesh.body_count, mesh.interface_count), (2, 0))

    def test_every_cell_type_goes_through_a_file(self):
        for kind in delam.CELLS:
            plane = kind in ("tri3", "quad4", "tri6", "quad8", "quad9")
            lengths, divisions = (1.0, 2) if plane else ((1.0, 1.0), (2, 1))
            mesh = delam.Mesh.layers(lengths, divisions, [0.5, 0.5], [1, 1], kind)
            mesh.add_interface(0, 1)
            with tempfile.TemporaryDirectory() as folder:
                file = pathlib.Path(folder) / "mesh.vtu"
                mesh.to_meshio({"place": np.arange(mesh.node_count)},
                               {"number": np.arange(mesh.cell_count)}).write(file)
                back = delam.Mesh.from_meshio(file)
            self.assertEqual(back.interface_count, 1, kind)
            np.testing.assert_array_equal(back.nodes, mesh.nodes, kind)
            np.testing.assert_array_equal(back.cells.connectivity, mesh.cells.connectivity, kind)
            np.testing.assert_array_equal(back.cells.bodies, mesh.cells.bodies, kind)

    def test_cell_sets_as_bodies(self):
        cells = [("line", [[0, 1]]), ("quad", [[0, 1, 2, 3], [3, 2, 4, 5]])]
        whole = {"edge": [[0], []], "lower": [[], [0]], "upper": [[], [1]]}
        mesh = delam.Mesh.from_meshio(meshio.Mesh(POINTS, cells, cell_sets=whole))
        self.assertEqual((mesh.body_count, mesh.interface_count), (2, 1))
        self.assertEqual(mesh.body_names, {0: "lower", 1: "upper"})
        self.assertEqual(mesh.cells.bodies.tolist(), [0, 1])
        mesh = delam.Mesh.from_meshio(meshio.Mesh(POINTS, cells, cell_sets=whole), bodies=["upper", "lower"])
        self.assertEqual((mesh.cells.bodies.tolist(), mesh.body_names), ([1, 0], {0: "upper", 1: "lower"}))
        # Sets that do not say for each cell where it belongs make no bodies, unless asked for.
        for sets in ({"lower": [[], [0]]}, {"lower": [[], [0, 1]], "all": [[], [0, 1]]}):
            source = meshio.Mesh(POINTS, cells, cell_sets=sets)
            self.assertEqual(delam.Mesh.from_meshio(source).body_count, 1)
            with self.assertRaisesRegex(delam.ArgumentError, "[12] cells are in none or in several of these sets"):
                delam.Mesh.from_meshio(source, bodies=list(sets))
        with self.assertRaisesRegex(delam.ArgumentError, "'middle' is no cell set; there are edge, lower, upper"):
            delam.Mesh.from_meshio(meshio.Mesh(POINTS, cells, cell_sets=whole), bodies=["middle"])

    def test_a_solver(self):
        solver = delam.Solver(support.double_cantilever())
        solver.history([0.5])
        mesh = solver.to_meshio()
        np.testing.assert_array_equal(mesh.point_data["displacement"][:, :2], solver.field("displacement"))
        np.testing.assert_array_equal(np.concatenate(mesh.cell_data["stress"]), solver.field("stress"))

    def test_data_of_the_wrong_length(self):
        mesh = delam.Mesh.layers(1.0, 2, [1.0], [1])
        with self.assertRaisesRegex(delam.ArgumentError, r"cell_data\['a'\] has 3 rows, expected 2"):
            mesh.to_meshio(cell_data={"a": [1, 2, 3]})


if __name__ == "__main__":
    support.main()
