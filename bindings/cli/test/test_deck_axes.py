# SPDX-License-Identifier: BSD-3-Clause
"""Material axes of decks that differ from cell to cell, by single cells that are drawn along y: their modulus is known for
each angle of the fibres."""
import csv
import math
import os
import re

from deck_runs import history, refused
from support import delam, expect, finish, folder, write

E1, E2, NU12, G12 = 100.0, 10.0, 0.25, 7.0
STRAIN, SIDE = 0.001, 0.5
MATERIAL = f"*Material, name=M\n*Elastic, type=ENGINEERING CONSTANTS\n{E1}, {E2}, 12., {NU12}, 0.2, 0.3, {G12}, 6.,\n5.,\n"
TABLE = "*Distribution table, name=T\ncoord3d, coord3d\n"
# Centres of cells, 60 to 300 degrees about the origin and outside of it.
CENTRES = [(3.0, 0.0), (2.0, 2.0), (0.0, 4.0), (-3.0, 1.0), (1.0, -2.5)]


def modulus(degrees):
    """That along y of fibres at an angle to x, where nothing holds the sides."""
    c, s = math.sin(math.radians(degrees)) ** 2, math.cos(math.radians(degrees)) ** 2
    return 1 / (c * c / E1 + (1 / G12 - 2 * NU12 / E1) * s * c + s * s / E2)


def energy(plane, angles):
    return sum(modulus(angle) for angle in angles) * STRAIN ** 2 / 2 * SIDE ** (2 if plane else 3)


def deck(plane, orientation, moved=False, section="", more=""):
    """Cells apart from each other; `moved`: as a part that is shifted and turned by a right angle about z."""
    nodes, elements, fixed, held = "", "", "", ""
    bottom, top = [], []
    for i, (x, y) in enumerate(CENTRES):
        numbers = []
        for z in (None,) if plane else (-SIDE / 2, SIDE / 2):
            for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                numbers.append(10 * i + len(numbers) + 1)
                (bottom if b < 0 else top).append(numbers[-1])
                nodes += f"{numbers[-1]}, {x + a * SIDE / 2}, {y + b * SIDE / 2}" + ("\n" if z is None else f", {z}\n")
        elements += f"{i + 1}, {', '.join(map(str, numbers))}\n"
        own = "I." if moved else ""
        fixed += f"{own}{numbers[0]}, {2 if moved else 1}\n"
        if not plane:
            held += f"{own}{numbers[0]}, 3\n{own}{numbers[1]}, 3\n"
    text = f"*Node\n{nodes}*Element, type={'CPS4' if plane else 'C3D8'}, elset=Cells\n{elements}"
    text += "".join(f"*Nset, nset={name}\n" + "".join(f"{n}\n" for n in numbers)
                    for name, numbers in (("Bottom", bottom), ("Top", top)))
    text += f"*Elset, elset=Two\n2, 4\n{more}{orientation}*Solid section, elset=Cells, material=M{section}\n,\n"
    if moved:
        text = (f"*Part, name=P\n{text}*End part\n*Assembly, name=A\n*Instance, name=I, part=P\n3., -5., 0.\n"
                "1., 0., 0., 1., 0., 1., 90.\n*End instance\n*End assembly\n")
    dof, sign, own = (1, -1, "I.") if moved else (2, 1, "")
    return (text + MATERIAL + f"*Step\n*Static\n1., 1., 1e-5, 1.\n*Boundary\n{own}Bottom, {dof}\n{fixed}{held}"
            f"{own}Top, {dof}, {dof}, {sign * STRAIN * SIDE}\n*End step\n")


def stored(what, text, wanted):
    rows, said, _ = history(text)
    found = float(rows[-1]["stored_bulk"]) if rows else math.nan
    expect(math.isclose(found, wanted, rel_tol=1e-9), f"{what}: {found} is stored, {wanted} is expected")
    return said


def orientation(first, second="", system=""):
    return f"*Orientation, name=O{system}\n{first}\n" + (f"{second}\n" if second else "")


