# SPDX-License-Identifier: BSD-3-Clause
"""Grids of cells with their data, and their forms in meshio, VTK and PyVista. All of them order the nodes of a cell as
VTK does, and so does this package."""
from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._base.arrays import FloatArray, IntArray
from .._base.cells import CELLS
from .._base.errors import ArgumentError
from .._base.protocols import Mesh, Result, Solver

if TYPE_CHECKING:
    import meshio

# meshio's names of our cells.
NAMES = {"triangle": "tri3", "quad": "quad4", "tetra": "tet4", "hexahedron": "hex8", "triangle6": "tri6",
         "quad8": "quad8", "quad9": "quad9", "tetra10": "tet10", "hexahedron20": "hex20", "hexahedron27": "hex27",
         "wedge": "wedge6", "pyramid": "pyramid5", "wedge15": "wedge15"}
# VTK's numbers of meshio's cells, those of faces of interfaces included.
VTK_TYPES = {"line": 3, "triangle": 5, "quad": 9, "tetra": 10, "hexahedron": 12, "line3": 21, "triangle6": 22,
             "quad8": 23, "tetra10": 24, "hexahedron20": 25, "quad9": 28, "hexahedron27": 29, "wedge": 13,
             "pyramid": 14, "wedge15": 26}
# meshio's names of the cells of a result by dimension and number of nodes, and of the faces of its interfaces.
_RESULT_CELLS = {2: {3: "triangle", 4: "quad", 6: "triangle6", 8: "quad8", 9: "quad9"},
                 3: {4: "tetra", 8: "hexahedron", 10: "tetra10", 20: "hexahedron20", 27: "hexahedron27", 6: "wedge",
                     5: "pyramid", 15: "wedge15"}}
_RESULT_FACES = {2: {2: "line", 3: "line3"}, 3: {3: "triangle", 4: "quad", 6: "triangle6", 8: "quad8", 9: "quad9"}}


class Grid(NamedTuple):
    """Points [n][3], blocks of cells (meshio's name of their type, connectivity [cells][nodes of a cell]), data over
    points [n] or [n][columns], and over cells in the order of the blocks."""

    points: FloatArray
    blocks: list[tuple[str, IntArray]]
    point_data: dict[str, NDArray[Any]]
    cell_data: dict[str, NDArray[Any]]

    def to_meshio(self) -> meshio.Mesh:
        """Returns the grid as a meshio.Mesh. ImportError: meshio is not installed; ArgumentError: it lacks a type of
        cells."""
        ends = np.cumsum([len(cells) for _, cells in self.blocks])[:-1]
        over_cells = {name: np.split(values, ends) for name, values in self.cell_data.items()}
        try:
            return meshio_module().Mesh(self.points, self.blocks, point_data=self.point_data, cell_data=over_cells)
        except KeyError as kind:  # how meshio says so
            raise ArgumentError(f"this meshio has no cells of type {kind}; to_vtk() has") from None

    def to_vtk(self) -> Any:
        """Returns the grid as a vtkUnstructuredGrid. ImportError: VTK is not installed."""
        model, support = vtk_modules()
        grid, points = model.vtkUnstructuredGrid(), model_points()
        points.SetData(support.numpy_to_vtk(self.points, deep=True))
        grid.SetPoints(points)
        types = np.concatenate([np.full(len(cells), VTK_TYPES[name], np.uint8) for name, cells in self.blocks])
        sizes = np.concatenate([np.full(len(cells), cells.shape[1], np.int64) for _, cells in self.blocks])
        offsets = np.concatenate([np.zeros(1, np.int64), np.cumsum(sizes)])
        nodes = np.concatenate([cells.ravel() for _, cells in self.blocks]).astype(np.int64)
        array = model.vtkCellArray()
        array.SetData(support.numpy_to_vtkIdTypeArray(offsets, deep=True),
                      support.numpy_to_vtkIdTypeArray(nodes, deep=True))
        grid.SetCells(support.numpy_to_vtk(types, deep=True), array)
        for data, arrays in ((grid.GetPointData(), self.point_data), (grid.GetCellData(), self.cell_data)):
            for name, values in arrays.items():
                item = support.numpy_to_vtk(np.ascontiguousarray(values), deep=True)
                item.SetName(name)
                data.AddArray(item)
        return grid

    def to_pyvista(self) -> Any:
        """Returns the grid as a pyvista.UnstructuredGrid. ImportError: PyVista is not installed."""
        try:
            import pyvista
        except ImportError:
            raise ImportError("this needs PyVista; to_vtk() needs VTK alone (Debian: python3-vtk9)") from None
        return pyvista.wrap(self.to_vtk())


def meshio_module() -> Any:
    try:
        import meshio
    except ImportError:
        raise ImportError("reading and writing meshes needs meshio (Debian: python3-meshio)") from None
    return meshio


