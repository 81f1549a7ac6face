# SPDX-License-Identifier: BSD-3-Clause
"""Intervals of delam evaluate: of specimens with noise and crack lengths that are misread, made of beam theory with fixed seeds,
90 to 98 of 100 intervals at 95 % have the truth. `whole`: of all tests; `coverage`: prints, for all methods and points, how
many do and how far values are off."""
import contextlib
import io
import math
import os
import sys
import types

import numpy as np
from support import expect, finish, folder

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "study"))
import command  # noqa: E402
from evaluation import Evaluation  # noqa: E402
from measured.chance import student  # noqa: E402
from scatter.intervals import MEAN, interval_of  # noqa: E402
from scatter.spread import OfSlope, Source  # noqa: E402

E1, E2, G13, B = 140e3, 10e3, 5e3, 25.0  # MPa, mm
GAMMA = 1.18 * math.sqrt(E1 * E2) / G13
CHI = math.sqrt(E1 / (11 * G13) * (3 - 2 * (GAMMA / (1 + GAMMA)) ** 2))
MODULI = {"width": "25mm", "E1": "140GPa", "E2": "10GPa", "G13": "5GPa"}
SPECIMENS, FEWEST, MOST = 100, 90, 98


def written(path, title, rows):
    with open(path, "w", encoding="utf-8") as file:
        file.write(title + "\n")
        for row in rows:
            file.write(",".join("" if value is None else f"{value:.7g}" for value in row) + "\n")
    return path


def curve(random, grown, first, noise, misread, every):
    """A rise to the crack of the notch and 20 mm of growth; marks every so many tenths of a millimetre."""
    opening, peak = grown(first)
    rows = [(opening * k / 120, peak * k / 120, None) for k in range(120)]
    rows += [(*grown(first + 0.1 * k), first + 0.1 * k + random.normal(0, misread) if k % every == 1 else None) for k in range(201)]
    return [(d, p + random.normal(0, noise) * peak, a) for d, p, a in rows]


def dcb(here, random):
    """Of 250 J/m2, read to half a millimetre, with noise of 0.2 % of the largest load."""
    h = 1.5

    def grown(a):
        load = B * math.sqrt(0.25 * h ** 3 * E1 / 12) / (a + CHI * h)
        return 8 * load * (a + CHI * h) ** 3 / (B * h ** 3 * E1), load

    path = written(os.path.join(here, "dcb.csv"), "Extension (mm),Load (N),Crack (mm)", curve(random, grown, 50.0, 0.002, 0.5, 30))
    return evaluated("dcb", path, {"arm": "1.5mm", "notch": "50mm"}), 250.0


def enf(here, random):
    """Of 750 J/m2, with noise of 0.3 %, and calibrations at lengths that are 0.3 mm off."""
    h, half, longer = 2.0, 50.0, 0.42 * 2.0 * CHI

    def grown(a):
        load = B * math.sqrt(0.75 * 16 * h ** 3 * E1 / 9) / (a + longer)
        return load * ((2 * half ** 3 + 3 * (a + longer) ** 3) / (8 * B * h ** 3 * E1) + 0.3 * half / (B * h * G13)), load

    files = []
    for name, a, part in (("a30", 30.0, 1.0), ("a20", 20 + random.normal(0, 0.3), 0.5), ("a40", 40 + random.normal(0, 0.3), 0.5)):
        deflection, peak = grown(a)
        rows = [(part * deflection * k / 200, part * peak * k / 200) for k in range(201)]
        rows += [row for row in (grown(a + 0.1 * k) for k in range(150)) if part == 1 and row[0] > deflection]
        files.append(written(os.path.join(here, name + ".csv"), "Deflection (mm),Load (N)",
                             [(d, p + random.normal(0, 0.003) * peak) for d, p in rows]))
    return evaluated("enf", files[0], {"arm": "2mm", "notch": "30mm", "half-span": "50mm"},
                     calibration=[f"20mm={files[1]}", f"40mm={files[2]}"]), 750.0


