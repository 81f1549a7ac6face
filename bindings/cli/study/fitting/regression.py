# SPDX-License-Identifier: BSD-3-Clause
"""The last steps of a search where curves have teeth: the derivatives at a point are those of its tooth, and a search by
them ends beside the least misfit. A linear model through all analyses nearby has the derivatives of the curve (regression
in derivative-free least squares: Cartis, Fiala, Marteau, Roberts, ACM Trans. Math. Softw. 45, 2019)."""
import numpy as np

from fitting.descent import Outcome, bounded_step

# Analyses that differ by more than this in the logarithm of a parameter say nothing of the solution: the ends of intervals
# and a step of the search to either side lie within. Half and twice of it, and of CLOSE, change none of the fits of
# `test_fits.py vary NEARBY CLOSE`: no step of these two promises enough there.
NEARBY = 0.6
# Closer analyses lie on one tooth: they count no more than those so far away.
CLOSE = 0.02
FARTHEST_STEP = 0.3  # half of NEARBY
# Variances of the sum of squares that a step must promise: 0.7 standard errors. With 0.5, fits to five DCB and two ENF files
# with noise (toughness .28, .8) take 7 to 9 analyses, and 6 of 7 intervals cover it; with eight times of it, 7 to 8, and 5.
WORTH = 0.5
FAILED = 2  # steps without success, after which the analyses nearby tell no more


def slopes_of_neighbours(misfit, point, kept):
    """Derivatives by the kept parameters, [points][kept], of the linear model through the point that fits the analyses
    nearby best; None: they do not span the parameters."""
    near = [found for found in misfit.fine_points() if found is not point
            and np.max(np.abs(found.at - point.at)) < NEARBY and not (found.at - point.at)[~kept].any()]
    if len(near) < kept.sum() + 1:
        return None
    moved = np.array([found.at - point.at for found in near])[:, kept]
    change = np.array([found.residual - point.residual for found in near])
    weight = 1 / np.maximum(np.linalg.norm(moved, axis=1), CLOSE)[:, None]
    slopes, _, rank, _ = np.linalg.lstsq(weight * moved, weight * change, rcond=1e-3)
    return slopes.T if rank == kept.sum() else None


def refine(misfit, outcome, kept, analyses):
    """Steps by the analyses nearby, as long as they promise a gain that is worth them. Returns the outcome, and whether it is
    another one."""
    lower, upper = misfit.bounds()
    point, failed = outcome.point, 0
    variance = point.misfit / max(1, len(misfit.y) - kept.sum())
    slopes = slopes_of_neighbours(misfit, point, kept)
    while slopes is not None and failed < FAILED and analyses > 0:
        low, high = np.maximum(lower - point.at, -FARTHEST_STEP)[kept], np.minimum(upper - point.at, FARTHEST_STEP)[kept]
        step = np.zeros(len(kept))
        step[kept] = bounded_step(slopes, point.residual, low, high)
        linear = point.residual + slopes @ step[kept]
        if point.misfit - linear @ linear <= WORTH * variance:
            break
        analyses -= 1
        found = misfit.point(point.at + step)
        if found is None:
            break
        if found.misfit < point.misfit:
            point = found
        else:
            failed += 1
        slopes = slopes_of_neighbours(misfit, point, kept)
    if point is outcome.point or slopes is None:
        return outcome, False
    jacobian = np.array(outcome.jacobian)
    jacobian[:, kept] = slopes
    return Outcome(point, jacobian, outcome.converged, "the misfit is least by a model of all analyses nearby"), True
