# SPDX-License-Identifier: BSD-3-Clause
"""Delamination of layered and fibrous composites by energy minimisation: libdelam from Python.

    mesh = delam.Mesh.layers(0.12, 240, [3e-3, 3e-3], [6, 6])      bodies and their interfaces
    law = delam.Law("piecewise-linear", normal_stiffness=125e9, ...)
    problem = delam.Problem(mesh)                                  materials, laws, supports, loads, options
    solver = delam.Solver(problem)                                 load steps and their results

Arrays are numpy's (in hints, FloatArray is one of float64, IntArray one of int64), indices start at 0, units are
whatever is consistent. Errors are exceptions under DelamError.
Warnings and notes of the library go to the logger "delam". Result reads what the command line has written. delam.plot
draws (matplotlib), delam.meshes reads and writes meshes (meshio, VTK, PyVista)."""
from __future__ import annotations

from types import ModuleType
from typing import get_type_hints

from . import errors, law, mesh, meshes, plot, problem, solver
from ._base.library import library as _library
from ._base.library import location as _location
from .errors import (ArgumentError, Cancelled, DelamError, FileError, HandleError, InternalError, LimitReached,
                     MeshError, NotConverged, NotConvergedWarning, NumericalError, Outcome, OutOfMemory,
                     ProblemError, SnapshotError, StateError)
from .history import History
from .law import Bounds, Law, Parameter
from .mesh import CELLS, Cells, Interface, Mesh, Ties
from .options import Options, options
from .problem import Forecast, Pattern, Problem, Proposal, Sparse
from .result import Fields, Result
from .solver import Average, Condensed, Fronts, Jump, PlanItem, Solver, ValueInfo, Values

__version__ = "0.2.0"

__all__ = ["ArgumentError", "Average", "Bounds", "CELLS", "Cancelled", "Cells", "Condensed", "DelamError", "Fields",
           "FileError", "Forecast", "Fronts", "HandleError", "History", "Interface", "InternalError", "Jump", "Law",
           "LimitReached", "Mesh", "MeshError", "NotConverged", "NotConvergedWarning", "NumericalError", "Options",
           "OutOfMemory", "Outcome", "Parameter", "Pattern", "PlanItem", "Problem", "ProblemError", "Proposal",
           "Result", "SnapshotError", "Solver", "Sparse", "StateError", "Ties", "ValueInfo", "Values", "blas_threads",
           "library_commit", "library_location", "library_version", "options"]


def library_version() -> str:
    """Version of the libdelam that was loaded."""
    return str(_library.delam_version().decode())


def library_commit() -> str:
    """Commit it was built from, or "unknown"."""
    return str(_library.delam_commit().decode())


def library_location() -> str:
    """File it was loaded from, as passed to the loader."""
    return _location


def blas_threads() -> int:
    """Threads of the linear algebra of this process, 0: unknown. Equal digits from run to run need an equal number.
    Option threads sets the library's own threads."""
    return int(_library.delam_blas_threads())


def _claim(*modules: ModuleType) -> None:
    """Lets tracebacks, help and pickles name the module that shows a class, in place of the room that defines it."""
    for module in modules:
        for name in module.__all__:
            thing = getattr(module, name)
            if not getattr(thing, "__module__", "").startswith(f"{__name__}._"):
                continue
            if isinstance(thing, type):  # the names in its hints are known in the room alone
                known = get_type_hints(thing)
                thing.__annotations__ = {field: known[field] for field in thing.__annotations__}
            thing.__module__ = module.__name__


_claim(errors, law, mesh, meshes, plot, problem, solver)
