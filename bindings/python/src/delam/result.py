# SPDX-License-Identifier: BSD-3-Clause
"""Results that `delam run` has written into a folder."""
from __future__ import annotations

import importlib
import os
import pathlib
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ._base.arrays import FloatArray, IntArray
from ._exchange.figures import result_figure
from ._exchange.frames import as_frame
from ._exchange.grids import result_grid
from ._pictures.input_file import MOST_RESULT, fields_file, read_columns, read_json

if TYPE_CHECKING:
    import meshio
    import pandas
    from matplotlib.figure import Figure


def _table(path: pathlib.Path) -> NDArray[np.void]:
    """A file of rows as a structured array: numbers are float64, columns with words are texts."""
    columns: dict[str, NDArray[Any]] = {title: np.array(column, np.str_ if isinstance(column, list) else np.float64)
                                        for title, column in read_columns(path).items()}
    table = np.empty(len(next(iter(columns.values()))), [(title, column.dtype) for title, column in columns.items()])
    for title, column in columns.items():
        table[title] = column
    return table


class Fields(Mapping[str, Any]):
    """A mapping of the fields of one step by name, fields["stress"], as arrays: displacement [nodes][3], stress
    [cells][6] (xx, yy, zz, xy, yz, zx) and what else the scene stores; "interface_0" and so on are mappings of the same
    kind with zeta (the adhesion) [pairs], jump and traction [pairs][3] (normal, tangents), contact, displacement, and
    the fronts. In 2D the remaining components are zero. Units are those of the result (Result.about["units"]). `step`
    and `time` say which step it is; list(fields) has the names."""

    def __init__(self, step: int, time: float, data: dict[str, Any]) -> None:
        self.step = step
        self.time = time
        self._data = data

    def __getitem__(self, name: str) -> Any:
        return self._data[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._data)

    def __len__(self) -> int:
        return len(self._data)

    def __repr__(self) -> str:
        return f"<Fields of step {self.step} at time {self.time:g}: {', '.join(self._data)}>"


