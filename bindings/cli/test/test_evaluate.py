# SPDX-License-Identifier: BSD-3-Clause
"""delam evaluate: toughnesses by the standards from raw files that beam theory has written, with points, R-curves,
calibrations, noise, and the words for what is missing or cannot be. `test_evaluate.py noise` prints how far points are off
with noise."""
import csv
import json
import os
import re
import sys

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
    expect(names[:2] == ["visual", "NL"] and names[2].startswith("5 %") and names[3] == "max", f"points: {names}")
    # Points without a mark have the crack of the notch, as ISO 15024 evaluates them; here the notch grows at 280 J/m2.
    for name in ("NL", "max"):
        value = about["toughness"]["modified beam theory"][name]
        expect(abs(value / TOUGH - 1) < 0.01, f"modified beam theory at {name}: {value}")
    spread = about["propagation"]["modified beam theory"]
    expect(abs(spread["mean"] / TOUGH - 1) < 1e-3 and spread["deviation"] < 1e-2 * TOUGH and spread["marks"] == 6,
           f"the mean of propagation: {spread}")
    expect("propagation 280 +-" in shown and "offset 4 mm" in shown, f"means and units are said: {shown}")
    expect(about["units"]["numbers"]["offset"] == "m" and about["units"]["toughness"] == "J/m2", "units are kept")
    peak = next(point for point in about["points"] if point["name"] == "max")
    expect(abs(peak["load"] - y.max()) < 1e-6 and abs(about["compliance"] / (1e-3 * x[59] / y[59]) - 1) < 1e-3, "load, compliance")
    with open(os.path.join(out, "r-curve.csv"), newline="", encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row["method"] == "modified beam theory"]
    expect(len(rows) == 7 and all(abs(float(row["toughness (J/m2)"]) / TOUGH - 1) < 1e-3 for row in rows),
           "the R-curve is flat")
    expect(abs(float(rows[-1]["crack (mm)"]) - 90) < 1e-6, "its lengths are in mm")
    expect(about["confidence"] == 0.95 and about["warnings"] == [] and about["intervals"]["modified beam theory"]["max"]["low"] is None
           and "none for" in shown and "there is neither noise in the curve nor scatter of marks" in shown, f"no interval without noise: {shown}")
    expect(not os.path.exists(os.path.join(out, "study.lock")), "no lock is left")
    expect(read(os.path.join(out, "evaluate.png"))[:4] == b"\x89PNG", "a picture")
    # Without marks: of E1, the crack that the compliance has, its offset included.
    raw(path, ["Extension (mm)", "Load (N)"], (x, y))
    code, shown, error = start(*words, "--E1", "140GPa", "--out", out)
    value = evaluated(out)["toughness"]["effective crack"]["max"]
    expect(code == 0 and "0 crack lengths: at least 3" in error and abs(value / TOUGH - 1) < 1e-3, f"without marks: {value} {error}")
    # With a soft machine, whose displacement is taken off.
    soft = raw(os.path.join(here, "soft.csv"), ["Extension (mm)", "Load (N)"], (x + 5e-3 * y, y))
    for more, right in ((["--compliance", "5e-3mm/N"], True), ([], False)):
        code, shown, error = start(*words[:2], soft, *words[3:], "--E1", "140GPa", *more, "--out", out, "--replace")
        value = evaluated(out)["toughness"]["effective crack"]["max"]
        expect(code == 0 and (abs(value / TOUGH - 1) < 1e-3) == right and ("machine and fixture take" in shown) == right,
               f"a soft machine {more}: {value} {error}")
    expect_error(start(*words, "--compliance", "5e-3mm", "--out", out), 2, "--compliance 5e-3mm: .* such as 2e-5mm/N")
    # Beside a fit, in its units.
    with open(os.path.join(here, "fit.json"), "w", encoding="utf-8") as file:
        json.dump({"units": ["mm", "N"], "parameters": [
            {"key": "laws[0].normal_toughness", "value": 0.28, "interval": [0.27, 0.29], "told": True},
            {"key": "laws[0].normal_strength", "value": 30.0, "interval": [None, None], "told": False}]}, file)
    code, shown, error = start(*words, "--beside", here, "--out", out, "--replace")
    expect(code == 0 and "delam fit: laws[0].normal_toughness 280 J/m2, interval 270 to 290, of mode I" in shown and "strength" not in shown,
           f"a fit beside it: {shown} {error}")
    with open(os.path.join(here, "fit.json"), "w", encoding="utf-8") as file:
        json.dump({"units": ["mm", "N"], "parameters": [
            {"key": "laws[0].normal_toughness", "value": 0.28, "interval": [0.27, 0.29], "interval_with_held": [0.25, 0.31],
             "told": True}]}, file)
    code, again, error = start(*words, "--beside", here, "--out", out)
    expect(code == 0 and "280 J/m2, interval 250 to 310, of mode I" in again, f"with errors in what is held: {again} {error}")
    expect("in the place of an earlier evaluation" in shown, "an earlier evaluation that is replaced is told")
    with open(os.path.join(here, "fit.json"), "w", encoding="utf-8") as file:
        json.dump({"units": ["mm", "N"], "data": ["other/dcb-2.csv"], "describes": False, "parameters": []}, file)
    code, _, error = start(*words, "--beside", here, "--out", out)
    expect(code == 0 and "it is the fit of dcb-2.csv, and this is dcb.csv" in error and "its model does not describe its curve" in error,
           f"a fit of another file: {error}")
    # A toughness of another mode is told, and does not stand beside.
    with open(os.path.join(here, "fit.json"), "w", encoding="utf-8") as file:
        json.dump({"units": ["mm", "N"], "parameters": [
            {"key": "laws[0].tangential_toughness", "value": 0.8, "interval": [0.7, 0.9], "told": True}]}, file)
    code, shown, error = start(*words, "--beside", here, "--out", out)
    expect(code == 0 and "is of mode II, and this test of mode I: it is not drawn" in error, f"a fit of another mode: {error}")
    expect_error(start(*words, "--beside", os.path.join(here, "nowhere"), "--out", out), 2, "the folder of delam fit is expected")


