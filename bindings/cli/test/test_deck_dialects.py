# SPDX-License-Identifier: BSD-3-Clause
"""Decks in the dialects of preprocessors, each with something usual: the bar that is pulled apart, whose force is known, and a
beam that is split, whose energy is."""
import os
import re

from bar_deck import (CFRP, GLUE, HELD, LENGTH, PULL, STEP, STIFFNESS, STRENGTH, SURFACES, THICKNESS, TOUGHNESS, YOUNG, bar,
                      pulled, stress)
from deck_runs import close, history, imported, refused
from support import delam, expect, finish, folder, write


def check_filled():
    """The older way: corners, lines between them, rows between these."""
    mesh = ""
    for first, low, name in ((1, 0.0, "A"), (101, 1.0, "B")):
        a, b, c, d = first, first + 2, first + 6, first + 8
        mesh += (f"*NODE\n{a}, 0., {low}\n{b}, 2., {low}\n{c}, 0., {low + 1}\n{d}, 2., {low + 1}\n"
                 f"*NGEN, NSET=LOW-{name}\n{a}, {b}, 1\n*NGEN, NSET=HIGH-{name}\n{c}, {d}, 1\n"
                 f"*NFILL, NSET=ALL-{name}\nLOW-{name}, HIGH-{name}, 2, 3\n"
                 f"*ELEMENT, TYPE=CPS4\n{first}, {a}, {a + 1}, {a + 4}, {a + 3}\n"
                 f"*ELGEN, ELSET={name}\n{first}, 2, 1, 1, 2, 3, 2\n")
    pulled("*NFILL", bar(mesh=mesh))
    scene, _ = imported(bar(mesh=mesh, after=STEP.replace("TOP, 2", "ALL-B, 1, 1\nTOP, 2")))
    expect(scene.count('set = "ALL-B"') == 1, "the set of *NFILL")


def check_copied():
    """The upper block as a copy of the lower one, at a distance."""
    mesh = ("*NODE, NSET=BELOW\n" + "".join(f"{1 + i + 3 * j}, {i:.1f}, {0.5 * j:.1f}\n" for j in range(3) for i in range(3)) +
            "*ELEMENT, TYPE=CPS4, ELSET=A\n" + "".join(
                f"{1 + i + 2 * j}, {1 + i + 3 * j}, {2 + i + 3 * j}, {5 + i + 3 * j}, {4 + i + 3 * j}\n"
                for j in range(2) for i in range(2)) +
            "*NCOPY, CHANGE NUMBER=100, OLD SET=BELOW, NEW SET=ABOVE, SHIFT\n0., 1., 0.\n"
            "*ELCOPY, ELEMENT SHIFT=10, OLD SET=A, SHIFT NODES=100, NEW SET=B\n")
    pulled("*NCOPY and *ELCOPY", bar(mesh=mesh))
    for old, new, pattern in (("OLD SET=BELOW", "OLD SET=BELO", r"\*NCOPY: node set \"BELO\" is not there"),
                              (", SHIFT\n", ", REFLECT=MIRROR\n", r"\*NCOPY: the parameter REFLECT is not read"),
                              ("0., 1., 0.\n", "0., 1., 0.\n0., 0., 0., 0., 0., 1., 90.\n", "a rotation of copies is not"),
                              ("CHANGE NUMBER=100", "CHANGE NUMBER=1", "node 2 occurs twice"),
                              ("SHIFT=10,", "SHIFT=1,", r"\*ELCOPY: element 2 occurs twice")):
        refused(bar(mesh=mesh.replace(old, new)), r"deck\.inp:\d+: ", pattern)


def check_exported_by_gmsh():
    """Lines of trusses beside the cells, rows of stars, groups as sets of elements and nodes."""
    text = bar()
    nodes, cells = text[text.index("*NODE, NSET=ALL\n"):text.index("*ELEMENT")], text[text.index("*ELEMENT"):]
    lines = ("******* E L E M E N T S *************\n*ELEMENT, type=T3D2, ELSET=Line1\n1001, 1, 2\n1002, 2, 3\n"
             "*ELEMENT, type=T3D2, ELSET=Line2\n1003, 107, 108\n1004, 108, 109\n")
    nodes = "*NODE\n" + re.sub(r"(?m)^(\d+, .*)$", r"\1, 0", nodes.split("\n", 1)[1])
    whole = text[:text.index("*NODE")].replace("a bar", "bar.inp") + nodes + lines + cells
    pulled("trusses of edges", whole)
    _, said = imported(whole)
    expect('left out  elements T3D2 of "Line1"' in said, f"what is left out: {said}")
    refused(whole.replace("*NSET, NSET=BOTTOM", "*SOLID SECTION, ELSET=Line1, MATERIAL=CFRP\n*NSET, NSET=BOTTOM"),
            r"\*ELEMENT: type T3D2 is not read: trusses stay out")


