# SPDX-License-Identifier: BSD-3-Clause
"""The slack of a test: where the straight line of its first loads meets the axis of displacements."""
import numpy as np

from measured.loops import Way

# The line goes through the points between these parts of the largest load, as in an evaluation by the standards
# (specimens/points.py): below, the fixture settles, above, the crack may grow.
LOW, HIGH = 0.1, 0.5
LEAST_POINTS = 8  # on the line, for its scatter to be told
# A smaller part of the displacement at HIGH is none, even without noise: it moves a toughness by less than the part itself.
# Half and twice of it find the same in 200 DCB files with 1.5 % of noise.
LEAST_SLACK = 0.01
# Standard errors of it: of 200 such files 2 have slack by noise alone, and 0.05, 0.1 and 0.3 of 4.8 mm are found in 34, 159
# and 200. Half of it: 29 by noise, and 124, 197, 200; twice of it: 0, and 1, 10, 200.
SURE = 3.0
# A curve bends where the lines of its lower and its upper half begin at places that differ by this part of the slack: then
# it is of the specimen. Lines of a parabola through 0 differ by 1.3 of it. Half and twice of it decide the same in
# test_measured.py.
BENT = 0.5


def _line(x, y):
    """Where the line of y over x begins, and the standard error of that: loads scatter more than displacements."""
    slope, height = np.polyfit(x, y, 1)
    if not slope > 0:
        return 0.0, np.inf
    scatter = np.sqrt(np.sum((y - slope * x - height) ** 2) / (len(x) - 2)) / slope
    zero = -height / slope
    return zero, scatter * np.sqrt(1 / len(x) + (np.mean(x) - zero) ** 2 / np.sum((x - np.mean(x)) ** 2))


def find_slack(x, y):
    """The displacement at which the load begins, negative for a preload; 0 where it cannot be told from none."""
    way = Way(x, y, False)
    top = int(np.argmax(way.y))
    x, y = way.x[:top + 1], way.y[:top + 1]
    if not y[top] > 0:
        return 0.0
    upper = np.flatnonzero(y >= HIGH * y[top])[0] + 1
    lower = np.flatnonzero(y[:upper] <= LOW * y[top])
    chosen = slice(int(lower[-1]) if lower.size else 0, int(upper))
    x, y = x[chosen], y[chosen]
    if len(x) < LEAST_POINTS:
        return 0.0
    zero, error = _line(x, y)
    if not abs(zero) > max(LEAST_SLACK * (x[-1] - zero), SURE * error):
        return 0.0
    low = y < 0.5 * (y[0] + y[-1])
    if min(low.sum(), (~low).sum()) < LEAST_POINTS // 2:
        return 0.0
    (first, one), (second, other) = _line(x[low], y[low]), _line(x[~low], y[~low])
    return float(zero) if abs(second - first) <= BENT * abs(zero) + 2 * np.hypot(one, other) else 0.0
