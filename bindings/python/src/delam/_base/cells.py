# SPDX-License-Identifier: BSD-3-Clause
"""Types of cells, and the cells of a mesh."""
from __future__ import annotations

import ctypes
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .arrays import IntArray, pointer
from .errors import ArgumentError
from .library import library


class CellType(NamedTuple):
    """Describes a cell type in the library's own numbers."""

    number: int
    nodes: int
    dimension: int
    corners: int
    faces: list[NDArray[np.int32]]  # [faces][nodes of the face], local nodes: corners in outward order, then the others
    middle: NDArray[np.int32]  # [nodes - corners][2], the corners on either side of each node that is not a corner


def cell_types() -> dict[str, CellType]:
    """{name: CellType} of all types that the library has."""
    found = {}
    for index in range(library.delam_cell_type_count()):
        name = ctypes.c_char_p()
        type_, dimension, nodes, corners, faces, face_nodes = (ctypes.c_int32() for _ in range(6))
        library.delam_cell_type_info(index, name, type_, dimension, nodes, corners, faces, face_nodes, None)
        face = np.empty((faces.value, face_nodes.value), np.int32)
        middle = np.empty((nodes.value - corners.value, 2), np.int32)
        library.delam_cell_type_topology(index, pointer(face), pointer(middle))
        found[(name.value or b"").decode()] = CellType(type_.value, nodes.value, dimension.value, corners.value,
                                                       [row[row >= 0] for row in face], middle)
    return found


CELL_TYPES = cell_types()
# Name: (number, nodes of a cell)
CELLS = {name: (cell.number, cell.nodes) for name, cell in CELL_TYPES.items()}
_CELL_NAMES = {number: name for name, (number, _) in CELLS.items()}


def cell_type(name: str) -> tuple[int, int]:
    """Number and nodes of a cell type; ArgumentError: there is none of this name."""
    if name not in CELLS:
        raise ArgumentError(f"cells = {name!r} is no cell type; known are {', '.join(CELLS)}")
    return CELLS[name]


class Cells(NamedTuple):
    """Cells in the order they were added: types [cells], numbers of CELLS; bodies [cells], labels; connectivity, the
    nodes of cell c at offsets[c] .. offsets[c+1]-1, with offsets [cells + 1]."""

    types: NDArray[np.int32]
    bodies: NDArray[np.int32]
    offsets: IntArray
    connectivity: IntArray

    def of(self, name: str) -> IntArray:
        """Connectivity [n][nodes of a cell] of the cells of one type, "quad4" for instance. ArgumentError: there is no
        such type."""
        number, size = cell_type(name)
        rows = np.flatnonzero(self.types == number)
        nodes: IntArray = self.connectivity[self.offsets[rows][:, None] + np.arange(size)]
        return nodes

    def names(self) -> list[str]:
        """The cell types that the mesh has, by name."""
        return [_CELL_NAMES[number] for number in sorted(set(self.types.tolist()))]
