# SPDX-License-Identifier: BSD-3-Clause
"""Meshes of Gmsh and Abaqus: stretched bars of every cell type and format, sets, interfaces, and what is refused."""
import json
import os
import re
import subprocess

from mesh_scenes import BONDED, STRETCH, YOUNG, last_row, near, pulled, scene, stretched
from support import delam, draw, expect, expect_error, finish, folder

# ---- every cell type through Gmsh's library, in every format; two blocks 4 x 1 (x 1) on each other ----
blocks = folder()
subprocess.run([os.environ["DELAM_MAKE_MESHES"], blocks], check=True)
SOLID = ("tet4", "hex8", "tet10", "hex20", "hex27", "wedge6", "wedge15")
for cell in ("tri3", "quad4", "tri6", "quad8", "quad9") + SOLID:
    for form in ("22a", "22b", "41a", "41b"):
        name = f"{cell}-{form}.msh"
        if form in ("22a", "41b"):
            stretched(blocks, name, "z" if cell in SOLID else "y", 4, 2, name)
        else:
            expect(delam("check", scene(blocks, name, BONDED + pulled("z" if cell in SOLID else "y")))[0] == 0, name)
# A partitioned mesh is the same for one process: its bodies and sets are whole, and borders of partitions are no sets.
for cell in ("tri3", "quad4", "tet4", "hex8", "wedge6"):
    for form in ("22p", "41p"):
        stretched(blocks, f"{cell}-{form}.msh", "z" if cell in SOLID else "y", 4, 2, f"{cell}-{form}.msh")
border = '[[supports]]\nset = "curve-1"\nfix = ["x"]\n'
expect_error(delam("check", scene(blocks, "quad4-41p.msh", BONDED + pulled("y") + border)), 2, "curve-1", "it has: bottom,")
expect_error(delam("check", scene(blocks, "tri10-41a.msh", "")), 2, "is a Triangle", "are known")

# What Gmsh writes for Abaqus, without the elements of its sets: node orders as a third party understands them.
for cell in ("quad4", "quad8", "tri6", "tet10", "hex20", "hex8", "wedge6", "wedge15"):
    with open(os.path.join(blocks, cell + ".inp"), encoding="utf-8") as file:
        lines = file.read().split("\n")
    kept, keep = [], True
    for line in lines:
        if line.startswith("*") and not line.startswith("**"):
            flat = re.match(r"\*ELEMENT, type=(T3D|CPS)", line)
            keep = not (flat and (flat.group(1) == "T3D" or cell in SOLID)) and not line.startswith("*ELSET")
        if keep:
            kept.append(line)
    with open(os.path.join(blocks, cell + "-cut.inp"), "w", encoding="utf-8") as file:
        file.write("\n".join(kept))
    stretched(blocks, cell + "-cut.inp", "z" if cell in SOLID else "y", 4, 2, cell + ".inp of Gmsh's")

code, out, _ = delam("check", scene(blocks, "quad4-41a.msh", BONDED + pulled("y")))
for line in ('body        "lower", 4 cells, material "m", formulation incompatible',
             'set         "bottom", 5 nodes, 4 faces', 'set         "corner", 1 node\n',
             'interface   "lower-upper", 5 pairs', "note: 4 cells clockwise: turned round"):
    expect(line in out, f"check says: {line.strip()}")

# ---- forces: a total, per area, along the normal ----
# A bar under tension t stores t^2 A h / (2 E).
for name, axis, zeros in (("quad4-41a.msh", "y", "0.0, "), ("tet10-22a.msh", "z", "0.0, 0.0, "),
                          ("hex20-41a.msh", "z", "0.0, 0.0, "), ("hex27-41a.msh", "z", "0.0, 0.0, "),
                          ("wedge6-41a.msh", "z", "0.0, 0.0, "), ("wedge15-22b.msh", "z", "0.0, 0.0, ")):
    hold = f'[[supports]]\nset = "bottom"\nfix = ["x", "y"{", " + chr(34) + "z" + chr(34) if axis == "z" else ""}]\n'
    for words in (f"force = [{zeros}2.0]", f"traction = [{zeros}0.5]", "pressure = -0.5"):
        pull = f'[[forces]]\nset = "top"\n{words}\npattern = "p"\n'
        row = last_row(blocks, scene(blocks, name, BONDED + hold + pull))
        expect(row is not None and near(row["stored_bulk"], 0.5 ** 2 * 4 * 2 / (2 * YOUNG), 1e-8),
               f"{name}, {words}: {row and row['stored_bulk']}")
