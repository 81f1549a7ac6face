# SPDX-License-Identifier: BSD-3-Clause
"""Keywords of decks one by one, each in a deck of two blocks whose answer is known in closed form."""
import math
import os

from block_deck import LAW, NODES, POISSON, SECTION, STIFFNESS, SURFACES, YOUNG, deck, history
from deck_runs import close, imported, refused
from support import delam, expect, expect_error, finish, folder, write


def check_increments():
    """Automatic increments give a curve whatever the first is; DIRECT takes it."""
    limited, _ = history(deck())
    expect(len(limited) == 11, f"ten increments: {len(limited)}")
    for line in ("", "1., 1., 1e-5, 1.\n", "1., 1.\n", "1e-6, 1., 1e-12\n", "1., 1., 1e-36, 1e30\n"):
        rows, said = history(deck(static="*Static\n" + line))
        expect(len(rows) == 51, f"{line!r}: {len(rows)} instants")
        # The fourth is that of a tenth of the increments: 0.08 against 0.1 of the largest force.
        peak = max(row["reaction"] for row in rows)
        expect(peak > 3.5, f"{line!r}: a peak of {peak}")
        expect("no work was done" not in said, "and work is done")
    tiny, _ = history(deck(static="*Static\n1e-6, 1., 1e-12, 0.1\n"))
    expect([row["reaction"] for row in tiny] == [row["reaction"] for row in limited], "a tiny first increment")
    scene, _ = imported(deck(static="*Static, direct\n0.25, 1.\n"))
    expect("steps = 4\n" in scene, "DIRECT")
    scene, _ = imported(deck(static="*Static\n0.5, 1., 0.1, 0.5\n"))
    expect("steps = 10\n" in scene and "smallest_step = 1.0" not in scene, "a least increment")
    refused(deck(static="*Static\n0.1, 1., 0.2, 0.1\n"), r"deck\.inp:\d+: \*STATIC", "0.2, is larger than the largest")
    refused(deck(static="*Static\n0.1, -1.\n"), "-1 in a line of increments")
    # One step in which everything breaks, done as the deck says: taken whole, it compares no energy with no work.
    once = deck(static="*Static, direct\n1., 1.\n")
    _, said = history(once)
    expect("energy balance: work " in said and "no work was done" not in said, f"work within a step: {said[-600:]}")
    _, said = history(once, "--set", "solver.step_control=fixed")
    expect("off by" not in said and "no work was done, and stored" in said, f"no work: {said[-600:]}")


def check_parameters():
    wanted, _ = history(deck())
    before = ("*Parameter\n# the plies\nE = 10.**3\nnu=0.3 # of the matrix\nroot = sqrt(9.)\n"
              "opening = 1.e-2*root\nfirst = 2*(50 + 3) + 1\nlast = first + 4\nname = 'Top'\n"
              "also = -2**2 + pow(2., 2) + abs(-3) - int(3.7) + log10(1.) + sin(0.) + 2**-1 - 0.5\n")
    text = deck(before=before).replace("1000.0, 0.3", "<E>, <nu>", 1).replace("Top, 2, 2, 0.03", "<name>, 2, 2, <opening>")
    text = text.replace("107, 111", "<first>, <last>").replace("*Nset, nset=Top", "*Nset, nset=<name>")
    text = text.replace("1, 0.0, 0.0\n", "1, <also>, <also>\n", 1).replace("a block", "a <block>")
    found, _ = history(text)
    worst = max(abs(a["reaction"] - b["reaction"]) for a, b in zip(found, wanted, strict=True))
    expect(worst < 1e-9, f"the deck of the values: {worst}")
    for line, pattern in (("a = 1/2", "whole numbers is cut off by some releases"), ("a = 1./0", "division by 0"),
                          ("a = b + 1", 'no parameter "b"'), ("a = open('x')", "no function that is evaluated"),
                          ("a = __import__('os')", "no function that is evaluated"), ("a = 3 +", "missing at the end"),
                          ("a = (1.", "is missing"), ("a = 1 2", "not understood"), ("a = 'x", "second quote"),
                          ("a = 'x'*3", "a text where a number"), ("a = sqrt(-1.)", "no finite number"),
                          ("a = 2**200", "beyond 9e15"), ("a = 9999999999*9999999999", "beyond 64 bits"),
                          ("a = x.y", "no parameter"), ("1a = 3", "NAME = EXPRESSION"), ("a = " + 200 * "(", "100"),
                          ("a = [1]", "a number or name is expected"), ("a == 3", "a number or name is expected"),
                          ("a = " + 200 * "-" + "1", "100"), ("a = 'x" + 300 * "y" + "'", "256")):
        refused(deck(before=f"*Parameter\n{line}\n"), r"deck\.inp:2: \*PARAMETER", pattern)
    refused(deck(elastic="*Elastic\n<young>, 0.3\n", before="*Parameter\nYoung = 3.\n"), r"<young>", "Young")
    refused(deck(elastic="*Elastic\n<young, 0.3\n"), "is not ended")


