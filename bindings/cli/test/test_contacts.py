# SPDX-License-Identifier: BSD-3-Clause
"""Contact of decks and scenes between meshes that were not made for each other."""
import csv
import math
import os
import re

from support import delam, expect, expect_error, finish, folder, write


def bar(lower, upper, slave):
    """A deck: two blocks of 1 x 1 on each other, so many cells along their common face; pressed by 5e-4."""
    text, first, cell, sets = "*NODE\n", 1, 1, {}
    elements = ""
    for name, n, z in (("LOW", lower, 0.0), ("UP", upper, 1.0)):
        for j in range(3):
            text += "".join(f"{first + j * (n + 1) + i}, {i / n}, {z + 0.5 * j}\n" for i in range(n + 1))
        elements += f"*ELEMENT, TYPE=CPE4, ELSET={name}\n"
        for j in range(2):
            for i in range(n):
                at = first + j * (n + 1) + i
                elements += f"{cell + j * n + i}, {at}, {at + 1}, {at + n + 2}, {at + n + 1}\n"
        end = 2 * (n + 1) if name == "UP" else 0
        sets[name] = list(range(first + end, first + end + n + 1))
        facing = range(cell + n, cell + 2 * n) if name == "LOW" else range(cell, cell + n)
        elements += f"*ELSET, ELSET=F{name}\n" + "".join(f"{k},\n" for k in facing)
        first, cell = first + 3 * (n + 1), cell + 2 * n
    text += elements + "".join(f"*NSET, NSET={to}\n" + "".join(f"{k},\n" for k in sets[of])
                               for to, of in (("BOT", "LOW"), ("TOP", "UP")))
    pair = "SUP, SLOW" if slave == "UP" else "SLOW, SUP"
    return text + f"""*SOLID SECTION, ELSET=LOW, MATERIAL=M
1.
*SOLID SECTION, ELSET=UP, MATERIAL=M
1.
*MATERIAL, NAME=M
*ELASTIC
1000., 0.
*SURFACE, NAME=SLOW, TYPE=ELEMENT
FLOW, S3
*SURFACE, NAME=SUP, TYPE=ELEMENT
FUP, S1
*SURFACE INTERACTION, NAME=I
1.,
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD
*CONTACT PAIR, INTERACTION=I, TYPE=SURFACE TO SURFACE
{pair}
*STEP
*STATIC
0.5, 1., 1e-5, 0.5
*BOUNDARY
BOT, 1, 2
TOP, 1, 1
TOP, 2, 2, -5e-4
*END STEP
"""


def apart(deck, distance):
    """The same deck with the upper block moved up by a distance."""
    head, tail = deck.split("*ELEMENT", 1)
    lines = []
    for line in head.splitlines():
        fields = line.split(", ")
        if len(fields) == 3 and int(fields[0]) > 12:
            line = f"{fields[0]}, {fields[1]}, {float(fields[2]) + distance}"
        lines.append(line)
    return "\n".join(lines) + "\n*ELEMENT" + tail


def pressed(scene):
    """The reaction at the end; the result can be viewed, whatever its interfaces are."""
    out = os.path.join(folder(), "out")
    code, _, error = delam("run", scene, "--out", out)
    expect(code == 0, f"it runs: exit {code} {error.strip()[:300]}")
    code, _, error = delam("view", out)
    expect(code == 0, f"view: exit {code} {error.strip()[:300]}")
    with open(os.path.join(out, "history.csv"), newline="", encoding="utf-8") as file:
        return float(list(csv.DictReader(file))[-1]["reaction"])


