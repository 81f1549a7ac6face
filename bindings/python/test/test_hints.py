# SPDX-License-Identifier: BSD-3-Clause
"""Type hints and docstrings of all public names: they are there, every name in the hints exists, and what a scene
returns has the type that they promise."""
import importlib
import inspect
import pickle
import pydoc
import types
import typing
import unittest

import support  # noqa: F401

import numpy as np

import delam
import delam.meshes
import delam.petsc
import delam.plot

MODULES = [delam, delam.meshes, delam.petsc, delam.plot]
CLASSES = [delam.Law, delam.Mesh, delam.Interface, delam.Problem, delam.Solver, delam.Values, delam.Options,
           delam.History, delam.Result, delam.Fields]
FUNCTIONS = [delam.library_version, delam.library_commit, delam.library_location, delam.blas_threads, delam.options]


# Names that the package imports for hints alone, from packages that need not be installed.
FOREIGN = {"meshio": types.SimpleNamespace(Mesh=object), "Axes": object, "Colormap": object,
           "Figure": object, "pandas": types.SimpleNamespace(DataFrame=object), "NDArray": np.ndarray}


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
    names = {**FOREIGN, **vars(delam), **vars(importlib.import_module(function.__module__))}
    return typing.get_type_hints(function, globalns=names)


def public():
    """(name, function or class) of all that a user can reach by names without an underscore."""
    seen = set()
    for module in MODULES:
        for name in getattr(module, "__all__", [name for name in vars(module) if not name.startswith("_")]):
            thing = getattr(module, name)
            own = getattr(thing, "__module__", "")
            # What a module has from elsewhere is its own affair, but not what the package shows as its own.
            if id(thing) in seen or (own != module.__name__ if module is not delam else not own.startswith("delam")):
                continue
            seen.add(id(thing))
            if inspect.isfunction(thing):
                yield f"{module.__name__}.{name}", thing
            elif inspect.isclass(thing):
                yield f"{module.__name__}.{name}", thing
                yield from members(f"{module.__name__}.{name}", thing)


def members(name, owner):
    for base in owner.__mro__:
        if not base.__module__.startswith("delam"):
            continue
        for key, member in vars(base).items():
            if isinstance(member, (staticmethod, classmethod)):
                member = member.__func__
            if isinstance(member, property):
                member = member.fget
            # Those of named tuples are Python's.
            if inspect.isfunction(member) and not key.startswith("_"):
                yield f"{name}.{key}", member


class Described(unittest.TestCase):
    def test_docstrings(self):
        found = dict(public())
        self.assertGreater(len(found), 150)
        self.assertEqual([name for name, thing in found.items() if not (inspect.getdoc(thing) or "").strip()], [])

    def test_classes_have_their_own(self):
        # An inherited text would pass for a description.
        classes = {name: thing for name, thing in public() if inspect.isclass(thing)}
        self.assertEqual([name for name, thing in classes.items() if not vars(thing).get("__doc__")], [])

    def test_every_function_is_hinted(self):
        missing = []
        for name, thing in public():
            if not inspect.isfunction(thing):
                continue
            signature = inspect.signature(thing)
            missing += [f"{name}: {parameter.name}" for parameter in signature.parameters.values()
                        if parameter.annotation is parameter.empty and parameter.name not in ("self", "cls")]
            if signature.return_annotation is signature.empty:
                missing.append(f"{name}: result")
        self.assertEqual(missing, [])

    def test_the_walk_sees_what_is_missing(self):
        class Bare:
            def said(self) -> None:
                """Something."""

            def unsaid(self, value):
                return value

        Bare.__module__ = "delam.bare"
        found = dict(members("Bare", Bare))
        self.assertEqual([name for name, thing in found.items() if not inspect.getdoc(thing)], ["Bare.unsaid"])

    def test_help_names_shapes_and_units(self):
        for thing, words in ((delam.Mesh.nodes, "[nodes][dimension]"), (delam.Interface.weights, "Length"),
                             (delam.Solver.field, "[cells][6]"), (delam.Solver.advance, "StateError"),
                             (delam.Law.respond, "[n][2 or 3]"), (delam.Fronts, "[points][3]")):
            self.assertIn(words.lower(), pydoc.render_doc(thing, renderer=pydoc.plaintext).lower())


class Rooms(unittest.TestCase):
    """What a private package defines and a public module shows bears the name of this module."""

    OF = {delam.ArgumentError: "delam.errors", delam.Parameter: "delam.law", delam.Cells: "delam.mesh",
          delam.Ties: "delam.mesh", delam.meshes.Grid: "delam.meshes", delam.meshes.grid_of: "delam.meshes",
          delam.plot.bodies: "delam.plot", delam.Sparse: "delam.problem", delam.Jump: "delam.solver"}

    def test_names(self):
        self.assertEqual({thing: thing.__module__ for thing in self.OF}, self.OF)
        private = [name for name, thing in public() if "._" in thing.__module__ and "." not in thing.__qualname__]
        self.assertEqual(private, [])

    def test_pickles_name_public_modules(self):
        for thing in self.OF:
            self.assertNotIn(b"delam._", pickle.dumps(thing))
            self.assertIs(pickle.loads(pickle.dumps(thing)), thing)

    def test_hints_of_fields_are_known(self):
        records = [thing for _, thing in public() if inspect.isclass(thing) and issubclass(thing, tuple)]
        self.assertGreater(len(records), 13)
        for thing in records:
            self.assertEqual(tuple(typing.get_type_hints(thing)), thing._fields)


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
        changes = {"commit", "rollback", "close", "advance", "add_interface", "layers", "from_meshio", "history",
                   # These need other packages, and have tests of their own.
                   "from_vtk", "to_meshio", "to_vtk", "to_pyvista", "to_pandas", "plot"}
        checked = 0
        for thing in (law, mesh, glue, problem, solver, solver.values, problem.options, solver.history([])):
            for name, function in functions(type(thing)):
                wanted = hints(function).get("return")
                if wanted in (None, type(None)) or name in changes or name.startswith("_"):
                    continue
                member = getattr(type(thing), name)
                needed = [p for p in inspect.signature(function).parameters.values()
                          if p.default is p.empty and p.name not in ("self", "cls")
                          and p.kind == p.POSITIONAL_OR_KEYWORD]
                if needed and name not in arguments:
                    continue
                value = getattr(thing, name)
                if not isinstance(member, property):
                    value = value(*arguments.get(name, []))
                either = typing.get_args(wanted) if typing.get_origin(wanted) is types.UnionType else (wanted,)
                kind = tuple(typing.get_origin(one) or one for one in either)
                with self.subTest(thing=type(thing).__name__, name=name):
                    self.assertIsInstance(value, kind)
                checked += 1
        self.assertGreater(checked, 45)


if __name__ == "__main__":
    unittest.main()
