# SPDX-License-Identifier: BSD-3-Clause
"""A history as the pictures take results (_pictures/result.py): what a run of the command line has in its files."""
from __future__ import annotations

import functools
import importlib
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from .history import History

COSTLY = "values of a History are chosen when it is made: history(times, values=...), or None for all of these"


@functools.cache
def _kind() -> Any:
    base = importlib.import_module("._pictures.result", __package__).Result

    class OfSolver(base):  # type: ignore[misc, valid-type]
        """Without files. Names are those of history.csv: load and reaction of a single pattern."""

        def __init__(self, history: History, units: Mapping[str, str], title: str) -> None:
            solver = history._solver
            self.folder, self.cell, self._title, self._solver = "", None, title, solver
            names = solver._patterns
            drives = solver.problem._drives
            self.history = Columns(history, names, "force" in drives.values())
            self.about = {
                "patterns": [{"name": name, "drives": drives.get(i, "displacement")} for i, name in enumerate(names)],
                "scene": {"dimension": solver.problem.dimension}, "units": units, "status": "complete",
                "steps": len(history) - 1, "estimate_violated": None,
                "options": {"backtracking_tolerance": float(solver.option("backtracking_tolerance"))}}
            self.name_units()

        def name(self) -> str:
            return self._title

        def concept(self) -> dict[str, str]:
            """As of a result of the command line, without the size of cells."""
            solver = self._solver
            return {"solution": f"{solver.option('solution')} solution",
                    "mixity_rule": f"{solver.option('mixity_rule')} mixity", "steps": f"{self.about['steps']} steps"}

        def jump_times(self) -> list[float]:
            jumps = self._solver.jumps
            largest = max((jump.debonded for jump in jumps), default=0.0)
            return [jump.time for jump in jumps if jump.debonded > 0.2 * largest]

        def stamp(self, figure: Any, caption: str = "") -> None:
            """There is no run to name."""

    return OfSolver


class Columns(Mapping[str, Any]):
    """Columns of a history by the names of history.csv, which has a load_potential only where there are dead forces."""

    def __init__(self, history: History, patterns: list[str], dead: bool) -> None:
        self._history = history
        self._names = {name: name for name in history.names if dead or name != "load_potential"}
        for name in patterns:
            for kind in ("load", "reaction"):
                title = kind if len(patterns) == 1 else f"{kind}_{name}"
                if f"{kind}:{name}" in history:
                    self._names[title] = f"{kind}:{name}"

    def __getitem__(self, name: str) -> Any:
        if name not in self._names:
            raise ValueError(f"the history lacks {name!r}, which this picture needs: {COSTLY}")
        return np.asarray(self._history[self._names[name]])

    def get(self, name: str, default: Any = None) -> Any:
        return self[name] if name in self._names else default

    def __contains__(self, name: object) -> bool:
        return name in self._names

    def __iter__(self) -> Any:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)


def bodies_figure(result: Any) -> Any:
    """The bodies at the present state of the solver."""
    from .plot import bodies
    solver = result._solver
    axes = bodies(solver)
    axes.axis("off")
    axes.figure.suptitle(result.title(f"bodies at time {solver.time:.6g}"), fontsize=11)
    return axes.figure


def shown(history: History, units: Mapping[str, str] | None, title: str) -> Any:
    """A History for the pictures. units: names of those of length, force and time, "" where they have none."""
    return _kind()(history, {"length": "", "force": "", "time": "", **(units or {})}, title)
