#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Toughnesses by the standards: `delam evaluate dcb | enf | mmb FILE --width 25mm --arm 1.5mm --notch 50mm .. --out DIR`.

Reads the raw file of a test machine as `delam fit` does. Writes DIR/evaluate.json, DIR/r-curve.csv and
DIR/evaluate.png; the lines say the toughness of each method at each point, beside that of a fit (--beside).
"""
import json
import os

import command

if __name__ == "__main__":
    command.begin("delam: evaluate")

from packages import require  # noqa: E402

require("numpy", "matplotlib")

import numpy as np  # noqa: E402

from _pictures.input_file import MOST_RESULT, read_json  # noqa: E402
from command import complain, loading, say  # noqa: E402
from marches import DONE, Trouble, given_words, hold, run_study  # noqa: E402
from measured.columns import choose, found, label, named  # noqa: E402
from measured.loops import Way  # noqa: E402
from measured.table_file import read_table  # noqa: E402
from measured.units import kind_of, quantity  # noqa: E402
from own_files import claim, write_file  # noqa: E402
from specimens import methods  # noqa: E402
from specimens.points import Point, initial_line, standard_points  # noqa: E402

SHEET = {"width": "length", "arm": "length", "notch": "length", "span": "length", "lever": "length", "E1": "stress",
         "E2": "stress", "G13": "stress"}
NEEDED = {"dcb": ("width", "arm", "notch"), "enf": ("width", "arm", "notch", "span"),
          "mmb": ("width", "arm", "notch", "span", "lever", "E1", "E2", "G13")}
LEAST_MARKS = 3  # crack lengths for a line through their compliances; ISO 15024 asks for more


def sheet_of(given):
    """The specimen in SI."""
    sheet = {}
    for key, kind in SHEET.items():
        text = given.sheet.get(key, "")
        if not text:
            continue
        read = quantity(text, kind)
        if read is None or not read[1] or not read[0] > 0:
            example = {"length": "25mm", "stress": "140GPa"}[kind]
            raise Trouble(f"--{key} {text[:60]}: a number > 0 with its unit is expected, such as {example}")
        sheet[key] = read[0] * kind_of(read[1])[1]
    missing = [f"--{key}" for key in NEEDED[given.test] if key not in sheet]
    if missing:
        raise Trouble(f"{given.test} needs {', '.join(missing)}")
    if "span" in sheet and not sheet["notch"] < 0.5 * sheet["span"]:
        raise Trouble(f"--notch {given.sheet['notch']}: less than half of the span {given.sheet['span']} is expected")
    return sheet


class Curve:
    """Displacement and load in SI along the way of the test without its unloadings, and the marks of the crack."""

    def __init__(self, path, given):
        table = read_table(path)
        x, y = choose(table, given.columns)
        said = [f"displacement is {label(table, x)}, load is {label(table, y)}", *table.said]
        units = [self._unit(table, k, option, kind) for k, option, kind in
                 zip((x, y), given.units or ["", ""], ("length", "force"))]
        columns = [np.abs(table.columns[k]) * size for k, size in zip((x, y), units)]
        there = np.isfinite(columns[0]) & np.isfinite(columns[1])
        if there.sum() < 5:
            raise Trouble(f"{path}: {int(there.sum())} points with displacement and load: at least 5 are expected")
        way = Way(columns[0][there], columns[1][there], False)
        if way.loops:
            said.append(f"{len(way.loops)} unloadings cut")
        if way.averaged:
            said.append(f"x jitters: {int(there.sum())} points are averaged to {len(way.x)}")
        self.path, self.displacement, self.load = path, way.x, way.y
        self.marks = self._marks(table, given, columns, there, said)
        say(f"{path}: {'; '.join(said)}")

    @staticmethod
    def _unit(table, k, option, kind):
        text = option or table.units[k]
        if not text:
            raise Trouble(f"{table.path}: {label(table, k)} has no unit: --units mm N names those of displacement and load")
        if kind_of(text)[0] != kind:
            raise Trouble(f"{table.path}: {label(table, k)}: {text[:60]} is no unit of {kind}")
        return kind_of(text)[1]

    @staticmethod
    def _marks(table, given, columns, there, said):
        """Displacement, load and crack length of the rows that have one; one for each length."""
        which = [named(table, given.crack)] if given.crack else found(table, "crack")[:1]
        if not which:
            return np.zeros((0, 3))
        k = which[0]
        unit = table.units[k] or (given.units or table.units)[0]
        if kind_of(unit)[0] != "length":
            raise Trouble(f"{table.path}: {label(table, k)} has no unit of length: \"Crack (mm)\", for example")
        crack = table.columns[k] * kind_of(unit)[1]
        rows = np.flatnonzero(there & np.isfinite(crack) & (crack > 0) & (columns[1] > 0))
        rows = rows[np.concatenate([[True], np.diff(crack[rows]) > 0])] if rows.size else rows
        said.append(f"crack is {label(table, k)} at {len(rows)} points")
        return np.array([columns[0][rows], columns[1][rows], crack[rows]]).T


def evaluate_dcb(curve, sheet, _):
    """Each method: lengths of the crack, rates, and numbers of it; and the points."""
    first, zero, points = standard_points(curve.displacement, curve.load, curve.path)
    out = {}
    after = curve.displacement >= points[0].displacement
    crack, rate = methods.dcb_effective(curve.displacement[after] - zero, curve.load[after], first, sheet)
    out["effective crack"] = (crack, rate, {}, curve.displacement[after])
    marks = curve.marks
    if len(marks) >= LEAST_MARKS:
        grown = np.flatnonzero(marks[:, 2] > 1.0001 * sheet["notch"])
        if grown.size:
            points.insert(0, Point("visual", -1, *map(float, marks[grown[0]])))
        for name, method in (("corrected beam theory", methods.corrected_beam_theory),
                             ("modified beam theory", methods.modified_beam_theory),
                             ("compliance calibration", methods.compliance_calibration),
                             ("modified compliance calibration", methods.modified_compliance_calibration)):
            rate, numbers = method(marks[:, 0] - zero, marks[:, 1], marks[:, 2], sheet)
            out[name] = (marks[:, 2], rate, numbers, marks[:, 0])
    else:
        complain(f"warning: {curve.path}: {len(marks)} crack lengths: at least {LEAST_MARKS} are needed for beam theory with a "
                 "corrected crack and for calibrations; the crack is taken from the compliance")
    return out, points, first


def evaluate_enf(curve, sheet, given):
    first, zero, points = standard_points(curve.displacement, curve.load, curve.path)
    upto = curve.displacement >= points[0].displacement
    crack, rate = methods.enf_effective(curve.displacement[upto] - zero, curve.load[upto], first, sheet)
    out = {"effective crack": (crack, rate, {}, curve.displacement[upto])}
    cracks, compliances = [sheet["notch"]], [first]
    for word in given.calibration:
        length, sign, path = word.partition("=")
        read = quantity(length, "length")
        if read is None or not read[1] or not sign:
            raise Trouble(f"--calibration {word[:60]}: LENGTH=FILE is expected, such as 20mm=a20.csv")
        other = Curve(path, given)
        cracks.append(read[0] * kind_of(read[1])[1])
        compliances.append(initial_line(other.displacement, other.load, path)[0])
    if len(cracks) >= LEAST_MARKS:
        intercept, m = methods.enf_calibration(cracks, compliances)
        out["compliance calibration"] = (np.full(len(curve.load), sheet["notch"]), methods.enf_calibrated(curve.load, m, sheet),
                                         {"A": intercept, "m": m}, curve.displacement)
    else:
        complain(f"warning: compliance calibration of ASTM D7905 needs --calibration LENGTH=FILE for two more crack lengths; "
                 f"{len(cracks) - 1} given")
    return out, points, first


def evaluate_mmb(curve, sheet, _):
    first, _, points = standard_points(curve.displacement, curve.load, curve.path)
    chi = methods.crack_correction(sheet)
    modulus = methods.mmb_modulus(first, chi, sheet)
    marks = curve.marks if len(curve.marks) else np.array([[p.displacement, p.load, sheet["notch"]] for p in points])
    one, two = methods.mixed_mode_bending(marks[:, 1], marks[:, 2], chi, modulus, sheet)
    numbers = {"chi": chi, "bending modulus": modulus, "mode II share": float(two[0] / (one[0] + two[0]))}
    return {"beam theory with corrections": (marks[:, 2], one + two, numbers, marks[:, 0])}, points, first


TESTS = {"dcb": evaluate_dcb, "enf": evaluate_enf, "mmb": evaluate_mmb}


def at_points(answers, points):
    """The toughness of each method at each point: between the places where the method has one, straight lines; before
    the first of them and behind the last, none."""
    table = {}
    for name, (_, rate, _, where) in answers.items():
        order = np.argsort(where, kind="stable")
        table[name] = {}
        for point in points:
            inside = where[order[0]] <= point.displacement * (1 + 1e-9) and point.displacement <= where[order[-1]] * (1 + 1e-9)
            table[name][point.name] = float(np.interp(point.displacement, where[order], rate[order])) if inside else None
    return table


def beside(folder):
    """Toughnesses of a fit in J/m2: key, value, ends of the interval; those of which it knows the units."""
    about = read_json(os.path.join(folder, "fit.json"), MOST_RESULT)
    sizes = [kind_of(unit) for unit in about.get("units", ["", ""])]
    if [kind for kind, _ in sizes] != ["length", "force"]:
        complain(f"warning: {folder}: its scene names no units of length and force: it cannot stand beside")
        return []
    factor = sizes[1][1] / sizes[0][1]
    return [(row["key"], row["value"] * factor, *(end * factor if end is not None else float("nan") for end in row["interval"]))
            for row in about["parameters"] if row["key"].endswith("toughness") and row.get("told", True)]


def report(given, curve, answers, points, first, fitted):
    with loading():
        from specimens.pictures import draw
    table = at_points(answers, points)
    for name, (_, _, numbers, _) in answers.items():
        said = ", ".join(f"{point} {rate:.4g}" for point, rate in table[name].items() if rate is not None)
        more = ", ".join(f"{key} {value:.4g}" for key, value in numbers.items())
        say(f"{name}: {said or 'no point'} J/m2" + (f" ({more})" if more else ""))
    for key, value, low, high in fitted:
        say(f"delam fit: {key} {value:.4g} J/m2, interval {low:.4g} to {high:.4g}")
    about = {"test": given.test, "file": curve.path, "sheet": given.sheet, "compliance": first,
             "points": [vars(point) | {"crack": point.crack if point.crack == point.crack else None} for point in points],
             "toughness": table, "numbers": {name: answer[2] for name, answer in answers.items()},
             "fit": [{"key": row[0], "value": row[1], "interval": [end if end == end else None for end in row[2:]]}
                     for row in fitted]}
    write_file(os.path.join(given.out, "evaluate.json"), json.dumps(about, indent=1, allow_nan=False))
    lines = ["method,displacement,crack,toughness"]
    for name, (crack, rate, _, where) in answers.items():
        lines += [f"{name},{w!r},{a!r},{g!r}" for w, a, g in zip(*(np.asarray(part, dtype=float).tolist() for part in (where, crack, rate)))]
    write_file(os.path.join(given.out, "r-curve.csv"), "\n".join(lines) + "\n")
    draw(given.out, curve, answers, points, fitted)
    say(f"wrote {given.out}: evaluate.json, r-curve.csv (m, J/m2), evaluate.png")


def main():
    given = given_words()
    sheet = sheet_of(given)
    curve = Curve(given.data[0], given)
    answers, points, first = TESTS[given.test](curve, sheet, given)
    fitted = beside(given.beside) if given.beside else []
    held = hold(given.out)
    claim(given.out, ["evaluate.json", "r-curve.csv", "evaluate.png"], False)
    report(given, curve, answers, points, first, fitted)
    held.close()
    return DONE


if __name__ == "__main__":
    run_study(main)
