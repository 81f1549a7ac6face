# SPDX-License-Identifier: BSD-3-Clause
"""Bodies that a scene cuts open along a group of faces (cut), in the plane and in space: a beam in one piece, cut along
its middle, is the beam of two bodies that touch there."""
import csv
import math
import os

from support import delam, expect, expect_error, folder, finish, write

LENGTH, WIDTH, HEIGHT, CELLS = 60.0, 4.0, 6.0, (60, 2, 4)


def block(dimension, halves, ends, height=CELLS[2] // 2):
    """Returns a Gmsh file (MSH 2.2): one body `beam`, or two, `lower` and `upper`, and groups of the faces on a row of
    cells, that of the middle, in order along x: {name: x at its end}."""
    along, across, up = CELLS
    rows = across + 1 if dimension == 3 else 1

    def node(i, j, k):
        return 1 + i + (along + 1) * (j * (up + 1) + k)

    names = [(dimension, 1, "lower" if halves else "beam"), (dimension, 2, "upper")][:2 if halves else 1]
    names += [(dimension - 1, 11 + n, name) for n, name in enumerate(ends)]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(names))]
    lines += [f'{rank} {tag} "{name}"' for rank, tag, name in names] + ["$EndPhysicalNames", "$Nodes"]
    places = [(i, j, k) for j in range(rows) for k in range(up + 1) for i in range(along + 1)]
    lines.append(str(len(places)))
    for i, j, k in places:
        x, y, z = LENGTH * i / along, WIDTH * j / across, HEIGHT * (k / up - 0.5)
        lines.append(f"{node(i, j, k)} {x} {y} {z}" if dimension == 3 else f"{node(i, j, k)} {x} {z} 0")
    cells, middle = [], up // 2
    for i in range(along):
        x = LENGTH * (i + 1) / along
        tag = next((11 + n for n, end in enumerate(ends.values()) if x <= end), None)
        for j in range(rows if dimension == 2 else across):
            square = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)] if dimension == 3 else [(i, 0), (i + 1, 0)]
            if tag:
                cells.append(f"{3 if dimension == 3 else 1} 2 {tag} {tag} " + " ".join(str(node(*c, height)) for c in square))
            for k in range(up):
                body = 2 if halves and k >= middle else 1
                if dimension == 3:
                    corners = [(*c, k) for c in square] + [(*c, k + 1) for c in square]
                else:
                    corners = [(i, 0, k), (i + 1, 0, k), (i + 1, 0, k + 1), (i, 0, k + 1)]
                cells.append(f"{5 if dimension == 3 else 3} 2 {body} {body} " + " ".join(str(node(*c)) for c in corners))
    lines += ["$EndNodes", "$Elements", str(len(cells))]
    lines += [f"{n + 1} {cell}" for n, cell in enumerate(cells)] + ["$EndElements", ""]
    return "\n".join(lines)


NOTCH = "notch = [{ lower = [%s], upper = [%s] }]"


def notch(dimension, end=20.0):
    """Returns the key of a notch from x = 0 to an end."""
    wide = ([0.0], [WIDTH]) if dimension == 3 else ([], [])
    return NOTCH % tuple(", ".join(map(str, [x, *y, z])) for x, y, z in ((0.0, wide[0], -0.1), (end, wide[1], 0.1)))


def scene(dimension, mesh, interfaces):
    """Returns a double cantilever beam on a mesh file, opened to 0.3 mm."""
    def box(x, z, to):
        wide = ([0.0], [WIDTH]) if dimension == 3 else ([], [])
        return f"box = {{ lower = {[x, *wide[0], z]}, upper = {[x, *wide[1], to]} }}"

    axis = "xyz" if dimension == 3 else "xy"
    plane = "" if dimension == 3 else 'plane = "plane-strain"\n'
    direction = [0.0] * (dimension - 1) + [1.0]
    loads = "".join(f'[[loads]]\nname = "{name}"\n{box(0.0, z, z)}\ndirection = {[s * d for d in direction]}\npattern = "open"\n'
                    for name, z, s in (("up", HEIGHT / 2, 1.0), ("down", -HEIGHT / 2, -1.0)))
    return (f'schema = 1\n[units]\nlength = "mm"\nforce = "N"\n[mesh]\nfile = "{mesh}"\n{plane}'
            '[[materials]]\nname = "m"\nyoung = 70000.0\npoisson = 0.3\n[[bodies]]\nname = "*"\nmaterial = "m"\n'
            + "".join(f'[[laws]]\nname = "{name}"\nkind = "piecewise-linear"\nnormal_stiffness = 1e5\n'
                      f'tangential_stiffness = 1e5\nnormal_onset = {onset}\ntangential_onset = {onset}\n'
                      f'normal_toughness = {toughness}\ntangential_toughness = {toughness}\n'
                      for name, onset, toughness in (("glue", 0.002, 0.3), ("tough", 1e3, 1e6)))
            + "".join(f"[[interfaces]]\n{text}\n" for text in interfaces)
            + f'[[supports]]\nname = "end"\n{box(LENGTH, -HEIGHT / 2, HEIGHT / 2)}\nfix = {list(axis)}\n'.replace("'", '"')
            + '[[patterns]]\nname = "open"\ntimes = [0.0, 1.0]\nvalues = [0.0, 0.3]\n' + loads
            + "[time]\nend = 1.0\nsteps = 6\n")


