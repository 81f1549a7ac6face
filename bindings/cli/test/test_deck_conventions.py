# SPDX-License-Identifier: BSD-3-Clause
"""Whole decks as their writers write them: a bar of two blocks that is pulled apart, by twenty conventions with one answer,
and a double cantilever beam as Abaqus/CAE writes it, with a cohesive layer that is meshed apart and tied."""
import math
import os
import re

from bar_deck import (ACROSS, CFRP, GLUE, HEIGHT, HELD, LENGTH, PULL, STEP, STIFFNESS, STRENGTH, SURFACES, THICKNESS, TOUGHNESS,
                      YOUNG, bar, dissipated, pulled, stress)
from deck_runs import close, history, refused
from support import delam, draw, expect, expect_error, finish, folder, write


def check_ways_to_write():
    """Upper and lower case, ends of lines, tabs, names in quotes, files that are included, sections without a number."""
    pulled("as written", bar())
    pulled("lower case, tabs, CRLF", bar().lower().replace(", ", ",\t").replace("\n", "\r\n"))
    pulled("blanks and comments", bar().replace("*NODE", "**\n** NODES\n*Node").replace(", ", " ,   "))
    pulled("names in quotes", bar().replace("ELSET=G", 'ELSET="Glue layer"'))
    pulled("a file that is included", bar(after="*INCLUDE, INPUT=step.inp\n"), step_inp=STEP)
    pulled("keywords cut short at an option", bar().replace("TYPE=CPS4, ELSET", "ELSET").replace(
        "*ELEMENT, ELSET", "*ELEMENT, TYPE=CPS4, ELSET"))
    pulled("parameters", bar(before="*PARAMETER\nstroke = 0.02\nhalf = stroke/2.\n",
                             after=STEP.replace(f"2, 2, {PULL}", "2, 2, <half>")))


def check_meshes_that_are_generated():
    nodes = "*NODE\n1, 0., 0.\n3, 2., 0.\n7, 0., 2.\n9, 2., 2.\n"
    copied = ("*NGEN, NSET=LOW\n1, 3, 1\n*NGEN, NSET=HIGH\n7, 9, 1\n")
    for wrong, pattern in (("LOW, MIDDLE, 2, 3", '"MIDDLE" is not there'), ("LOW, ALONE, 2, 3", '"LOW" has 3 nodes, "ALONE" has 1'),
                           ("LOW, HIGH, 2, 1", "occurs twice"), ("LOW, HIGH", "intervals and an increment")):
        refused(bar(mesh=nodes + copied + f"*NSET, NSET=ALONE\n1\n*NFILL, NSET=BLOCK\n{wrong}\n"), r"deck\.inp:\d+: \*NFILL", pattern)
    rows = "".join(f"*NODE\n{a}, 0., {y}\n{a + 2}, 2., {y}\n*NGEN\n{a}, {a + 2}, 1\n"
                   for a, y in ((1, 0), (4, 1), (7, 1.5), (101, 1.5), (104, 1.75), (107, 2)))
    cells = ("*ELEMENT, TYPE=CPS4, ELSET=A\n1, 1, 2, 5, 4\n*ELGEN, ELSET=A\n1, 2, 1, 1, 2, 3, 2\n"
             "*ELEMENT, TYPE=CPS4, ELSET=B\n11, 101, 102, 105, 104\n*ELGEN, ELSET=B\n11, 2, 1, 1, 2, 3, 2\n")
    pulled("generated nodes and elements", bar(mesh=rows + cells))