class Result:
    """Reads what `delam run SCENE.toml --out FOLDER` has written:

        result = delam.Result("out/enf")
        result.plot()                                  load over displacement
        result.history["reaction"].max()
        result.fields()["interface_0"]["zeta"]         adhesion at the last step that has fields

    folder: its path; about: result.json as a dict (status, units, options, closing lines ...). FileNotFoundError: the
    folder holds no result. ValueError: a file of it is damaged, no regular one, or too large (bindings/cli/MANUAL.md,
    Limits)."""

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        self.folder = pathlib.Path(folder)
        try:
            self.about: dict[str, Any] = read_json(self.folder / "result.json", MOST_RESULT)
            self._history = _table(self.folder / "history.csv")
        except FileNotFoundError as error:
            raise FileNotFoundError(error.errno, f"{self.folder} holds no result: a file is missing", error.filename
                                    ) from None

    def __repr__(self) -> str:
        return f"<Result in {str(self.folder)!r}: {self.about['status']}, {len(self.history) - 1} steps>"

    @property
    def complete(self) -> bool:
        """True if the run came to its end; otherwise the result has the steps that were finished."""
        return bool(self.about["status"] == "complete")

    @property
    def closing(self) -> list[str]:
        """Returns the lines with which the run ended: jumps, energy balance, warnings."""
        return [str(line) for line in self.about.get("closing", [])]

    @property
    def history(self) -> NDArray[np.void]:
        """history.csv as a structured array [steps + 1], row 0 the initial state: history["reaction"],
        history.dtype.names. Its columns and their units are described in bindings/cli/MANUAL.md."""
        return self._history

    @property
    def jumps(self) -> NDArray[np.void]:
        """jumps.csv as a structured array [jumps], without columns if there was no jump."""
        path = self.folder / "jumps.csv"
        return _table(path) if path.exists() else np.empty(0, [])

    def to_pandas(self) -> pandas.DataFrame:
        """The history as a pandas.DataFrame, a column each. ImportError: pandas is not installed."""
        return as_frame(self._history)

    # ---- fields

    def _file(self) -> Any:
        try:
            importlib.import_module("h5py")
        except ImportError:
            raise ImportError("fields need h5py (Debian: python3-h5py)") from None
        if not self.about["output"]["fields"]:
            raise ValueError(f"{self.folder}: the scene writes no fields (output.fields = [])")
        return fields_file(self.folder / "fields.h5")

    @property
    def steps(self) -> dict[int, float]:
        """{step: time} of the steps that have fields."""
        with self._file() as file:
            return {int(name): float(file["steps"][name].attrs["time"]) for name in sorted(file["steps"])}

    def fields(self, step: int = -1) -> Fields:
        """The fields of a step, by its number; -1 is the last that has fields, -2 the one before. KeyError names those
        that have fields."""
        with self._file() as file:
            names = {int(name): name for name in sorted(file["steps"])}
            stored = list(names)
            if step < 0 and -step <= len(stored):
                step = stored[step]
            if step not in names:
                raise KeyError(f"step {step} has no fields; those are {', '.join(map(str, stored))}")
            group = file["steps"][names[step]]
            return Fields(step, float(group.attrs["time"]), _arrays_of(group))

    @property
    def nodes(self) -> FloatArray:
        """Positions [nodes][3]; z = 0 in 2D."""
        with self._file() as file:
            return np.asarray(file["mesh/points"][()], np.float64)

    @property
    def cells(self) -> list[IntArray]:
        """Connectivity [n][nodes of a cell] of the cells of each size, in the order of their rows in fields;
        `cell_rows` has those."""
        with self._file() as file:
            table = np.asarray(file["mesh/cells"][()], np.int64)
        return [table[rows][:, :size] for size, rows in _sizes(table)]

    @property
    def cell_rows(self) -> list[IntArray]:
        """For each entry of `cells` the rows [n] that its cells have in fields over cells."""
        with self._file() as file:
            return [rows for _, rows in _sizes(np.asarray(file["mesh/cells"][()], np.int64))]

    @property
    def bodies(self) -> IntArray:
        """[cells]: number of the body of each cell, in the order of their rows in fields."""
        with self._file() as file:
            return np.asarray(file["mesh/body"][()], np.int64)

    # ---- pictures and other programs

    def plot(self, kind: str = "load", cut: str | None = None) -> Figure:
        """A figure of matplotlib, as the command line's plot.py draws it; a notebook shows it as the value of a cell,
        pyplot.show() in a window, figure.savefig() writes it.

        kind  "load" (over displacement), "energies", "averages" (stress over strain), "snapshots" (deformed bodies with
              the adhesion in colour), "stresses" (plane scenes with prescribed strains), in space "fronts" and "cut"
        cut   for kind "cut": where to cut, "y=0.01" for instance; None: where most opens

        ArgumentError: there is no such kind or cut; ValueError: this result has nothing to draw of it; ImportError:
        matplotlib or h5py is not installed."""
        return result_figure(str(self.folder), kind, cut)

    def _interface(self, name: str) -> tuple[FloatArray, IntArray]:
        """Points [pairs][3] and faces of an interface."""
        with self._file() as file:
            if name not in file["interfaces"]:
                raise KeyError(f"{name} is not in the result; there are {', '.join(file['interfaces']) or 'none'}")
            group = file["interfaces"][name]
            return np.asarray(group["points"][()], np.float64), np.asarray(group["faces"][()], np.int64)

    def to_meshio(self, step: int = -1, interface: int | None = None) -> meshio.Mesh:
        """The bodies at a step as a meshio.Mesh, with the fields over nodes as point data and those over cells and the
        numbers of the bodies as cell data: to_meshio().write("last.vtu"). With the number of an interface: its faces,
        with adhesion (zeta), jump, traction and contact as point data. KeyError: the step has no fields, or there is no
        such interface."""
        return result_grid(self, step, interface).to_meshio()

    def to_vtk(self, step: int = -1, interface: int | None = None) -> Any:
        """The same as a vtkUnstructuredGrid; to_pyvista() gives one of PyVista. ImportError: VTK is not installed."""
        return result_grid(self, step, interface).to_vtk()

    def to_pyvista(self, step: int = -1, interface: int | None = None) -> Any:
        """The same as a pyvista.UnstructuredGrid. ImportError: PyVista is not installed."""
        return result_grid(self, step, interface).to_pyvista()


def _sizes(table: IntArray) -> list[tuple[int, IntArray]]:
    """Numbers of nodes of cells, and the rows with as many; short rows end with -1."""
    number = (table >= 0).sum(1)
    return [(int(n), np.flatnonzero(number == n).astype(np.int64)) for n in np.unique(number)]


def _arrays_of(group: Any) -> dict[str, Any]:
    """Reads a group of an HDF5 file into arrays by their names."""
    return {name: _arrays_of(item) if hasattr(item, "keys") else item[()] for name, item in group.items()}
