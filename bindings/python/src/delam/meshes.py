# SPDX-License-Identifier: BSD-3-Clause
"""Meshes and results in and out: through meshio (Gmsh, Abaqus, VTK, MED and its other formats), and as grids of VTK and
PyVista. All of them order the nodes of a cell as VTK does, and so does this package."""
from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arrays import FloatArray, IntArray
from ._call import logger
from ._words import listing, meant
from .errors import ArgumentError, MeshError
from .mesh import CELL_TYPES, CELLS, Mesh

if TYPE_CHECKING:
    import meshio

    from .result import Result
    from .solver import Solver

# meshio's names of our cells.
NAMES = {"triangle": "tri3", "quad": "quad4", "tetra": "tet4", "hexahedron": "hex8", "triangle6": "tri6",
         "quad8": "quad8", "quad9": "quad9", "tetra10": "tet10", "hexahedron20": "hex20"}
# VTK's numbers of meshio's cells, those of faces of interfaces included.
VTK_TYPES = {"line": 3, "triangle": 5, "quad": 9, "tetra": 10, "hexahedron": 12, "line3": 21, "triangle6": 22,
             "quad8": 23, "tetra10": 24, "hexahedron20": 25, "quad9": 28}
# Cell data in which meshers and solvers keep the labels of bodies, the first that exists counts.
LABELS = ("bodies", "gmsh:physical", "medit:ref", "cell_tags", "gmsh:geometrical", "body", "part", "region", "material",
          "CellEntityIds", "MaterialIds", "ElementBlockIds")
# meshio's names of the cells of a result by dimension and number of nodes, and of the faces of its interfaces.
_RESULT_CELLS = {2: {3: "triangle", 4: "quad", 6: "triangle6", 8: "quad8", 9: "quad9"},
                 3: {4: "tetra", 8: "hexahedron", 10: "tetra10", 20: "hexahedron20"}}
_RESULT_FACES = {2: {2: "line", 3: "line3"}, 3: {3: "triangle", 4: "quad", 6: "triangle6", 8: "quad8", 9: "quad9"}}


class Grid(NamedTuple):
    """Points [n][3], blocks of cells (meshio's name of their type, connectivity [cells][nodes of a cell]), data over
    points [n] or [n][columns], and over cells in the order of the blocks."""

    points: FloatArray
    blocks: list[tuple[str, IntArray]]
    point_data: dict[str, NDArray[Any]]
    cell_data: dict[str, NDArray[Any]]

    def to_meshio(self) -> meshio.Mesh:
        """As a meshio.Mesh. ImportError: meshio is not installed."""
        ends = np.cumsum([len(cells) for _, cells in self.blocks])[:-1]
        return _meshio().Mesh(self.points, self.blocks, point_data=self.point_data,
                              cell_data={name: np.split(values, ends) for name, values in self.cell_data.items()})

    def to_vtk(self) -> Any:
        """As a vtkUnstructuredGrid. ImportError: VTK is not installed."""
        model, support = _vtk()
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
        """As a pyvista.UnstructuredGrid. ImportError: PyVista is not installed."""
        try:
            import pyvista
        except ImportError:
            raise ImportError("this needs PyVista; to_vtk() needs VTK alone (Debian: python3-vtk9)") from None
        return pyvista.wrap(self.to_vtk())


def _meshio() -> Any:
    try:
        import meshio
    except ImportError:
        raise ImportError("reading and writing meshes needs meshio (Debian: python3-meshio)") from None
    return meshio


def _vtk() -> tuple[Any, Any]:
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


# ---- in