def curve(text, name, place):
    """Runs a scene; returns reactions and dissipated energies of its steps."""
    out = os.path.join(place, name)
    code, _, error = delam("run", write(text, name + ".toml", place), "--out", out)
    expect(code == 0, f"{name}: {error.strip()}")
    with open(os.path.join(out, "history.csv"), encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return [(float(row["reaction"]), float(row["dissipated"])) for row in rows]


def same(one, other, digits):
    """True if two curves agree to so much of their largest values."""
    return len(one) == len(other) and all(
        math.isclose(a, b, rel_tol=0.0, abs_tol=digits * max(abs(row[i]) for row in other))
        for pair in zip(one, other) for i, (a, b) in enumerate(zip(*pair)))


place = folder()
OWN = 'a = "beam"\nb = "beam"\n'
for dimension in (2, 3):
    write(block(dimension, False, {"mid": LENGTH}), "one.msh", place)
    write(block(dimension, True, {"mid": LENGTH}), "two.msh", place)
    law = 'law = "glue"\n' + notch(dimension)
    one = curve(scene(dimension, "one.msh", [OWN + 'cut = "mid"\n' + law]), "one", place)
    two = curve(scene(dimension, "two.msh", ['a = "lower"\nb = "upper"\n' + law]), "two", place)
    expect(two[-1][1] > 0.0, "the crack of two bodies grows")
    expect(same(one, two, 1e-8), f"{dimension}D: {one[-1]} of a cut body, {two[-1]} of two")

    # A crack that ends within the body, without adhesion: the rest is one piece.
    write(block(dimension, False, {"crack": 20.0}), "crack.msh", place)
    crack = curve(scene(dimension, "crack.msh", [OWN + 'cut = "crack"\ncontact = true']), "crack", place)
    bonded = curve(scene(dimension, "two.msh", ['a = "lower"\nb = "upper"\nlaw = "tough"\n' + notch(dimension, 20.0)]),
                   "bonded", place)
    expect(crack[-1][1] == 0.0 and bonded[-1][1] == 0.0, "nothing is dissipated")
    # The springs of the law ahead of the crack give way by 2 % of the opening at the load.
    expect(0.95 < bonded[-1][0] / crack[-1][0] < 1.0, f"{dimension}D: {crack[-1]} with a tip, {bonded[-1]} with springs")

# Two cuts with laws of their own in one body, here parts of one plane with a bonded cell between them.
write(block(2, False, {"first": 30.0, "none": 31.0, "second": LENGTH}), "parts.msh", place)
parts = [OWN + 'cut = "first"\nlaw = "glue"\n' + notch(2), OWN + 'cut = "second"\nlaw = "tough"']
code, text, error = delam("check", write(scene(2, "parts.msh", parts), "parts.toml", place))
expect(code == 0, f"two cuts: {error.strip()}")
path = write(block(2, False, {"first": 30.0, "second": LENGTH}), "joined.msh", place)
expect_error(delam("check", write(scene(2, "joined.msh", parts), "joined.toml", place)), 2, "goes on beyond this set")

for interfaces, words in (
        (['a = "lower"\nb = "upper"\ncut = "mid"\nlaw = "glue"'], "same body"),
        (['all = true\ncut = "mid"\nlaw = "glue"'], "same body"),
        (['a = "lower"\nb = "lower"\ncut = "mid"\nlaw = "glue"', 'a = "lower"\nb = "upper"\nlaw = "glue"'],
         "no two cells of one body share it"),
        (['a = "lower"\nb = "lower"\ncut = "midd"\nlaw = "glue"'], '"midd": no such set.*it has: mid')):
    write(block(2, True, {"mid": LENGTH}), "two.msh", place)
    expect_error(delam("check", write(scene(2, "two.msh", interfaces), "wrong.toml", place)), 2, words)
write(block(2, True, {"high": LENGTH}, 3), "high.msh", place)
other = ['a = "lower"\nb = "lower"\ncut = "high"\nlaw = "glue"', 'a = "lower"\nb = "upper"\nlaw = "glue"']
expect_error(delam("check", write(scene(2, "high.msh", other), "other.toml", place)), 2,
             'lie within body "upper", and a and b are "lower"')
write(block(2, False, {"mid": LENGTH}), "one.msh", place)
twice = [OWN + 'cut = "mid"\nlaw = "glue"'] * 2
expect_error(delam("check", write(scene(2, "one.msh", twice), "twice.toml", place)), 2, "no two cells of one body share it")
finish()
