# SPDX-License-Identifier: BSD-3-Clause
"""delam evaluate: toughnesses by the standards from raw files that beam theory has written, with points, R-curves,
calibrations, and the words for what is missing."""
import csv
import json
import os

import numpy as np
from support import expect, expect_error, finish, folder, read, start

E1, E2, G13 = 140e9, 9e9, 5e9
B, H, A0, TOUGH = 0.025, 0.0015, 0.050, 280.0


def raw(path, titles, columns):
    with open(path, "w", encoding="utf-8") as file:
        file.write("Operator,Lee\n" + ",".join(titles) + "\n")
        for row in zip(*columns):
            file.write(",".join("" if value != value else f"{value:.9g}" for value in row) + "\n")
    return path


def opened(offset):
    """A DCB whose arms are clamped an offset behind the tip: until it grows, and then at one rate. In mm and N."""
    bending = E1 * B * H ** 3 / 12
    crack = np.concatenate([np.full(60, A0), np.linspace(A0, 0.09, 121)[1:]])
    load = np.sqrt(TOUGH * B * bending) / (crack + offset)
    load[:60] *= np.linspace(0, 1, 60)
    marks = np.where(np.arange(180) % 20 == 19, 1e3 * crack, np.nan)
    marks[:59] = np.nan
    return 1e3 * load * 2 * (crack + offset) ** 3 / (3 * bending), load, marks


def evaluated(out):
    with open(os.path.join(out, "evaluate.json"), encoding="utf-8") as file:
        return json.load(file)


def opening():
    here = folder()
    path, out = os.path.join(here, "dcb.csv"), os.path.join(here, "out")
    x, y, marks = opened(0.004)
    words = ["evaluate", "dcb", raw(path, ["Extension (mm)", "Load (N)", "Crack (mm)"], (x, y, marks)), "--width", "25mm",
             "--arm", "1.5mm", "--notch", "50mm"]
    code, shown, error = start(*words, "--out", out)
    expect(code == 0 and 'displacement is "Extension" in mm' in shown and 'crack is "Crack" in mm at 7 points' in shown,
           f"a DCB is evaluated: {shown} {error}")
    about = evaluated(out)
    for name, within in (("modified beam theory", 1e-4), ("modified compliance calibration", 0.02), ("compliance calibration", 0.02),
                         ("corrected beam theory", 0.06)):
        value = about["toughness"][name]["visual"]
        expect(abs(value / TOUGH - 1) < within, f"{name}: {value} J/m2, {TOUGH} are given")
    expect(abs(about["numbers"]["modified beam theory"]["offset"] - 0.004) < 1e-5, "the offset of the crack is found")
    large = about["toughness"]["corrected beam theory"]["visual"]
    expect(large < about["toughness"]["modified beam theory"]["visual"], f"F takes off what large displacements do: {large}")
    names = [point["name"] for point in about["points"]]
    expect(names[0] == "visual" and names[1].startswith("5 %") and names[2] == "max", f"points: {names}")
    peak = next(point for point in about["points"] if point["name"] == "max")
    expect(abs(peak["load"] - y.max()) < 1e-6 and abs(about["compliance"] / (1e-3 * x[59] / y[59]) - 1) < 1e-3, "load, compliance")
    with open(os.path.join(out, "r-curve.csv"), newline="", encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row["method"] == "modified beam theory"]
    expect(len(rows) == 7 and all(abs(float(row["toughness"]) / TOUGH - 1) < 1e-3 for row in rows), "the R-curve is flat")
    expect(read(os.path.join(out, "evaluate.png"))[:4] == b"\x89PNG", "a picture")
    # Without marks: of E1, the crack that the compliance has, its offset included.
    raw(path, ["Extension (mm)", "Load (N)"], (x, y))
    code, shown, error = start(*words, "--E1", "140GPa", "--out", out)
    value = evaluated(out)["toughness"]["effective crack"]["max"]
    expect(code == 0 and "0 crack lengths: at least 3" in error and abs(value / TOUGH - 1) < 1e-3, f"without marks: {value} {error}")
    # Beside a fit, in its units.
    with open(os.path.join(here, "fit.json"), "w", encoding="utf-8") as file:
        json.dump({"units": ["mm", "N"], "parameters": [
            {"key": "laws[0].normal_toughness", "value": 0.28, "interval": [0.27, 0.29], "told": True},
            {"key": "laws[0].normal_strength", "value": 30.0, "interval": [None, None], "told": False}]}, file)
    code, shown, error = start(*words, "--beside", here, "--out", out)
    expect(code == 0 and "delam fit: laws[0].normal_toughness 280 J/m2, interval 270 to 290" in shown and "strength" not in shown,
           f"a fit beside it: {shown} {error}")


