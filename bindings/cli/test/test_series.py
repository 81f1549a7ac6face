# SPDX-License-Identifier: BSD-3-Clause
"""delam evaluate of a series: mean, standard deviation and coefficient of variation of specimens of beam theory with known
toughnesses, sheets that differ, specimens that fail or are left out, and whose folder it is."""
import csv
import json
import os

import numpy as np
from support import expect, expect_error, finish, folder, read, start

E1, B, H, A0 = 140e9, 0.025, 0.0015, 0.050
SHEET = ["--width", "25mm", "--arm", "1.5mm", "--notch", "50mm"]
TOUGH = (260.0, 280.0, 300.0, 270.0, 290.0)  # mean 280, standard deviation 15.81


def curve(toughness, width=B):
    """A DCB whose arms are clamped 4 mm behind the tip: displacement (mm), load (N), marks (mm)."""
    bending = E1 * width * H ** 3 / 12
    crack = np.concatenate([np.full(60, A0), np.linspace(A0, 0.09, 121)[1:]])
    load = np.sqrt(toughness * width * bending) / (crack + 0.004)
    load[:60] *= np.linspace(0, 1, 60)
    marks = np.where(np.arange(180) % 20 == 19, 1e3 * crack, np.nan)
    marks[:59] = np.nan
    return 1e3 * load * 2 * (crack + 0.004) ** 3 / (3 * bending), load, marks


def text_of(columns, name="", titles="Extension (mm),Load (N),Crack (mm)"):
    rows = [",".join("" if value != value else f"{value:.9g}" for value in row) for row in zip(*columns)]
    return "\n".join([f"Specimen,{name}" if name else "Operator,Lee", titles, *rows]) + "\n"


def written(here, name, text):
    path = os.path.join(here, name)
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    return path


def specimens(here, many=5):
    return [written(here, f"s{k + 1}.csv", text_of(curve(TOUGH[k]))) for k in range(many)]


def series(out):
    with open(os.path.join(out, "series.json"), encoding="utf-8") as file:
        return json.load(file)


def table(out):
    with open(os.path.join(out, "series.csv"), newline="", encoding="utf-8") as file:
        return {row["specimen"]: row for row in csv.DictReader(file)}


def files():
    """Five files: one row each, and their statistics, in the units of the titles."""
    here = folder()
    out = os.path.join(here, "out")
    code, shown, error = start("evaluate", "dcb", *specimens(here), *SHEET, "--out", out)
    expect(code == 0 and "at least 5" not in error and "5 of 5 specimens count" in shown, f"a series is evaluated: {shown} {error}")
    mean = series(out)["statistics"]["modified beam theory"]["propagation"]
    expect(mean["count"] == 5 and abs(mean["mean"] / 280 - 1) < 1e-3 and abs(mean["deviation"] / np.std(TOUGH, ddof=1) - 1) < 1e-2
           and abs(mean["variation"] / (mean["deviation"] / mean["mean"]) - 1) < 1e-9, f"mean and deviation: {mean}")
    half = 2.7764 * mean["deviation"] / np.sqrt(5)  # Student's t of 4 degrees of freedom
    expect(abs(mean["high"] - mean["mean"] - half) < 1e-3 * half, f"the interval of the mean: {mean}")
    rows = table(out)
    expect(list(rows) == ["s1", "s2", "s3", "s4", "s5", "mean", "standard deviation", "CV (%)", "count"], f"a row each: {list(rows)}")
    column = "modified beam theory: propagation (J/m2)"
    expect(all(abs(float(rows[f"s{k + 1}"][column]) / TOUGH[k] - 1) < 1e-3 for k in range(5)) and float(rows["mean"]["width (mm)"]) == 25
           and abs(float(rows["CV (%)"][column]) - 100 * mean["variation"]) < 1e-5, "the table has values and units")
    expect(shown.count("\ns1 ") == 1 and "standard deviation" in shown and "CV (%)" in shown, f"and the terminal: {shown}")
    with open(os.path.join(out, "r-curves.csv"), newline="", encoding="utf-8") as file:
        curves = list(csv.DictReader(file))
    expect({row["specimen"] for row in curves} == {f"s{k + 1}" for k in range(5)}, "all R-curves are kept")
    expect(read(os.path.join(out, "series.png"))[:4] == b"\x89PNG" and not os.path.exists(os.path.join(out, "study.lock")), "a picture, no lock")
    own = series(out)["specimens"][1]
    expect(own["name"] == "s2" and own["units"]["toughness"] == "J/m2" and own["counted"] and "intervals" in own, "and each specimen as if alone")


