# SPDX-License-Identifier: BSD-3-Clause
"""Meshes: what goes in comes out, and the array gate names what is wrong."""
import unittest

import support
import numpy as np

import delam
from delam._base import raw
from delam.mesh import CELL_TYPES
from delam.meshes import NAMES

SQUARES = np.array([[0, 0], [1, 0], [1, 1], [0, 1], [1, 2], [0, 2]], float)


class Arrays(unittest.TestCase):
    def test_conforming_cells_double_shared_nodes(self):
        mesh = delam.Mesh(SQUARES)
        mesh.add_conforming_cells("quad4", [[0, 1, 2, 3], [3, 2, 4, 5]], [7, 9])
        self.assertEqual((mesh.dimension, mesh.node_count, mesh.cell_count, mesh.body_count), (2, 8, 2, 2))
        np.testing.assert_array_equal(mesh.node_origins, [0, 1, 2, 3, 4, 5, 3, 2])
        np.testing.assert_array_equal(mesh.node_bodies, [7, 7, 7, 7, 9, 9, 9, 9])
        np.testing.assert_array_equal(mesh.nodes[[6, 7]], SQUARES[[3, 2]])
        (interface,) = mesh.add_all_interfaces()
        self.assertEqual((interface.body_a, interface.body_b, interface.pair_count), (7, 9, 2))
        np.testing.assert_allclose(interface.weights, [0.5, 0.5])
        np.testing.assert_array_equal(interface.places, [[0, 1], [1, 1]])
        np.testing.assert_allclose(interface.frames[:, 0], [[0, 1], [0, 1]])
        np.testing.assert_array_equal(mesh.nodes[interface.nodes_a], mesh.nodes[interface.nodes_b])
        np.testing.assert_array_equal(np.sort(interface.faces), [[0, 1]])

    def test_a_seam_has_pairs_up_to_its_tip(self):
        # Two rows of three cells. The upper one has nodes of its own on the left, 12 and 13; node 6 is the tip.
        nodes = [[x, y] for y in range(3) for x in range(4)] + [[0, 1], [1, 1]]
        mesh = delam.Mesh(np.array(nodes, float))
        mesh.add_cells("quad4", [[0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6],
                                 [12, 13, 9, 8], [13, 6, 10, 9], [6, 7, 11, 10]], 3)
        with self.assertRaisesRegex(ValueError, "tolerance"):
            mesh.add_seams(tolerance=0.5)
        (seam,) = mesh.add_seams()
        self.assertEqual((seam.body_a, seam.body_b, seam.pair_count), (3, 3, 2))
        np.testing.assert_array_equal([seam.nodes_a, seam.nodes_b], [[4, 5], [12, 13]])
        np.testing.assert_allclose(seam.weights, [0.5, 1.0])
        np.testing.assert_allclose(seam.frames[:, 0], [[0, 1], [0, 1]])
        np.testing.assert_array_equal(np.sort(seam.faces), [[0, 1]])
        self.assertEqual(mesh.add_seams(), [], "a second call")
        self.assertEqual(mesh.interface_count, 1)

    def test_the_walls_of_a_slot_are_in_contact(self):
        # Three rows of four cells, without the last two of the middle row: the walls of the slot are 1 apart.
        mesh = delam.Mesh(np.array([[x, y] for y in range(4) for x in range(5)], float))
        mesh.add_cells("quad4", [[n, n + 1, n + 6, n + 5] for n in (0, 1, 2, 3, 5, 6, 10, 11, 12, 13)], 3)
        with self.assertRaisesRegex(ValueError, "gap"):
            mesh.add_self_contact(0.0)
        self.assertEqual(mesh.add_self_contact(0.5), [])
        (walls,) = mesh.add_self_contact(1.1)
        self.assertEqual((walls.body_a, walls.body_b), (3, 3))
        np.testing.assert_allclose(np.abs(walls.frames[:, 0]), [[0, 1]] * walls.pair_count, atol=1e-12)
        self.assertEqual(mesh.interface_count, 1)

    def test_cell_types_are_those_of_the_library(self):
        numbers = {name: getattr(raw, f"DELAM_{name.upper()}") for name in delam.CELLS}
        self.assertEqual({name: number for name, (number, _) in delam.CELLS.items()}, numbers)
        self.assertEqual(delam.CELLS["hex20"][1], 20)
        self.assertEqual({name: cell.corners for name, cell in CELL_TYPES.items() if cell.dimension == 2},
                         {"tri3": 3, "quad4": 4, "tri6": 3, "quad8": 4, "quad9": 4})
        self.assertEqual(set(NAMES.values()), set(delam.CELLS), "names in meshio")

    def test_faces_and_middle_nodes_of_cell_types(self):
        for name, cell in CELL_TYPES.items():
            with self.subTest(name):
                self.assertEqual(cell.middle.shape, (cell.nodes - cell.corners, 2))
                # Every corner belongs to as many faces as the dimension, the apex of a pyramid to one more.
                self.assertEqual(np.bincount(np.concatenate(cell.faces))[:cell.corners].tolist(),
                                 [cell.dimension] * (cell.corners - 1) + [4 if name == "pyramid5" else cell.dimension])
                for face in cell.faces:
                    # The middle node of an edge of a face lies between the corners before and after it.
                    count = np.count_nonzero(face < cell.corners)
                    corners, between = face[:count], face[count:2 * count]
                    self.assertTrue(np.all(corners < cell.corners))
                    for k, node in enumerate(between):
                        ends = {int(corners[k]), int(corners[(k + 1) % len(corners)])}
                        self.assertEqual(set(cell.middle[node - cell.corners].tolist()), ends)
        self.assertEqual([face.tolist() for face in CELL_TYPES["quad4"].faces], [[0, 1], [1, 2], [2, 3], [3, 0]])

    def test_cells_come_out_by_type(self):
        mesh = delam.Mesh(SQUARES)
        mesh.add_cells("quad4", [[0, 1, 2, 3]])
        mesh.add_cells("tri3", [[3, 2, 4], [3, 4, 5]])
        cells = mesh.cells
        self.assertEqual(cells.names(), ["tri3", "quad4"])
        np.testing.assert_array_equal(cells.of("tri3"), [[3, 2, 4], [3, 4, 5]])
        np.testing.assert_array_equal(cells.of("quad4"), [[0, 1, 2, 3]])
        self.assertEqual(cells.of("hex8").shape, (0, 8))
        np.testing.assert_array_equal(cells.offsets, [0, 4, 7, 10])

    def test_any_layout_is_taken(self):
        for nodes in (SQUARES.tolist(), SQUARES.astype(np.float32), np.asfortranarray(SQUARES),
                      np.repeat(SQUARES, 2, 0)[::2], SQUARES.astype(np.int32)):
            np.testing.assert_array_equal(delam.Mesh(nodes).nodes, SQUARES)
        for cells in ([[0, 1, 2, 3]], np.array([[0, 1, 2, 3]], np.uint8), np.array([[0, 1, 2, 3]], np.int32)):
            mesh = delam.Mesh(SQUARES)
            mesh.add_cells("quad4", cells)
            np.testing.assert_array_equal(mesh.cells.connectivity, [0, 1, 2, 3])
        both = np.array([[0, 1, 2, 3], [3, 2, 4, 5]])
        for cells in (np.asfortranarray(both), np.repeat(both, 2, 0)[::2], both[:, ::-1].copy()[:, ::-1]):
            mesh = delam.Mesh(SQUARES)
            mesh.add_cells("quad4", cells)
            np.testing.assert_array_equal(mesh.cells.of("quad4"), both)

    def test_the_gate_names_the_argument(self):
        mesh = delam.Mesh(SQUARES)
        broken = SQUARES.copy()
        broken[4, 1] = np.nan
        for call, words in (
                (lambda: delam.Mesh(broken), r"nodes\[4, 1\] is nan"),
                (lambda: delam.Mesh(SQUARES[:, :1]), r"nodes has shape \(6, 1\), expected \(any, 2 or 3\)"),
                (lambda: delam.Mesh("abc"), "nodes has type <U3"),
                (lambda: delam.Mesh([["a", "b"]]), "nodes has type"),
                (lambda: delam.Mesh(SQUARES * 1j), "nodes has type complex128"),
                (lambda: delam.Mesh([[1, 2], [3]]), "nodes: .*inhomogeneous|nodes has type object"),
                (lambda: mesh.add_cells("quad4", [[0, 1, 2]]), r"connectivity has shape \(1, 3\), expected \(any, 4\)"),
                (lambda: mesh.add_cells("quad4", [[0.0, 1, 2, 3]]), "connectivity has type float64, expected integers"),
                (lambda: mesh.add_cells("quad4", np.array([[0, 1, 2, 2 ** 63]], np.uint64)),
                 r"connectivity\[0, 3\] = 9223"),
                (lambda: mesh.add_cells("quad", [[0, 1, 2, 3]]), "'quad' is no cell type; known are tri3"),
                (lambda: mesh.add_cells("quad4", [[0, 1, 2, 3]], [0, 1]), r"bodies has shape \(2,\)"),
                (lambda: mesh.add_cells("quad4", [[0, 1, 2, 3]], 2 ** 31), "does not fit into 32 bits"),
                (lambda: mesh.add_interface(0, 1.5), "body_b = 1.5 is no integer"),
                (lambda: mesh.find_nodes((0, 0, 0)), r"lower has shape \(3,\)")):
            with self.assertRaisesRegex(delam.ArgumentError, words):
                call()
        self.assertEqual(mesh.cell_count, 0)

    def test_errors_of_the_library(self):
        mesh = delam.Mesh(SQUARES)
        with self.assertRaisesRegex(delam.MeshError, "cell") as caught:
            mesh.add_cells("quad4", [[0, 3, 2, 1]])
        self.assertEqual((caught.exception.status, caught.exception.name), (-3, "DELAM_ERROR_MESH"))
        self.assertIsInstance(caught.exception, ValueError)
        with self.assertRaisesRegex(delam.ArgumentError, "6"):
            mesh.add_cells("quad4", [[0, 1, 2, 6]])
        self.assertEqual(mesh.cell_count, 0)


