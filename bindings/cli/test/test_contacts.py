# SPDX-License-Identifier: BSD-3-Clause
"""Contact of decks and scenes between meshes that were not made for each other."""
import csv
import math
import os

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


def pressed(scene):
    """The reaction at the end."""
    out = os.path.join(folder(), "out")
    code, _, error = delam("run", scene, "--out", out)
    expect(code == 0, f"it runs: exit {code} {error.strip()[:300]}")
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

# General contact of a body with a slit (its halves share one node) is told, not left out in silence.
deck = bar(3, 3, "UP").replace("13, 0.0, 1.0\n", "").replace(", 13, ", ", 9, ")
deck = deck.replace("ELSET=LOW\n", "ELSET=ALL\n").replace("ELSET=UP\n", "ELSET=ALL\n")
head, tail = deck.split("*SOLID SECTION", 1)[0], deck.split("*MATERIAL", 1)[1]
middle, step = tail.split("*SURFACE, NAME", 1)[0], tail.split("*STEP", 1)[1]
path = write(head + "*SOLID SECTION, ELSET=ALL, MATERIAL=M\n1.\n*MATERIAL" + middle +
               "*CONTACT\n*CONTACT INCLUSIONS, ALL EXTERIOR\n*STEP" + step, "seam.inp")
code, scene, error = delam("import", path)
expect(code == 0 and "faces of one body and faces that meet later are left out" in error, f"a changed line: {error.strip()}")
code, _, error = delam("check", write(scene, "seam.toml", os.path.dirname(path)))
expect("body 0: 6 outer faces between (0.16" in error and "pass through each other" in error, f"check: {error.strip()}")
finish()
