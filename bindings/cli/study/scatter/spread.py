# SPDX-License-Identifier: BSD-3-Clause
"""How much of a toughness is chance, by what the crack lengths and the calibration of one specimen tell: variances, each
with its degrees of freedom and with what it comes from. What the sheet says counts as right."""
from dataclasses import dataclass

import numpy as np

from measured.chance import correlated

LEAST = 3  # marks or lengths: a line through them leaves one degree of freedom


@dataclass
class Source:
    """A part of the variance of a toughness, and from where it is known, in words."""
    what: str
    variance: float
    freedom: float


class Nothing:
    """Of a method that has no calibration: only the noise of the curve is known."""
    calibrated = False

    def at(self, _point, _value):
        return []

    def mean(self):
        return []


class OfSlope:
    """Of a compliance calibration with files of other crack lengths, whose slope m is in the toughness as a factor."""
    calibrated = True

    def __init__(self, error, lengths):
        """error: the standard error of the slope over the slope."""
        self.error, self.freedom = error, lengths - 2
        self.what = f"the calibration line through {lengths} lengths"

    def at(self, _point, value):
        return [Source(self.what, (self.error * value) ** 2, self.freedom)] if self.freedom > 0 else []

    def mean(self):
        return []


class OfMarks:
    """Of a method whose line goes through the marks of the crack. How far lengths lie off this line says how well they are
    read. At a point the toughness moves with each length, through the line and, where the crack there lies at or between
    marks, by itself. The mean of the marks has the scatter that is left by leaving out one mark after the other, in the
    line and in the mean (the jackknife; R. G. Miller, Biometrika 61 (1974) 1-15): it has what differs along the crack, too.
    Where errors of neighbours are alike, as of a crack that a camera follows, both variances are as much larger."""
    calibrated = True

    def __init__(self, method, marks, sheet, points, grown):
        """marks: displacement, load and length; grown: places of those that count for the mean."""
        self.method, self.marks, self.points, self.grown = method, marks, points, np.asarray(grown, int)
        # An offset that is taken as 0 is known no better than one a little above.
        self.sheet = sheet | {"least offset": -np.inf}
        misread = self._line(marks)[2]
        self.alike = correlated(misread, [0])
        self.freedom = (len(marks) - 2) / self.alike
        self.misread = float(np.sqrt(misread @ misread / max(len(marks) - 2, 1) * self.alike))
        self.what = f"the line through {len(marks)} crack lengths"
        self._variances = None

    def _line(self, marks):
        return self.method(marks[:, 0] - self.points.zero, marks[:, 1], marks[:, 2], self.sheet)

    def _at_points(self, marks):
        rate = self._line(marks)[0]
        d, p = (np.array([getattr(point, name) for point in self.points.points]) for name in ("displacement", "load"))
        return rate(d - self.points.zero, p, np.array(self.points.cracks_with(marks)))

    def _moved(self):
        """The variance at each point."""
        step = self.misread or 1e-6 * self.sheet["notch"]
        before, sum_of = self._at_points(self.marks), 0.0
        for k in range(len(self.marks)):
            marks = self.marks.copy()
            marks[k, 2] += step
            sum_of = sum_of + ((self._at_points(marks) - before) / step) ** 2
        return dict(zip((point.name for point in self.points.points), sum_of * self.misread ** 2))

    def at(self, point, _value):
        if self.freedom <= 0 or len(self.marks) < LEAST:
            return []
        self._variances = self._variances or self._moved()
        return [Source(self.what, float(self._variances[point.name]), self.freedom)]

    def mean(self):
        count = len(self.marks)
        if self.freedom <= 0 or len(self.grown) < LEAST:
            return []
        means = []
        for k in range(count):
            kept = np.delete(np.arange(count), k)
            rate, grown = self._line(self.marks[kept])[0], self.marks[np.setdiff1d(self.grown, [k])]
            means.append(np.mean(rate(grown[:, 0] - self.points.zero, grown[:, 1], grown[:, 2])))
        variance = (count - 1) ** 2 / count * np.var(means, ddof=1) * self.alike
        return [Source("the marks, one left out after the other", float(variance), self.freedom)]


class OfScatter:
    """Of a method without a line through its marks: toughnesses at the marks scatter about a line over the crack, those
    that count for the mean about their mean."""
    calibrated = False

    def __init__(self, marks, rates, points, grown):
        self.marks, self.points = marks, points
        self.rates, self.grown = rates, np.asarray(grown, int)
        self.what = f"the scatter of {len(self.grown)} marks"

    def at(self, point, _value):
        if len(self.marks) < LEAST:
            return []
        a = self.marks[:, 2]
        off = self.rates - np.polyval(np.polyfit(a, self.rates, 1), a)
        step, names = 1e-6 * np.mean(a), [one.name for one in self.points.points]
        place, share = names.index(point.name), 0.0  # by how much the crack at the point follows each of the marks
        for k in range(len(a)):
            marks = self.marks.copy()
            marks[k, 2] += step
            share += ((self.points.cracks_with(marks)[place] - point.crack) / step) ** 2
        freedom = len(a) - 2
        return [Source(self.what, share * float(off @ off) / freedom, freedom)] if share > 1e-6 else []

    def mean(self):
        rates = self.rates[self.grown]
        if len(rates) < LEAST:
            return []
        alike = correlated(rates - np.mean(rates), [0])
        return [Source(self.what, float(np.var(rates, ddof=1)) / len(rates) * alike, (len(rates) - 1) / alike)]