def one_file():
    """All tests of a file, or some of them."""
    here = folder()
    path = written(here, "plate.csv", "\n".join(text_of(curve(tough), f"P-{k + 1}") for k, tough in enumerate(TOUGH)))
    out = os.path.join(here, "out")
    code, shown, error = start("evaluate", "dcb", path, *SHEET, "--specimen", "all", "--out", out)
    names = [one["name"] for one in series(out)["specimens"]]
    expect(code == 0 and names == [f"P-{k + 1}" for k in range(5)], f"all tests of a file: {names} {shown} {error}")
    code, shown, error = start("evaluate", "dcb", path, *SHEET, "--specimen", "P-2", "--specimen", "3", "--out", out, "--replace")
    expect(code == 0 and [one["name"] for one in series(out)["specimens"]] == ["P-2", "plate 3"], f"two of them: {shown} {error}")
    expect(error.count("2 specimens count: ISO 15024 and ASTM D5528 ask for at least 5") == 1, f"fewer than five are told once: {error}")
    code, shown, error = start("evaluate", "dcb", path, *SHEET, "--specimen", "P-2", "--out", os.path.join(here, "one"))
    expect(code == 0 and os.path.exists(os.path.join(here, "one", "evaluate.json")), f"one of them is no series: {shown} {error}")
    expect_error(start("evaluate", "dcb", path, path, *SHEET, "--specimen", "P-2", "--out", out), 2, "is given twice with the specimen \"P-2\"")


def sheets():
    """A table of sheets: what it says of a specimen counts, and what differs is told."""
    here = folder()
    paths = specimens(here, 4) + [written(here, "s5.csv", text_of(curve(TOUGH[4], 0.020)))]
    out = os.path.join(here, "out")
    wide = written(here, "sheets.csv", "Specimen;Width (mm);Thickness [mm];Operator\ns5;20,0;3,0;Lee\ns1;;3;Kim\n")
    code, shown, error = start("evaluate", "dcb", *paths, *SHEET, "--sheets", wide, "--out", out)
    last = series(out)["specimens"][4]
    expect(code == 0 and abs(last["propagation"]["modified beam theory"]["mean"] / TOUGH[4] - 1) < 1e-3 and last["sheet"]["width"] == "20.0mm",
           f"the width of a specimen: {last['sheet']} {error}")
    expect("--width differs: 20 mm (s5), where most have 25 mm" in error and 'not taken: "Operator"' in shown, f"is told: {shown} {error}")
    other = written(here, "moduli.csv", "Specimen,E1,E2,G13\ns2,120GPa,9GPa,5GPa\n")
    code, shown, error = start("evaluate", "dcb", *paths[:4], *SHEET, "--E1", "130GPa", "--E2", "9GPa", "--G13", "5GPa", "--sheets", other,
                               "--out", out, "--replace")
    expect(code == 0 and "--E1 differs: 130 GPa (s1, s3, s4); 120 GPa (s2): one series has one material" in error
           and any("--E1 differs" in text for text in series(out)["warnings"]), f"what must agree: {error}")
    for text, wanted in (("Specimen,width\ns9,25mm\n", 'line 2: there is no specimen "s9"; there are: s1, s2'), ("", "the file is empty"),
                         ("Probe,Breite\n", 'titles are expected, each once: "Specimen"'), ("Specimen,width\ns1,2mm\ns1,3mm\n", "lines 2, 3 are of one"),
                         ("Specimen,width\n,2mm\n", "line 2 names no specimen")):
        expect_error(start("evaluate", "dcb", *paths[:2], *SHEET, "--sheets", written(here, "wrong.csv", text), "--out", out), 2, wanted)
    marks = np.flatnonzero(np.isfinite(curve(1.0)[2]))
    for k in range(2):
        x, y, a = curve(TOUGH[k])
        written(here, f"plain{k}.csv", text_of((x, y), titles="Extension (mm),Load (N)"))
        written(here, f"marks{k}.csv", text_of((x[marks], a[marks]), titles="Extension (mm),Crack (mm)"))
    apart = written(here, "apart.csv", "file,marks\nplain0.csv,marks0.csv\nplain1,marks1.csv\n")
    code, shown, error = start("evaluate", "dcb", *(os.path.join(here, f"plain{k}.csv") for k in range(2)), *SHEET, "--sheets", apart, "--out", out,
                               "--replace")
    found = [one["propagation"]["modified beam theory"]["mean"] for one in series(out)["specimens"]]
    expect(code == 0 and np.allclose(found, TOUGH[:2], rtol=1e-3), f"crack lengths apart, for each: {found} {error}")


