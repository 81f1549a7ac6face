# SPDX-License-Identifier: BSD-3-Clause
"""The evaluation of one specimen: its curve, its sheet, and what each method of the standard says at each point, with
intervals."""
import os

import numpy as np

from command import Trouble, complain
from measured.units import kind_of, quantity
from scatter.intervals import MEAN, intervals
from scatter.intervals import lines as interval_lines
from scatter.spread import OfMarks, OfScatter, OfSlope
from specimens import methods
from specimens.answer import Answer
from specimens.checks import (complain_of_growth, complain_of_offsets, complain_of_opening, complain_of_spread,
                              complain_of_toughness, require_lengths, require_marks, said_of_marks)
from specimens.curve import Curve
from specimens.points import Points
from specimens.sheet import require_growing, require_modulus, sheet_of

LEAST_MARKS = 3  # crack lengths for a line through their compliances; ISO 15024 asks for more


def along_marks(marks, sheet, points, grown):
    """Answers of the methods that are calibrated by the marks of the crack."""
    answers, (d, p, a) = [], (marks[:, 0] - points.zero, marks[:, 1], marks[:, 2])
    for name, method in (("corrected beam theory", methods.corrected_beam_theory),
                         ("modified beam theory", methods.modified_beam_theory),
                         ("compliance calibration", methods.compliance_calibration),
                         ("modified compliance calibration", methods.modified_compliance_calibration)):
        rate, numbers, _ = method(d, p, a, sheet)
        answers.append(Answer(name, marks[:, 0], a, rate(d, p, a), rate, numbers, grown, OfMarks(method, marks, sheet, points, grown)))
    return answers


def evaluate_dcb(curve, sheet, given, checks=True):
    """Answers of the methods, and the points. checks: False for a curve of the same specimen with other noise, of which only
    what no marks calibrate is asked."""
    points = Points(curve.displacement, curve.load, curve.path)
    marks = points.without_noise(curve.marks)
    if checks:
        require_lengths(curve, sheet, given)
        points.modulus = require_modulus(lambda c, one: methods.dcb_modulus(c, one)[0], points.compliance, sheet, curve, "dcb")
        require_marks(marks, curve, points, sheet, given, lambda c, one: methods.dcb_modulus(c, one)[0])
    answers, offset = [], 0.0
    if len(marks) >= LEAST_MARKS:
        d, p, a = marks[:, 0] - points.zero, marks[:, 1], marks[:, 2]
        grown = np.flatnonzero(a > 1.0001 * sheet["notch"])
        points.add_visual(marks, grown[0])
        offset = methods.modified_beam_theory(d, p, a, sheet)[1]["offset"]
        if checks:
            require_growing(a, d / p, curve.path, "is the column of crack lengths another one (--crack)?")
            answers = along_marks(marks, sheet, points, grown)
    else:
        complain(f"warning: {curve.path}: {len(marks)} crack lengths: at least {LEAST_MARKS} are needed for beam theory with a "
                 "corrected crack and for calibrations: a column \"Crack (mm)\" of the file, or a sheet apart (--marks FILE); the "
                 "crack is taken from the compliance")
    if "E1" not in sheet and not {"E2", "G13"} <= sheet.keys() and not offset > 0:
        complain("warning: effective crack: the initial compliance alone knows nothing of the rotation of the arms at the tip, "
                 "so that these values are too large, by 3 to 10 % for unidirectional composites: give --E1, or --E2 and --G13")
    crack, rate = methods.dcb_effective(points.compliance, sheet, offset)
    answers.append(points.along("effective crack", crack, rate))
    points.place_cracks(sheet["notch"], marks)
    if checks:
        cracks = np.array([(p.displacement - points.zero, p.crack) for p in points.points] + [(row[0] - points.zero, row[2]) for row in marks])
        complain_of_opening(curve.path, *cracks.T)
    return answers, points


def calibration_curve(word, given):
    """The curve of a file at another crack length. word: FILE, or FILE:TEST where the file has several tests."""
    path, _, test = word.rpartition(":")
    if os.path.lexists(word) or not os.path.lexists(path):
        return Curve(word, given, "", "")
    return Curve(path, given, "", test)


