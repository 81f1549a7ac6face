# SPDX-License-Identifier: BSD-3-Clause
"""What an embedding host does: bodies of its own as sparse matrices, pairs that it knows, histories that it learns of
as it goes, tangents, the condensed operator, states as files."""
import os
import pathlib
import tempfile
import types
import unittest

import support
import numpy as np

import delam
from delam._base.library import library

try:
    from scipy import sparse
except ImportError:
    sparse = None

LAW = dict(normal_stiffness=1e13, tangential_stiffness=1e13, normal_onset=20.0, tangential_onset=40.0,
           normal_toughness=200.0, tangential_toughness=500.0)
ENDS = {"lift": 2.5e-4, "pull": -4e-5}


def strip_mesh():
    mesh = delam.Mesh.layers(0.03, 30, [1e-3, 1e-3], [1, 1])
    mesh.add_interface(0, 1)
    return mesh


def load(problem):
    """A strip peeled and sheared at its left end by two devices, its lower side held."""
    mesh = problem.mesh
    (interface,) = mesh.interfaces
    problem.set_law(interface, delam.Law("piecewise-linear", **LAW))
    problem.set_adhesion(interface, interface.places[:, 0] < 5.5e-3, 0.0)
    foot, tip = mesh.find_nodes((0, 0), (0.03, 0)), mesh.find_node((0, 2e-3))
    for axis, name in zip("yx", ENDS):
        problem.prescribe(foot, axis)
        problem.prescribe(tip, axis, problem.add_pattern(name, [0, 1], [0, ENDS[name]]))
    problem.options["damage_tolerance"] = 1e-11
    problem.options["kinematics"] = "linear"  # a stiffness that is given does not turn
    return problem


def strip(**options):
    problem = delam.Problem(strip_mesh())
    problem.set_elastic(70e9, 0.3)
    problem.options.update(options)
    return load(problem)


def without_cells(own):
    """Nodes and interfaces of a scene's mesh, its bodies without cells."""
    mesh = delam.Mesh(own.nodes)
    for body in np.unique(own.node_bodies):
        mesh.add_host_body(body, own.node_bodies == body)
    for known in own.interfaces:
        made = mesh.add_pairs(known.body_a, known.body_b, known.nodes_a, known.nodes_b, known.frames[:, 0],
                              known.weights, known.faces)
        np.testing.assert_array_equal(made.frames, known.frames)
        np.testing.assert_array_equal(made.faces, known.faces)
    return mesh


def with_scipys_names(matrix):
    return types.SimpleNamespace(indptr=matrix.row_starts.astype(np.int32), indices=matrix.columns.astype(np.int32),
                                 data=matrix.values)


