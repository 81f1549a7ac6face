# SPDX-License-Identifier: BSD-3-Clause
"""Intervals from profiles of the misfit: each parameter moves to both ends of its interval, the others following, and
what an analysis finds there says how far the interval reaches."""
from dataclasses import dataclass

import numpy as np

from fitting.misfit import NOTHING
from measured.chance import correlated, student

TRUSTED = 4.0  # by which factor the misfit at the ends of an interval may differ from that which the derivatives predict
# Where curves have teeth, misfits are compared this far away, in logarithms: closer, those of the teeth of the DCB
# differ by more than what 1 % of its toughness adds. Half and twice of it change none of the fits of
# `test_fits.py vary FAR`.
FAR = 0.1
FARTHEST = np.log(4.0)  # no analysis looks farther than the first step of a search goes
AGAIN = 0.25  # and so far where this was not trusted


@dataclass
class Interval:
    """In logarithms about the solution: to its lower and its upper end, and whether both were found as predicted."""
    below: float
    above: float
    trusted: bool


def covariance(residual, jacobian, starts):
    """The inverse of J'J, the covariance of the parameters, and how many degrees of freedom each variance has. Errors may
    differ from point to point (noise in proportion to the load): HC3 of J. MacKinnon, H. White, J. Econometrics 29 (1985)
    305-325, with the leverages of the points; and neighbours may err alike. A variance to which few points contribute has
    few degrees of freedom: twice its mean squared over its variance, for errors of one size (R. Bell, D. McCaffrey, Survey
    Methodology 28 (2002) 169-181; G. Imbens, M. Kolesar, Rev. Econ. Stat. 98 (2016) 701-712)."""
    left, singular, vectors = np.linalg.svd(jacobian, full_matrices=False)
    inverse = (vectors.T / singular) @ left.T
    leverage = np.sum(left ** 2, axis=1)
    most = 1 / np.maximum(1 - leverage, 0.1)
    alike = correlated(residual, starts)
    freedom = []
    for row in inverse:
        # The variance is e'MDMe of the errors e, with D = diag(parts) and M = I - UU'; this is tr(DM)^2 / tr(DMDM).
        parts = (row * most) ** 2
        mean = parts @ (1 - leverage)
        spread = parts ** 2 @ (1 - 2 * leverage) + np.sum(((left.T * parts) @ left) ** 2)
        freedom.append(mean ** 2 / spread / alike if spread > 0 else 1.0)
    return inverse @ inverse.T, (inverse * (residual * most) ** 2) @ inverse.T * alike, np.array(freedom)


@dataclass
class Shift:
    """By how much a kept parameter moves, in logarithms, because others are held: its standard uncertainty, and the farthest
    it goes down and up."""
    standard: float
    below: float
    above: float


def shifts_of_held(misfit, outcome, kept, ranges):
    """A Shift for each kept parameter, as held ones may lie anywhere in their ranges (type B of the GUM, JCGM 100:2008,
    4.3.7). An analysis at both ends of each range, to which the kept ones follow by the derivatives, corrects how far they
    go. What of the curve does not follow them, as its teeth do not, may hide a shift of its own size to either side."""
    count = int(kept.sum())
    variance, below, above = np.zeros(count), np.zeros(count), np.zeros(count)
    least = NOTHING * np.linalg.norm(misfit.y / misfit.size)
    spread = np.linalg.norm(np.linalg.pinv(outcome.jacobian[:, kept]), axis=1)
    for k in np.flatnonzero(~kept):
        if np.linalg.norm(outcome.jacobian[:, k]) <= least:
            continue
        ends = [_followed_to(misfit, outcome, kept, k, side) for side in (-ranges[k][0], ranges[k][1])]
        moves = np.array([moved for moved, _ in ends])
        hidden = spread * max(left for _, left in ends)
        variance += (np.average(np.square(moves), axis=0, weights=ranges[k]) + hidden ** 2) / 3
        same = moves[0] * moves[1] > 0  # it may go in the other direction between the ends
        most = np.max(np.abs(moves), axis=0)
        below += np.hypot(np.where(same, most, np.maximum(0.0, -np.min(moves, axis=0))), hidden)
        above += np.hypot(np.where(same, most, np.maximum(0.0, np.max(moves, axis=0))), hidden)
    return [Shift(*one) for one in zip(np.sqrt(variance), below, above)]


