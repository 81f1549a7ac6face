# SPDX-License-Identifier: BSD-3-Clause
"""A deck of two instances of one part as Abaqus/CAE writes it, in the variants that people make: each has the answer of the
plain one, or is told in one line, with the line of the deck, what to do."""
import json
import math
import os

import deck_runs
from support import delam, expect, expect_error, finish, folder, write

NODES = "".join(f"{1 + i + 5 * j:7d}, {float(i):12.5f}, {float(j):12.5f}\n" for j in (0, 1) for i in range(5))
CELLS = "".join(f"{i}, {i}, {i + 1}, {i + 6}, {i + 5}\n" for i in range(1, 5))
HELD = "Bottom, 2, 2\nCorner, 1, 1\nTop, 1, 1\n"
PROPERTY = """*Surface Interaction, name=IntProp-1
1.,
*Friction, slip tolerance=0.005
0.3,
*Surface Behavior, pressure-overclosure=HARD
*Cohesive Behavior, eligibility=ORIGINAL CONTACTS
1000., 1000., 1000.
*Damage Initiation, criterion=QUADS
1., 1., 1.
*Damage Evolution, type=ENERGY, mixed mode behavior=BK, power=1.45
0.01, 0.01, 0.01
"""
PAIR = "*Contact Pair, interaction=IntProp-1, small sliding, type=SURFACE TO SURFACE\nUp, Low\n"
GENERAL = """*Contact
*Contact Inclusions, ALL EXTERIOR
*Contact Property Assignment
 ,  , IntProp-1
*Surface Property Assignment, property=GEOMETRIC CORRECTION
*Contact Initialization Assignment
Low , Up , CInit-1
*Contact Initialization Data, name=CInit-1, SEARCH ABOVE=0.01
*Contact Formulation, type=PURE MASTER-SLAVE
Low , Up , MASTER
"""


def step(boundary=HELD + "Top, 2, 2, 0.03\n", before="", after=""):
    return (f"{before}*Step, name=Step-1, nlgeom=NO, inc=1000\n*Static\n0.1, 1., 1e-05, 0.1\n*Boundary\n{boundary}{after}"
            "*Restart, write, frequency=0\n*Output, field\n*Node Output\nRF, U\n*Element Output, directions=YES\nLE, S\n"
            "*Output, history, variable=PRESELECT\n*End Step\n")


def deck(interactions=PROPERTY + PAIR, steps=None, assembly=""):
    return f"""*Heading
** Job name: Job-1 Model name: Model-1
*Preprint, echo=NO, model=NO, history=NO, contact=NO
*Part, name=Block
*Node
{NODES}*Element, type=CPS4R
{CELLS}*Nset, nset=Set-1, generate
  1, 10,  1
*Elset, elset=Set-1, generate
 1, 4,  1
*Solid Section, elset=Set-1, material=M
,
*End Part
*Assembly, name=Assembly
*Instance, name=Block-1, part=Block
*End Instance
*Instance, name=Block-2, part=Block
          0.,           1.,           0.
*End Instance
*Nset, nset=Bottom, instance=Block-1, generate
 1, 5, 1
*Nset, nset=Corner, instance=Block-1
 1,
*Nset, nset=Top, instance=Block-2, generate
 6, 10, 1
*Elset, elset=_Low_S3, internal, instance=Block-1, generate
 1, 4, 1
*Surface, type=ELEMENT, name=Low
_Low_S3, S3
*Elset, elset=_Up_S1, internal, instance=Block-2, generate
 1, 4, 1
*Surface, type=ELEMENT, name=Up
_Up_S1, S1
{assembly}*End Assembly
*Material, name=M
*Elastic
1000., 0.3
{interactions}{steps or step()}"""


def history(text):
    rows, said, _ = deck_runs.history(text)
    return [row["reaction"] for row in rows], said


def independent(text):
    """The same deck with the mesh within the instances, whose data lines move it all the same."""
    begin, end = text.index("*Node\n"), text.index("*End Part")
    return (text[:begin] + text[end:].replace("*End Instance", text[begin:end] + "*End Instance"))