def check_materials():
    constants = f"*ELASTIC, TYPE=ENGINEERING CONSTANTS\n135000., {ACROSS}, {ACROSS}, 0.3, 0.3, 0.45, 5000., 5000.\n3100.\n"
    axes = "*ORIENTATION, NAME=O1, SYSTEM=RECTANGULAR\n1., 0., 0., 0., 1., 0.\n3, 0.\n"
    turned = axes.replace("1., 0., 0., 0., 1., 0.", "0., 1., 0., -1., 0., 0.")
    section = "".join(f"*SOLID SECTION, ELSET={name}, MATERIAL=CFRP, ORIENTATION=O1\n{THICKNESS},\n" for name in "AB")
    material = "*MATERIAL, NAME=CFRP\n"
    pulled("engineering constants", bar(section=section, material=axes + material + constants), ACROSS)
    pulled("fibres along the load", bar(section=section, material=turned + material + constants), 135000.0)
    pulled("a lamina", bar(material=material + f"*ELASTIC, TYPE=LAMINA\n135000., {ACROSS}, 0.3, 5000., 5000., 3100.\n"), ACROSS)
    controls = ("*SECTION CONTROLS, NAME=EC-1, HOURGLASS=ENHANCED, ELEMENT DELETION=YES, VISCOSITY=1e-5\n1., 1., 1.\n"
                + "".join(f"*SOLID SECTION, ELSET={name}, MATERIAL=CFRP, CONTROLS=EC-1\n{THICKNESS},\n" for name in "AB"))
    pulled("section controls, reduced integration", bar(cell="CPS4R", section=controls))
    pulled("a power law", bar(law=GLUE.replace("BK, POWER=1.75", "POWER LAW, POWER=1.")))
    others = {"SOFTENING=TABULAR": GLUE.replace("TYPE=ENERGY, MIXED MODE BEHAVIOR=BK, POWER=1.75",
                                                 "TYPE=DISPLACEMENT, SOFTENING=EXPONENTIAL").replace(
                                                     f"{TOUGHNESS}, 0.8, 0.8", "0.02, 2.")}
    for words, law in others.items():
        refused(bar(law=law), words)
    refused(bar(cohesive="RESPONSE=CONTINUUM\n,2.\n"), "RESPONSE=CONTINUUM", "TRACTION SEPARATION")


def check_loads():
    amplitude = "*AMPLITUDE, NAME=SAW, TIME=TOTAL TIME\n0., 0., 1., 1., 2., 0.2, 3., 2.\n"
    steps = "".join(f"*STEP, NAME=S{k}\n*STATIC\n0.1, 1.\n*BOUNDARY, AMPLITUDE=SAW\n{HELD}TOP, 2, 2, {PULL}\n*END STEP\n"
                    for k in range(3))
    rows, _, _ = history(bar(before=amplitude, after=steps))
    at = {round(row["time"], 9): row["reaction"] for row in rows}
    _, opened = stress(PULL)
    close("up", at.get(1.0, math.nan), LENGTH * stress(PULL)[0])
    close("and down along the secant", at.get(2.0, math.nan), LENGTH * stress(0.2 * PULL, opened=opened)[0])
    close("until the bar is in two", at.get(3.0, math.nan), 0.0)
    # A smooth step and inertia that is left out reach the same end.
    smooth = "*AMPLITUDE, NAME=SMOOTH, DEFINITION=SMOOTH STEP\n0., 0., 1., 1.\n"
    pulled("a smooth step", bar(before=smooth, after=STEP.replace("*BOUNDARY\n" + HELD, "*BOUNDARY\n" + HELD +
                                                                  "*BOUNDARY, AMPLITUDE=SMOOTH\n")))
    pulled("a quasi-static *DYNAMIC", bar(after=STEP.replace("*STATIC", "*DYNAMIC, APPLICATION=QUASI-STATIC, INITIAL=NO")))
    expect_error(delam("import", write(bar(after=STEP.replace("*STATIC\n0.1", "*DYNAMIC, EXPLICIT\n")), "deck.inp")), 2,
                 "explicit", r"\*STATIC")
    # A reference point that moves the upper edge, and a face by its elements.
    edge = "*SURFACE, TYPE=ELEMENT, NAME=EDGE\nB2, S3\n"
    point = "*COUPLING, CONSTRAINT NAME=C1, REF NODE=999, SURFACE=EDGE\n*KINEMATIC\n2, 2\n"
    pulled("a reference point", bar(before="*NODE\n999, 1., 2.5\n", after=edge + point + STEP.replace("TOP, 2", "999, 2")))
    # Stresses below the strength: a force on a node with equations, a pressure. What is stored is half of force times way;
    # the work of a load pattern of forces is the change of the energy with the potential of the loads, its negative.
    way = 20.0 * (HEIGHT / YOUNG + 1.0 / STIFFNESS)
    held = f"*STEP\n*STATIC\n0.1, 1.\n*BOUNDARY\n{HELD}"
    equations = "".join(f"*EQUATION\n2\n{node}, 2, 1., 109, 2, -1.\n" for node in (107, 108))
    for what, after in (("a force, equations", equations + held + f"*CLOAD\n109, 2, {20.0 * LENGTH * THICKNESS}\n"),
                        ("a pressure", edge + held + "*DSLOAD\nEDGE, P, -20.\n")):
        rows, _, _ = history(bar(after=after + "*END STEP\n"))
        if rows:
            close(what, rows[-1]["work"], -0.5 * 20.0 * LENGTH * way)
    # A bar that cools between two walls.
    rows, _, _ = history(bar(material=CFRP + "*EXPANSION, ZERO=20.\n1.2e-5,\n", after="*INITIAL CONDITIONS, TYPE=TEMPERATURE\n"
                             f"ALL, 20.\n*STEP\n*STATIC\n0.1, 1.\n*BOUNDARY\n{HELD}TOP, 2\n*TEMPERATURE\nALL, -80.\n*END STEP\n"))
    if rows:
        close("cooled", rows[-1]["dissipated"], LENGTH * dissipated(stress(1.2e-5 * 100.0 * HEIGHT)[1]))


