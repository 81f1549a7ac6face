# SPDX-License-Identifier: BSD-3-Clause
"""Loads that turn back, dead loads past their limit, unilateral supports on sets of faces."""
import csv
import json
import os

from support import SCENE, changed, delam, expect, folder, finish, write


def run(text, wanted=0):
    out = os.path.join(folder(), "out")
    code, _, error = delam("run", write(text), "--out", out)
    expect(code == wanted, f"exit {code}, {wanted} is expected: {error.strip().splitlines()[-1:] if code else ''}")
    if not os.path.exists(os.path.join(out, "history.csv")):
        return [], error, {}
    with open(os.path.join(out, "history.csv"), newline="", encoding="utf-8") as file:
        rows = [{k: float(v) for k, v in row.items() if k not in ("solution", "mixity_rule")} for row in csv.DictReader(file)]
    with open(os.path.join(out, "result.json"), encoding="utf-8") as file:
        return rows, error, json.load(file)


# Down by 6 mm, back to 0, and down again: nothing is dissipated on the way back and up to where it had been, and that is a straight line.
cycle = changed("times = [0.0, 2.0]\nvalues = [0.0, 0.006]", "times = [0.0, 1.0, 2.0, 3.5]\nvalues = [0.0, 0.006, 0.0, 0.009]")
rows, _, _ = run(changed("end = 2.0\nsteps = 20", 'end = 3.5\nsteps = 70\n[solver]\nkinematics = "linear"', cycle))
at = {round(row["time"], 6): row for row in rows}
first, back, again = at[1.0], at[2.0], at[3.0]
expect(first["dissipated"] > 0.01 * first["work"], "the first pressing breaks something")
size = first["dissipated"]
expect(all(abs(row["dissipated"] - size) <= 1e-9 * size for row in rows if 1.0 <= row["time"] <= 3.0), "nothing breaks on the way back and forth")
expect(abs(back["reaction"]) < 1e-9 * first["reaction"] and abs(back["stored_bulk"]) < 1e-9 * first["stored_bulk"], "without load nothing is stored")
expect(abs(again["reaction"] - first["reaction"]) < 1e-9 * first["reaction"], "pressed as far as before it carries as much")
half, whole = at[2.5], at[3.0]
expect(abs(2 * half["reaction"] - whole["reaction"]) < 1e-6 * whole["reaction"], "damaged, but linear")
expect(rows[-1]["dissipated"] > 1.01 * size, "further down it breaks on")

# Two layers pulled apart by a dead load: past the strength of the interface, sqrt(2 k onset) = 5e6 N/m2 here, nothing carries it.
dead = SCENE[:SCENE.index("[[supports]]")].replace('\nnotch = [{ from = 0.0, to = 0.030 }]', "") + '''
[[supports]]
box = { lower = [0.0, 0.0], upper = [0.120, 0.0] }
fix = ["x", "y"]
[[patterns]]
name = "pull"
times = [0.0, 1.0]
values = [0.0, 1.0]
[[forces]]
patch = { centre = [0.060, 0.006], length = 0.120, face = "+y" }
traction = [0.0, 6e6]
pattern = "pull"
[time]
end = 1.0
steps = 11
'''
rows, error, about = run(dead, 1)
expect("limit" in error.lower(), f"the analysis says so: {error.strip().splitlines()[-1:]}")
expect(about.get("status") == "incomplete" and len(rows) == 10, f"the {len(rows) - 1} steps up to 5e6 N/m2 are kept")

