# SPDX-License-Identifier: BSD-3-Clause
"""Rows of values over the steps, and the progress bar of an analysis."""
from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Iterator, Mapping, Sized
from typing import IO, TYPE_CHECKING

import numpy as np

from ._arrays import FloatArray

if TYPE_CHECKING:
    import pandas
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from .solver import Solver


class History:
    """Values of a solver over its steps, as numpy arrays by name: history["reaction:load"]. The first row is the state
    at the time of construction; record() appends the present one. If a step has replaced earlier ones (option
    backtracking), their rows are read again. names: the values that it keeps, in their order; Solver.values.describe()
    has their units."""

    names: tuple[str, ...]

    def __init__(self, solver: Solver, values: Iterable[str] | None = None) -> None:
        self._solver = solver
        self.names = solver._names(values)
        self._steps: list[int] = []
        self._rows: list[list[float]] = []
        self.record()

    def record(self) -> None:
        """Appends a row of the state described (Solver.values); in the place of the last row if that is of the same
        step."""
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

    def _row(self) -> list[float]:
        return [self._solver.values[name] for name in self.names]

    def __getitem__(self, name: str) -> FloatArray:
        try:
            column = self.names.index(name)
        except ValueError:
            raise KeyError(f"{name!r} is not among {', '.join(self.names)}") from None
        return np.array([row[column] for row in self._rows])

    def __contains__(self, name: object) -> bool:
        return name in self.names

    def __iter__(self) -> Iterator[str]:
        return iter(self.names)

    def __len__(self) -> int:
        """Number of rows."""
        return len(self._rows)

    def keys(self) -> tuple[str, ...]:
        """Names of the values, as a mapping of arrays has them."""
        return self.names

    def row(self, index: int) -> dict[str, float]:
        """{name: value} of one row; -1 is the last one. IndexError: there is none."""
        return dict(zip(self.names, self._rows[index]))

    @property
    def array(self) -> NDArray[np.void]:
        """All rows as a structured array [rows] of float64 with the names of the values."""
        table = np.empty(len(self._rows), [(name, np.float64) for name in self.names])
        for name in self.names:
            table[name] = self[name]
        return table

    def to_pandas(self) -> pandas.DataFrame:
        """All rows as a pandas.DataFrame, a column each. ImportError: pandas is not installed."""
        from .result import as_frame
        return as_frame(self.array)

    def plot(self, kind: str = "load", units: Mapping[str, str] | None = None, title: str = "history") -> Figure:
        """A figure of matplotlib; a notebook shows it as the value of a cell, pyplot.show() in a window,
        figure.savefig() writes it. delam.plot.history draws any values.

        kind   "load" (over displacement, a picture for each pattern), "energies" with the two-sided estimate, or
               "bodies": the plane bodies at the present state, with the adhesion in colour
        units  names for the axes: {"length": "m", "force": "N", "time": "s"}

        ArgumentError: there is no such kind; ValueError: the history lacks a value for it, or the bodies are in space;
        ImportError: matplotlib is not installed."""
        from .result import picture
        kinds = {"load": ("._pictures.curves", "load_figure"), "energies": ("._pictures.curves", "energies_figure"),
                 "bodies": ("._live", "bodies_figure")}

        def shown() -> object:
            from ._live import shown as made
            return made(self, units, title)

        return picture(shown, kind, kinds)

    def write_csv(self, file: str | os.PathLike[str] | IO[str], titles: Iterable[str] | None = None) -> None:
        """Writes all digits to an open text file or a path. titles: used instead of the names."""
        if isinstance(file, (str, os.PathLike)):
            with open(file, "w", encoding="utf-8") as opened:
                self.write_csv(opened, titles)
            return
        file.write(",".join(titles or self.names) + "\n")
        for row in self._rows:
            file.write(",".join(format(value + 0.0, ".17g") for value in row) + "\n")


def steps_of(times: Iterable[float], progress: bool) -> Iterable[float]:
    """The times, with a progress bar on standard error if requested: tqdm's if it is installed, else a counter."""
    if not progress:
        return times
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return _counted(times)
    bar: Iterable[float] = tqdm(times, unit="step", desc="delam")
    return bar


def _counted(times: Iterable[float]) -> Iterator[float]:
    total = f"/{len(times)}" if isinstance(times, Sized) else ""
    try:
        for done, time in enumerate(times, start=1):
            sys.stderr.write(f"\rstep {done}{total}, to time {time:g} ")
            sys.stderr.flush()
            yield time
    finally:
        sys.stderr.write("\n")
