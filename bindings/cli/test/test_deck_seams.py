# SPDX-License-Identifier: BSD-3-Clause
"""Cohesive elements of decks that end within a body, and between bodies that share nodes elsewhere: a block with a
ligament of glue on a part of its middle plane, pulled apart."""
import csv
import os

from decks import Beam
from support import delam, expect, expect_error, finish, folder, write

STEPS = 10


class Block(Beam):
    """Half a block on another one; both share the nodes of the middle up to column `shared`."""

    def __init__(self, shared, **size):
        super().__init__(length=3.0, width=1.0, thick=1.0, notch=shared * 0.5, nx=6, nz=2, **size)
        self.shared = shared

    def node(self, arm, i, j, k):
        if arm == 1 and k == 0 and i <= self.shared:
            arm, k = 0, self.nz
        return super().node(arm, i, j, k)


def deck(block, bodies, cohesive=True, stiffness=1000.0, strength=1.0, top=0.03, law=""):
    """bodies: the sets of the solid sections."""
    plane = block.plane
    text = "*Node\n" + "".join(f"{n}, {', '.join(map(str, at))}\n" for n, at in dict(block.nodes()).items())
    number = 0
    for arm, name in enumerate(("Low", "Up")):
        text += f"*Element, type={'CPE4' if plane else 'C3D8'}, elset={name}\n"
        for nodes in block.cells(arm):
            number += 1
            text += f"{number}, {', '.join(map(str, nodes))}\n"
    text += "*Elset, elset=All\nLow, Up\n"
    if cohesive:
        text += f"*Element, type={'COH2D4' if plane else 'COH3D8'}, elset=Coh\n"
        for nodes in block.cohesive():
            number += 1
            text += f"{number}, {', '.join(map(str, nodes))}\n"
        text += "*Cohesive section, elset=Coh, material=C, response=TRACTION SEPARATION\n1.\n"
    every = range(block.nx + 1)
    for name, arm, k in (("Bot", 0, 0), ("Top", 1, block.nz)):
        text += f"*Nset, nset={name}\n" + "".join(f"{n},\n" for i in every for n in block.set_at(i, (arm,), (k,)))
    text += "".join(f"*Solid section, elset={name}, material={material}\n,\n" for name, material in bodies)
    text += "*Material, name=M\n*Elastic\n1000., 0.3\n*Material, name=N\n*Elastic\n2000., 0.2\n"
    text += f"*Material, name=C\n*Elastic, type=TRACTION\n{stiffness}, {stiffness}, {stiffness}\n"
    text += law or (f"*Damage initiation, criterion=QUADS\n{strength}, {strength}, {strength}\n"
                    "*Damage evolution, type=ENERGY\n0.01,\n")
    last = 2 if plane else 3
    return (text + f"*Step\n*Static\n{1 / STEPS}, 1., 1e-5, {1 / STEPS}\n*Boundary\nBot, 1, {last}\nTop, 1, {last - 1}\n"
            f"Top, {last}, {last}, {top}\n*End step\n")


def run(text):
    place = folder()
    out = os.path.join(place, "out")
    code, said, error = delam("run", write(text, "deck.inp", place), "--out", out)
    expect(code == 0, f"exit {code}: {error.strip()[:400]}")
    if code != 0:
        return None
    with open(os.path.join(out, "history.csv"), newline="", encoding="utf-8") as file:
        return [{k: float(v) for k, v in row.items() if k not in ("solution", "mixity_rule")}
                for row in csv.DictReader(file)]


def alike(what, one, other, key="reaction", tolerance=1e-9):
    if one is None or other is None:
        return
    largest = max(abs(row[key]) for row in other)
    worst = max(abs(a[key] - b[key]) for a, b in zip(one, other))
    expect(len(one) == len(other) and worst <= tolerance * largest, f"{what}: {key} differs by {worst}, {largest} at most")


