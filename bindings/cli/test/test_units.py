# SPDX-License-Identifier: BSD-3-Clause
"""Units: a scene names none unless it says so, `check` proposes names by the magnitudes and warns where these contradict each
other or the names, and lines show numbers with the prefix that suits them."""
import json
import os
import re

from support import SCENE, changed, delam, expect, finish, folder, read, write

NAMED = '[units]\nlength = "{}"\nforce = "{}"\n'
# SCENE is in m and N. The same in other units: a factor on lengths, and one on forces.
KEYS = {"length": (1, 0), "h": (1, 0), "thickness": (1, 0), "young": (-2, 1), "normal_stiffness": (-3, 1),
        "tangential_stiffness": (-3, 1), "normal_onset": (-1, 1), "tangential_onset": (-1, 1), "normal_toughness": (-1, 1),
        "tangential_toughness": (-1, 1), "to": (1, 0), "values": (1, 0), "point": (1, 0)}


def scaled(length, force):
    def number(match):
        of = KEYS[match[1]]
        return match[1] + match[2] + re.sub(r"-?\d[\d.e+-]*", lambda one: repr(
            float(f"{float(one[0]) * length ** of[0] * force ** of[1]:.9g}")), match[3])
    return re.sub(rf"\b({'|'.join(KEYS)})( = )(\[[^\]]*\]|[\d.e+-]+)", number, SCENE)


def found(text):
    code, said, error = delam("check", write(text), "--json")
    expect(code == 0, f"a correct scene {error}")
    return json.loads(said)


def units_of_warnings(about):
    return [line for line in about["warnings"] if "fit together: " in line or "[units]" in line]


SYSTEMS = (("m", "N", 1, 1), ("mm", "N", 1e3, 1), ("m", "kN", 1, 1e-3), ("mm", "kN", 1e3, 1e-3))
for length, force, of_length, of_force in SYSTEMS:
    about = found(scaled(of_length, of_force))
    proposed = about["units"].get("proposed", {})
    expect((proposed.get("length"), proposed.get("force")) == (length, force), f"numbers in {length}, {force}: {proposed}")
    expect(not units_of_warnings(about) and about["units"]["length"] == "", "nothing is named, and nothing is wrong")
    about = found(scaled(of_length, of_force) + NAMED.format(length, force))
    expect("proposed" not in about["units"] and not units_of_warnings(about), f"{length}, {force} are right")
    other = SYSTEMS[(SYSTEMS.index((length, force, of_length, of_force)) + 1) % 4]
    told = units_of_warnings(found(scaled(of_length, of_force) + NAMED.format(*other[:2])))
    expect(len(told) == 1 and f"the numbers suggest {length}, {force}" in told[0], f"named {other[:2]} wrongly: {told}")

# Lengths in mm, and a modulus in Pa.
mixed = re.sub(r"young = .*", "young = 126e9", scaled(1e3, 1))
told = units_of_warnings(found(mixed))
expect(len(told) == 1 and "young = 1.26e+11 suggests m, N" in told[0], f"a contradiction: {told}")
expect(not units_of_warnings(found(mixed + NAMED.format("", ""))), "empty names: numbers without units")
code, said, error = delam("check", write(scaled(1e3, 1)))
expect('propose     [units] length = "mm", force = "N"' in said, "lines for people")

# The same run without names, and in m: numbers of history.csv are the same, and lines have a prefix.
plain, named = (os.path.join(folder(), "out") for _ in range(2))
lines = {}
for out, text in ((plain, changed("steps = 20", "steps = 4")), (named, changed("steps = 20", "steps = 4") + NAMED.format("m", "N"))):
    code, lines[out], error = delam("run", write(text), "--out", out)
    expect(code in (0, 1), error)
expect(read(os.path.join(plain, "history.csv")) == read(os.path.join(named, "history.csv")), "names change no number")
balance = {out: next(line for line in lines[out].splitlines() if "energy balance" in line) for out in lines}
expect(not re.search(r"[0-9] [nµmk]?J/m", balance[plain]) and re.search(r"[0-9] [mk]?J/m", balance[named]), str(balance))
expect(len(set(re.findall(r"[0-9] ([nµmk]?J/m)", balance[named]))) == 1, f"one unit for the energies of a run: {balance[named]}")
units = json.loads(read(os.path.join(named, "result.json")))["units"]
expect([one["name"] for one in units["scales"]["release_rate"]] == ["J/m²"], f"toughness: {units['scales']['release_rate']}")
scales = {one["name"]: one["factor"] for one in units["scales"]["length"]}
expect(abs(scales["mm"] - 1e3) < 1e-9 and scales["m"] == 1 and units["scales"]["stress"], f"units to choose from: {scales}")
finish()