def calibrated(curve, points, sheet, given):
    """Compliance calibration of ASTM D7905, with the files of other crack lengths."""
    cracks, compliances = [sheet["notch"]], [points.compliance]
    for word in given.calibration:
        length, sign, path = word.partition("=")
        read = quantity(length, "length")
        if read is None or not read[1] or not sign:
            raise Trouble(f"--calibration {word[:60]}: LENGTH=FILE is expected, such as 20mm=a20.csv, or LENGTH=FILE:TEST, such as "
                          "20mm=all.csv:2, with the name or the number of one of the tests of a file")
        if word not in given.read:
            given.read[word] = calibration_curve(path, given)
        other = given.read[word]
        cracks.append(read[0] * kind_of(read[1])[1])
        for k, known in enumerate(cracks[:-1]):
            if abs(cracks[-1] / known - 1) < 1e-3:
                raise Trouble(f"--calibration {word[:60]}: {1e3 * known:g} mm is the length of "
                              f"{given.calibration[k - 1][:60] if k else '--notch'}, too: different lengths are expected")
        compliances.append(Points(other.displacement, other.load, path).compliance)
    if len(cracks) < LEAST_MARKS:
        complain(f"warning: compliance calibration of ASTM D7905 needs --calibration LENGTH=FILE for two more crack lengths; "
                 f"{len(cracks) - 1} given")
        return []
    require_growing(cracks, compliances, "--calibration", "do the files belong to other lengths?", each=True)
    intercept, m, error = methods.enf_calibration(cracks, compliances)
    return [Answer("compliance calibration", curve.displacement, np.full(len(curve.load), sheet["notch"]),
                   methods.enf_calibrated(points.load, m, sheet), lambda d, p, a: methods.enf_calibrated(p, m, sheet),
                   {"A": intercept, "m": m}, spread=OfSlope(error, len(cracks)))]


def evaluate_enf(curve, sheet, given, checks=True):
    points = Points(curve.displacement, curve.load, curve.path)
    if checks:
        points.modulus = require_modulus(lambda c, one: methods.enf_modulus(c, one)[0], points.compliance, sheet, curve, "enf")
    answers = calibrated(curve, points, sheet, given) if checks else []
    if "G13" not in sheet:
        complain("warning: effective crack: without --G13 the shear of the beam counts as crack if --E1 is given (these values are "
                 "some per cent too large), and as bending if not (too small): give --E1, --E2 and --G13")
    elif "E2" not in sheet:
        complain("warning: effective crack: without --E2 the rotation of the arms at the tip is left out: these values are some "
                 "per cent too small")
    crack, rate = methods.enf_effective(points.compliance, sheet)
    answers.append(points.along("effective crack", crack, rate))
    points.place_cracks(sheet["notch"], curve.marks)
    return answers, points


def evaluate_mmb(curve, sheet, given, checks=True):
    points = Points(curve.displacement, curve.load, curve.path)
    chi = methods.chi(sheet["E1"], sheet["E2"], sheet["G13"])
    modulus = methods.mmb_modulus(points.compliance, chi, sheet)
    marks = points.without_noise(curve.marks)
    if checks:
        require_lengths(curve, sheet, given)
        points.modulus = require_modulus(lambda c, one: methods.mmb_modulus(c, chi, one), points.compliance, sheet, curve, "mmb")
        require_marks(marks, curve, points, sheet, given, lambda c, one: methods.mmb_modulus(c, chi, one))
    if len(marks):
        points.add_visual(marks, np.flatnonzero(marks[:, 2] > sheet["notch"])[0])
    points.place_cracks(sheet["notch"], marks)
    rows = marks if len(marks) else np.array([[p.displacement, p.load, p.crack] for p in points.points])

    def both(p, a):
        return methods.mixed_mode_bending(p, a, chi, modulus, sheet)

    one, two = both(rows[:, 1], rows[:, 2])
    numbers = {"chi": chi, "bending modulus": modulus, "mode II share": float(two[0] / (one[0] + two[0]))}
    grown = np.flatnonzero(marks[:, 2] > 1.0001 * sheet["notch"]) if len(marks) else ()
    crack, rate = methods.mmb_effective(points.compliance, chi, sheet)
    return [Answer("beam theory with corrections", rows[:, 0], rows[:, 2], one + two, lambda d, p, a: sum(both(p, a)), numbers,
                   grown, OfScatter(marks, one + two, points, grown) if len(marks) else None, rows[:, 1]),
            points.along("effective crack", crack, rate)], points


TESTS = {"dcb": evaluate_dcb, "enf": evaluate_enf, "mmb": evaluate_mmb}
TITLES = {"dcb": "double cantilever beam, mode I", "enf": "end-notched flexure, mode II", "mmb": "mixed-mode bending, both modes together"}