class Bodies(unittest.TestCase):
    def setUp(self):
        self.mesh = delam.Mesh(SQUARES)
        self.mesh.add_conforming_cells("quad4", [[0, 1, 2, 3], [3, 2, 4, 5]], [7, 9])

    def test_by_name(self):
        self.mesh.body_names = {7: "lower", 9: "upper"}
        interface = self.mesh.add_interface("lower", "upper")
        self.assertEqual((interface.body_a, interface.body_b), (7, 9))
        np.testing.assert_array_equal(self.mesh.find_nodes((0, 1), (1, 1), body="upper"), [6, 7])
        problem = delam.Problem(self.mesh)
        problem.set_elastic(1.0, 0.3, body="lower")
        with self.assertRaisesRegex(delam.ProblemError, "body 9"):
            problem.check()
        problem.set_elastic(2.0, 0.3, body="upper")
        np.testing.assert_allclose(problem.body_matrix("upper").toarray(), 2 * problem.body_matrix("lower").toarray())
        with self.assertRaisesRegex(delam.ArgumentError, "body = 'uper' is not the name of one body .did you mean "
                                                         "'upper'.*there are lower, upper"):
            problem.set_elastic(1.0, 0.3, body="uper")

    def test_labels_are_listed(self):
        with self.assertRaisesRegex(delam.ArgumentError, "body = 0: no body has this label; there are 7, 9"):
            delam.Problem(self.mesh).set_elastic(1.0, 0.3, body=0)
        self.mesh.body_names = {7: "lower"}
        with self.assertRaisesRegex(delam.ArgumentError, r"body_b = 8: .*there are 7 \(lower\), 9"):
            self.mesh.add_interface(7, 8)
        with self.assertRaisesRegex(delam.ArgumentError, "body = True is no integer"):
            self.mesh.find_nodes((0, 0), body=True)

    def test_a_problem_needs_no_open_mesh(self):
        problem = delam.Problem(self.mesh)
        self.mesh.close()
        problem.set_elastic(1.0, 0.3, body=7)
        with self.assertRaisesRegex(delam.ArgumentError, "body = 8: no body has this label"):
            problem.set_elastic(1.0, 0.3, body=8)
        with self.assertRaisesRegex(delam.ArgumentError, "nodes is empty, expected at least one node$"):
            problem.prescribe([], "x")