def failing():
    """A specimen in the middle that cannot be evaluated: all others are, it is named, and the exit code says it."""
    here = folder()
    paths = specimens(here, 4)
    empty = written(here, "empty.csv", "")
    out = os.path.join(here, "out")
    bad = written(here, "sheets.csv", "Specimen,width\ns2,25\n")
    code, shown, error = start("evaluate", "dcb", *paths[:2], empty, *paths[2:], *SHEET, "--sheets", bad, "--out", out)
    expect(code == 1 and "empty is not evaluated: " in error and "the file is empty" in error and "s2 is not evaluated: --width 25: a number > 0"
           in error and "not evaluated: s2, empty" in shown, f"the failed are named: {code} {shown} {error}")
    found = series(out)
    expect([one["counted"] for one in found["specimens"]] == [True, False, False, True, True]
           and found["statistics"]["modified beam theory"]["max"]["count"] == 3 and "empty" in found["specimens"][2]["message"],
           "the others count, and the table says why one does not")
    expect(table(out)["empty"]["counted"] == "no" and "the file is empty" in table(out)["empty"]["message"], f"{table(out)['empty']}")
    expect_error(start("evaluate", "dcb", empty, "/nowhere.csv", *SHEET, "--out", os.path.join(here, "none")), 2, "no specimen is evaluated")
    expect(not os.path.exists(os.path.join(here, "none")), "and nothing is written")


def outliers():
    """An outlier is told and counts; what is left out is named, and its row stays."""
    here = folder()
    paths = specimens(here) + [written(here, "s6.csv", text_of(curve(600.0)))]
    out = os.path.join(here, "out")
    code, shown, error = start("evaluate", "dcb", *paths, *SHEET, "--out", out)
    expect(code == 0 and "s6 is an outlier by Grubbs' test at 95 %" in error and "--leave-out s6 leaves it out" in error
           and series(out)["statistics"]["modified beam theory"]["max"]["count"] == 6, f"an outlier counts: {error}")
    code, shown, error = start("evaluate", "dcb", *paths, *SHEET, "--leave-out", "s6", "--out", out)
    mean = series(out)["statistics"]["modified beam theory"]["propagation"]
    expect(code == 0 and mean["count"] == 5 and abs(mean["mean"] / 280 - 1) < 1e-3 and "s6 (left out)" in shown
           and "5 of 6 specimens count; left out (--leave-out): s6" in shown and "outlier" not in error, f"left out: {mean} {shown} {error}")
    expect(table(out)["s6"]["counted"] == "no" and float(table(out)["s6"]["modified beam theory: max (J/m2)"]) > 500, "its row stays")
    expect_error(start("evaluate", "dcb", *paths, *SHEET, "--leave-out", "s7", "--out", out), 2, "--leave-out s7: the name of one specimen is expected: s1, ")
    code, _, error = start("evaluate", "dcb", *paths[:2], written(here, "copy.csv", read(paths[1]).decode()), *SHEET, "--out", out, "--replace")
    expect(code == 0 and "copy has the same curve as s2: is one file a copy of the other?" in error, f"a copy is told: {error}")
    code, shown, error = start("evaluate", "dcb", paths[0], *SHEET, "--specimen", "all", "--out", out, "--replace")
    only = series(out)["statistics"]["modified beam theory"]["max"]
    expect(code == 0 and "one has no standard deviation" in error and only["count"] == 1 and only["deviation"] is None and only["low"] is None,
           f"one specimen alone: {only} {error}")