class Bodies(unittest.TestCase):
    def setUp(self):
        self.own = strip()

    def same_reactions(self, problem):
        names = ["reaction:lift", "reaction:pull", "dissipated", "crack_length"]
        times = np.linspace(0.1, 1.0, 10)
        own = delam.Solver(self.own).history(times, names)
        other = delam.Solver(problem).history(times, names)
        for name in names:
            np.testing.assert_allclose(other[name], own[name], rtol=0, atol=1e-10 * abs(own[name]).max(), err_msg=name)
        self.assertGreater(own["dissipated"][-1], 0.0)

    def test_handed_over_they_give_the_same_reactions(self):
        for form in (lambda matrix: matrix, with_scipys_names):
            self.handed_over(form)

    def test_scipys_matrices(self):
        if sparse is None:
            self.skipTest("scipy is not installed")
        for name in ("csr", "csc", "coo", "bsr"):
            self.handed_over(lambda matrix: sparse.csr_matrix((matrix.values, matrix.columns, matrix.row_starts),
                                                              matrix.shape).asformat(name))

    def handed_over(self, form):
        mesh = without_cells(self.own.mesh)
        self.assertEqual(mesh.cell_count, 0)
        problem = delam.Problem(mesh)
        for body in (0, 1):
            problem.set_stiffness(mesh.node_bodies == body, form(self.own.body_matrix(body)))
        self.same_reactions(load(problem))

    def test_rows_in_an_order_of_the_hosts(self):
        mesh = without_cells(self.own.mesh)
        problem = delam.Problem(mesh)
        random = np.random.default_rng(1)
        for body in (0, 1):
            dense = self.own.body_matrix(body).toarray()
            size = len(dense)
            place = random.permutation(size)
            moved = np.empty_like(dense)
            moved[np.ix_(place, place)] = dense
            full = delam.Sparse(dense.shape, np.arange(size + 1) * size, np.tile(np.arange(size), size), moved.ravel())
            problem.set_stiffness(np.flatnonzero(mesh.node_bodies == body), full, dofs=place.reshape(-1, 2))
        self.same_reactions(load(problem))

    def test_a_kernel_that_is_told(self):
        mesh = without_cells(self.own.mesh)
        problem = delam.Problem(mesh)
        for body in (0, 1):
            nodes = np.flatnonzero(mesh.node_bodies == body)
            x, y = mesh.nodes[nodes].T
            motions = np.zeros((3, nodes.size, 2))
            motions[0, :, 0] = motions[1, :, 1] = 1.0
            motions[2] = np.column_stack([-y, x])
            problem.set_stiffness(nodes, self.own.body_matrix(body), kernel=motions.reshape(3, -1))
        self.same_reactions(load(problem))

    def test_what_needs_cells_is_not_known_without(self):
        mesh = without_cells(self.own.mesh)
        problem = delam.Problem(mesh)
        for body in (0, 1):
            problem.set_stiffness(mesh.node_bodies == body, self.own.body_matrix(body))
        solver = delam.Solver(load(problem))
        solver.advance(1.0)
        self.assertTrue(np.isnan(solver.values["rotation_max"]))
        own = delam.Solver(self.own)
        own.advance(1.0)
        self.assertGreater(own.values["rotation_max"], 0.0)

    def test_bodies_with_cells_may_have_it_too(self):
        problem = delam.Problem(strip_mesh())
        problem.set_elastic(1.0, 0.0)
        for body in (0, 1):
            problem.set_stiffness(problem.mesh.node_bodies == body, self.own.body_matrix(body))
        self.same_reactions(load(problem))

    def test_a_support_of_the_hosts(self):
        # A column on springs at both lower nodes: springs in series.
        young, spring, layer = 3.0, 5.0, 7.0
        mesh = delam.Mesh.layers(1.0, 1, [1.0, 1.0], [1, 1])
        interface = mesh.add_interface(0, 1)
        own = delam.Problem(mesh)
        own.set_elastic(young, 0.0)
        stiffness = own.body_matrix(0)
        nodes = np.flatnonzero(mesh.node_bodies == 0)
        rows = np.repeat(np.arange(stiffness.shape[0]), np.diff(stiffness.row_starts))
        grounded = np.repeat(mesh.nodes[nodes, 1] == 0.0, 2)[rows] & (rows == stiffness.columns)
        stiffness.values[grounded] += spring / 2
        top = mesh.find_nodes((0, 2), (1, 2))
        for kernel in (None, []):
            own.set_stiffness(nodes, stiffness, kernel=kernel)
            problem = own
            problem.set_law(interface, delam.Law("griffith", normal_stiffness=layer, tangential_stiffness=layer,
                                                 normal_toughness=1e9, tangential_toughness=1e9))
        problem.prescribe(top, "y", problem.add_pattern("lift", [0, 1], [0, 1]))
        solver = delam.Solver(problem)
        solver.advance(1.0)
        self.assertAlmostEqual(solver.values["reaction:lift"], 1 / (1 / spring + 2 / young + 1 / layer), places=12)

    def test_pairs_without_faces(self):
        own = self.own.mesh.interfaces[0]
        mesh = delam.Mesh(self.own.mesh.nodes)
        for body in (0, 1):
            mesh.add_host_body(body, self.own.mesh.node_bodies == body)
        made = mesh.add_pairs(0, 1, own.nodes_a, own.nodes_b, "y", 1e-3)
        np.testing.assert_array_equal(made.weights, np.full(31, 1e-3))
        np.testing.assert_array_equal(made.frames[:, 0], np.tile([0.0, 1.0], (31, 1)))
        self.assertEqual(made.faces.shape[0], 0)
        for call, words in ((lambda: mesh.add_pairs(0, 1, [0, 1], [62], "y", 1.0), r"nodes_b has shape \(1,\)"),
                            (lambda: mesh.add_pairs(0, 1, [0], [62], [[1, 0, 0]], 1.0), r"normals has shape \(1, 3\)"),
                            (lambda: mesh.add_pairs(0, 1, [0], [62], "y", 1.0, [0, 1]), r"faces has shape \(2,\)")):
            with self.assertRaisesRegex(delam.ArgumentError, words):
                call()
        with self.assertRaises(delam.MeshError):
            mesh.add_host_body(0, [0])

    def test_matrices_that_are_none(self):
        problem = delam.Problem(without_cells(self.own.mesh))
        nodes = problem.mesh.node_bodies == 0
        good = self.own.body_matrix(0)
        lopsided = good.values.copy()
        lopsided[1] *= 1.001
        for matrix, words in (
                (good.toarray(), "matrix is a ndarray, expected a delam.Sparse"),
                (good._replace(values=good.values[:-1]), r"columns has shape"),
                (good._replace(row_starts=good.row_starts[:-1]), r"row_starts has shape \(124,\), expected \(125,\)"),
                (good._replace(values=good.values[:-1], columns=good.columns[:-1]), r"row_starts\[124\]"),
                (good._replace(columns=good.columns * 1.0), "columns has type float64, expected integers"),
                (good._replace(values=lopsided), "not symmetric")):
            with self.assertRaisesRegex(delam.ArgumentError, words):
                problem.set_stiffness(nodes, matrix)
        for more, words in ((dict(kernel=[[1.0, 0.0]]), "kernel has shape"), (dict(dofs=[[0, 1]]), "dofs has shape")):
            with self.assertRaisesRegex(delam.ArgumentError, words):
                problem.set_stiffness(nodes, good, **more)
        with self.assertRaisesRegex(delam.ProblemError, "no cells and no stiffness"):
            problem.check()


