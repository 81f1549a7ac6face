# SPDX-License-Identifier: BSD-3-Clause
"""The curve of a test from the file of a machine, in SI, with the marks of its crack."""
import numpy as np

from command import Trouble, complain, say
from measured.broken import broken_at, said_of_break
from measured.columns import choose, label, rivals
from measured.curve_data import left_out, upright
from measured.loops import Way
from measured.one_test import read_test
from specimens.marks import Sheet, crack_column, farthest, placed, size_of

LEAST_POINTS = 5
MACHINE = 0.25  # share of machine and fixture from which on it is told: an error of 10 % in them is 3 % of the specimen there


class Curve:
    """Displacement and load in SI along the way of the test without its unloadings, and the marks of the crack."""

    def __init__(self, path, given, apart, calibration=None):
        """apart: a file of crack lengths, or "". calibration: which test of the file; None: that of --specimen."""
        table = (read_test(path, given.specimen[0] if given.specimen else "") if calibration is None else
                 read_test(path, calibration, f"--calibration LENGTH={path}:1"))
        x, y = choose(table, given.columns)
        said = [f"displacement is {label(table, x)}, load is {label(table, y)}", *([] if given.columns else rivals(table, (x, y))), *table.said]
        self.names = [option or table.units[k] for k, option in zip((x, y), given.units or ["", ""])]
        units = [size_of(table, k, name, kind) for k, name, kind in zip((x, y), self.names, ("length", "force"))]
        columns = [table.columns[k] * size for k, size in zip((x, y), units)]
        there = np.isfinite(columns[0]) & np.isfinite(columns[1])
        if there.sum() < LEAST_POINTS:
            raise Trouble(f"{path}: {int(there.sum())} points with displacement and load: at least {LEAST_POINTS} are expected")
        if not there.all():
            said.append(left_out(int((~there).sum())))
        turned = []
        for column, one in zip(columns, upright([column[there] for column in columns], (1.0, 1.0), turned)):
            column[there] = one
        rows = np.flatnonzero(there)
        broken = broken_at(columns[0][rows], columns[1][rows])
        self.broken = broken is not None
        if broken is not None:
            said.append(said_of_break(1e3 * columns[0][rows[broken - 1]], len(rows) - broken, "mm"))
            for column in columns:
                column[rows[broken]:] = np.nan
            there[rows[broken]:] = False
        said += [text.replace("x ", "displacement ", 1).replace("y ", "load ", 1) for text in turned]
        columns[0] = columns[0] - given.machine * columns[1]
        way = Way(columns[0][there], columns[1][there], False)
        if given.machine:
            said.append(machine_share(path, given.machine, columns[0][there], columns[1][there]))
        if way.loops:
            said.append(f"{len(way.loops)} unloading{'s' * (len(way.loops) > 1)} cut")
        if way.averaged:
            said.append(f"x jitters: {int(there.sum())} points are averaged to {len(way.x)}"
                        if not way.loops else f"x jitters: {way.averaged} points are merged with their neighbours")
        self.path, self.displacement, self.load = path, way.x, way.y
        # The whole way of the machine, where its unloadings are cut: for the picture.
        self.whole = (columns[0][there], columns[1][there]) if way.loops else None
        self.read_as = " and ".join(f"{label(table, k).removesuffix(' in ' + table.units[k])} in {name}"
                                    for k, name in zip((x, y), self.names))
        self.marks = Sheet(apart, given).marks(table, columns, said) if apart else self._marks(table, given, columns, there, said)
        say(f"{path}: {'; '.join(said)}")

    @staticmethod
    def _marks(table, given, columns, there, said):
        """Displacement, load and crack length of the rows that have one; one for each length."""
        k, crack = crack_column(table, given)
        if k is None:
            return np.zeros((0, 3))
        rows = there & np.isfinite(crack) & (crack > 0) & (columns[1] > 0)
        marks, left = placed(columns[0][rows], columns[1][rows], crack[rows], farthest(columns[0], there)[rows],
                             np.ptp(columns[0][there]))
        said += [f"crack is {label(table, k)} at {len(marks)} points", *left]
        return marks


def machine_share(path, compliance, displacement, load):
    """What machine and fixture take, in words; displacement: of the specimen alone."""
    top = int(np.argmax(load))
    machine = compliance * load[top]
    share = machine / (machine + displacement[top])
    if not 0 < share < 1:
        raise Trouble(f"{path}: --compliance takes {1e3 * machine:.4g} mm off a displacement of {1e3 * (machine + displacement[top]):.4g} mm "
                      "at the largest load: that of the machine is less than that of the test")
    if share > MACHINE:
        complain(f"warning: {path}: {100 * share:.0f} % of the displacement at the largest load are those of machine and fixture (--compliance): "
                 f"10 % more of it make the specimen {10 * share / (1 - share):.0f} % stiffer")
    return f"machine and fixture take {1e3 * machine:.4g} mm, {100 * share:.2g} %, of the displacement at the largest load"