def check_two_sections():
    """Two sections of one material: in one interface where they say the same; else each in a part or one of its own."""
    halves = ("*ELEMENT, TYPE=COH2D4, ELSET=G\n21, 7, 8, 102, 101\n*ELEMENT, TYPE=COH2D4, ELSET=H\n22, 8, 9, 103, 102\n" +
              "".join(f"*COHESIVE SECTION, ELSET={n}, MATERIAL=GLUE, RESPONSE=TRACTION SEPARATION\n,2.\n" for n in "GH"))
    text = bar(glue=False).replace("*SOLID SECTION", halves + "*SOLID SECTION", 1)
    pulled("two alike", text)
    # Each of two thicknesses has a part of the interface.
    scene, _ = imported(text.replace("\n,2.\n*SOLID", "\n2.,2.\n*SOLID", 1))
    stiffnesses = sorted(float(value) for value in re.findall(r"\nnormal_stiffness = (\S+)", scene))
    expect(stiffnesses == [STIFFNESS / 2, STIFFNESS] and all(f'part = [{{ set = "{name}" }}]' in scene for name in "GH"),
           f"two laws: {stiffnesses}, {scene.count('part = ')} parts")
    # A third block on top, with a layer of another thickness between: two springs of the glue in series.
    third = ("*NODE\n" + "".join(f"{201 + i}, {i:.1f}, 2.\n{204 + i}, {i:.1f}, 3.\n" for i in range(3)) +
             "*ELEMENT, TYPE=CPS4, ELSET=C\n31, 201, 202, 205, 204\n32, 202, 203, 206, 205\n"
             "*ELEMENT, TYPE=COH2D4, ELSET=H\n41, 107, 108, 202, 201\n42, 108, 109, 203, 202\n"
             f"*SOLID SECTION, ELSET=C, MATERIAL=CFRP\n{THICKNESS},\n"
             "*COHESIVE SECTION, ELSET=H, MATERIAL=GLUE, RESPONSE=TRACTION SEPARATION\n0.5, 2.\n"
             "*COHESIVE SECTION, ELSET=G, MATERIAL=GLUE, RESPONSE=TRACTION SEPARATION\n1., 2.\n")
    text = bar().replace("*COHESIVE SECTION, ELSET=G, MATERIAL=GLUE, RESPONSE=TRACTION SEPARATION\n,2.\n", third)
    small = 0.1 * STRENGTH * (3.0 / YOUNG + 1.5 / STIFFNESS)
    text = text.replace("107, 109, 1\n", "204, 206, 1\n").replace("104, 107\n", "104, 107, 201, 204\n").replace(
        f"TOP, 2, 2, {PULL}", f"TOP, 2, 2, {small!r}")
    rows, _, _ = history(text)
    if rows:
        close("two thicknesses", rows[-1]["reaction"], LENGTH * 0.1 * STRENGTH)


def check_jumps_of_damage():
    """Surfaces that adhere, with damage that begins at jumps (MAXU, QUADU), and toughness by displacement."""
    contact = ("*SURFACE INTERACTION, NAME=I\n1.,\n*COHESIVE BEHAVIOR\n" + f"{STIFFNESS}, {STIFFNESS}, {STIFFNESS}\n" +
               "*DAMAGE INITIATION, CRITERION={}\n" + f"{STRENGTH / STIFFNESS}, 1e-4, 1e-4\n" +
               f"*DAMAGE EVOLUTION, TYPE=ENERGY\n{TOUGHNESS},\n*CONTACT PAIR, INTERACTION=I\nABOVE, BELOW\n")
    for criterion in ("QUADU", "MAXU"):
        pulled(criterion, bar(glue=False, law=SURFACES + contact.format(criterion)))