def intervals():
    """With noise and lengths that are misread each toughness has an interval, which is wider at a higher confidence."""
    here = folder()
    random = np.random.default_rng(1)
    x, y, marks = opened(0.004)
    path = raw(os.path.join(here, "dcb.csv"), ["Extension (mm)", "Load (N)", "Crack (mm)"],
               (x, y + random.normal(0, 0.005 * y.max(), len(y)), marks + random.normal(0, 0.3, len(y))))
    found = []
    for more in ([], ["--confidence", "0.99"]):
        code, shown, error = start("evaluate", "dcb", path, "--width", "25mm", "--arm", "1.5mm", "--notch", "50mm", *more, "--out", os.path.join(here, "out"))
        about = evaluated(os.path.join(here, "out"))
        found.append(about["intervals"]["modified beam theory"])
        level = 99 if more else 95
        expect(code == 0 and f"{level} % interval, modified beam theory: visual " in shown and "numbers of the sheet count as right" in shown
               and all(one["low"] < about["toughness"]["modified beam theory"].get(name, about["propagation"]["modified beam theory"]["mean"]) < one["high"]
                       for name, one in found[-1].items()), f"each toughness has an interval: {found[-1]} {error}")
    expect(set(found[0]) == {"visual", "NL", "5 %", "max", "propagation"}
           and all(found[1][name]["high"] - found[1][name]["low"] > 1.2 * (one["high"] - one["low"]) for name, one in found[0].items()),
           "which is wider at 99 %")
    expect(found[0]["max"]["sources"].keys() == {"the noise of the curve", "the line through 7 crack lengths"}, f"and comes from: {found[0]['max']}")
    expect_error(start("evaluate", "dcb", path, "--confidence", "1", "--out", here), 2, "a number from 0.01 to 0.9999")


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
    expect("zero:" not in shown, "a line that begins at 0 is not told")
    expect("the curve ends at its largest load, still on its initial line" in error, f"a crack that is not seen to grow is told: {error}")
    # All lengths in one file, as machines write them: tests by their names or numbers.
    whole = os.path.join(here, "all.csv")
    with open(whole, "w", encoding="utf-8") as file:
        file.write("\n".join(f"Specimen,CC {1e3 * a:.0f}\n" + read(files[a]).decode().split("\n", 1)[1] for a in files))
    same = [*words[:2], whole, *words[3:], "--specimen", "CC 30", "--out", out, "--replace"]
    code, shown, error = start(*same, "--calibration", f"20mm={whole}:CC 20", "--calibration", f"40mm={whole}:3")
    expect(code == 0 and abs(evaluated(out)["toughness"]["compliance calibration"]["max"] / 700 - 1) < 1e-4, f"in one file: {shown} {error}")
    expect_error(start(*same, "--calibration", f"20mm={whole}"), 2, f"has 3 tests: .*: --calibration LENGTH={whole}:1, for example, takes the first")
    expect_error(start(*same, "--calibration", f"20mm={whole}:CC 50"), 2, 'there is no specimen "CC 50": the file has 3 tests')
    w, p = bent(0.03, 0.05)
    slack = raw(os.path.join(here, "slack.csv"), ["Deflection (mm)", "Load (kN)"], (np.concatenate([[0.0], w + 0.3]), np.concatenate([[0.0], p / 1e3])))
    code, again, error = start(*words[:2], slack, *words[3:], "--out", out, "--replace")
    expect(code == 0 and "zero: the initial line begins at a displacement of 0.3 mm" in again
           and abs(evaluated(out)["toughness"]["effective crack"]["max"] / 700 - 1) < 1e-4, f"slack is told, and counts for nothing: {again} {error}")


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
    # A beam that also shears, as specimens do: the modulus of the standard is too small, and the effective crack is that of the notch.
    sheared = compliance + ((lever + half) / half) ** 2 * 3 * half / (10 * B * H * G13)
    raw(path, ["d (mm)", "P (N)"], (1e3 * sheared * load, load))
    code, _, error = start(*words)
    about = evaluated(out)
    value, plain = (about["toughness"][name]["max"] for name in ("effective crack", "beam theory with corrections"))
    expect(code == 0 and abs(value / exact - 1) < 1e-3 and plain > 1.005 * exact, f"without the shear of the beam: {value} {plain} {exact} {error}")


