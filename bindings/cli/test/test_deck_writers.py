# SPDX-License-Identifier: BSD-3-Clause
"""Decks as further programs write them: the bar of two blocks that is pulled apart, in the plane and in space, each with the
habits of its writer, against the force that is known in closed form."""
import math
import os
import re

from bar_deck import (CFRP, GLUE, HEIGHT, HELD, LENGTH, PULL, STEP, STIFFNESS, SURFACES, THICKNESS, YOUNG, bar, pulled,
                      stress)
from deck_runs import close, history, imported, refused
from support import delam, expect, finish, folder, write

# ---- the bar in space, 2 x 1 x 2, of any cells: corners on a grid, of quadratic cells with nodes midway ----
CORNERS = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
WEDGES = ((0, 1, 2, 4, 5, 6), (0, 2, 3, 4, 6, 7))
TETS = ((0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6))
EDGES = {4: ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)),
         6: ((0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)),
         8: ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7))}
FACES = {4: ((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)), 6: ((0, 1, 2), (3, 5, 4), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0)),
         8: ((0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0))}


class Block:
    """Two cubes along x on the height `low`, of bricks, wedges or tetrahedra; labels begin behind `first`."""

    def __init__(self, low, first, corners, quadratic):
        self.first, self.nodes, self.cells, self.corners = first, {}, [], corners
        kinds = {8: (tuple(range(8)),), 6: WEDGES, 4: TETS}[corners]
        for x in range(2):
            at = [(float(x + a), float(b), float(low + c)) for a, b, c in CORNERS]
            for kind in kinds:
                cell = [at[k] for k in kind]
                middle = [tuple((p + q) / 2 for p, q in zip(cell[a], cell[b])) for a, b in EDGES[corners]] if quadratic else []
                self.cells.append([self.label(point) for point in cell + middle])

    def label(self, point):
        return self.nodes.setdefault(point, self.first + len(self.nodes) + 1)

    def at_height(self, z):
        return [label for point, label in self.nodes.items() if point[2] == z]

    def sides(self, z):
        """Cell and side, as Abaqus numbers them, of the faces at a height."""
        on = set(self.at_height(z))
        return [(c, s + 1) for c, cell in enumerate(self.cells) for s, face in enumerate(FACES[self.corners])
                if all(cell[k] in on for k in face)]


def solid(cell, corners, quadratic, cohesive=True):
    """The bar as two blocks with cohesive elements between them, or with surfaces that adhere."""
    blocks = [Block(0, 0, corners, quadratic), Block(1, 1000, corners, quadratic)]
    text = "*HEADING\nbar in space\n"
    for k, block in enumerate(blocks):
        text += "*NODE\n" + "".join(f"{n}, {x}, {y}, {z}\n" for (x, y, z), n in block.nodes.items())
        text += f"*ELEMENT, TYPE={cell}, ELSET={'AB'[k]}\n"
        for number, nodes in enumerate(block.cells):
            words = [str(100 * k + number + 1), *map(str, nodes)]
            text += ",\n".join(", ".join(words[i:i + 8]) for i in range(0, len(words), 8)) + "\n"
        text += f"*SOLID SECTION, ELSET={'AB'[k]}, MATERIAL=CFRP\n"
    held = [blocks[0].sides(1.0), blocks[1].sides(1.0)]
    if cohesive:
        below, above = blocks
        places = {n: p for p, n in below.nodes.items()}
        text += f"*ELEMENT, TYPE=COH3D{2 * (4 if corners == 8 else 3)}, ELSET=G\n"
        for number, (c, s) in enumerate(held[0]):
            face = [below.cells[c][k] for k in FACES[corners][s - 1]][::-1]
            text += f"{501 + number}, {', '.join(map(str, face + [above.nodes[places[n]] for n in face]))}\n"
        text += "*COHESIVE SECTION, ELSET=G, MATERIAL=GLUE, RESPONSE=TRACTION SEPARATION\n" + CFRP + GLUE
    else:
        for k, name in enumerate(("BELOW", "ABOVE")):
            text += f"*SURFACE, NAME={name}\n" + "".join(f"{100 * k + c + 1}, S{s}\n" for c, s in held[k])
        text += CFRP + ADHERE
    for name, block, z in (("BOTTOM", blocks[0], 0.0), ("TOP", blocks[1], 2.0)):
        text += f"*NSET, NSET={name}\n" + "".join(f"{n},\n" for n in block.at_height(z))
    ends = "".join(f"{block.nodes[at]}, {axes}\n" for block, z in zip(blocks, (0.0, 2.0))
                   for at, axes in (((0.0, 0.0, z), "1, 2"), ((2.0, 0.0, z), "2, 2")))
    return text + f"*STEP\n*STATIC\n0.1, 1.\n*BOUNDARY\nBOTTOM, 3\n{ends}TOP, 3, 3, {PULL}\n*END STEP\n"