def check_in_the_mean():
    """A reference point that moves the upper edge in the mean; one beside it carries a moment to the edge, too."""
    edge = "*SURFACE, TYPE=ELEMENT, NAME=EDGE\nB2, S3\n"
    point = "*NODE\n1000, 1., {}\n*COUPLING, CONSTRAINT NAME=C1, REF NODE=1000, SURFACE=EDGE\n*DISTRIBUTING\n"
    for height, lines in ((2.0, ""), (3.0, "1, 3\n")):
        pulled("*DISTRIBUTING", bar(before=point.format(height), law=GLUE + edge + "",
                                    after=STEP.replace("TOP, 2, 2", "1000, 2, 2")).replace("*DISTRIBUTING\n",
                                                                                          "*DISTRIBUTING\n" + lines))
    pulled("a rotation that is held", bar(before=point.format(2.5), law=GLUE + edge,
                                          after=STEP.replace("TOP, 2, 2", "1000, 6\n1000, 2, 2")))
    refused(bar(before=point.format(2.0).replace("*DISTRIBUTING", "*DISTRIBUTING, WEIGHTING METHOD=LINEAR"), law=GLUE + edge),
            r"\*DISTRIBUTING: WEIGHTING METHOD=LINEAR is not imported: UNIFORM is")
    refused(bar(before=point.format(2.0).replace("*DISTRIBUTING\n", ""), law=GLUE + edge), "is expected next")


def moved_as_one(solid):
    """Two cells upon each other; a rigid motion of the lower face's node, and of a point that has the upper face in the mean."""
    corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)] if solid else [(0.0,), (1.0,)]
    layers = [[(*corner, z) for corner in corners] for z in (0.0, 1.5, 2.0)]
    count = len(corners)
    text = "*NODE\n" + "".join(f"{1 + k + count * j}, {', '.join(map(str, at))}\n" for j, layer in enumerate(layers)
                               for k, at in enumerate(layer))
    points = {900: (0.3, 0.4, -1.0), 901: (0.7, 0.9, 3.0)} if solid else {900: (0.3, -1.0), 901: (0.7, 3.0)}
    text += "".join(f"{n}, {', '.join(map(str, at))}\n" for n, at in points.items())
    for j in (0, 1):
        below, above = (list(range(1 + count * (j + k), 1 + count * (j + k + 1))) for k in (0, 1))
        text += f"*ELEMENT, TYPE={'C3D8' if solid else 'CPS4'}, ELSET={'AB'[j]}\n{1 + j}, " + ", ".join(
            map(str, below + (above if solid else above[::-1]))) + "\n"
    text += f"*SURFACE, NAME=HIGH\nB, {'S2' if solid else 'S3'}\n*NSET, NSET=LOW, GENERATE\n1, {count}\n"
    text += "".join(f"*SOLID SECTION, ELSET={n}, MATERIAL=M\n" for n in "AB") + "*MATERIAL, NAME=M\n*ELASTIC\n1000., 0.3\n"
    text += "*RIGID BODY, REF NODE=900, TIE NSET=LOW\n*COUPLING, CONSTRAINT NAME=C, REF NODE=901, SURFACE=HIGH\n*DISTRIBUTING\n"
    turn, shift = ((2e-3, -1e-3, 3e-3) if solid else (0.0, 0.0, 3e-3)), (1e-2, -2e-2, 3e-2)
    lines = ""
    for n, at in points.items():
        x, y, z = (*at, 0.0)[:3]
        across = (turn[1] * z - turn[2] * y, turn[2] * x - turn[0] * z, turn[0] * y - turn[1] * x)
        lines += "".join(f"{n}, {a + 1}, {a + 1}, {shift[a] + across[a]!r}\n" for a in range(len(at)))
        lines += "".join(f"{n}, {a + 4}, {a + 4}, {turn[a]!r}\n" for a in range(3) if solid or a == 2)
    return text + f"*STEP\n*STATIC, DIRECT\n1., 1.\n*BOUNDARY\n{lines}*END STEP\n", shift, turn


def check_rigid_motion():
    """Both points move as one: nothing is strained; without the rotation of the upper one, something is."""
    for solid in (False, True):
        text, _, turn = moved_as_one(solid)
        rows, _, _ = history(text)
        strained, _, _ = history(text.replace(f"901, 6, 6, {turn[2]!r}", "901, 6, 6, 0.1"))
        if rows and strained:
            expect(abs(rows[-1]["stored_bulk"]) < 1e-12 * strained[-1]["stored_bulk"], f"solid {solid}: {rows[-1]['stored_bulk']}, "
                   f"where another rotation stores {strained[-1]['stored_bulk']}")


