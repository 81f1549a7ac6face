# SPDX-License-Identifier: BSD-3-Clause
"""Wedges and pyramids of decks: two blocks of the size 1 on each other, a layer of cohesive elements between them."""
import csv
import os

from support import delam, expect, expect_error, finish, folder, write

YOUNG, STIFFNESS, HEIGHT = 1000.0, 1000.0, 2.0
CORNERS = [(0, 0), (1, 0), (1, 1), (0, 1)]
LOW = [(x, y, z) for z in (0, 1) for x, y in CORNERS]  # nodes 1 .. 8
UP = [(x, y, z) for z in (1, 2) for x, y in CORNERS]  # nodes 9 .. 16
CENTRES = [(0.5, 0.5, 0.5), (0.5, 0.5, 1.5)]  # nodes 17 and 18
# The triangles of a wedge as Abaqus lists them: S1 first, seen counter-clockwise from S2.
WEDGES = [(1, 2, 3, 5, 6, 7), (1, 3, 4, 5, 7, 8)]
PYRAMIDS = [(1, 2, 3, 4), (5, 8, 7, 6), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 8, 4), (4, 8, 5, 1)]


def deck(kind, top, load="Top, 3, 3, 0.002\n"):
    nodes = dict(enumerate(LOW + UP + (CENTRES if kind == "C3D5" else []), 1))
    below = {"C3D6": WEDGES, "C3D5": [(*face, 17) for face in PYRAMIDS], "C3D8": [tuple(range(1, 9))]}[kind]
    above = [tuple(18 if n == 17 else n + 8 for n in cell) for cell in below]
    text = "*Heading\nblocks\n*Node\n" + "".join(f"{n}, {x}, {y}, {z}\n" for n, (x, y, z) in nodes.items())
    for name, first, cells in (("Low", 1, below), ("Up", 101, above)):
        text += f"*Element, type={kind}, elset={name}\n"
        text += "".join(f"{first + i}, " + ", ".join(map(str, cell)) + "\n" for i, cell in enumerate(cells))
    layer = [(5, 6, 7, 9, 10, 11), (5, 7, 8, 9, 11, 12)] if kind == "C3D6" else [(5, 6, 7, 8, 9, 10, 11, 12)]
    text += f"*Element, type={'COH3D6' if kind == 'C3D6' else 'COH3D8'}, elset=Coh\n"
    text += "".join(f"{201 + i}, " + ", ".join(map(str, cell)) + "\n" for i, cell in enumerate(layer))
    text += "*Cohesive section, elset=Coh, material=C, response=TRACTION SEPARATION\n1.\n"
    flat = {height: [n for n, at in nodes.items() if at[2] == height] for height in (0, 2)}
    text += "*Nset, nset=Bottom\n" + "".join(f"{n},\n" for n in flat[0])
    text += "*Nset, nset=Top\n" + "".join(f"{n},\n" for n in flat[2])
    text += "*Nset, nset=Origin\n1,\n*Nset, nset=Side\n2,\n"
    text += f"*Surface, name=Lid\n{top}\n"
    text += "*Solid section, elset=Low, material=M\n,\n*Solid section, elset=Up, material=M\n,\n"
    text += f"*Material, name=M\n*Elastic\n{YOUNG}, 0.3\n*Material, name=C\n*Elastic, type=TRACTION\n"
    text += f"{STIFFNESS}, {STIFFNESS}, {STIFFNESS}\n*Damage initiation, criterion=QUADS\n10., 10., 10.\n"
    text += "*Damage evolution, type=ENERGY\n1.,\n*Step\n*Static\n1., 1., 1., 1.\n*Boundary\nBottom, 3\nOrigin, 1, 2\nSide, 2\n"
    return text + load + "*End step\n"


def last_row(text):
    place = folder()
    out = os.path.join(place, "out")
    code, said, error = delam("run", write(text, "deck.inp", place), "--out", out)
    expect(code == 0, f"exit {code}: {error.strip()[:400]}")
    if code != 0:
        return None
    with open(os.path.join(out, "history.csv"), newline="", encoding="utf-8") as file:
        return {k: float(v) for k, v in list(csv.DictReader(file))[-1].items() if k not in ("solution", "mixity_rule")}


def near(what, value, wanted):
    expect(abs(value - wanted) <= 1e-9 * abs(wanted), f"{what}: {value}, {wanted} is expected")


# Stress t = u / (h/E + 1/k); the blocks contract freely and alike.
STRESS = 0.002 / (HEIGHT / YOUNG + 1 / STIFFNESS)
# Sides: of the wedges S2 is the upper triangle, of the second of the pyramids S1 is its base.
for kind, top in (("C3D6", "Up, S2"), ("C3D5", "102, S1"), ("C3D8", "Up, S2")):
    row = last_row(deck(kind, top))
    if row is not None:
        near(f"{kind}: stored in the blocks", row["stored_bulk"], STRESS ** 2 * HEIGHT / (2 * YOUNG))
        near(f"{kind}: stored in the layer", row["stored_interface"], STRESS ** 2 / (2 * STIFFNESS))
    row = last_row(deck(kind, top, "*Dsload\nLid, P, -2.\n"))
    if row is not None:
        near(f"{kind}: pulled by a pressure", row["stored_bulk"], 4 * HEIGHT / (2 * YOUNG))

# One C3D27, whose nodes stand as Abaqus lists them: corners, sides, the centre, the centres of S1 to S6. A pressure on
# each side in turn has the total force of its area: its nodes are those of this side.
EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
SIDES = [(0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0)]
PLACES = list(LOW)
for corners in [*EDGES, range(8), *SIDES]:
    PLACES.append(tuple(sum(LOW[c][k] for c in corners) / len(corners) for k in range(3)))
for number, side in enumerate(SIDES, 1):
    axis = next(k for k in range(3) if len({LOW[c][k] for c in side}) == 1)
    end = LOW[side[0]][axis]
    text = "*Heading\none cell\n*Node\n" + "".join(f"{n}, {x}, {y}, {z}\n" for n, (x, y, z) in enumerate(PLACES, 1))
    text += "*Element, type=C3D27, elset=All\n1, " + ", ".join(map(str, range(1, 16))) + ",\n" + ", ".join(map(str, range(16, 28)))
    text += "\n*Nset, nset=Far\n" + "".join(f"{n},\n" for n, at in enumerate(PLACES, 1) if at[axis] == 1 - end)
    text += f"*Surface, name=Face\nAll, S{number}\n*Solid section, elset=All, material=M\n,\n"
    text += f"*Material, name=M\n*Elastic\n{YOUNG}, 0.0\n*Step\n*Static\n1., 1., 1., 1.\n*Boundary\nFar, 1, 3\n*Dsload\nFace, P, -2.\n*End step\n"
    row = last_row(text)
    if row is not None:
        near(f"C3D27, S{number}", row["stored_bulk"], 4 / (2 * YOUNG))
expect_error(delam("import", write(deck("C3D6", "Up, S6"), "deck.inp")), 2, r"S6: element 101 \(C3D6\) has sides S1 \.\. S5")
finish()