def read(source: meshio.Mesh | str | os.PathLike[str], bodies: str | Sequence[str] | None = None,
         interfaces: bool = True) -> Mesh:
    """The cells of highest dimension of a meshio.Mesh or of a file; those of lower dimension (edges, faces of solids)
    are left out. Plane cells make a mesh in 2D; all must have the same z.

    bodies      name of the cell data with a label for each cell, or names of cell sets, which become the bodies 0, 1
                ..; None: the first of delam.meshes.LABELS that exists (bodies, gmsh:physical, medit:ref, cell_tags,
                gmsh:geometrical, body, part, region, material, CellEntityIds, MaterialIds, ElementBlockIds), else the
                cell sets if each cell is in one of them, else one body
    interfaces  pair the faces that bodies share (they may share nodes, these are doubled)

    Nodes keep their indices. body_names of the mesh has {label: name} if the source names its groups. Cells that are
    numbered clockwise or inside out are turned round. The logger "delam" is told what was taken for bodies, how many
    cells were turned, and, as a warning, of labels that nobody asked for and of bodies that touch no other. MeshError:
    cells that have no place here; ArgumentError: there are no such data or sets, a cell is in none or several of them,
    or a label is no integer."""
    if isinstance(source, (str, os.PathLike)):
        source = _meshio().read(source)
    blocks = [(block.type, np.asarray(block.data, np.int64)) for block in source.cells]
    chosen = _chosen([name for name, _ in blocks])
    labels, names = _labels(source, blocks, chosen, bodies)
    dimension = 3 if CELL_TYPES[NAMES[blocks[chosen[0]][0]]].dimension == 3 else 2
    if not names:
        names = {int(tag): name for name, (tag, of) in source.field_data.items()
                 if of == dimension and any(tag in label for label in labels)}
    return _made(np.asarray(source.points, np.float64), [blocks[i] for i in chosen], labels, names, interfaces)


def from_vtk(grid: Any, bodies: str | None = None, interfaces: bool = True) -> Mesh:
    """The cells of highest dimension of a vtkUnstructuredGrid, or of a grid of PyVista, as `read` takes those of
    meshio. bodies: name of the cell array with a label for each cell; None: the first of LABELS that exists, else one
    body."""
    model, support = _vtk()
    if not isinstance(grid, model.vtkUnstructuredGrid):
        raise ArgumentError(f"grid = {type(grid).__name__}, expected a vtkUnstructuredGrid or one of PyVista")
    known = {number: name for name, number in VTK_TYPES.items()}
    types = support.vtk_to_numpy(grid.GetCellTypesArray()) if grid.GetNumberOfCells() else np.empty(0, np.uint8)
    offsets = support.vtk_to_numpy(grid.GetCells().GetOffsetsArray()).astype(np.int64)
    nodes = support.vtk_to_numpy(grid.GetCells().GetConnectivityArray()).astype(np.int64)
    data = grid.GetCellData()
    there = [data.GetArrayName(i) for i in range(data.GetNumberOfArrays())]
    name = _label_name(bodies, there)
    labels = np.zeros(len(types), np.int64)
    if name is not None:
        labels = _integers(name, support.vtk_to_numpy(data.GetArray(name)))
    if bodies is None:
        _tell_bodies(name, {name: [support.vtk_to_numpy(data.GetArray(name))] for name in there if data.GetArray(name)})
    rows = [np.flatnonzero(types == number) for number in np.unique(types)]
    blocks = [(known.get(int(types[row[0]]), f"VTK type {types[row[0]]}"),
               nodes[offsets[row][:, None] + np.arange(offsets[row[0] + 1] - offsets[row[0]])]) for row in rows]
    chosen = _chosen([name for name, _ in blocks])
    points = np.asarray(support.vtk_to_numpy(grid.GetPoints().GetData()), np.float64)
    return _made(points, [blocks[i] for i in chosen], [labels[rows[i]] for i in chosen], {}, interfaces)


def _chosen(types: Sequence[str]) -> list[int]:
    """Which blocks of cells make the bodies."""
    kinds = [NAMES.get(name) for name in types]
    solid = [i for i, kind in enumerate(kinds) if kind is not None and CELL_TYPES[kind].dimension == 3]
    chosen = solid or [i for i, kind in enumerate(kinds) if kind is not None]
    if not chosen:
        there = ", ".join(sorted(set(types))) or "none"
        raise MeshError(f"no cells of a known type; there are {there}, known are {', '.join(NAMES)}")
    unknown = sorted({name for name, kind in zip(types, kinds) if kind is None and _fills(name, bool(solid))})
    if unknown:
        raise MeshError(f"cells of type {', '.join(unknown)} have no place here; known are {', '.join(NAMES)}")
    return chosen


def _fills(kind: str, solid: bool) -> bool:
    """Whether an unknown cell type belongs to a body, which is then incomplete."""
    volumes = ("tetra", "hexahedron", "wedge", "pyramid", "VTK type")
    surfaces = ("triangle", "quad")
    return kind.startswith(volumes if solid else volumes + surfaces)


