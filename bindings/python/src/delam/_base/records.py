# SPDX-License-Identifier: BSD-3-Clause
"""Defines what the objects return as named tuples: data that need no object of the library, and can be pickled."""
from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .arrays import FloatArray, IntArray


class Parameter(NamedTuple):
    """Description of a parameter or an option, as texts. type: "number", "integer" or "text"; unit: in terms of force
    and length; initial: the value without a setting, "" if it must be given; range: the admissible values."""

    key: str
    type: str
    unit: str
    initial: str
    range: str
    meaning: str


class Bounds(NamedTuple):
    """Between what a number lies. open: the bound itself is outside; infinite: there is no bound, numbers are
    finite."""

    lower: float
    upper: float
    lower_open: bool
    upper_open: bool

    def __contains__(self, value: Any) -> bool:
        above = value > self.lower if self.lower_open else value >= self.lower
        return bool(above and (value < self.upper if self.upper_open else value <= self.upper))


class Ties(NamedTuple):
    """Tied nodes: u of nodes[i] is the sum of weights[e] u of of[e] over e = starts[i] .. starts[i+1]-1; starts has an
    entry more than nodes."""

    nodes: IntArray
    starts: IntArray
    of: IntArray
    weights: FloatArray


class Forecast(NamedTuple):
    """Estimates an analysis that has not begun: its plan, its setup in s at a nominal rate, its memory in bytes."""

    plan: str
    setup: float
    memory: float


class Proposal(NamedTuple):
    """Numbers for the law of an interface; 0: unknown or none."""

    stiffness: float  #: the least, 50 E3/t of the adjacent layer
    share: float  #: of that layer's stiffness, what the present normal stiffness leaves
    normal_strength: float  #: the largest with which the process zone has enough pairs
    tangential_strength: float


class Sparse(NamedTuple):
    """A matrix by rows: the entries of row i are row_starts[i] .. row_starts[i+1]-1 of columns and values. For SciPy:
    csr_matrix((m.values, m.columns, m.row_starts), m.shape)."""

    shape: tuple[int, int]
    row_starts: IntArray
    columns: IntArray
    values: FloatArray

    def toarray(self) -> FloatArray:
        """The matrix in full, [rows][columns]; entries at the same place are summed."""
        out = np.zeros(self.shape)
        rows = np.repeat(np.arange(self.shape[0]), np.diff(self.row_starts))
        np.add.at(out, (rows, self.columns), self.values)
        return out


class ValueInfo(NamedTuple):
    """Describes a value of the library. cost: "free", "reads" (goes over pairs or fronts) or "recovers" (recovers the
    displacements, a sparse solve); scope: "whole", "interface" or "pattern"; alias: another name for it, or "";
    recorded: Solver.record takes it."""

    alias: str
    unit: str
    cost: str
    scope: str
    meaning: str
    recorded: bool


class Average(NamedTuple):
    """Over the volume of a body (in 2D its area): strain [6] and stress [6], xx, yy, zz, xy, yz, zx, shear strains
    doubled."""

    volume: float
    strain: FloatArray
    stress: FloatArray


class Condensed(NamedTuple):
    """All bodies condensed onto the interfaces, and the loads with them: at the factors theta the energy of bodies and
    dead forces is 1/2 x.S x - theta.L x + 1/2 theta.A theta, and the local jumps of all pairs, component by component,
    are N x + O theta. The energy stored in the interfaces is not included.

    stiffness  S [unknowns][unknowns], symmetric
    load       L [patterns][unknowns]
    constant   A [patterns][patterns]
    jump       N [dimension * pairs][unknowns]
    offset     O [dimension * pairs][patterns]"""

    stiffness: FloatArray
    load: FloatArray
    constant: FloatArray
    jump: Sparse
    offset: FloatArray


class Fronts(NamedTuple):
    """Crack fronts of an interface; front f has the points starts[f] .. starts[f+1]-1.

    starts        [fronts + 1]
    closed        [fronts] of bool: a loop
    places        [points][dimension]
    directions    [points][dimension], unit vectors along the interface, into the adhering part
    lengths       [points], 2D: length of the crack, 3D: length of front that belongs to a point
    rates         [points][3], energy release rates (energy per area) in modes I, II, III
    zone_lengths  [points], of the process zone
    zone_pairs    [points], pairs in the process zone"""

    starts: IntArray
    closed: NDArray[np.bool_]
    places: FloatArray
    directions: FloatArray
    lengths: FloatArray
    rates: FloatArray
    zone_lengths: FloatArray
    zone_pairs: FloatArray

    def lines(self) -> list[FloatArray]:
        """Positions [points of the front][dimension] of each front."""
        return [self.places[begin:end] for begin, end in zip(self.starts[:-1], self.starts[1:])]


class Jump(NamedTuple):
    """A jump of the state between the times `before` and `time` of a step: energies that are stored, dissipated and
    released by it (in 2D per unit of width), the area (in 2D length) that it debonded, the interface and the pairs
    where, and the reactions [patterns] before and after."""

    step: int
    before: float
    time: float
    stored: float
    dissipated: float
    released: float
    debonded: float
    interface: int
    first_pair: int
    last_pair: int
    reaction_before: FloatArray
    reaction_after: FloatArray


class PlanItem(NamedTuple):
    """A part of the method that the scene needs or that was left out, and why; cost and saving are predicted numbers of
    `unit`."""

    subject: str
    decision: str
    reason: str
    cost: float
    saving: float
    unit: str