# The bar shortens by 5e-4 in 2: sigma = 0.25, whichever side is the slave and whichever is finer.
for lower, upper in ((20, 4), (20, 1), (1, 20), (3, 2)):
    for slave in ("UP", "LOW"):
        path = write(bar(lower, upper, slave), "bar.inp")
        place = os.path.dirname(path)
        code, scene, error = delam("import", path)
        expect(code == 0, f"import: {error.strip()}")
        expect("projection" not in scene, "the scene has the default")
        force = pressed(write(scene, "bar.toml", place))
        expect(math.isclose(abs(force), 0.25, rel_tol=1e-9), f"{lower}:{upper}, slave {slave}: {force}")
        if (lower, upper, slave) == (20, 1, "UP"):
            points = scene.replace("projected = true", 'projected = true\nprojection = "points"')
            force = pressed(write(points, "points.toml", place))
            expect(abs(force) < 0.2, f"points alone, where b is coarse: {force}")
            for wrong, words in ((points.replace('"points"', '"nodes"'), "projection.*means.*points"),
                                 (points.replace("projected = true\n", ""), "is for projected = true")):
                expect_error(delam("check", write(wrong, "wrong.toml", place)), 2, words)

# Faces that are apart press once they meet: 5e-4 less 2e-4 on a length of 2, in 4 steps; nothing holds them before.
gap = apart(bar(3, 2, "UP"), 2e-4).replace("*STATIC", "*STATIC, DIRECT").replace("0.5, 1., 1e-5, 0.5", "0.25, 1.")
for drive, forces in ((-5e-4, (0, 0.025, 0.0875, 0.15)), (5e-4, (0, 0, 0, 0))):
    path = write(gap.replace("-5e-4", str(drive)), "gap.inp")
    code, scene, error = delam("import", path)
    expect(code == 0, f"import: {error.strip()}")
    place = os.path.dirname(path)
    for reduction in ("condensed", "iterated", "feti"):
        out = os.path.join(folder(), "out")
        text = scene.replace("[solver]\n", f'[solver]\nreduction = "{reduction}"\n')
        code, said, error = delam("run", write(text, "gap.toml", place), "--out", out)
        expect(code == 0, f"it runs: exit {code} {error.strip()[:300]}")
        with open(os.path.join(out, "history.csv"), newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))[1:]
        got = [abs(float(row["reaction"])) for row in rows]
        expect(all(math.isclose(g, f, rel_tol=1e-9, abs_tol=1e-12) for g, f in zip(got, forces)), f"{reduction}: {got}")
        if drive > 0:
            expect("no work was done" in said + error, "nothing that is rounding is told of")
    closed = scene.replace("projected = true", 'projected = true\ninitial_gap = "closed"')
    expect(math.isclose(abs(pressed(write(closed, "closed.toml", place))), 0.25 if drive < 0 else 0, rel_tol=1e-9),
           "closed: they touch from the start")
    expect_error(delam("check", write(closed.replace("\ngap = ", "\nadjust = 1e-3\ngap = "), "wrong.toml", place)), 2,
                 "adjust.*is for initial_gap")
    expect_error(delam("check", write(closed.replace('"closed"', '"shut"'), "wrong.toml", place)), 2, "open.*closed")
    points = scene.replace("projected = true", 'projected = true\nprojection = "points"\ninitial_gap = "open"')
    expect_error(delam("check", write(points, "wrong.toml", place)), 2, "needs projection")

# Faces that overlap are refused with the value, or moved apart without strain.
for adjust, words in (("", "overlap by up to 0.0002"), (", ADJUST=1e-4", "overlap by up to 0.0002"),
                      (", ADJUST=3e-4", None)):
    text = apart(bar(3, 2, "UP"), -2e-4).replace("*CONTACT PAIR", f"*CONTACT PAIR{adjust}")
    path = write(text, "overlap.inp")
    code, scene, error = delam("import", path)
    expect(code == 0, f"import: {error.strip()}")
    scene = write(scene, "overlap.toml", os.path.dirname(path))
    if words:
        expect_error(delam("run", scene, "--out", os.path.join(folder(), "out")), 2, words, "adjust")
    else:
        expect(math.isclose(abs(pressed(scene)), 0.25, rel_tol=1e-9), "moved together, they press from the start")