# The end of a stack, pulled as one: a patch over two layers that are bonded is that of one layer as thick, in the plane and in space, and so is a force on it.
for space in (False, True):
    axes = "xyz" if space else "xy"
    middle, size = ([0.005, 0.002], [0.01, 0.004]) if space else ([0.002], [0.004])
    block = f"""
schema = 1
[geometry]
dimension = {len(axes)}
length = 0.04
{"width = 0.01" if space else ""}
h = 0.001
[[materials]]
name = "m"
young = 70e9
poisson = 0.3
LAYERS
[[supports]]
box = {{ lower = {[0.0] * len(axes)}, upper = {[0.0, 0.01, 0.004] if space else [0.0, 0.004]} }}
fix = {list(axes)}
[[patterns]]
name = "pull"
times = [0.0, 1.0]
values = [0.0, 1e-5]
[[loads]]
patch = {{ centre = {[0.04] + middle}, length = {size}, face = "+x" }}
direction = {[1.0, 0.3, 0.0][:len(axes)]}
pattern = "pull"
[time]
end = 1.0
steps = 1
"""
    layer = '[[layers]]\nname = "{}"\nthickness = {}\nmaterial = "m"\n'
    stack = layer.format("thin", 0.001) + layer.format("thick", 0.003) + '[[interfaces]]\nlower = "thin"\nupper = "thick"\nbonded = true\n'
    alone, together = block.replace("LAYERS", layer.format("whole", 0.004)), block.replace("LAYERS", stack)
    for wanted in ("reaction", "stored_bulk"):
        one, two = (run(text)[0][-1][wanted] for text in (alone, together))
        expect(one > 0 and abs(two - one) < 1e-9 * one, f"a displacement over two layers in {axes}: {wanted} {two}, of one layer {one}")
    pull = f'[[forces]]\npatch = {{ centre = {[0.04] + middle}, length = {size}, face = "+x" }}\nforce = {[2e3, 5e2, 0.0][:len(axes)]}\n'
    forces = [text[:text.index("[[loads]]")] + pull + text[text.index('pattern = "pull"'):] for text in (alone, together)]
    one, two = (run(text)[0][-1]["stored_bulk"] for text in forces)
    expect(one > 0 and abs(two - one) < 1e-9 * one, f"a force over two layers in {axes}: {two}, of one layer {one}")
    thin = together.replace('face = "+x" }', 'face = "+x" }\nlayer = "thin"')
    code, _, error = delam("check", write(thin))
    expect(code == 0 and "only what is on the body counts" in error, f"a layer may still be named: {error.strip()}")

# A square that a rigid plane supports from below, named as a set of faces of a mesh.
MESH = """*NODE
1, 0, 0
2, 1, 0
3, 1, 1
4, 0, 1
*ELEMENT, TYPE=CPE4, ELSET=block
1, 1, 2, 3, 4
*NSET, NSET=bottom
1, 2
*NSET, NSET=top
3, 4
*SURFACE, NAME=under
block, S1
"""
TEXT = """
schema = 1
[mesh]
file = "m.inp"
[[materials]]
name = "m"
young = 8.0
poisson = 0.0
[[bodies]]
name = "*"
material = "m"
[[controls]]
name = "table"
[[supports]]
control = "table"
fix = ["x", "y"]
[[obstacles]]
set = "under"
control = "table"
[[supports]]
set = "top"
fix = ["x"]
[[patterns]]
name = "p"
times = [0, 1, 2]
values = [0, -0.1, 0.1]
[[loads]]
set = "top"
component = ["y"]
pattern = "p"
[time]
end = 2.0
steps = 2
"""
place = folder()
with open(os.path.join(place, "m.inp"), "w", encoding="utf-8") as file:
    file.write(MESH)
with open(os.path.join(place, "scene.toml"), "w", encoding="utf-8") as file:
    file.write(TEXT)
for centre, words in (([0.75, 1.0], "loads[0].patch covers 0.75 of 1: only what is on the boundary counts"), ([0.5, 1.0], "")):
    with open(os.path.join(place, "patch.toml"), "w", encoding="utf-8") as file:
        file.write(TEXT.replace('[[loads]]\nset = "top"', f'[[loads]]\npatch = {{ centre = {centre}, length = 1.0, face = "+y" }}'))
    _, _, error = delam("check", os.path.join(place, "patch.toml"))
    expect((words in error) if words else "patch" not in error, f"a patch of a mesh at {centre}: {error.strip()}")
code, _, error = delam("run", os.path.join(place, "scene.toml"), "--out", os.path.join(place, "out"))
expect(code == 0, f"an obstacle under a set of faces {error.strip()}")
with open(os.path.join(place, "out", "history.csv"), newline="", encoding="utf-8") as file:
    rows = list(csv.DictReader(file)) if code == 0 else []
reactions = [float(row["reaction"]) for row in rows]
expect(len(rows) == 3 and abs(reactions[1] + 0.8) < 1e-9 and abs(reactions[2]) < 1e-9, f"pressed it carries, lifted it does not: {reactions}")
finish()
