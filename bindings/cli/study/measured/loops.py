# SPDX-License-Identifier: BSD-3-Clause
"""The way of a test: where it turns, what of it is jitter, and what remains without its unloading loops."""
import numpy as np

# A test that goes back by more than this part of the range of x unloads; by less, x jitters. Encoders of machines
# resolve 1e-4 of a test of some mm, and people unload by tenths: ten times of it takes an unloading of 5 % for jitter.
# Twice of it finds the same loops in test_measured.py; half of it takes the jitter there for loops.
TURN = 0.01


def turning_points(x):
    """The places at which x turns, with the first and the last one: from each to the next, x rises or falls as a
    whole, and by more than TURN of its range but for the ends."""
    least = TURN * (np.max(x) - np.min(x))
    turns, high, low, rising = [0], 0, 0, None
    for k, value in enumerate(x.tolist()):
        high = k if value > x[high] else high
        low = k if value < x[low] else low
        if rising is not False and value < x[high] - least:
            if rising or x[high] > x[0] + least:
                turns.append(high)
            rising, low = False, k
        elif rising is not True and value > x[low] + least:
            if rising is False or x[low] < x[0] - least:
                turns.append(low)
            rising, high = True, k
    if turns[-1] != len(x) - 1:
        turns.append(len(x) - 1)
    return turns


def monotone(x, y):
    """Points whose x increases strictly: those that do not are averaged with their neighbours, x and y alike, as little
    as possible (pool adjacent violators; Ayer et al., Ann. Math. Stat. 26, 1955)."""
    sums = []  # of x, of y, and the number of points
    for one in zip(x.tolist(), y.tolist()):
        block = [*one, 1]
        while sums and sums[-1][0] / sums[-1][2] >= block[0] / block[2]:
            block = [a + b for a, b in zip(sums.pop(), block)]
        sums.append(block)
    counts = np.array([block[2] for block in sums])
    return np.array([block[0] for block in sums]) / counts, np.array([block[1] for block in sums]) / counts


class Way:
    """A measured curve along its way. x, y: the points that are compared; at: their place along the way, which is x
    itself if loops are cut, and else the length of the way in x; turns: x where the way turns, its first and last
    included. loops, averaged: how many unloadings it had, and how many points jitter has merged."""

    def __init__(self, x, y, follow):
        turns = turning_points(x)
        parts = list(zip(turns[:-1], turns[1:]))
        falls = [x[begin] - x[end] for begin, end in parts if x[end] < x[begin]]
        self.loops = falls
        kept = [self._part(x, y, begin, end, first=k == 0) for k, (begin, end) in enumerate(parts)]
        self.averaged = len(x) - sum(len(part[0]) for part in kept)
        if not follow or not falls:
            kept = self._envelope(kept)
            self.x, self.y = (np.concatenate(columns) for columns in zip(*kept))
            self.x, self.y = monotone(self.x, self.y)
            self.at, self.turns = self.x, None
            return
        self.x, self.y = (np.concatenate(columns) for columns in zip(*kept))
        self.turns = np.array([x[k] for k in turns])
        lengths = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(self.turns)))])
        self.at = np.concatenate([lengths[k] + np.abs(part[0] - self.turns[k]) for k, part in enumerate(kept)])

    @staticmethod
    def _part(x, y, begin, end, first):
        """The points from one turn to the next; the turn itself belongs to the part before."""
        begin += 0 if first else 1
        sign = 1.0 if x[end] >= x[begin] else -1.0
        there, value = monotone(sign * x[begin:end + 1], y[begin:end + 1])
        return sign * there, value

    @staticmethod
    def _envelope(parts):
        """What lies farther than all before it."""
        kept, most = [], -np.inf
        for x, y in parts:
            if len(x) and x[-1] > most:
                new = x > most
                kept.append((x[new], y[new]))
                most = x[-1]
        return kept