def check_amplitudes():
    """AMPLITUDE=STEP applies what has no amplitude at once, and holds it; points at equal intervals."""
    at_once = STEP.replace("*STEP", "*STEP, NAME=S1, AMPLITUDE=STEP, INC=100")
    rows, said, _ = history(bar(after=at_once))
    for row in rows[1:]:
        close(f"at once, at {row['time']}", row["reaction"], LENGTH * stress(PULL)[0])
    expect(len(rows) == 51 and "jumps at the beginning of a step" in said, f"said: {said[-500:]}")
    even = "*AMPLITUDE, NAME=E, DEFINITION=EQUALLY SPACED, FIXED INTERVAL=0.25\n0., 0.1, 0.2, 0.3\n1.\n"
    drawn = STEP.replace("*BOUNDARY\n" + HELD, "*BOUNDARY\n" + HELD + "*BOUNDARY, AMPLITUDE=E\n")
    rows, _, _ = history(bar(before=even, after=drawn))
    at = {round(row["time"], 9): row["reaction"] for row in rows}
    close("points at equal intervals", at.get(0.5, 0.0), LENGTH * stress(0.2 * PULL)[0])
    close("and the last", at.get(1.0, 0.0), LENGTH * stress(PULL)[0])
    refused(bar(before=even.replace(", FIXED INTERVAL=0.25", ""), after=drawn), "FIXED INTERVAL= is missing")


def check_hypermesh():
    """Comments as commands of the preprocessor, supports node by node, a set of sides of single elements."""
    text = bar(glue=False, law=("*SURFACE, NAME = BELOW, TYPE = ELEMENT\n3, S3\n4, S3\n"
                                "*SURFACE, NAME = ABOVE, TYPE = ELEMENT\n11, S1\n12, S1\n"
                                f"*SURFACE INTERACTION, NAME = glue\n*COHESIVE BEHAVIOR\n{STIFFNESS}, {STIFFNESS}, {STIFFNESS}\n"
                                + GLUE[GLUE.index("*DAMAGE INIT"):GLUE.index("*DAMAGE STAB")] +
                                "*CONTACT PAIR, INTERACTION = glue, TYPE = SURFACE TO SURFACE\nABOVE, BELOW\n"))
    text = text.replace("*NODE, NSET=ALL", "**HM_comp_by_property \"arms\" 3\n**HMNAME COMP 1 arms\n*NODE")
    single = "".join(f"{n}, 2, 2, 0.0\n" for n in (1, 2, 3)) + "".join(f"{n}, 1, 1, 0.0\n" for n in (1, 4, 7, 101, 104, 107))
    text = text.replace(HELD, "**HWNAME LOADCOL 1 held\n" + single).replace("*STEP\n", "*STEP, INC = 100, NLGEOM = NO\n")
    pulled("as HyperMesh writes it", text.replace("*END STEP", "*NODE PRINT, NSET = TOP, TOTALS = YES\nRF2,\n*END STEP"))


def check_calculix():
    """As PrePoMax writes for CalculiX: sets of a face, a solver, output by names, each step with its own supports."""
    text = bar().replace("*STEP\n*STATIC\n", "*TIME POINTS, NAME=TP\n0.5, 1.\n*STEP, INC=100\n*STATIC, SOLVER=PASTIX\n")
    text = text.replace("*BOUNDARY\n" + HELD, "*BOUNDARY, OP=NEW\nBOTTOM, 2, 2, 0\nLEFT, 1, 1, 0\n*BOUNDARY\n")
    text = text.replace("*END STEP", "*NODE FILE, OUTPUT=2D, TIME POINTS=TP\nRF, U\n*EL FILE\nS, E, NOE\n"
                        "*CONTACT FILE\nCDIS, CSTR\n*END STEP")
    pulled("as PrePoMax writes it", text)


def check_meshio():
    """Numbers with exponents, a title of two lines, sets that list one number a line."""
    text = bar().replace("a bar\n", "Abaqus DataFile Version 6.14\nwritten by meshio v5.3.5\n")
    head, rest = text.split("*NODE, NSET=ALL\n")
    nodes, rest = rest.split("*ELEMENT", 1)
    numbers = [[float(x) for x in line.split(",")] for line in nodes.strip().splitlines()]
    nodes = "".join(f"{int(n)}, {x:.16e}, {y:.16e}, {0.0:.16e}\n" for n, x, y in numbers)
    pulled("as meshio writes it", head + "*NODE\n" + nodes + "*ELEMENT" + rest.replace(
        "1, 4, 7, 101, 104, 107\n", "1,\n4,\n7,\n101,\n104,\n107,\n"))


