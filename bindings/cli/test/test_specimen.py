# SPDX-License-Identifier: BSD-3-Clause
"""`delam new`: the scene of each kind of test runs as it is, and its peak agrees with corrected beam theory, whose
formulas are here once more, in SI units and for one specimen. `test_specimen.py pairs` prints peaks for other meshes."""
import csv
import io
import math
import os
import re
import sys
import tomllib

from support import delam, expect, expect_error, finish, folder, read

E1, E2, G12 = 140e9, 10e9, 5e9
PLY = "--E1 140GPa --E2 10GPa --G12 5e3MPa --nu12 0.3 --nu23 0.45 --width 25mm ".split()
GAMMA = 1.18 * math.sqrt(E1 * E2) / G12
CHI = math.sqrt(E1 / (11 * G12) * (3 - 2 * (GAMMA / (1 + GAMMA)) ** 2))
HALF, C = 0.05, 0.0413


def mode_one(load, a, h):
    return 12 * load ** 2 * (a + CHI * h) ** 2 / (h ** 3 * E1)


def mode_two(load, a, h):
    return 9 * load ** 2 * (a + 0.42 * CHI * h) ** 2 / (16 * h ** 3 * E1)


def mixed(one, two):
    """The load per width at which a mixed front grows, of the energy release rates at the load 1."""
    b = two / (one + two)
    return math.sqrt((250 + 500 * b ** 2) / (one + two))


PRESS = (3 * C - HALF) / (4 * HALF), (C + HALF) / HALF
UPPER, LOWER = 1.5e-3, 2e-3
# kind: its sheet, the peak per width (N/m), and how far the peak of the scene may be from it: the zone in which the
# interface softens shortens the load arm, most in mode II.
KINDS = {
    "dcb": ("--arm 1.5mm --notch 50mm --GIc 250J/m2", math.sqrt(250 / mode_one(1, 0.05, 1.5e-3)), 0.02),
    "adcb": ("--arm 1.5mm --lower-arm 2mm --notch 5cm --GIc 0.25N/mm --GIIc 0.25kJ/m^2", math.sqrt(
        250 / sum(6 * (0.05 + CHI * h) ** 2 / (h ** 3 * E1) for h in (UPPER, LOWER))), 0.02),
    "enf": ("--arm 2mm --notch 30mm --half-span 50mm --GIIc 750J/m2", math.sqrt(750 / mode_two(1, 0.03, 2e-3)), 0.04),
    "4enf": ("--arm 2mm --notch 35mm --span 100mm --inner-span 60mm --GIIc 750J/m2",
             math.sqrt(750 * 16 * E1 * 8e-9 / 9) / 0.02, 0.01),
    "mmb": ("--arm 2mm --notch 25mm --half-span 50mm --lever 41.3mm --GIc 250J/m2 --GIIc 750J/m2",
            mixed(mode_one(PRESS[0], 0.025, 2e-3), mode_two(PRESS[1], 0.025, 2e-3)), 0.04),
    "slb": ("--arm 2mm --notch 25mm --half-span 50mm --GIc 250J/m2 --GIIc 750J/m2",
            mixed(mode_one(0.25, 0.025, 2e-3), mode_two(1, 0.025, 2e-3)), 0.04),
}
# What a cell of a fibre and a strip of a laminate need.
OTHERS = {
    "fibre": "--radius 5um --fraction 0.22 --young 3.35GPa --poisson 0.35 --fibre-young 74GPa --fibre-poisson 0.2 "
             "--GIc 2J/m2 --GIIc 8J/m2 --normal-strength 40MPa --shear-strength 60MPa --strain 2% --steps 50",
    "laminate": "--layup 0/90/90/0 --ply 0.5mm --width 10mm --length 12mm --E1 126GPa --E2 11GPa --G12 6.6GPa "
                "--GIc 220J/m2 --GIIc 600J/m2 --strain 1% --steps 4",
}


def rows_of(scene, *settings):
    out = os.path.join(folder(), "out")
    code, text, error = delam("run", scene, "--out", out, *settings)
    expect(code == 0, f"{os.path.basename(scene)} runs as it is {error if code else ''}")
    return list(csv.DictReader(io.StringIO(read(os.path.join(out, "history.csv")).decode()))), text + error