def folders():
    """Whose folder it is, and options that are of one specimen."""
    here = folder()
    paths, out = specimens(here, 3), os.path.join(here, "out")
    code, _, error = start("evaluate", "dcb", *paths[:2], *SHEET, "--out", out)
    expect(code == 0, error)
    expect_error(start("evaluate", "dcb", *paths, *SHEET, "--out", out), 2, "holds the evaluation of another series, dcb of 2 files: --replace")
    expect_error(start("evaluate", "dcb", paths[0], *SHEET, "--out", out), 2, "holds the evaluation of a series: --replace")
    code, shown, error = start("evaluate", "dcb", paths[0], *SHEET, "--out", out, "--replace")
    expect(code == 0 and sorted(name for name in os.listdir(out) if name[0] != ".") == ["evaluate.json", "evaluate.png", "r-curve.csv"],
           f"one in the place of a series leaves nothing of it: {os.listdir(out)} {error}")
    expect_error(start("evaluate", "dcb", *paths, *SHEET, "--out", out), 2, "holds the evaluation of one specimen: --replace")
    for option, value, wanted in (("--marks", paths[2], "--marks is of one specimen"), ("--beside", here, "--beside is of one specimen"),
                                  ("--calibration", "20mm=a.csv", "--calibration is of one specimen")):
        expect_error(start("evaluate", "dcb", *paths[:2], *SHEET, option, value, "--out", out), 2, wanted)
    mine = os.path.join(here, "mine")
    os.mkdir(mine)
    written(mine, "series.csv", "mine")
    expect(start("evaluate", "dcb", *paths, *SHEET, "--out", mine)[0] == 3 and read(os.path.join(mine, "series.csv")) == b"mine", "foreign files stay")


def flexure():
    """ENF: each specimen has its own calibration files, named in the table of sheets."""
    here, half, width, arm = folder(), 0.05, 0.025, 0.002
    for k, tough in enumerate((700.0, 760.0)):
        for a in (0.02, 0.03, 0.04):
            compliance = (3 * a ** 3 + 2 * half ** 3) / (8 * width * arm ** 3 * E1)
            load = np.linspace(0, np.sqrt(tough * 16 * width ** 2 * arm ** 3 * E1 / 9) / a, 80)
            written(here, f"e{k}-{1e3 * a:.0f}.csv", text_of((1e3 * compliance * load, load), titles="Deflection (mm),Load (N)"))
    calibrations = "\n".join(f"e{k}-30,20mm=e{k}-20.csv 40mm=e{k}-40.csv" for k in range(2))
    table_of_sheets = written(here, "sheets.csv", f"specimen,calibration\n{calibrations}\n")
    out = os.path.join(here, "out")
    code, shown, error = start("evaluate", "enf", *(os.path.join(here, f"e{k}-30.csv") for k in range(2)), "--width", "25mm", "--arm", "2mm",
                               "--notch", "30mm", "--span", "100mm", "--sheets", table_of_sheets, "--out", out)
    mean = series(out)["statistics"]["compliance calibration"]["max"]
    expect(code == 0 and mean["count"] == 2 and abs(mean["mean"] / 730 - 1) < 1e-3 and "ASTM D7905 ask" in error, f"ENF: {mean} {shown} {error}")


files()
one_file()
sheets()
failing()
outliers()
folders()
flexure()
finish()