ALL = [("All", "M")]
for ny in (0, 2):
    where = "in space" if ny else "in the plane"
    block = Block(3, ny=ny)
    slit = run(deck(block, ALL))
    # A stiff law that stays intact: the block without a slit.
    alike(f"stiff, {where}", run(deck(block, ALL, stiffness=1e10, strength=1e4)),
          run(deck(Block(6, ny=ny), ALL, cohesive=False)), tolerance=1e-6)
    # Wholly broken: the block with an open slit.
    opened = run(deck(block, ALL, cohesive=False))
    if slit is not None and opened is not None:
        expect(abs(slit[-1]["reaction"] - opened[-1]["reaction"]) < 1e-9 * opened[-1]["reaction"],
               f"broken, {where}: {slit[-1]['reaction']}, {opened[-1]['reaction']} is expected")
        expect(slit[1]["reaction"] > 1.05 * opened[1]["reaction"], f"the ligament holds at first, {where}")
        expect(slit[-1]["dissipated"] > 0.005, f"and breaks, {where}: {slit[-1]['dissipated']}")
    # One element of the glue alone has no face without a node of the tip.
    one = run(deck(Block(5, ny=ny), ALL))
    if one is not None:
        expect(one[-1]["dissipated"] > 1e-4, f"one column of elements, {where}: {one[-1]['dissipated']}")

    # Two bodies that share nodes: of one material the same as one body.
    two = run(deck(block, [("Low", "M"), ("Up", "M")]))
    alike(f"two bodies, {where}", two, slit)
    if two is not None and slit is not None:
        alike(f"two bodies, {where}", two, slit, "dissipated")
    # Two materials: once the glue is broken, the result is that without it.
    mixed = [("Low", "M"), ("Up", "N")]
    broken, open_ = run(deck(block, mixed)), run(deck(block, mixed, cohesive=False))
    if broken is not None and open_ is not None:
        expect(abs(broken[-1]["reaction"] - open_[-1]["reaction"]) < 1e-9 * open_[-1]["reaction"],
               f"two materials, {where}: {broken[-1]['reaction']}, {open_[-1]['reaction']} is expected")

thick = Block(3, ny=0, gap=0.01)
expect_error(delam("check", write(deck(thick, ALL), "deck.inp", folder())), 2,
             r"lies within \"All\", and its faces are 0.01 apart")

write(deck(Block(3, ny=0), [("Low", "M"), ("Up", "M")]), "two.inp", place := folder())
code, two, _ = delam("import", os.path.join(place, "two.inp"))
expect('shared = "bonded"' in two, "the part that shares nodes is bonded")
for old, new, said in (('shared = "bonded"', 'shared = "bonded"\nprojected = true', "is for meshes that match"),
                       ('a = "Low"', 'a = "L*"', "needs two bodies by name")):
    expect_error(delam("check", write(two.replace(old, new, 1), "scene.toml", place)), 2, said)
write(deck(Block(6, ny=0), [("Low", "M"), ("Up", "M")], cohesive=False), "two.inp", place)
whole = two.split("notch =")[0] + two.split("notch =")[1].split("\n", 1)[1]
expect_error(delam("check", write(whole, "scene.toml", place)), 2, "7 of the 7 pairs of nodes are one node")

# The same as a scene: what is wrong with an entry of one body.
place = folder()
write(deck(Block(3, ny=0), ALL), "slit.inp", place)
code, scene, _ = delam("import", os.path.join(place, "slit.inp"))
expect('a = "All"\nb = "All"\nlaw = "C"' in scene, "one body is a and b")
for old, new, said in (('law = "C"', 'law = "C"\nprojected = true', "is for two bodies"),
                       ("[[interfaces]]", '[[interfaces]]\na = "All"\nb = "All"\nbonded = true\n\n[[interfaces]]',
                        "another interface between these bodies")):
    expect_error(delam("check", write(scene.replace(old, new, 1), "scene.toml", place)), 2, said)
write(deck(Block(6, ny=0), ALL, cohesive=False), "slit.inp", place)
whole = scene.split("notch =")[0] + scene.split("notch =")[1].split("\n", 1)[1]
expect_error(delam("check", write(whole, "scene.toml", place)), 2, "this body has no seam")
finish()
