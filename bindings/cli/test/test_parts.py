# SPDX-License-Identifier: BSD-3-Clause
"""Parts of one interface with laws of their own: of layers, of meshes that match or not, in scenes and in decks. What is
pulled apart dissipates the toughness of each part over its pairs."""
import csv
import os

from decks import Beam
from support import delam, expect, expect_error, finish, folder, write

# Two blocks that are 3 long and stiff, pulled apart by far more than either law holds; mm, N.
LAW = """[[laws]]
name = "{0}"
normal_stiffness = 1e4
tangential_stiffness = 1e4
normal_strength = 4.0
tangential_strength = 4.0
normal_toughness = {1}
tangential_toughness = {1}
"""
LAYERS = """schema = 1
[units]
force = "N"
length = "mm"
[geometry]
dimension = {dimension}
{size}
[[materials]]
name = "block"
young = 1e5
poisson = 0.0
[[layers]]
name = "lower"
thickness = 1.0
divisions = 1
material = "block"
[[layers]]
name = "upper"
thickness = 1.0
divisions = 1
material = "block"
""" + LAW.format("weak", 0.2) + LAW.format("tough", 0.5)
PULL = """[[patterns]]
name = "pull"
times = [0, 1]
values = [0, 1.0]
[[supports]]
box = {{ lower = {low}, upper = {low_to} }}
fix = {all}
[[loads]]
box = {{ lower = {high}, upper = {high_to} }}
component = ["{up}"]
pattern = "pull"
coefficient = 1.0
[[supports]]
box = {{ lower = {high}, upper = {high_to} }}
fix = {across}
[time]
end = 1.0
steps = 12
[output]
fields = []
"""
PLANE = LAYERS.format(dimension=2, size="length = 3.0\ndivisions = 6") + PULL.format(
    low="[0.0, 0.0]", low_to="[3.0, 0.0]", high="[0.0, 2.0]", high_to="[3.0, 2.0]", all='["x", "y"]', up="y", across='["x"]')
SPACE = LAYERS.format(dimension=3, size="length = 3.0\nwidth = 1.0\ndivisions = [6, 2]") + PULL.format(
    low="[0.0, 0.0, 0.0]", low_to="[3.0, 1.0, 0.0]", high="[0.0, 0.0, 2.0]", high_to="[3.0, 1.0, 2.0]",
    all='["x", "y", "z"]', up="z", across='["x", "y"]')
# (part, law), in the order of the entries; no part: the rest.
BETWEEN = "[[interfaces]]\nlower = \"lower\"\nupper = \"upper\"\n"


def entries(scene, *parts, between=BETWEEN):
    tables = "".join(between + f'law = "{law}"\n' + (f"part = [{part}]\n" if part else "") for part, law in parts)
    return scene.replace("[[patterns]]", tables + "[[patterns]]", 1)


def run(text, name="scene.toml"):
    place = folder()
    out = os.path.join(place, "out")
    code, _, error = delam("run", write(text, name, place), "--out", out)
    expect(code == 0, f"it runs: {error.strip()[:400]}")
    with open(os.path.join(out, "history.csv"), encoding="utf-8", newline="") as file:
        return [(float(row["reaction"]), float(row["dissipated"])) for row in csv.DictReader(file)]


def dissipates(what, text, expected, name="scene.toml"):
    last = run(text, name)[-1]
    expect(abs(last[1] - expected) < 1e-9 * expected, f"{what}: {last[1]:.12g} is dissipated, {expected:.12g} is expected")


def alike(what, one, other):
    largest = max(abs(reaction) for reaction, _ in other)
    worst = max(abs(a[0] - b[0]) for a, b in zip(one, other))
    expect(len(one) == len(other) and worst < 1e-9 * largest, f"{what}: reactions differ by {worst / largest:.1e}")


for scene, whole in ((PLANE, "{ from = 0.0, to = 3.0 }"), (SPACE, "{ lower = [0.0, 0.0], upper = [3.0, 1.0] }")):
    half = whole.replace("3.0", "1.5")
    end = "{ from = 2.5, to = 3.0 }" if scene is PLANE else "{ lower = [2.5, 0.0], upper = [3.0, 1.0] }"
    one = run(entries(scene, ("", "weak")))
    expect(abs(one[-1][1] - 0.6) < 1e-9, "an interface of 3 mm2 dissipates the toughness times its area")
    alike("equal laws are one", run(entries(scene, (half, "weak"), ("", "weak"))), one)
    # The pairs at a border have the law of the first entry that holds them: half a cell more than the part.
    dissipates("half and rest", entries(scene, (half, "tough"), ("", "weak")), 0.5 * 1.75 + 0.2 * 1.25)
    dissipates("the rest comes first", entries(scene, ("", "weak"), (half, "tough")), 0.5 * 1.75 + 0.2 * 1.25)
    dissipates("two parts of one entry", entries(scene, (f"{half}, {end}", "tough"), ("", "weak")), 0.5 * 2.5 + 0.2 * 0.5)
    dissipates("two parts, no rest", entries(scene, (half, "tough"), (whole, "weak")), 0.5 * 1.75 + 0.2 * 1.25)
    middle = half.replace("1.5", "1.0")
    dissipates("three entries", entries(scene, (middle, "tough"), (end, "tough"), ("", "weak")), 0.5 * 2.0 + 0.2 * 1.0)

# A notch in a part belongs to it alone.
notched = entries(PLANE, ("{ from = 0.0, to = 1.5 }", "tough"), ("", "weak")).replace(
    'law = "tough"\n', 'law = "tough"\nnotch = [{ from = 0.0, to = 1.0 }]\n', 1)
