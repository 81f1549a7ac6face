# SPDX-License-Identifier: BSD-3-Clause
"""Twenty meshes as their writers write them: a bar of two blocks, 1 x 1 x 2 or 1 x 2, that is stretched and stores what the same
bar in layers stores; or a mesh that is refused by its name, with the way to one that is read, which is then gone where its tools are here."""
import os
import shutil
import struct
import subprocess

from mesh_scenes import BONDED, STRETCH, YOUNG, last_row, near, scene, stretched
from support import delam, expect, expect_error, finish, folder

place = folder()
# The bar, cell by cell from the bottom up; plane ones in two triangles or a quadrilateral.
SOLID = [(x, y, z) for z in range(3) for y in range(2) for x in range(2)]
HEXES = [(0, 1, 3, 2, 4, 5, 7, 6), (4, 5, 7, 6, 8, 9, 11, 10)]
PLANE = [(x, y, 0) for y in range(3) for x in range(2)]
QUADS = [(0, 1, 3, 2), (2, 3, 5, 4)]
TRIS = [(0, 1, 3), (0, 3, 2), (2, 3, 5), (2, 5, 4)]
PLACES = [(x / 2, y / 2, 0) for y in range(5) for x in range(3)]  # with the nodes midway
TETS = [(0, 1, 3, 7), (0, 3, 2, 7), (0, 2, 6, 7), (0, 6, 4, 7), (0, 4, 5, 7), (0, 5, 1, 7)]
KINDS = {"line": 1, "tri": 2, "quad": 3, "tet": 4, "hex": 5, "wedge": 6, "tri6": 9, "point": 15}
DIMENSION = {1: 1, 2: 2, 3: 2, 4: 3, 5: 3, 6: 3, 9: 2, 15: 0}


def held(axis, height=2.0):
    """By boxes in the place of sets, which many meshes do not have."""
    across = ('"x", "y", "z"', 2) if axis == "z" else ('"x", "y"', 1)
    box = [0.0] * (across[1] + 1)
    far = [1.0] * across[1]
    return (f"[[supports]]\nbox = {{ lower = {box}, upper = {[*far, 0.0]} }}\nfix = [{across[0]}]\n"
            f"[[loads]]\nbox = {{ lower = {[*box[:-1], height]}, upper = {[*far, height]} }}\n"
            f'component = ["{axis}"]\npattern = "p"\ncoefficient = {STRETCH}\n')


def taken(name, axis, bodies, cells, text=BONDED, keys=""):
    """Cells and bodies as they should be, and the energy of the bar."""
    path = scene(place, name, text + held(axis), keys)
    code, said, error = delam("check", path)
    counted = [line for line in said.splitlines() if line.startswith("body ")]
    found = sum(int(line.split('", ')[1].split(" cell")[0]) for line in counted)
    expect(code == 0 and len(counted) == bodies and found == cells, f"{name}: {len(counted)} bodies, {found} cells {error[:300]}")
    row = last_row(place, path)
    expect(row is not None and near(row["stored_bulk"], YOUNG * STRETCH ** 2 / 4), f"{name}: {row and row['stored_bulk']}")


def write(name, content):
    with open(os.path.join(place, name), "wb" if isinstance(content, bytes) else "w", **(
            {} if isinstance(content, bytes) else {"encoding": "utf-8"})) as file:
        file.write(content)
    return name


def refused(name, content, *patterns):
    expect_error(delam("check", scene(place, write(name, content), BONDED)), 2, *patterns)


def msh2(nodes, cells, binary=False, names=None, sections="", tags=2):
    """Format 2.2. nodes: by label; cells: kind, physical group, entity, labels."""
    names = names or {}
    out = f"$MeshFormat\n2.2 {int(binary)} 8\n".encode() + (struct.pack("<i", 1) + b"\n" if binary else b"")
    out += b"$EndMeshFormat\n" + sections.encode()
    if names:
        out += f"$PhysicalNames\n{len(names)}\n".encode() + "".join(
            f'{d} {g} "{name}"\n' for (d, g), name in names.items()).encode() + b"$EndPhysicalNames\n"
    out += f"$Nodes\n{len(nodes)}\n".encode()
    for label, at in nodes.items():
        out += struct.pack("<i3d", label, *at) if binary else f"{label} {' '.join(repr(float(x)) for x in at)}\n".encode()
    out += (b"\n" if binary else b"") + f"$EndNodes\n$Elements\n{len(cells)}\n".encode()
    for number, (kind, group, entity, of) in enumerate(cells, 1):
        if binary:
            out += struct.pack(f"<3i{3 + len(of)}i", KINDS[kind], 1, 2, number, group, entity, *of)
        else:
            more = [0] * (tags - 2)
            out += (" ".join(map(str, (number, KINDS[kind], tags, group, entity, *more, *of))) + "\n").encode()
    return out + (b"\n" if binary else b"") + b"$EndElements\n"