def check_surfaces():
    """Cohesive surfaces in the place of cohesive elements; MAXS and QUADS agree in one mode."""
    law = GLUE.replace("*MATERIAL, NAME=GLUE\n*ELASTIC, TYPE=TRACTION\n", "*COHESIVE BEHAVIOR\n").replace("QUADS", "MAXS")
    law = law.replace("*DAMAGE STABILIZATION\n1e-5\n", "")
    contact = "*SURFACE INTERACTION, NAME=I1\n2.,\n*FRICTION\n0.,\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD\n"
    pair = "*CONTACT PAIR, INTERACTION=I1, TYPE=SURFACE TO SURFACE, SMALL SLIDING\nBELOW, ABOVE\n"
    pulled("cohesive surfaces", bar(glue=False, law=SURFACES + contact + law + pair))
    expect_error(delam("run", write(bar(glue=False, law=SURFACES.replace("A2, S3", "A, S3") + contact + law + pair),
                                    "deck.inp"), "--out", os.path.join(folder(), "out")), 2, "2 of the 4 sides", "BELOW")
    shell = "*NODE\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 1., 1., 0.\n4, 0., 1., 0.\n*ELEMENT, TYPE=S4R, ELSET=E\n1, 1, 2, 3, 4\n"
    expect_error(delam("import", write(shell + "*SHELL SECTION, ELSET=E, MATERIAL=M\n0.1, 5\n*MATERIAL, NAME=M\n*ELASTIC\n1., 0.\n",
                                       "deck.inp")), 2, "S4R", "SC8R")


def solid(cell):
    """The bar in space, 1 deep: two blocks of two cells upon two."""
    def node(block, x, y, z):
        return 100 * block + 1 + x + 3 * y + 6 * z

    def face(block, x, z):
        return [node(block, a, b, z) for a, b in ((x, 0), (x + 1, 0), (x + 1, 1), (x, 1))]

    text = "*HEADING\na bar in space\n*NODE\n"
    text += "".join(f"{node(k, x, y, z)}, {x}., {y}., {0.5 * z + k}\n"
                    for k in range(2) for z in range(3) for y in range(2) for x in range(3))
    for k, name in enumerate("AB"):
        text += f"*ELEMENT, TYPE={cell}, ELSET={name}\n"
        for number, (z, x) in enumerate(((0, 0), (0, 1), (1, 0), (1, 1))):
            corners = [str(n) for n in face(k, x, z) + face(k, x, z + 1)]
            text += f"{10 * k + number + 1}, {', '.join(corners[:6])},\n{', '.join(corners[6:])}\n"
    text += "*ELEMENT, TYPE=COH3D8, ELSET=G\n"
    text += "".join(f"{31 + x}, {', '.join(map(str, face(0, x, 2) + face(1, x, 0)))}\n" for x in range(2))
    thick = "*SHELL SECTION, ELSET={}, MATERIAL=CFRP, STACK DIRECTION=3\n0.5, 5\n" if cell == "SC8R" else (
        "*SOLID SECTION, ELSET={}, MATERIAL=CFRP\n,\n")
    text += thick.format("A") + thick.format("B")
    text += "*COHESIVE SECTION, ELSET=G, MATERIAL=GLUE, RESPONSE=TRACTION SEPARATION\n,\n" + CFRP + GLUE
    for name, number, z in (("BOTTOM", 0, 0), ("TOP", 1, 2)):
        text += f"*NSET, NSET={name}\n{', '.join(str(node(number, x, y, z)) for x in range(3) for y in range(2))}\n"
    return text + f"*STEP\n*STATIC\n0.1, 1.\n*BOUNDARY\nBOTTOM, 3\nTOP, 3, 3, {PULL}\n1, 1, 2\n3, 2\n101, 1, 2\n103, 2\n*END STEP\n"