def made(kind, sheet, *more):
    scene = os.path.join(folder(), f"{kind}.toml")
    code, text, error = delam("new", kind, *sheet, "--out", scene, *more)
    expect(code == 0 and os.path.exists(scene), f"delam new {kind} {error if code else ''}")
    return scene, text, error


def peaks():
    for kind, (sheet, theory, tolerance) in KINDS.items():
        scene, text, _ = made(kind, [*PLY, *sheet.split()])
        # One is run as it is; fields take half of the time of a run.
        rows, said = rows_of(scene, *([] if kind == "dcb" else ["--set", "output.fields=[]"]))
        peak = 1e3 * max(float(row["reaction"]) for row in rows)
        expect(abs(peak / theory - 1) < tolerance, f"{kind}: peak {peak:.5g} N/m, beam theory {theory:.5g}")
        told = 1e3 * float(re.search(r"grows from [\d.]+ mm at ([\d.e+]+) N/mm", text)[1])
        expect(abs(told / theory - 1) < 1e-3, f"{kind}: the theory that is told, {told:.5g} N/m")
        expect(float(rows[-1]["crack_length"]) > 1.1 * float(rows[0]["crack_length"]), f"{kind}: the crack grows")
        expect("fewer than 3 pairs" not in said and "at least 3 are needed" not in said, f"{kind}: resolved")
        expect('length = "mm"' in read(scene).decode(), f"{kind}: units are named")
    for kind, sheet in OTHERS.items():
        scene, _, _ = made(kind, sheet.split())
        rows, said = rows_of(scene)
        if kind == "fibre":
            expect(float(rows[-1]["debonded_length"]) > 0, "fibre: the interface comes off")
        else:  # half of the plies along, half across: the mean of both moduli, but for what Poisson's ratios do
            force = float(rows[-1]["reaction"]) / (0.01 * 20 * 0.5 * (126e3 + 11e3))
            expect(abs(force - 1) < 0.01, f"laminate: force over that of its plies {force:.4f}")
        expect("at least 3 are needed" not in said, f"{kind}: resolved")


def flaws():
    """A flaw of a laminate is a notch of the interface that the sheet names, at pairs of the mesh; where it does not fit, words
    say so."""
    sheet = OTHERS["laminate"].split()
    flaw = ["--flaw", "4mm", "--flaw-width", "3mm", "--flaw-at", "8mm", "--flaw-across", "0.4cm", "--flaw-interface", "1"]
    scene, _, error = made("laminate", [*sheet, *flaw])
    about = tomllib.loads(read(scene).decode())
    expect(about["interfaces"][0]["notch"] == [{"lower": [6.0, 2.5], "upper": [10.0, 5.5]}] and "law" in about["interfaces"][0]
           and not any("notch" in one for one in about["interfaces"][1:]) and "the flaw" not in error, f"where it lies: {error}")
    rows, _ = rows_of(scene, "--set", "time.steps=1", "--set", "time.end=0.01", "--set", "output.columns=['crack_area']")
    # The pairs within, and half of those of its border at most, lie in it.
    expect(0.7 * 12 < float(rows[0]["crack_area"]) < 12 * 1.3, f"its area: {rows[0]['crack_area']}")
    drawing = os.path.join(folder(), "flaw.svg")
    code, _, error = delam("check", scene, "--draw", drawing)
    expect(code == 0 and b"notch" in read(drawing), f"it is drawn: {error}")
    scene, _, error = made("laminate", [*sheet, "--flaw", "4.3mm"], "--replace")
    about = tomllib.loads(read(scene).decode())["interfaces"]
    expect("law" in about[1] and about[1]["notch"][0]["lower"][1] == 0.0 and about[1]["notch"][0]["upper"][1] == 10.0 and "ends between pairs" in error,
           f"the middle interface, whose plies have one direction, and the whole width: {error}")
    code, _, error = delam("new", *"laminate".split(), *sheet, "--flaw", "4mm", "--flaw-at", "11mm")
    expect(code == 0 and "from x = 9 to 13 mm does not fit into the laminate" in error, f"a flaw at the end: {error}")
    for words, wanted in ((["--flaw", "4mm", "--flaw-at", "30mm"], "outside of the laminate"),
                          (["--flaw", "0.1mm"], "--flaw 0.1 mm is too short: pairs are 0.5 mm apart along x"),
                          (["--flaw-width", "2mm"], "--flaw-width: without --flaw"),
                          (["--flaw", "4mm", "--flaw-interface", "4"], "--flaw-interface 4 is not allowed: one of the interfaces 1 to 3"),
                          (["--flaw", "4mm", "--flaw-interface", "1.5"], "--flaw-interface 1.5 is not allowed")):
        expect_error(delam("new", "laminate", *sheet, *words), 2, re.escape(wanted))


