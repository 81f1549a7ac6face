# SPDX-License-Identifier: BSD-3-Clause
"""The misfit of a model: residuals and their derivatives, in the logarithms of the parameters over their starts."""
from dataclasses import dataclass

import numpy as np

from command import Trouble, say
from fit_model import Infeasible
from measured.units import unit_of_key

# From this roughness on the derivatives of an analysis are those of teeth, one for each pair that the front passes, and
# not of the curve. On a DCB with 4 and 18 pairs in the zone (roughness 0.97 and 0.77) they have 0.11 and 0.55 of what
# steps of 3 to 25 % change; on a strip with 4 pairs and ten steps a tooth (0.15) they are right, with one step a tooth
# (0.56 to 0.65) within 4 % over steps of 2 %. 0.35 takes chords there, which lose digits that exact data have; 1.4 never.
TEETH = 0.7
# By so much a parameter moves to see what it does to the curve, where its derivative has teeth or there is none. Half
# of it shows the teeth of the DCB again (its strength: 1.8 instead of 0.36 times the smoothed derivative at 3 %), twice
# of it does the same to the toughness within 2 %.
ROUGH_STEP, SMOOTH_STEP = 0.25, 0.05
# A derivative that gives less than this part of what an analysis finds, or more than its inverse, is that of a tooth,
# however smooth it looks: means over steps of 25 % have 0.64 to 0.71 of it (DCB), 0.3 to 0.6 (ENF) and 0.3 to 0.4 (MMB) on
# meshes of `delam new`, and 0.80 to 1.02 on the strip of test_fits.py. Half of it takes the teeth of DCB and ENF for the
# curve; with 0.9 the strip loses digits. Twice of it takes no derivative at all.
HONEST = 0.75
NOTHING = 1e-3  # of the size of the curve: a smaller derivative by a logarithm is none, with teeth and without
UPDATED = 0.1  # of these steps: a shorter one says nothing new of the derivative


@dataclass
class Point:
    """An analysis: place in logarithms, residuals, derivatives (columns of NaN where there are none), and the answer."""
    at: np.ndarray
    residual: np.ndarray
    jacobian: np.ndarray
    rough: list
    answer: object

    @property
    def misfit(self):
        return float(self.residual @ self.residual)


class Misfit:
    """Evaluates points. start: the values at 0; y: the data of all curves; size: by what residuals are divided."""

    def __init__(self, model, weights):
        self.model, self.weights = model, weights
        self.start = np.array([p.start for p in model.parameters])
        self.y = np.concatenate([data.y for data in model.data])
        self.size = np.concatenate([self._sizes(np.abs(data.y), weights) for data in model.data])
        if not (self.size > 0).all():
            raise Trouble("--data: a curve is zero throughout")
        self.count = 0
        self.known = {}

    @staticmethod
    def _sizes(y, weights):
        """By what residuals are divided; errors in proportion to y are no smaller than 5 % of the largest allow."""
        if weights == "relative":
            return np.maximum(y, 0.05 * np.max(y))
        return np.full(len(y), np.max(y) if weights == "curve" else 1.0)

    def in_words(self, size):
        """A root mean square of residuals, with what it is a part of."""
        if self.weights == "equal":
            return f"{size:.4g}{self.model.y_unit}"
        y = "load" if self.model.y_name.startswith("reaction") else self.model.y_name
        return f"{100 * size:.4g} % of " + (f"the largest {y}" if self.weights == "curve" else f"the {y}")

    def bounds(self):
        with np.errstate(divide="ignore"):
            return (np.log(np.array([p.lower for p in self.model.parameters]) / self.start),
                    np.log(np.array([p.upper for p in self.model.parameters]) / self.start))

    def values(self, at):
        return self.start * np.exp(at)

    def _evaluate(self, at, first):
        values = self.values(at)
        try:
            answer = self.model.evaluate(values)
        except Infeasible as error:
            if first:
                raise Trouble(f"the scene does not run at the start: {error}", error.code) from error
            return None, f"not feasible: {error}"
        finally:
            self.count += 1
        if first:
            self.model.compare_slopes(answer.curves)
        residual = (np.concatenate(answer.curves) - self.y) / self.size
        slopes = [np.full(len(self.y), np.nan) if slope is None or rough > TEETH else slope * value / self.size
                  for slope, rough, value in zip(answer.slopes, answer.rough, values)]
        point = Point(np.array(at), residual, np.array(slopes).T, answer.rough, answer)
        return point, f"root mean square {self.in_words(np.sqrt(np.mean(residual ** 2)))}"

    def fine_points(self):
        """All points that were evaluated with the scene's own load steps."""
        return [found for (fine, _), found in self.known.items() if fine and found is not None]

    def point(self, at):
        """The point there; None: the scene has no answer. Each is computed once for the same load steps."""
        key = (self.model.fine, np.asarray(at).tobytes())
        if key not in self.known:
            found, text = self._evaluate(at, not self.known)
            shown = "  ".join(f"{p.path} {v:.4g}{unit_of_key(p.path, self.model.units)}"
                              for p, v in zip(self.model.parameters, self.values(at)))
            coarse = self.model.begins_coarse
            say(f"analysis {self.count}{' with coarse steps' if coarse else ''}: {text}  {shown}")
            self.known[key] = found
        return self.known[key]