ADHERE = (f"*SURFACE INTERACTION, NAME=I\n*COHESIVE BEHAVIOR\n{STIFFNESS}, {STIFFNESS}, {STIFFNESS}\n" +
          GLUE[GLUE.index("*DAMAGE INIT"):GLUE.index("*DAMAGE STAB")] +
          "*CONTACT PAIR, INTERACTION=I, TYPE=SURFACE TO SURFACE\nABOVE, BELOW\n")


def check_types_of_elements():
    """Bricks, wedges and tetrahedra, linear with cohesive elements, quadratic with surfaces that adhere."""
    for cell, corners in (("c3d8i", 8), ("C3D6", 6), ("C3D4", 4)):
        pulled(cell, solid(cell, corners, False))
    for cell, corners in (("C3D20", 8), ("C3D20R", 8), ("C3D15", 6), ("C3D10", 4), ("c3d10m", 4)):
        pulled(cell, solid(cell, corners, True, False))


def check_cgx():
    """cgx of CalculiX: the mesh, each set and each pressure in a file of its own, which the deck includes; orthotropic sections."""
    text = bar(law=GLUE.replace("*DAMAGE STAB", "** no viscosity\n*DAMAGE STAB"))
    mesh = text[text.index("*NODE"):text.index("*SOLID SECTION")]
    files = {"all_msh": mesh.replace("*NODE, NSET=ALL", "*NODE, NSET=Nall"),
             "bottom_nam": "** Names based on bottom\n*NSET,NSET=Nbottom\n1,\n2,\n3,\n",
             "top_nam": "*NSET,NSET=Ntop\n107,\n108,\n109,\n", "left_nam": "*NSET,NSET=Nleft\n1,4,\n7,101,\n104,107,\n",
             "pulled_dlo": "** Pressure\n13,P3,-20.\n14,P3,-20.\n"}
    ortho = ("*MATERIAL,NAME=CFRP\n*ELASTIC,TYPE=ENGINEERING CONSTANTS\n135000.,9000.,9000.,.3,.3,.45,5000.,5000.,\n3100.,294.\n"
             "*ORIENTATION,NAME=OR1,SYSTEM=RECTANGULAR\n0.,1.,0.,-1.,0.,0.\n")
    main = ("*INCLUDE,INPUT=all.msh\n*INCLUDE,INPUT=bottom.nam\n*INCLUDE,INPUT=top.nam\n*INCLUDE,INPUT=left.nam\n" + ortho +
            text[text.index("*MATERIAL, NAME=GLUE"):text.index("*NSET, NSET=BOTTOM")] +
            "".join(f"*SOLID SECTION,ELSET={n},MATERIAL=CFRP,ORIENTATION=OR1\n{THICKNESS}\n" for n in "AB"))
    last = "*NODE PRINT,NSET=Ntop,TOTALS=ONLY\nRF\n*EL PRINT,ELSET=A\nS\n*SECTION PRINT,SURFACE=EDGE,NAME=SP1\nSOF,SOM\n*END STEP\n"
    fixed = "*BOUNDARY\nNbottom,2,2\nNleft,1,1\n"
    pulled("fibres along the load", main + f"*STEP,INC=1000\n*STATIC,SOLVER=SPOOLES\n.1,1.\n{fixed}Ntop,2,2,{PULL}\n" + last,
           135000.0, **files)
    rows, _, _ = history(main + f"*STEP\n*STATIC\n{fixed}*DLOAD\n*INCLUDE,INPUT=pulled.dlo\n" + last, **files)
    if rows:
        close("a pressure of a file", rows[-1]["work"], -0.5 * 20.0 * LENGTH * 20.0 * (HEIGHT / 135000.0 + 1.0 / STIFFNESS))


