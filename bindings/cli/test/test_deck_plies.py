# SPDX-License-Identifier: BSD-3-Clause
"""Composites of several plies in a cell: a strip of such cells against the same strip whose plies have elements and
sections of their own."""
import csv
import math
import os

from support import delam, expect, expect_error, finish, folder, write

NX, LENGTH, WIDTH = 4, 4.0, 1.0
PLIES = [(0.5, 0.0), (1.0, 90.0), (0.25, 30.0), (0.25, -30.0)]  # thickness and angle from the bottom up: unsymmetric
HEIGHT = sum(thickness for thickness, _ in PLIES)
HEIGHTS = [sum(thickness for thickness, _ in PLIES[:k]) for k in range(len(PLIES) + 1)]
MATERIAL = "*MATERIAL, NAME=M\n*ELASTIC, TYPE=ENGINEERING CONSTANTS\n10000., 900., 900., 0.3, 0.3, 0.4, 500., 500.\n320.\n"
AXES = "*ORIENTATION, NAME=O\n1., 0., 0., 0., 1., 0.\n3, 0.\n"


def node(i, j, level):
    return 1 + i + (NX + 1) * (j + 2 * level)


def layup(plies, scale=1.0):
    return "".join(f"{scale * thickness}, 3, M, {angle}, P{k}\n" for k, (thickness, angle) in enumerate(plies))


def deck(apart, loads, cell="SC8R", section=None, angles=None):
    """apart: a layer of elements for each ply; else one layer whose cells have all plies."""
    levels = list(range(len(PLIES) + 1)) if apart else [0, len(PLIES)]
    text = "*HEADING\na strip\n*NODE\n" + "".join(
        f"{node(i, j, k)}, {i * LENGTH / NX}, {j * WIDTH}, {HEIGHTS[k]!r}\n" for k in levels for j in (0, 1)
        for i in range(NX + 1))
    sections = ""
    for n, (below, above) in enumerate(zip(levels, levels[1:])):
        text += f"*ELEMENT, TYPE={cell}, ELSET=E{n}\n"
        for i in range(NX):
            corners = [node(i + a, j, k) for k in (below, above) for a, j in ((0, 0), (1, 0), (1, 1), (0, 1))]
            text += f"{1 + i + NX * n}, {', '.join(map(str, corners))}\n"
        own = layup(PLIES[n:n + 1]) if apart else angles or layup(PLIES)
        sections += f"*SHELL SECTION, ELSET=E{n}, COMPOSITE, ORIENTATION=O, STACK DIRECTION=3\n{own}"
    text += "*NSET, NSET=HELD\n" + "".join(f"{node(0, j, k)},\n" for k in levels for j in (0, 1))
    text += "*NSET, NSET=END\n" + "".join(f"{node(NX, j, k)},\n" for k in levels for j in (0, 1))
    text += "*NSET, NSET=EDGE\n" + "".join(f"{node(NX, j, k)},\n" for k in (0, len(PLIES)) for j in (0, 1))
    text += "*SURFACE, NAME=FACE\n" + "".join(f"{NX * (n + 1)}, S4\n" for n in range(len(levels) - 1))
    text += "*SURFACE, NAME=LID\n" + "".join(f"E{len(levels) - 2}, S2\n")
    return (text + AXES + (section or sections) + MATERIAL +
            f"*STEP\n*STATIC\n1., 1., 1e-5, 1.\n*BOUNDARY\nHELD, 1, 3\n{loads}*END STEP\n")


def last(text):
    place = folder()
    out = os.path.join(place, "out")
    code, said, error = delam("run", write(text, "deck.inp", place), "--out", out)
    expect(code == 0, f"exit {code}: {error.strip()[:400]}")
    if code != 0:
        return {}, said + error
    with open(os.path.join(out, "history.csv"), newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))[-1], said + error


def energy(text):
    return float(last(text)[0].get("stored_bulk", "nan"))


