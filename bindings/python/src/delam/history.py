# SPDX-License-Identifier: BSD-3-Clause
"""Rows of values over the steps, and the progress bar of an analysis."""
from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Iterator, Mapping, Sized
from typing import IO, TYPE_CHECKING, Any

import numpy as np

from ._base.arrays import FloatArray
from ._base.closing import lines
from ._base.errors import StateError
from ._base.protocols import Solver
from ._base.records import Jump
from ._base.words import listing, meant
from ._exchange.figures import history_figure
from ._exchange.frames import as_frame

if TYPE_CHECKING:
    import pandas
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

# Pictures and closing lines need these values, whichever ones are asked for. None of them costs anything to read.
_ALWAYS = ("step", "time", "stored_bulk", "stored_interface", "dissipated", "load_potential", "work", "lower",
           "increment", "upper", "defect", "defect_slides", "backtracks")


class History:
    """Values of a solver over its steps, as numpy arrays by name: history["reaction:load"]. The first row is the state
    at the time of construction; record() appends the present one. If a step has replaced earlier ones (option
    backtracking), their rows are read again. names: the values that it keeps, in their order; Solver.values.describe()
    has their units.

    An alias of a value works like its name. With a single load pattern, "load" and "reaction" are those of the command
    line: short for "load:NAME" and "reaction:NAME".

    Pictures of curves and closing need no open solver, and so does what pickle or copy makes of a History: its rows,
    without the solver."""

    names: tuple[str, ...]

    def __init__(self, solver: Solver, values: Iterable[str] | None = None) -> None:
        self._solver: Solver | None = solver
        self.names = solver._names(values)
        self._aliases = solver._aliased()
        self._known = tuple(solver.values)
        self._keys = tuple(self._aliases.get(name, name) for name in self.names)
        of_patterns = (name for name in self._known if name.startswith(("load:", "reaction:")))
        columns = dict.fromkeys((*self._keys, *_ALWAYS, *of_patterns))
        self._columns = {name: column for column, name in enumerate(columns)}
        self._rows: list[list[float]] = []
        self._jumps: list[Jump] = []
        drives = solver.problem._drives
        self._about: dict[str, Any] = {
            "patterns": [{"name": name, "drives": drives.get(i, "displacement")}
                         for i, name in enumerate(solver._patterns)],
            "scene": {"dimension": solver.problem.dimension},
            "options": {key: solver.option(key) for key in ("solution", "mixity_rule", "step_control")}
                       | {"backtracking_tolerance": float(solver.option("backtracking_tolerance"))}}
        self.record()

    def record(self) -> None:
        """Appends a row of the state described (Solver.values); in the place of the last row if that is of the same
        step. StateError: this History was pickled or copied, and has no solver."""
        solver = self._solver
        if solver is None:
            raise StateError("this History was pickled or copied: it has its rows, but no solver to record")
        step, first = int(solver.values["step"]), int(solver.values["revised_from"])
        steps = [int(row[self._columns["step"]]) for row in self._rows]
        if first < step:
            for i, other in enumerate(steps):
                if first <= other < step:
                    with solver.looking(other):
                        self._rows[i] = self._row(solver)
        # In one go each, so that Ctrl-C leaves whole rows.
        if steps and steps[-1] == step:
            self._rows[-1] = self._row(solver)
        else:
            self._rows.append(self._row(solver))
        old = [jump for jump in self._jumps if jump.step < first]
        self._jumps = old + solver._jumps(len(old))

    def _row(self, solver: Solver) -> list[float]:
        values = solver.values
        return [values[name] for name in self._columns]

    def _column(self, key: str) -> FloatArray:
        column = self._columns[key]
        return np.array([row[column] for row in self._rows])

    def _by_value(self) -> dict[str, FloatArray]:
        return {name: self._column(name) for name in self._columns}

    def _key(self, name: object) -> str | None:
        """Returns the key of the value with this name or alias, or None: it was not asked for."""
        if name in self.names:
            return self._keys[self.names.index(str(name))]
        key = self._aliases.get(str(name), str(name))
        return key if key in self._keys else None

    def __getstate__(self) -> dict[str, Any]:
        return {**vars(self), "_solver": None, "_rows": list(self._rows)}

    def __getitem__(self, name: str) -> FloatArray:
        key = self._key(name)
        if key is not None:
            return self._column(key)
        if self._aliases.get(name, name) in self._known:
            raise KeyError(f"{name!r} is not in this history, which has {listing(self.names) or 'no values'}; name it "
                           f"in values= where the history is made")
        raise KeyError(f"{name!r} is no value{meant(name, (*self.names, *self._aliases))}; this history has "
                       f"{listing(self.names) or 'none'}")

    def __contains__(self, name: object) -> bool:
        return self._key(name) is not None

    def __repr__(self) -> str:
        times = self._column("time")
        return f"<History of {len(times)} rows, time {times[0]:g} to {times[-1]:g}: {listing(self.names)}>"

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
        row = self._rows[index]
        return {name: row[self._columns[key]] for name, key in zip(self.names, self._keys)}

    @property
    def closing(self) -> list[str]:
        """Returns the lines with which the command line ends a run, as far as the steps tell them: jumps and the energy
        that they released, the largest defect of the energy balance with its step, steps outside their two-sided
        estimate, and steps whose estimate says nothing."""
        return lines(self._by_value(), self._jumps, self._about["options"])

    @property
    def array(self) -> NDArray[np.void]:
        """All rows as a structured array [rows] of float64 with the names of the values."""
        table = np.empty(len(self._rows), [(name, np.float64) for name in self.names])
        for name in self.names:
            table[name] = self[name]
        return table

    def to_pandas(self) -> pandas.DataFrame:
        """All rows as a pandas.DataFrame, a column each. ImportError: pandas is not installed."""
        return as_frame(self.array)

    def plot(self, kind: str = "load", units: Mapping[str, str] | None = None, title: str = "history") -> Figure:
        """A figure of matplotlib; a notebook shows it as the value of a cell, pyplot.show() in a window,
        figure.savefig() writes it. delam.plot.history draws any values.

        kind   "load" (over displacement, a picture for each pattern), "energies" with the two-sided estimate, or
               "bodies": the plane bodies at the present state of the solver, with the adhesion in colour
        units  names for the axes: {"length": "m", "force": "N", "time": "s"}

        "load" and "energies" draw any history; "bodies" needs the solver open. ArgumentError: there is no such kind or
        unit; ValueError: there is no load pattern, the bodies are in space, or the solver is closed; ImportError:
        matplotlib is not installed."""
        return history_figure(self._by_value(), self._jumps, self._about, self._solver, kind, units, title)

    def write_csv(self, file: str | os.PathLike[str] | IO[str], titles: Iterable[str] | None = None) -> None:
        """Writes all digits to an open text file or a path. titles: used instead of the names."""
        if isinstance(file, (str, os.PathLike)):
            with open(file, "w", encoding="utf-8") as opened:
                self.write_csv(opened, titles)
            return
        file.write(",".join(titles or self.names) + "\n")
        columns = [self._columns[key] for key in self._keys]
        for row in self._rows:
            file.write(",".join(format(row[column] + 0.0, ".17g") for column in columns) + "\n")


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