def check_space():
    """Force times the depth of 1: the same stress."""
    for cell in ("C3D8", "C3D8R", "C3D8I", "SC8R"):
        pulled(cell, solid(cell))


COLUMNS = 180


def check_places():
    """Blocks that overlap, with cohesive elements turned inside out between them, are told; a layer that is thick is not."""
    for what, text in (("plane", bar()), ("space", solid("C3D8"))):
        for up, told in ((-0.25, True), (0.25, False)):
            head, rest = text.split("*ELEMENT", 1)
            moved = re.sub(r"^(1\d\d, .*, )(\S+)$", lambda m: f"{m[1]}{float(m[2]) + up}", head, flags=re.MULTILINE)
            expect(moved != head, "a block is moved")
            code, _, error = delam("check", write(moved + "*ELEMENT" + rest, "deck.inp"))
            expect(code == 0 and ("overlap by up to 0.25 at" in error) == told, f"{what}, {up}: {error.strip()[-300:]}")


def arm(columns=COLUMNS, length=60.0, height=1.5, rows=2):
    nodes = [f"{j * (columns + 1) + i + 1:7d}, {length * i / columns:12.6f}, {height * j / rows:12.6f}"
             for j in range(rows + 1) for i in range(columns + 1)]
    cells = [f"{j * columns + i + 1}, {a}, {a + 1}, {a + columns + 2}, {a + columns + 1}"
             for j in range(rows) for i in range(columns) for a in [j * (columns + 1) + i + 1]]
    return "\n".join(nodes), "\n".join(cells)


