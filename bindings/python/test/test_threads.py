# SPDX-License-Identifier: BSD-3-Clause
"""Threads: distinct problems side by side, one problem in turns."""
import sys
import threading
import unittest
from concurrent.futures import ThreadPoolExecutor

import support
import numpy as np

import delam

TIMES = np.linspace(0.05, 1.0, 20)


def march(divisions):
    return delam.Solver(support.double_cantilever(divisions)).history(TIMES)["reaction:opening"]


class Threads(unittest.TestCase):
    def test_distinct_problems(self):
        sizes = [40, 50, 60, 70] * 3
        with ThreadPoolExecutor(4) as pool:
            results = list(pool.map(march, sizes))
        for size, result in zip(sizes, results):
            np.testing.assert_array_equal(result, march(size))

    def test_the_interpreter_is_free_during_a_call(self):
        """A thread that is told that a call begins gets its turn while that lasts, in time to stop it. The interpreter
        itself takes no turns meanwhile, so it must be the call that gives it free."""
        mesh = delam.Mesh.layers(0.12, 1200, [3e-3, 3e-3], [30, 30])
        mesh.add_interface(0, 1)
        problem = delam.Problem(mesh)
        problem.set_elastic(75e9, 0.3)
        problem.set_law(0, support.bilinear())
        problem.prescribe(mesh.find_nodes((0, 0), (0, 6e-3)), "x")
        problem.prescribe(mesh.find_nodes((0, 0), (0, 6e-3)), "y")
        begins = threading.Event()

        def stop():
            begins.wait()
            problem.cancel()

        interval = sys.getswitchinterval()
        thread = threading.Thread(target=stop)
        thread.start()
        sys.setswitchinterval(1000.0)
        try:
            begins.set()
            with self.assertRaises(delam.Cancelled):
                delam.Solver(problem)
        finally:
            sys.setswitchinterval(interval)
            thread.join()

    def test_calls_side_by_side(self):
        """Two marches, each of which waits inside a call until the other is inside one too."""
        meeting = threading.Barrier(2, timeout=60)
        met = []

        def run():
            def progress(stage, done, total):
                if not here:
                    here.append(True)
                    met.append(meeting.wait())

            here = []
            problem = support.double_cantilever(progress=progress)
            return delam.Solver(problem).history(TIMES[:5])["reaction:opening"]

        with ThreadPoolExecutor(2) as pool:
            first, second = (pool.submit(run) for _ in range(2))
            np.testing.assert_array_equal(first.result(), second.result())
        self.assertEqual(sorted(met), [0, 1])

    def test_one_mesh_law_and_problem_in_turns(self):
        problem = support.double_cantilever()
        law = support.bilinear()
        expected = march(50)

        def run(_):
            own = delam.Problem(problem.mesh)
            own.set_elastic(1.0, 0.3)
            own.set_law(0, law)
            law.respond([[1e-5, 0.0]], 0.0)
            return delam.Solver(problem).history(TIMES)["reaction:opening"]

        with ThreadPoolExecutor(4) as pool:
            for result in pool.map(run, range(8)):
                np.testing.assert_array_equal(result, expected)

    def test_laws_by_python_in_threads(self):
        def run(_):
            problem = support.double_cantilever()
            problem.set_law(0, support.host_bilinear())
            return delam.Solver(problem).history(TIMES)["reaction:opening"]

        with ThreadPoolExecutor(2) as pool:
            first, second = pool.map(run, range(2))
        np.testing.assert_array_equal(first, second)

    def test_an_exception_stays_in_its_thread(self):
        def run(fails):
            def progress(stage, done, total):
                if fails and stage == "minimise":
                    raise LookupError
            problem = support.double_cantilever(progress=progress)
            solver = delam.Solver(problem)
            try:
                solver.history(TIMES)
            except LookupError:
                return True
            return False

        with ThreadPoolExecutor(4) as pool:
            self.assertEqual(list(pool.map(run, [True, False] * 4)), [True, False] * 4)


if __name__ == "__main__":
    support.main()