def check_large_rotations():
    """NLGEOM=YES means corotational kinematics where the library knows them; the bar does not rotate, but shortens."""
    large = STEP.replace("*STEP", "*STEP, NLGEOM")
    rows, said, _ = history(bar(after=large))
    if rows:
        close("large", rows[-1]["reaction"], LENGTH * stress(PULL)[0], 2.0 * PULL)
    expect('NLGEOM=YES: kinematics = "corotational"' in said, f"said: {said[:600]}")
    scene, said = imported(bar(after=large))
    expect('[solver]\nkinematics = "corotational"\n' in scene, scene[-800:])
    scene, said = imported(bar(after=STEP.replace("*STEP", "*STEP, NLGEOM=NO")))
    expect('[solver]\nkinematics = "linear"\n' in scene and "NLGEOM=NO: kinematics" in said, said)
    scene, said = imported(bar())
    expect('[solver]\nkinematics = "linear"\n' in scene and "no NLGEOM" in said, said)
    scene, said = imported(bar(after=STEP + large))
    expect('kinematics = "corotational"' in scene and "from the first step on" in said, said)
    point = "*NODE\n1000, 1., 2.\n*RIGID BODY, REF NODE=1000, PIN NSET=TOP\n"
    scene, said = imported(bar(before=point, after=large.replace("TOP, 2, 2", "1000, 2, 2")))
    expect('kinematics = "linear"' in scene and "because angles of nodes that belong to no body" in said, said)
    tied = "*NODE\n1000, 1., 2.\n*EQUATION\n2\nTOP, 2, 1., 1000, 2, -1.\n"
    point = bar(before=tied, after=large.replace("TOP, 2, 2", "1000, 2, 2"))
    scene, said = imported(point)
    expect('kinematics = "corotational"' in scene and "[[equations]]" in scene, said)
    rows, said, _ = history(point)
    if rows:
        close("pulled by a node of no body", rows[-1]["reaction"], LENGTH * stress(PULL)[0], 2.0 * PULL)
    warm = "*TEMPERATURE\nALL, 10.\n"
    hot = bar(material=CFRP + "*EXPANSION\n1e-5,\n", after=large.replace("*END", warm + "*END"))
    scene, said = imported(hot)
    expect('kinematics = "corotational"' in scene and "NLGEOM=YES" in said, said)
    stored = [rows[-1]["stored_bulk"] for rows, _, _ in (history(text) for text in (hot, hot.replace(", NLGEOM", ""))) if rows]
    expect(len(stored) == 2 and abs(stored[0] / stored[1] - 1) < 1e-6,
           f"heated and stretched, with large rotations and with small ones: {stored}")

    # The upper block floats once it is off and its supports are freed.
    torn = STEP.replace(f"TOP, 2, 2, {PULL}", "TOP, 2, 2, 0.05")
    freed = f"*STEP\n*STATIC\n0.5, 1.\n*BOUNDARY, OP=NEW\n{HELD.replace('LEFT, XSYMM', '1, 1')}*END STEP\n"
    path = write(bar(after=torn.replace("*STEP", "*STEP, NLGEOM") + freed), "deck.inp")
    for kinematics in ("corotational", "linear"):
        code, _, error = delam("run", path, "--out", os.path.join(folder(), "out"), "--set", f"solver.kinematics={kinematics}")
        expect(code == 0, f"{kinematics}, exit {code}: {error[-600:]}")