def units():
    """The same sheet in other units is the same scene but for the line of the command."""
    texts = []
    for width, arm, e1, gc in (("25mm", "1.5mm", "140GPa", "250J/m2"), ("2.5cm", "1.5e-3m", "140000N/mm2", "0.25 kJ/m^2")):
        _, out, _ = delam("new", "dcb", "--width", width, "--arm", arm, "--notch", "50mm", "--E1", e1, "--E2", "10GPa",
                          "--G12", "5GPa", "--GIc", gc)
        texts.append(out.split("\n", 1)[1])
    expect(texts[0] == texts[1] and "[units]" in texts[0], "units of the sheet do not matter")
    _, out, _ = delam("new", "dcb", "--width", "25mm", "--arm", "1,5mm", "--notch", "50mm", "--E1", "140GPa", "--E2", "10GPa",
                      "--G13", "5GPa", "--GIc", "250J/m2")
    expect(out.split("\n", 1)[1] == texts[0], "nor do a decimal comma, and another name of the shear modulus")
    _, out, _ = delam("new", "enf", *PLY, "--arm", "2mm", "--notch", "30mm", "--half-span", "50mm", "--GIIc", "750J/m2")
    _, whole, _ = delam("new", "enf", *PLY, "--arm", "2mm", "--notch", "30mm", "--span", "100mm", "--GIIc", "750J/m2")
    expect(out and out.split("\n", 1)[1] == whole.split("\n", 1)[1], "nor does the span for its half")
    good = [*PLY, *KINDS["dcb"][0].split()]
    for words, wanted in ((["--arm", "1.5"], "--arm 1.5: a number with its unit is expected, like 1.5mm"),
                          (["--arm", "1.5GPa"], "--arm 1.5GPa: a unit of another kind is expected, like 1.5mm"),
                          (["--arm", "-1mm"], "--arm -1mm: a finite number > 0"),
                          (["--arm", "x"], "--arm x: a number with its unit is expected"),
                          (["--arm", "1,5"], "--arm 1,5: a number with its unit is expected"),
                          (["--arm", "1.5mm", "--G23", "5GPa"],
                           "--G23: `delam new` has no such option (did you mean '--G13'"),
                          (["--arm", "1.5mm", "--G13", "4GPa"], "--G13 4GPa and --G12 5e3MPa contradict each other"),
                          (["--length", "40mm"], "--length 40 mm is too short")):
        sheet = [*good] if words[0] == "--length" else [w for w in good if w not in ("--arm", "1.5mm")]
        expect_error(delam("new", "dcb", *sheet, *words), 2, re.escape(wanted))
    sheet = ("laminate --layup 0/90/90/0 --ply 0.5mm --width 4mm --length 4mm --young 70GPa --GIc 220J/m2 --GIIc 600J/m2 "
             "--strain 1%").split()
    code, _, error = delam("new", *sheet)
    expect(code == 0 and "take" not in error, f"a laminate takes all of its sheet: {error}")
    code, _, error = delam("new", *sheet, "--notch", "2mm", "--half-span", "50mm")
    expect(code == 0 and "warning: laminate does not take --half-span, --notch: not used" in error, f"numbers that do nothing: {error}")
    expect_error(delam("new", "enf", *good), 2, "enf needs --half-span .or --span., --GIIc as well")
    code, _, error = delam("new", "dbc", *good)
    expect(code == 2 and "dbc" in error and "dcb" in error, "an unknown kind")
    scene, _, _ = made("dcb", good)
    expect_error(delam("new", "dcb", *good, "--out", scene), 2, "is there already; --replace")