def wrong():
    here = folder()
    path = raw(os.path.join(here, "a.csv"), ["x (mm)", "F (N)"], (np.arange(9), np.arange(9)))
    words = ["--width", "25mm", "--arm", "1.5mm", "--notch", "50mm", "--out", os.path.join(here, "out")]
    expect_error(start("evaluate", "dcb", path, *words[2:]), 2, "dcb needs --width, such as 25mm$")
    expect_error(start("evaluate", "enf", path, *words), 2, "enf needs --span .or --half-span., such as 100mm")
    expect_error(start("evaluate", "dcb", path, *words[:2], *words[4:]), 2, "dcb needs --arm .or --thickness., such as 1.5mm")
    expect_error(start("evaluate", "dcb", path, "--width", "25", *words[2:]), 2, "--width 25: a number > 0 with its unit")
    expect_error(start("evaluate", "enf", path, *words, "--span", "80mm"), 2, "less than the half span")
    expect_error(start("evaluate", "dcb", path, *words, "--units", "N", "N"), 2, "N is no unit of length")
    expect_error(start("evaluate", "dcb", "/nowhere/a.csv", *words), 2, "No such file")
    expect_error(start("evaluate", "mmb", path, "--width", "25mm", "--arm", "1.5mm", "--notch", "30mm", "--span", "100mm", "--lever", "16mm",
                       "--E1", "140GPa", "--E2", "9GPa", "--G13", "5GPa", *words[6:]), 2, "--lever 16mm: more than a third of the half span, 16.67 mm")
    expect(not os.path.exists(os.path.join(here, "out")), "and nothing is written")


