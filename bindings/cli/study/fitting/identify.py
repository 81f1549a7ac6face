# SPDX-License-Identifier: BSD-3-Clause
"""Which parameters the data can tell, from the derivatives before a fit and after it."""
import numpy as np

# By how much a test machine and a model may be off, as a part of the largest load: ISO 15024 and ASTM D5528 ask for
# load cells within 1 %. Errors of this size have a shape of their own, and more points do not average them out.
ACCURACY = 0.01
# A parameter that such an error moves by more than this part of its value is not told. 0.3 leaves out the strength of a
# DCB (0.5 to 1.2) and the onset of an ENF (1.1), and keeps their toughnesses (0.01 to 0.03; 0.21 where an ENF ends
# before it has lost a fifth of its load) and the strength of a strip that peels over 6 mm (0.07). By these numbers
# half of it drops that ENF's toughness, and twice of it keeps some of the DCB's strengths.
TOLD = 0.3
ALIKE = 0.8  # from this correlation on a sentence names the other parameter; it decides nothing
MOST_FACTOR = np.log(10.0)  # a larger factor is not said
# A parameter that is held may be this much larger or smaller, where its bounds do not say it.
HELD_RANGE = np.log(2.0)


def noise_of(data, size):
    """The noise of a curve over the size of its residuals: deviations from the mean of both neighbours (Gasser, Sroka,
    Jennen-Steinmetz 1986), by the median."""
    y, x = data.y / size, data.at
    if len(y) < 5:
        return 0.0
    share = (x[1:-1] - x[:-2]) / np.maximum(x[2:] - x[:-2], 1e-300)
    deviation = y[1:-1] - (1 - share) * y[:-2] - share * y[2:]
    return float(np.median(np.abs(deviation) / np.sqrt(1 + share ** 2 + (1 - share) ** 2)) / 0.6745)


def uncertainties(jacobian, noise):
    """For each parameter, by how much (in its logarithm) errors of the size of ACCURACY, and noise, may move it if the
    others follow; infinite where the curve does not depend on it."""
    points, count = jacobian.shape
    sizes = np.linalg.norm(jacobian, axis=0)
    out = np.full(count, np.inf)
    alive = np.flatnonzero(sizes > 1e-12 * max(np.max(sizes, initial=0.0), 1e-300))
    if not alive.size:
        return out
    _, singular, vectors = np.linalg.svd(jacobian[:, alive] / sizes[alive], full_matrices=False)
    if len(singular) < alive.size:
        return out
    singular = np.maximum(singular, 1e-12)
    spread = np.sqrt(np.sum((vectors.T / singular) ** 2, axis=1)) / sizes[alive]
    out[alive] = spread * np.hypot(ACCURACY * np.sqrt(points), 2 * noise)
    return out


def told(jacobian, noise, names, limit=TOLD):
    """The parameters that the data tell, as a mask, and a sentence for each of the others. Of several that are not told,
    the one goes first that is told least, and of two that do the same the one that does less."""
    kept = np.ones(jacobian.shape[1], dtype=bool)
    said = {}
    while kept.any():
        off = np.full(len(kept), 0.0)
        off[kept] = uncertainties(jacobian[:, kept], noise)
        worst = off.max()
        if worst <= limit:
            break
        # Those that move the curve alike are off alike.
        level = min(worst, 1e6) / 1.5
        candidates = [k for k in np.flatnonzero(kept) if off[k] >= level]
        k = min(candidates, key=lambda one: np.linalg.norm(jacobian[:, one]))
        others = [other for other in np.flatnonzero(kept) if other != k]
        alone = uncertainties(jacobian[:, [k]], noise)[0]
        said[k] = _sentence(k, off[k], alone, jacobian, others, names)
        kept[k] = False
    return kept, said


def _sentence(k, off, alone, jacobian, others, names):
    size = np.linalg.norm(jacobian[:, k])
    if not size > 0:
        return "the curve does not depend on it"
    alike = [(abs(jacobian[:, k] @ jacobian[:, other]) / (size * max(np.linalg.norm(jacobian[:, other]), 1e-300)), other)
             for other in others]
    if alone <= TOLD and alike and max(alike)[0] > ALIKE:
        correlation, other = max(alike)
        return (f"the data do not tell it apart from {names[other]}, which moves the curve in the same way (correlation "
                f"{correlation:.3f})")
    moved = f"a change by 10 % moves the curve by {10 * size / np.sqrt(jacobian.shape[0]):.2g} % of its largest value"
    return moved + (f", and an error of the load of {100 * ACCURACY:g} % hides a change by a factor of "
                    f"{np.exp(off):.2g}" if off < MOST_FACTOR else "")


def held_ranges(misfit, at):
    """How far below and above its place, in logarithms, each parameter may be that is held: to its bounds if it has both."""
    lower, upper = misfit.bounds()
    bounded = np.isfinite(lower) & np.isfinite(upper)
    below, above = (np.where(bounded, room, np.minimum(room, HELD_RANGE)) for room in (at - lower, upper - at))
    return np.stack([below, above], axis=1)
