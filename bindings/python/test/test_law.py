# SPDX-License-Identifier: BSD-3-Clause
"""Laws: by keyword, and by Python functions."""
import signal
import unittest

import support
import numpy as np

import delam
from delam.law import kinds

NUMBERS = dict(normal_stiffness=1e12, tangential_stiffness=1e12, normal_onset=50.0, tangential_onset=50.0,
               normal_toughness=280.0, tangential_toughness=280.0)


class Parameters(unittest.TestCase):
    def test_law_describes_itself(self):
        self.assertEqual(repr(delam.Law("exponential")), "<Law 'exponential'>")
        self.assertEqual(repr(delam.Law.host("mine", lambda b, y: (1.0, 0.0), lambda b, z: (0.0, 0.0, 0.0))),
                         "<Law 'host'>")

    def test_kinds_describe_themselves(self):
        known = delam.Law.parameters("trapezoidal")
        self.assertEqual(known["plateau"].type, "real")
        self.assertEqual(known["normal_stiffness"].unit, "F/L3")
        self.assertEqual(known["normal_stiffness"].initial, "")
        for make in (delam.Law, delam.Law.parameters, delam.Law.bounds):
            for kind, words in (("bilinear", r" \(piecewise-linear is the bilinear law\)"), ("zzz", ""),
                                ("exponental", r" \(did you mean 'exponential'\?\)")):
                with self.assertRaisesRegex(delam.ArgumentError, f"'{kind}' is not known{words}; known are piece"):
                    make(kind)
        with self.assertRaisesRegex(delam.ArgumentError, "kind = 'host' needs callbacks: use Law.host$"):
            delam.Law("host")
        self.assertIn("Law.host", kinds()["host"])

    def test_missing_parameters(self):
        law = delam.Law("trapezoidal", normal_stiffness=1e12, normal_onset=50.0, tangential_onset=50.0)
        problem = support.double_cantilever()
        before = problem.hash
        for use in (law.check, lambda: law.respond([[0.0, 0.0]], 0.0), lambda: problem.set_law(0, law)):
            with self.assertRaisesRegex(delam.ProblemError, r"^law 'trapezoidal': tangential_stiffness \(finite and > 0"
                                                            r"\), normal_toughness .*, plateau \(>= 0 and < 1\) are "
                                                            r"missing$"):
                use()
        self.assertEqual(problem.hash, before)
        law.set(tangential_stiffness=1e12, normal_toughness=280.0, tangential_toughness=280.0)
        with self.assertRaisesRegex(delam.ProblemError, "^law 'trapezoidal': plateau .* is missing$"):
            law.check()
        law.set(plateau=0.5)
        law.check()
        # A strength is another way to give an onset.
        strengths = {key: value for key, value in NUMBERS.items() if "onset" not in key}
        for law in (delam.Law("exponential", **strengths, normal_strength=1e7, tangential_strength=1e7),
                    delam.Law("griffith", **strengths)):
            law.check()
        with self.assertRaisesRegex(delam.ProblemError, "normal_onset or normal_strength .* is missing"):
            delam.Law("exponential", **strengths, tangential_strength=1e7).check()

    def test_kinds_and_bounds(self):
        kinds = delam.Law.kinds()
        self.assertEqual(list(kinds)[0], "piecewise-linear")
        self.assertIn("callbacks", kinds["host"])
        bounds = delam.Law.bounds("trapezoidal")
        self.assertEqual(bounds["plateau"], (0.0, 1.0, False, True))
        self.assertEqual([value in bounds["plateau"] for value in (-0.1, 0.0, 0.9, 1.0)], [False, True, True, False])
        self.assertEqual(bounds["normal_stiffness"], (0.0, np.inf, True, True))
        self.assertNotIn("criterion", bounds)
        for kind in kinds:
            texts = {"criterion", "onset_criterion"}
            self.assertEqual(set(delam.Law.bounds(kind)) | texts, set(delam.Law.parameters(kind)) | texts)
        with self.assertRaises(delam.ArgumentError):
            delam.Law.bounds("bilinear")

    def test_texts_come_before_numbers(self):
        law = delam.Law("exponential", **{**NUMBERS, "tangential_toughness": 560.0}, toughness_exponent=1.0,
                        criterion="benzeggagh-kenane")
        np.testing.assert_allclose(law.toughness([0.0, 0.5, 1.0])[1], [280.0, 420.0, 560.0])

    def test_mistakes(self):
        for call, kind, words in (
                (lambda: delam.Law("linear"), delam.ArgumentError, "linear"),
                (lambda: delam.Law("exponential", stiffness=1.0), delam.ArgumentError, "stiffness"),
                (lambda: delam.Law("exponential", normal_onset=-1.0), delam.ArgumentError, "normal_onset"),
                (lambda: delam.Law("exponential", normal_onset="high"), delam.ArgumentError, "normal_onset"),
                (lambda: delam.Law("exponential", normal_onset=[]), delam.ArgumentError, "normal_onset"),
                (lambda: delam.Law("exponential", normal_onset=None), delam.ArgumentError,
                 "normal_onset = None is no number"),
                (lambda: delam.Law("tabulated", softening=[0, 1, 2]), delam.ArgumentError, r"\(xi, s\)"),
                (lambda: delam.Law("tabulated", softening=([0, 1], [1])), delam.ArgumentError,
                 r"softening\[1\] has shape"),
                (lambda: delam.Law("exponential", normal_stiffness=1.0).check(), delam.ProblemError, "tangential")):
            with self.assertRaisesRegex(kind, words):
                call()

    def test_tabulated_is_the_bilinear_law(self):
        law = delam.Law("tabulated", **NUMBERS, softening=([0, 0.5, 1], [1, 0.5, 0]))
        jump = np.column_stack([np.linspace(0, 1.2e-4, 20), np.zeros(20)])
        adhesion, traction = law.respond(jump, 0.0)
        other, _ = support.bilinear().respond(jump, 0.0)
        np.testing.assert_allclose(adhesion, other, atol=1e-12)
        np.testing.assert_allclose(traction[:, 0], adhesion * 1e12 * jump[:, 0])


