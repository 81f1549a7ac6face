# SPDX-License-Identifier: BSD-3-Clause
"""Points of a load curve at which standards evaluate: the initial compliance, where the curve leaves its line (NL), the
5 % offset, the largest load. Loads are those of specimens/smooth.py, so that no single noisy point decides."""
from dataclasses import dataclass, replace

import numpy as np

from command import Trouble
from specimens.answer import Answer
from specimens.smooth import noise_of, smoothed

# The initial line goes through the points between these parts of the largest load: below is the slack of the fixture,
# above the crack may grow. From 0.05 to 0.4 and 0.2 to 0.6, its compliance on beams of test_evaluate.py is within 0.5 %.
LOW, HIGH = 0.1, 0.5
# The curve has left the initial line where its compliance is larger by this part and by so many standard errors of the
# load. People read NL by eye, which sees 1 %. Half and twice of either do not move the median toughness at NL of the curves
# of `test_evaluate.py noise`, which have a kink there.
LEAVES, SURELY = 0.01, 3.0


@dataclass
class Point:
    """name, place among the points of the curve, displacement, load, its standard error; crack: its length, where the
    file has it; after_largest_load: the curve reaches it there, and the largest load is taken."""
    name: str
    place: int
    displacement: float
    load: float
    error: float = 0.0
    crack: float = float("nan")
    after_largest_load: bool = False


class Points:
    """What a load curve in SI shows: compliance, zero (where the initial line meets the axis), points by name; loads and
    their standard errors without noise."""

    def __init__(self, displacement, load, path):
        self.displacement = displacement
        self.load, self.error, least = smoothed(displacement, load)
        self.noise, self.first = noise_of(displacement, load), 0
        # Two standard errors lower, so that a lucky short line is not taken for the largest load.
        self.top = int(np.argmax(least - 2 * self.error))
        chosen = self._straight(path)
        stiffness, at_zero = np.polyfit(displacement[chosen], load[chosen], 1)
        if not stiffness > 0:
            raise Trouble(f"{path}: the load does not rise with the displacement at first")
        self.compliance, self.zero = float(1 / stiffness), float(-at_zero / stiffness)
        self.points = self._standard()

    def _straight(self, path):
        """The places of the initial line."""
        rising, largest = self.load[:self.top + 1], self.load[self.top]
        above = [int(np.argmax(rising >= part * largest)) for part in (LOW, HIGH)]
        if above[1] - above[0] < 2:
            raise Trouble(f"{path}: {above[1] - above[0] + 1} points lie between {100 * LOW:g} and {100 * HIGH:g} % of the "
                          "largest load before it: at least 3 are expected for the initial compliance")
        self.behind = above[1]
        return slice(above[0], above[1] + 1)

    def _beyond(self, part, errors):
        """From which place on, up to the largest load, the compliance stays larger than the initial one by this part,
        and by so many standard errors of the load; None: it does not. A noisy point beyond the line does not count if
        the curve comes back."""
        line = (self.displacement - self.zero) / ((1 + part) * self.compliance)
        within = np.flatnonzero(line[self.behind:self.top + 1] <= (self.load + errors * self.error)[self.behind:self.top + 1])
        first = self.behind + int(within[-1]) + 1 if within.size else self.behind
        return first if first <= self.top else None

    def _point(self, name, place):
        return Point(name, place, float(self.displacement[place]), float(self.load[place]), float(self.error[place]))

    def _standard(self):
        """NL, "5 %" and "max" (ISO 15024, ASTM D5528): the second is where the compliance is 5 % larger, or
        the largest load if that comes first."""
        leaves, offset = self._beyond(LEAVES, SURELY), self._beyond(0.05, 0.0)
        leaves = self.top if leaves is None else leaves
        # NL comes no later than the 5 % offset: by its definition where the noise is small, by this where it is large.
        leaves = leaves if offset is None else min(leaves, offset)
        return [self._point("NL", leaves),
                replace(self._point("5 %", self.top if offset is None else offset), after_largest_load=offset is None),
                self._point("max", self.top)]

    def without_noise(self, marks):
        """Marks with the loads of the curve without noise. One in an unloading lies off the curve, and keeps its load."""
        marks = marks.copy()
        if len(marks):
            load = np.interp(marks[:, 0], self.displacement, self.load)
            near = np.abs(load - marks[:, 1]) <= 4 * self.noise
            marks[near, 1] = load[near]
        return marks

    def add_visual(self, marks, first):
        """The first mark of a crack that has grown, which of the marks: displacement, load, length."""
        mark, self.first = marks[first], first
        error = float(np.interp(mark[0], self.displacement, self.error))
        self.points.insert(0, Point("visual", -1, float(mark[0]), float(mark[1]), error, float(mark[2])))

    def place_cracks(self, notch, marks):
        """The crack at each point: that of the notch until the curve leaves its initial line, then between marks (ISO
        15024 evaluates NL and 5 % at the notch). Without marks: the notch."""
        self._notch = notch
        for point, crack in zip(self.points, self.cracks_with(marks)):
            point.crack = crack

    def cracks_with(self, marks):
        """The cracks at the points with other lengths at the marks."""
        start = next(p.displacement for p in self.points if p.name == "NL")
        later = marks[marks[:, 0] > start] if len(marks) else np.zeros((0, 3))
        return [float(marks[self.first, 2]) if point.name == "visual" else
                float(np.interp(point.displacement, [start, *later[:, 0]], [self._notch, *later[:, 2]])) for point in self.points]

    def along(self, name, crack, rate):
        """The answer of a method that needs no crack length, from where the curve leaves its initial line."""
        start = min(p.place for p in self.points if p.place >= 0)
        d, p = self.displacement[start:], self.load[start:]
        there = p > 0.05 * self.load[self.top]  # behind the break there is neither load nor crack
        d, p = d[there], p[there]
        return Answer(name, d, crack(d - self.zero, p), rate(d - self.zero, p), lambda w, q, a: rate(w, q), {})