def line_of(text, card, which=0):
    """The line of the data behind a card."""
    return 2 + [k for k, line in enumerate(text.splitlines()) if line == card][which]


plain, _ = history(deck())
expect(len(plain) == 11 and max(plain) > 3.5, f"{plain}")
POINT = "*Node\n1000, 2., 3.\n*Nset, nset=RP\n1000,\n*Equation\n2\nTop, 2, 1.\nRP, 2, -1.\n"
for what, text in (
        ("supports that overlap", deck(PROPERTY + PAIR + "*Boundary\nBottom, 2, 2\nCorner, PINNED\n",
                                       step("Top, 1, 1\nTop, 2, 2, 0.03\n"))),
        ("loads that overlap", deck(assembly="*Nset, nset=Half, instance=Block-2\n 6, 7, 8\n",
                                    steps=step(HELD + "Half, 2, 2, 0.03\nTop, 2, 2, 0.03\n"))),
        ("general contact", deck(PROPERTY, step(before=GENERAL))),
        ("an equation", deck(assembly=POINT, steps=step(HELD + "RP, 2, 2, 0.03\n"))),
        ("independent instances", independent(deck())),
        ("the ends of lines of DOS, comments between data", deck().replace("1000., 0.3\n", "** moduli\n1000., 0.3\n").replace(
            "Top, 1, 1\n", "**\nTop, 1, 1\n").replace("\n", "\r\n"))):
    found, said = history(text)
    expect(len(found) == len(plain) and all(math.isclose(a, b, rel_tol=1e-8, abs_tol=1e-9) for a, b in zip(found, plain)),
           f"{what}: {found}, {plain} is expected")
    if what == "general contact":
        expect("no faces are moved" in said and "*CONTACT FORMULATION" in said, f"what is changed and left out: {said}")

# What the library says of what was made of a card names the card's line.
apart = deck(assembly="*Nset, nset=Half, instance=Block-2\n 6, 7, 8\n",
             steps=step(HELD + "Top, 2, 2, 0.03\nHalf, 2, 2, 0.01\n"))
line = line_of(apart, "*Boundary") + 4
for command in (["check"], ["import"], ["run", "--out", os.path.join(folder(), "out")]):
    if command == ["import"]:
        code, scene, error = delam("import", write(apart, "deck.inp"))
        expect(code == 0 and f"deck.inp:{line}: *BOUNDARY\n[[loads]]" in scene, f"a comment before its table: {scene} {error}")
    else:
        expect_error(delam(command[0], write(apart, "deck.inp"), *command[1:]), 2,
                     rf"deck\.inp:{line}: \*BOUNDARY: loads\[1\]: .* prescribed along")
code, said, _ = delam("check", "--json", write(apart, "deck.inp"))
error = json.loads(said)["errors"][0]
expect(code == 2 and error["line"] == line and error["key"] == "*BOUNDARY: loads[1]" and error["file"].endswith("deck.inp"),
       f"{error}")
weak = deck(PROPERTY.replace("0.01, 0.01, 0.01", "1e-5, 0.01, 0.01") + PAIR)
line = line_of(weak, "*Cohesive Behavior, eligibility=ORIGINAL CONTACTS") - 1
expect_error(delam("check", write(weak, "deck.inp")), 2, rf"deck\.inp:{line}: \*COHESIVE BEHAVIOR: laws\[0\]")

for after, pattern in (("*Model Change, type=CONTACT PAIR, remove\nUp, Low\n", "end it with the step before"),
                       ("*Debond, slave=Up, master=Low\n", r"give \*COHESIVE BEHAVIOR"),
                       ("*Dload\n, GRAV, 9.81, 0., -1.\n", "forces on the volume stay out")):
    text = deck(steps=step(after=after))
    line = 1 + text.splitlines().index(after.splitlines()[0])
    expect_error(delam("import", write(text, "deck.inp")), 2, rf"deck\.inp:({line}|{line + 1}): \*", pattern)
expect_error(delam("import", write(deck(PROPERTY + PAIR + "*Clearance, master=Low, slave=Up, value=0.1\n"), "deck.inp")), 2,
             r"deck\.inp:\d+: \*CLEARANCE: ", "ADJUST=")
finish()