for adjust, words in (("NODES", "ADJUST=NODES is not imported: a distance"), ("-1", "a distance >= 0")):
    wrong = bar(3, 2, "UP").replace("*CONTACT PAIR", f"*CONTACT PAIR, ADJUST={adjust}")
    expect_error(delam("import", write(wrong, "wrong.inp")), 2, words)

# Nothing joins faces that are apart, even with a law, unless they are moved together.
law = "*COHESIVE BEHAVIOR\n1000., 1000., 1000.\n*DAMAGE INITIATION, CRITERION=QUADS\n1., 1., 1.\n"
law += "*DAMAGE EVOLUTION, TYPE=ENERGY\n0.01,\n"
for adjust, force in (("", 0.0), (", ADJUST=3e-4", 1000 * 5e-4 / 3)):
    text = gap.replace("*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD\n", law).replace("-5e-4", "5e-4")
    path = write(text.replace("*CONTACT PAIR", f"*CONTACT PAIR{adjust}"), "law.inp")
    code, scene, error = delam("import", path)
    expect(code == 0, f"import: {error.strip()}")
    scene = write(scene, "law.toml", os.path.dirname(path))
    code, _, error = delam("check", scene)
    expect(("3 of 3 pairs have a gap" in error) == (adjust == ""), f"check tells: {error.strip()[:300]}")
    expect(math.isclose(abs(pressed(scene)), force, rel_tol=1e-8, abs_tol=1e-12), f"with a law{adjust}")

# General contact joins the halves of a body with a slit; without it they pass through each other, which is told.
deck = bar(3, 3, "UP").replace("13, 0.0, 1.0\n", "").replace(", 13, ", ", 9, ")
deck = deck.replace("ELSET=LOW\n", "ELSET=ALL\n").replace("ELSET=UP\n", "ELSET=ALL\n")
head, tail = deck.split("*SOLID SECTION", 1)[0], deck.split("*MATERIAL", 1)[1]
middle, step = tail.split("*SURFACE, NAME", 1)[0], tail.split("*STEP", 1)[1]
path = write(head + "*SOLID SECTION, ELSET=ALL, MATERIAL=M\n1.\n*MATERIAL" + middle +
             "*CONTACT\n*CONTACT INCLUSIONS, ALL EXTERIOR\n*STEP" + step, "seam.inp")
code, scene, error = delam("import", path)
expect(code == 0 and "[contact]\ngeneral = true" in scene and "those that meet later are left out" in error,
       f"a changed line: {error.strip()}")
place = os.path.dirname(path)
expect(math.isclose(abs(pressed(write(scene, "seam.toml", place))), 0.25, rel_tol=1e-9), "the seam is closed")
bare = write(scene.replace("[contact]\ngeneral = true\n", ""), "bare.toml", place)
code, _, error = delam("check", bare)
expect("body 0: 6 outer faces between (0.16" in error and "pass through each other" in error, f"check: {error.strip()}")
expect(abs(pressed(bare)) < 0.2, "without contact the halves pass through each other")

# General contact of bodies: matching, not matching, and apart.
for lower, upper, distance, reach, force in ((3, 3, 0, 0, 0.25), (3, 2, 0, 0, 0.25), (3, 4, 2e-4, 2.1e-4, 0.15)):
    path = write(apart(bar(lower, upper, "UP"), distance) if distance else bar(lower, upper, "UP"), "two.inp")
    code, scene, error = delam("import", path)
    expect(code == 0, f"import: {error.strip()}")
    start, rest = scene.split("[[interfaces]]", 1)
    scene = start + f"[contact]\ngeneral = true\ngap = {reach}\n\n[[patterns]]" + rest.split("[[patterns]]", 1)[1]
    scene = write(scene, "two.toml", os.path.dirname(path))
    expect(math.isclose(abs(pressed(scene)), force, rel_tol=1e-9), f"general contact, {lower}:{upper}, {distance} apart")
