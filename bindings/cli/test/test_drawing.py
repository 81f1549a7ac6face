# SPDX-License-Identifier: BSD-3-Clause
"""`delam check --draw`: everything of a scene has its name in the drawing; no text lies over another, none is cut off;
faces behind are left out; what is no drawing is not replaced."""
import itertools
import json
import os
import random
import re
import sys

import numpy as np

from support import SCENE, changed, expect, finish, folder, read, start, write

sys.path.insert(0, os.path.join(os.path.dirname(os.environ["DELAM_PLOT"]), "..", "..", "python", "src", "delam"))

from _pictures import drawing, labels  # noqa: E402
from _pictures.result import for_files  # noqa: E402

for_files()


def told(what, condition, about=""):
    expect(condition, f"{what} {about if not condition else ''}".rstrip())


def drawn(scene, name="scene.svg"):
    """Exit code, messages and the bytes of the drawing."""
    path = os.path.join(folder(), name)
    code, _, error = start("check", write(scene), "--draw", path)
    return code, error, read(path) if os.path.exists(path) else b""


# ---- names, in the comments that Matplotlib writes beside the outlines of letters

code, error, picture = drawn(SCENE)
told("the scene is drawn", code == 0 and picture.startswith(b"<?xml"), error)
for text in ("small ENF", "lower (arm)", "upper (arm)", "lower-upper: law ductile", "notch of lower-upper",
             "supports[0]: uy = 0", "supports[1]: ux = uy = 0", "loads[0]: uy = -1 press"):
    told(f"the drawing says {text}", f"<!-- {text} -->".encode() in picture)
told("a scene without units has none on its axes", b"[m]" not in picture)
_, _, named = drawn(changed('point = [0.0, 0.0]\n', 'point = [0.0, 0.0]\nname = "left roller"\n'))
told("a support has the name of the scene", b"<!-- left roller: uy = 0 -->" in named and b"supports[0]" not in named)
_, _, without = drawn(changed("notch = [{ from = 0.0, to = 0.030 }]\n", ""))
told("an interface without a notch has none", b"notch of" not in without and b"law ductile" in without)
_, _, in_mm = drawn(SCENE + '[units]\nlength = "m"\nforce = "N"\n')
told("0.12 m are drawn in mm", b"<!-- extent 120" in in_mm or b"<!-- extent 0.12" in in_mm)
told("dimension lines have the lengths of the scene: notch, span, thickness", all(
    f"<!-- {text} -->".encode() in in_mm for text in ("120 mm", "30", "60", "3")))
told("without units they are numbers", b"<!-- 0.12 -->" in without and b"<!-- 0.03 -->" in picture)
# A patch has its place in the scene: the nodes of the cells that it touches lie elsewhere.
specimen = "--width 25mm --arm 2mm --notch 30mm --half-span 50mm --E1 140GPa --E2 10GPa --G12 5GPa --GIIc 750J/m2"
_, error, sheet_drawn = drawn(start("new", "enf", *specimen.split())[1])
lengths = [text for text in re.findall(rb"<!-- ([0-9.]+)(?: mm)? -->", sheet_drawn)]
told("dimensions are those of the sheet: notch, rest of the half span, half span", lengths[1:4] == [b"30", b"20", b"50"], f"{lengths} {error}")
between = changed('point = [0.120, 0.0]\n', 'patch = { centre = [0.1113, 0.0], length = 0.002, face = "-y" }\n')
_, error, between = drawn(between)
told("a roller between nodes has its place", b"<!-- 0.0513 -->" in between and b"<!-- 0.0087 -->" in between, error)
told("PNG", drawn(SCENE, "scene.png")[2].startswith(b"\x89PNG"))

# ---- an equation of two parallel displacements is a lever, whose load has its place by their factors