dissipates("a notch in a part", notched, 0.5 * (1.75 - 0.75) + 0.2 * 1.25)

for parts, said in (
        ((("{ from = 0.0, to = 1.5 }", "weak"),), r"3 of the 7 pairs .* lie in the part of no entry"),
        ((("{ from = 0.1, to = 0.4 }", "tough"), ("", "weak")), "no face of the interface lies in it"),
        ((("{ from = 0.0, to = 3.0 }", "tough"), ("{ from = 0.0, to = 1.0 }", "weak")), "entries before"),
        ((("{ from = 0.0, to = 3.0 }", "tough"), ("", "weak")), "leave no pair"),
        ((("", "tough"), ("", "weak")), "another interface between these layers"),
        ((("{ from = 0.0, to = 1.0 }", "tough"), ("", "weak"), ("", "weak")), "another interface between these")):
    expect_error(delam("check", write(entries(PLANE, *parts))), 2, said)


class Blocks(Beam):
    """Two blocks of 6 x 1 cells, one on the other."""

    def __init__(self, **size):
        super().__init__(length=3.0, width=1.0, thick=1.0, notch=0.0, nx=6, nz=1, **size)


def deck(block, sections, gap=0.0):
    """sections: the columns of cohesive elements of each, and its toughness."""
    plane = block.plane
    last = 2 if plane else 3
    text = "*Node\n" + "".join(f"{n}, {', '.join(map(str, at))}\n" for n, at in dict(block.nodes()).items())
    number = 0
    for arm, name in enumerate(("Low", "Up")):
        text += f"*Element, type={'CPE4' if plane else 'C3D8'}, elset={name}\n"
        for nodes in block.cells(arm):
            number += 1
            text += f"{number}, {', '.join(map(str, nodes))}\n"
        text += f"*Solid section, elset={name}, material=M\n,\n"
    glue = list(block.cohesive())
    for k, (columns, toughness) in enumerate(sections):
        text += f"*Element, type={'COH2D4' if plane else 'COH3D8'}, elset=Coh{k}\n"
        for column in columns:
            for nodes in glue[column::6]:
                number += 1
                text += f"{number}, {', '.join(map(str, nodes))}\n"
        text += f"*Cohesive section, elset=Coh{k}, material=C{k}, response=TRACTION SEPARATION\n1.\n"
    for name, arm, k in (("Bot", 0, 0), ("Top", 1, block.nz)):
        text += f"*Nset, nset={name}\n" + "".join(f"{n},\n" for i in range(7) for n in block.set_at(i, (arm,), (k,)))
    text += "*Material, name=M\n*Elastic\n1e5, 0.\n"
    for k, (_, toughness) in enumerate(sections):
        text += (f"*Material, name=C{k}\n*Elastic, type=TRACTION\n1e4, 1e4, 1e4\n*Damage initiation, criterion=QUADS\n"
                 f"4., 4., 4.\n*Damage evolution, type=ENERGY\n{toughness},\n")
    return (text + f"*Step\n*Static\n.1, 1., 1e-5, .1\n*Boundary\nBot, 1, {last}\nTop, 1, {last - 1}\nTop, {last}, {last}, 1.\n"
            "*End step\n")


# A seam within one body is an interface, too.
for ny in (0, 2):
    where = "in space" if ny else "in the plane"
    body = deck(Blocks(ny=ny), ((range(2), 0.5), (range(3, 5), 0.2))).replace("elset=Up", "elset=Low").replace(
        "*Solid section, elset=Low, material=M\n,\n", "", 1)
    dissipates(f"a seam {where}", body, 0.5 * 1.25 + 0.2 * 1.5, "deck.inp")

for ny in (0, 2):
    block = Blocks(ny=ny)
    where = "in space" if ny else "in the plane"
    left, right = range(3), range(3, 6)
    dissipates(f"two sections {where}", deck(block, ((left, 0.5), (right, 0.2))), 0.5 * 1.75 + 0.2 * 1.25, "deck.inp")
    dissipates(f"sections and faces without glue {where}", deck(block, ((range(2), 0.5), (range(3, 5), 0.2))),
               0.5 * 1.25 + 0.2 * 1.5, "deck.inp")
    alike(f"equal sections {where}", run(deck(block, ((left, 0.5), (right, 0.5 + 1e-13))), "deck.inp"),
          run(deck(block, ((range(6), 0.5),)), "deck.inp"))
expect_error(delam("import", write(deck(Blocks(ny=0), ((range(4), 0.5), (range(3, 6), 0.2))), "deck.inp", folder())), 2,
             "where their faces overlap, an interface has one law")

place = folder()
write(deck(Blocks(ny=0), ((range(2), 0.5), (range(3, 5), 0.2))), "deck.inp", place)
code, scene, said = delam("import", os.path.join(place, "deck.inp"))
expect(code == 0 and scene.count("part = [") == 2 and "contact = true" in scene, "each has its part, the rest is in contact")
expect("have 2 laws between them" in scene + said, "the import says so")
for old, new, said in (('b = "Up"\n', 'b = "Up"\ntolerance = 1e-4\n', "must be those of"),
                       ('b = "Up"\n', 'b = "Up"\nshared = "bonded"\n', "for the only entry between two bodies"),
                       ('b = "Up"\n', 'b = "U*"\n', "needs two bodies by name")):
    expect_error(delam("check", write(scene.replace(old, new, 1), "scene.toml", place)), 2, said)

finish()