force = '[[forces]]\nset = "{}"\n{}\npattern = "p"\n'
hold = '[[supports]]\nset = "bottom"\nfix = ["x", "y"]\n'
for text, words in ((force.format("seam", "pressure = 1.0"), 'between "lower" and "upper"; name one with body'),
                    (force.format("corner", "pressure = 1.0"), "single node"),
                    (force.format("top", "pressure = 1.0\ntraction = [0, 1]"), "one of force, traction and pressure"),
                    (force.format("tip", "pressure = 1.0"), r'forces\[0\]\.set: "tip": no such set.* \(did you mean')):
    expect_error(delam("check", scene(blocks, "quad4-41a.msh", BONDED + hold + text)), 2, words)
held = last_row(blocks, scene(blocks, "quad4-41a.msh",
                              BONDED + hold + force.format("seam", 'body = "lower"\npressure = -0.5')))
expect(held is not None and near(held["stored_bulk"], 0.5 ** 2 * 4 * 1 / (2 * YOUNG)), "pressure on one side of a seam")
mean = pulled("y").replace('set = "top"', 'set = "top"\nmean = true')
stretched_by_mean = last_row(blocks, scene(blocks, "quad4-41a.msh", BONDED + mean))
expect(stretched_by_mean is not None and near(stretched_by_mean["reaction"], YOUNG * 4 * STRETCH ** 2 / 2),
       "a mean over faces")

# ---- interfaces and notches: what breaks is what adhered ----
LAW = '[[interfaces]]\na = "lower"\nb = "upper"\nlaw = "law"\n'
torn = pulled("y", 10.0) + '[[supports]]\nset = "top"\nfix = ["x"]\n'
for text, adhered, what in ((LAW, 4.0, "no notch"),
                            (LAW + "notch = [{ lower = [0, 1], upper = [2, 1] }]\n", 2.5,
                             "the tip of a box stays bonded"),
                            (LAW + "notch = [{ lower = [0, 0.5], upper = [1.9, 1.5] }]\n", 2.5, "a box between pairs"),
                            (LAW + "notch = [{ lower = [0, 1], upper = [4, 1] }]\n", 0.0, "a box over all"),
                            (LAW + 'notch = [{ set = "seam" }]\n', 0.0, "a notch by set"),
                            ('[[interfaces]]\na = "up*"\nb = "lower"\nlaw = "law"\n', 4.0, "a pattern of names")):
    row = last_row(blocks, scene(blocks, "quad4-41a.msh", text + torn))
    expect(row is not None and abs(row["dissipated"] - 2.0 * adhered) < 1e-9, f"{what}: {row and row['dissipated']}")
solid_notch = LAW + "notch = [{ lower = [0, 0, 1], upper = [2, 1, 1] }]\n"
row = last_row(blocks, scene(blocks, "hex8-41a.msh", solid_notch + pulled("z", 10.0) +
                                '[[supports]]\nset = "top"\nfix = ["x", "y"]\n'))
expect(row is not None and abs(row["dissipated"] - 5.0) < 1e-9, f"a notch in a solid: {row and row['dissipated']}")
for text, words in (("", '"lower" and "upper" touch, but none says how they hold together'),
                    (LAW.replace("upper", "uper"), r'interfaces\[0\]\.b: "uper": no body.*did you mean'),
                    (LAW + LAW, "another interface between these bodies"),
                    (LAW.replace('"upper"', '"lower"'), "this body has no seam"),
                    (LAW + 'notch = [{ set = "corner" }]\n', r"interfaces\[0\]\.notch\[0\]: no pair"),
                    (LAW + 'notch = [{ from = 0, to = 1 }]\n', r"notch\[0\]\.from: is not for a scene with \[mesh\]"),
                    (LAW + BONDED, "there are no bodies that touch and have no interface yet")):
    expect_error(delam("check", scene(blocks, "quad4-41a.msh", text + torn)), 2, words)

# ---- meshes that do not match, contact alone, a generator ----
stretched(blocks, "quad4-41a.msh", "y", 4, 2, "a projected bond",
          '[[interfaces]]\na = "lower"\nb = "upper"\nprojected = true\nbonded = true\n')