def alfano(columns):
    """The double cantilever beam of Alfano and Crisfield (Int. J. Numer. Meth. Engng 50, 2001), 100 long with a crack of 30, as
    older decks write it: corners, lines between them, rows between these, rows of elements."""
    row, last = 1000, columns + 1
    text = "*HEADING\n DELAMINATION OF A DOUBLE CANTILEVER BEAM\n*PREPRINT,ECHO=NO,MODEL=NO,HISTORY=NO\n"
    for name, first, y in (("BOT", 1, 0.0), ("MIDB", 2 * row + 1, 1.5), ("MIDT", 10 * row + 1, 1.5), ("TOP", 12 * row + 1, 3.0)):
        text += f"*NODE\n{first},0.,{y}\n{first + columns},100.,{y}\n*NGEN,NSET={name}\n{first},{first + columns},1\n"
    text += f"*NFILL,NSET=LOWER\nBOT,MIDB,2,{row}\n*NFILL,NSET=UPPER\nMIDT,TOP,2,{row}\n"
    for name, first, node in (("ARM1", 1, 1), ("ARM2", 10001, 10 * row + 1)):
        text += (f"*ELEMENT,TYPE=CPE4I\n{first},{node},{node + 1},{node + row + 1},{node + row}\n"
                 f"*ELGEN,ELSET={name}\n{first},{columns},1,1,2,{row},{columns}\n")
    tip = 3 * columns // 10 + 1
    text += (f"*ELEMENT,TYPE=COH2D4\n20001,{2 * row + tip},{2 * row + tip + 1},{10 * row + tip + 1},{10 * row + tip}\n"
             f"*ELGEN,ELSET=ADHESIVE\n20001,{columns + 1 - tip},1,1\n")
    text += "".join(f"*SOLID SECTION,ELSET={name},MATERIAL=A1,ORIENTATION=OR\n20.,\n" for name in ("ARM1", "ARM2"))
    return text + f"""*ORIENTATION,NAME=OR,SYSTEM=RECTANGULAR
1.,0.,0.,0.,1.,0.
3,0.
*COHESIVE SECTION,ELSET=ADHESIVE,MATERIAL=A2,RESPONSE=TRACTION SEPARATION,CONTROLS=VISCO,THICKNESS=SPECIFIED
1.0,20.
*SECTION CONTROLS,NAME=VISCO,VISCOSITY=1.E-5,ELEMENT DELETION=NO,MAX DEGRADATION=1.
*MATERIAL,NAME=A1
*ELASTIC,TYPE=ENGINEERING CONSTANTS
135300.,9000.,9000.,0.24,0.24,0.46,5200.,5200.
3080.,
*MATERIAL,NAME=A2
*ELASTIC,TYPE=TRACTION
1.E5,1.E5,1.E5
*DAMAGE INITIATION,CRITERION=QUADS
20.,20.,20.
*DAMAGE EVOLUTION,TYPE=ENERGY,MIXED MODE BEHAVIOR=POWER LAW,POWER=1.
0.28,0.28,0.28
*NSET,NSET=TIP1
1,
*NSET,NSET=TIP2
{12 * row + 1},
*NSET,NSET=FIX,GENERATE
{last},{2 * row + last},{row}
{10 * row + last},{12 * row + last},{row}
*BOUNDARY
FIX,1,2
*AMPLITUDE,NAME=A
0.,0.,1.,1.
*STEP,NLGEOM,INC=1000
 OPEN THE BEAM
*STATIC
.02,1.,1.E-8,.02
*BOUNDARY,AMPLITUDE=A
TIP1,2,2,-1.5
TIP2,2,2,1.5
*CONTROLS,ANALYSIS=DISCONTINUOUS
*CONTROLS,PARAMETERS=TIME INCREMENTATION
,,,,,,,10
*MONITOR,NODE={12 * row + 1},DOF=2
*PRINT,CONTACT=YES
*OUTPUT,FIELD,FREQ=20
*NODE OUTPUT
U,RF
*OUTPUT,HISTORY,FREQ=1
*NODE OUTPUT,NSET=TIP2
U2,RF2
*NODE FILE,NSET=TIP2
U,RF
*END STEP
"""


def check_older_beam():
    """Grows as beam theory says: Gc = 3 P w/(2 a) per width, with the length of the compliance, C = 8 a^3/(E' h^3)."""
    rows, said, _ = history(alfano(200))
    if not rows:
        return
    expect('kinematics = "corotational"' in said and "left out  *MONITOR" in said, f"said: {said[:900]}")
    force, opening, height, stretch = 0.5 * rows[-1]["reaction"], 3.0, 1.5, 135300.0 / (1.0 - 0.24 ** 2 * 9000.0 / 135300.0)
    length = (stretch * height ** 3 * opening / (8.0 * force)) ** (1.0 / 3.0)
    expect(30.0 < length < 60.0, f"the crack grows from 30 to {length:.1f}")
    close("energy release rate by beam theory", 3.0 * force * opening / (2.0 * length), 0.28, 0.02)


for check in (check_filled, check_copied, check_exported_by_gmsh, check_two_sections, check_jumps_of_damage, check_in_the_mean,
              check_rigid_motion, check_amplitudes, check_hypermesh, check_calculix, check_meshio, check_large_rotations,
              check_older_beam):
    check()
finish()
