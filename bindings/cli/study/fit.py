#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Law parameters from measured load curves: `delam fit SCENE.toml --data curve.csv --parameters KEY ... --out DIR`.

Least squares between the reaction of the scene and the curve, by SciPy's trust region (least_squares) with the
derivatives of the march. Several scenes, each with its data, share the parameters. Writes DIR/fit.json, DIR/fit.png and
DIR/fit.csv (data and model); the last lines say the parameters with their confidence intervals.
"""
import contextlib
import json
import os

import command

if __name__ == "__main__":
    command.begin("delam: fit")

from packages import require  # noqa: E402

require("numpy", "scipy", "matplotlib")

import numpy as np  # noqa: E402

from _pictures.input_file import MOST_RESULT, Unreadable, read_json  # noqa: E402
from command import loading, say  # noqa: E402
from curve_data import CurveData  # noqa: E402
from fit_model import Infeasible, Model, Parameter  # noqa: E402
from marches import (DONE, NUMERICAL, Trouble, given_words, hold, make_folder, read_about, refuse_set,  # noqa: E402
                     run_study)
from own_files import claim, write_file  # noqa: E402

WORSE = 10.0  # what a step into an infeasible region costs, in residuals: the trust region then shrinks

BEGINNINGS = 6  # of a fit whose solution turns out to have neighbours with less misfit
TRUSTED = 4.0  # by which factor the misfit at the ends of an interval may differ from that which the derivatives predict

ENOUGH = 0.01  # the sum of squares over their variance changes by 1 within a standard error: so much is no news


class Fit:
    """The residuals and their Jacobian in terms of parameters over their start."""

    def __init__(self, model, weights):
        self.model = model
        self.start = np.array([p.start for p in model.parameters])
        self.y = np.concatenate([data.y for data in model.data])
        self.size = np.concatenate([self._sizes(np.abs(data.y), weights) for data in model.data])
        if not (self.size > 0).all():
            raise Trouble("--data: a curve is zero throughout")
        self.known, self.norm = {}, None
        self.worst = None

    @staticmethod
    def _sizes(y, weights):
        """By what residuals are divided; errors in proportion to y are no smaller than 5 % of the largest allow."""
        if weights == "relative":
            return np.maximum(y, 0.05 * np.max(y))
        return np.full(len(y), np.max(y) if weights == "curve" else 1.0)

    def _at(self, scaled):
        key = scaled.tobytes()
        if key not in self.known:
            values = self.start * scaled
            first = self.norm is None
            try:
                curves, slopes = self.model.evaluate(values)
                residual = (np.concatenate(curves) - self.y) / self.size
                self.norm = np.linalg.norm(residual) if self.norm is None else min(self.norm, np.linalg.norm(residual))
                jacobian = slopes * self.start / self.size[:, None]
                note = ""
            except Infeasible as error:
                if first:
                    raise Trouble(f"the scene does not run at the start: {error}", error.code) from error
                residual = np.full(len(self.y), WORSE * max(self.norm, 1e-12) / np.sqrt(len(self.y)))
                jacobian, note = np.zeros((len(self.y), len(values))), f"  not feasible: {error}"
            self.known[key] = residual, jacobian
            shown = "  ".join(f"{p.path} {v:.6g}" for p, v in zip(self.model.parameters, values))
            say(f"march {self.model.marches}: root mean square {np.sqrt(np.mean(residual ** 2)):.4g}  {shown}{note}")
        return self.known[key]

    def residual(self, scaled):
        return self._at(scaled)[0]

    def jacobian(self, scaled):
        return self._at(scaled)[1]

    def bounds(self):
        return (np.array([p.lower for p in self.model.parameters]) / self.start,
                np.array([p.upper for p in self.model.parameters]) / self.start)

    def best(self, level):
        """The solution, and the parameters whose intervals the curves do not bear out (probe). Where a probe finds less
        misfit than the solution, the fit begins anew there: curves that depend on a parameter in steps, as cracks do
        that advance from pair to pair, have a minimum in each."""
        begin, doubted = np.ones(len(self.start)), []
        for _ in range(BEGINNINGS):
            found = self.run(begin)
            better, doubted = probe(self, found, level)
            if better is None:
                break
            begin = better
        return found, doubted

    def run(self, begin):
        with loading():
            from scipy.optimize import least_squares  # here, for it loads for a second, and words may be wrong
        lower, upper = self.bounds()
        return least_squares(self.residual, begin, jac=self.jacobian, bounds=(lower, upper),
                             x_scale="jac", ftol=ENOUGH / len(self.y), xtol=1e-5, gtol=1e-10, max_nfev=60)


def probe(fit, found, level):
    """Compares the misfit at both ends of each interval with that which the derivatives predict there, the other
    parameters following. Returns where it is lowest, if that is below the solution's, and the keys of the parameters
    for which one of them differs by more than a factor of `TRUSTED`. For these it also looks farther away."""
    try:
        _, _, intervals, correlation = estimates(fit, found, level)
    except Trouble:
        return None, []  # report() says so
    if not np.isfinite(intervals).all() or not np.isfinite(correlation).all():
        return None, []
    least = np.sum(found.fun ** 2)
    lower, upper = fit.bounds()
    normal = found.jac.T @ found.jac
    inverse = np.linalg.inv(normal)
    better, lowest, doubted = None, least * (1 - ENOUGH / len(fit.y)), []
    for k, parameter in enumerate(fit.model.parameters):
        ends = intervals[k] / fit.start[k]
        farther = [found.x[k] * (1 + share) for share in (-0.1, 0.1, -0.25, 0.25)]
        for which, end in enumerate([*ends, *farther]):
            if which >= len(ends) and parameter.path not in doubted:
                break
            at = np.clip(found.x + (end - found.x[k]) * inverse[:, k] / inverse[k, k], lower, upper)
            step = at - found.x
            predicted = step @ normal @ step
            if not predicted > 1e-6 * least or not np.isfinite(predicted):
                continue
            misfit = np.sum(fit.residual(at) ** 2)
            if misfit < lowest:
                better, lowest = at, misfit
            if which < len(ends) and not predicted / TRUSTED < misfit - least < predicted * TRUSTED:
                doubted = [*doubted, parameter.path] if parameter.path not in doubted else doubted
    return better, doubted


def estimates(fit, found, level):
    """Values, standard errors and intervals; the errors of the data are taken as independent."""
    with loading():
        from scipy.stats import t as student
    points, count = found.jac.shape
    values = fit.start * found.x
    freedom = points - count
    if freedom < 0:
        raise Trouble(f"{points} points for {count} parameters: as many are expected, and more for intervals", NUMERICAL)
    idle = [p.path for p, slope in zip(fit.model.parameters, found.jac.T) if not slope.any()]
    if idle:
        data = fit.model.data[0]
        raise Trouble(f"{'the curve does' if len(fit.model.data) == 1 else 'the curves do'} not depend on {', '.join(idle)}"
                      + (f" for {fit.model.x_name} from {data.x[0]:g} to {data.x[-1]:g}" if len(fit.model.data) == 1 else "")
                      + ": numbers of laws act where the interface damages or the crack grows; are the data in the units of the "
                        "scene, and do they reach so far?", NUMERICAL)
    left, singular, vectors = np.linalg.svd(found.jac, full_matrices=False)
    if singular[-1] <= 1e-10 * singular[0]:
        weak = np.abs(vectors[-1]) > 0.1
        names = ", ".join(p.path for p, is_weak in zip(fit.model.parameters, weak) if is_weak)
        raise Trouble(f"the data do not tell these parameters apart: {names}; give fewer, or other curves", NUMERICAL)
    if freedom == 0:
        return values, np.full(count, np.nan), np.full((count, 2), np.nan), np.full((count, count), np.nan)
    # The errors may differ from point to point (noise in proportion to the load): HC3 of J. MacKinnon, H. White, J.
    # Econometrics 29 (1985) 305-325, with the leverages h of the points.
    inverse = (vectors.T / singular) @ left.T
    leverage = np.sum(left ** 2, axis=1)
    covariance = (inverse * (found.fun / np.maximum(1 - leverage, 0.1)) ** 2) @ inverse.T
    errors = np.sqrt(np.diag(covariance))
    half = student.ppf(0.5 + 0.5 * level, freedom) * errors * fit.start
    with np.errstate(invalid="ignore"):  # exact data have no errors
        correlation = covariance / np.outer(errors, errors)
    return values, errors * fit.start, np.array([values - half, values + half]).T, correlation


def report(model, fit, found, doubted, level, out):
    with loading():
        from fit_pictures import draw_fit
    values, errors, intervals, correlation = estimates(fit, found, level)
    jumps = [sorted(set(map(float, at))) for at in model.jumps]
    rows = []
    for k, parameter in enumerate(model.parameters):
        at_bound = found.active_mask[k] != 0
        rows.append({"key": parameter.path, "value": values[k], "standard_error": errors[k],
                     "interval": list(intervals[k]), "start": parameter.start, "at_bound": bool(at_bound)})
    rms = float(np.sqrt(np.mean(found.fun ** 2)))
    about = {"parameters": rows, "confidence": level, "correlation": correlation.tolist(), "rms": rms,
             "points": len(fit.y), "marches": model.marches, "converged": bool(found.success),
             "message": found.message, "scenes": model.files, "data": [d.path for d in model.data],
             "jumps": jumps, "unknown_pairs": model.unknown, "doubted": doubted}
    # JSON has no NaN: there are no intervals.
    known = json.loads(json.dumps(about), parse_constant=lambda _: None)
    write_file(os.path.join(out, "fit.json"), json.dumps(known, indent=1, allow_nan=False))
    lines = ["scene,x,y,model,residual"]
    for which, (data, curve) in enumerate(zip(model.data, fit.model.evaluate(values)[0])):
        lines += [f"{which + 1},{x!r},{y!r},{m!r},{m - y!r}" for x, y, m in zip(*map(np.ndarray.tolist, (data.x, data.y, curve)))]
        draw_fit(out, which, len(model.data), model, curve, read_about(os.path.join(model.work, f"{which + 1}-at")))
    write_file(os.path.join(out, "fit.csv"), "\n".join(lines) + "\n")
    for row in rows:
        say(f"{row['key']} = {row['value']:.6g}, {100 * level:g} % interval {row['interval'][0]:.6g} to "
              f"{row['interval'][1]:.6g}" + (" (at its bound)" if row["at_bound"] else ""))
    say(f"root mean square of the residuals {rms:.4g}, {len(fit.y)} points, {model.marches} marches")
    if doubted:
        say(f"warning: the interval{'s' if len(doubted) > 1 else ''} of {', '.join(doubted)} cannot be trusted: at "
              "their ends the misfit is not what the derivatives say; the curve may depend on them in steps, from pair to "
              "pair: refine the mesh, and begin from other values")
    for path, count in zip(model.files, model.unknown):
        if count:
            say(f"warning: {path}: the adhesion of {count:.0f} pairs came to rest within a step and is taken as constant; "
                  "the derivatives, and with them the intervals, are not exact")
    for path, at in zip(model.files, jumps):
        if at:
            say(f"warning: {path} jumps at {model.x_name} {', '.join(f'{x:.6g}' for x in at[:5])}: the march has no "
                  "derivative there, and the intervals do not know of it")


def claim_folder(out, curves):
    """A fit that is there is replaced, and nothing else."""
    names = ["fit.json", "fit.csv", "fit.png", "work", *(f"fit-{k + 1}.png" for k in range(curves))]
    before = os.path.join(out, "fit.json")
    known = False
    if os.path.lexists(before):
        with contextlib.suppress(Unreadable):
            about = read_json(before, MOST_RESULT)
            known = isinstance(about, dict) and {"parameters", "rms", "marches"} <= set(about)
    claim(out, names, known)


def main():
    given = given_words()
    if len(given.data) != len(given.scenes):
        raise Trouble(f"--data: {len(given.data)} curves for {len(given.scenes)} scenes: one for each is expected")
    parameters = [Parameter(text) for text in given.parameters]
    refuse_set([p.path for p in parameters], given.set, "--parameters")
    for path in given.scenes:
        if path.lower().endswith(".inp"):
            raise Trouble(f"{path}: write the scene of a deck first: delam import {path} --out scene.toml")
    if len({p.path for p in parameters}) < len(parameters):
        raise Trouble("--parameters: a key is given twice")
    data = [CurveData(path, given.columns, given.scale) for path in given.data]
    model = Model(given.scenes, data, parameters, given)
    fit = Fit(model, given.weights)
    held = hold(given.out)  # until the end
    claim_folder(given.out, len(data))
    make_folder(os.path.join(given.out, "work"))
    found, doubted = fit.best(given.confidence)
    try:
        report(model, fit, found, doubted, given.confidence, given.out)
    except Infeasible as error:
        raise Trouble(f"the scene does not run at the end: {error}", error.code) from error
    held.close()
    say(f"wrote {given.out}: fit.json, fit.csv, fit.png" if len(data) == 1 else
          f"wrote {given.out}: fit.json, fit.csv, fit-1.png to fit-{len(data)}.png")
    return DONE if found.success else NUMERICAL


if __name__ == "__main__":
    run_study(main)
