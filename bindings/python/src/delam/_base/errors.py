# SPDX-License-Identifier: BSD-3-Clause
"""Exceptions and warnings, which delam.errors describes."""
from __future__ import annotations

from typing import Any

from . import raw
from .library import library
from .words import in_python


class DelamError(Exception):
    """An error or an outcome of the library. `status` is its number, `name` the constant of the C header; `history` has
    the rows so far where Solver.history has raised it."""

    status: int = raw.DELAM_ERROR_INTERNAL
    history: Any = None  # a History, whose class lies above

    def __init__(self, message: str, status: int | None = None) -> None:
        super().__init__(message)
        if status is not None:
            self.status = status

    @property
    def name(self) -> str:
        """Constant of the C header, such as "DELAM_ERROR_ARGUMENT"."""
        return str(library.delam_status_name(self.status).decode())


class ArgumentError(DelamError, ValueError):
    """A value outside its range, an array of the wrong shape or type, an index past the end."""

    status = raw.DELAM_ERROR_ARGUMENT


class HandleError(DelamError, ValueError):
    """An object that was closed, or is not of this library."""

    status = raw.DELAM_ERROR_HANDLE


class MeshError(DelamError, ValueError):
    """Inverted cell, shared node, faces that do not match."""

    status = raw.DELAM_ERROR_MESH


class ProblemError(DelamError, ValueError):
    """Incomplete or contradictory scene: missing material, missing support, bad law."""

    status = raw.DELAM_ERROR_PROBLEM


class StateError(DelamError, RuntimeError):
    """A call out of order, such as an advance with a step that is not yet committed."""

    status = raw.DELAM_ERROR_STATE


class OutOfMemory(DelamError, MemoryError):
    """The library could not get the memory that it asked for."""

    status = raw.DELAM_ERROR_MEMORY


class NumericalError(DelamError, ArithmeticError):
    """A factorisation broke down."""

    status = raw.DELAM_ERROR_NUMERICAL


class SnapshotError(DelamError, ValueError):
    """Saved bytes that are damaged, of another version or of another scene."""

    status = raw.DELAM_ERROR_SNAPSHOT


class FileError(DelamError, OSError):
    """A file that cannot be opened, read or written; the message says why."""

    status = raw.DELAM_ERROR_FILE


class InternalError(DelamError, RuntimeError):
    """A defect of the library: please report."""

    status = raw.DELAM_ERROR_INTERNAL


class Outcome(DelamError):
    """Not an error: the call ended without its full result, the object stays valid."""


class NotConverged(Outcome):
    """An iteration limit was reached, or forces do not balance; the best state found is pending: read, commit or roll
    it back."""

    status = raw.DELAM_NOT_CONVERGED


class Cancelled(Outcome):
    """Stopped on request; the state before the call is restored."""

    status = raw.DELAM_CANCELLED


class LimitReached(Outcome):
    """No equilibrium: a dead load acts on a part that nothing holds any more."""

    status = raw.DELAM_LIMIT


class NotConvergedWarning(RuntimeWarning):
    """The warning in place of NotConverged, if the solver is to continue."""


_KINDS: dict[int, type[DelamError]] = {
    kind.status: kind for kind in (ArgumentError, HandleError, MeshError, ProblemError, StateError, OutOfMemory,
                                   NumericalError, SnapshotError, FileError, InternalError, NotConverged, Cancelled,
                                   LimitReached)}


def error_of(status: int, message: str) -> DelamError:
    """The exception of a status; one that this package does not know is a DelamError with that number."""
    return _KINDS.get(status, DelamError)(in_python(message), status)