LEVER = """
[[equations]]
NAME
pattern = "press"
coefficient = -1.0
left = [
    { patch = { centre = [0.06, 0.006], length = 0.001, face = "+y" }, component = ["y"], coefficient = 1.5 },
    { patch = { centre = [0.0, 0.0045], length = 0.003, face = "-x" }, layer = "upper", DIRECTION, coefficient = -0.5 },
]
"""
unloaded = SCENE[:SCENE.index("[[loads]]")] + "[time]" + SCENE.split("[time]")[1]
for name, direction, texts in (('name = "bar"', 'component = ["y"]', ("bar: 1.5 uy", "bar: -0.5 uy", "bar: uy = -1 press")),
                               ("", 'component = ["y"]', ("equations[0]: uy = -1 press",)),
                               ("", 'component = ["x"]', ("equations[0]: 1.5 uy", "equations[0]: -0.5 ux"))):
    code, error, picture = drawn(unloaded + LEVER.replace("NAME", name).replace("DIRECTION", direction))
    told(f"a lever is drawn: {texts}", code == 0 and all(f"<!-- {text} -->".encode() in picture for text in texts), error)
    told("what does not move in parallel is no lever", (b"uy = -1 press" in picture) == ('"y"' in direction))

# ---- angles of plies

sheet = "--layup 0/90/-45/-45 --ply 0.5mm --width 4mm --length 4mm --E1 126GPa --E2 11GPa --G12 6.6GPa --GIc 220J/m2 --GIIc 600J/m2 --strain 1%"
laminate = start("new", "laminate", *sheet.split())[1]
code, error, picture = drawn(laminate)
told("plies have their angles", code == 0 and all(f"<!-- ply {k + 1} (ply, {angle}°) -->".encode() in picture
                                                  for k, angle in enumerate((0, 90, -45, -45))), error)

# ---- what cannot be drawn, or must not be replaced

code, error, _ = drawn(SCENE, "scene.pdf")
told("only known endings", code == 2 and ".svg or .png is expected" in error, error)
path = write("my notes", "notes.svg")
code, _, error = start("check", write(SCENE), "--draw", path)
told("foreign files stay", code == 3 and read(path) == b"my notes" and "no picture" in error, error)
path = os.path.join(folder(), "again.svg")
told("a drawing is replaced", [start("check", write(SCENE), "--draw", path)[0] for _ in range(2)] == [0, 0])
told("nothing is left beside it", os.listdir(os.path.dirname(path)) == ["again.svg"])
code, shown, _ = start("check", write(SCENE), "--json", "--draw", path)
told("with --json the output is JSON", code == 0 and json.loads(shown)["correct"])

# ---- labels

generator = random.Random(3)
for number, trial in itertools.product((1, 3, 8, 20), range(20)):
    some = [labels.Label("x", generator.choice([0.0, 4.0, generator.uniform(0, 9)]), 0, "k",
                         generator.uniform(0.3, 3)) for _ in range(number)]
    labels.place(some, 9.25)
    clashes = [(a, b) for a, b in itertools.combinations(some, 2)
               if a.row == b.row and a.left < b.left + b.width and b.left < a.left + a.width]
    told(f"{number} labels, trial {trial}: none over another", not clashes, clashes)
    told(f"{number} labels, trial {trial}: none is cut off",
           all(one.left >= 0 and one.left + one.width <= 9.25 for one in some))

# ---- dimension lines of layers, which other bodies have not; symbols that keep apart


def layers(second_from):
    """What the program finds of two layers of 10 x 1, the upper one from `second_from` on."""
    points = [[0, 0, 0], [10, 0, 0], [10, 1, 0], [0, 1, 0], [second_from, 1, 0], [10, 1, 0], [10, 2, 0], [second_from, 2, 0]]
    return {"dimension": 2, "title": "layers", "scales": [[1.0, "mm"]], "remarks": [], "points": points, "offsets": [0, 4, 8],
            "faces": list(range(8)), "body": [0, 1], "bodies": [{"name": "a", "material": "m"}, {"name": "b", "material": "m"}],
            "interfaces": [], "marks": [{"kind": "support", "text": "roller: uy = 0", "directions": [[0, 1]],
                                         "points": [[x, 0, 0] for x in np.linspace(3.95, 4.05, 15)]}]}