def _label_name(bodies: str | None, there: Iterable[str]) -> str | None:
    there = list(there)
    if bodies is None:
        return next((name for name in LABELS if name in there), None)
    if bodies not in there:
        raise ArgumentError(f"bodies = {bodies!r} is no cell data{meant(bodies, there)}; there are "
                            f"{', '.join(there) or 'none'}")
    return bodies


def _are_integers(values: NDArray[Any]) -> bool:
    return values.ndim == 1 and values.dtype.kind in "iuf" and bool((values == np.rint(values)).all())


def _integers(name: str, values: ArrayLike) -> IntArray:
    """Labels of cells."""
    array = np.asarray(values)
    if not _are_integers(array):
        what = f"has shape {array.shape} and type {array.dtype}"
        if array.ndim == 1 and array.dtype.kind == "f":
            wrong = int(np.flatnonzero(array != np.rint(array))[0])
            what = f"of cell {wrong} is {array[wrong]}"
        raise ArgumentError(f"cell data {name!r} {what}; labels of bodies are integers, one for each cell")
    return array.astype(np.int64)


def _tell_bodies(taken: str | None, data: Mapping[str, Sequence[ArrayLike]], sets: Sequence[str] = ()) -> None:
    """Logs what was taken for bodies where nobody has said it. sets: those that say it not of every cell."""
    rivals = []
    for name, parts in data.items():
        arrays = [np.asarray(part) for part in parts]
        if name != taken and all(map(_are_integers, arrays)) and len(np.unique(np.concatenate(arrays))) > 1:
            rivals.append(name)
    if taken is not None:
        also = f"; bodies= takes others: {listing(rivals)}" if rivals else ""
        logger.info("the bodies are those of cell data %r%s", taken, also)
    elif rivals:
        logger.warning("all cells make one body, because no cell data have one of the names %s; labels may be in %s: "
                       "bodies=%r takes them", ", ".join(LABELS), listing(rivals), rivals[0])
    elif sets:
        logger.warning("all cells make one body, because some are in none or in several of the cell sets %s; "
                       "bodies=[..] chooses among these", listing(sets))
    else:
        logger.info("all cells make one body: the mesh has no labels")


def _of_blocks(source: Any, chosen: list[int]) -> dict[str, list[Any]]:
    """Cell data of the chosen blocks."""
    return {name: [parts[i] for i in chosen] for name, parts in source.cell_data.items()}


def _labels(source: Any, blocks: list[tuple[str, IntArray]], chosen: list[int],
            bodies: str | Sequence[str] | None) -> tuple[list[NDArray[Any]], dict[int, str]]:
    """The label of each cell of the chosen blocks, and the names of labels that cell sets make."""
    if bodies is None or isinstance(bodies, str):
        name = _label_name(bodies, source.cell_data)
        if name is not None:
            if bodies is None:
                _tell_bodies(name, _of_blocks(source, chosen))
            return [_integers(name, source.cell_data[name][i]) for i in chosen], {}
    sets = {name: parts for name, parts in source.cell_sets.items() if ":" not in name}
    names = list(sets) if bodies is None else list(bodies)
    lost = [name for name in names if name not in source.cell_sets]
    if lost:
        raise ArgumentError(f"bodies = {bodies!r}: {lost[0]!r} is no cell set; there are {', '.join(sets) or 'none'}")
    if bodies is None:  # sets of edges and faces make no bodies
        names = [name for name in names if any(np.size(sets[name][i]) for i in chosen)]
    labels = [np.full(len(blocks[i][1]), -1, np.int64) for i in chosen]
    times = [np.zeros(len(label), np.int64) for label in labels]
    for number, name in enumerate(names):
        for label, count, i in zip(labels, times, chosen):
            rows = np.asarray(source.cell_sets[name][i] if source.cell_sets[name][i] is not None else [], np.int64)
            label[rows] = number
            count[rows] += 1
    if all((count == 1).all() for count in times):
        if bodies is None:
            logger.info("the bodies are the cell sets %s", listing(names))
        return labels, dict(enumerate(names))
    if bodies is None:
        _tell_bodies(None, _of_blocks(source, chosen), names)
        return [np.zeros(len(label), np.int64) for label in labels], {}
    wrong = sum(int((count != 1).sum()) for count in times)
    raise ArgumentError(f"bodies = {bodies!r}: {wrong} cells are in none or in several of these sets")