def block(first, cells, at, height, plane=True):
    """Nodes and cells of a block of 4 by `height` (by 2 in space) in one row, from the number `first` on."""
    rows = 1 if plane else 2
    width = [""] if plane else [f", {2.0 * j / rows}" for j in range(rows + 1)]
    layer = (cells + 1) * len(width)
    text = "*Node\n" + "".join(f"{first + i + (cells + 1) * j + layer * k}, {4.0 * i / cells}{y}, {at + height * k}\n"
                               for k in (0, 1) for j, y in enumerate(width) for i in range(cells + 1))
    corners = ((0, 0), (1, 0), (1, 1), (0, 1)) if plane else tuple(
        (a, b, c) for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)))

    def node(i, j, corner):
        a, b, c = (corner[0], 0, corner[1]) if plane else corner
        return first + i + a + (cells + 1) * (j + b) + layer * c
    lists = [[node(i, j, corner) for corner in corners] for j in range(rows) for i in range(cells)]
    return text, lists, list(range(first, first + layer)), list(range(first + layer, first + 2 * layer))


def tower(plane, lower, upper, middle=0, thick=0.0, loads="0.002", extra="", shared=False):
    """A block on another, tied: with cells of their own, and with `middle` cohesive elements between them."""
    text, low, bottom, seat = block(1, lower, 0.0, 1.0, plane)
    more, up, sole, top = block(1001, upper, 1.0 + thick, 1.0, plane)
    text += more
    number = 0
    for name, lists in (("Low", low), ("Up", up)):
        text += f"*Element, type={'CPS4' if plane else 'C3D8'}, elset={name}\n"
        for nodes in lists:
            number += 1
            text += f"{number}, {', '.join(map(str, nodes))}\n"
        text += f"*Solid section, elset={name}, material=M\n,\n"
    faces = ("S1", "S3") if plane else ("S1", "S2")
    text += f"*Surface, name=Seat\nLow, {faces[1]}\n*Surface, name=Sole\nUp, {faces[0]}\n"
    ties = "*Tie, name=T, adjust=yes\nSole, Seat\n"
    if middle:
        more, glue, under, above = block(2001, middle, 1.0, thick, plane)
        if shared:  # with the nodes of the lower block
            own = dict(zip(under, seat, strict=True))
            glue = [[own.get(n, n) for n in nodes] for nodes in glue]
            more = "\n".join(line for line in more.split("\n") if not line or int(line.split(",")[0] if line[0] != "*"
                                                                                   else 0) not in own)
        text += more + f"*Element, type={'COH2D4' if plane else 'COH3D8'}, elset=Coh\n"
        for nodes in glue:
            number += 1
            text += f"{number}, {', '.join(map(str, nodes))}\n"
        text += SECTION + LAW
        text += f"*Surface, name=Glue-below\nCoh, {faces[0]}\n*Surface, name=Glue-above\nCoh, {faces[1]}\n"
        ties = ("" if shared else "*Tie, name=A\nGlue-below, Seat\n") + "*Tie, name=B\nGlue-above, Sole\n"
    text += "".join(f"*Nset, nset={n}\n" + "".join(f"{x}\n" for x in s) for n, s in (("Bottom", bottom), ("Top", top)))
    up = 2 if plane else 3
    held = f"Bottom, {up}\n1, 1\n" + ("" if plane else f"1, 2\n{lower + 1}, 2\n")
    return (text + ties + f"*Material, name=M\n*Elastic\n{YOUNG}, {POISSON if not middle else 0.0}\n" + extra +
            f"*Step\n*Static\n0.5, 1., 1e-5, 0.5\n*Boundary\n{held}Top, {up}, {up}, {loads}\n*End step\n")