def check_texgen():
    """TexGen and older decks: nodes, elements, axes and amplitudes in files that the keyword names (INPUT=)."""
    text = bar()
    nodes, rest = text[text.index("*NODE"):].split("\n", 1)
    nodes, rest = rest[:rest.index("*ELEMENT")], rest[rest.index("*ELEMENT"):]
    first = rest.index("\n") + 1
    rows, rest = rest[first:rest.index("*ELEMENT", first)], rest[:first - 1] + ", INPUT=a1.ele\n" + rest[rest.index("*ELEMENT", first):]
    constants = "*MATERIAL, NAME=CFRP\n*ELASTIC, TYPE=ENGINEERING CONSTANTS\n135000., 9000., 9000., .3, .3, .45, 5000., 5000.\n3100.\n"
    axes = ("*Distribution Table, Name=TexGenOrientationVectors\nCOORD3D, COORD3D\n"
            "*Distribution, Location=Element, Table=TexGenOrientationVectors, Name=TexGenOrientationDistr, Input=bar.ori\n"
            "*Orientation, Name=TexGenOrientations, Definition=coordinates\nTexGenOrientationDistr\n1, 0\n")
    section = "".join(f"*Solid Section, ElSet={n}, Material=CFRP, Orientation=TexGenOrientations\n{THICKNESS},\n" for n in "AB")
    whole = "*Heading\nFile generated by TexGen v3.13\n*Node, Input=bar.nod, NSet=ALL\n" + rest.replace(CFRP, constants)
    plain = "".join(f"*SOLID SECTION, ELSET={n}, MATERIAL=CFRP\n{THICKNESS},\n" for n in "AB")
    whole = whole.replace(plain, axes + section).replace("*STEP\n", "*AMPLITUDE, NAME=RAMP, INPUT=ramp.txt\n*STEP\n").replace(
        f"{HELD}TOP", f"{HELD}*BOUNDARY, AMPLITUDE=RAMP\nTOP")
    along = ", ".join(("0., 1., 0., -1., 0., 0.",))
    files = {"bar_nod": nodes, "a1_ele": rows, "ramp_txt": "0., 0.,\n1., 1.\n",
             "bar_ori": f", {along}\n" + "".join(f"{n}, {along}\n" for n in (1, 2, 3, 4, 11, 12, 13, 14))}
    pulled("data in files", whole, 135000.0, **files)
    refused(whole, r"deck\.inp:3: \*NODE: ", r"bar\.nod")


