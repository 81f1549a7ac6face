#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Toughnesses by the standards: `delam evaluate dcb | enf | mmb FILE --width 25mm --arm 1.5mm --notch 50mm .. --out DIR`.

Reads the raw file of a test machine as `delam fit` does. Writes DIR/evaluate.json, DIR/r-curve.csv and
DIR/evaluate.png; the lines say the toughness of each method at each point, beside that of a fit (--beside).
"""
import contextlib
import json
import os

import command

if __name__ == "__main__":
    command.begin("delam: evaluate")

from packages import require  # noqa: E402

require("numpy", "matplotlib")

import numpy as np  # noqa: E402

from _pictures.input_file import MOST_RESULT, Unreadable, read_json  # noqa: E402
from command import complain, loading, say  # noqa: E402
from analyses import DONE, Trouble, given_words, hold, run_study  # noqa: E402
from measured.units import kind_of, quantity  # noqa: E402
from own_files import claim, write_file  # noqa: E402
from specimens import methods  # noqa: E402
from specimens.answer import Answer  # noqa: E402
from specimens.beside import beside, compared  # noqa: E402
from specimens.checks import complain_of_offsets, complain_of_spread, complain_of_toughness, marked, require_lengths, said_of_marks  # noqa: E402
from specimens.curve import Curve  # noqa: E402
from specimens.points import Point, Points  # noqa: E402
from specimens.sheet import require_growing, require_modulus, sheet_of  # noqa: E402

LEAST_MARKS = 3  # crack lengths for a line through their compliances; ISO 15024 asks for more
NAMES = ["evaluate.json", "r-curve.csv", "evaluate.png"]


def evaluate_dcb(curve, sheet, given):
    """Answers of the methods, and the points."""
    require_lengths(curve, sheet, given)
    points = Points(curve.displacement, curve.load, curve.path)
    points.modulus = require_modulus(lambda one: methods.dcb_modulus(points.compliance, one)[0], points.compliance, sheet, curve, "dcb")
    marks = marked(curve, points, sheet, given, lambda compliance, one: methods.dcb_modulus(compliance, one)[0])
    answers, offset = [], 0.0
    if len(marks) >= LEAST_MARKS:
        d, p, a = marks[:, 0] - points.zero, marks[:, 1], marks[:, 2]
        require_growing(a, d / p, curve.path, "is the column of crack lengths another one (--crack)?")
        grown = np.flatnonzero(a > 1.0001 * sheet["notch"])
        points.add_visual(marks[grown[0]])
        for name, method in (("corrected beam theory", methods.corrected_beam_theory),
                             ("modified beam theory", methods.modified_beam_theory),
                             ("compliance calibration", methods.compliance_calibration),
                             ("modified compliance calibration", methods.modified_compliance_calibration)):
            rate, numbers = method(d, p, a, sheet)
            offset = numbers.get("offset", offset)
            answers.append(Answer(name, marks[:, 0], a, rate(d, p, a), rate, numbers, grown))
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
    return answers, points


def calibrated(curve, points, sheet, given):
    """Compliance calibration of ASTM D7905, with the files of other crack lengths."""
    cracks, compliances = [sheet["notch"]], [points.compliance]
    for word in given.calibration:
        length, sign, path = word.partition("=")
        read = quantity(length, "length")
        if read is None or not read[1] or not sign:
            raise Trouble(f"--calibration {word[:60]}: LENGTH=FILE is expected, such as 20mm=a20.csv")
        other = Curve(path, given, "")
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
    intercept, m = methods.enf_calibration(cracks, compliances)
    return [Answer("compliance calibration", curve.displacement, np.full(len(curve.load), sheet["notch"]),
                   methods.enf_calibrated(points.load, m, sheet), lambda d, p, a: methods.enf_calibrated(p, m, sheet),
                   {"A": intercept, "m": m})]


def evaluate_enf(curve, sheet, given):
    points = Points(curve.displacement, curve.load, curve.path)
    points.modulus = require_modulus(lambda one: methods.enf_modulus(points.compliance, one)[0], points.compliance, sheet, curve, "enf")
    answers = calibrated(curve, points, sheet, given)
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


def evaluate_mmb(curve, sheet, given):
    require_lengths(curve, sheet, given)
    points = Points(curve.displacement, curve.load, curve.path)
    chi = methods.chi(sheet["E1"], sheet["E2"], sheet["G13"])
    modulus = methods.mmb_modulus(points.compliance, chi, sheet)
    points.modulus = require_modulus(lambda one: methods.mmb_modulus(points.compliance, chi, one), points.compliance, sheet, curve, "mmb")
    marks = marked(curve, points, sheet, given, lambda compliance, one: methods.mmb_modulus(compliance, chi, one))
    if len(marks):
        points.add_visual(marks[np.flatnonzero(marks[:, 2] > sheet["notch"])[0]])
    points.place_cracks(sheet["notch"], marks)
    rows = marks if len(marks) else np.array([[p.displacement, p.load, p.crack] for p in points.points])

    def both(p, a):
        return methods.mixed_mode_bending(p, a, chi, modulus, sheet)

    one, two = both(rows[:, 1], rows[:, 2])
    numbers = {"chi": chi, "bending modulus": modulus, "mode II share": float(two[0] / (one[0] + two[0]))}
    return [Answer("beam theory with corrections", rows[:, 0], rows[:, 2], one + two, lambda d, p, a: sum(both(p, a)), numbers,
                   np.flatnonzero(marks[:, 2] > 1.0001 * sheet["notch"]) if len(marks) else ())], points


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


def earlier(given, curve):
    """True if an evaluation is there; that of another test is refused without --replace."""
    place = os.path.join(given.out, NAMES[0])
    if not os.path.lexists(place):
        return False
    before = {}
    with contextlib.suppress(Unreadable):
        before = read_json(place, MOST_RESULT)
    same = (before.get("test") == given.test and os.path.realpath(str(before.get("file"))) == os.path.realpath(curve.path)
            and before.get("specimen", given.specimen) == given.specimen)
    if before and not same and not given.replace:
        raise Trouble(f"{given.out} holds the evaluation of another test, {before.get('test')} of {before.get('file')}: --replace, or another --out")
    return True


def report(given, sheet, curve, answers, points, fitted):
    with loading():
        from specimens.pictures import draw
    table = at_points(answers, points, curve.path)
    complain_of_offsets({answer.name: answer.numbers for answer in answers}, sheet, points.modulus)
    complain_of_spread(table)
    complain_of_toughness(table, curve)
    for line in lines(table, answers, points, sheet):
        say(line)
    counted = said_of_marks(curve.marks, sheet["notch"]) if given.test != "enf" else ""
    if counted:
        say(counted)
    bands = compared(given.test, fitted, answers)
    replaced = earlier(given, curve)
    held = hold(given.out)
    claim(given.out, NAMES, False)
    about = {"test": given.test, "file": curve.path, "specimen": given.specimen, "sheet": {key: text for key, text in given.sheet.items() if text},
             "units": {"displacement": "m", "crack": "m", "load": "N", "compliance": "m/N", "modulus": "Pa", "toughness": "J/m2",
                       "numbers": {name: unit for answer in answers for name, unit in answer.units().items()}},
             "compliance": points.compliance, "modulus": points.modulus, "zero": points.zero, "noise": points.noise,
             "points": [vars(p) | {"crack": p.crack if p.crack == p.crack else None} for p in points.points],
             "toughness": table, "numbers": {answer.name: answer.numbers for answer in answers},
             "propagation": {answer.name: dict(zip(("mean", "deviation", "marks"), answer.propagation())) for answer in answers
                             if answer.propagation()},
             "fit": [{"key": row[0], "value": row[1], "interval": [end if end == end else None for end in row[2:]]}
                     for row in fitted]}
    write_file(os.path.join(given.out, "evaluate.json"), json.dumps(about, indent=1, allow_nan=False))
    rows = ["method,displacement (mm),crack (mm),toughness (J/m2)"]
    for answer in answers:
        rows += [f"{answer.name},{1e3 * w:.9g},{1e3 * a:.9g},{g:.9g}" for w, a, g in zip(answer.where, answer.crack, answer.rate)]
    write_file(os.path.join(given.out, "r-curve.csv"), "\n".join(rows) + "\n")
    draw(given.out, TITLES[given.test], curve, answers, points, bands)
    os.unlink(os.path.join(given.out, "study.lock"))
    held.close()
    say(f"wrote {given.out}: {', '.join(NAMES)}" + (", in the place of an earlier evaluation" if replaced else ""))


def main():
    given = given_words()
    sheet = sheet_of(given)
    given.machine = sheet.pop("compliance", 0.0)
    fitted = beside(given.beside, given.data[0]) if given.beside else []
    curve = Curve(given.data[0], given, given.marks)
    answers, points = TESTS[given.test](curve, sheet, given)
    report(given, sheet, curve, answers, points, fitted)
    return DONE


if __name__ == "__main__":
    run_study(main)