def replaced():
    """An evaluation of another test is not replaced without a word; loads in another unit are told by the toughness."""
    here = folder()
    x, y, marks = opened(0.004)
    out, titles = os.path.join(here, "out"), ["Extension (mm)", "Load (N)", "Crack (mm)"]
    one, other = (raw(os.path.join(here, name), titles, (x, y, marks)) for name in ("one.csv", "other.csv"))
    words = ["--width", "25mm", "--arm", "1.5mm", "--notch", "50mm", "--out", out]
    code, _, error = start("evaluate", "dcb", one, *words)
    expect(code == 0 and "laminates have" not in error, error)
    expect_error(start("evaluate", "dcb", other, *words), 2, "holds the evaluation of another test, dcb of .*one.csv: --replace, or another --out")
    for file, more in ((one, []), (other, ["--replace"])):
        code, shown, error = start("evaluate", "dcb", file, *words, *more)
        expect(code == 0 and "in the place of an earlier evaluation" in shown, f"{more}: {shown} {error}")
    keys = set(evaluated(out))
    few = raw(os.path.join(here, "few.csv"), titles[:2], (x, y / 40))
    code, _, error = start("evaluate", "dcb", few, *words, "--replace", "--E2", "0.2GPa", "--G13", "0.1GPa")
    expect(code == 0 and "J/m2 at the largest load (effective crack), and laminates have 10 to 20000 J/m2" in error, f"too small: {error}")
    expect(set(evaluated(out)) == keys and {point["name"] for point in evaluated(out)["points"]} == {"NL", "5 %", "max"}, "its keys are always the same")


def noisy(seed, noise):
    """A straight rise and a growth that takes 5 % of the load, with noise of load and displacement in parts of their largest
    ones: displacement (m), load (N), the load at which the crack begins to grow."""
    random = np.random.default_rng(seed)
    compliance, force = 1.6e-5, 180.0
    crack = np.linspace(0, 1, 60)
    load = np.concatenate([np.linspace(0, force, 430), force * (1 - 0.05 * crack)])
    bent = np.concatenate([np.full(430, compliance), compliance * (1 + 0.12 * crack)]) * load
    return (bent + random.normal(0, 0.002 * bent.max() / 3, len(bent)), load + random.normal(0, noise * force, len(load)), force)


def point_errors(noise, seeds=20):
    """How far loads of NL, 5 % and max are off, as parts, squared as toughnesses are."""
    sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "study"))
    import command  # noqa: F401, finds its neighbours
    from measured.loops import Way
    from specimens.points import Points
    rows = []
    for seed in range(seeds):
        x, y, force = noisy(seed, noise)
        way = Way(x, y, False)
        rows.append([(point.load / force) ** 2 - 1 for point in Points(way.x, way.y, "noisy").points])
    return np.array(rows)


def noise():
    """No single noisy point decides: with noise of 1.5 % of the largest load, which loads cells of a class of 1 have at
    small loads, the 5 % point is where the curve leaves its line for good, and the maximum that of the curve."""
    off = point_errors(0.015)
    for k, (name, most) in enumerate((("NL", 0.1), ("5 %", 0.06), ("max", 0.06))):
        expect(np.all(np.abs(off[:, k]) < most) and abs(np.median(off[:, k])) < 0.02,
               f"{name} with noise: median {np.median(off[:, k]):.3f}, {off[:, k].min():.3f} to {off[:, k].max():.3f}")
    exact = point_errors(0.0, 1)[0]
    expect(np.all(np.abs(exact) < 0.01), f"and without noise: {exact}")


