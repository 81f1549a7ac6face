# SPDX-License-Identifier: BSD-3-Clause
"""The load of a noisy curve, point by point, from lines through its neighbours; drops and kinks stay as sharp as they are."""
import numpy as np

# Lines go through so many more neighbours that the standard error of the load is below this part of the largest load.
# The median toughness at "max" of 20 curves with a noise of 1.5 % is 0.8 % off, with half of it 0.9 %, with twice of it
# 0.3 %, where points of some curves go lost in longer lines (`test_evaluate.py noise`, as for the next two).
WANTED = 3e-3
# A longer line counts as long as its value lies within so many standard errors of those of all shorter ones (the
# intersection of confidence intervals; A. Goldenshluger, A. Nemirovski, Math. Methods Stat. 6, 1997). Half of it: 1.3 %, twice
# of it: -0.2 %, and steps of the size of the noise are smoothed away.
AGREE = 2.5
# A line on one side counts beside the best one if its standard error is at most so many times as large. Half of it, which
# leaves the best one alone: 2.2 %, twice of it: 0.6 %.
ALIKE = 2.0


def noise_of(x, y):
    """The standard deviation of the noise of y: of what each point is off the line between its neighbours. The median
    does not see drops."""
    if len(x) < 5:
        return 0.0
    part = (x[1:-1] - x[:-2]) / (x[2:] - x[:-2])
    off = y[1:-1] - (1 - part) * y[:-2] - part * y[2:]
    return float(np.median(np.abs(off) / np.sqrt(1 + part ** 2 + (1 - part) ** 2)) / 0.6745)


def _lines(x, y, begin, end):
    """Values at the points of the lines through points begin to end - 1 (arrays, a window for each point), the factor
    of the standard deviation of a value, and the mean square of what is off the line."""
    middle = np.mean(y)
    x, y = x - np.mean(x), y - middle
    count = (end - begin).astype(float)

    def mean(of):
        sums = np.concatenate([[0.0], np.cumsum(of)])
        return (sums[end] - sums[begin]) / count

    at_x, at_y = mean(x), mean(y)
    wide = np.maximum(mean(x * x) - at_x ** 2, 1e-300)
    slope = (mean(x * y) - at_x * at_y) / wide
    rest = np.maximum(mean(y * y) - at_y ** 2 - slope ** 2 * wide, 0.0) * count / np.maximum(count - 2, 1)
    return middle + at_y + slope * (x - at_x), np.sqrt((1 + (x - at_x) ** 2 / wide) / count), rest


def smoothed(x, y):
    """The load at each point, its standard error, and the least of the loads that lines to the left, across and to the
    right say with about this error: behind a peak the line to the left is too high. x increases."""
    noise, wanted = noise_of(x, y), WANTED * float(np.max(np.abs(y)))
    best, error = np.array(y, dtype=float), np.full(len(y), noise)
    if noise <= wanted:
        return best, error, best
    sides, place = [], np.arange(len(y))
    for before, behind in ((1.0, 0.0), (0.5, 0.5), (0.0, 1.0)):
        low, high = y - AGREE * noise, y + AGREE * noise
        value, current, going = np.array(y, dtype=float), np.full(len(y), noise), np.full(len(y), True)
        size = 4
        while size < len(y) and going.any():
            begin, end = place - int(before * size), place + int(behind * size) + 1
            inside = (begin >= 0) & (end <= len(y))
            line, factor, rest = _lines(x, y, np.where(inside, begin, 0), np.where(inside, end, 3))
            low, high = np.maximum(low, line - AGREE * factor * noise), np.minimum(high, line + AGREE * factor * noise)
            # No more off the line than the noise: twice the standard deviation of a mean square is allowed.
            going &= inside & (low <= high) & (rest <= noise ** 2 * (1 + AGREE * np.sqrt(2 / (size - 1))))
            going &= current > wanted
            value, current = np.where(going, line, value), np.where(going, factor * noise, current)
            size = int(1.5 * size)
        sides.append((value, current))
        better = current < error
        best, error = np.where(better, value, best), np.where(better, current, error)
    return best, error, np.min([np.where(current <= ALIKE * error, value, np.inf) for value, current in sides], axis=0)