def check_ties():
    """A bar of two parts that are tied stretches like a whole one, whatever cells they have."""
    for plane in (True, False):
        area = 4.0 if plane else 8.0
        for lower, upper in ((4, 4), (4, 6), (5, 3)):
            rows, _ = history(tower(plane, lower, upper))
            close(f"{plane=}: {lower} cells tied to {upper}", rows[-1]["reaction"], YOUNG * area * 0.002 / 2)
        # A layer of cohesive elements between them is a spring in series, wherever its own mesh comes from.
        wanted = area * 0.002 / (2 / YOUNG + 1 / STIFFNESS)
        for shared, thick, middle in ((False, 0.0, 4), (False, 0.0, 8), (False, 0.01, 4), (True, 0.0, 4)):
            rows, said = history(tower(plane, 4, 6, middle, thick, shared=shared))
            close(f"{plane=} {shared=}: {middle} tied elements, {thick} thick", rows[-1]["reaction"], wanted)
            expect("is tied: the bodies to which it is tied have its law" in said, "that they are tied is said")
        # And it breaks.
        rows, _ = history(tower(plane, 4, 6, 4, loads="0.1"))
        close("what it takes to break", rows[-1]["dissipated"], 0.01 * area, 1e-6)
    text = tower(True, 4, 6, 4)
    refused(text.replace("*Tie, name=B\nGlue-above, Sole\n", ""), r"deck\.inp:\d+", "upper face is in no surface of a")
    refused(text.replace("Glue-above, Sole", "Glue-above, Soul"), '\\*TIE: surface "Soul" is not there')
    refused(text.replace("Coh, S3", "Coh, S2"), "faces of the cohesive element .* are S1 and S3")
    refused(tower(True, 4, 4).replace("Seat\nLow, S3", "Seat\n1, S3"), "touch at 4 sides, of which 1 are tied")


def check_pins():
    """Nodes that an MPC of type TIE or PIN makes one, with sets or one by one."""
    for plane in (True, False):
        text = tower(plane, 3, 3)
        seat = range(5, 9) if plane else range(13, 25)
        sole = range(1001, 1005) if plane else range(1001, 1013)
        area = 4.0 if plane else 8.0
        single = "*Mpc\n" + "".join(f"TIE, {a}, {b}\n" for a, b in zip(sole, seat, strict=True))
        sets = (f"*Nset, nset=A, generate\n{sole[0]}, {sole[-1]}\n*Nset, nset=B, generate\n{seat[0]}, {seat[-1]}\n"
                "*Mpc\nPIN, A, B\n")
        for card in (single, sets):
            rows, _ = history(text.replace("*Tie, name=T, adjust=yes\nSole, Seat\n", card))
            close(f"{plane=}: pinned nodes", rows[-1]["reaction"], YOUNG * area * 0.002 / 2)
    refused(text.replace("*Tie, name=T, adjust=yes\nSole, Seat\n", "*Mpc\nBEAM, 1001, 13\n"), "BEAM is not imported",
            "KINEMATIC")


def same(what, text, other):
    rows, reference = history(text)[0], history(other)[0]
    worst = max(abs(a["reaction"] - b["reaction"]) for a, b in zip(rows, reference, strict=True))
    expect(worst < 1e-9 and max(row["reaction"] for row in reference) > 1, f"{what}: {worst}")


def number(scene, key):
    return float(next(line for line in scene.splitlines() if line.startswith(key + " = ")).split(" = ")[1])


def check_constants():
    same("TYPE=ISO", deck(elastic="*Elastic, type=ISO\n1000., 0.3\n"), deck())
    rows = [[100.0, 20.0, 10.0], [20.0, 50.0, 5.0], [10.0, 5.0, 30.0]]
    scene, _ = imported(deck(elastic="*Elastic, type=ORTHOTROPIC\n100., 20., 50., 10., 5., 30., 7., 8.,\n9.\n"))
    modulus = [number(scene, f"E{i}") for i in (1, 2, 3)]
    ratio = {(0, 1): number(scene, "nu12"), (0, 2): number(scene, "nu13"), (1, 2): number(scene, "nu23")}
    soft = [[1 / modulus[i] if i == j else -ratio[min(i, j), max(i, j)] / modulus[min(i, j)] for j in range(3)]
            for i in range(3)]
    worst = max(abs(sum(soft[i][k] * rows[k][j] for k in range(3)) - (i == j)) for i in range(3) for j in range(3))
    expect(worst < 1e-12, f"compliance times stiffness is 1: {worst}")
    expect([number(scene, g) for g in ("G12", "G13", "G23")] == [7.0, 8.0, 9.0], "shear moduli")
    refused(deck(elastic="*Elastic, type=ORTHOTROPIC\n1., 20., 50., 10., 5., 30., 7., 8.,\n9.\n"), "positive definite")
    refused(deck(elastic="*Elastic, type=ANISO\n1., 2.\n"), "TYPE=ANISO is not imported")


