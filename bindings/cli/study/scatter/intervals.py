# SPDX-License-Identifier: BSD-3-Clause
"""Confidence intervals of the toughnesses of one specimen. They come from the data alone: from the noise of the curve,
which is drawn again so many times, and from crack lengths and calibrations (scatter/spread.py)."""
import copy
from dataclasses import dataclass, field

import numpy as np

from command import Trouble, overheard
from measured.chance import student
from scatter.spread import Source

# Curves with other noise, each evaluated anew: a standard error from 60 of them is known to 9 %, and the quantile of their 59
# degrees of freedom counts that. With half of them intervals at "max" are 5 % narrower (effective crack of `dcb`) and 0.4 %
# wider (`mmb`), with twice 6 and 7 % narrower, in half and 1.6 times of the time; 95 to 97 of 100 have the truth with each
# (`test_intervals.py coverage`).
REPLICAS = 60
NOISE = "the noise of the curve"
MEAN = "propagation"
# Standard errors below this part of a toughness are rounding: the data have neither noise nor marks that scatter. Files have
# four to six digits; half and twice of it change no interval of `dcb` in `test_intervals.py`, half none of `mmb` (twice: not measured).
ROUNDING = 1e-4


@dataclass
class Interval:
    """low and high are None where the data tell none, which `why` says; sources: what it comes from, by standard error."""
    low: float = None
    high: float = None
    sources: dict = field(default_factory=dict)
    why: str = ""


def interval_of(value, sources, level):
    """Of independent sources, whose own half widths add up as squares. The degrees of freedom of Welch and Satterthwaite
    make intervals too narrow where a line through three lengths leaves one: when this happens to be small, the others
    decide (F. A. Graybill, C.-M. Wang, J. Am. Stat. Assoc. 75 (1980) 869-873)."""
    if not sum(one.variance for one in sources) > (ROUNDING * value) ** 2:
        return Interval(why="there is neither noise in the curve nor scatter of marks")
    half = np.sqrt(sum(student(level, one.freedom) ** 2 * one.variance for one in sources))
    by = {one.what: float(np.sqrt(one.variance)) for one in sources}
    if not half < value:
        return Interval(sources=by, why=f"+- {half:.3g} J/m2 are more than the value itself: the data do not tell it")
    return Interval(float(value - half), float(value + half), by)


def _drawn_again(curve, answers, points, again):
    """By method and point: the toughnesses of curves with other noise."""
    drawn = {answer.name: {} for answer in answers}
    random = np.random.default_rng(1)  # the same file gives the same digits
    for _ in range(REPLICAS if points.noise > ROUNDING * points.load[points.top] else 0):
        other = copy.copy(curve)
        other.load = points.load + random.normal(0.0, points.noise, len(points.load))
        try:
            with overheard():
                anew, there = again(other)
        except Trouble:  # with this noise it could not be evaluated
            continue
        by_name = {answer.name: answer for answer in anew}
        for answer in answers:
            one = answer if answer.spread.calibrated else by_name[answer.name]  # a calibration has an error of its own
            for point in there.points:
                drawn[answer.name].setdefault(point.name, []).append(one.at(point, there.zero))
            if answer.propagation() and not answer.spread.calibrated:
                drawn[answer.name].setdefault(MEAN, []).append(one.mean_over(answer))
    return drawn


def intervals(curve, answers, points, again, level):
    """By method and point, and the mean of propagation where there is one. again: evaluates another curve of the same
    specimen with other noise."""
    drawn, out = _drawn_again(curve, answers, points, again), {}
    for answer in answers:
        out[answer.name] = {}

        def noise(name, value, of=drawn[answer.name]):
            # About the value, not about their mean: at a peak noise takes some of the load off, by about as much again.
            values = np.array(of.get(name, []))
            return [Source(NOISE, float(np.mean((values - value) ** 2)), len(values) - 1)] if len(values) > REPLICAS // 2 else []

        for point in points.points:
            value = answer.at(point, points.zero)
            out[answer.name][point.name] = interval_of(value, noise(point.name, value) + answer.spread.at(point, value), level)
        mean = answer.propagation()
        if mean:
            out[answer.name][MEAN] = interval_of(mean[0], noise(MEAN, mean[0]) + answer.spread.mean(), level)
    return out


def lines(found, level):
    """What the command says of them."""
    froms = {}
    for answer, rows in found.items():
        told = [f"{name} {one.low:.4g} to {one.high:.4g}" for name, one in rows.items() if one.low is not None]
        froms |= {what: True for one in rows.values() if one.low is not None for what in one.sources}
        not_told = {}
        for name, one in rows.items():
            if one.low is None:
                not_told.setdefault(one.why, []).append(name)
        yield f"{100 * level:g} % interval, {answer}: " + "; ".join(
            ([", ".join(told) + " J/m2"] if told else []) + [f"none for {', '.join(names)}: {why}" for why, names in not_told.items()])
    if froms:
        yield f"intervals come from {', from '.join(froms)}; numbers of the sheet count as right"
