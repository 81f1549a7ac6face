# SPDX-License-Identifier: BSD-3-Clause
"""Meshes through meshio: Gmsh, Abaqus, VTK, MED and its other formats. Its node orders are VTK's, and so are
those of this package."""
from __future__ import annotations

import os
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from .errors import ArgumentError, MeshError
from .mesh import CELL_TYPES, CELLS, Mesh

if TYPE_CHECKING:
    import meshio

# meshio's names of our cells.
NAMES = {"triangle": "tri3", "quad": "quad4", "tetra": "tet4", "hexahedron": "hex8", "triangle6": "tri6",
         "quad8": "quad8", "quad9": "quad9", "tetra10": "tet10", "hexahedron20": "hex20"}
# Where meshers keep the labels of bodies.
LABELS = ("bodies", "gmsh:physical", "medit:ref", "cell_tags", "gmsh:geometrical")


def _meshio() -> Any:
    try:
        import meshio
    except ImportError:
        raise ImportError("reading and writing meshes needs meshio (Debian: python3-meshio)") from None
    return meshio


def read(source: meshio.Mesh | str | os.PathLike[str], bodies: str | None = None,
         interfaces: bool = True) -> Mesh:
    """The cells of highest dimension of a meshio.Mesh or of a file; those of lower dimension (edges, faces of solids)
    are left out. Plane cells make a mesh in 2D; all must have the same z.

    bodies      name of the cell data with a label for each cell; None: the first of `LABELS` that exists, else one
                body
    interfaces  pair the faces that bodies share (they may share nodes, these are doubled)

    Nodes keep their indices. body_names of the mesh has {label: name} if the file names its groups."""
    if isinstance(source, (str, os.PathLike)):
        source = _meshio().read(source)
    kinds = [NAMES.get(block.type) for block in source.cells]
    solid = [i for i, kind in enumerate(kinds) if kind is not None and CELL_TYPES[kind].dimension == 3]
    chosen = solid or [i for i, kind in enumerate(kinds) if kind is not None]
    if not chosen:
        there = ", ".join(sorted({block.type for block in source.cells})) or "none"
        raise MeshError(f"no cells of a known type; there are {there}, known are {', '.join(NAMES)}")
    unknown = sorted({block.type for block, kind in zip(source.cells, kinds)
                      if kind is None and _fills(block.type, bool(solid))})
    if unknown:
        raise MeshError(f"cells of type {', '.join(unknown)} have no place here; known are {', '.join(NAMES)}")

    points = np.asarray(source.points, float)
    if not solid and points.shape[1] == 3:
        used = points[np.unique(np.concatenate([np.ravel(source.cells[i].data) for i in chosen]))]
        if used.size and np.ptp(used[:, 2]) > 1e-9 * np.ptp(used[:, :2]):
            low, high = used[:, 2].min(), used[:, 2].max()
            raise MeshError(f"plane cells have z from {low:g} to {high:g}: shells have no place here")
        points = points[:, :2]

    if bodies is None:
        bodies = next((name for name in LABELS if name in source.cell_data), None)
    elif bodies not in source.cell_data:
        raise ArgumentError(f"bodies = {bodies!r} is no cell data; there are {', '.join(source.cell_data) or 'none'}")
    mesh = Mesh(points)
    labels = set()
    for i in chosen:
        count = len(source.cells[i].data)
        label = np.zeros(count, np.int64) if bodies is None else np.asarray(source.cell_data[bodies][i])
        labels.update(np.unique(label).tolist())
        mesh.add_conforming_cells(str(kinds[i]), np.asarray(source.cells[i].data, np.int64), label.astype(np.int64))
    dimension = points.shape[1]
    mesh.body_names = {int(tag): name for name, (tag, of) in source.field_data.items()
                       if of == dimension and tag in labels}
    if interfaces and mesh.body_count > 1:
        mesh.add_all_interfaces()
    return mesh


def _fills(kind: str, solid: bool) -> bool:
    """Whether an unknown cell type belongs to a body, which is then incomplete."""
    volumes = ("tetra", "hexahedron", "wedge", "pyramid")
    surfaces = ("triangle", "quad")
    return kind.startswith(volumes if solid else volumes + surfaces)


def write(mesh: Mesh, point_data: Mapping[str, ArrayLike] | None = None,
          cell_data: Mapping[str, ArrayLike] | None = None) -> meshio.Mesh:
    """A meshio.Mesh with the nodes and cells of `mesh`; plane ones get z = 0. cell_data are arrays over all cells, in
    the order they were added; "bodies" is among them."""
    meshio = _meshio()
    nodes, cells = mesh.nodes, mesh.cells
    if nodes.shape[1] == 2:
        nodes = np.column_stack([nodes, np.zeros(len(nodes))])
    back = {ours: theirs for theirs, ours in NAMES.items()}
    data: dict[str, Any] = {"bodies": cells.bodies, **(cell_data or {})}
    blocks, rows = [], []
    for name in cells.names():
        if name not in back:
            raise ArgumentError(f"cells of type {name} have no name in meshio")
        blocks.append((back[name], cells.of(name)))
        rows.append(np.flatnonzero(cells.types == CELLS[name][0]))
    for name, values in data.items():
        if len(values) != len(cells.types):
            raise ArgumentError(f"cell_data[{name!r}] has {len(values)} rows, expected {len(cells.types)}")
    return meshio.Mesh(nodes, blocks, point_data=point_data,
                       cell_data={name: [np.asarray(values)[row] for row in rows] for name, values in data.items()})
