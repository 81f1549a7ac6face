# SPDX-License-Identifier: BSD-3-Clause
"""The search for the least misfit: Gauss-Newton steps within a box that shrinks and grows with their success, each a
linear least squares problem with bounds (SciPy's lsq_linear)."""
from dataclasses import dataclass

import numpy as np

from command import loading

RADIUS = np.log(4.0)  # of the first step, by which factor a parameter may change
GOOD, POOR = 0.75, 0.25  # of the predicted gain (Dennis, Schnabel, Numerical Methods for Unconstrained Optimization, 6.4)
# A step that would lower the sum of squares by less than this part of its variance moves nothing by more than a tenth
# of its standard error. Half and twice of it move nothing by more than that tenth (`test_fits.py vary ENOUGH`).
ENOUGH = 0.01
# A gain of less than so many variances of the sum of squares is within two standard errors.
DOUBTFUL = 4
SHORT = 1e-6  # of a logarithm: shorter steps are rounding
# With chords, shorter steps find other teeth and nothing else. It is about a standard error of the toughness of the DCB
# with 1 % of noise. Half of it moves nothing by more than 0.05 standard errors, with 3 % more analyses; twice of it changes
# nothing (`test_fits.py vary CHORD_SHORT`).
CHORD_SHORT = 0.002
# With coarse load steps, shorter ones are left to fine steps. Half and twice of it change nothing
# (`test_fits.py vary COARSE_SHORT`).
COARSE_SHORT = 0.03


@dataclass
class Outcome:
    """Where a search ended: the point, its derivatives, whether nothing was left to gain, and why it ended."""
    point: object
    jacobian: np.ndarray
    converged: bool
    message: str


def bounded_step(jacobian, residual, low, high):
    """The step of least residual by the derivatives, within the bounds."""
    with loading():
        from scipy.optimize import lsq_linear  # here, for it loads for a second, and words may be wrong
    room = high - low > 1e-12
    step = np.clip(0.0, low, high)
    if room.any():
        step[room] = lsq_linear(jacobian[:, room], -residual, (low[room], high[room]), tol=1e-12).x
    return np.clip(step, low, high)


def descend(misfit, slopes, begin, kept, analyses, short=SHORT):
    """From a point, over the parameters in the mask, with at most so many analyses, until a step is short."""
    lower, upper = misfit.bounds()
    point, jacobian, radius = begin, slopes.at(begin), RADIUS
    if slopes.chord[kept].any():
        short = max(short, CHORD_SHORT)
    freedom = max(1, len(misfit.y) - int(kept.sum()))
    said = "no analyses were left"
    while True:
        low = np.where(kept, np.maximum(lower - point.at, -radius), 0.0)
        high = np.where(kept, np.minimum(upper - point.at, radius), 0.0)
        step = np.zeros(len(kept))
        step[kept] = bounded_step(jacobian[:, kept], point.residual, low[kept], high[kept])
        linear = point.residual + jacobian @ step
        predicted, variance = point.misfit - linear @ linear, point.misfit / freedom
        if predicted <= ENOUGH * variance or np.max(np.abs(step), initial=0.0) < short:
            return Outcome(point, jacobian, True, "the misfit is least")
        if analyses <= 0:
            return Outcome(point, jacobian, False, said)
        analyses -= 1
        found = misfit.point(point.at + step)
        if found is None:
            radius, said = 0.25 * np.max(np.abs(step)), "the scene is not feasible where the misfit should fall"
            continue
        slopes.correct(point, found, jacobian)
        gain = (point.misfit - found.misfit) / predicted
        if gain <= 0 and predicted < DOUBTFUL * variance:
            # Within two standard errors the misfit does not do what the derivatives say.
            return Outcome(point, slopes.at(point), True, "the misfit is least as far as the curve lets it be told")
        radius = 0.5 * np.max(np.abs(step)) if gain < POOR else 2 * radius if gain > GOOD else radius
        point = found if gain > 0 else point
        jacobian = slopes.at(point)