pushed = pulled("y", -STRETCH) + '[[supports]]\nset = "top"\nfix = ["x"]\n'
CONTACT = '[[interfaces]]\na = "lower"\nb = "upper"\ncontact = true\n'
row = last_row(blocks, scene(blocks, "quad4-41a.msh", CONTACT + pushed))
expect(row is not None and near(row["stored_bulk"], YOUNG * 4 * STRETCH ** 2 / 4), "contact presses")
row = last_row(blocks, scene(blocks, "quad4-41a.msh",
                             CONTACT + pulled("y") + '[[supports]]\nset = "top"\nfix = ["x"]\n'))
expect(row is not None and abs(row["stored_bulk"]) < 1e-12, "contact does not pull")
expect_error(delam("check", scene(blocks, "quad4-41a.msh", CONTACT + "bonded = true\n" + pulled("y"))), 2,
             "one of law = .NAME., bonded = true and contact = true")
with open(scene(blocks, "x", '[[interfaces]]\na = "fibre-*"\nb = "matrix"\nlaw = "law"\n'
                '[[supports]]\nset = "left"\nfix = ["x", "y"]\n[[loads]]\nset = "right"\ncomponent = ["x"]\n'
                'pattern = "p"\n'), encoding="utf-8") as file:
    text = file.read()
generated = text.replace('file = "x"', 'generator = "fibre-cell"\nfraction = 0.3\nradius = 1.0\nfibres = 2\n'
                         'cells_around = 12\ncell = "tri3"')
path = os.path.join(blocks, "generated.toml")
with open(path, "w", encoding="utf-8") as file:
    file.write(generated)
code, out, error = delam("check", path)
expect(code == 0 and 'interface   "matrix-fibre-2"' in out and 'body        "fibre-1"' in out, f"a generator: {error}")
with open(path, "w", encoding="utf-8") as file:
    file.write(generated.replace("[mesh]", '[mesh]\nfile = "x"'))
expect_error(delam("check", path), 2, r"mesh\.file: give either file or generator")

# ---- small meshes as text ----
NODES = {1: (0, 0), 2: (1, 0), 3: (0, 1), 4: (1, 1), 5: (0, 2), 6: (1, 2)}
NAMES = {(2, 1): "quad", (2, 2): "tris", (1, 3): "bottom", (1, 4): "top", (0, 5): "control"}
# Type, physical group, entity, nodes: a quadrilateral under two triangles.
CELLS = [(1, 3, 1, (1, 2)), (1, 4, 2, (5, 6)), (3, 1, 1, (1, 2, 4, 3)), (2, 2, 2, (3, 4, 6)), (2, 2, 2, (3, 6, 5))]


def msh22(nodes, cells, names):
    out = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat"]
    if names:
        out += ["$PhysicalNames", str(len(names))]
        out += [f'{d} {t} "{n}"' for (d, t), n in names.items()] + ["$EndPhysicalNames"]
    out += ["$Nodes", str(len(nodes))]
    out += [f"{i} " + " ".join(str(x) for x in (tuple(at) + (0,))[:3]) for i, at in nodes.items()] + ["$EndNodes"]
    out += ["$Elements", str(len(cells))]
    out += [f"{i} {t} 2 {p} {e} " + " ".join(map(str, of)) for i, (t, p, e, of) in enumerate(cells, 1)]
    return "\n".join(out + ["$EndElements", ""])


MSH41 = """$MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
4
1 3 "bottom"
1 4 "top"
2 1 "quad"
2 2 "tris"
$EndPhysicalNames
$Entities
0 2 2 0
1 0 0 0 1 0 0 1 3 0
2 0 2 0 1 2 0 1 4 0
1 0 0 0 1 1 0 1 1 0
2 0 1 0 1 2 0 1 2 0
$EndEntities
$Nodes
1 6 1 6
2 1 0 6
1
2
3
4
5
6
0 0 0
1 0 0
0 1 0
1 1 0
0 2 0
1 2 0
$EndNodes
$Elements
4 5 1 5
1 1 1 1
1 1 2
1 2 1 1
2 5 6
2 1 3 1
3 1 2 4 3
2 2 2 2
4 3 4 6
5 3 6 5
$EndElements
"""
small = folder()


def put(name, text):
    with open(os.path.join(small, name), "w", encoding="utf-8") as file:
        file.write(text)
    return name