def check_contacts():
    """The same adhesion from pairs and from general contact, and where its stiffness comes from."""
    law = LAW[LAW.index("*Damage init"):]

    def glued(behavior="*Cohesive behavior\n1e3, 1e3, 1e3\n", pair="*Contact pair, interaction=I\nUpper, Lower\n", of=law):
        return deck(cohesive=False, extra=SURFACES + "*Surface interaction, name=I\n1.,\n" + behavior + of + pair)
    wanted = glued()
    same("cohesive elements", deck(), wanted)
    same("ORIGINAL CONTACTS", glued(behavior="*Cohesive behavior, eligibility=ORIGINAL CONTACTS\n1e3, 1e3, 1e3\n"), wanted)
    general = "*Surface interaction, name=Default\n*Contact\n*Contact inclusions, all exterior\n*Contact property assignment\n"
    same("two surfaces", glued(pair=general + " , , Default\nUpper, Lower, I\n"), wanted)
    same("everything that touches", glued(pair=general + " , , I\n"), wanted)
    same("no stiffness", glued(behavior="*Cohesive behavior\n"), glued(behavior="*Cohesive behavior\n1e4, 1e4, 1e4\n"))
    expect("about 10 times" in imported(glued(behavior="*Cohesive behavior\n"))[1], "which stiffness is said")
    refused(glued(pair=general + "Upper, , I\n"), r"\*CONTACT PROPERTY ASSIGNMENT", "or none of both")
    # A surface and a set of nodes of one name.
    named = wanted.replace("name=Upper", "name=Top").replace("Upper, Lower", "Top, Lower")
    same("one name", named, wanted)
    expect('is a node set and a surface: the surface is "Top-surface" here' in imported(named)[1], "and the new name")


def check_meshes():
    """Nodes in other systems, and those that are generated."""
    polar = [(n, math.hypot(x, y), math.degrees(math.atan2(y, x))) for n, x, y in NODES]
    same("SYSTEM=C", deck(nodes=polar).replace("*Node\n", "*Node, system=C\n"), deck())
    scene, _ = imported(deck(nodes=[(n, x, 0.0) if y == 0 else (n, x, y) for n, x, y in NODES]))
    expect("4 cells" not in scene, "and rectangular ones stay")
    text = ("*Node, nset=Ends\n1, 0., 0.\n5, 4., 0.\n6, 0., 2.\n10, 4., 2.\n*Ngen, nset=Bottom\n1, 5\n*Ngen, nset=Top\n"
            "6, 10, 1\n*Element, type=CPS4\n11, 1, 2, 7, 6\n*Elgen, elset=Bar\n11, 4, 1, 10\n"
            "*Solid section, elset=Bar, material=M\n,\n*Material, name=M\n*Elastic\n1e3, 0.3\n"
            "*Step\n*Static, direct\n1., 1.\n*Boundary\nBottom, 2\n1, 1\nTop, 2, 2, 0.002\n*End step\n")
    close("a generated bar", history(text)[0][-1]["reaction"], YOUNG * 4 * 0.002 / 2)
    refused(text.replace("11, 4, 1, 10", "11, 40000, 40000, 1, 40000, 9"), r"\*ELGEN", "at least|more than")
    refused(text.replace("6, 10, 1\n", "6, 10, 3\n"), r"\*NGEN", "whole increments")
    refused(text.replace("11, 4, 1, 10", "12, 4"), r"\*ELGEN: element 12 is not there")


