# SPDX-License-Identifier: BSD-3-Clause
"""Type hints of the public classes and functions: every name in them exists, and what a scene returns has the type that
they promise."""
import importlib
import inspect
import typing
import unittest

import support  # noqa: F401
import numpy as np

import delam

CLASSES = [delam.Law, delam.Mesh, delam.Interface, delam.Problem, delam.Solver, delam.Values, delam.Options, delam.History]
FUNCTIONS = [delam.library_version, delam.library_commit, delam.library_location, delam.blas_threads, delam.options]


def functions(owner):
    for name, member in vars(owner).items():
        if isinstance(member, (staticmethod, classmethod)):
            member = member.__func__
        if isinstance(member, property):
            member = member.fget
        made = name == "__init__" and owner in (delam.Law, delam.Mesh, delam.Problem, delam.Solver, delam.History)
        if inspect.isfunction(member) and (made or not name.startswith("_")):
            yield name, member


def hints(function):
    names = dict(vars(delam), **vars(importlib.import_module(function.__module__)))
    return typing.get_type_hints(function, globalns=names)


class Hints(unittest.TestCase):
    def test_names_exist(self):
        hinted = 0
        for owner in CLASSES:
            for name, function in functions(owner):
                with self.subTest(owner=owner.__name__, function=name):
                    found = hints(function)
                    hinted += len(found)
                    missing = [p.name for p in inspect.signature(function).parameters.values()
                               if p.name not in found and p.name not in ("self", "cls")]
                    self.assertEqual(missing, [])
        self.assertGreater(hinted, 200)
        for function in FUNCTIONS:
            self.assertIn("return", hints(function), function.__name__)
        self.assertIsInstance(delam.library_version(), str)

    def test_results_have_their_types(self):
        mesh = delam.Mesh.layers(lengths=1.0, divisions=2, thickness=[1.0, 1.0], layer_divisions=[1, 1])
        glue = mesh.add_interface(0, 1)
        law = delam.Law("piecewise-linear", normal_stiffness=1e12, tangential_stiffness=1e12, normal_onset=50.0,
                        tangential_onset=50.0, normal_toughness=280.0, tangential_toughness=280.0)
        problem = delam.Problem(mesh)
        problem.set_elastic(young=70e9, poisson=0.3)
        problem.set_law(glue, law)
        pull = problem.add_pattern("pull", times=[0, 1], values=[0, 1e-5])
        bottom = mesh.find_nodes((0, 0), (1, 0))
        problem.prescribe(bottom, "x")
        problem.prescribe(bottom, "y")
        problem.prescribe(mesh.find_nodes((0, 2), (1, 2)), "y", drive={pull: 1.0})
        solver = delam.Solver(problem)
        solver.record("time")
        solver.advance(1.0)
        arguments = {"factors": [1.0], "forces": [pull], "pattern": [pull], "body_matrix": [0], "process_zone": [0],
                     "field": ["jump"], "recorded": ["time"], "option": ["solution"], "toughness": [[0.5]],
                     "respond": [[[1e-6, 0.0]], 0.0], "find_nodes": [(0, 0), (1, 0)], "find_node": [(0, 0)],
                     "find_patch": [None, (0, 2), (1, 2), "y"], "row": [0], "info": ["solution"]}
        changes = {"commit", "rollback", "close", "advance", "add_interface", "layers", "from_meshio", "history"}
        checked = 0
        for thing in (law, mesh, glue, problem, solver, solver.values, problem.options, solver.history([])):
            for name, function in functions(type(thing)):
                wanted = hints(function).get("return")
                if wanted in (None, type(None)) or name in changes or name.startswith("_"):
                    continue
                member = getattr(type(thing), name)
                needed = [p for p in inspect.signature(function).parameters.values()
                          if p.default is p.empty and p.name not in ("self", "cls") and p.kind == p.POSITIONAL_OR_KEYWORD]
                if needed and name not in arguments:
                    continue
                value = getattr(thing, name)
                if not isinstance(member, property):
                    value = value(*arguments.get(name, []))
                kind = typing.get_origin(wanted) or wanted
                with self.subTest(thing=type(thing).__name__, name=name):
                    self.assertIsInstance(value, np.ndarray if kind is np.ndarray else kind)
                checked += 1
        self.assertGreater(checked, 45)


if __name__ == "__main__":
    unittest.main()