for second_from in (0, 2):
    figure = drawing.scene_figure(layers(second_from))
    texts = {text.get_text() for text in figure.texts}
    told(f"layers from {second_from} have dimensions", ({"4", "6", "10 mm", "1"} <= texts) == (second_from == 0), texts)
    marks = [line for line in figure.axes[0].lines if line.get_marker() not in ("None", "o", "", None)]
    told("fifteen nodes under a roller are one symbol, in their middle",
         len(marks) == 1 and len(marks[0].get_xdata()) == 1 and abs(marks[0].get_xdata()[0] - 4) < 0.05)
told("supports above the bodies are drawn above them", drawing.outwards(np.array([[4.0, 2.0]]), np.zeros(2), np.array([10.0, 2.0])) == 180)

# ---- two cubes on one another in space


def cubes(bodies):
    """What the program finds of a stack of unit cubes, each with its six faces outwards."""
    corners = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]], float)
    sides = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
    return {"dimension": 3, "title": "cubes", "scales": [], "remarks": [],
            "points": np.concatenate([corners + [0, 0, b] for b in range(bodies)]).tolist(),
            "offsets": list(range(0, 24 * bodies + 1, 4)),
            "faces": [8 * b + node for b in range(bodies) for side in sides for node in side],
            "body": [b for b in range(bodies) for _ in sides],
            "bodies": [{"name": f"body {b}", "material": "m"} for b in range(bodies)],
            "interfaces": [{"name": f"joint {b}", "kind": "law l", "law": True, "offsets": [0, 4],
                            "faces": [8 * b + node for node in sides[0]], "adhesion": [b % 2]}
                           for b in range(1, bodies)],
            "marks": [{"kind": "support", "text": "supports[0]: ux = uy = uz = 0", "directions": [[1, 0, 0]],
                       "points": corners[:4].tolist()},
                      {"kind": "load", "text": "loads[0]: uz = 1 pull", "directions": [[0, 0, 1]],
                       "points": (corners[4:] + [0, 0, bodies - 1]).tolist()}]}


figure = drawing.scene_figure(cubes(1))
told("half of the faces of a cube are seen", len(figure.axes[0].collections[0].get_paths()) == 3)
bar = {"text": "bar: uz = -1 press", "ends": [[0.5, 0.5, 1], [0, 0.5, 0.5]], "load": [0.9, 0.5, 1], "direction": [0, 0, -1]}
for bodies, levers in ((1, []), (2, []), (11, []), (40, []), (1, [bar]), (3, [bar])):
    figure = drawing.scene_figure({**cubes(bodies), "levers": levers})
    figure.canvas.draw()
    boxes = [(text.get_text(), text.get_window_extent()) for text in figure.texts if text.get_text()]
    over = [(a[0], b[0]) for a, b in itertools.combinations(boxes, 2) if a[1].overlaps(b[1])]
    told(f"{bodies} cubes: no text over another", not over, over)
    cut = [text for text, box in boxes
           if box.x0 < 0 or box.y0 < 0 or box.x1 > figure.bbox.width or box.y1 > figure.bbox.height]
    told(f"{bodies} cubes: no text is cut off", not cut, cut)
    told("the bar lies beyond the bodies", all(
        line.get_ydata().min() > max(path.vertices[:, 1].max() for path in figure.axes[0].collections[0].get_paths())
        for line in figure.axes[0].lines if line.get_linewidth() == 5))
    names = {text for text, _ in boxes}
    told("the bar is named", {one["text"] for one in levers} <= names)
    told(f"{bodies} cubes: all are named", bodies > drawing.MOST_NAMED or
         {f"body {b} (m)" for b in range(bodies)} <= names)
    told(f"{bodies} cubes: very many are named once", bodies < drawing.MOST_NAMED or
         {"body 0 (m) and 39 like it", "joint 1: law l and 19 like it", "notch of joint 2 and 18 like it"} <= names,
         names)

finish()