# Sets of nodes and of faces have what lies between their corners; forces at nodes stay those of the deck's nodes.
for what, loads in (("displacements of a set", "END, 3, 3, 0.1\n"), ("a traction", "*DSLOAD\nFACE, TRVEC, 2., 1., 0., 1.\n"),
                    ("a pressure", "*DSLOAD\nLID, P, 0.3\n"), ("forces at nodes", "*CLOAD\nEDGE, 3, 1.5\n"),
                    ("heat", "*TEMPERATURE\nALL, 20.\n")):
    if "TEMPERATURE" in loads:
        every = "*NSET, NSET=ALL, ELSET={}\n*EXPANSION\n1e-4,\n*STEP"
        names = ["E0", ",".join(f"E{k}" for k in range(len(PLIES)))]
        texts = [deck(apart, loads, section=None).replace(
            "*STEP", "*ELSET, ELSET=CELLS\n" + names[apart] + "\n" + every.format("CELLS"), 1) for apart in (False, True)]
    else:
        texts = [deck(apart, loads) for apart in (False, True)]
    one, own = map(energy, texts)
    expect(own > 0 and math.isclose(one, own, rel_tol=1e-8), f"{what}: {one}, {own} is expected")

# Thicknesses are scaled to the cell; SYMMETRIC has the plies up to the middle.
pull = "END, 3, 3, 0.1\n"
whole = energy(deck(False, pull))
expect(math.isclose(energy(deck(False, pull, angles=layup(PLIES, 7.0))), whole, rel_tol=1e-12), "scaled thicknesses")
half = [(1.0, 0.0), (1.0, 45.0)]
head = "*SHELL SECTION, ELSET=E0, COMPOSITE, ORIENTATION=O, SYMMETRIC\n"
mirrored = energy(deck(False, pull, section=head + layup(half)))
expect(math.isclose(mirrored, energy(deck(False, pull, angles=layup(half + half[::-1]))), rel_tol=1e-12), "SYMMETRIC")
expect(not math.isclose(mirrored, energy(deck(False, pull, angles=layup(half))), rel_tol=1e-3), "and without is another")
_, said = last(deck(False, pull))
expect('"E0": 4 cells of 4 plies, one for each ply here: 16 cells' in said, said)

# What cannot be split is named with its line.
two = "*ELSET, ELSET=FIRST\n1, 2\n*ELSET, ELSET=REST\n3, 4\n"
for section, pattern in (
        (two + f"*SHELL SECTION, ELSET=FIRST, COMPOSITE, ORIENTATION=O\n{layup(PLIES)}"
         f"*SHELL SECTION, ELSET=REST, COMPOSITE, ORIENTATION=O\n{layup(PLIES[:1])}", 'SHELL SECTION: "FIRST" has 4 plies.*same plies'),
        (two + f"*SHELL SECTION, ELSET=FIRST, COMPOSITE, ORIENTATION=O\n{layup(PLIES)}"
         f"*SHELL SECTION, ELSET=REST, COMPOSITE, ORIENTATION=O\n{layup(PLIES[::-1])}", 'has 4 plies.*same plies'),
        (f"*SHELL SECTION, ELSET=E0, COMPOSITE\n{layup(PLIES)}", "need the ORIENTATION= of the section"),
        ("*SHELL SECTION, ELSET=E0, COMPOSITE, ORIENTATION=O\n1., 3, M, 0.\n1., 3, GLASS, 0.\n", 'of "M" and of "GLASS"'),
        ("*SHELL SECTION, ELSET=E0, COMPOSITE, ORIENTATION=O\n1., 3, M, 0.\n0., 3, M, 0.\n", r"thickness 0: must be > 0"),
        ("*SHELL SECTION, ELSET=E0, COMPOSITE, ORIENTATION=O\n1., 3, M, O\n1., 3, M, 0.\n", "the angle of a ply"),
        ("*SHELL SECTION, ELSET=E0, COMPOSITE, ORIENTATION=O, STACK DIRECTION=1\n1., 3, M\n", "STACK DIRECTION=1")):
    expect_error(delam("import", write(deck(False, pull, section=section), "deck.inp")), 2, r"deck\.inp:\d+: \*", pattern)
finish()
