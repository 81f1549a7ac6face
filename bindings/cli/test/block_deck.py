# SPDX-License-Identifier: BSD-3-Clause
"""A deck of two blocks of an elastic material upon each other, whose answers are known in closed form, and its runs."""
import deck_runs

YOUNG, POISSON, STRENGTH, STIFFNESS = 1000.0, 0.3, 1.0, 1000.0

# Two rows of four square cells; the upper one has nodes of its own where they meet.
NODES = [(1 + i + 5 * j + (91 if j > 1 else 0), float(i), float(j - (j > 1))) for j in range(4) for i in range(5)]
COHESIVE = ("*Element, type=COH2D4, elset=Coh\n" +
            "".join(f"{201 + i}, {6 + i}, {7 + i}, {103 + i}, {102 + i}\n" for i in range(4)))
SECTION = "*Cohesive section, elset=Coh, material=C, response=TRACTION SEPARATION\n1.\n"
LAW = (f"*Material, name=C\n*Elastic, type=TRACTION\n{STIFFNESS}, {STIFFNESS}, {STIFFNESS}\n"
       f"*Damage initiation, criterion=QUADS\n{STRENGTH}, {STRENGTH}, {STRENGTH}\n"
       "*Damage evolution, type=ENERGY\n0.01,\n")
SURFACES = "*Surface, name=Lower\nLow, S3\n*Surface, name=Upper\nUp, S1\n"


def cells(name, first, below):
    return (f"*Element, type=CPS4, elset={name}\n" +
            "".join(f"{first + i}, {below + i}, {below + i + 1}, {below + i + 6}, {below + i + 5}\n" for i in range(4)))


def deck(cohesive=True, extra="", elastic=f"*Elastic\n{YOUNG}, {POISSON}\n", static="*Static\n0.1, 1., 1e-5, 0.1\n",
         loads="Top, 2, 2, 0.03\n", before="", after="", held="Bottom, 2\n1, 1\nTop, 1\n", nodes=None):
    text = before + "*Heading\na block upon another\n*Node\n"
    text += "".join(f"{n}, {x}, {y}\n" for n, x, y in nodes or NODES)
    text += cells("Low", 1, 1) + cells("Up", 101, 102) + (COHESIVE if cohesive else "")
    text += "*Nset, nset=Bottom, generate\n1, 5\n*Nset, nset=Top, generate\n107, 111\n*Nset, nset=All\nBottom, Top\n"
    text += "*Solid section, elset=Low, material=M\n1.\n*Solid section, elset=Up, material=M\n1.\n"
    text += (SECTION if cohesive else "") + "*Material, name=M\n" + elastic + (LAW if cohesive else "") + extra
    return text + f"*Step\n{static}*Boundary\n{held}{loads}{after}*End step\n"


def history(text, *words):
    """Rows of history.csv, and what is said."""
    rows, said, _ = deck_runs.history(text, *words)
    return rows, said
