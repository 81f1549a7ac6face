# SPDX-License-Identifier: BSD-3-Clause
"""Meshes through meshio. Skipped without it."""
import contextlib
import importlib.util
import io
import logging
import pathlib
import sys
import tempfile
import unittest
from unittest import mock

import support
import numpy as np

import delam
from delam.mesh import CELL_TYPES, _distance
from delam.meshes import LABELS

HAVE = importlib.util.find_spec("meshio") is not None
if HAVE:
    import meshio

# Debian's meshio cannot hold cells of type wedge15.
IN_MESHIO = [kind for kind in delam.CELLS if kind != "wedge15"]
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

    def told(self, source, **options):
        """What the logger is told, by level, and the mesh."""
        with self.assertLogs("delam", logging.INFO) as caught:
            logging.getLogger("delam").info("one at least")
            mesh = delam.Mesh.from_meshio(source, **options)
        return [(record.levelname, record.getMessage()) for record in caught.records[1:]], mesh

    def test_what_was_taken_for_bodies(self):
        blocks = [("quad", [[0, 1, 2, 3]]), ("quad", [[3, 2, 4, 5]])]
        for data, level, words, bodies in (
                ({"zones": [[3], [4]], "number": [[0.5], [1.5]]}, "WARNING", "may be in zones: bodies='zones'", 1),
                ({"zones": [[3], [4]], "material": [[1.0], [2.0]]}, "INFO",
                 "those of cell data 'material'; bodies= takes others: zones", 2),
                ({"part": [[7], [9]], "same": [[1], [1]]}, "INFO", "the bodies are those of cell data 'part'$", 2),
                ({}, "INFO", "all cells make one body: the mesh has no labels", 1)):
            lines, mesh = self.told(meshio.Mesh(POINTS, blocks, cell_data=data))
            self.assertEqual((len(lines), lines[0][0], mesh.body_count), (1, level, bodies))
            self.assertRegex(lines[0][1], words)
        self.assertEqual(self.told(meshio.Mesh(POINTS, blocks, cell_data={"zones": [[3], [4]]}), bodies="zones")[0], [])
        sets = {"lower": [[0], []], "upper": [[], [0]]}
        self.assertIn("the bodies are the cell sets lower, upper",
                      self.told(meshio.Mesh(POINTS, blocks, cell_sets=sets))[0][0][1])
        ((level, line),), mesh = self.told(meshio.Mesh(POINTS, blocks, cell_sets={"lower": [[0], []]}))
        self.assertEqual((level, mesh.body_count), ("WARNING", 1))
        self.assertIn("none or in several of the cell sets lower", line)
        for name in LABELS:
            self.assertIn(name, delam.meshes.read.__doc__)
            mesh = delam.Mesh.from_meshio(meshio.Mesh(POINTS, blocks, cell_data={name: [[3], [4]]}))
            self.assertEqual(mesh.body_count, 2, name)

    def test_labels_are_integers(self):
        blocks = [("quad", [[0, 1, 2, 3], [3, 2, 4, 5]])]
        for values, words in (([2.0, 2.5], "'part' of cell 1 is 2.5; labels of bodies are integers"),
                              ([[1, 2], [3, 4]], r"'part' has shape \(2, 2\)")):
            with self.assertRaisesRegex(delam.ArgumentError, words):
                delam.Mesh.from_meshio(meshio.Mesh(POINTS, blocks, cell_data={"part": [values]}), bodies="part")
        mesh = delam.Mesh.from_meshio(meshio.Mesh(POINTS, blocks, cell_data={"part": [[2.0, 3.0]]}))
        self.assertEqual(mesh.cells.bodies.tolist(), [2, 3])

    def test_cells_are_turned_round(self):
        for kind in IN_MESHIO:
            plane = CELL_TYPES[kind].dimension == 2
            mesh = delam.Mesh.layers(*((1.0, 2) if plane else ((1.0, 1.0), (2, 1))), [0.5, 0.5], [1, 1], kind)
            theirs = mesh.to_meshio()
            right = theirs.cells[0].data
            blocks = [(theirs.cells[0].type, right)]
            # A mirror turns every cell inside out, wherever its nodes stand in it.
            mirrored = meshio.Mesh(theirs.points * [-1, 1, 1], blocks, cell_data=theirs.cell_data)
            lines, back = self.told(mirrored)
            found = [line for _, line in lines if "turned round" in line]
            words = "clockwise" if plane else "as by Gmsh and Abaqus" if kind.startswith("wedge") else "inside out"
            count = len(right)
            self.assertEqual(found, [f"{count} of {count} cells of type {kind} were numbered {words} and were turned "
                                     f"round"])
            np.testing.assert_array_equal(np.sort(back.cells.connectivity.reshape(right.shape), 1), np.sort(right, 1))
            self.assertTrue((back.cells.connectivity.reshape(right.shape) != right).any(1).all())
            # The library has checked corners; these are the nodes between them.
            nodes, cell = back.nodes, CELL_TYPES[kind]
            for row in back.cells.of(kind):
                ends = nodes[row[cell.middle]].mean(1) if len(cell.middle) else np.empty((0, back.dimension))
                np.testing.assert_allclose(nodes[row[cell.corners:]], ends, atol=1e-14)
            self.assertEqual(self.told(meshio.Mesh(theirs.points, blocks))[0],
                             [("INFO", "all cells make one body: the mesh has no labels")])

    def test_bodies_that_touch_nowhere(self):
        mesh = delam.Mesh.layers(1.0, 4, [0.5, 0.5, 0.5], [1, 2, 2])
        source = mesh.to_meshio()
        source.points[mesh.node_bodies == 2, 1] += 3e-4
        (_, (level, line)), back = self.told(source)
        self.assertEqual((level, back.interface_count), ("WARNING", 1))
        self.assertIn("no interface was made for body 2, whose faces coincide with none of another body; the nearest "
                      "nodes of body 2 and of others are 0.0003 apart", line)
        self.assertEqual(len(self.told(source, interfaces=False)[0]), 1)
        self.assertEqual(len(self.told(mesh.to_meshio())[0]), 1)
        generator = np.random.default_rng(3)
        one, other = generator.random((40, 2)), generator.random((300, 2)) + [1.1, 0]
        exact = min(np.linalg.norm(other - place, axis=1).min() for place in one)
        self.assertEqual(_distance(one, other), exact)
        far = np.column_stack([np.linspace(0, 1, 6000), np.zeros(6000)])
        # Not all of these are looked at first, and not the ends, which are nearest.
        near = np.column_stack([far[:, 0], 0.25 - 0.1 * far[:, 0]])
        self.assertEqual(_distance(far, near), 0.25 - 0.1)

    def test_every_cell_type_goes_through_a_file(self):
        with mock.patch.object(meshio, "Mesh", side_effect=KeyError("wedge15")), self.assertRaisesRegex(
                delam.ArgumentError, "this meshio has no cells of type 'wedge15'; to_vtk.. has"):
            delam.Mesh.layers((1.0, 1.0), (2, 1), [0.5, 0.5], [1, 1], "wedge15").to_meshio()
        for kind in IN_MESHIO:
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
            np.testing.assert_array_equal(back.nodes[:mesh.node_count], mesh.nodes, kind)  # new tied nodes follow
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

    def test_groups_of_med(self):
        """SALOME numbers families -1, -2 .., and a cell in two groups has a family of its own."""
        cells = [("line", [[0, 1]]), ("quad", [[0, 1, 2, 3], [3, 2, 4, 5]])]

        def med(families, groups):
            source = meshio.Mesh(POINTS, cells, cell_data={"cell_tags": [np.array([-3]), np.array(families)]})
            source.cell_tags = {-3: ["edge"], **groups}
            with tempfile.TemporaryDirectory() as folder:
                file = pathlib.Path(folder) / "two.med"
                source.write(file)
                return meshio.read(file)

        two = med([-7, -6], {-6: ["upper"], -7: ["lower"]})
        lines, mesh = self.told(two)
        self.assertEqual((mesh.body_names, mesh.interface_count), ({0: "upper", 1: "lower"}, 1))
        self.assertEqual(mesh.cells.bodies.tolist(), [1, 0])
        self.assertIn("the bodies are the cell sets upper, lower", lines[0][1])
        mesh = delam.Mesh.from_meshio(two, bodies=["lower", "upper"])
        self.assertEqual(mesh.cells.bodies.tolist(), [0, 1])
        several = med([-7, -6], {-6: ["plies", "upper"], -7: ["plies"]})
        lines, mesh = self.told(several)
        self.assertEqual(mesh.body_names, {0: "plies, upper", 1: "plies"})
        self.assertIn("families of cells in the same groups", lines[0][1])
        partly = med([0, -6], {-6: ["upper"]})
        self.assertEqual(delam.Mesh.from_meshio(partly).body_names, {1: "upper"})
        bare = delam.Mesh.from_meshio(meshio.Mesh(POINTS, cells, cell_data={"cell_tags": [[-3], [-7, -6]]}))
        self.assertEqual(bare.cells.bodies.tolist(), [1, 0])

    def test_files_that_meshio_cannot_read(self):
        """It ends the program for some of them, and prints."""
        with tempfile.TemporaryDirectory() as folder:
            for name, text, words in (("a.vtu", "hello", "cannot read it: .*vtu"), ("a.bdf", "hello", "BEGIN BULK"),
                                      ("a.msh", "hello\n", "cannot read it: .*ansys, gmsh"),
                                      ("a.foo", "hello", "file format"), ("a.med", "hello", "cannot read it: OSError"),
                                      ("none.vtu", None, "no such file")):
                file = pathlib.Path(folder) / name
                if text is not None:
                    file.write_text(text, encoding="utf-8")
                said = io.StringIO()
                with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said), \
                        self.assertRaisesRegex(delam.FileError, f"{name}: .*{words}"):
                    delam.Mesh.from_meshio(file)
                self.assertEqual(said.getvalue(), "", name)

    def test_twenty_meshes(self):
        """Two blocks of each cell type through each format that keeps labels."""
        formats = {"vtu": "part", "vtk": "part", "xdmf": "part", "med": "cell_tags", "bdf": "nastran:ref",
                   "mesh": "medit:ref", "avs": "avsucd:material", "dat": "material"}
        count = 0
        for kind in ("quad4", "tri3", "hex8", "tet4"):
            plane = CELL_TYPES[kind].dimension == 2
            given = delam.Mesh.layers(*((1.0, 2) if plane else ((1.0, 1.0), (2, 1))), [0.5, 0.5], [1, 1], kind)
            for ending, name in formats.items():
                source = given.to_meshio(cell_data={name: given.cells.bodies + 1})
                source.cell_data = {name: source.cell_data[name]}
                flat = np.zeros((len(source.points), 3 - source.points.shape[1]))
                source.points = np.column_stack([source.points, flat])
                with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(io.StringIO()), \
                        contextlib.redirect_stderr(io.StringIO()):
                    file = pathlib.Path(folder) / f"two.{ending}"
                    source.write(file)
                    mesh = delam.meshes.read(file)
                where = f"{kind} in {ending}"
                self.assertEqual((mesh.body_count, mesh.interface_count), (2, 1), where)
                self.assertEqual(mesh.cell_count, given.cell_count, where)
                np.testing.assert_allclose(mesh.nodes, given.nodes, atol=1e-12, err_msg=where)
                count += 1
        self.assertGreaterEqual(count, 20)

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
