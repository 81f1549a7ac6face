# SPDX-License-Identifier: BSD-3-Clause
"""delam fit: what is said of the numbers that are held and are no parameters, against fits with other values of them."""
import json
import os
import sys

from strip import strip
from support import expect, finish, folder, read, start, write

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "study"))
import fit  # noqa: E402, F401: it finds the pictures of the Python package
from fitting.held import keys_of  # noqa: E402

# A strip that is peeled; its zone has a dozen pairs, and two laws, of which one has no interface.
PEEL = strip("""normal_stiffness = 1e13
tangential_stiffness = 1e13
normal_strength = 1.2e7
tangential_strength = 1.2e7
normal_toughness = 200.0
tangential_toughness = 400.0
""", """[[patterns]]
name = "lift"
times = [0, 1]
values = [0, 4e-4]
[[loads]]
point = [0.0, 0.002]
component = ["y"]
pattern = "lift"
""", """[time]
end = 1.0
steps = 40
[output]
every = 100
""")
TOUGH = "laws[0].normal_toughness"


def fitted(scene, data, *words):
    out = os.path.join(folder(), "fit")
    code, shown, error = start("fit", scene, "--data", data, "--parameters", "laws.0.normal_toughness", "--out", out, *words)
    expect(code == 0, f"a fit {words}: {error}")
    with open(os.path.join(out, "fit.json"), encoding="utf-8") as file:
        return json.load(file), shown


def held():
    """Each change that is told is about that of a fit with the number larger by 10 %, and of the same sign."""
    scene, out = write(PEEL), os.path.join(folder(), "out")
    code, _, error = start("run", scene, "--out", out, "--set", "solver.damage_tolerance=1e-9")
    expect(code == 0, f"the truth: {error}")
    data = os.path.join(folder(), "curve.csv")
    with open(data, "wb") as file:
        file.write(b"\n".join(b",".join(line.split(b",")[k] for k in places) for places in [columns(out)]
                              for line in read(os.path.join(out, "history.csv")).strip().split(b"\n")))
    about, shown = fitted(scene, data, "--set", "solver.damage_tolerance=1e-9")
    changes = {row["key"]: row["changes"][TOUGH] for row in about["held"]}
    expect(about["held_larger_by"] == 0.1 and about["analyses"] <= 12, f"analyses of the search: {about['analyses']}")
    expect(set(changes) >= {"laws[0].normal_strength", "laws[0].tangential_toughness", "materials[0].young", "materials[0].poisson"}
           and TOUGH not in changes, f"all numbers of the law and the elastic constants: {changes}")
    expect(max(changes, key=lambda key: abs(changes[key])) == "materials[0].young" and abs(changes["materials[0].young"]) > 0.01,
           f"the modulus does most: {changes}")
    expect("held, and taken as right by the intervals from the curve alone; 10 % more of\n    materials[0].young (of 7e+10) changes" in shown
           and "take the model as right" not in shown, f"it is said beside the interval: {shown}")
    row = about["parameters"][0]
    value, wide = row["value"], sum(change ** 2 for change in changes.values()) ** 0.5
    low, high = (end / value - 1 for end in row["interval_with_held"])
    expect(-wide < low < -0.8 * wide and 0.8 * wide < high < 1.3 * wide, f"errors in all of them at once: {low}, {high}, {wide}")
    for key, moved in (("laws.0.normal_strength", 1.1 * 1.2e7), ("materials.0.young", 1.1 * 70e9), ("materials.0.poisson", 0.33)):
        again, _ = fitted(scene, data, "--set", "solver.damage_tolerance=1e-9", "--set", f"{key}={moved!r}", "--held", "0")
        found = again["parameters"][0]["value"] / value - 1
        said = changes[key.replace(".0.", "[0].")]
        # One step by derivatives, which are chords over 25 %, is that far off.
        expect(abs(found - said) < 0.35 * abs(found) + 1e-3, f"{key}: told {said:.4f}, a fit finds {found:.4f}")
        expect(again["held"] == [], "--held 0 leaves it out")
    _, shown = fitted(scene, data, "--held", "0")
    expect("10 % more" not in shown and "intervals take the model as right" in shown, f"and says so: {shown}")
    half, _ = fitted(scene, data, "--set", "solver.damage_tolerance=1e-9", "--held", "0.05")
    part = next(row["changes"][TOUGH] for row in half["held"] if row["key"] == "materials[0].young")
    expect(0.4 < part / changes["materials[0].young"] < 0.6, f"of half of it: {part}")
    code, _, error = start("fit", scene, "--data", data, "--parameters", "laws.0.normal_toughness", "--out", out + "2", "--held", "2")
    expect(code == 2 and "--held: 2: a number from 0 to 1 is expected" in error, f"a part beyond all: {error}")


def columns(out):
    names = read(os.path.join(out, "history.csv")).split(b"\n", 1)[0].split(b",")
    return [names.index(name) for name in (b"load", b"reaction")]


def keys():
    """Zeros, exponents and words: what counts, and with which value."""
    scene = {"laws": [{"name": "a", "normal_toughness": 2.0, "gradient": 0, "toughness_exponent": 2}],
             "materials": [{"name": "m", "E1": 3.0, "nu12": 0.0, "density": 5.0}, {"young": 7.0}]}
    found = keys_of(scene, ["laws[0].toughness_exponent=4", "materials[1].young=8"], ["laws[0].normal_toughness"])
    expect(found == {"laws[0].toughness_exponent": 4.0, "materials[0].E1": 3.0, "materials[1].young": 8.0}, f"{found}")


for part in (keys, held):
    part()
finish()