def msh4(nodes, cells, binary=False, names=None, partitions=0):
    """Format 4.1: the nodes in one block, the cells in one for each entity. cells as above."""
    names, pack = names or {}, struct.pack
    entities = sorted({(DIMENSION[KINDS[kind]], entity, group) for kind, group, entity, _ in cells})

    def ints(*values):
        return pack(f"<{len(values)}i", *values) if binary else (" ".join(map(str, values)) + "\n").encode()

    def sizes(*values):
        return pack(f"<{len(values)}Q", *values) if binary else (" ".join(map(str, values)) + "\n").encode()

    out = f"$MeshFormat\n4.1 {int(binary)} 8\n".encode() + (pack("<i", 1) + b"\n" if binary else b"") + b"$EndMeshFormat\n"
    if names:
        out += f"$PhysicalNames\n{len(names)}\n".encode() + "".join(
            f'{d} {g} "{name}"\n' for (d, g), name in names.items()).encode() + b"$EndPhysicalNames\n"
    out += b"$Entities\n" + sizes(*(sum(d == of for d, _, _ in entities) for of in range(4)))
    for d, entity, group in entities:
        bounds = [0.0, 0.0, 0.0] * (1 if d == 0 else 2)
        groups = [group] if group else []
        if binary:
            out += pack(f"<i{len(bounds)}dQ{len(groups)}i", entity, *bounds, len(groups), *groups) + (pack("<Q", 0) if d else b"")
        else:
            out += (" ".join(map(str, [entity, *bounds, len(groups), *groups, *([0] if d else [])])) + "\n").encode()
    out += (b"\n" if binary else b"") + b"$EndEntities\n"
    if partitions:
        pieces = [(d, 10 + entity, d, entity, 1, 1, *[0.0] * 6, 1 if group else 0, *([group] if group else []), 0)
                  for d, entity, group in entities]
        out += (f"$PartitionedEntities\n{partitions}\n0\n" + " ".join(
            str(sum(d == of for d, _, _ in entities)) for of in range(4)) + "\n" + "".join(
                " ".join(map(str, piece[1:])) + "\n" for piece in pieces) + "$EndPartitionedEntities\n").encode()
        cells = [(kind, group, 10 + entity, of) for kind, group, entity, of in cells]
    d, entity, _ = entities[-1]
    home = entity + (10 if partitions else 0)
    out += b"$Nodes\n" + sizes(1, len(nodes), min(nodes), max(nodes))
    out += ints(d, home, 0) + sizes(len(nodes)) if binary else f"{d} {home} 0 {len(nodes)}\n".encode()
    out += sizes(*nodes) if binary else "".join(f"{label}\n" for label in nodes).encode()
    out += b"".join(pack("<3d", *at) if binary else (" ".join(map(str, at)) + "\n").encode() for at in nodes.values())
    blocks = {}
    for number, (kind, _, entity, of) in enumerate(cells, 1):
        blocks.setdefault((DIMENSION[KINDS[kind]], entity, KINDS[kind]), []).append((number, *of))
    out += (b"\n" if binary else b"") + b"$EndNodes\n$Elements\n" + sizes(len(blocks), len(cells), 1, len(cells))
    for block, rows in blocks.items():
        out += ints(*block) + sizes(len(rows)) if binary else (" ".join(map(str, (*block, len(rows)))) + "\n").encode()
        out += b"".join(sizes(*row) for row in rows)
    return out + (b"\n" if binary else b"") + b"$EndElements\n"


def labelled(points, first=1, by=1):
    return {first + by * i: at for i, at in enumerate(points)}


def with_labels(kind, cells, first=1, by=1, half=1, groups=(1, 2)):
    """The lower half of the cells in one body, the others in another; groups of 0: none."""
    return [(kind, groups[0 if c < half else 1], 1 if c < half else 2, tuple(first + by * i for i in cell))
            for c, cell in enumerate(cells)]