def places():
    """The crack stays before the load in the middle; the notch ends at a pair; units are not told that nobody chose."""
    sheet = [*PLY, "--arm", "2mm", "--half-span", "50mm", "--GIIc", "750J/m2"]
    expect_error(delam("new", "enf", *sheet, "--notch", "55mm"), 2, "--notch 55 mm is not allowed: less than the half span of 50 mm")
    expect_error(delam("new", "enf", *sheet, "--notch", "40mm", "--growth", "30mm"), 2,
                 "--growth 30 mm is not allowed: less than 10 mm")
    _, text, _ = made("enf", [*sheet, "--notch", "45mm"])
    expect("and from 49.5 mm" in text, f"the growth ends before the middle: {text}")
    good = [*PLY, *KINDS["dcb"][0].split()]
    _, _, error = made("dcb", [*good, "--normal-strength", "57MPa", "--growth", "30mm"])
    expect("between two pairs" not in error, f"the notch ends at a pair: {error}")
    for toughness, value in (("250kJ/m2", "2.5e+05 J/m2"), ("0.25J/m2", "0.25 J/m2")):
        _, _, error = delam("new", "dcb", *good[:-1], toughness)
        expect(f"--GIc {toughness} is {value}, and specimens have 40 to 6000 J/m2: 250J/m2 may be meant" in error and "[units]" not in error,
               f"a toughness of another unit: {error}")
    _, _, error = delam("new", "dcb", *(word if word != "1.5mm" else "15mm" for word in good))
    expect("3 to 5 mm, both arms together, for this toughness and notch; it is 30 mm: --arm 1.5mm may be meant" in error, f"an arm: {error}")
    _, _, error = delam("new", "dcb", *(word if word != "140GPa" else "140MPa" for word in good))
    expect("--E1 140MPa is 0.14 GPa" in error and ": 140GPa may be meant" in error, f"a modulus: {error}")
    for kind, sheet in {**{kind: [*PLY, *one[0].split()] for kind, one in KINDS.items()},
                        **{kind: one.split() for kind, one in OTHERS.items()}}.items():
        _, _, error = made(kind, sheet, "--replace")
        expect("may be meant" not in error and "specimens have" not in error, f"{kind}: usual numbers are not told: {error}")
    thick = [word if word != "1.5mm" else "3mm" for word in good]
    expect_error(delam("new", "dcb", *thick), 2, "--arm 3mm is one arm, which makes a specimen of 6 mm; .* --thickness 3mm if that is the whole")
    whole = [{"--arm": "--thickness", "1.5mm": "3mm"}.get(word, word) for word in good]
    texts = [delam("new", "dcb", *sheet)[1].split("\n", 1)[1] for sheet in (good, whole)]
    expect(texts[0] and texts[0] == texts[1], "the whole thickness instead of that of an arm")
    thick = [{"--arm": "--thickness", "1.5mm": "6mm"}.get(word, word) for word in good]
    code, _, error = delam("new", "dcb", *thick)
    expect(code == 0 and "it is 6 mm" in error, f"a thick specimen that is meant: {error}")
    _, text, _ = made("mmb", [*PLY, *KINDS["mmb"][0].split()])
    expect("toughness 372.2 J/m2" in text, f"the toughness of a mixed test: {text}")