def _reversal(kind: str) -> IntArray:
    """Where each node of a cell of this kind stands in its mirror image."""
    cell = CELL_TYPES[kind]
    corners = {3: [0, 2, 1], 4: [0, 3, 2, 1]}[cell.corners] if cell.dimension == 2 else (
        {4: [0, 2, 1, 3], 8: [0, 3, 2, 1, 4, 7, 6, 5]}[cell.corners])
    between = {frozenset(pair): cell.corners + i for i, pair in enumerate(cell.middle.tolist())}
    middle = [between[frozenset((corners[a], corners[b]))] for a, b in cell.middle.tolist()]
    return np.array([*corners, *middle], np.int64)


def _turned(points: FloatArray, kind: str, cells: IntArray) -> IntArray:
    """The cells with those turned round whose corners go clockwise or inside out: whose Jacobian at the centre is
    negative."""
    if cells.size == 0 or cells.min() < 0 or cells.max() >= len(points):
        return cells
    cell = CELL_TYPES[kind]
    x = points[cells[:, :cell.corners]]
    if cell.dimension == 2:
        after = np.roll(x, -1, axis=1)
        size = (x[..., 0] * after[..., 1] - x[..., 1] * after[..., 0]).sum(1)
    else:
        ends = ([1], [0]), ([2], [0]), ([3], [0])
        if cell.corners == 8:
            ends = ([1, 2, 5, 6], [0, 3, 4, 7]), ([2, 3, 6, 7], [0, 1, 4, 5]), ([4, 5, 6, 7], [0, 1, 2, 3])
        edges = np.stack([x[:, there].mean(1) - x[:, here].mean(1) for there, here in ends], axis=1)
        size = np.linalg.det(edges)
    wrong = size < 0
    if wrong.any():
        logger.info("%d of %d cells of type %s were numbered %s and were turned round", wrong.sum(), len(cells), kind,
                    "clockwise" if cell.dimension == 2 else "inside out")
        cells = np.where(wrong[:, None], cells[:, _reversal(kind)], cells)
    return cells


def _distance(one: FloatArray, other: FloatArray) -> float:
    """Of the nearest nodes; of large bodies an upper bound, from some nodes and their nearest ones in turn."""
    few, many = (one, other) if len(one) < len(other) else (other, one)
    step = 1 + int(len(few) * len(many) / 2e7)
    best, at = min((float(np.linalg.norm(many - place, axis=1).min()), i) for i, place in enumerate(few[::step]))
    place = few[at * step]
    for nodes in (many, few) * 3:
        distances = np.linalg.norm(nodes - place, axis=1)
        best, place = min(best, float(distances.min())), nodes[distances.argmin()]
    return best


def _warn_of_lone_bodies(mesh: Mesh) -> None:
    """Those that share no face with another."""
    joined = {body for interface in mesh.interfaces for body in (interface.body_a, interface.body_b)}
    lone = [body for body in mesh._labels() if body not in joined]
    if not lone:
        return
    nodes, bodies = mesh.nodes, mesh.node_bodies
    first = lone[0]
    distance = _distance(nodes[bodies == first], nodes[(bodies != first) & (bodies >= 0)])
    logger.warning("no interface was made for %s %s, whose faces coincide with none of another body; the nearest nodes "
                   "of body %s and of others are %.3g apart. Mesh.add_interface(tolerance=..) or, where meshes do not "
                   "match, Mesh.add_projected_interface(gap=..) joins faces at a distance",
                   "bodies" if len(lone) > 1 else "body", listing(lone), first, distance)


def _made(points: FloatArray, blocks: list[tuple[str, IntArray]], labels: list[NDArray[Any]], names: dict[int, str],
          interfaces: bool) -> Mesh:
    if CELL_TYPES[NAMES[blocks[0][0]]].dimension == 2 and points.shape[1] == 3:
        used = points[np.unique(np.concatenate([np.ravel(cells) for _, cells in blocks]))]
        if used.size and np.ptp(used[:, 2]) > 1e-9 * np.ptp(used[:, :2]):
            low, high = used[:, 2].min(), used[:, 2].max()
            raise MeshError(f"plane cells have z from {low:g} to {high:g}: shells have no place here")
        points = points[:, :2]
    mesh = Mesh(points)
    for (name, cells), label in zip(blocks, labels):
        mesh.add_conforming_cells(NAMES[name], _turned(points, NAMES[name], cells), label)
    mesh.body_names = names
    if interfaces and mesh.body_count > 1:
        mesh.add_all_interfaces()
        _warn_of_lone_bodies(mesh)
    return mesh


# ---- out


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
