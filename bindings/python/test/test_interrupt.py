# SPDX-License-Identifier: BSD-3-Clause
"""Ctrl-C, cancel and exceptions in callbacks: the call ends, the exception surfaces, the state is the one before."""
import os
import random
import signal
import sys
import threading
import time
import unittest
from unittest import mock

import support
import numpy as np

import delam
from delam._base.library import library


def at_poll(number, action):
    """A progress function that acts once, at that poll."""
    polls = []

    def progress(stage, done, total):
        polls.append(stage)
        return action() if len(polls) == number else None

    progress.polls = polls
    return progress


class Interrupts(unittest.TestCase):
    def setUp(self):
        self.lost = []
        self.hook, sys.unraisablehook = sys.unraisablehook, self.lost.append
        self.addCleanup(setattr, sys, "unraisablehook", self.hook)
        self.problem = support.double_cantilever()
        self.solver = delam.Solver(self.problem)
        self.solver.history([0.2, 0.4], ())
        self.before = self.solver.save()
        twin = delam.Solver(support.double_cantilever())
        twin.load(self.before)
        twin.advance(0.6)
        twin.commit()
        self.after = twin.save()

    def tearDown(self):
        """Whatever happened, the object is as it was, and goes on as if nothing had been."""
        self.problem.progress = None
        self.assertFalse(self.solver.pending)
        self.assertEqual(self.solver.save(), self.before)
        self.solver.advance(0.6)
        self.solver.commit()
        self.assertEqual(self.solver.save(), self.after)
        self.assertIs(signal.getsignal(signal.SIGINT), signal.default_int_handler)
        self.assertEqual(self.lost, [])

    def test_control_c_at_each_poll(self):
        count = at_poll(0, None)
        self.problem.progress = count
        self.solver.advance(0.6)
        self.solver.rollback()
        self.assertGreater(len(count.polls), 3)
        for number in range(1, len(count.polls) + 1):
            self.problem.progress = at_poll(number, lambda: signal.raise_signal(signal.SIGINT))
            with self.assertRaises(KeyboardInterrupt):
                self.solver.advance(0.6)
            self.assertEqual(self.solver.save(), self.before)

    def test_control_c_while_a_solver_is_made(self):
        self.problem.progress = at_poll(2, lambda: signal.raise_signal(signal.SIGINT))
        with self.assertRaises(KeyboardInterrupt):
            delam.Solver(self.problem)
        self.problem.progress = None
        delam.Solver(self.problem)

    def test_control_c_from_outside(self):
        generator = random.Random(1)
        for _ in range(25):
            solver = delam.Solver(self.problem)
            solver.load(self.before)
            delay = 0.02 * generator.random()
            outside = threading.Thread(target=lambda: (time.sleep(delay), os.kill(os.getpid(), signal.SIGINT)))
            with self.assertRaises(KeyboardInterrupt):
                outside.start()
                while True:
                    solver.advance(0.6)
                    solver.rollback()
            outside.join()
            if solver.pending:
                solver.rollback()
            self.assertEqual(solver.save(), self.before)
            solver.advance(0.6)
            solver.commit()
            self.assertEqual(solver.save(), self.after)

    def test_control_c_while_something_is_built_or_read(self):
        def interrupted(context, call):
            """The call stopped in its first look, so that nothing of it has been done; then undisturbed."""
            context.progress = at_poll(1, lambda: signal.raise_signal(signal.SIGINT))
            with self.assertRaises(KeyboardInterrupt):
                call()
            self.assertEqual(len(context.progress.polls), 1)
            context.progress = None
            return call()

        mesh = delam.Mesh.layers(0.1, 600, [1.5e-3, 1.5e-3], [2, 2])
        glue = interrupted(mesh.context, lambda: mesh.add_interface(0, 1))
        self.assertEqual((glue.index, mesh.interface_count), (0, 1))
        self.assertEqual(interrupted(mesh.context, lambda: mesh.find_patch(0, (0, 0), (0.1, 3e-3), "-y"))[0].size, 601)
        problem = delam.Problem(mesh, plane="plane-strain")
        problem.set_elastic(young=135e9, poisson=0.3)
        problem.set_law(glue, support.bilinear())
        left = mesh.find_nodes((0, 0), (0.1, 0))
        self.assertEqual(left.size, 601)
        interrupted(problem.context, lambda: problem.prescribe(left, "y"))
        problem.prescribe(mesh.find_nodes((0, 0), (0, 6e-3)), "x")
        problem.prescribe(mesh.find_node((0, 3e-3)), "y")
        interrupted(problem.context, problem.check)
        matrix = interrupted(problem.context, lambda: problem.body_matrix(0))
        body = np.flatnonzero(mesh.node_bodies == 0)
        interrupted(problem.context, lambda: problem.set_stiffness(body, matrix))
        self.assertEqual(interrupted(problem.context, problem.constraints)[0].shape[1], problem.dofs[0])
        solver = delam.Solver(problem)
        for read in (lambda: solver.field("stress"), solver.average, solver.condensed):
            with self.subTest(read=read):
                interrupted(problem.context, read)
        # Requests are consumed by what they stop: none waits for a step.
        solver.advance(1.0)

    def test_progress_that_says_stop(self):
        self.problem.progress = lambda stage, done, total: True
        with self.assertRaises(delam.Cancelled):
            self.problem.check()
        with self.assertRaises(delam.Cancelled):
            self.solver.advance(0.6)
        self.assertTrue(np.isfinite(self.solver.field("displacement")).all())

    def test_control_c_when_all_is_done_already(self):
        for name, make in (("delam_solver_advance", lambda: self.solver.advance(0.6)),
                           ("delam_solver_create", lambda: delam.Solver(self.problem))):
            function = getattr(library, name)

            def late(*arguments):
                status = function(*arguments)
                signal.raise_signal(signal.SIGINT)
                return status

            with mock.patch.object(library, name, late), self.assertRaises(KeyboardInterrupt):
                make()
            self.assertEqual(self.solver.time, 0.4)

    def test_control_c_in_a_march(self):
        self.problem.progress = at_poll(3, lambda: signal.raise_signal(signal.SIGINT))
        with self.assertRaises(KeyboardInterrupt):
            list(self.solver.march([0.6, 0.8]))

    def test_handlers_of_the_host(self):
        class Stop(Exception):
            pass

        def raising(number, frame):
            raise Stop

        calls = []
        for handler, kind in ((raising, Stop), (lambda number, frame: calls.append(number), None)):
            previous = signal.signal(signal.SIGINT, handler)
            try:
                self.problem.progress = at_poll(3, lambda: signal.raise_signal(signal.SIGINT))
                if kind is None:
                    self.solver.advance(0.6)
                    self.solver.rollback()
                else:
                    with self.assertRaises(kind):
                        self.solver.advance(0.6)
                self.assertIs(signal.getsignal(signal.SIGINT), handler)
            finally:
                signal.signal(signal.SIGINT, previous)
        self.assertEqual(calls, [signal.SIGINT])

    def test_a_handler_that_a_callback_installs_stays(self):
        former = []

        def own(number, frame):
            former[0](number, frame)

        def install():
            former.append(signal.signal(signal.SIGINT, own))

        previous = signal.getsignal(signal.SIGINT)
        try:
            self.problem.progress = at_poll(3, install)
            self.solver.advance(0.6)
            self.solver.rollback()
            self.assertIs(signal.getsignal(signal.SIGINT), own)
            # The one that it hands on to was the call's, which is over.
            with self.assertRaises(KeyboardInterrupt):
                signal.raise_signal(signal.SIGINT)
        finally:
            signal.signal(signal.SIGINT, previous)

    def test_ignored_signals_stay_ignored(self):
        previous = signal.signal(signal.SIGINT, signal.SIG_IGN)
        try:
            self.problem.progress = at_poll(3, lambda: signal.raise_signal(signal.SIGINT))
            self.solver.advance(0.6)
            self.solver.rollback()
        finally:
            signal.signal(signal.SIGINT, previous)

    def test_progress_cancels(self):
        self.problem.progress = at_poll(3, lambda: True)
        with self.assertRaisesRegex(delam.Cancelled, "cancelled by the host") as caught:
            self.solver.advance(0.6)
        self.assertEqual(caught.exception.status, 2)

    def test_progress_raises(self):
        class Mine(Exception):
            pass

        def trouble():
            raise Mine

        self.problem.progress = at_poll(3, trouble)
        with self.assertRaises(Mine):
            self.solver.advance(0.6)
        self.problem.progress = at_poll(1, sys.exit)
        with self.assertRaises(SystemExit):
            self.solver.advance(0.6)
        with self.assertRaisesRegex(delam.ArgumentError, "progress = 3 cannot be called"):
            self.problem.progress = 3

    def test_progress_that_calls_the_solver_is_refused(self):
        self.problem.progress = at_poll(2, lambda: self.solver.values["time"])
        with self.assertRaisesRegex(delam.StateError, "inside a callback"):
            self.solver.advance(0.6)

    def test_cancel_from_another_thread(self):
        begun, done = threading.Event(), threading.Event()

        def cancel():
            begun.wait()
            self.solver.cancel()
            done.set()

        def progress(stage, count, total):
            begun.set()
            done.wait()

        thread = threading.Thread(target=cancel)
        thread.start()
        self.problem.progress = progress
        with self.assertRaises(delam.Cancelled):
            self.solver.advance(0.6)
        thread.join()

    def test_a_request_waits_for_the_next_call(self):
        self.solver.cancel()
        with self.assertRaises(delam.Cancelled):
            self.solver.advance(0.6)


