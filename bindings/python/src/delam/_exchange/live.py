# SPDX-License-Identifier: BSD-3-Clause
"""A history as the pictures take results (_pictures/result.py): what a run of the command line has in its files."""
from __future__ import annotations

import functools
import importlib
from collections.abc import Mapping, Sequence
from typing import Any

from .._base.arrays import FloatArray
from .._base.errors import ArgumentError
from .._base.protocols import Solver
from .._base.records import Jump
from .._base.words import listing, meant
from .bodies import bodies


@functools.cache
def _kind() -> Any:
    base = importlib.import_module(".._pictures.result", __package__).Result

    class OfSolver(base):  # type: ignore[misc, valid-type]
        """A result without files. Its names are those of history.csv: load and reaction of a single pattern."""

        def __init__(self, columns: Mapping[str, FloatArray], jumps: Sequence[Jump], about: Mapping[str, Any],
                     solver: Solver | None, title: str) -> None:
            self.folder, self.cell, self._title = "", None, title
            self._solver, self._jumps = solver, jumps
            self.history = _columns(columns, about["patterns"])
            self.about: dict[str, Any] = {**about, "status": "complete", "steps": len(columns["step"]) - 1,
                                          "estimate_violated": None}
            self.name_units()

        def name(self) -> str:
            return self._title

        def concept(self) -> dict[str, str]:
            """Returns what a result of the command line has here, without the size of cells."""
            options = self.about["options"]
            return {"solution": f"{options['solution']} solution", "mixity_rule": f"{options['mixity_rule']} mixity",
                    "steps": f"{self.about['steps']} steps"}

        def jump_times(self) -> list[float]:
            largest = max((jump.debonded for jump in self._jumps), default=0.0)
            return [jump.time for jump in self._jumps if jump.debonded > 0.2 * largest]

        def stamp(self, figure: Any, caption: str = "") -> None:
            """There is no run to name."""

    return OfSolver


def _columns(values: Mapping[str, FloatArray], patterns: Sequence[Mapping[str, str]]) -> dict[str, Any]:
    """Columns of a history by the names of history.csv, which has a load_potential only where there are dead forces."""
    dead = any(pattern["drives"] == "force" for pattern in patterns)
    columns = {name: column for name, column in values.items() if dead or name != "load_potential"}
    for pattern in patterns:
        for kind in ("load", "reaction"):
            title = kind if len(patterns) == 1 else f"{kind}_{pattern['name']}"
            columns[title] = columns[f"{kind}:{pattern['name']}"]
    return columns


def load_figure(result: Any) -> Any:
    """Draws the load curves; ValueError: the problem has no load pattern."""
    if not result.about["patterns"]:
        raise ValueError("no picture of load: the problem has no load pattern")
    return importlib.import_module(".._pictures.curves", __package__).load_figure(result)


def bodies_figure(result: Any) -> Any:
    """The bodies at the present state of the solver."""
    solver = result._solver
    if solver is None or solver.closed:
        raise ValueError("no picture of bodies: it shows the present state of the solver, which is closed or was left "
                         "behind with a pickled History; draw it while the solver is open")
    axes = bodies(solver)
    axes.axis("off")
    axes.figure.suptitle(result.title(f"bodies at time {solver.time:.6g}"), fontsize=11)
    return axes.figure


def shown(columns: Mapping[str, FloatArray], jumps: Sequence[Jump], about: Mapping[str, Any], solver: Solver | None,
          title: str) -> Any:
    """A History for the pictures. columns: by the names of values; about: what result.json would say, with units."""
    return _kind()(columns, jumps, about, solver, title)


def units_of(units: Mapping[str, str] | None) -> dict[str, str]:
    """Names of the units of length, force and time, "" where they have none."""
    named = {"length": "", "force": "", "time": ""}
    if units is None:
        return named
    if not isinstance(units, Mapping):
        raise TypeError(f"units = {units!r} is a {type(units).__name__}, expected a mapping such as "
                        f"{{'length': 'mm', 'force': 'N', 'time': 's'}}")
    for key, name in units.items():
        if key not in named:
            raise ArgumentError(f"units: {key!r} is no quantity{meant(key, named)}; these are {listing(named)}")
        if not isinstance(name, str):
            raise TypeError(f"units[{key!r}] = {name!r} is a {type(name).__name__}, expected a str")
        named[key] = name
    return named