def vtk_modules() -> tuple[Any, Any]:
    try:
        from vtkmodules import vtkCommonDataModel
        from vtkmodules.util import numpy_support
    except ImportError:
        raise ImportError("grids of VTK need VTK (Debian: python3-vtk9)") from None
    return vtkCommonDataModel, numpy_support


def model_points() -> Any:
    """Empty points of VTK."""
    from vtkmodules import vtkCommonCore
    return vtkCommonCore.vtkPoints()


def _in_space(values: FloatArray) -> FloatArray:
    """Two columns as three."""
    return np.column_stack([values, np.zeros(len(values))]) if values.shape[1] == 2 else values


def _rows(name: str, values: ArrayLike, count: int) -> NDArray[Any]:
    array = np.asarray(values)
    if array.ndim == 0 or len(array) != count:
        have = "no" if array.ndim == 0 else len(array)
        raise ArgumentError(f"{name} has {have} rows, expected {count}")
    return array


def grid_of(mesh: Mesh, point_data: Mapping[str, ArrayLike] | None = None,
            cell_data: Mapping[str, ArrayLike] | None = None) -> Grid:
    """The nodes and cells of a mesh; plane ones get z = 0. point_data: arrays over all nodes; cell_data: arrays over
    all cells, in the order they were added; "bodies" is among them. ArgumentError: another number of rows."""
    nodes, cells = mesh.nodes, mesh.cells
    back = {ours: theirs for theirs, ours in NAMES.items()}
    unnamed = [name for name in cells.names() if name not in back]
    if unnamed:
        raise ArgumentError(f"cells of type {unnamed[0]} have no name in meshio")
    order = np.concatenate([np.flatnonzero(cells.types == CELLS[name][0]) for name in cells.names()]
                           or [np.empty(0, np.int64)])
    given: dict[str, Any] = {"bodies": cells.bodies, **(cell_data or {})}
    data = {name: _rows(f"cell_data[{name!r}]", values, len(cells.types))[order] for name, values in given.items()}
    return Grid(_in_space(nodes), [(back[name], cells.of(name)) for name in cells.names()],
                {name: _rows(f"point_data[{name!r}]", values, len(nodes))
                 for name, values in (point_data or {}).items()}, data)


def write(mesh: Mesh, point_data: Mapping[str, ArrayLike] | None = None,
          cell_data: Mapping[str, ArrayLike] | None = None) -> meshio.Mesh:
    """A meshio.Mesh with the nodes and cells of `mesh`; plane ones get z = 0. cell_data are arrays over all cells, in
    the order they were added; "bodies" is among them. ArgumentError: another number of rows."""
    return grid_of(mesh, point_data, cell_data).to_meshio()


def solver_grid(solver: Solver) -> Grid:
    """The bodies of the state described (Solver.values): displacement [nodes][3] over points, stress [cells][6] and
    bodies over cells. Nodes beyond the problem's own have none: zero."""
    mesh = solver.problem.mesh
    found = solver.field("displacement")
    displacement = np.zeros((mesh.node_count, found.shape[1]))
    displacement[:len(found)] = found
    return grid_of(mesh, {"displacement": _in_space(displacement)}, {"stress": solver.field("stress")})


def result_grid(result: Result, step: int = -1, interface: int | None = None) -> Grid:
    """The bodies of a result at a step, with its fields over nodes and cells; or the faces of one interface, with its
    adhesion (zeta), jump, traction, contact and displacement over their points. KeyError: the step has no fields, or
    there is no such interface."""
    fields, dimension = result.fields(step), int(result.about["scene"]["dimension"])
    if interface is not None:
        name = f"interface_{interface}"
        points, faces = result._interface(name)
        kind = _RESULT_FACES[dimension][faces.shape[1]]
        of = fields[name] if name in fields else {}
        return Grid(points, [(kind, faces)], _over(of, len(points)), {})
    points, cells, rows = result.nodes, result.cells, result.cell_rows
    order = np.concatenate(rows)
    over_cells = {"bodies": result.bodies, **_over(fields, len(order), {"stress", "rotation"})}
    names = _RESULT_CELLS[dimension]
    return Grid(points, [(names[block.shape[1]], block) for block in cells],
                _over(fields, len(points), None, {"stress", "rotation"}),
                {name: values[order] for name, values in over_cells.items()})


def _over(fields: Mapping[str, Any], count: int, only: set[str] | None = None,
          without: Iterable[str] = ()) -> dict[str, NDArray[Any]]:
    """The fields with as many rows."""
    return {name: np.asarray(values) for name, values in fields.items()
            if not isinstance(values, Mapping) and np.ndim(values) > 0 and len(values) == count
            and (only is None or name in only) and name not in without and not name.startswith("front_")}