def _followed_to(misfit, outcome, kept, k, distance):
    """How far the kept parameters go if the k-th one, which is held, goes that far; and the size of the residuals that they
    do not follow."""
    point, jacobian = outcome.point, outcome.jacobian[:, kept]
    there = np.array(point.at)
    there[k] += distance
    there[kept] -= np.linalg.lstsq(jacobian, outcome.jacobian[:, k] * distance, rcond=None)[0]
    there = np.clip(there, *misfit.bounds())
    found = misfit.point(there)
    moved = (there - point.at)[kept]
    if found is None:
        return moved, 0.0
    change = found.residual - point.residual
    more = -np.linalg.lstsq(jacobian, change, rcond=None)[0]
    return moved + more, float(np.linalg.norm(change + jacobian @ more))


class Profile:
    """The profiles around a solution, over the kept parameters."""

    def __init__(self, misfit, outcome, kept, chord, level):
        self.misfit, self.outcome, self.point = misfit, outcome, outcome.point
        self.places = np.flatnonzero(kept)
        self.jacobian = outcome.jacobian[:, kept]
        self.chord = chord[kept]
        starts = np.cumsum([0] + [len(data.x) for data in misfit.model.data][:-1]).tolist()
        self.inverse, self.covariance, freedom = covariance(self.point.residual, self.jacobian, starts)
        self.factors = np.array([student(level, one) for one in freedom])
        self.better = None  # a point with less misfit than the solution

    def errors(self):
        return np.sqrt(np.diag(self.covariance))

    def of_derivatives(self, trusted=True):
        """The intervals without analyses at their ends; none where there are no more points than parameters."""
        if len(self.misfit.y) <= len(self.places) or not np.isfinite(self.errors()).all():
            return []
        return [Interval(half, half, trusted) for half in self.factors * self.errors()]

    def _ratio(self, k, distance):
        """How much more misfit there is at a distance than the derivatives predict, and whether the bounds allow it."""
        lower, upper = self.misfit.bounds()
        step = np.zeros(len(self.point.at))
        step[self.places] = distance * self.inverse[:, k] / self.inverse[k, k]
        there = np.clip(self.point.at + step, lower, upper)
        moved = (there - self.point.at)[self.places]
        predicted = float(np.sum((self.jacobian @ moved) ** 2))
        if abs(moved[k]) < 0.5 * abs(distance) or not predicted > 1e-9 * self.point.misfit:
            return None
        found = self.misfit.point(there)
        if found is None:
            return None
        if found.misfit < (self.better or self.point).misfit:
            self.better = found
        return (self._followed(found, k) - self.point.misfit) / predicted

    def _followed(self, found, k):
        """The misfit there once the others follow: least over them by the derivatives there, or those of the solution
        where these have teeth. Along the straight way alone it is larger, and intervals are too narrow."""
        there = found.jacobian[:, self.places]
        others = np.delete(np.where(np.isnan(there), self.jacobian, there), k, axis=1)
        if not others.shape[1]:
            return found.misfit
        moves = np.linalg.lstsq(others, -found.residual, rcond=None)[0]
        left = found.residual + others @ moves
        return float(left @ left)

    def _side(self, k, sign, half, distance):
        """The interval to one side: as far as its derivatives say, corrected by what is found at the distance."""
        ratio = self._ratio(k, sign * distance)
        if ratio is None:
            return half, True
        if not 1 / TRUSTED < ratio < TRUSTED:
            return half, False
        return half / np.sqrt(ratio), True

    def interval(self, k, analyses):
        """Of the k-th kept parameter. analyses: how many may be spent beyond the two at its ends."""
        half = self.factors[k] * self.errors()[k]
        if half > FARTHEST:
            return Interval(half, half, False)
        distance = max(half, FAR) if self.chord[k] else half
        sides = [self._side(k, sign, half, distance) for sign in (-1.0, 1.0)]
        if not all(trusted for _, trusted in sides) and analyses >= 2 and distance < AGAIN:
            sides = [self._side(k, sign, half, AGAIN) for sign in (-1.0, 1.0)]
        return Interval(sides[0][0], sides[1][0], all(trusted for _, trusted in sides))
