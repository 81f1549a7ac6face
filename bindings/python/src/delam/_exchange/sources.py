# SPDX-License-Identifier: BSD-3-Clause
"""Meshes of meshio, VTK and PyVista as arrays of which a Mesh is made."""
from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._base.arrays import FloatArray, IntArray
from .._base.call import logger
from .._base.cells import CELL_TYPES
from .._base.errors import ArgumentError, MeshError
from .._base.words import listing, meant
from .files import family_labels, groups_of, read_file
from .grids import NAMES, VTK_TYPES, vtk_modules

if TYPE_CHECKING:
    import meshio

# Cell data in which meshers and solvers keep the labels of bodies, the first that exists counts.
LABELS = ("bodies", "gmsh:physical", "medit:ref", "cell_tags", "gmsh:geometrical", "body", "part", "region", "material",
          "CellEntityIds", "MaterialIds", "ElementBlockIds", "nastran:ref", "avsucd:material")


class Source(NamedTuple):
    """Points [n][2 or 3], blocks of cells of one type with a label for each cell, and the names of labels."""

    points: FloatArray
    blocks: list[tuple[str, IntArray, NDArray[Any]]]
    names: dict[int, str]


def of_meshio(source: meshio.Mesh | str | os.PathLike[str], bodies: str | Sequence[str] | None) -> Source:
    """Returns the part of a meshio.Mesh, or of a file, that meshes.read takes."""
    if isinstance(source, (str, os.PathLike)):
        source = read_file(source)
    blocks = [(block.type, np.asarray(block.data, np.int64)) for block in source.cells]
    chosen = _chosen([name for name, _ in blocks])
    labels, names = _labels(source, blocks, chosen, bodies)
    dimension = 3 if CELL_TYPES[NAMES[blocks[chosen[0]][0]]].dimension == 3 else 2
    if not names:
        names = {int(tag): name for name, (tag, of) in source.field_data.items()
                 if of == dimension and any(tag in label for label in labels)}
    return _turned(np.asarray(source.points, np.float64), [blocks[i] for i in chosen], labels, names)


def of_vtk(grid: Any, bodies: str | None) -> Source:
    """Returns the part of a grid that meshes.from_vtk takes."""
    model, support = vtk_modules()
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
    return _turned(points, [blocks[i] for i in chosen], [labels[rows[i]] for i in chosen], {})


def _turned(points: FloatArray, blocks: list[tuple[str, IntArray]], labels: list[NDArray[Any]],
            names: dict[int, str]) -> Source:
    """In the plane where the cells are plane ones, with all cells turned the right way round."""
    if CELL_TYPES[NAMES[blocks[0][0]]].dimension == 2 and points.shape[1] == 3:
        used = points[np.unique(np.concatenate([np.ravel(cells) for _, cells in blocks]))]
        if used.size and np.ptp(used[:, 2]) > 1e-9 * np.ptp(used[:, :2]):
            low, high = used[:, 2].min(), used[:, 2].max()
            raise MeshError(f"plane cells have z from {low:g} to {high:g}: shells have no place here")
        points = points[:, :2]
    kinds = [NAMES[name] for name, _ in blocks]
    cells = [_turned_cells(points, kind, block) for kind, (_, block) in zip(kinds, blocks)]
    return Source(points, list(zip(kinds, cells, labels)), names)


def _chosen(types: Sequence[str]) -> list[int]:
    """Returns the indices of the blocks of cells that make the bodies."""
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
    """True if an unknown cell type belongs to a body, which is then incomplete."""
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
    groups = groups_of(source)
    if bodies is None or isinstance(bodies, str):
        name = _label_name(bodies, source.cell_data)
        if name is not None and not (bodies is None and name == "cell_tags" and groups):
            if bodies is None:
                _tell_bodies(name, _of_blocks(source, chosen))
            if name == "cell_tags":
                return family_labels(source, chosen)
            return [_integers(name, source.cell_data[name][i]) for i in chosen], {}
    sets = {name: parts for name, parts in {**source.cell_sets, **groups}.items() if ":" not in name}
    names = list(sets) if bodies is None else list(bodies)
    lost = [name for name in names if name not in sets and name not in source.cell_sets]
    if lost:
        raise ArgumentError(f"bodies = {bodies!r}: {lost[0]!r} is no cell set; there are {', '.join(sets) or 'none'}")
    if bodies is None:  # sets of edges and faces make no bodies
        names = [name for name in names if any(np.size(sets[name][i]) for i in chosen)]
    labels = [np.full(len(blocks[i][1]), -1, np.int64) for i in chosen]
    times = [np.zeros(len(label), np.int64) for label in labels]
    for number, name in enumerate(names):
        for label, count, i in zip(labels, times, chosen):
            of = sets[name] if name in sets else source.cell_sets[name]
            rows = np.asarray(of[i] if of[i] is not None else [], np.int64)
            label[rows] = number
            count[rows] += 1
    if all((count == 1).all() for count in times):
        if bodies is None:
            logger.info("the bodies are the cell sets %s", listing(names))
        return labels, dict(enumerate(names))
    if bodies is None and groups:
        logger.info("the bodies are the families of cells in the same groups %s; bodies=[..] chooses among these",
                    listing(names))
        return family_labels(source, chosen)
    if bodies is None:
        _tell_bodies(None, _of_blocks(source, chosen), names)
        return [np.zeros(len(label), np.int64) for label in labels], {}
    wrong = sum(int((count != 1).sum()) for count in times)
    raise ArgumentError(f"bodies = {bodies!r}: {wrong} cells are in none or in several of these sets")


def _reversal(kind: str) -> IntArray:
    """Returns the place that each node of a cell of this kind has in its mirror image."""
    cell = CELL_TYPES[kind]
    corners = {3: [0, 2, 1], 4: [0, 3, 2, 1]}[cell.corners] if cell.dimension == 2 else (
        {4: [0, 2, 1, 3], 8: [0, 3, 2, 1, 4, 7, 6, 5], 6: [3, 4, 5, 0, 1, 2], 5: [0, 3, 2, 1, 4]}[cell.corners])
    between = {frozenset(pair): cell.corners + i for i, pair in enumerate(cell.middle.tolist())}
    middle = [between[frozenset((corners[a], corners[b]))] for a, b in cell.middle.tolist()]
    return np.array([*corners, *middle], np.int64)


def _turned_cells(points: FloatArray, kind: str, cells: IntArray) -> IntArray:
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
        elif cell.corners == 6:
            ends = ([1, 4], [0, 3]), ([2, 5], [0, 3]), ([0, 1, 2], [3, 4, 5])
        elif cell.corners == 5:
            ends = ([1, 2], [0, 3]), ([2, 3], [0, 1]), ([4], [0, 1, 2, 3])
        edges = np.stack([x[:, there].mean(1) - x[:, here].mean(1) for there, here in ends], axis=1)
        size = np.linalg.det(edges)
    wrong = size < 0
    if wrong.any():
        how = "clockwise" if cell.dimension == 2 else "as by Gmsh and Abaqus" if cell.corners == 6 else "inside out"
        logger.info("%d of %d cells of type %s were numbered %s and were turned round", wrong.sum(), len(cells), kind,
                    how)
        cells = np.where(wrong[:, None], cells[:, _reversal(kind)], cells)
    return cells