def drawing():
    """What is drawn: units as text, methods with few values as points, and values below zero in sight."""
    sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "study"))
    import types
    from specimens import pictures
    from specimens.answer import Answer
    from specimens.points import Point
    kept = []
    pictures.save = lambda figure, path: kept.append(figure)
    answer = Answer("method", np.array([1e-3, 2e-3, 3e-3]), np.full(3, 0.03), np.array([-5.0, 300.0, 400.0]), lambda d, p, a: p, {})
    points = types.SimpleNamespace(points=[Point("NL", 1, 1e-3, -5.0), Point("5 %", 1, 1e-3, 300.0), Point("max", 1, 1e-3, 400.0)], zero=0.1, compliance=0.5)
    curve = types.SimpleNamespace(displacement=np.arange(3.0), load=np.arange(3.0), whole=None, path="/a/raw.csv")
    pictures.draw("nowhere", "a test", curve, [answer], points, [])
    right = kept[0].axes[1]
    expect([text.get_text() for text in right.get_xticklabels()] == ["NL", "5 %", "max"] and right.lines[0].get_ydata().tolist() == [-5, 300, 400]
           and right.get_xlabel().endswith("crack 30 mm"), "toughnesses of one crack stand over the points")
    expect("$" not in right.get_ylabel() and "J/m²" in right.get_ylabel(), f"the unit is text: {right.get_ylabel()}")
    expect(all(line.get_linestyle() == "None" for line in right.lines), "three values at one crack are points, no line")
    expect(right.get_ylim()[0] < -5 and right.get_ylim()[1] > 400, f"all values are in sight: {right.get_ylim()}")
    answer = Answer("calibration", np.linspace(0.0, 1e-3, 50), np.full(50, 0.03), np.linspace(0.0, 1e9, 50), lambda d, p, a: 70.0 * p, {})
    points.points = [Point("NL", 1, 1e-3, 10.0), Point("5 %", 1, 1e-3, 10.0), Point("max", 1, 1e-3, 10.0)]
    grows = Answer("effective crack", np.array([1e-3, 2e-3]), np.array([0.03, 0.04]), np.array([700.0, 710.0]), lambda d, p, a: 70.0 * p, {})
    curve.whole = np.array([0.0, 1.0, 0.2, 3.0]), np.array([0.0, 1.0, 0.1, 3.0])
    pictures.draw("nowhere", "a test", curve, [answer, grows], points, [])
    column = kept[1].axes[1].lines[0]
    expect(kept[1].axes[1].get_xlabel() == "crack length (mm)" and kept[1].axes[1].lines[1].get_xdata().tolist() == [30, 40], "else over the crack")
    expect(kept[1].axes[0].lines[0].get_xdata().tolist() == [0, 1000, 200, 3000], "unloadings are drawn")
    expect(column.get_ydata().tolist() == 3 * [700.0] and column.get_linestyle() == "None" and kept[1].axes[1].get_ylim()[1] < 1e3,
           f"a calibration has its values at the points, not all of the load: {column.get_ydata()}")
    ends = [line.get_xdata()[-1] for line in kept[0].axes[0].lines if line.get_label() in ("initial line", "5 % offset")]
    expect(np.allclose(ends, [1100, 1150]), f"the lines of the initial compliance and of the offset: {ends}")
    expect([text.get_text() for text in kept[0].texts] == ["raw.csv: a test"], "file and test are named")
    one, none = types.SimpleNamespace(low=600.0, high=1500.0), types.SimpleNamespace(low=None, high=None)
    pictures.draw("nowhere", "a test", curve, [answer, grows], points, [], {"calibration": {"max": none}, "effective crack": {"max": one}})
    right = kept[2].axes[1]
    points.points[-1].crack = 0.03
    expect(not right.containers, "an interval at a crack that nobody knows is not drawn")
    pictures.draw("nowhere", "a test", curve, [answer, grows], points, [], {"calibration": {"max": none}, "effective crack": {"max": one}})
    right = kept[3].axes[1]
    ends = [path.vertices[:, 1].tolist() for bar in right.containers for lines in bar.lines[2] for path in lines.get_paths()]
    expect(ends == [[600.0, 1500.0]] and right.get_ylim()[1] > 1500 and "95 % intervals at the largest load" in right.get_legend_handles_labels()[1],
           f"intervals stand at the largest load, and none where the data tell none: {ends}")
    sizes = [line.get_markersize() for line in kept[0].axes[0].lines if line.get_linestyle() == "None"]
    expect(len(set(sizes)) == 3, f"points that coincide are told apart: {sizes}")


