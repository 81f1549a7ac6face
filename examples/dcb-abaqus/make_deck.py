#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""make_deck.py > dcb-abaqus.inp: writes the deck of a double cantilever beam with cohesive elements; in N and mm.

Two arms of 50 mm x 1.5 mm lie on each other. The nodes where they meet are doubled, and from the notch of 20 mm on,
cohesive elements without thickness join them.
"""
COLUMNS, ROWS, LENGTH, HEIGHT, NOTCH = 100, 2, 50.0, 1.5, 20.0
PER_ARM = (COLUMNS + 1) * (ROWS + 1)


def node(arm, i, j):
    """Number of the node i from the left and j from the bottom of an arm (0: the lower one)."""
    return 1 + arm * PER_ARM + j * (COLUMNS + 1) + i


def square(a, b, i, j, k):
    """Four nodes, counter-clockwise, from row j of arm a to row k of arm b."""
    return node(a, i, j), node(a, i + 1, j), node(b, i + 1, k), node(b, i, k)


def table(rows, first=1):
    return "".join(f"{number}, {', '.join(map(str, row))}\n" for number, row in enumerate(rows, first))


places = [(LENGTH * i / COLUMNS, HEIGHT * (arm + j / ROWS)) for arm in (0, 1) for j in range(ROWS + 1)
          for i in range(COLUMNS + 1)]
cells = [square(arm, arm, i, j, j + 1) for arm in (0, 1) for j in range(ROWS) for i in range(COLUMNS)]
glue = [square(0, 1, i, ROWS, 0) for i in range(COLUMNS) if LENGTH * i / COLUMNS >= NOTCH]
clamp = [node(arm, COLUMNS, j) for arm in (0, 1) for j in range(ROWS + 1)]

print(f"""*HEADING
Double cantilever beam with cohesive elements; N, mm
*NODE
{table(places)}*ELEMENT, TYPE=CPE4I, ELSET=ARMS
{table(cells)}*ELEMENT, TYPE=COH2D4, ELSET=GLUE
{table(glue, len(cells) + 1)}*NSET, NSET=CLAMP
{', '.join(map(str, clamp))}
*NSET, NSET=TOP
{node(1, 0, ROWS)}
*NSET, NSET=BOTTOM
{node(0, 0, 0)}
*ORIENTATION, NAME=ALONG
1., 0., 0., 0., 1., 0.
3, 0.
*SOLID SECTION, ELSET=ARMS, MATERIAL=PLY, ORIENTATION=ALONG
25.
*COHESIVE SECTION, ELSET=GLUE, MATERIAL=RESIN, RESPONSE=TRACTION SEPARATION, THICKNESS=SPECIFIED
1., 25.
*MATERIAL, NAME=PLY
*ELASTIC, TYPE=ENGINEERING CONSTANTS
135000., 9000., 9000., 0.3, 0.3, 0.45, 5000., 5000.,
3103.4
*MATERIAL, NAME=RESIN
*ELASTIC, TYPE=TRACTION
3e5, 3e5, 3e5
*DAMAGE INITIATION, CRITERION=QUADS
20., 35., 35.
*DAMAGE EVOLUTION, TYPE=ENERGY, MIXED MODE BEHAVIOR=BK, POWER=2.
0.25, 0.75, 0.75
*BOUNDARY
CLAMP, ENCASTRE
*STEP, NAME=OPEN, NLGEOM=NO, INC=1000
*STATIC
0.02, 1., 1e-6, 0.02
*BOUNDARY
TOP, 2, 2, 1.2
BOTTOM, 2, 2, -1.2
*OUTPUT, FIELD, VARIABLE=PRESELECT
*END STEP""")