def check_loads():
    bar = tower(True, 4, 4)
    pressed = bar.replace("Top, 2, 2, 0.002\n", "*Dload\nUp, P3, 5.\n")
    close("the energy under a pressure", history(pressed)[0][-1]["stored_bulk"], 5.0 ** 2 / (2 * YOUNG) * 8)
    refused(pressed.replace("P3", "GRAV"), r"\*DLOAD", "GRAV.* is not imported: pressures")
    # Axis 1 of the nodes above is y, axis 2 is -x.
    turned = "*Transform, nset=Top\n0., 1., 0., -1., 0., 0.\n"
    same("TRANSFORM", deck(extra=turned, held="Bottom, 2\n1, 1\nTop, 2\n", loads="Top, 1, 1, 0.03\n"), deck())
    free = bar.replace("Top, 2, 2, 0.002\n", "*Cload\nTop, 2, 0.5\n")
    aside = bar.replace("Top, 2, 2, 0.002\n", "*Cload\nTop, 1, 0.5\n").replace("*Material", turned + "*Material", 1)
    close("a force along axis 1 of a TRANSFORM", history(aside)[0][-1]["stored_bulk"], history(free)[0][-1]["stored_bulk"])
    refused(deck(extra="*Transform, nset=Top\n0., 1., 0., -1., 0., 0.\n", loads="All, 1\n"), "have a \\*TRANSFORM")
    moving = deck(static="*Static\n0.1, 2., 1e-5, 0.2\n", loads="").replace(
        "*End step", "*Boundary, type=VELOCITY\nTop, 2, 2, 0.03\n*End step")
    later = "*Step\n*Static\n0.1, 1., 1e-5, 0.1\n*End step\n"
    rows, said = history(moving + later)
    close("a velocity of 0.03 over 2", rows[10]["load"], 0.06)
    close("that goes on", rows[-1]["load"], 0.09)
    expect("VELOCITY: displacements that grow evenly" in said, "is said")
    same("RIKS", deck(static="*Static, riks\n0.01, 1., 1e-9, 0.1, , 107, 2, 0.03\n"), deck(static="*Static\n"))
    refused(deck(static="*Static, riks\n", after="*Cload\nTop, 2, 1.\n"), "forces in a step with RIKS")


def check_temperatures():
    """Free expansion, and the stress of what is held."""
    heat = "*Initial conditions, type=TEMPERATURE\nEvery, 180.\n"
    change = "*Temperature\nEvery, 20.\n"
    sets = "*Elset, elset=Cells\nLow, Up\n*Nset, nset=Every, elset=Cells\n"
    strain = 1e-5 * 160
    for plane in (True, False):
        def bar(between, at=change, alpha="*Expansion\n1e-5,\n", before=heat):
            text = tower(plane, 4, 4, extra=alpha + sets + before)
            top = "Top, 2, 2, 0.002\n" if plane else "Top, 3, 3, 0.002\n"
            return text.replace(top, between + at)
        held = bar("Top, 2\n" if plane else "Top, 3\n")
        rows, _ = history(held)
        stored = rows[-1]["stored_bulk"]
        close(f"{plane=}: a held bar that cools", stored, YOUNG * strain ** 2 / 2 * (8 if plane else 16))
        close(f"{plane=}: a free one", history(bar(""))[0][-1]["stored_bulk"], 0.0)
        for same_as, text in (("an amplitude", bar("Top, 2\n" if plane else "Top, 3\n", at="*Temperature, amplitude=A\n"
                                                   "Every, 1.\n").replace("*Step", "*Amplitude, name=A\n0., 180., 1., 20.\n"
                                                                          "*Step", 1)),
                              ("ORTHO", held.replace("*Expansion\n1e-5,", "*Expansion, type=ORTHO\n1e-5, 1e-5, 1e-5"))):
            close(f"{plane=}: {same_as}", history(text)[0][-1]["stored_bulk"], stored)
        scene, _ = imported(bar("", at=""))
        expect("[[thermal]]" not in scene, "a constant temperature does nothing")
    expect("[[thermal]]" not in imported(bar("", at="*Temperature\nEvery, 180.\n"))[0], "nor does one that stays")
    refused(bar("", at="*Temperature\nTop, 20.\n"), r"deck\.inp:\d+: \*TEMPERATURE",
            '"Top" has .* of the .* nodes of "Up", and not node 1001')
    refused(bar("", at="*Temperature\nEvery, 20., 30.\n"), "through the thickness")
    refused(bar("", alpha="*Expansion, type=ANISO\n1e-5,\n"), r"\*EXPANSION: TYPE=ANISO")