def at_points(answers, points, path):
    """The toughness of each method at each point, in J/m2; none may be negative."""
    table = {}
    for answer in answers:
        table[answer.name] = {p.name: answer.at(p, points.zero) for p in points.points}
        for name, rate in table[answer.name].items():
            if not rate > 0:
                words = [", ".join(answer.words())] if answer.words() else []
                raise Trouble(": ".join([f"{path}: {answer.name}: {rate:.4g} J/m2 at {name}, which no toughness is", *words,
                                         "another column, unit, --notch or --span?"]))
    return table


def lines(table, answers, points, sheet):
    """What the command says of the methods."""
    for answer in answers:
        said = ", ".join(f"{point} {rate:.4g}" for point, rate in table[answer.name].items())
        mean = answer.propagation()
        said += f", propagation {mean[0]:.4g} +- {mean[1]:.2g} of {mean[2]} marks" if mean else ""
        yield f"{answer.name}: {said} J/m2" + (f" ({', '.join(answer.words())})" if answer.numbers else "")
    yield f"modulus: the initial compliance of {1e3 * points.compliance:.4g} mm/N gives a bending modulus of {points.modulus / 1e9:.4g} GPa" + (
        f", {points.modulus / sheet['E1']:.2f} of --E1" if "E1" in sheet else "") + (
            "" if {"E2", "G13"} <= sheet.keys() else " (without --E2 and --G13 the rotation of the arms counts as bending)")
    if abs(points.zero) > 0.01 * points.displacement[points.top]:
        yield (f"zero: the initial line begins at a displacement of {1e3 * points.zero:.4g} mm (slack or preload of the fixture), "
               "from which methods count")
    if any(point.after_largest_load for point in points.points):
        yield "5 %: the curve reaches this offset after its largest load, which is taken"
    if points.noise > 1e-3 * points.points[-1].load:
        error = 200 * max(p.error / p.load for p in points.points)
        yield (f"noise: {100 * points.noise / points.points[-1].load:.2g} % of the largest load; loads of points are those of lines "
               f"through their neighbours, which leaves up to {error:.2g} % of toughness (standard error)")


class Evaluation:
    """A specimen, evaluated; Trouble says why it cannot be. given: what the command line says, for this specimen."""

    def __init__(self, given):
        self.given, given.read = given, {}
        self.sheet = sheet_of(given)
        given.machine = self.sheet.pop("compliance", 0.0)
        self.curve = Curve(given.data[0], given, given.marks)

        def again(curve):
            return TESTS[given.test](curve, self.sheet, given, False)

        self.answers, self.points = TESTS[given.test](self.curve, self.sheet, given)
        self.table = at_points(self.answers, self.points, self.curve.path)
        complain_of_offsets({answer.name: answer.numbers for answer in self.answers}, self.sheet, self.points.modulus)
        complain_of_spread(self.table)
        complain_of_growth(self.curve, self.points)
        complain_of_toughness(self.table, self.curve)
        self.intervals = intervals(self.curve, self.answers, self.points, again, given.confidence)

    def lines(self):
        """What the command says of it."""
        yield from lines(self.table, self.answers, self.points, self.sheet)
        yield from interval_lines(self.intervals, self.given.confidence)
        counted = said_of_marks(self.curve.marks, self.sheet["notch"]) if self.given.test != "enf" else ""
        if counted:
            yield counted

    def values(self):
        """By method: the toughness at each point, and the mean of propagation where there is one."""
        out = {name: dict(rates) for name, rates in self.table.items()}
        for answer in self.answers:
            mean = answer.propagation()
            if mean:
                out[answer.name][MEAN] = mean[0]
        return out

    def about(self):
        """What is kept of it, in SI."""
        answers, points = self.answers, self.points
        return {"test": self.given.test, "file": self.curve.path, "specimen": self.given.specimen,
                "sheet": {key: text for key, text in self.given.sheet.items() if text},
                "units": {"displacement": "m", "crack": "m", "load": "N", "compliance": "m/N", "modulus": "Pa", "toughness": "J/m2",
                          "numbers": {name: unit for answer in answers for name, unit in answer.units().items()}},
                "compliance": points.compliance, "modulus": points.modulus, "zero": points.zero, "noise": points.noise,
                "points": [vars(p) | {"crack": p.crack if p.crack == p.crack else None} for p in points.points],
                "toughness": self.table, "numbers": {answer.name: answer.numbers for answer in answers},
                "propagation": {answer.name: dict(zip(("mean", "deviation", "marks"), answer.propagation())) for answer in answers
                                if answer.propagation()},
                "confidence": self.given.confidence,
                "intervals": {name: {point: vars(one) for point, one in rows.items()} for name, rows in self.intervals.items()}}
