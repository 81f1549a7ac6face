# SPDX-License-Identifier: BSD-3-Clause
"""Meshes and results in and out: through meshio (Gmsh, Abaqus, VTK, MED and its other formats), and as grids of VTK and
PyVista. All of them order the nodes of a cell as VTK does, and so does this package."""
from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from ._exchange.grids import NAMES, VTK_TYPES, Grid, grid_of, model_points, result_grid, solver_grid, write
from ._exchange.sources import LABELS
from .mesh import Mesh

if TYPE_CHECKING:
    import meshio

__all__ = ["Grid", "LABELS", "NAMES", "VTK_TYPES", "from_vtk", "grid_of", "model_points", "read", "result_grid",
           "solver_grid", "write"]


def read(source: meshio.Mesh | str | os.PathLike[str], bodies: str | Sequence[str] | None = None,
         interfaces: bool = True) -> Mesh:
    """The cells of highest dimension of a meshio.Mesh or of a file; those of lower dimension (edges, faces of solids)
    are left out. Plane cells make a mesh in 2D; all must have the same z.

    bodies      name of the cell data with a label for each cell, or names of cell sets, which become the bodies 0, 1
                ..; None: the first of delam.meshes.LABELS that exists (bodies, gmsh:physical, medit:ref, cell_tags,
                gmsh:geometrical, body, part, region, material, CellEntityIds, MaterialIds, ElementBlockIds,
                nastran:ref, avsucd:material), else the cell sets if each cell is in one of them, else one body.
                Groups of MED count as cell sets; where cells are in several, each combination is a body
    interfaces  pair the faces that bodies share (they may share nodes, these are doubled)

    Nodes keep their indices. body_names of the mesh has {label: name} if the source names its groups. Cells that are
    numbered clockwise or inside out are turned round. The logger "delam" is told what was taken for bodies, how many
    cells were turned, and, as a warning, of labels that nobody asked for and of bodies that touch no other.

    FileError: meshio cannot read the file. MeshError: cells that have no place here. ArgumentError: there are no such
    data or sets, a cell is in none or several of them, or a label is no integer."""
    return Mesh.from_meshio(source, bodies, interfaces)


def from_vtk(grid: Any, bodies: str | None = None, interfaces: bool = True) -> Mesh:
    """The cells of highest dimension of a vtkUnstructuredGrid, or of a grid of PyVista, as `read` takes those of
    meshio. bodies: name of the cell array with a label for each cell; None: the first of LABELS that exists, else one
    body."""
    return Mesh.from_vtk(grid, bodies, interfaces)