class Marches(unittest.TestCase):
    def test_histories_told_on_the_way(self):
        for control, apart in (("fixed", 0.0), ("auto", 1e-9)):  # instants within a step have factors that are rounded
            problem = strip()
            problem.options["step_control"] = control
            known, told = delam.Solver(problem), delam.Solver(problem)
            for time in (0.3, 0.6, 1.0):
                told.set_history("lift", time, 9.0)
                told.set_history("lift", time, ENDS["lift"] * time)
                told.set_history(1, [time, time + 1], [ENDS["pull"] * time, 0.0])
                for solver in (known, told):
                    solver.advance(time)
                    solver.commit()
                size = abs(known.values["work"])
                energies = {"work", "dissipated", "stored_bulk", "reaction:lift"}
                same = set(known.values) if control == "fixed" else energies
                for key, value in known.values.items():
                    if key not in same:
                        continue
                    np.testing.assert_allclose(told.values[key], value, rtol=apart, atol=apart * size, err_msg=key)
        with self.assertRaisesRegex(delam.ArgumentError, "'push' is not known; known are lift, pull"):
            told.set_history("push", 2.0, 1.0)
        with self.assertRaisesRegex(delam.ArgumentError, r"values has shape \(1,\), expected \(2,\)"):
            told.set_history("lift", [2.0, 3.0], [1.0])
        told.advance(1.5)
        with self.assertRaises(delam.StateError):
            told.set_history("lift", 2.0, 1.0)

    def test_recorded_values_are_the_history(self):
        times = [0.3, 0.6, 1.0]
        history = delam.Solver(strip()).history(times, ["time", "reaction:lift", "front"])
        solver = delam.Solver(strip())
        solver.record("time", "reaction:lift")
        for time in times:
            solver.advance(time)
            self.assertEqual(len(solver.recorded_steps), len(solver.recorded("time")))
            solver.commit()
        solver.record("front")
        self.assertEqual(solver.recorded_steps, range(0, 4))
        for name in ("time", "reaction:lift"):
            np.testing.assert_array_equal(solver.recorded(name), history[name])
        np.testing.assert_array_equal(solver.recorded("front"), [np.nan, np.nan, np.nan, history["front"][-1]])
        other = delam.Solver(strip())
        other.load(solver.save())
        np.testing.assert_array_equal(other.recorded("time"), history["time"])
        with self.assertRaisesRegex(delam.ArgumentError, "'work' is not recorded.*time, reaction:lift, front"):
            solver.recorded("work")
        with self.assertRaisesRegex(delam.ArgumentError, "'kkt_gap'"):
            solver.record("kkt_gap")

    def test_matrices_are_those_of_c(self):
        """What they mean is tested in C (verify/cases/test_step_tangent.cpp)."""
        def of_c(function, *shapes):
            arrays = [np.full(shape, -1, np.int64 if whole else float) for shape, whole in shapes]
            size = arrays[0].size
            self.assertEqual(function(solver._handle, size, *(a.ctypes.data_as(kind) for a, kind in
                                                              zip(arrays, function.argtypes[2:]))), 0)
            return arrays

        solver, damaged = delam.Solver(strip()), False
        for time in np.linspace(0.1, 1.0, 10):
            solver.advance(time)
            tangent, held = solver.step_tangent(), solver.tangent()
            np.testing.assert_array_equal([tangent], of_c(library.delam_solver_step_tangent, ((2, 2), False)))
            np.testing.assert_array_equal([held], of_c(library.delam_solver_tangent, ((2, 2), False)))
            damaged = damaged or (tangent != held).any()
            solver.commit()
        self.assertTrue(damaged, "no step was damaged: the two tangents are one")
        with self.assertRaises(delam.StateError):
            solver.step_tangent()
        problem = strip()
        problem.add_forces(problem.add_pattern("press", [0, 1], [0, 1]), problem.mesh.find_node((0.012, 2e-3)),
                           (0.0, 2000.0))
        solver = delam.Solver(problem)
        problem.add_pattern("later", [0], [0])
        stiffness, load_, constant, jump, offset = solver.condensed()
        unknowns, rows = len(stiffness), solver.field("jump").size
        self.assertEqual((stiffness.shape, load_.shape, constant.shape, jump.shape, offset.shape),
                         ((unknowns,) * 2, (3, unknowns), (3, 3), (rows, unknowns), (rows, 3)))
        np.testing.assert_array_equal(jump.toarray().sum(axis=1), np.add.reduceat(jump.values, jump.row_starts[:-1]))
        given = stiffness, load_, constant, *jump[1:], offset
        for own, other in zip(given, of_c(library.delam_solver_condensed, *((a.shape, a.dtype == np.int64)
                                                                             for a in given))):
            np.testing.assert_array_equal(own, other)

    def test_feti_has_no_condensed_operator(self):
        with self.assertRaisesRegex(delam.StateError, "reduction = condensed"):
            delam.Solver(strip(reduction="feti")).condensed()

    def test_pending(self):
        solver = delam.Solver(strip())
        self.assertIs(solver.pending, False)
        solver.advance(0.1)
        self.assertIs(solver.pending, True)
        solver.load(delam.Solver(strip()).save())
        self.assertIs(solver.pending, False)
        solver.equilibrate(0.2)
        self.assertIs(solver.pending, True)
        solver.commit()
        self.assertIs(solver.pending, False)
        with self.assertRaises(delam.DelamError):
            solver.advance(0.1)
        self.assertIs(solver.pending, False)

    def test_threads(self):
        self.assertGreaterEqual(delam.blas_threads(), 0)
        one, two = (delam.Solver(strip(threads=threads)) for threads in (1, 2))
        for solver in (one, two):
            solver.history([0.5, 1.0], ())
        self.assertEqual(one.save(), two.save())


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_a_file_goes_on_like_its_bytes(self):
        solver = delam.Solver(strip())
        solver.history([0.4], ())
        for path in (self.folder / "état 1.state", str(self.folder / "2.state"), os.fsencode(self.folder / "3.state")):
            self.assertIsNone(solver.save(path))
            self.assertEqual(pathlib.Path(os.fsdecode(path)).read_bytes(), solver.save())
            again = delam.Solver(strip())
            again.advance(0.1)
            again.load(os.fsdecode(path))
            self.assertEqual((again.pending, again.time), (False, 0.4))
            self.assertEqual(again.save(), solver.save())
        self.assertEqual(len(list(self.folder.iterdir())), 3)

    def test_what_goes_wrong(self):
        solver = delam.Solver(strip())
        before = solver.save()
        nowhere = self.folder / "none" / "state"
        for call in (lambda: solver.save(nowhere), lambda: solver.load(nowhere), lambda: solver.save(self.folder),
                     lambda: solver.load(str(self.folder))):
            with self.assertRaisesRegex(delam.FileError, str(self.folder)) as caught:
                call()
            self.assertIsInstance(caught.exception, OSError)
            self.assertIsInstance(caught.exception, delam.DelamError)
            self.assertEqual((caught.exception.status, caught.exception.name), (-10, "DELAM_ERROR_FILE"))
        foreign = self.folder / "foreign"
        foreign.write_bytes(b"<?xml version='1.0'?>")
        with self.assertRaises(delam.SnapshotError):
            solver.load(foreign)
        for path, words in ((3, "path = 3 is a int"), ("a\0b", "zero character")):
            with self.assertRaisesRegex(delam.ArgumentError, words):
                solver.save(path)
        self.assertEqual(solver.save(), before)


if __name__ == "__main__":
    support.main()