def check_gmsh():
    """Both formats, text and binary, with and without names."""
    taken(write("tri-22.msh", msh2(labelled(PLANE), with_labels("tri", TRIS, half=2), sections="$Comments\nby hand\n$EndComments\n")),
          "y", 2, 4)
    clockwise = [cell[::-1] for cell in QUADS]
    taken(write("quad-22b.msh", msh2(labelled(PLANE), with_labels("quad", clockwise), True, {(2, 1): "a b", (2, 2): "ü"})), "y", 2, 2)
    unused = {**labelled(SOLID, 1000, 7), 5: (9, 9, 9), 2000: (-3, 0, 0)}
    taken(write("hex-41.msh", msh4(unused, with_labels("hex", HEXES, 1000, 7), names={(3, 1): "low", (3, 2): "up"})), "z", 2, 2)
    tets = [tuple(cell[i] + 4 * k for i in range(4)) for k in range(2) for cell in TETS]
    taken(write("tet-41b.msh", msh4(labelled(SOLID), with_labels("tet", tets, half=6, groups=(0, 0)), True)), "z", 2, 12)
    wide = [tuple(2 * (n % 2) + 6 * (n // 2) for n in cell) for cell in TRIS]
    six = [(*cell, *((a + b) // 2 for a, b in zip(cell, cell[1:] + cell[:1]))) for cell in wide]
    for name, text in (("tri6-41.msh", msh4(labelled(PLACES), with_labels("tri6", six, half=2))),
                       ("tri6-22b.msh", msh2(labelled(PLACES), with_labels("tri6", six, half=2), True))):
        taken(write(name, text), "y", 2, 4)


def check_neper():
    """Neper's: sections of its own, faces beside the cells, three tags for each element, orientations behind."""
    faces = [("tri", 0, 11, (1, 2, 3)), ("tri", 0, 12, (2, 4, 3)), ("line", 0, 21, (1, 2)), ("point", 0, 31, (1,))]
    own = "$MeshVersion\n2.2.4\n$EndMeshVersion\n$Domain\ncube\n$EndDomain\n$Topology\n0\n$EndTopology\n"
    tets = [tuple(cell[i] + 4 * k for i in range(4)) for k in range(2) for cell in TETS]
    text = msh2(labelled(SOLID), faces + with_labels("tet", tets, half=6, groups=(0, 0)), sections=own, tags=3)
    behind = (b"$NSets\n1\nz0\n4\n1\n2\n3\n4\n$EndNSets\n$Fasets\n1\nz0\n2\n1 1 2 3\n2 2 4 3\n$EndFasets\n"
              b"$NodePartitions\n12\n1 1\n$EndNodePartitions\n$ElsetOrientations\n2 euler-bunge:active\n1 0 0 0\n2 90 0 0\n"
              b"$EndElsetOrientations\n$Groups\n3\n2\n1 1\n2 2\n$EndGroups\n")
    taken(write("neper.msh", text + behind), "z", 2, 12)


def check_several_dimensions():
    """Points, edges and faces of groups of their own beside the cells, of which some are left out."""
    names = {(3, 1): "low", (3, 2): "up", (2, 3): "bottom", (2, 4): "top", (1, 5): "edge", (0, 6): "corner"}
    more = [("quad", 3, 3, (1, 2, 4, 3)), ("quad", 4, 4, (9, 10, 12, 11)), ("line", 5, 5, (1, 2)), ("point", 6, 6, (1,)),
            ("line", 0, 9, (3, 4)), ("point", 0, 8, (12,))]
    name = write("dimensions.msh", msh2(labelled(SOLID), more + with_labels("hex", HEXES), names=names))
    taken(name, "z", 2, 2)
    stretched(place, name, "z", 1, 2, "by its sets")
    _, said, _ = delam("check", scene(place, name, BONDED + held("z")))
    expect("left out: 1 edge, 1 point in no physical group" in said and '"edge", 2 nodes' in said, "what is left out, and sets of edges")


def check_doubled():
    """Nodes of their own where the blocks meet, in one body that falls into pieces; cells that lie upon each other."""
    apart = [*SOLID[:8], *SOLID[4:]]
    cells = [HEXES[0], tuple(i + 4 for i in HEXES[1])]
    bonded = '[[interfaces]]\na = "volume-1-1"\nb = "volume-1-2"\nbonded = true\n'
    alone = [("hex", 0, 1, tuple(i + 1 for i in cell)) for cell in cells]
    taken(write("doubled.msh", msh4(labelled(apart), alone)), "z", 2, 2, bonded, "pieces = true\n")
    refused("twice.msh", msh2(labelled(SOLID), with_labels("hex", [HEXES[0], HEXES[0]])), "twice.msh", "element")
    refused("inside-out.msh", msh2(labelled(SOLID), with_labels("hex", [HEXES[0], HEXES[1][4:] + HEXES[1][:4]])),
            r"element 2 of .*inside-out\.msh .*smallest Jacobian")


def check_split():
    """One file of a mesh that was split."""
    refused("part_1.msh", msh4(labelled(SOLID), with_labels("hex", HEXES[:1]), partitions=2), "cells of 1 of its 2 partitions",
            "without -part_split")


def check_abaqus_mesh():
    """A deck's mesh alone: labels that do not begin at 1, sets of other elements, exponents as meshio writes them."""
    nodes = "".join(f"{n}, {x:.16e}, {y:.16e}, {z:.16e}\n" for n, (x, y, z) in labelled(SOLID, 501, 3).items())
    cells = "".join(f"*ELEMENT, TYPE=C3D8, ELSET={name}\n{40 + k}, " + ",".join(str(501 + 3 * i) for i in cell) + "\n"
                    for k, (name, cell) in enumerate(zip("AB", HEXES)))
    text = f"*HEADING\nAbaqus DataFile Version 6.14\nwritten by meshio v5.3.5\n*NODE\n{nodes}{cells}"
    taken(write("mesh.inp", text), "z", 2, 2)
    taken(write("mark.inp", b"\xef\xbb\xbf" + text.replace("\n", "\r\n").encode()), "z", 2, 2)


def nastran(form):
    """Bulk data in small, large or free fields; properties 7 and 8."""
    def fields(name, values):
        if form == "free":
            words = [str(v) for v in values]
            lines = [words[i:i + 8] for i in range(0, len(words), 8)]
            return ",+\n+,".join(",".join(line) for line in ([[name, *lines[0]], *lines[1:]])) + "\n"
        width, count = (8, 8) if form == "small" else (16, 4)
        star = "" if form == "small" else "*"
        words = [f"{v:>{width}}" for v in values]
        lines = ["".join(words[i:i + count]) for i in range(0, len(words), count)]
        return "\n".join(f"{name + star if i == 0 else '+' if form == 'small' else '*':<8}{line}" for i, line in enumerate(lines)) + "\n"

    text = "$ written by hand\nBEGIN BULK\n"
    text += "".join(fields("GRID", [n, "", float(x), float(y), float(z)]) for n, (x, y, z) in labelled(SOLID, 101).items())
    return text + "".join(fields("CHEXA", [k + 1, k + 7, *(i + 101 for i in cell)]) for k, cell in enumerate(HEXES)) + "ENDDATA\n"


def ideas():
    def dataset(number, text):
        return f"    -1\n{number:>6}\n{text}    -1\n"

    nodes = "".join(f"{n:>10}{1:>10}{1:>10}{11:>10}\n" + "".join(f"{v:>25.16E}" for v in at).replace("E", "D") + "\n"
                    for n, at in labelled(SOLID).items())
    cells = "".join(f"{k + 1:>10}{115:>10}{k + 1:>10}{k + 1:>10}{7:>10}{8:>10}\n" + "".join(f"{i + 1:>10}" for i in cell) + "\n"
                    for k, cell in enumerate(HEXES))
    return dataset(2411, nodes) + dataset(2412, cells)


def medit():
    return ("MeshVersionFormatted 2\nDimension 3\nVertices\n12\n" + "".join(f"{x} {y} {z} 0\n" for x, y, z in SOLID) +
            "Hexahedra\n2\n" + "".join(" ".join(str(i + 1) for i in cell) + f" {k + 3}\n" for k, cell in enumerate(HEXES)) + "End\n")


def check_converted_by_gmsh():
    """Refused with a command line, which gives the mesh with its bodies."""
    for name, text, what in (("small.bdf", nastran("small"), "Nastran"), ("large.nas", nastran("large"), "Nastran"),
                             ("free.BDF", nastran("free"), "Nastran"), ("model.unv", ideas(), "I-DEAS"),
                             ("model.mesh", medit(), "Medit")):
        stem = name.rsplit(".", 1)[0]
        refused(name, text, rf"{name}: a mesh of Gmsh \(.msh\) or of Abaqus \(.inp\) is expected, and this is a mesh of {what}: "
                            rf"gmsh {name} -save -o {stem}\.msh converts it")
        if shutil.which("gmsh"):
            os.replace(os.path.join(place, name), os.path.join(place, name.lower()))  # Gmsh goes by the ending
            subprocess.run(["gmsh", name.lower(), "-save", "-o", f"{stem}.msh"], cwd=place, check=True, capture_output=True)
            taken(f"{stem}.msh", "z", 2, 2)


VTU = """<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian">
<UnstructuredGrid><Piece NumberOfPoints="12" NumberOfCells="2">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">{points}</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">{cells}</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">8 16</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">12 12</DataArray></Cells>
<CellData><DataArray type="Int64" Name="part" format="ascii">3 4</DataArray></CellData>
</Piece></UnstructuredGrid></VTKFile>
"""
VTK = """# vtk DataFile Version 3.0
bar
ASCII
DATASET UNSTRUCTURED_GRID
POINTS 12 double
{points}
CELLS 2 18
8 {low}
8 {up}
CELL_TYPES 2
12
12
CELL_DATA 2
SCALARS part int 1
LOOKUP_TABLE default
3
4
"""
XDMF = """<Xdmf Version="3.0"><Domain><Grid Name="Grid">
<Geometry GeometryType="XYZ"><DataItem DataType="Float" Dimensions="12 3" Format="XML" Precision="8">{points}</DataItem></Geometry>
<Topology TopologyType="Hexahedron" NumberOfElements="2"><DataItem DataType="Int" Dimensions="2 8" Format="XML" Precision="8">
{cells}</DataItem></Topology>
<Attribute Name="part" AttributeType="Scalar" Center="Cell"><DataItem DataType="Int" Dimensions="2" Format="XML" Precision="8">
3 4</DataItem></Attribute></Grid></Domain></Xdmf>
"""


def check_converted_by_meshio():
    """Refused with a line of Python; SCENE.md says how bodies keep their numbers."""
    points = " ".join(f"{x}. {y}. {z}." for x, y, z in SOLID)
    low, up = (" ".join(map(str, cell)) for cell in HEXES)
    for name, text, what in (("bar.vtu", VTU, "VTK"), ("bar.vtk", VTK, "VTK"), ("bar.xdmf", XDMF, "XDMF")):
        write(name, text.format(points=points, cells=f"{low} {up}", low=low, up=up))
        refused(name, text.format(points=points, cells=f"{low} {up}", low=low, up=up), f"this is a mesh of {what}: meshio .*"
                rf'meshio\.read\("{name}"\)\.write\("bar\.msh", "gmsh22"\)', "SCENE.md")
        try:
            import meshio
        except ImportError:
            continue
        mesh = meshio.read(os.path.join(place, name))
        mesh.cell_data["gmsh:physical"] = mesh.cell_data["gmsh:geometrical"] = [
            part.astype(int).ravel() for part in mesh.cell_data["part"]]
        mesh.write(os.path.join(place, "bar.msh"), "gmsh22")
        taken("bar.msh", "z", 2, 2)
    refused("bar.med", b"\x89HDF", "this is a mesh of Salome: meshio")
    refused("bar.e", b"CDF\x01", "this is a mesh of Exodus: meshio")


def check_no_mesh_here():
    for name, pattern in (("bar.cdb", "a mesh of ANSYS: let its preprocessor write the mesh for Abaqus"), ("bar.k", "a mesh of LS-DYNA"),
                          ("bar.stl", "a surface: it has no cells; fill its volume"), ("bar.OBJ", "a surface: it has no cells"),
                          ("bar.step", r"a geometry: gmsh bar\.step -3 -o bar\.msh makes a mesh of it")):
        refused(name, "solid bar\n", rf"{name}: a mesh of Gmsh \(.msh\) or of Abaqus \(.inp\) is expected, and this is " + pattern)
    refused("fluent.msh", '(0 "GAMBIT to Fluent File")\n(2 3)\n', r"fluent\.msh: no mesh of Gmsh: \$MeshFormat is expected first")
    refused("one.msh", "$NOD\n1\n1 0 0 0\n$ENDNOD\n", r"one\.msh: no mesh of Gmsh")
    refused("cdb.inp", "/PREP7\nET,1,185\n", r"cdb\.inp:1: a keyword line .* one of ANSYS: convert its mesh")


for check in (check_gmsh, check_neper, check_several_dimensions, check_doubled, check_split, check_abaqus_mesh,
              check_converted_by_gmsh, check_converted_by_meshio, check_no_mesh_here):
    check()
finish()