# The same halves as one body: its walls face each other.
deck = apart(bar(3, 4, "UP"), 2e-4).replace("ELSET=LOW\n", "ELSET=ALL\n").replace("ELSET=UP\n", "ELSET=ALL\n")
head, tail = deck.split("*SOLID SECTION", 1)[0], deck.split("*MATERIAL", 1)[1]
middle, step = tail.split("*SURFACE, NAME", 1)[0], tail.split("*STEP", 1)[1]
path = write(head + "*SOLID SECTION, ELSET=ALL, MATERIAL=M\n1.\n*MATERIAL" + middle +
             "*CONTACT\n*CONTACT INCLUSIONS, ALL EXTERIOR\n*STEP" + step, "walls.inp")
code, text, error = delam("import", path)
expect(code == 0, f"import: {error.strip()}")
for reach, force in ((0, 0.0), (2.1e-4, 0.15)):
    walls = re.sub(r"general = true\n(gap = .*\n)?", f"general = true\ngap = {reach}\n", text)
    walls = write(walls, "walls.toml", os.path.dirname(path))
    expect(math.isclose(abs(pressed(walls)), force, rel_tol=1e-9, abs_tol=1e-12), f"walls within {reach}")
# A hole that is narrower than the gap faces itself: it stays without contact, which is told.
places = [(r * math.cos(k * math.pi / 12), r * math.sin(k * math.pi / 12)) for r in (1.0, 2.0) for k in range(24)]
ring = "*NODE\n" + "".join(f"{n + 1}, {x:.9f}, {y:.9f}\n" for n, (x, y) in enumerate(places))
ring += "*ELEMENT, TYPE=CPE4, ELSET=RING\n"
ring += "".join(f"{k + 1}, {k + 1}, {k + 25}, {(k + 1) % 24 + 25}, {(k + 1) % 24 + 1}\n" for k in range(24))
path = write(ring, "ring.inp")
hole = ('schema = 1\n[mesh]\nfile = "ring.inp"\n[[materials]]\nname = "m"\nyoung = 1000.0\npoisson = 0.3\n'
        '[[bodies]]\nname = "*"\nmaterial = "m"\n[contact]\ngeneral = true\ngap = 2.1\n'
        '[[supports]]\nbody = "RING"\nfix = ["x", "y"]\n[time]\nend = 1.0\nsteps = 1\n')
code, _, error = delam("check", write(hole, "ring.toml", os.path.dirname(path)))
expect("leaves the walls of single bodies without contact" in error and "faces itself" in error, f"told: {error.strip()}")
# General contact of a deck takes in bodies that are apart; one that takes in no face of a body says so.
distance = 2e-4
near = apart(bar(3, 4, "UP"), distance).replace("*CONTACT PAIR, INTERACTION=I, TYPE=SURFACE TO SURFACE\nSUP, SLOW\n",
                                               "*CONTACT\n*CONTACT INCLUSIONS, ALL EXTERIOR\n")
place = folder()
code, given, error = delam("import", write(near, "near.inp", place))
expect(code == 0 and re.search(r"general = true\ngap = 0.000200[12]", given) and "up to 0.0002002 apart" in error,
       f"general contact of a deck with a gap: {error} {given[-600:]}")
_, _, error = delam("check", write(re.sub(r"gap = .*\n", "", given), "without.toml", place))
expect('takes in no face of body "LOW" and of 1 other' in error and '0.0002 away from "UP"' in error and "0.000202 would" in error,
       f"bodies that general contact leaves alone: {error}")
_, _, error = delam("check", write(given, "with.toml", place))
expect("takes in no face" not in error, f"and not where it takes them in: {error}")

for wrong, words in (("general = 1", "general.*true or false"), ("gap = 1", "is for general = true"),
                     ("general = true\ngap = -1", "gap.*>= 0")):
    with open(scene, encoding="utf-8") as file:
        text = file.read()
    start, rest = text.split("[contact]\n", 1)
    expect_error(delam("check", write(f"{start}[contact]\n{wrong}\n\n[[patterns]]" + rest.split("[[patterns]]", 1)[1],
                                      "wrong.toml", os.path.dirname(scene))), 2, words)
finish()