def bent(a, half):
    """End-notched flexure, loaded until the crack of this length grows."""
    compliance = (3 * a ** 3 + 2 * half ** 3) / (8 * B * H ** 3 * E1)
    peak = np.sqrt(700.0 * 16 * B ** 2 * H ** 3 * E1 / 9) / a
    load = np.linspace(0, peak, 80)
    return 1e3 * compliance * load, load


def flexure():
    here = folder()
    files = {}
    for a in (0.02, 0.03, 0.04):
        files[a] = raw(os.path.join(here, f"{a}.csv"), ["Deflection (mm)", "Load (kN)"], (bent(a, 0.05)[0], bent(a, 0.05)[1] / 1e3))
    out = os.path.join(here, "out")
    words = ["evaluate", "enf", files[0.03], "--width", "25mm", "--arm", "1.5mm", "--notch", "30mm", "--span", "10cm"]
    code, shown, error = start(*words, "--calibration", f"20mm={files[0.02]}", "--calibration", f"40mm={files[0.04]}", "--out", out)
    expect(code == 0, f"an ENF is evaluated: {error}")
    about = evaluated(out)
    for name in ("compliance calibration", "effective crack"):
        expect(abs(about["toughness"][name]["max"] / 700 - 1) < 1e-4, f"{name}: {about['toughness'][name]}")
    m = 3 / (8 * B * H ** 3 * E1)
    expect(abs(about["numbers"]["compliance calibration"]["m"] / m - 1) < 1e-5, "the slope of the calibration")
    code, shown, error = start(*words, "--out", out)
    expect(code == 0 and "two more crack lengths; 0 given" in error and "effective crack" in shown, f"without calibration: {error}")


def mixed():
    here, half, lever = folder(), 0.05, 0.0413
    gamma = 1.18 * np.sqrt(E1 * E2) / G13
    chi = np.sqrt(E1 / (11 * G13) * (3 - 2 * (gamma / (1 + gamma)) ** 2))
    compliance = ((8 * (0.03 + chi * H) ** 3 * (3 * lever - half) ** 2 + (6 * (0.03 + 0.42 * chi * H) ** 3 + 4 * half ** 3)
                   * (lever + half) ** 2) / (16 * half ** 2 * B * H ** 3 * E1))
    load = np.linspace(0, 100, 60)
    path, out = os.path.join(here, "mmb.csv"), os.path.join(here, "out")
    raw(path, ["d", "P"], (1e3 * compliance * load, load))
    words = ["evaluate", "mmb", path, "--width", "25mm", "--arm", "1.5mm", "--notch", "30mm", "--span", "100mm", "--lever", "41.3mm",
             "--E1", "140GPa", "--E2", "9GPa", "--G13", "5GPa", "--out", out]
    expect_error(start(*words), 2, "has no unit: --units mm N")
    code, _, error = start(*words, "--units", "mm", "N")
    expect(code == 0, f"an MMB is evaluated: {error}")
    numbers = evaluated(out)["numbers"]["beam theory with corrections"]
    expect(abs(numbers["bending modulus"] / E1 - 1) < 1e-4 and 0.3 < numbers["mode II share"] < 0.6, f"modulus and share: {numbers}")
    # Energy balance: G = P^2/2b dC/da at fixed load, by difference of the compliance of the same formulae.
    step = 1e-6
    more = ((8 * (0.03 + step + chi * H) ** 3 * (3 * lever - half) ** 2 + (6 * (0.03 + step + 0.42 * chi * H) ** 3 + 4 * half ** 3)
             * (lever + half) ** 2) / (16 * half ** 2 * B * H ** 3 * E1))
    exact = 100 ** 2 / (2 * B) * (more - compliance) / step
    value = evaluated(out)["toughness"]["beam theory with corrections"]["max"]
    expect(abs(value / exact - 1) < 1e-3, f"the rate is that of the compliance: {value} {exact}")


def wrong():
    here = folder()
    path = raw(os.path.join(here, "a.csv"), ["x (mm)", "F (N)"], (np.arange(9), np.arange(9)))
    words = ["--width", "25mm", "--arm", "1.5mm", "--notch", "50mm", "--out", os.path.join(here, "out")]
    expect_error(start("evaluate", "dcb", path, *words[2:]), 2, "dcb needs --width")
    expect_error(start("evaluate", "enf", path, *words), 2, "enf needs --span")
    expect_error(start("evaluate", "dcb", path, "--width", "25", *words[2:]), 2, "--width 25: a number > 0 with its unit")
    expect_error(start("evaluate", "enf", path, *words, "--span", "80mm"), 2, "less than half of the span")
    expect_error(start("evaluate", "dcb", path, *words, "--units", "N", "N"), 2, "N is no unit of length")
    expect_error(start("evaluate", "dcb", "/nowhere/a.csv", *words), 2, "No such file")
    expect(not os.path.exists(os.path.join(here, "out")), "and nothing is written")


opening()
flexure()
mixed()
wrong()
finish()