class Slopes:
    """Derivatives for the search: those of the analyses where they are of the curve, and else chords, which each step
    corrects (Broyden, Math. Comp. 19, 1965)."""

    def __init__(self, misfit, first):
        self.misfit = misfit
        self.law = np.array([p.of_law for p in misfit.model.parameters])
        self.chord = np.isnan(first.jacobian).any(axis=0)
        has = np.array([slope is not None for slope in first.answer.slopes])
        self.step = np.where(has, ROUGH_STEP, SMOOTH_STEP)
        self.columns = np.zeros_like(first.jacobian)

    def at(self, point):
        """The derivatives there."""
        known = np.where(self.chord, self.columns, point.jacobian)
        self.teeth(point)
        return np.where(np.isnan(known), self.columns, known)

    def teeth(self, point):
        """Columns that turn out to have teeth are followed by chords from then on; the last smooth one begins."""
        new = np.isnan(point.jacobian).any(axis=0) & ~self.chord
        self.chord |= new
        smooth = ~self.chord
        self.columns[:, smooth] = point.jacobian[:, smooth]

    def begin(self, point):
        """Chords where they are needed: of numbers of laws for all or for none, for the teeth of one are those of all. One
        of them is tried where their derivatives look smooth. Returns the points of the tries."""
        sizes = np.linalg.norm(np.nan_to_num(point.jacobian), axis=0)
        active = self.law & (self.chord | (sizes > NOTHING * np.linalg.norm(self.misfit.y / self.misfit.size)))
        tried = []
        if active.any() and not (self.chord & active).any():
            k = int(np.argmax(np.where(active, sizes, 0.0)))
            found = self.probe(point, k)
            tried = [found]
            if found is not None and not np.isnan(found.jacobian[:, k]).any():
                change, mean = found.residual - point.residual, 0.5 * (found.jacobian + point.jacobian)[:, k]
                if self.honest(change, mean * (found.at - point.at)[k]):
                    return [found]
                self.chord[k] = True
        if (self.chord & active).any():
            self.chord |= active
        tried += [self.probe(point, k) for k in np.flatnonzero(self.chord) if not self.columns[:, k].any()]
        return [found for found in tried if found is not None]

    @staticmethod
    def honest(change, predicted):
        """True if derivatives predict what an analysis has found between two points."""
        size = change @ change
        return not size > 0 or HONEST < (predicted @ change) / size < 1 / HONEST

    def probe(self, point, k):
        """Moves parameter k for its chord, to where there is more room. Returns the point there, or None."""
        lower, upper = self.misfit.bounds()
        for sign in (1.0, -1.0) if upper[k] - point.at[k] >= point.at[k] - lower[k] else (-1.0, 1.0):
            there = np.array(point.at)
            room = (upper[k] if sign > 0 else lower[k]) - there[k]
            there[k] += sign * min(self.step[k], 0.5 * abs(room))
            found = self.misfit.point(there)
            if found is not None:
                self.columns[:, k] = (found.residual - point.residual) / (there[k] - point.at[k])
                return found
        return None

    def correct(self, before, after, known):
        """Chords meet the step between two points. known: the derivatives that led there."""
        step = after.at - before.at
        if not (np.abs(step) > UPDATED * self.step).any():
            return
        change = after.residual - before.residual
        smooth = ~self.chord
        middle = 0.5 * (known[:, smooth] + np.where(np.isnan(after.jacobian), known, after.jacobian)[:, smooth])
        if not self.chord[self.law].any() and not step[~self.law].any() and not self.honest(change, middle @ step[smooth]):
            self.columns[:, smooth] = middle
            self.chord |= self.law
            smooth, middle = ~self.chord, middle[:, ~self.law[smooth]]
        moved = np.where(self.chord, step, 0.0)
        if not (np.abs(moved) > UPDATED * self.step).any():
            return
        missed = change - middle @ step[smooth] - self.columns @ moved
        self.columns += np.outer(missed, moved) / (moved @ moved)
