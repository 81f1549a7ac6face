# SPDX-License-Identifier: BSD-3-Clause
"""Protocols of the objects whose classes lie above a module: each lists what the module needs, under the class's
name."""
from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from contextlib import AbstractContextManager
from typing import Any, Protocol

from .arrays import FloatArray, IntArray
from .cells import Cells
from .records import Jump


class Interface(Protocol):
    """Its faces, as a picture of the bodies shows them."""

    @property
    def index(self) -> int: ...

    @property
    def nodes_b(self) -> IntArray: ...

    @property
    def faces(self) -> IntArray: ...


class Mesh(Protocol):
    """Its geometry, as pictures and grids show it."""

    @property
    def node_count(self) -> int: ...

    @property
    def nodes(self) -> FloatArray: ...

    @property
    def cells(self) -> Cells: ...

    @property
    def interfaces(self) -> Sequence[Interface]: ...


class Problem(Protocol):
    """Its mesh, what its patterns drive, and the call that sets an option."""

    @property
    def mesh(self) -> Mesh: ...

    @property
    def dimension(self) -> int: ...

    @property
    def _drives(self) -> Mapping[int, str]: ...

    def _call(self, function: Any, *arguments: Any, long: bool = False) -> None: ...


class Solver(Protocol):
    """The state that a History records, and that pictures and grids show."""

    @property
    def problem(self) -> Problem: ...

    @property
    def values(self) -> Mapping[str, float]: ...

    @property
    def time(self) -> float: ...

    @property
    def closed(self) -> bool: ...

    @property
    def _patterns(self) -> Sequence[str]: ...

    def field(self, name: str, interface: int | None = None) -> FloatArray: ...

    def option(self, key: str) -> str: ...

    def looking(self, step: int) -> AbstractContextManager[object]: ...

    def _names(self, values: Iterable[str] | None) -> tuple[str, ...]: ...

    def _aliased(self) -> Mapping[str, str]: ...

    def _jumps(self, first: int) -> list[Jump]: ...


class Result(Protocol):
    """The mesh and the fields of a result, as grids show them."""

    @property
    def about(self) -> Mapping[str, Any]: ...

    @property
    def nodes(self) -> FloatArray: ...

    @property
    def cells(self) -> Sequence[IntArray]: ...

    @property
    def cell_rows(self) -> Sequence[IntArray]: ...

    @property
    def bodies(self) -> IntArray: ...

    def fields(self, step: int = -1) -> Mapping[str, Any]: ...

    def _interface(self, name: str) -> tuple[FloatArray, IntArray]: ...
