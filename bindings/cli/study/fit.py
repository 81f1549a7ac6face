#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Law parameters from measured load curves: `delam fit SCENE.toml --data curve.csv --parameters KEY ... --out DIR`.

Least squares between the reaction of the scene and the curve, with the derivatives of the analyses. Before the search
it says which parameters the data tell, and holds the others. Several scenes, each with its data, share the parameters.
Writes DIR/fit.json, DIR/fit.png and DIR/fit.csv (data and model); the last lines say the parameters with their
intervals.
"""
import contextlib
import json
import os
from dataclasses import dataclass

import command

if __name__ == "__main__":
    command.begin("delam: fit")

from packages import require  # noqa: E402

require("numpy", "scipy", "matplotlib")

import numpy as np  # noqa: E402

from _pictures.input_file import MOST_RESULT, Unreadable, read_json  # noqa: E402
from command import complain, loading, say  # noqa: E402
from fit_model import Infeasible, Model, Parameter, kind_of_new, read_scene, units_of_scene, word_of  # noqa: E402
from fitting.descent import COARSE_SHORT, ENOUGH, SHORT, Outcome, descend  # noqa: E402
from fitting.held import lines_of, moved_by_held, widened  # noqa: E402
from fitting.identify import TOLD, held_ranges, noise_of, told  # noqa: E402
from fitting.misfit import Misfit, Slopes  # noqa: E402
from fitting.profiles import Profile, shifts_of_held  # noqa: E402
from fitting.regression import refine  # noqa: E402
from analyses import DONE, NUMERICAL, Trouble, given_words, hold, make_folder, read_about, refuse_set, run_study, value_at  # noqa: E402
from measured.curve_data import CurveData, scale_of  # noqa: E402
from measured.units import unit_of_key  # noqa: E402
from own_files import claim, write_file  # noqa: E402

# Analyses of a fit of one or two parameters, and how many more for each beyond two; ends of intervals take two each of
# them, and so do those of what is held. A DCB, an ENF and an MMB of one parameter on meshes of `delam new` took 7 to 9, 100
# raw files of beams with a strength that is held 8 to 13 where more were allowed; with two thirds of ANALYSES, a start 12 %
# off ended before the least misfit.
ANALYSES, OF_MANY = 12, 28
# Residuals of this part of the largest y are the tolerance of the analyses: there is nothing to look for in them.
# damage_tolerance has 4e-4 as its default, and peaks of a few points have errors of this size.
EXACT = 1e-4
DECIDED = 1.5  # by this factor a parameter must be told better, or worse, than TOLD to be taken in, or out, again
FARTHER = (0.25, 4.0)  # where a start without any damage is left to, by these factors
# Where a start is left to at which the data tell nothing, though the model is off: to less toughness and strength, since a
# curve tells of them from where it leaves its straight line. An ENF whose notch is 0.6 of the half span and whose start is
# 20 % too tough lets go where its data end. With the squares of these factors more analyses would lead back.
EARLIER = (0.7, 0.4)
# From this root mean square on the model is not that of the curve: good fits of the trials have 0.4 to 1.3 %, a toughness that
# grows with the crack by 40 % leaves 2.8 %, a width that is half 19 %. From half of it on the residuals count as systematic if
# they are larger than the noise by the factor.
POOR, SYSTEMATIC = 0.05, 3.0
SAME_DROP = 0.03  # of the range of x: jumps that lie closer are steps of one drop
# Toughnesses of mode I that fits of scenes of `delam new mmb` have found, over those of the data (bindings/site/pages/tests/trials.md).
BIAS_OF_MMB = (0.96, 1.14)
OFF = 0.01  # root mean square from which on the model is off at its start: that of a load cell (identify.ACCURACY)


@dataclass
class Solution:
    """outcome of the search, mask of the parameters that the data tell, a sentence for each other one, intervals of the
    kept ones, the profile that they are of, how what is held shifts them, and what the numbers do that are no parameters."""
    outcome: Outcome
    kept: np.ndarray
    reasons: dict
    intervals: list
    profile: Profile
    shifts: list
    others: list


class Search:
    """Finds the parameters: from a start, through which of them are told, to their intervals."""

    def __init__(self, model, weights, level, held=0.0):
        """held: by which part numbers that are no parameters move in the end; 0: they do not."""
        self.model, self.level, self.part = model, level, held
        self.misfit = Misfit(model, weights)
        self.names = [p.path for p in model.parameters]
        self.units = [unit_of_key(name, model.units) for name in self.names]
        count = len(self.names)
        self.most = ANALYSES + OF_MANY * max(0, count - 2)
        self.for_held = 0  # analyses
        self.analyses_of_search = 0
        self.noise = max(noise_of(data, np.max(np.abs(data.y))) for data in model.data)

    def left(self):
        return self.most - self.misfit.count - self.for_held

    def _begin(self):
        """The start, and the derivatives there; where nothing is damaged yet, another one."""
        point = self.misfit.point(np.zeros(len(self.names)))
        idle = [k for k, p in enumerate(self.model.parameters) if p.of_law and not point.jacobian[:, k].any()]
        lower, upper = self.misfit.bounds()
        if idle and np.sqrt(point.misfit / len(self.misfit.y)) > OFF:
            for factor in FARTHER:
                there = np.array(point.at)
                there[idle] += np.clip(np.log(factor), 0.9 * lower[idle], 0.9 * upper[idle])
                found = self.misfit.point(there)
                if found is not None and found.misfit < point.misfit:
                    point = found
                    break
        slopes = Slopes(self.misfit, point)
        return point, slopes, slopes.begin(point)

    def _begin_earlier(self, begin):
        """The same as _begin from starts at which the data tell something; None: there is no such start, or the model is
        as good as the data where it begins."""
        laws = np.array([p.of_law for p in self.model.parameters])
        if not laws.any() or np.sqrt(begin.misfit / len(self.misfit.y)) < OFF:
            return None
        lower, upper = self.misfit.bounds()
        for factor in EARLIER:
            point = self.misfit.point(np.clip(begin.at + np.where(laws, np.log(factor), 0.0), lower, upper))
            if point is None:
                continue
            slopes = Slopes(self.misfit, point)
            tried = slopes.begin(point)
            if self._told(slopes.at(point))[0].any():
                return point, slopes, tried
        return None

    def _told(self, jacobian, before=None, residual=None):
        """Which parameters are told. before: those that were; a search must not go to and fro for the last digit."""
        if before is None:
            kept, reasons = told(jacobian, self.noise, self.names)
        else:
            noise = max(self.noise, float(np.std(residual)))
            more, reasons = told(jacobian, noise, self.names, TOLD / DECIDED)
            fewer, reasons_fewer = told(jacobian, noise, self.names, TOLD * DECIDED)
            kept = (before & fewer) | more
            reasons = {k: reasons_fewer.get(k, reasons.get(k, "")) for k in np.flatnonzero(~kept)}
        return kept, reasons

    def _nothing_told(self, reasons):
        data = self.model.data
        idle = [self.names[k] for k, reason in reasons.items() if "does not depend" in reason]
        if len(idle) == len(self.names):
            name, unit = self.model.named_x(0)
            where = f" for a {name} from {data[0].x[0]:g} to {data[0].x[-1]:g}{unit}" if len(data) == 1 else ""
            return (f"{'the curve does' if len(data) == 1 else 'the curves do'} not depend on {', '.join(idle)}{where}: "
                    "numbers of laws act where the interface damages, or the crack grows, in their mode; are the data in the units of the "
                    "scene, and do they reach so far?")
        return "the data tell none of the parameters: " + "; ".join(f"{self.names[k]}: {reasons[k]}" for k in sorted(reasons))

    def say_left_out(self, reasons, at):
        for k in sorted(reasons):
            say(f"{self.names[k]} is not told by the data and stays at {self.misfit.values(at)[k]:.4g}{self.units[k]}: "
                f"{reasons[k]}")

    def _descend(self, slopes, begin, kept):
        reserve, coarse = 2 * int(kept.sum()), self.model.begins_coarse
        outcome = descend(self.misfit, slopes, begin, kept, self.left() - reserve - int(coarse),
                          COARSE_SHORT if coarse else SHORT)
        self.model.fine = True
        if not coarse:
            return outcome
        fine = self.misfit.point(outcome.point.at)
        if fine is None:
            raise Trouble("the scene does not run with its own load steps where it does with fewer", NUMERICAL)
        return descend(self.misfit, slopes, fine, kept, self.left() - reserve)

    def _put_back(self, outcome, dropped, kept):
        """The point from which to go on where some parameters are dropped: they have their starts again, and the others
        follow by the derivatives."""
        if not dropped.any():
            return outcome.point
        lower, upper = self.misfit.bounds()
        there = np.where(dropped, 0.0, outcome.point.at)
        change = outcome.jacobian[:, dropped] @ (there - outcome.point.at)[dropped]
        there[kept] -= np.linalg.lstsq(outcome.jacobian[:, kept], change, rcond=None)[0]
        return self.misfit.point(np.clip(there, lower, upper)) or outcome.point

    def run(self):
        begin, slopes, tried = self._begin()
        kept, reasons = self._told(slopes.at(begin))
        if not kept.any():
            begin, slopes, tried = self._begin_earlier(begin) or (begin, slopes, tried)
            kept, reasons = self._told(slopes.at(begin))
        self.for_held = 2 * int((~kept).sum())
        if not kept.any():
            raise Trouble(self._nothing_told(reasons), NUMERICAL)
        self.say_left_out(reasons, begin.at)
        begin = min([begin, *(found for found in tried if not found.at[~kept].any())], key=lambda one: one.misfit)
        if kept.sum() > len(self.misfit.y):
            raise Trouble(f"{len(self.misfit.y)} points for {kept.sum()} parameters: as many are expected, and more for "
                          "intervals", NUMERICAL)
        outcome = self._descend(slopes, begin, kept)
        # At the solution more may be told, or less.
        again, reasons_again = self._told(outcome.jacobian, kept, outcome.point.residual)
        if (again != kept).any() and again.any() and self.left() > 2 * int(again.sum()):
            for k in np.flatnonzero(again & ~kept):
                say(f"{self.names[k]} is told by the data after all: from here on it is fitted")
            begin = self._put_back(outcome, kept & ~again, again)
            self.say_left_out({k: reasons_again[k] for k in np.flatnonzero(kept & ~again)}, begin.at)
            reasons = {k: reasons_again.get(k) or reasons[k] for k in np.flatnonzero(~again)}
            kept = again
            self.for_held = 2 * int((~kept).sum())
            outcome = self._descend(slopes, begin, kept)
        elif (kept & ~again).any():
            outcome.converged, outcome.message = False, "the data do not tell what is fitted where the search has ended"
        outcome, intervals, profile = self._intervals(slopes, outcome, kept)
        shifts = shifts_of_held(self.misfit, outcome, kept, held_ranges(self.misfit, outcome.point.at))
        self.analyses_of_search = self.model.analyses
        others = moved_by_held(self.model, self.misfit, outcome, kept, self.part) if self.part > 0 else []
        return Solution(outcome, kept, reasons, intervals, profile, shifts, others)

    def _intervals(self, slopes, outcome, kept):
        while True:
            profile = Profile(self.misfit, outcome, kept, slopes.chord, self.level)
            if not self._worth_ends(outcome, profile, kept):
                return outcome, profile.of_derivatives(), profile
            ends = 2 * int(kept.sum())
            intervals = []
            for k in range(int(kept.sum())):
                intervals.append(profile.interval(k, self.left() - ends + 2 * k))
            news = ENOUGH * outcome.point.misfit / (len(self.misfit.y) - kept.sum())
            better = profile.better
            if better is None or better.misfit >= outcome.point.misfit - news:
                outcome, moved = refine(self.misfit, outcome, kept, self.left())
                if moved:
                    profile = Profile(self.misfit, outcome, kept, slopes.chord, self.level)
                    intervals = profile.of_derivatives()
                return outcome, intervals, profile
            if self.left() < ends:  # no analyses for another search and its ends
                profile = Profile(self.misfit, Outcome(better, outcome.jacobian, False, "no analyses were left"), kept,
                                  slopes.chord, self.level)
                return profile.outcome, profile.of_derivatives(trusted=False), profile
            outcome = descend(self.misfit, slopes, better, kept, self.left() - ends)

    def _worth_ends(self, outcome, profile, kept):
        """True if there are errors, and more of them than the analyses have."""
        points = len(self.misfit.y)
        return (points > kept.sum() and self.left() >= 2 * int(kept.sum()) and np.isfinite(profile.errors()).all()
                and outcome.point.misfit > points * (EXACT * np.max(np.abs(self.misfit.y / self.misfit.size))) ** 2)


def rows_of(search, found):
    """What fit.json says of each parameter."""
    values, misfit_start = search.misfit.values(found.outcome.point.at), search.misfit.start
    lower, upper = search.misfit.bounds()
    places = np.flatnonzero(found.kept).tolist()
    errors = found.profile.errors()
    factors = found.profile.factors
    rows = []
    for k, parameter in enumerate(search.model.parameters):
        row = {"key": parameter.path, "value": values[k], "start": parameter.start, "told": bool(found.kept[k]),
               "standard_error": None, "interval": [None, None], "at_bound": False}
        rows.append(row)
        if not found.kept[k]:
            row["reason"] = found.reasons[k]
            continue
        at, which = found.outcome.point.at[k], places.index(k)
        row["at_bound"] = bool(min(at - lower[k], upper[k] - at) < 1e-9)
        if found.intervals:
            # Of what lies anywhere in a range, the confidence lies in the same part of it.
            one, shift = found.intervals[which], found.shifts[which]
            held = [min(factors[which] * shift.standard, search.level * most) for most in (shift.below, shift.above)]
            row["standard_error"] = values[k] * float(np.hypot(errors[which], shift.standard))
            ends = np.array([-np.hypot(one.below, held[0]), np.hypot(one.above, held[1])])
            ends = np.clip(at + ends, lower[k], upper[k])
            # Beyond this a logarithm has no number, and the data no say.
            row["interval"] = [float(misfit_start[k] * np.exp(end)) if abs(end) < 300 else None for end in ends]
            if found.others and None not in row["interval"]:
                factors_of_ends = widened(found.others, *(end / values[k] for end in row["interval"]), k)
                row["interval_with_held"] = [float(values[k] * factor) for factor in factors_of_ends]
            row["of_held"] = [float(values[k] * abs(np.expm1(end))) for end in (-held[0], held[1])]
    return rows


def correlations(search, found):
    """Between all parameters; None where one is held."""
    out = [[None] * len(search.names) for _ in search.names]
    errors = found.profile.errors()
    for i, a in enumerate(np.flatnonzero(found.kept)):
        for j, b in enumerate(np.flatnonzero(found.kept)):
            size = errors[i] * errors[j]
            out[a][b] = float(found.profile.covariance[i, j] / size) if size > 0 and found.intervals else None
    return out


def report(search, found, given):
    with loading():
        from fit_pictures import draw_fit
    model, misfit, out = search.model, search.misfit, given.out
    answer, residual = found.outcome.point.answer, found.outcome.point.residual
    rows = rows_of(search, found)
    doubted = [search.names[k] for k, one in zip(np.flatnonzero(found.kept), found.intervals) if not one.trusted]
    rms = float(np.sqrt(np.mean(residual ** 2)))
    jumps = [sorted(set(map(float, history[model.x_name][history["jumps"] > 0]))) for history in answer.histories]
    all_drops = [drops(at, np.ptp(history[model.x_name])) for at, history in zip(jumps, answer.histories)]
    share = rms / float(np.max(np.abs(misfit.y / misfit.size)))
    about_model = remarks(search, share, rows)
    about = {"parameters": rows, "confidence": given.confidence, "correlation": correlations(search, found), "rms": rms,
             "points": len(misfit.y), "analyses": search.analyses_of_search, "converged": found.outcome.converged, "describes": share < POOR,
             "message": found.outcome.message, "scenes": model.files, "data": [d.path for d in model.data],
             "read": [d.said for d in model.data], "units": list(model.units), "jumps": jumps, "unknown_pairs": model.unknown, "doubted": doubted,
             "held_larger_by": search.part, "held": held_rows(search, found)}
    write_file(os.path.join(out, "fit.json"), json.dumps(about, indent=1, allow_nan=False))
    lines = ["scene,x,y,model,residual"]
    texts = [text_of(row, search, given.confidence, 4, "\n") for row in rows if row["told"]] + about_model
    for which, (data, curve) in enumerate(zip(model.data, answer.curves)):
        lines += [f"{which + 1},{x!r},{y!r},{m!r},{m - y!r}" for x, y, m in zip(*map(np.ndarray.tolist, (data.x, data.y, curve)))]
        draw_fit(out, which, model, curve, answer.histories[which], all_drops[which],
                 read_about(os.path.join(model.work, f"{which + 1}-at")), texts)
    write_file(os.path.join(out, "fit.csv"), "\n".join(lines) + "\n")
    say_rows(rows, search, given.confidence)
    for line in lines_of(found.others, search.part, search.names, lambda key: unit_of_key(key, model.units)):
        say(line)
    say(f"root mean square of the residuals {misfit.in_words(rms)}, {len(misfit.y)} points, {analyses(search)}"
        f"{'' if found.others else '; ' + right(search.names)}")
    for text in about_model:
        say(f"warning: {text}")
    warn(search, found, doubted, all_drops)
    return share < POOR


def drops(jumps, wide):
    """Where the analysis jumps, from and to: jumps from pair to pair that lie close by are one drop."""
    out = []
    for x in jumps:
        if out and x - out[-1][1] <= SAME_DROP * wide:
            out[-1][1] = x
        else:
            out.append([x, x])
    return out


def remarks(search, share, rows):
    """What the terminal and the picture say of how well the model can stand for the test. share: root mean square of the
    residuals over the largest y."""
    out = []
    over = share / search.noise if search.noise > 0 else np.inf
    if share >= POOR:
        out.append(f"the model does not describe the curve, {100 * share:.3g} % off as a root mean square: the intervals mean nothing; width, "
                   "notch, moduli, another test, or an end that the scene does not have are likely")
    elif share >= 0.5 * POOR and over > SYSTEMATIC:
        out.append(f"the model is off the curve by {100 * share:.3g} % as a root mean square, {over:.2g} times the noise: the intervals, which "
                   "take it as right, mean little; a toughness that grows with the crack is a likely reason")
    one = [row["key"] for row in rows if row["told"] and row["key"].endswith("normal_toughness")]
    if one and [kind_of_new(path) for path in search.model.files] == ["mmb"]:
        out.append("fits of one mixed-mode test whose toughness is known were {:.0f} % too small to {:.0f} % too large in {}, because all errors of the model "
                   "fall on it (site, trials of fits)".format(100 - 100 * BIAS_OF_MMB[0], 100 * BIAS_OF_MMB[1] - 100, one[0]))
    return out


def held_rows(search, found):
    """What fit.json says of the numbers that are no parameters."""
    return [{"key": one.key, "value": one.value,
             "changes": None if one.moves is None else {name: None if np.isnan(move) else float(move)
                                                        for name, move in zip(search.names, one.moves)}}
            for one in found.others]


def analyses(search):
    """How many there were, those of the search apart from those with what is held."""
    more = search.model.analyses - search.analyses_of_search
    return f"{search.analyses_of_search} analyses" + (f" and {more} of what is held" if more else "")


def right(names):
    """What the intervals know nothing of, in a sentence."""
    alone = any(name.endswith("_toughness") for name in names) and not any(name.endswith(("_strength", "_onset")) for name in names)
    return "intervals take the model as right" + (", strengths too, which are not among --parameters" if alone else "")


def text_of(row, search, level, digits=6, between=" "):
    """A parameter with its interval; where other numbers are held, the interval with errors in these comes first."""
    unit = unit_of_key(row["key"], search.model.units)

    def ends(name):
        low, high = (float("nan") if end is None else end for end in row[name])
        return f"{low:.{digits}g} to {high:.{digits}g}{unit}"

    text = f"{row['key']} = {row['value']:.{digits}g}{unit}, {100 * level:g} % interval "
    of_held = (" (of this {:.2g} below and {:.2g}{} above for parameters that are held)".format(*row["of_held"], unit)
               if any(row.get("of_held", [])) else "")
    if "interval_with_held" in row:
        return (f"{text}{ends('interval_with_held')} with errors of {100 * search.part:g} % in each number that is held,"
                f"{between}{ends('interval')} from the curve alone{of_held}")
    return text + ends("interval") + of_held


def say_rows(rows, search, level):
    for row in rows:
        if row["told"]:
            say(text_of(row, search, level) + (" (at its bound)" if row["at_bound"] else ""))
        else:
            say(f"{row['key']} is not told by the data: {row['value']:.4g}{unit_of_key(row['key'], search.model.units)} is its start")


def finer(scene):
    """Settings that halve the cells and the load steps, as far as the scene says them by one number."""
    found = [f"--set {key}={2 * int(value)}" for key in ("geometry.divisions", "time.steps")
             if (value := value_at(scene, key)) is not None]
    return f" ({' '.join(found)})" if found else ""


def warn(search, found, doubted, all_drops):
    model = search.model
    there = dict(zip(search.names, search.misfit.values(found.outcome.point.at)))
    if not found.outcome.converged:
        words = " ".join(f"{word_of(name)}@{there[name]:.6g}" for name in there)
        say(f"warning: {search.analyses_of_search} analyses have not found the least misfit ({found.outcome.message}): begin from there, "
            f"--parameters {words}")
    if doubted:
        one = len(doubted) == 1
        elsewhere = " ".join(f"{word_of(name)}@{1.2 * there[name]:.4g}" for name in doubted)
        say(f"warning: the interval{'' if one else 's'} of {', '.join(doubted)} cannot be trusted: at {'its' if one else 'their'} "
            f"ends the misfit is not what the derivatives say; the curve may depend on {'it' if one else 'them'} in steps, from "
            f"pair to pair: refine the mesh{finer(model.scenes[0])}, and begin elsewhere (--parameters {elsewhere})")
    for path, count in zip(model.files, model.unknown):
        if count:
            say(f"warning: {path}: the adhesion of {count:.0f} pairs came to rest within a step and is taken as constant; "
                "the derivatives, and with them the intervals, are not exact")
    for which, (path, at) in enumerate(zip(model.files, all_drops)):
        if at:
            name, unit = model.named_x(which)
            places = ", ".join(f"{low:.4g}" + (f" to {high:.4g}" if high > low else "") for low, high in at[:5])
            say(f"warning: {path} jumps at a {name} of {places}{unit}: the analysis has no "
                "derivative there, and the intervals do not know of it")


def claim_folder(out, curves):
    """A fit that is there is replaced, and nothing else."""
    names = ["fit.json", "fit.csv", "fit.png", "work", *(f"fit-{k + 1}.png" for k in range(curves))]
    before = os.path.join(out, "fit.json")
    known = False
    if os.path.lexists(before):
        with contextlib.suppress(Unreadable):
            about = read_json(before, MOST_RESULT)
            known = isinstance(about, dict) and {"parameters", "rms"} <= set(about) and bool({"analyses", "marches"} & set(about))
    claim(out, names, known)


def counted(number, what):
    return f"{number} {what}{'' if number == 1 else 's'}"


def specimens_of(given):
    """Which test of its file each curve is, "" where the file has one."""
    words = given.specimen or [""]
    if len(words) not in (1, len(given.data)):
        raise Trouble(f"--specimen: {counted(len(words), 'name')} for {counted(len(given.data), 'file')}: one for all, or one for each, "
                      "is expected")
    return words * (len(given.data) // len(words))


def read_all(given):
    """The scenes and their data."""
    if len(given.data) != len(given.scenes):
        raise Trouble(f"--data: {counted(len(given.data), 'curve')} for {counted(len(given.scenes), 'scene')}: one for each is expected")
    for path in given.scenes:
        if path.lower().endswith(".inp"):
            raise Trouble(f"{path}: write the scene of a deck first: delam import {path} --out scene.toml")
    scenes = [read_scene(path) for path in given.scenes]
    data = []
    for path, scene, specimen in zip(given.data, scenes, specimens_of(given)):
        units = units_of_scene(scene, given.set)
        one = CurveData(path, given, units, scale_of(given, units[0]), specimen)
        data.append(one)
        say(one.said)
        if not all(units) and any(one.named_units):
            complain(f"warning: {path} names units, and the scene does not: the numbers are taken as they are; name "
                     "[units] in the scene to have them converted")
    return scenes, data


def main():
    given = given_words()
    parameters = [Parameter(text) for text in given.parameters]
    refuse_set([p.path for p in parameters], given.set, "--parameters")
    if len({p.path for p in parameters}) < len(parameters):
        raise Trouble("--parameters: a key is given twice")
    scenes, data = read_all(given)
    search = Search(Model(given.scenes, scenes, data, parameters, given), given.weights, given.confidence,
                    given.held)
    held = hold(given.out)  # until the end
    claim_folder(given.out, len(data))
    make_folder(os.path.join(given.out, "work"))
    try:
        found = search.run()
    except Infeasible as error:
        raise Trouble(f"the scene does not run at the end: {error}", error.code) from error
    describes = report(search, found, given)
    held.close()
    say(f"wrote {given.out}: fit.json, fit.csv, " + ("fit.png" if len(data) == 1 else f"fit-1.png to fit-{len(data)}.png") +
        "; work has the last analyses")
    return DONE if found.outcome.converged and describes else NUMERICAL


if __name__ == "__main__":
    run_study(main)