def check_freecad():
    """FreeCAD's Fem: rows of stars, sets of single labels with a comma, one that names another, a tie of two solids."""
    below, above = Block(0, 0, 4, True), Block(1, 1000, 4, True)
    text = "** written by FreeCAD inp file writer for CalculiX,Abaqus meshes\n** highest dimension mesh elements only.\n\n"
    text += "** Nodes\n*Node, NSET=Nall\n" + "".join(f"{n}, {x:.13E}, {y:.13E}, {z:.13E}\n" for b in (below, above)
                                                     for (x, y, z), n in b.nodes.items())
    text += "\n\n** Volume elements\n*Element, TYPE=C3D10, ELSET=Evolumes\n"
    text += "".join(f"{1 + c + 100 * k}, {', '.join(map(str, cell))}\n" for k, b in enumerate((below, above))
                    for c, cell in enumerate(b.cells))
    stars = "*" * 59
    title = stars + "\n** {}\n** written by write function\n"
    text += "\n** Define element set Eall\n*ELSET, ELSET=Eall\nEvolumes\n\n\n" + title.format("Element sets for materials")
    text += "*ELSET,ELSET=MechanicalMaterialSolid\nEvolumes\n\n" + title.format("Node sets")
    for name, b, z in (("ConstraintFixed", below, 0.0), ("ConstraintDisplacement", above, 2.0)):
        text += f"** {name}\n*NSET,NSET={name}\n" + "".join(f"{n},\n" for n in b.at_height(z)) + "\n"
    text += title.format("Surfaces") + "*SURFACE, NAME=TIE_DEP\n" + "".join(f"{101 + c},S{s}\n" for c, s in above.sides(1.0))
    text += "*SURFACE, NAME=TIE_IND\n" + "".join(f"{1 + c},S{s}\n" for c, s in below.sides(1.0))
    text += title.format("Materials") + "** FreeCAD material name: Resin\n*MATERIAL, NAME=Resin\n*ELASTIC\n70000, 0\n*DENSITY\n1.2E-09\n"
    text += title.format("Sections") + "*SOLID SECTION, ELSET=MechanicalMaterialSolid, MATERIAL=Resin\n"
    text += "*TIE, POSITION TOLERANCE=25.0, ADJUST=NO, NAME=ConstraintTie\nTIE_DEP,TIE_IND\n"
    text += "*STEP, INC=2000\n*STATIC, SOLVER=SPOOLES\n1.0,1.0,1e-05,1.0\n" + "*BOUNDARY\n"
    text += "".join(f"ConstraintFixed,{a}\n" for a in (1, 2, 3)) + f"\nConstraintDisplacement,3,3,{PULL}\n\n"
    text += title.format("Outputs --> frd file") + "*NODE FILE\nU\n*EL FILE\nS, E\n** outputs --> dat file\n*NODE PRINT, NSET="
    text += "ConstraintFixed, TOTALS=ONLY\nRF\n*OUTPUT, FREQUENCY=1\n*END STEP\n" + stars + "\n** CalculiX Input file\n"
    rows, _, _ = history(text)
    if rows:
        close("a tie of two solids", rows[-1]["reaction"], LENGTH * YOUNG * PULL / HEIGHT)


def check_femap():
    """Femap and Patran: systems of nodes, a blank *SYSTEM for the global one, sets of a part of a face, one value a line."""
    turned = {n: (x, y) for n, x, y in ((int(a), float(b), float(c)) for a, b, c in re.findall(
        r"(?m)^(\d+), (\d\.\d), (\d\.\d)$", bar()))}
    # x' is the deck's y and y' is its -x, from an origin aside.
    lower = "".join(f"{n}, {y - 3.0!r}, {5.0 - x!r}, 0.\n" for n, (x, y) in turned.items() if n < 100)
    upper_block = "".join(f"{n}, {math.hypot(x, y)!r}, {math.degrees(math.atan2(y, x))!r}, 0.\n" for n, (x, y) in turned.items()
                          if n > 100)
    mesh = bar()[bar().index("*ELEMENT"):bar().index("*ELEMENT, TYPE=COH")]
    nodes = ("** FEMAP 2020\n*SYSTEM\n5., 3., 0., 5., 9., 0.\n-4., 3., 0.\n*NODE, NSET=GLOBAL, SYSTEM=R\n" + lower +
             "*SYSTEM\n*NODE, NSET=GLOBAL, SYSTEM=C\n" + upper_block)
    step = STEP.replace("*STEP", "*STEP, INC=100, AMPLITUDE=RAMP").replace("*BOUNDARY", "*BOUNDARY, OP=NEW").replace(
        "*END", "*NODE PRINT, FREQ=0\n*EL PRINT, FREQ=0\n*RESTART, WRITE, FREQ=0\n*END")
    pulled("*SYSTEM", bar(mesh=nodes + mesh, after=step))
    pulled("two points of an axis of x", bar(mesh=nodes.replace("*SYSTEM\n5., 3., 0., 5., 9., 0.\n-4., 3., 0.\n",
                                                                "*SYSTEM\n0., 2., 0.\n").replace(
        lower, "".join(f"{n}, {x!r}, {y - 2.0!r}\n" for n, (x, y) in turned.items() if n < 100)) + mesh))
    for old, new, pattern in (("5., 9., 0.\n", "5., 3., 0.\n", "the points of the axis of x are the same"),
                              ("-4., 3., 0.\n", "5., 4., 0.\n", "lies on the axis of x"),
                              ("*SYSTEM\n5., 3.", "*SYSTEM\n5., x.", '"x."')):
        refused(bar(mesh=nodes.replace(old, new) + mesh), r"deck\.inp:\d+: \*SYSTEM: ", pattern)


