# SPDX-License-Identifier: BSD-3-Clause
"""Objects of the library are neither pickled nor copied: they say so, and what to do instead; and that works."""
import copy
import multiprocessing
import pickle
import unittest

import support
import numpy as np

import delam


def continued(state):
    """In another process: an equal problem, from the state on."""
    solver = delam.Solver(support.double_cantilever())
    solver.load(state)
    history = solver.history(np.linspace(0.6, 1.0, 5))
    return history["reaction:opening"], solver.save()


class Refused(unittest.TestCase):
    def test_messages(self):
        problem = support.double_cantilever()
        solver = delam.Solver(problem)
        for thing, words in ((problem.mesh, "to_meshio"), (support.bilinear(), "kind and parameters"),
                             (problem, "Solver.save()"), (solver, "load() them into a Solver of an equal problem")):
            kind = type(thing).__name__
            for what, attempt in (("pickled", pickle.dumps), ("copied", copy.copy), ("copied", copy.deepcopy),
                                  ("pickled", lambda thing: pickle.dumps([thing], protocol=2))):
                with self.subTest(kind, what=what), self.assertRaises(TypeError) as caught:
                    attempt(thing)
                self.assertIn(f"a {kind} cannot be {what}: ", str(caught.exception))
                self.assertIn(words, str(caught.exception))
                self.assertNotIn("ctypes", str(caught.exception))
        # Whatever holds one, too.
        for thing in (problem.mesh.interfaces[0], problem.options):
            with self.subTest(type(thing).__name__), self.assertRaisesRegex(TypeError, "cannot be pickled: its data"):
                pickle.dumps(thing)
        with self.assertRaisesRegex(TypeError, r"Values read the solver .*: use dict\(solver.values\)"):
            pickle.dumps(solver.values)

    def test_results_can_be_pickled(self):
        problem = support.double_cantilever()
        solver = delam.Solver(problem)
        solver.history(np.linspace(0.1, 1.0, 10))
        for thing in (solver.fronts(0), solver.average(), solver.values.describe(), problem.body_matrix(0),
                      problem.mesh.cells):
            again = pickle.loads(pickle.dumps(thing))
            self.assertEqual(repr(again), repr(thing))
            self.assertEqual(repr(copy.deepcopy(thing)), repr(thing))
        pattern = pickle.loads(pickle.dumps(problem.add_pattern("more", [0, 1], [0, 1])))
        self.assertEqual((pattern.name, pattern.index), ("more", 1))

    def test_a_history_leaves_its_solver_behind(self):
        solver = delam.Solver(support.double_cantilever())
        history = solver.history(np.linspace(0.1, 0.5, 5))
        for again in (pickle.loads(pickle.dumps(history)), copy.copy(history), copy.deepcopy(history)):
            np.testing.assert_array_equal(again.array, history.array)
            self.assertEqual((again.names, again.closing, repr(again)),
                             (history.names, history.closing, repr(history)))
            with self.assertRaisesRegex(delam.StateError, "no solver to record"):
                again.record()
        again = copy.copy(history)
        solver.advance(1.0)
        solver.commit()
        history.record()
        self.assertEqual((len(again), len(history)), (6, 7))

    def test_fields_can_be_pickled(self):
        fields = delam.Fields(3, 0.5, {"stress": np.eye(6), "interface_0": {"zeta": np.ones(4)}})
        again = pickle.loads(pickle.dumps(fields))
        self.assertEqual((again.step, again.time, list(again)), (3, 0.5, ["stress", "interface_0"]))
        np.testing.assert_array_equal(again["interface_0"]["zeta"], np.ones(4))

    def test_errors_can_be_pickled(self):
        with self.assertRaises(delam.DelamError) as caught:
            delam.Mesh.layers(1.0, 0, [1.0], [1])
        error = caught.exception
        again = pickle.loads(pickle.dumps(error))
        self.assertEqual((type(again), str(again), again.status, again.name),
                         (type(error), str(error), error.status, error.name))


class Instead(unittest.TestCase):
    def test_a_state_goes_to_another_process(self):
        solver = delam.Solver(support.double_cantilever())
        solver.history(np.linspace(0.1, 0.5, 5))
        state = solver.save()
        here = continued(pickle.loads(pickle.dumps(state)))
        with multiprocessing.get_context("spawn").Pool(1) as pool:
            there = pool.apply(continued, (state,))
        np.testing.assert_array_equal(there[0], here[0])
        self.assertEqual(there[1], here[1])


if __name__ == "__main__":
    support.main()