def proposals():
    """What the sheet leaves out and the scene has is said, in the scene and on the terminal, with its value; what the sheet has
    is not. Strengths of a laminate decide when its edges delaminate: a warning says so, and what it advises is resolved."""
    good = [*PLY, *KINDS["dcb"][0].split()]
    scene, text, error = made("dcb", [word for word in good if word not in ("--nu12", "0.3", "--nu23", "0.45")])
    about, comments = tomllib.loads(read(scene).decode()), " ".join(read(scene).decode().replace("\n# ", " ").split())
    strength = about["laws"][0]["normal_strength"]
    for said in (" ".join(text.split()), comments):
        expect("nu12 = 0.3, nu23 = 0.45, the toughness of mode II is that of mode I, 0.25 N/mm: not in the sheet (--nu12, --nu23, --GIIc)"
               in said and f"{strength:g} MPa in opening" in said and "eta" not in said, f"what is proposed: {said}")
    whole = [*good, "--GIIc", "0.7N/mm", "--eta", "2", "--normal-strength", "30MPa", "--shear-strength", "50MPa"]
    scene, text, error = made("dcb", whole, "--replace")
    expect("Proposed" not in read(scene).decode() and "not in the sheet" not in text + error, f"nothing is: {text}")
    sheet = ("--layup 0/90/90/0 --ply 0.5mm --width 6mm --length 2mm --E1 126GPa --E2 11GPa --G12 6.6GPa --GIc 220J/m2 --GIIc 600J/m2 "
             "--strain 1%").split()
    scene, _, error = made("laminate", sheet)
    law = tomllib.loads(read(scene).decode())["laws"][0]
    said = f"strengths of {law['normal_strength']:g} MPa in opening and {law['tangential_strength']:g} MPa in shear are proposed"
    expect("warning: " + said in error and said in " ".join(read(scene).decode().replace("\n# ", " ").split()), f"a laminate: {error}")
    advice = re.search(r"for example (--normal-strength \S+ --shear-strength \S+ --cell [\d.]+mm)", error)[1].split()
    scene, _, error = made("laminate", [*sheet, *advice], "--replace")
    expect("proposed" not in error and "shorter than" not in error, f"what it advises is resolved: {error}")


def standards():
    """Each sheet breaks one rule, and the good one none: no rules exclude each other."""
    for kind, changes, wanted in (
            ("dcb", {}, None), ("dcb", {"--arm": "1mm"}, "a thickness of 3 to 5 mm"), ("dcb", {"--notch": "30mm"}, "a notch of about"),
            ("dcb", {"--GIc": "5kJ/m2"}, "a thickness of 3.7 to 5 mm"),
            ("dcb", {"--GIc": "15kJ/m2"}, "a thickness of 5.3 mm at least"), ("dcb", {"--GIc": "15kJ/m2", "--arm": "2.7mm"}, None),
            ("enf", {}, None), ("enf", {"--notch": "36mm"}, "a notch of 30 mm from the support; it is 36 mm, from which the crack grows stably"),
            ("enf", {"--notch": "25mm"}, "a notch of 30 mm from the support; it is 25 mm"),
            ("mmb", {"--half-span": "60mm", "--notch": "20mm"}, "a notch of about half of the half span, 24 to 36 mm; it is 20 mm"), ("enf", {"--half-span": "60mm"}, "a half span of 50 mm"),
            ("mmb", {}, None), ("mmb", {"--lever": "20mm"}, "a share of mode II"), ("4enf", {"--notch": "22mm"}, "a notch that ends between the noses and a thickness away from them, from 24 to 76 mm; it is 22 mm"),
            ("slb", {"--growth": "30mm"}, "a crack shorter than the half span")):
        words = [*PLY, *KINDS[kind][0].split()]
        for key, value in changes.items():
            words = words + [key, value] if key not in words else [
                value if i and words[i - 1] == key else word for i, word in enumerate(words)]
        _, text, error = made(kind, words)
        expect(("the crack jumps at the peak" in text) == (kind == "enf" and changes.get("--notch") != "36mm"), f"{kind} {changes}: {text}")
        asks = [line for line in error.splitlines() if "asks for" in line]
        expect(not asks if wanted is None else any(wanted in line for line in asks), f"{kind} {changes}: {asks}")


def print_pairs():
    """Peaks over corrected beam theory with half and twice of the pairs in the process zone."""
    for kind, (sheet, theory, _) in KINDS.items():
        scene, _, _ = made(kind, [*PLY, *sheet.split()])
        cells = int(re.search(r"^divisions = (\d+)", read(scene).decode(), re.M)[1])
        for factor in (0.5, 1, 2):
            rows, _ = rows_of(scene, "--set", f"geometry.divisions={int(factor * cells)}")
            print(f"{kind}: {factor} of the cells, peak {1e3 * max(float(row['reaction']) for row in rows) / theory:.4f}")


if sys.argv[1:] == ["pairs"]:
    print_pairs()
else:
    units()
    flaws()
    places()
    proposals()
    standards()
    peaks()
finish()