def mmb(here, random, sheared=0.0):
    """Of 370 J/m2 in both modes together, by the formulae of the standard. sheared: 1 for a beam that also shears."""
    h, half, lever = 2.0, 50.0, 41.3
    shear = sheared * ((lever + half) / half) ** 2 * 0.3 * half / (B * h * G13)

    def grown(a):
        one, two = (3 * lever - half) ** 2 * (a + CHI * h) ** 2, (lever + half) ** 2 * (a + 0.42 * CHI * h) ** 2
        load = math.sqrt(0.37 * 16 * B ** 2 * h ** 3 * half ** 2 * E1 / (12 * one + 9 * two))
        bent = 8 * one * (a + CHI * h) + 6 * two * (a + 0.42 * CHI * h) + 4 * half ** 3 * (lever + half) ** 2
        return load * (bent / (16 * half ** 2 * B * h ** 3 * E1) + shear), load

    path = written(os.path.join(here, "mmb.csv"), "Extension (mm),Load (N),Crack (mm)", curve(random, grown, 30.0, 0.005, 0.5, 25))
    return evaluated("mmb", path, {"arm": "2mm", "notch": "30mm", "half-span": "50mm", "lever": "41.3mm"}), 370.0


def mmb_sheared(here, random):
    return mmb(here, random, 1.0)


def evaluated(test, path, sheet, **options):
    given = types.SimpleNamespace(**{"columns": [], "units": [], "crack": "", "marks": "", "specimen": [], "calibration": [],
                                     "confidence": 0.95, **options, "test": test, "data": [path], "sheet": {**MODULI, **sheet}})
    with contextlib.redirect_stdout(io.StringIO()), command.overheard():
        return Evaluation(given)


def coverage(make):
    """By method and point: how many intervals have the truth, how many there are, values over the truth, half widths over
    it."""
    here, found = folder(), {}
    for seed in range(SPECIMENS):
        one, truth = make(here, np.random.default_rng(seed))
        for method, rows in one.intervals.items():
            for point, interval in rows.items():
                row = found.setdefault((method, point), [0, 0, [], []])
                row[2].append(one.values()[method][point] / truth)
                if interval.low is not None:
                    row[0] += interval.low <= truth <= interval.high
                    row[1] += 1
                    row[3].append(0.5 * (interval.high - interval.low) / truth)
    return found


ASKED = {dcb: [(method, point) for method in ("modified beam theory", "compliance calibration", "modified compliance calibration")
               for point in ("visual", "5 %", "max", MEAN)] + [("effective crack", "max")],
         enf: [("compliance calibration", "max")], mmb: [("beam theory with corrections", MEAN)],
         mmb_sheared: [("effective crack", "max")]}


def covered(make):
    found = coverage(make)
    for key in ASKED[make]:
        within, told, _, _ = found[key]
        expect(told == SPECIMENS and FEWEST <= within <= MOST, f"{make.__name__}, {', '.join(key)}: {within} of {told} intervals have the truth")


def formulae():
    """Quantiles, and how sources come together."""
    for level, freedom, wanted in ((0.95, 1, 12.706), (0.95, 5, 2.571), (0.99, 10, 3.169), (0.95, 1e9, 1.960)):  # tables of Student's t
        expect(abs(student(level, freedom) - wanted) < 1e-3, f"Student's t, {level}, {freedom:g}: {student(level, freedom)}")
    both = interval_of(100.0, [Source("a", 1.0, 5), Source("b", 4.0, 10)], 0.95)
    half = math.sqrt(2.5706 ** 2 + 4 * 2.2281 ** 2)
    expect(abs(both.high - 100 - half) < 1e-3 and abs(100 - both.low - half) < 1e-3, f"half widths add up as squares: {both}")
    none = interval_of(100.0, [], 0.95)
    expect(none.low is None and "neither noise" in none.why, f"without sources there is none: {none}")
    wide = interval_of(100.0, OfSlope(0.1, 3).at(None, 100.0), 0.95)
    expect(wide.low is None and "more than the value itself" in wide.why, f"nor where it is wider than the value: {wide}")
    expect(not OfSlope(0.1, 2).at(None, 100.0), "two lengths leave no degree of freedom")


if sys.argv[1:] == ["coverage"]:
    for test in (dcb, enf, mmb, mmb_sheared):
        for (name, place), (within_it, count, values, halves) in coverage(test).items():
            print(f"{test.__name__}, {name}, {place}: {within_it} of {count}; values off by {100 * (np.mean(values) - 1):+.2f} %, deviation "
                  f"{100 * np.std(values):.2f} %, half width {100 * np.median(halves):.2f} %")
else:
    formulae()
    for test in (dcb, enf, mmb, mmb_sheared) if sys.argv[1:] == ["whole"] else (dcb, ):
        covered(test)
    finish()