class Laws(unittest.TestCase):
    def scene(self, spy):
        problem = support.double_cantilever()
        problem.set_law(0, support.host_bilinear(spy=spy))
        return problem

    def test_exception_in_the_middle_of_a_step(self):
        calls, armed = [], []

        def spy(which):
            calls.append(which)
            if armed and len(calls) == armed[0]:
                raise ZeroDivisionError(which)

        problem = self.scene(spy)
        solver = delam.Solver(problem)
        solver.history([0.2, 0.4], ())
        before = solver.save()
        begin = len(calls)
        solver.advance(0.6)
        solver.rollback()
        number = len(calls) - begin
        self.assertGreater(number, 100)
        for which in (1, 2, number // 2, number):
            calls.clear()
            armed[:] = [which]
            with self.assertRaises(ZeroDivisionError):
                solver.advance(0.6)
            armed.clear()
            self.assertFalse(solver.pending)
            self.assertEqual(solver.save(), before)
        solver.advance(0.6)
        solver.commit()

    def test_the_step_ends_at_once(self):
        calls, raised = [], []

        def progress(stage, done, total):
            if stage == "minimise":
                raised.append(len(calls))
                raise LookupError

        problem = self.scene(calls.append)
        solver = delam.Solver(problem)
        problem.progress = progress
        calls.clear()
        with self.assertRaises(LookupError):
            solver.advance(1.0)
        self.assertEqual(raised, [len(calls)])
        problem.progress = None
        solver.advance(1.0)
        self.assertGreater(len(calls), 2 * raised[0] + 50)

    def test_control_c_inside_a_law(self):
        armed = []

        def spy(which):
            if armed:
                armed.clear()
                signal.raise_signal(signal.SIGINT)

        problem = self.scene(spy)
        law = support.host_bilinear(spy=spy)
        solver = delam.Solver(problem)
        for call in (law.check, problem.check, lambda: problem.set_law(0, law), lambda: law.respond([[1e-5, 0]], 0.0),
                     lambda: solver.advance(0.6)):
            armed.append(True)
            with self.assertRaises(KeyboardInterrupt):
                call()
            self.assertEqual(armed, [])
            call()

    def test_history_equals_that_of_the_library(self):
        times = np.linspace(0.1, 1.0, 10)
        ours = delam.Solver(self.scene(None)).history(times)
        theirs = delam.Solver(support.double_cantilever()).history(times)
        np.testing.assert_allclose(ours["reaction:opening"], theirs["reaction:opening"], rtol=1e-6)


if __name__ == "__main__":
    support.main()