def blocks():
    """Load blocks: N and F of ISO 15024, here from their formulae at the first mark."""
    here = folder()
    path, out = os.path.join(here, "dcb.csv"), os.path.join(here, "out")
    x, y, marks = opened(0.004)
    words = ["evaluate", "dcb", raw(path, ["Extension (mm)", "Load (N)", "Crack (mm)"], (x, y, marks)), "--width", "25mm",
             "--arm", "1,5mm", "--notch", "50mm", "--block-pin", "8mm", "--block-length", "2cm", "--out", out]
    code, _, error = start(*words)
    expect(code == 0, f"with blocks: {error}")
    kept = np.flatnonzero(np.isfinite(marks))
    d, p, a = 1e-3 * x[kept], y[kept], 1e-3 * marks[kept]
    n = 1 - (0.01 / a) ** 3 - 9 / 8 * (1 - (0.01 / a) ** 2) * d * 0.008 / a ** 2 - 9 / 35 * (d / a) ** 2
    f = 1 - 0.3 * (d / a) ** 2 - 1.5 * d * 0.008 / a ** 2
    slope, at_zero = np.polyfit(a, np.cbrt(d / p / n), 1)
    k = int(np.flatnonzero(a > 0.05001)[0])
    wanted = 1.5 * p[k] * d[k] / (B * (a[k] + max(0.0, at_zero / slope))) * f[k] / n[k]
    value = evaluated(out)["toughness"]["corrected beam theory"]["visual"]
    expect(abs(value / wanted - 1) < 2e-3, f"blocks: {value} {wanted}")


def effective():
    """The crack that the compliance has, with what the arms rotate and shear: of E1, E2 and G13, and a warning without."""
    here, half, notch = folder(), 0.05, 0.03
    gamma = 1.18 * np.sqrt(E1 * E2) / G13
    chi = np.sqrt(E1 / (11 * G13) * (3 - 2 * (gamma / (1 + gamma)) ** 2))
    out = os.path.join(here, "out")
    x, y, _ = opened(chi * H)
    path = raw(os.path.join(here, "dcb.csv"), ["Extension (mm)", "Load (N)"], (x, y))
    words = ["evaluate", "dcb", path, "--width", "25mm", "--arm", "1.5mm", "--notch", "50mm", "--out", out]
    code, _, error = start(*words)
    plain = evaluated(out)["toughness"]["effective crack"]["max"]
    expect(code == 0 and "rotation of the arms" in error and plain > 1.03 * TOUGH, f"without moduli: {plain} {error}")
    code, _, error = start(*words, "--E2", "9GPa", "--G12", "5GPa")
    value = evaluated(out)["toughness"]["effective crack"]["max"]
    expect(code == 0 and "rotation" not in error and abs(value / TOUGH - 1) < 2e-3, f"with E2 and G12: {value} {error}")
    crack = notch + 0.42 * chi * H
    compliance = (3 * crack ** 3 + 2 * half ** 3) / (8 * B * H ** 3 * E1) + 3 * half / (10 * B * H * G13)
    load = np.linspace(0, np.sqrt(700.0 * 16 * B ** 2 * H ** 3 * E1 / 9) / crack, 80)
    path = raw(os.path.join(here, "enf.csv"), ["Deflection (mm)", "Load (N)"], (1e3 * compliance * load, load))
    words = ["evaluate", "enf", path, "--width", "25mm", "--arm", "1.5mm", "--notch", "30mm", "--half-span", "50mm", "--out", out, "--replace"]
    code, _, error = start(*words, "--E1", "140GPa", "--E2", "9GPa", "--G13", "5GPa")
    value = evaluated(out)["toughness"]["effective crack"]["max"]
    expect(code == 0 and "warning: effective" not in error and abs(value / 700 - 1) < 1e-3, f"ENF with moduli: {value} {error}")
    code, _, error = start(*words, "--E1", "140GPa")
    expect(code == 0 and "without --G13 the shear of the beam" in error, f"ENF without: {error}")