def check_ends():
    """Cohesive elements that end within a body: refused with what to do, and that gives what a tie of the rest gives."""
    text = deck().replace("201, 6, 7, 103, 102\n202, 7, 8, 104, 103\n", "")
    assert "203, 8" in text and "\n201, 6" not in text
    parts = text.replace("*Solid section, elset=Up, material=M\n1.\n",
                         "*Elset, elset=Beside\n103, 104\n*Elset, elset=Rest\n101, 102\n" + "".join(
                             f"*Solid section, elset={name}, material=M\n1.\n" for name in ("Beside", "Rest")))
    tied = parts.replace("*Step", "*Surface, name=Seat\n1, S3\n2, S3\n*Surface, name=Sole\nRest, S1\n"
                         "*Tie, name=T\nSole, Seat\n*Step", 1)

    def whole(text):
        for upper, lower in ((102, 6), (103, 7), (104, 8)):
            text = text.replace(f"{upper}, {upper - 96.0 - 6}, 1.0\n", "")
            text = "\n".join(",".join(f" {lower}" if i > 0 and field.strip() == str(upper) else field
                                      for i, field in enumerate(line.split(",")))
                             if line.count(",") == 4 else line for line in text.split("\n"))
        return text
    same("a rest that shares its nodes", whole(parts), tied)
    same("two bodies that share nodes", whole(text), tied)
    one = whole(text).replace("*Solid section, elset=Up, material=M\n1.\n", "").replace("elset=Low, material", "elset=Both, material")
    same("a tip within one body", one.replace("*Solid", "*Elset, elset=Both\nLow, Up\n*Solid", 1), tied)


def check_left_out():
    """A scene by hand is told of the cohesive elements of its mesh, and whether a law takes them."""
    place = folder()
    text = deck()
    write(text[:text.index("*Step")].replace("elset=Up\n", "elset=Renamed\n", 1).replace("elset=Up,", "elset=Renamed,"),
          "mesh.inp", place)
    scene = ('schema = 1\n[mesh]\nfile = "mesh.inp"\n[[materials]]\nname = "M"\nyoung = 1000\npoisson = 0.3\n'
             '[[bodies]]\nname = "*"\nmaterial = "M"\n[[laws]]\nname = "C"\nnormal_stiffness = 1000\n'
             'tangential_stiffness = 1000\nnormal_strength = 1\ntangential_strength = 1\nnormal_toughness = 0.01\n'
             'tangential_toughness = 0.01\n[time]\nend = 1\nsteps = 1\n[[supports]]\nset = "All"\nfix = ["x", "y"]\n')
    for held, left in (("contact = true", True), ('law = "C"', False)):
        said = delam("check", write(scene + f'[[interfaces]]\na = "Low"\nb = "Renamed"\n{held}\n', "s.toml", place))
        expect(said[0] == 0, f"check: {said[1:]}")
        said = said[1] + said[2]
        expect('cohesive: 4 elements of "Coh"' in said, f"what there is: {said[-900:]}")
        expect(("4 cohesive elements of the mesh left out" in said) == left, f"{held}: {said[-900:]}")


def check_cohesive_nodes():
    """An element whose nodes begin at another corner is told its order, with which it runs."""
    text = deck()
    first = text.index("201, 6, 7, 103, 102")
    turned = text.replace("201, 6, 7, 103, 102", "201, 7, 103, 102, 6")
    line = 1 + text[:first].count("\n")
    refused(turned, rf'deck\.inp:{line}: \*ELEMENT: element 201 of "Coh" has a face that is no side', "write 201, 103, 102, 6, 7")
    same("in that order", text.replace("201, 6, 7, 103, 102", "201, 103, 102, 6, 7"), text)


