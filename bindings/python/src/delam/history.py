# SPDX-License-Identifier: BSD-3-Clause
"""Rows of values over the steps, and the progress bar of an analysis."""
from __future__ import annotations

import sys
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from .solver import Solver


class History:
    """Values of a solver over its steps, as numpy arrays by name: history["reaction:load"]. The first row is the state at
    the time of construction; record() appends the present one. If a step has replaced earlier ones (option backtracking),
    their rows are read again."""

    def __init__(self, solver: Solver, values: Iterable[str] | None = None) -> None:
        self._solver = solver
        self.names = solver._names(values)
        self._steps = []
        self._rows = []
        self.record()

    def record(self) -> None:
        values = self._solver.values
        step, first = int(values["step"]), int(values["revised_from"])
        if first < step and self._steps:
            for i, other in enumerate(self._steps):
                if first <= other < step:
                    with self._solver.looking(other):
                        self._rows[i] = self._row()
        if self._steps and self._steps[-1] == step:
            self._rows[-1] = self._row()
        else:
            self._steps.append(step)
            self._rows.append(self._row())

    def _row(self):
        return [self._solver.values[name] for name in self.names]

    def __getitem__(self, name: str) -> NDArray:
        try:
            column = self.names.index(name)
        except ValueError:
            raise KeyError(f"{name!r} is not among {', '.join(self.names)}") from None
        return np.array([row[column] for row in self._rows])

    def __contains__(self, name: str):
        return name in self.names

    def __iter__(self):
        return iter(self.names)

    def __len__(self):
        """Number of rows."""
        return len(self._rows)

    def keys(self):
        return self.names

    def row(self, index: int):
        return dict(zip(self.names, self._rows[index]))

    def write_csv(self, file: object, titles: Mapping | None = None):
        """Writes all digits to an open text file or a path. titles: used instead of the names."""
        if not hasattr(file, "write"):
            with open(file, "w", encoding="utf-8") as opened:
                self.write_csv(opened, titles)
            return
        file.write(",".join(titles or self.names) + "\n")
        for row in self._rows:
            file.write(",".join(format(value + 0.0, ".17g") for value in row) + "\n")


def steps_of(times, progress):
    """The times, with a progress bar on standard error if requested: tqdm's if it is installed, else a counter."""
    if not progress:
        return times
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return _counted(times)
    return tqdm(times, unit="step", desc="delam")


def _counted(times):
    total = f"/{len(times)}" if hasattr(times, "__len__") else ""
    try:
        for done, time in enumerate(times, start=1):
            sys.stderr.write(f"\rstep {done}{total}, to time {time:g} ")
            sys.stderr.flush()
            yield time
    finally:
        sys.stderr.write("\n")
