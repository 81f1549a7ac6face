# SPDX-License-Identifier: BSD-3-Clause
"""Messages speak Python: names of C functions become those of this package, which exist."""
import functools
import logging
import unittest

import support
import numpy as np

import delam
import delam.petsc
from delam._base import raw
from delam._base.words import _OTHERS, in_python, listing, meant

# Functions that nobody who writes Python can call by any name.
INNER = {"abi", "cell_type_topology", "context_create", "context_destroy", "context_message", "context_set_log",
         "petsc_explain", "petsc_message"}
PROGRAMS = [*raw.FUNCTIONS, *delam.petsc._FUNCTIONS, "delam_petsc_create"]


def found(name):
    """What a name of this package means."""
    first, *rest = name.split(".")
    owner = getattr(delam, first, None) or getattr(delam.petsc, first)
    return functools.reduce(getattr, rest, owner)


class Names(unittest.TestCase):
    def test_each_function_has_its_name(self):
        inner = set()
        for function in PROGRAMS:
            if function.startswith("delam_experimental_"):
                continue
            name = in_python(function)
            with self.subTest(function):
                if name == function or function.removeprefix("delam_") in INNER:
                    inner.add(function.removeprefix("delam_"))
                else:
                    self.assertIsNotNone(found(name))
        self.assertEqual(inner, INNER)
        self.assertEqual({name for name in _OTHERS if f"delam_{name}" not in PROGRAMS}, set())

    def test_texts(self):
        self.assertEqual(in_python("no law (delam_problem_set_law, delam_problem_set_bonded or delam_law_create_host)"),
                         "no law (Problem.set_law, Problem.set_bonded or Law.host)")
        for same in ("nothing of C", "delam_experimental_engine", "delam_problem", "delam_context_message"):
            self.assertEqual(in_python(same), same)

    def test_errors_warnings_and_logs(self):
        problem = delam.Problem(delam.Mesh.layers(1.0, 2, [1.0, 1.0], [1, 1]))
        with self.assertRaisesRegex(delam.ProblemError, "no material .Problem.set_elastic or Problem.set_orthotropic."):
            problem.check()
        with self.assertLogs("delam", logging.WARNING) as caught:
            delam.Solver(support.double_cantilever(divisions=20))
        self.assertIn("Problem.propose", "\n".join(caught.output))
        texts = [*delam.Law.kinds().values(), *(item.meaning for item in delam.options().values()),
                 *(info.meaning for info in delam.Solver(support.double_cantilever()).values.describe().values())]
        self.assertEqual([text for text in texts if "delam_" in text], [])


class Hints(unittest.TestCase):
    def test_listing(self):
        self.assertEqual((listing([]), listing([1, 2]), listing(range(12))),
                         ("", "1, 2", "0, 1, 2, 3, 4, 5, 6, 7, 8, 9 .. (12 in all)"))

    def test_meant(self):
        names = ["load:pull", "load:push", "dissipated", *map(str, np.arange(3))]
        for word, hint in (("load", " (did you mean 'load:pull' or 'load:push'?)"), ("zzz", ""), ("", ""),
                           ("disipated", " (did you mean 'dissipated'?)")):
            self.assertEqual(meant(word, names), hint)


if __name__ == "__main__":
    unittest.main()
