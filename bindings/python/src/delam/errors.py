# SPDX-License-Identifier: BSD-3-Clause
"""Exceptions and warnings.

Errors of the library (status < 0) leave the object unchanged. Outcomes (status > 0) leave it valid:

NotConverged   an iteration limit was reached, or forces do not balance; the step is pending all the same. A
               warning, unless set otherwise: Solver(..., not_converged="warn" | "raise" | "ignore").
Cancelled      stopped on request; the state before the call is restored. Always raised.
LimitReached   no equilibrium: a dead load acts on a part that nothing holds any more. No step is pending. Always
               raised.
"""
from ._base.errors import (ArgumentError, Cancelled, DelamError, FileError, HandleError, InternalError, LimitReached,
                           MeshError, NotConverged, NotConvergedWarning, NumericalError, Outcome, OutOfMemory,
                           ProblemError, SnapshotError, StateError)

__all__ = ["ArgumentError", "Cancelled", "DelamError", "FileError", "HandleError", "InternalError", "LimitReached",
           "MeshError", "NotConverged", "NotConvergedWarning", "NumericalError", "OutOfMemory", "Outcome",
           "ProblemError", "SnapshotError", "StateError"]
