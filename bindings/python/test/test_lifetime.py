# SPDX-License-Identifier: BSD-3-Clause
"""Ends of objects: in any order, by close, with, the collector, from inside callbacks and at the end of the process."""
import copy
import gc
import itertools
import pickle
import subprocess
import sys
import unittest
import weakref

import support

import delam
from delam._base.library import library


BEGIN = """import support, delam
problem = support.double_cantilever()
problem.set_law(0, support.host_bilinear())
solver = delam.Solver(problem)
solver.history([0.3], ())
"""


class Ends(unittest.TestCase):
    def test_any_order(self):
        for order in itertools.permutations(("mesh", "law", "problem", "solver")):
            things = {"problem": support.double_cantilever(divisions=10)}
            things["mesh"] = things["problem"].mesh
            things["law"] = support.bilinear()
            things["problem"].set_law(0, things["law"])
            things["solver"] = delam.Solver(things["problem"])
            for name in order:
                if "solver" in things and name != "solver":
                    things["solver"].advance(0.1)
                    things["solver"].rollback()
                things.pop(name).close()

    def test_the_solver_keeps_what_it_needs(self):
        def make():
            problem = support.double_cantilever()
            problem.set_law(0, support.host_bilinear())
            problem.set_law(0, support.host_bilinear())
            return delam.Solver(problem)

        solver = make()
        gc.collect()
        solver.problem.set_law(0, support.bilinear())
        solver.history([0.3, 0.6], ())
        self.assertGreater(solver.values["dissipated"], 0.0)

    def test_a_law_outlives_its_handle(self):
        problem = support.double_cantilever()
        law = support.host_bilinear()
        problem.set_law(0, law)
        law.close()
        del law
        gc.collect()
        solver = delam.Solver(problem)
        problem.close()
        solver.advance(1.0)

    def test_references_do_not_wait_for_the_collector(self):
        gc.disable()
        try:
            solver = delam.Solver(support.double_cantilever())
            history = solver.history([0.1])
            dict(solver.problem.options)
            ends = [weakref.ref(thing) for thing in (solver, solver.problem, solver.problem.mesh, solver.context)]
            del solver, history
            self.assertEqual([end() for end in ends], [None] * 4)
        finally:
            gc.enable()

    def test_closed_objects_say_so(self):
        problem = support.double_cantilever()
        solver = delam.Solver(problem)
        with solver as same:
            self.assertIs(same, solver)
        self.assertTrue(solver.closed)
        solver.close()
        for call in (lambda: solver.advance(1.0), lambda: solver.values["time"], solver.save, lambda: solver.plan,
                     lambda: solver.field("jump")):
            with self.assertRaisesRegex(delam.HandleError, "this Solver is closed"):
                call()
        mesh = delam.Mesh.layers(1.0, 1, [1.0], [1])
        mesh.close()
        with self.assertRaisesRegex(delam.HandleError, "this Mesh is closed"):
            delam.Problem(mesh)
        self.assertEqual((repr(mesh), repr(solver)), ("<Mesh, closed>", "<Solver, closed>"))

    def test_ends_inside_callbacks_wait(self):
        freed = []
        real = library.delam_solver_destroy
        problem = support.double_cantilever()
        other = [delam.Solver(problem)]
        finalizer = other[0]._finalizer

        def progress(stage, done, total):
            if other:
                other.clear()
                gc.collect()
                freed.append((finalizer.alive, len(problem.context._doomed)))

        problem.progress = progress
        solver = delam.Solver(problem)
        self.assertEqual(freed, [(False, 1)])
        self.assertEqual(len(problem.context._doomed), 0)
        solver.advance(0.1)
        self.assertIs(library.delam_solver_destroy, real)

    def test_copies_and_pickles(self):
        law = support.bilinear()
        with self.assertRaises(TypeError):
            copy.copy(law)
        # Whoever insists has an object that says it is closed.
        twin = object.__new__(delam.Law)
        vars(twin).update(vars(law))
        del law
        gc.collect()
        with self.assertRaises(delam.HandleError):
            twin.check()
        with self.assertRaises(TypeError):
            pickle.dumps(support.bilinear())

    def test_the_process_ends_in_peace(self):
        for tail in ("", "raise SystemExit(0)", "import gc; gc.disable(); cycle = [solver]; cycle.append(cycle)",
                     "import builtins; builtins.kept = solver", "del problem.mesh; mesh = None"):
            code = BEGIN + tail
            done = subprocess.run([sys.executable, "-X", "dev", "-c", code], cwd=support.HERE, capture_output=True,
                                  text=True)
            self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""), tail)


if __name__ == "__main__":
    support.main()
