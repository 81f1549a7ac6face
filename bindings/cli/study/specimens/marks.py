# SPDX-License-Identifier: BSD-3-Clause
"""Crack lengths and where they were read: in the rows of the test, or in a sheet apart that has the time or the
displacement beside them. In SI."""
import numpy as np

from command import Trouble
from measured.columns import found, label, named
from measured.one_test import read_test
from measured.units import kind_of

WIDER = 0.02  # part of the range of the test by which readings of an operator may lie outside


def size_of(table, k, text, kind):
    """The size of a unit in SI, which must be of this kind."""
    if not text:
        raise Trouble(f"{table.path}: {label(table, k)} has no unit: --units mm N names those of displacement and load")
    if kind_of(text)[0] != kind:
        raise Trouble(f"{table.path}: {label(table, k)}: {text[:60]} is no unit of {kind} (--columns X Y takes other columns)")
    return kind_of(text)[1]


def crack_column(table, given):
    """The place of the column with crack lengths, None where there is none, and these lengths."""
    which = [named(table, given.crack)] if given.crack else found(table, "crack")[:1]
    if not which:
        return None, None
    k = which[0]
    unit = table.units[k] or (given.units or table.units)[0]
    if kind_of(unit)[0] != "length":
        raise Trouble(f"{table.path}: {label(table, k)} has no unit of length: \"Crack (mm)\", for example")
    return k, table.columns[k] * kind_of(unit)[1]


def farthest(displacement, there):
    """The largest displacement before each row."""
    return np.maximum.accumulate(np.where(there, displacement, -np.inf))


def placed(displacement, load, crack, before, wide):
    """Displacement, load and crack of the marks that count, along the test: one for each length, and none where the test is
    unloaded; and a sentence for each kind that does not. before: the largest displacement until each; wide: the range."""
    way = displacement >= before - WIDER * wide
    off = int(np.sum(~way))
    displacement, load, crack = displacement[way], load[way], crack[way]
    longest = np.maximum.accumulate(crack) if len(crack) else crack
    new = np.concatenate([[True], crack[1:] > longest[:-1]]) if len(crack) else np.zeros(0, dtype=bool)
    shorter = int(np.sum(crack < longest))
    left = []
    if off:
        left.append(f"{off} mark{'s' * (off > 1)} on an unloading {'are' if off > 1 else 'is'} left out")
    if shorter:
        left.append(f"{shorter} mark{'s' * (shorter > 1)} behind a longer crack {'are' if shorter > 1 else 'is'} left out")
    return np.array([displacement[new], load[new], crack[new]]).T, left


class Sheet:
    """A file of crack lengths."""

    def __init__(self, path, given):
        self.table, self.given = read_test(path), given
        k, self.crack = crack_column(self.table, given)
        if k is None:
            raise Trouble(f"{path}: there is no column of crack lengths: a title such as \"Crack (mm)\", or --crack COLUMN, is "
                          f"expected; it has: {', '.join(label(self.table, j) for j in range(len(self.table.columns)))}")
        self.crack_column = k

    def _column(self, kind, unit_kind, default):
        """A column in SI; None: the sheet has none."""
        places = [k for k in found(self.table, kind) if k != self.crack_column]
        if not places:
            return None
        unit = self.table.units[places[0]] or default
        return self.table.columns[places[0]] * size_of(self.table, places[0], unit, unit_kind)

    def marks(self, test, columns, said):
        """Displacement, load and crack of each length. test: the table of the test; columns: its displacement and load in
        SI, along the way of the test."""
        path, units = self.table.path, self.given.units or ["", ""]
        time = self._column("time", "time", "s")
        at = found(test, "time")[:1]
        if time is not None and at:
            own = test.columns[at[0]] * size_of(test, at[0], test.units[at[0]] or "s", "time")
            rows = np.isfinite(own) & np.isfinite(columns[0]) & np.isfinite(columns[1])
            place, order, what, unit = time, np.argsort(own[rows], kind="stable"), "time", ("s", 1.0)
            where = own[rows][order]
            displacement, load, before = (np.interp(time, where, column[rows][order])
                                          for column in (*columns, farthest(columns[0], rows)))
        else:
            place = self._column("displacement", "length", units[0])
            if place is None:
                raise Trouble(f"{path}: a column of time or displacement beside the crack lengths is expected, by which they find "
                              f"their place in {test.path}" + ("" if time is None else ", which has no time"))
            what, unit = "displacement", ("mm", 1e-3)
            rows = np.isfinite(columns[0]) & np.isfinite(columns[1])
            where = np.maximum.accumulate(columns[0][rows])
            if not np.nanmax(place) > 0:  # written with the sign of the machine
                place = -place
            displacement, load, before = place, np.interp(place, where, columns[1][rows]), place
            own = self._column("force", "force", units[1])
            load = np.where(np.isfinite(own), np.abs(own), load) if own is not None else load
        known = np.isfinite(self.crack) & np.isfinite(place) & (self.crack > 0)
        wide = WIDER * np.ptp(where)
        outside = np.flatnonzero(known & ((place < where.min() - wide) | (place > where.max() + wide)))
        if outside.size:
            k = int(outside[0])
            raise Trouble(f"{path}: the {what} {place[k] / unit[1]:.4g} {unit[0]} of the crack of {1e3 * self.crack[k]:g} mm lies outside "
                          f"of the test, {where.min() / unit[1]:.4g} to {where.max() / unit[1]:.4g} {unit[0]} in {test.path}: is its unit "
                          "another one, or does the sheet belong to another test?")
        order = np.flatnonzero(known)[np.argsort(place[known], kind="stable")]
        marks, left = placed(displacement[order], load[order], self.crack[order], before[order], np.ptp(columns[0][rows]))
        said += [f"crack is {label(self.table, self.crack_column)} of {path} at {len(marks)} points, found by their {what}", *left]
        return marks