def refused(name, text, *patterns, extra="", keys=""):
    expect_error(delam("check", scene(small, put(name, text), extra, keys)), 2, *patterns)


put("mixed.msh", msh22(NODES, CELLS, NAMES))
stretched(small, "mixed.msh", "y", 1, 2, "triangles on a quadrilateral, 2.2")
stretched(small, put("mixed41.msh", MSH41), "y", 1, 2, "triangles on a quadrilateral, 4.1")
code, error = draw("plot", os.path.join(small, "out"))
for words in ("load-displacement.png", "snapshots.png"):
    expect(code == 0 and os.path.exists(os.path.join(small, "out", words)), f"{words} of a mixed mesh {error.strip()[-300:]}")
import h5py  # noqa: E402
with h5py.File(os.path.join(small, "out", "fields.h5"), "r") as file:
    cells = file["mesh/cells"][()].tolist()
    expect(sorted(len([n for n in cell if n >= 0]) for cell in cells) == [3, 3, 4], f"cells of two types: {cells}")
    expect(sorted(file["mesh/mixed"][()].tolist())[-1] >= 5 and len(file["mesh/mixed"]) == 13, "the list for XDMF")
    expect(len(file["mesh/body"]) == 3 and file["steps/00000001/stress"].shape == (3, 6),
           "bodies and stress of each cell")
    written = sorted(file["mesh"].attrs[f"body_{i}"].decode() if isinstance(file["mesh"].attrs[f"body_{i}"], bytes)
                     else file["mesh"].attrs[f"body_{i}"] for i in range(2))
    expect(written == ["quad", "tris"], f"names of bodies {written}")
with open(os.path.join(small, "out", "fields.xdmf"), encoding="utf-8") as file:
    expect('TopologyType="Mixed" NumberOfElements="3"' in file.read(), "a mixed topology")
with open(os.path.join(small, "out", "result.json"), encoding="utf-8") as file:
    about = json.load(file)
expect(about["layers"] == ["quad", "tris"] and about["scene"]["shortest_edge"] == 1.0, "result.json")

# The mesh is part of the scene: another one is another content, wherever it is edited.
hashes = set()
for at in (2, 2.5):
    put("mixed.msh", msh22({**NODES, 5: (0, at), 6: (1, at)}, CELLS, NAMES))
    delam("run", scene(small, "mixed.msh", BONDED + pulled("y")), "--out", os.path.join(small, "out"))
    with open(os.path.join(small, "out", "result.json"), encoding="utf-8") as file:
        hashes.add(json.load(file)["scene_content_hash"])
expect(len(hashes) == 2, "the hash of the content holds the mesh")
expect_error(delam("run", scene(small, put("mixed.msh", msh22(NODES, CELLS, NAMES)), BONDED + pulled("y")), "--out",
                   os.path.join(small, "out"), "--resume"), 2, "is not the one")

# A hexahedron below pyramids and two tetrahedra, whose triangles are the top.
SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]
tower = {4 * z + i: (*at, z) for z in range(3) for i, at in enumerate(SQUARE, 1)}
tower[13] = (0.5, 0.5, 1.5)
pyramids = [(5, 6, 7, 8), (5, 9, 10, 6), (6, 10, 11, 7), (7, 11, 12, 8), (8, 12, 9, 5)]
kinds = [(3, 3, 1, (1, 2, 3, 4)), (2, 4, 2, (9, 10, 11)), (2, 4, 2, (9, 11, 12)), (5, 1, 1, tuple(range(1, 9))),
         *((7, 2, 2, (*base, 13)) for base in pyramids), (4, 2, 2, (9, 11, 10, 13)), (4, 2, 2, (9, 12, 11, 13))]
towers = {(3, 1): "lower", (3, 2): "upper", (2, 3): "bottom", (2, 4): "top"}
stretched(small, put("tower.msh", msh22(tower, kinds, towers)), "z", 1, 2, "pyramids between a hexahedron and tetrahedra")

bare = [(t, 0, e, of) for t, _, e, of in CELLS if t > 1]
code, out, error = delam("check", scene(small, put("bare.msh", msh22({**NODES, 9: (7, 7)}, bare, {})),
                                        '[[interfaces]]\nall = true\nlaw = "law"\n[[supports]]\nbody = "surface-1"\n'
                                        'fix = ["x", "y"]\n[[loads]]\n'
                                        'body = "surface-2"\ncomponent = ["y"]\npattern = "p"\n'))