def direction(degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return f"{c!r}, {s!r}, 0., {-s!r}, {c!r}, 0."


def check_cylinders():
    """Fibres along the radius, around the axis and between, with one at an angle; also in an instance that is turned."""
    of_section = ", orientation=O"
    for plane in (True, False):
        for moved in (False, True):
            for second, turned in (("", 0), ("3, 90.", 90), ("3, 20.", 20), ("3,", 0)):
                angles = [math.degrees(math.atan2(y - 1.0, x - 0.5)) + turned for x, y in CENTRES]
                text = deck(plane, orientation("0.5, 1., 0., 0.5, 1., 2.", second, ", system=CYLINDRICAL"), moved, of_section)
                said = stored(f"{plane=} {moved=} {second!r}", text, energy(plane, angles))
                expect('5 cells with the axes of *ORIENTATION "O", radial' in said, f"the axes are told: {said[:600]}")
    refused(deck(False, orientation("3., 0., 0., 3., 0., 1.", "", ", system=CYLINDRICAL"), section=of_section),
            r"deck\.inp:\d+: \*ORIENTATION: element 1: the centre of the element lies on the axis")
    refused(deck(True, orientation("3., 0., 0., 3., 0., 0.", "", ", system=CYLINDRICAL"), section=of_section), "are the same")
    refused(deck(True, orientation("3., 0., 0.", "", ", system=CYLINDRICAL"), section=of_section), "6 coordinates, two points")
    refused(deck(True, orientation("3., 0., 0., 1., 1., 1.", "", ", system=SPHERICAL"), section=of_section), "or CYLINDRICAL")


def check_distributions():
    """Axes by elements, sets of them and for all others, in the plane, in space and in an instance that is turned."""
    of_section = ", orientation=O"

    def distributed(lines, second="3, 0."):
        return TABLE + "*Distribution, name=D, location=ELEMENT, table=T\n" + lines + orientation("D", second)
    lines = f", {direction(10)}\n1, {direction(35)}\nTwo, {direction(90)}\n"
    for plane in (True, False):
        for moved in (False, True):
            for second, turned in (("3, 0.", 0), ("3, 25.", 25), ("", 0)):
                angles = [angle + turned for angle in (35, 90, 10, 90, 10)]
                said = stored(f"{plane=} {moved=} {second!r}", deck(plane, distributed(lines, second), moved, of_section),
                              energy(plane, angles))
                expect('each as *DISTRIBUTION "D" has it' in said, f"the axes are told: {said[:600]}")
            # The digits of one orientation.
            whole, _, _ = history(deck(plane, orientation(direction(30)), moved, of_section))
            cells, _, _ = history(deck(plane, distributed(f", {direction(30)}\n"), moved, of_section))
            for key in ("reaction", "stored_bulk"):
                expect([row[key] for row in whole] == [row[key] for row in cells], f"{plane=} {moved=}: equal axes, {key}")

    def wrong(lines, pattern, text=None, change=("", "")):
        bad = text or deck(True, distributed(lines), section=of_section)
        assert change[0] in bad
        refused(bad.replace(*change, 1) if change[0] else bad, r"deck\.inp:\d+: \*", pattern)
    wrong(f"1, {direction(30)}\n", '"D" has no line for element 2')
    wrong(f", {direction(30)}\n, {direction(20)}\n", "another line for all other")
    wrong(f", {direction(30)}\n2, {direction(20)}\nTwo, {direction(20)}\n", "element 2 has another line")
    wrong(f", {direction(30)}\n9, {direction(20)}\n", "element 9 is not there")
    wrong(", 1., 0., 0.\n", "4 entries: an element")
    wrong(", 1., 0., 0., 2., 0., 0.\n", "element 1: the points lie on one line")
    good = f", {direction(30)}\n"
    wrong(good, "COORD3D, COORD3D", change=("coord3d, coord3d", "angle"))
    wrong(good, "LOCATION=NODE", change=("location=ELEMENT", "location=NODE"))
    wrong(good, 'table "X" is not there', change=("table=T", "table=X"))
    wrong(good, '"E" is not there', change=("name=O\nD", "name=O\nE"))
    wrong(good, "an angle is expected", change=("O\nD\n3, 0.", "O\nD\n3, D"))


def check_expansion():
    """Fibres that stretch otherwise than what is across them, in an isotropic body that is held and cools."""
    first, second, cooled, young = 3e-5, 1e-5, 50.0, 100.0
    own = f"*Material, name=M\n*Elastic\n{young}, 0.\n*Expansion, type=ORTHO\n{first}, {second}, {second}\n"
    for plane in (True, False):
        text = deck(plane, orientation("0.5, 1., 0., 0.5, 1., 2.", "", ", system=CYLINDRICAL"), section=", orientation=O")
        text = text.replace(MATERIAL, own + "*Nset, nset=Every\nBottom, Top\n*Initial conditions, type=TEMPERATURE\n"
                            f"Every, {cooled}\n").replace("*Boundary\n", "*Temperature\nEvery, 0.\n*Boundary\n")
        text = text.replace(f", 2, 2, {STRAIN * SIDE}", ", 2")
        sines = [math.sin(math.atan2(y - 1.0, x - 0.5)) ** 2 for x, y in CENTRES]
        stored(f"{plane=}: cooled", text, sum(young / 2 * (cooled * (first * s + second * (1 - s))) ** 2
                                              for s in sines) * SIDE ** (2 if plane else 3))


def check_meshes():
    """A scene that is written by hand has the axes of its mesh, unless it gives a body some."""
    place = folder()
    text = deck(True, orientation("0.5, 1., 0., 0.5, 1., 2.", "", ", system=CYLINDRICAL"), section=", orientation=O")
    path = write(text, "deck.inp", place)
    code, scene, _ = delam("import", path)
    expect(code == 0 and "axes = " not in scene and "differ from cell to cell" in scene, f"import: {scene[:400]}")
    for body, angles in (("", [math.degrees(math.atan2(y - 1.0, x - 0.5)) for x, y in CENTRES]),
                         ("axes = [[0, 1, 0], [-1, 0, 0]]\n", 5 * [90])):
        own = re.sub(r"# Its axes.*\n", body, scene)
        code, _, error = delam("run", write(own, "scene.toml", place), "--out", os.path.join(place, "out"))
        expect(code == 0, error[:300])
        with open(os.path.join(place, "out", "history.csv"), newline="", encoding="utf-8") as file:
            found = float(list(csv.DictReader(file))[-1]["stored_bulk"])
        expect(math.isclose(found, energy(True, angles), rel_tol=1e-9), f"{body!r}: {found}, {energy(True, angles)}")


check_cylinders()
check_distributions()
check_expansion()
check_meshes()
finish()