def check_columns_of_nodes():
    """Coordinates that are blank or missing are 0, and normals follow them in older decks."""
    text = bar()
    for what, pattern, line in (("a blank", r"0\.0, (\d\.\d)", r"\1, , \2"), ("none behind", r"(\d\.\d), 0\.0", r"\1, \2"),
                                ("normals", r"(\d\.\d), (\d\.\d)", r"\1, \2, \3, 0., 0., 0., 1.")):
        changed = re.sub(rf"(?m)^(\d+), {pattern}$", line, text)
        expect(changed != text, "nodes are changed")
        pulled(what, changed)
    _, said = imported(re.sub(r"(?m)^(\d+), (\d\.\d), (\d\.\d)$", r"\1, \2, \3, 0., 0., 0., 1.", text))
    expect("left out  normals of *NODE" in said, "normals are left out")
    refused(text.replace("\n1, 0.0, 0.0\n", "\n1, 0.0, 0.0, 0., 0., 0., 1., 2.\n"), r"\*NODE: 8 entries")


def check_bytes():
    """A mark of UTF-8, letters of a title in it or in Latin 1, a line of blanks and tabs, ends of lines of DOS and of old Macs,
    an end of the file within the last line."""
    text = bar().replace("a bar\n", "Stab f\u00fcr die Pr\u00fcfung, *mit* Klebung\n \t \n")
    step = "".join(line + "  \t\n" for line in STEP.splitlines())
    wanted = LENGTH * stress(PULL)[0]
    for what, content in (("UTF-8", b"\xef\xbb\xbf" + text.encode()), ("Latin 1", text.encode("latin-1")),
                          ("DOS", b"\xef\xbb\xbf" + text.replace("\n", "\r\n").encode()),
                          ("an old Mac", text.replace("\n", "\r").encode()),
                          ("blanks at the ends", text.replace(STEP, step).rstrip().encode()),
                          ("a word of DOS for the end", text.encode() + b"\x1a")):
        place = folder()
        with open(os.path.join(place, "deck.inp"), "wb") as file:
            file.write(content)
        code, _, error = delam("run", os.path.join(place, "deck.inp"), "--out", os.path.join(place, "out"))
        expect(code == 0, f"{what}: {error.strip()[:300]}")
        if code == 0:
            with open(os.path.join(place, "out", "history.csv"), encoding="utf-8") as file:
                head, *lines = file.read().splitlines()
            close(what, float(lines[-1].split(",")[head.split(",").index("reaction")]), wanted)