def check_messages():
    """What a file is told that is no deck."""
    text = tower(True, 4, 4)
    expect_error(delam("run", write(text[:text.index("*Step")], "mesh.inp"), "--out", os.path.join(folder(), "out")), 2,
                 "as its mesh.file")
    for start, program in (("/BATCH\n/PREP7\nET,1,185\n", "ANSYS"), ("SOL 101\nCEND\n", "Nastran")):
        expect_error(delam("check", write(start, "other.inp")), 2, "no input file of Abaqus", program)
    part = text.replace("*Node\n", "*Part, name=P\n*Node\n", 1)
    part = part.replace("*Material, name=M", "*End part\n*Material, name=M", 1)
    for old, new, pattern in (("type=CPS4", "type=CAX4", "CAX4 is not read: axisymmetry stays out"),
                              ("type=CPS4", "type=S4R", "S4R is not read: shells stay out"),
                              ("type=CPS4", "type=U1", "U1 is not read: user elements stay out"),
                              ("*Static", "*Dynamic, explicit", "DYNAMIC: explicit steps stay out"),
                              ("*Elastic\n1000.0, 0.3", "*User material, constants=1\n3.", "user materials stay out"),
                              ("*Material", "*Transform, nset=Top, type=C\n0., 1., 0., 1., 0., 0.\n*Material", "TYPE=C is")):
        assert old in text, old
        refused(text.replace(old, new, 1), r"deck\.inp:\d+: \*", pattern)
    refused(part, 'part "P" is in no \\*INSTANCE: give it one')


def check_cae():
    """A cohesive layer meshed apart and tied between two instances, as Abaqus/CAE writes it."""
    def part(name, kind, cells, height, section):
        text, lists, _, _ = block(1, cells, 0.0, height, plane=False)
        text = f"*Part, name={name}\n{text}*Element, type={kind}\n"
        text += "".join(f"{i + 1}, {', '.join(map(str, nodes))}\n" for i, nodes in enumerate(lists))
        return (text + f"*Nset, nset=Set-1, generate\n1, {6 * (cells + 1)}, 1\n*Elset, elset=Set-1, generate\n1, {2 * cells}, 1\n" +
                section + "*End Part\n**\n")
    text = "*Parameter\nE = 1.e3\npull = 0.05*2\n*Heading\n** Job name: Job-1 Model name: Model-1\n*Preprint, echo=NO\n"
    text += part("Block", "C3D8R", 4, 1.0, "** Section: S\n*Solid Section, elset=Set-1, material=M\n,\n")
    text += part("Layer", "COH3D8", 6, 0.01, "*Cohesive Section, elset=Set-1, material=C, response=TRACTION SEPARATION\n1.,\n")
    text += ("*Assembly, name=Assembly\n*Instance, name=Block-1, part=Block\n*End Instance\n"
             "*Instance, name=Layer-1, part=Layer\n0., 0., 1.\n*End Instance\n"
             "*Instance, name=Block-2, part=Block\n0., 0., 1.01\n*End Instance\n")
    for name, instance, count, side in (("Low", "Block-1", 8, 2), ("High", "Block-2", 8, 1), ("Under", "Layer-1", 12, 1),
                                        ("Over", "Layer-1", 12, 2)):
        text += (f"*Elset, elset=_{name}_S{side}, internal, instance={instance}, generate\n1, {count}, 1\n"
                 f"*Surface, type=ELEMENT, name={name}\n_{name}_S{side}, S{side}\n")
    text += ("*Nset, nset=Bottom, instance=Block-1, generate\n1, 15, 1\n*Nset, nset=Top, instance=Block-2, generate\n16, 30, 1\n"
             "*Tie, name=Constraint-1, adjust=yes\nUnder, Low\n*Tie, name=Constraint-2, adjust=no, position tolerance=0.1\n"
             "Over, High\n*End Assembly\n*Material, name=M\n*Elastic\n<E>, 0.\n" + LAW +
             "*Step, name=Step-1, nlgeom=YES, inc=1000\n*Static\n1., 1., 1e-05, 1.\n*Boundary\nBottom, ENCASTRE\n"
             "Top, 1, 1\nTop, 2, 2\nTop, 3, 3, <pull>\n*Restart, write, frequency=0\n"
             "*Output, field, variable=PRESELECT\n*End Step\n")
    rows, _ = history(text)
    expect(len(rows) == 51, f"{len(rows)} instants")
    # Two blocks and a layer in series, and the toughness of the whole face at the end. NLGEOM changes the third digit.
    close("its stiffness", rows[1]["reaction"] / rows[1]["load"], 8 / (2 / YOUNG + 1 / STIFFNESS), 0.01)
    close("its toughness", rows[-1]["dissipated"], 0.01 * 8, 1e-3)
    refused(text.replace("Over, High\n", "Over, Low\n"), "lies within .Block-1.Set-1.")


check_cae()
check_increments()
check_parameters()
check_temperatures()
check_cohesive_nodes()
check_messages()
check_left_out()
check_ends()
check_ties()
check_pins()
check_constants()
check_contacts()
check_meshes()
check_loads()
finish()