def cae():
    """A double cantilever beam by the conventions of Abaqus/CAE: parts, instances, ties, a layer meshed finer than its arms."""
    nodes, cells = arm()
    count = 320
    layer = "\n".join(f"{i + 1 + k * (count + 1)}, {20 + 40 * i / count:.8g}, {0.01 * k}" for k in range(2) for i in range(count + 1))
    glued = "\n".join(f"{i + 1}, {i + 1}, {i + 2}, {count + 3 + i}, {count + 2 + i}" for i in range(count))
    return f"""*Heading
** Job name: dcb Model name: Model-1
** Generated by: Abaqus/CAE 2022
*Preprint, echo=NO, model=NO, history=NO, contact=NO
*Parameter
opening = 3.0
half = opening/2.
**
** PARTS
**
*Part, name=Arm
*Node
{nodes}
*Element, type=CPE4I
{cells}
*Elset, elset=Set-All, generate
   1,  {2 * COLUMNS},    1
*Elset, elset=_Low_S1, internal, generate
  1,  {COLUMNS},   1
*Surface, type=ELEMENT, name=Low
_Low_S1, S1
*Elset, elset=_High_S3, internal, generate
 {COLUMNS + 1}, {2 * COLUMNS},   1
*Surface, type=ELEMENT, name=High
_High_S3, S3
** Section: Section-1
*Solid Section, elset=Set-All, material=CFRP
25.,
*End Part
**
*Part, name=Layer
*Node
{layer}
*Element, type=COH2D4
{glued}
*Elset, elset=All, generate
 1, {count}, 1
*Surface, type=ELEMENT, name=Low
All, S1
*Surface, type=ELEMENT, name=High
All, S3
*Cohesive Section, elset=All, material=GLUE, response=TRACTION SEPARATION, thickness=SPECIFIED
1., 25.
*End Part
**
** ASSEMBLY
**
*Assembly, name=Assembly
**
*Instance, name=Lower, part=Arm
          0.,         -1.5,           0.
*End Instance
**
*Instance, name=Upper, part=Arm
          0.,         0.01,           0.
*End Instance
**
*Instance, name=Layer-1, part=Layer
*End Instance
**
*Nset, nset=LoadUp, instance=Upper
 1,
*Nset, nset=LoadLow, instance=Lower
 {2 * (COLUMNS + 1) + 1},
*Nset, nset=Fixed, instance=Lower
  {", ".join(str(k * (COLUMNS + 1)) for k in (1, 2, 3))}
*Nset, nset=Fixed, instance=Upper
  {", ".join(str(k * (COLUMNS + 1)) for k in (1, 2, 3))}
** Constraint: Tie-1
*Tie, name=Tie-1, adjust=yes
Layer-1.Low, Lower.High
** Constraint: Tie-2
*Tie, name=Tie-2, adjust=yes
Layer-1.High, Upper.Low
*End Assembly
**
** MATERIALS
**
{CFRP.replace("DENSITY", "Density")}{GLUE.replace(f"{STRENGTH}, 60., 60.", "10., 20., 20.")}** ----------------------------------------------------------------
**
** STEP: Step-1
**
*Step, name=Step-1, nlgeom=YES, inc=1000
*Static
0.02, 1., 1e-08, 0.02
**
** BOUNDARY CONDITIONS
**
** Name: BC-1 Type: Displacement/Rotation
*Boundary
Fixed, 1, 1
Fixed, 2, 2
** Name: BC-2 Type: Displacement/Rotation
*Boundary
LoadUp, 2, 2, <half>
** Name: BC-3 Type: Displacement/Rotation
*Boundary
LoadLow, 2, 2, -1.5
**
** CONTROLS
**
*Controls, reset
*Controls, analysis=discontinuous
**
** OUTPUT REQUESTS
**
*Restart, write, frequency=0
*Output, field, variable=PRESELECT
*Output, history
*Node Output, nset=LoadUp
RF2, U2
*End Step
"""


def check_cae():
    """Runs as it is, to pictures and a page for a browser, and grows as beam theory says: Gc = 3 P w/(2 b a) with the length of C."""
    rows, said, out = history(cae(), name="dcb.inp")
    if not rows:
        return
    expect("*CONTROLS" in said and "NLGEOM" in said, "what was left out and changed is said")
    last = rows[-1]
    # Two loads of one pattern move in proportion: its reaction is the sum of both forces. The length of beam theory is
    # the one that has this compliance, C = 8 a^3/(E' h^3).
    force, opening, height, stretch = 0.5 * last["reaction"], 3.0, 1.5, YOUNG / (1.0 - 0.3 ** 2)
    length = (stretch * height ** 3 * opening / (8.0 * force)) ** (1.0 / 3.0)
    expect(30.0 < length < 45.0, f"the crack grows from 20 to {length:.1f}")
    close("energy release rate by beam theory", 3.0 * force * opening / (2.0 * length), TOUGHNESS, 0.01)
    close("energy release rate", last["energy_release_rate"], TOUGHNESS, 0.01)
    code, error = draw("plot", out)
    for picture in ("load-displacement.png", "snapshots.png"):
        expect(code == 0 and os.path.getsize(os.path.join(out, picture)) > 5000, f"{picture}: {error.strip()[-300:]}")
    code, _, error = delam("view", out)
    expect(code == 0 and os.path.exists(os.path.join(out, "view.html")), f"view: {error.strip()[:200]}")


check_ways_to_write()
check_meshes_that_are_generated()
check_materials()
check_loads()
check_surfaces()
check_space()
check_places()
check_cae()
finish()