def check_rotated_instances():
    """Abaqus/CAE: two instances of one part, the upper one turned by half a turn and moved; surfaces and sets of instances."""
    nodes = "".join(f"{1 + i + 3 * j:7d}, {i - 1.0:12.5f}, {0.5 * j:12.5f}\n" for j in range(3) for i in range(3))
    cells = "".join(f"{1 + i + 2 * j}, {1 + i + 3 * j}, {2 + i + 3 * j}, {5 + i + 3 * j}, {4 + i + 3 * j}\n"
                    for j in range(2) for i in range(2))
    text = f"""*Heading
*Preprint, echo=NO, model=NO, history=NO, contact=NO
*Part, name="Half bar"
*Node
{nodes}*Element, type=CPS4I
{cells}*Nset, nset=Foot, generate
 1, 3, 1
*Nset, nset=Side, generate
 1, 7, 3
*Elset, elset=All, generate
 1, 4, 1
*Elset, elset=_Face_S3, internal
 3, 4
*Surface, type=ELEMENT, name=Face
_Face_S3, S3
*Orientation, name=Ori-1
1., 0., 0., 0., 1., 0.
3, 0.
*Solid Section, elset=All, orientation=Ori-1, material=CFRP
{THICKNESS},
*End Part
*Assembly, name=Assembly
*Instance, name="Half bar-1", part="Half bar"
*End Instance
*Instance, name="Half bar-2", part="Half bar"
          0.,           2.,           0.
          0.,           2.,           0.,           0.,           2.,           1.,        180.
*End Instance
*Nset, nset=Top, instance="Half bar-2"
 Foot
*Nset, nset=Axis, instance="Half bar-1"
 Side
*Nset, nset=Axis, instance="Half bar-2", generate
 3, 9, 3
*End Assembly
*Material, name=CFRP
*Elastic, type=ENGINEERING CONSTANTS
 9000., {YOUNG}, 9000., .02, .3, .3, 5000., 3100.
 5000.,
{ADHERE.replace("ABOVE, BELOW", '"Half bar-2".Face, "Half bar-1".Face')}*Step, name=Step-1, nlgeom=NO, inc=1000, unsymm=YES
*Static
1., 1., 1e-05, 1.
*Boundary
"Half bar-1".Foot, YSYMM
Axis, 1, 1
Top, 2, 2, {PULL}
*Restart, write, number interval=1, time marks=NO
*Output, field
*Node Output
CF, RF, U
*Element Output, directions=YES
S, STATUS
*Contact Output
CDISP, CSDMG, CSTRESS
*Output, history
*Energy Output
ALLAE, ALLDMD
*Integrated Output, surface=Face
SOF,
*Diagnostics, nonlinear solution=DETAILED
*End Step
"""
    pulled("half a turn", text)
    _, said = imported(text)
    expect("left out  *DIAGNOSTICS" in said and "left out  *RESTART" in said and "left out  *ENERGY OUTPUT" in said, said[-300:])


def check_whole_sets_as_surfaces():
    """A surface of a set without a side has all faces of the set's elements that are on the outside."""
    for name in ("A,", "A", "A2,"):
        pulled(f"free sides of {name}", bar(glue=False, law=SURFACES.replace("A2, S3", name) + ADHERE))
    # The lower block has cohesive elements on its upper side: three are free, two faces each.
    pressed = STEP.replace(f"TOP, 2, 2, {PULL}\n", "*DSLOAD\nSKIN, P, 10.\n")
    code, said, error = delam("check", write(bar(law=GLUE + "*SURFACE, NAME=SKIN\nA,\n", after=pressed), "deck.inp"))
    expect(code == 0 and '"SKIN", 7 nodes, 6 faces' in said, f"a pressure on the free sides: {error.strip()[:300]}")
    for wrong, pattern in ((", S1", "an element or an element set and a side"), ("A, S1, S2", "an element or an element set and a side"),
                           ("NONE,", '"NONE" is not there')):
        refused(bar(glue=False, law=SURFACES.replace("A2, S3", wrong) + ADHERE), r"deck\.inp:\d+: \*SURFACE: ", pattern)


for check in (check_types_of_elements, check_cgx, check_texgen, check_freecad, check_femap, check_columns_of_nodes, check_bytes,
              check_rotated_instances, check_whole_sets_as_surfaces):
    check()
finish()