def implausible():
    """What no specimen has is refused, with the reason; what one hardly has is told."""
    here = folder()
    out = os.path.join(here, "out")
    x, y, marks = opened(0.004)
    dcb = ["--width", "25mm", "--arm", "1.5mm", "--out", out]
    metres = raw(os.path.join(here, "m.csv"), ["Extension (m)", "Load (N)", "Crack (mm)"], (x, y, marks))
    expect_error(start("evaluate", "dcb", metres, "--notch", "50mm", *dcb), 2, "bending modulus of 0.1[0-9]* GPa.*units of the file")
    path = raw(os.path.join(here, "mm.csv"), ["Extension (mm)", "Load (N)", "Crack (mm)"], (x, y, marks))
    expect_error(start("evaluate", "dcb", path, "--notch", "50m", *dcb), 2, "up to 90 mm, are not longer than --notch 50m")
    # Half of the width for all of it, and the opening of one arm for that of both: told, with what would agree.
    for given, asked, more in (("80GPa", "1.39", ""), ("60GPa", "1.85", "opening of one arm"), ("200GPa", "0.56", "(--compliance)")):
        code, shown, error = start("evaluate", "dcb", path, "--notch", "50mm", "--E1", given, *dcb)
        expect(code == 0 and f"warning: {path}: the initial compliance" in error and f"--E1 is {given[:-3]} GPa: it would agree with a width of" in error
               and ("opening of one arm" in error) == (more == "opening of one arm") and more in error and f"GPa, {asked} of --E1 (without" in shown,
               f"a modulus beside E1 of {given}: {shown} {error}")
    code, shown, error = start("evaluate", "dcb", path, "--notch", "50mm", "--E1", "140GPa", "--E2", "9GPa", "--G13", "5GPa", *dcb)
    expect(code == 0 and "warning" not in error and re.search(r"^modulus: the initial compliance of 0.1[0-9]* mm/N gives a bending modulus of 1[2-4][0-9.]* GPa, "
                                                             "[0-9.]* of --E1$", shown, re.M), f"the modulus is always said: {shown} {error}")
    # Units, decimal places and columns with which the modulus would be that of the sheet are named.
    titles, known = ["Extension (mm)", "Load (N)", "Crack (mm)"], ["--notch", "50mm", "--E1", "140GPa", "--E2", "9GPa", "--G13", "5GPa"]
    for name, columns, wanted in ((["Extension (cm)", *titles[1:]], (x, y, marks), "the displacement of the file is in mm and not in cm .--units."),
                                  (["Extension (mm)", "Load (kN)", titles[2]], (x, y, marks), "the load of the file is in N and not in kN .--units."),
                                  (titles[:2], (y, x), "displacement and load are exchanged .--columns X Y.")):
        other = raw(os.path.join(here, "other.csv"), name, columns)
        expect_error(start("evaluate", "dcb", other, *known, *dcb), 2, f"GPa, --E1 is 140 GPa, and would agree if (.*, or if )?{wanted}")
    for more, wanted in ((["--arm", "15mm"], "--arm is 1.5mm"), (["--arm", "1.5mm", "--E1", "140MPa"], "--E1 is 140GPa")):
        expect_error(start("evaluate", "dcb", path, *known[:2], *known[4:], *(["--E1", "140GPa"] * ("--E1" not in more)), "--width", "25mm", *more,
                           "--out", out), 2, f"and would agree if (.*, or if )?{wanted}")
    far = raw(os.path.join(here, "far.csv"), ["Extension (cm)", "Load (N)", "Crack (mm)"], (x, y, marks))
    code, shown, error = start("evaluate", "dcb", far, "--notch", "50mm", *dcb, "--replace")
    expect(code == 0 and re.search("at an opening of .* mm the crack is 90 mm long: beyond 0.4 of the crack, arms rotate too far", error), f"far open: {error}")
    code, shown, error = start("evaluate", "dcb", path, *known, *dcb, "--replace")
    expect(code == 0 and "warning" not in error, error)
    expect(90e9 < evaluated(out)["modulus"] < 150e9 and evaluated(out)["units"]["modulus"] == "Pa", "and kept")
    files = {}
    for a in (0.02, 0.03, 0.04):
        bend, load = bent(a, 0.05)
        files[a] = raw(os.path.join(here, f"{a}.csv"), ["Deflection (mm)", "Load (N)"], (bend, load))
    words = ["evaluate", "enf", files[0.03], "--notch", "30mm", "--half-span", "50mm", *dcb]
    expect_error(start(*words, "--calibration", f"20mm={files[0.04]}", "--calibration", f"40mm={files[0.02]}"), 2,
                 "compliance does not grow with the crack")
    expect_error(start(*words[:2], files[0.02], *words[3:], "--calibration", f"20mm={files[0.03]}", "--calibration", f"40mm={files[0.04]}"), 2,
                 "compliance does not grow with the crack: .* at 20 mm, .* at 30 mm: do the files")
    expect_error(start(*words, "--calibration", f"30mm={files[0.03]}", "--calibration", f"40mm={files[0.04]}"), 2,
                 "30 mm is the length of --notch, too")
    expect_error(start("evaluate", "dcb", files[0.03], "--notch", "50mm", *dcb), 2, "1 to 1000 GPa are expected")
    # The whole thickness for that of an arm, by the standards and by the modulus; the whole span for its half.
    for sheet, wanted in ((["--arm", "3mm"], "--arm 3mm is one arm, .* give --thickness 3mm if that is the whole specimen, --thickness 6mm"),
                          (["--thickness", "6mm", "--E1", "140GPa"], "would agree if --arm is that of the whole specimen"),
                          (["--thickness", "3mm", "--arm", "2mm"], "contradict each other")):
        expect_error(start("evaluate", "dcb", path, "--notch", "50mm", "--width", "25mm", *sheet, "--out", out), 2, wanted)
    expect_error(start(*words[:5], "--half-span", "100mm", *dcb, "--E1", "140GPa"), 2, "would agree if --half-span is the whole span")
    found = []
    for sheet in (["--arm", "1.5mm"], ["--thickness", "3mm"]):
        code, _, error = start("evaluate", "dcb", path, "--notch", "50mm", "--width", "25mm", *sheet, "--out", out)
        expect(code == 0, error)
        with open(os.path.join(out, "evaluate.json"), encoding="utf-8") as file:
            found.append(json.load(file)["toughness"])
    expect(found[0] == found[1], "both thicknesses are the same specimen")
    expect_error(start(*words, "--span", "90mm"), 2, "contradict each other")
    expect_error(start(*words, "--halfspan", "90mm"), 2, "--halfspan: `delam evaluate` has no such option .did you mean '--half-span'")
    expect_error(start("evaluate", "dcb", path, "--notch", "50mm", "--width", "25mm", "--arm", "-1.5mm", "--out", out), 2,
                 "such as 1.5mm")


if sys.argv[1:] == ["noise"]:
    for level in (0.0025, 0.005, 0.01, 0.015):
        print(f"noise {100 * level:g} %: median of NL, 5 %, max off by", np.round(100 * np.median(point_errors(level), axis=0), 2), "%")
else:
    opening()
    flexure()
    mixed()
    wrong()
    noise()
    drawing()
    blocks()
    effective()
    implausible()
    replaced()
    intervals()
finish()