expect(code == 0 and 'body        "surface-1", 1 cell' in out and 'body        "surface-2", 2 cells' in out,
       f"entities are bodies where there are no groups: {error}")
# The notes count what was taken, and edges and points that nobody has named.
loose = [*CELLS, (1, 0, 7, (3, 4)), (1, 0, 8, (2, 4)), (15, 0, 9, (1,))]
code, out, error = delam("check", scene(small, put("loose.msh", msh22(NODES, loose, NAMES)), BONDED + pulled("y")))
expect(code == 0 and "note: taken: 3 cells (1 quad4, 2 tri3) in 2 bodies, 2 named sets" in out and
       "note: left out: 2 edges, 1 point in no physical group" in out, f"counts: {out[-300:]} {error.strip()[:200]}")
code, out, error = delam("check", scene(small, "mixed.msh", BONDED + pulled("y")))
expect(code == 0 and "note: taken: 3 cells" in out and "note: left out: " not in out, f"nothing is left out: {error}")
refused("half.msh", msh22(NODES, [*CELLS[:3], (2, 0, 2, (3, 4, 6))], NAMES),
        "element 4 of surface 2 is in no physical group")
refused("tilted.msh", msh22({**NODES, 6: (1, 2, 0.5)}, CELLS, NAMES), r"node 6 is at z = 0\.5", "z = 0")
refused("missing.msh", msh22(NODES, [*CELLS[:4], (2, 2, 2, (3, 6, 77))], NAMES), "missing.msh: Gmsh says: .*77")
refused("pyramid.msh", msh22({i: (i % 3, i // 3, i % 2) for i in range(1, 14)}, [(19, 1, 1, tuple(range(1, 14)))], {}),
        "Pyramid 13")
refused("script.msh", 'SystemCall "touch ran";\n', r"scene\.toml:\d+: mesh\.file: .*script\.msh: no mesh of Gmsh")
expect(not os.path.exists(os.path.join(small, "ran")) and not os.path.exists("ran"), "a script is not run")
refused("old.msh", "$MeshFormat\n3.0 0 8\n$EndMeshFormat\n", "mesh format 3.0 is not read: 2.2 and 4.1 are")
refused("empty.msh", "", "no mesh of Gmsh")
refused("nothing.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n", "no cells")
refused("cut.msh", MSH41[:-30], "cut.msh: the file ends before .EndElements")
refused("mesh.vtk", "", r"Gmsh \(.msh\) or of Abaqus \(.inp\)")
expect_error(delam("check", scene(small, "nowhere.msh", "")), 2, r"mesh\.file", "nowhere.msh", "No such file")
refused("bodies.msh", MSH41, "bodies is for .inp alone", keys='bodies = ["a"]\n')
refused("plane.msh", MSH41, r"mesh\.plane", keys='plane = "flat"\n')
refused("twisted.msh", msh22(NODES, [*CELLS[:2], (3, 1, 1, (1, 4, 2, 3)), *CELLS[3:]], NAMES), "mesh", extra=BONDED)
for old, new, words in (('name = "*"', 'name = "quad"', 'there is none for "tris"; the mesh has: quad, tris'),
                        ('name = "*"', 'name = "qad"', r'bodies\[0\]\.name: "qad".*did you mean .quad'),
                        ('material = "m"', 'material = "m"\nformulation = "soft"', r"bodies\[0\]\.formulation"),
                        ("[[bodies]]", '[[bodies]]\nname = "*s"\nmaterial = "m"\n[[bodies]]', "described by")):
    path = scene(small, "mixed41.msh", BONDED + pulled("y"))
    with open(path, encoding="utf-8") as file:
        text = file.read()
    with open(path, "w", encoding="utf-8") as file:
        file.write(text.replace(old, new, 1))
    expect_error(delam("check", path), 2, words)
refused("both.msh", MSH41, "geometry: is not for a scene with", extra="[geometry]\ndimension = 2\n")

# ---- Abaqus ----
FLAT = """*Heading
 a bar of two materials
** a comment
*NODE, NSET=all
1, 0.d0, 0., 0.
2, 1.D+0, 0.
3, 0., 1.
4, 1., 1.
5, 0, 2
6, +1.0e0, 2
90, 5., 5.
*Element, type=CPE4R,
 elset=Lower
10, 1, 2,
4, 3
*ELEMENT, TYPE=CPE3, ELSET=Upper
20, 3, 4, 6
21, 3, 6, 5
*NSET, NSET=bottom, GENERATE
1, 2, 1
*NSET, NSET="top"
5,
6
*NSET, NSET=hook
90
*ELSET, ELSET=lid
21
*SURFACE, NAME=lidtop, TYPE=ELEMENT
LID, S2
*SURFACE, NAME=wall
10, S4
20, S2
*MATERIAL, NAME=steel
*ELASTIC
210e9, 0.3
*STEP
*STATIC
*CLOAD
5, 2, 1.
*END STEP
"""
stretched(small, put("flat.inp", FLAT), "y", 1, 2, "a flat .inp")
code, out, error = delam("check", scene(small, "flat.inp", BONDED + pulled("y")))
expect(code == 0 and all(w in out for w in ('"Lower", 1 cell', '"Upper", 2 cells', '"all", 7 nodes',
                                            '"bottom", 2 nodes',
                                            '"lidtop", 2 nodes, 1 face', '"wall", 4 nodes, 2 faces', '"hook", 1 node',
                                            "CPE4R: integrated fully here", "ignored: *ELASTIC, *MATERIAL, *STEP")),
       f"check of a flat .inp: {error}")
row = last_row(small, scene(small, "flat.inp", BONDED + '[[supports]]\nset = "bottom"\nfix = ["x", "y"]\n'
                            '[[forces]]\nset = "lidtop"\npressure = -0.5\npattern = "p"\n'))
expect(row is not None and near(row["stored_bulk"], 0.5 ** 2 * 2 / (2 * YOUNG)), "pressure on a surface of an .inp")
code, out, error = delam("check", scene(small, put("cps.inp", FLAT.replace("CPE", "CPS").replace("CPS4R", "CPS4I")),
                                        BONDED + pulled("y")))
expect(code == 0 and '"Lower", 1 cell, material "m", formulation incompatible' in out, "CPS4I has incompatible modes")
code, out, _ = delam("check", scene(small, "cps.inp", BONDED + pulled("y")), "--set",
                     "materials[0].formulation=standard")
expect(code == 0 and '"Lower", 1 cell, material "m", formulation standard' in out and
       "formulation incompatible" not in out, "the scene says otherwise")

PARTS = """*PART, NAME=Brick
*NODE
1, 0, 0, 0
2, 1, 0, 0
3, 1, 1, 0
4, 0, 1, 0
5, 0, 0, 1
6, 1, 0, 1
7, 1, 1, 1
8, 0, 1, 1
*ELEMENT, TYPE=C3D8
1, 1, 2, 3, 4, 5, 6, 7, 8
*ELSET, ELSET=Set-1
1
*NSET, NSET=low, GENERATE
1, 4
*SURFACE, NAME=lid
Set-1, S2
*SOLID SECTION, ELSET=set-1, MATERIAL=steel
1.,
*END PART
*ASSEMBLY, NAME=A
*INSTANCE, NAME=One, PART=brick
*END INSTANCE
*INSTANCE, NAME=Two, PART=Brick
0., 1., 1.
0., 1., 1., 1., 1., 1., 90.
*END INSTANCE
*NSET, NSET=bottom, INSTANCE=One
LOW
*NSET, NSET=top
Two.3, Two.4, Two.7, Two.8
*SURFACE, NAME=both
One.Set-1, S4
Two.SET-1, S4
*END ASSEMBLY
"""
# The second brick, turned by 90 degrees about an edge: its y is z now, so its side y = 1 is the top.
stretched(small, put("parts.inp", PARTS), "z", 1, 2, "instances, moved and turned")
code, out, error = delam("check", scene(small, "parts.inp", BONDED + pulled("z")))
expect(code == 0 and all(w in out for w in ('"One.Set-1", 1 cell', '"Two.Set-1", 1 cell', '"One.lid", 4 nodes, 1 face',
                                            '"both", 8 nodes, 2 faces', '"One.Set-1-Two.Set-1", 4 pairs')),
       f"names of an assembly: {error}")
put("nodes.txt", "".join(line + "\n" for line in FLAT.split("\n")[4:11]))
put("include.inp", FLAT.split("1, 0.d0")[0] + "*INCLUDE, INPUT=nodes.txt\n*Element" + FLAT.split("*Element")[1])
stretched(small, "include.inp", "y", 1, 2, "nodes from another file")
code, out, error = delam("check", scene(small, put("sets.inp", FLAT + "*ELSET, ELSET=one\nLOWER, UPPER\n"),
                                    pulled("y"), 'bodies = ["ONE"]\n'))
expect(code == 0 and '"ONE", 3 cells' in out, f"bodies that the scene names: {error}")


def inp(old, new, *patterns, text=FLAT, keys=""):
    assert old in text, old
    refused("bad.inp", text.replace(old, new, 1), *patterns, keys=keys)


inp("TYPE=CPE3", "TYPE=COHAX4", r"bad\.inp:16: \*ELEMENT: type COHAX4 is not read")
inp("TYPE=CPE3", "TYPE=COH2D4", r"bad\.inp:17: \*ELEMENT: 3 nodes: COH2D4 has 4")
inp("TYPE=CPE3", "TYPE=CPE3H", r"bad\.inp:16: \*ELEMENT: type CPE3H is not read \(did you mean 'CPE3'")
inp("20, 3, 4, 6", "20, 3, 4", r"bad\.inp:17: \*ELEMENT: 2 nodes: CPE3 has 3")
inp("20, 3, 4, 6", "20, 3, 4, 66", r"bad\.inp:17: \*ELEMENT: element 20 has node 66, which is not there")
inp("20, 3, 4, 6", "20, 3, 4, 6.5", r"bad\.inp:17: \*ELEMENT: \"6\.5\": a whole number")
inp("21, 3, 6, 5", "20, 3, 6, 5", r"bad\.inp:18: \*ELEMENT: element 20 occurs twice")
inp("5, 0, 2", "5, 0, two", r"bad\.inp:9: \*NODE: \"two\": a finite number")
inp("5, 0, 2", "4, 0, 2", r"bad\.inp:9: \*NODE: node 4 occurs twice")
inp("5, 0, 2", "5, 0, 2, 1", r"node 5 is at z = 1")
inp("1, 2, 1\n", "1, 6, 2\n", r"bad\.inp:20: \*NSET: 1, 6, 2")
inp("*NSET, NSET=hook\n90", "*NSET, NSET=hook\n91", r"bad\.inp:25: \*NSET: node 91 is not there")
inp("LID, S2", "LID, S4", r"bad\.inp:29: \*SURFACE: S4: element 21 \(CPE3\) has sides S1 .. S3")
inp("LID, S2", "LIT, S2", r"bad\.inp:29: \*SURFACE: element set \"LIT\" is not there")
inp("*MATERIAL, NAME=steel", "*TIE, NAME=t", r"bad\.inp:33: \*TIE: a data line is expected")
inp("*NODE, NSET=all", "*NODE, SYSTEM=Q", r"bad\.inp:4: \*NODE: SYSTEM=Q is not imported: R, C or S is")
inp("*Heading\n", "", r"bad\.inp:1: a keyword line")
inp("*END STEP", "", r"\*STEP is not ended")
inp("*MATERIAL", "*INCLUDE, INPUT=bad.inp\n*MATERIAL", r"bad\.inp:33: \*INCLUDE: files include each other")
inp("*MATERIAL", "*INCLUDE, INPUT=none.txt\n*MATERIAL", r"bad\.inp:33: \*INCLUDE: .*none\.txt")
inp("*END PART\n", "", r"bad\.inp:21: \*ASSEMBLY: \"Brick\" is not ended", text=PARTS)
inp("PART=brick", "PART=stone", r"bad\.inp:23: \*INSTANCE: part \"stone\" is not there", text=PARTS)
inp("0., 1., 1., 1., 1., 1., 90.", "0., 1., 1., 0., 1., 1., 90.", "two points of the axis", text=PARTS)
inp("*ELSET, ELSET=Set-1\n1\n", "*ELSET, ELSET=Set-2\n1\n", r"element set .set-1. is not there", text=PARTS)
inp("One.Set-1, S4", "Six.Set-1, S4", r"instance \"Six\" is not there", text=PARTS)
inp("*Heading", "*Heading", "element 10 is in none of the bodies: UPPER", keys='bodies = ["UPPER"]\n')
finish()