class Mine(Exception):
    pass


def fails_in(trouble):
    """A spy of host_bilinear whose law fails as long as `trouble` is not empty."""
    def spy(which):
        if trouble:
            raise Mine(which)
    return spy


class Host(unittest.TestCase):
    def test_equals_the_law_of_the_library(self):
        jump = np.column_stack([np.linspace(0, 1.2e-4, 50), np.full(50, 1e-6)])
        law = support.host_bilinear()
        law.check()
        np.testing.assert_allclose(law.respond(jump, 0.0)[0], support.bilinear().respond(jump, 0.0)[0], atol=1e-10)

    def test_an_exception_surfaces_after_the_call(self):
        trouble = []
        law = support.host_bilinear(spy=fails_in(trouble))
        trouble.append(True)
        with self.assertRaises(Mine) as caught:
            law.check()
        self.assertIn(str(caught.exception), ("adhesion", "dissipation"))
        with self.assertRaises(Mine):
            law.respond([[1e-5, 0.0]], 0.0)
        trouble.clear()
        law.check()

    def test_control_c_ends_it(self):
        """Also where the library does not look up: the next point is not asked for."""
        asked = []

        def spy(which):
            asked.append(which)
            if len(asked) == 20:
                signal.raise_signal(signal.SIGINT)

        law = support.host_bilinear(spy=spy)
        asked.clear()
        jump = np.full((1000, 2), 5e-5)
        with self.assertRaises(KeyboardInterrupt):
            law.respond(jump, 0.0)
        self.assertEqual(len(asked), 20)

    def test_only_laws_are_laws(self):
        problem = support.brittle_flexure(30)
        for other in ("host", None, 3):
            with self.assertRaises(delam.ArgumentError):
                problem.set_law(0, other)
        with self.assertRaises(delam.ArgumentError):
            problem.set_law(7, support.host_bilinear())
        self.assertFalse(problem.context.hosted)
        for make in (delam.Problem, delam.Solver):
            with self.assertRaises(delam.ArgumentError):
                make(None)

    def test_a_law_that_fails_while_a_step_is_committed(self):
        trouble = []
        problem = support.brittle_flexure(30)
        problem.set_law(0, support.host_bilinear(spy=fails_in(trouble)))
        solver = delam.Solver(problem, not_converged="ignore")
        solver.record("time", "process_zone")
        solver.advance(1.0)
        trouble.append(True)
        with self.assertRaises(Mine):
            solver.commit()
        self.assertTrue(solver.pending)
        self.assertEqual(len(solver.recorded("time")), 1)
        trouble.clear()
        solver.commit()
        self.assertEqual(list(solver.recorded("time")), [0.0, 1.0])
        self.assertTrue(np.all(np.isfinite(solver.recorded("process_zone"))))

    def test_results_of_the_wrong_kind(self):
        law = delam.Law.host("bad", lambda mixity, driving: None, lambda mixity, adhesion: ("a", "b", "c"),
                             normal_stiffness=1.0, tangential_stiffness=1.0)
        with self.assertRaises(TypeError):
            law.check()

    def test_a_law_that_calls_the_library_is_refused(self):
        laws = []
        law = support.host_bilinear(spy=lambda which: laws[0].check())
        laws.append(law)
        with self.assertRaisesRegex(delam.StateError, "inside a callback"):
            law.check()


if __name__ == "__main__":
    support.main()