class Made(unittest.TestCase):
    def test_layers(self):
        for cells, lengths, nodes in (("quad4", 2.0, 2 * 3 * 2), ("quad8", 2.0, 2 * 13), ("hex8", (2.0, 1.0), 2 * 12)):
            divisions = 2 if cells != "hex8" else (2, 1)
            mesh = delam.Mesh.layers(lengths, divisions, [0.5, 0.5], [1, 1], cells)
            self.assertEqual(mesh.node_count, nodes, cells)
            self.assertEqual(mesh.body_count, 2)
            interface = mesh.add_interface(0, 1)
            self.assertAlmostEqual(interface.weights.sum(), 2.0)
            self.assertEqual(mesh.interfaces[0].index, interface.index)

    def test_finding(self):
        mesh = delam.Mesh.layers(2.0, 4, [0.5, 0.5], [1, 1])
        np.testing.assert_array_equal(mesh.find_nodes((0, 0), (2, 0)), range(5))
        self.assertEqual(len(mesh.find_nodes((1.0, 0.5))), 2)
        self.assertEqual(mesh.find_node((1.0, 0.5), body=0), 7)
        for call, words in (
                (lambda: mesh.find_node((1.0, 0.5)), r"\(1, 0.5\): 2 nodes are there, expected 1 \(7 of body 0, 12 of "
                                                     r"body 1\): give body="),
                (lambda: mesh.find_node((1.1, 0.5), body=1), r"\(1.1, 0.5\): 0 nodes of body 1 are there, expected 1; "
                                                             r"the nearest is node 12 at \(1, 0.5\), 0.1 away"),
                (lambda: mesh.find_patch(1, (0, 1), (2, 1), "-y"),
                 r"no face of body 1 from \(0, 1\) to \(2, 1\) has its outward normal within 45 degrees of direction "
                 r"\(0, -1\); the nodes lie from \(0, 0\) to \(2, 1\)")):
            with self.assertRaisesRegex(delam.ArgumentError, words):
                call()
        self.assertEqual(mesh.find_nodes((3, 3), body=0).size, 0)
        nodes, weights = mesh.find_patch(1, (0.0, 1.0), (1.25, 1.0), "y")
        self.assertAlmostEqual(weights.sum(), 1.25)
        self.assertEqual(len(nodes), len(weights))
        end, height = mesh.find_patch(None, (2.0, 0.0), (2.0, 1.0), "x")
        np.testing.assert_array_equal(end, mesh.find_nodes((2.0, 0.0), (2.0, 1.0)))
        np.testing.assert_allclose(height, 0.25)
        with self.assertRaisesRegex(delam.ArgumentError, "'z' is no axis; in 2D these are x, y"):
            mesh.find_patch(1, (0.0, 1.0), (1.25, 1.0), "z")

    def test_projection_ties_nodes(self):
        nodes = np.array([[0, 0], [1, 0], [1, 1], [0, 1], [0, 1], [0.5, 1], [1, 1], [0, 2], [0.5, 2], [1, 2]], float)
        mesh = delam.Mesh(nodes)
        mesh.add_cells("quad4", [[0, 1, 2, 3]], 0)
        mesh.add_cells("quad4", [[4, 5, 8, 7], [5, 6, 9, 8]], 1)
        interface = mesh.add_projected_interface(0, 1)
        ties = mesh.ties
        self.assertEqual(interface.pair_count, 3)
        self.assertEqual(len(ties.nodes), 3)
        np.testing.assert_allclose(np.add.reduceat(ties.weights, ties.starts[:-1]), 1.0)

    def test_mortar(self):
        nodes = np.array([[0, 0], [2, 0], [2, 1], [0, 1], [0, 1], [1, 1], [2, 1], [0, 2], [1, 2], [2, 2]], float)
        mesh = delam.Mesh(nodes)
        mesh.add_cells("quad4", [[0, 1, 2, 3]], 0)
        mesh.add_cells("quad4", [[4, 5, 8, 7], [5, 6, 9, 8]], 1)
        interface = mesh.add_mortar_interface(1, 0)
        self.assertEqual(interface.pair_count, 2)
        force = np.bincount(mesh.ties.of, mesh.ties.weights)[4:7]
        np.testing.assert_allclose(force, [0.5, 1.0, 0.5])

    def test_obstacle(self):
        mesh = delam.Mesh(np.vstack([SQUARES[:4], [[0.5, 3.0]]]))
        mesh.add_cells("quad4", [[0, 1, 2, 3]])
        obstacle = mesh.add_obstacle([2, 3], "-y", control_node=4)
        self.assertEqual((obstacle.body_a, obstacle.pair_count), (-1, 2))
        np.testing.assert_array_equal(obstacle.nodes_b, [2, 3])


if __name__ == "__main__":
    support.main()
