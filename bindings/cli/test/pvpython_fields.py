# SPDX-License-Identifier: BSD-3-Clause
"""ParaView opens fields.xdmf: blocks, cells, arrays and their ranges at several times, for each type of cells in 2D and 3D.

Runs the scenes itself (python3), then each result in pvpython, where this file is read once more."""
import os
import subprocess
import sys

READERS = ("Xdmf3ReaderS", "Xdmf3ReaderT", "XDMFReader")
# VTK's numbers of the cells and of the faces of the interface.
CELLS = {"tri3": (5, 3), "quad4": (9, 3), "tri6": (22, 21), "quad8": (23, 21), "quad9": (28, 21),
         "tet4": (10, 5), "hex8": (12, 9), "tet10": (24, 22), "hex20": (25, 23), "wedge6": (13, 5), "pyramid5": (14, 9),
         "wedge15": (26, 22)}
# Straight lines come as polylines.
LINES = (3, 4)
VOLUME = {2: 0.04 * 0.004, 3: 0.04 * 0.006 * 0.004}
AREA = {2: 0.04, 3: 0.04 * 0.006}


def scene(cell):
    """A double cantilever beam that grows by a few cells."""
    flat = cell.startswith(("tri", "quad"))

    def at(x, y, z):
        return str([x, z] if flat else [x, y, z])

    place = "box = {{ lower = {}, upper = {} }}"
    loads = "".join(
        f'[[loads]]\n{place.format(at(0.0, 0.0, z), at(0.0, 0.006, z))}\ndirection = {at(0.0, 0.0, sign)}\npattern = "open"\n'
        for z, sign in ((0.004, 1.0), (0.0, -1.0)))
    law = "".join(f"{mode}_{key} = {value}\n" for mode in ("normal", "tangential")
                  for key, value in (("stiffness", 125e9), ("onset", 100.0), ("toughness", 250.0)))
    return f"""schema = 1
title = "DCB"
[geometry]
dimension = {2 if flat else 3}
length = 0.040
{"" if flat else "width = 0.006"}
h = 0.002
cell = "{cell}"
[[materials]]
name = "arm"
young = 75e9
poisson = 0.3
[[layers]]
name = "lower"
thickness = 0.002
material = "arm"
[[layers]]
name = "upper"
thickness = 0.002
material = "arm"
[[laws]]
name = "glue"
{law}
[[interfaces]]
lower = "lower"
upper = "upper"
law = "glue"
notch = [{{ from = 0.0, to = 0.012 }}]
[[patterns]]
name = "open"
times = [0.0, 1.0]
values = [0.0, 0.001]
[[supports]]
{place.format(at(0.04, 0.0, 0.0), at(0.04, 0.006, 0.004))}
fix = {'["x", "y"]' if flat else '["x", "y", "z"]'}
{loads}
[time]
end = 1.0
steps = 3
[output]
fields = ["displacement", "stress", "zeta", "jump", "traction", "contact", "mixity", "rotation"]
"""


def mixed_mesh():
    """The same beam in Gmsh's words: 20 quadrilaterals below, 40 triangles above."""
    number, nodes, cells = {}, [], []

    def node(i, j):
        if (i, j) not in number:
            number[i, j] = len(nodes) + 1
            nodes.append(f"{len(nodes) + 1} {0.002 * i} {0.002 * j} 0")
        return number[i, j]

    def cell(kind, body, *corners):
        cells.append(f"{len(cells) + 1} {kind} 2 {body} {body} " + " ".join(map(str, corners)))

    for i in range(20):
        a, b, c, d, e, f = (node(i + k, j) for j in range(3) for k in range(2))
        cell(3, 1, a, b, d, c)
        cell(2, 2, c, d, f)
        cell(2, 2, c, f, e)
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "2", '2 1 "lower"', '2 2 "upper"', "$EndPhysicalNames",
             "$Nodes", str(len(nodes)), *nodes, "$EndNodes", "$Elements", str(len(cells)), *cells, "$EndElements", ""]
    return "\n".join(lines)


def mixed_scene():
    """That of quad4, with the mesh from a file."""
    text = scene("quad4")
    begin, end = text.index("[geometry]"), text.index("[[materials]]")
    text = text[:begin] + '[mesh]\nfile = "mixed.msh"\n' + text[end:]
    begin, end = text.index("[[layers]]"), text.index("[[laws]]")
    text = text[:begin] + '[[bodies]]\nname = "*"\nmaterial = "arm"\n' + text[end:]
    text = text.replace('lower = "lower"\nupper = "upper"', 'a = "lower"\nb = "upper"')
    return text.replace("notch = [{ from = 0.0, to = 0.012 }]", "notch = [{ lower = [-1.0, -1.0], upper = [0.011, 1.0] }]")


def blocks_of(data):
    """Leaves of whatever tree a reader makes."""
    found = []
    tree = data.NewIterator()
    tree.InitTraversal()
    while not tree.IsDoneWithTraversal():
        found.append(tree.GetCurrentDataObject())
        tree.GoToNextItem()
    return found


def size_of(block):
    """Length, area or volume, cell by cell from its corners' shape functions: wrong node orders show."""
    from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter
    measure = vtkCellSizeFilter()
    measure.SetInputData(block)
    measure.Update()
    cells = measure.GetOutput().GetCellData()
    return sum(sum(cells.GetArray(name).GetTuple1(i) for i in range(block.GetNumberOfCells()))
               for name in ("Length", "Area", "Volume"))


def view(folder, cell):
    """In pvpython."""
    from paraview import servermanager, simple
    dimension = 2 if cell in ("tri3", "quad4", "tri6", "quad8", "quad9", "mixed") else 3
    failures = 0

    def expect(condition, what):
        nonlocal failures
        failures += not condition
        print(("ok    " if condition else "FAIL  ") + f"{cell}: {what}")

    path = os.path.join(folder, "fields.xdmf")
    for name in READERS:
        make = getattr(simple, name)
        reader = make(FileNames=[path]) if name == "XDMFReader" else make(FileName=[path])
        reader.UpdatePipelineInformation()
        times = list(reader.TimestepValues)
        expect(len(times) == 4 and abs(times[-1] - 1.0) < 1e-12, f"{name}: times {times}")
        opening = []
        for time in times:
            reader.UpdatePipeline(time)
            found = blocks_of(servermanager.Fetch(reader))
            if len(found) != 2:
                expect(False, f"{name}: {len(found)} blocks")
                return 1
            bodies, face = found
            zeta = face.GetPointData().GetArray("zeta").GetRange()
            opening.append(bodies.GetPointData().GetArray("displacement").GetRange(dimension - 1)[1])
            expect(0.0 <= zeta[0] <= zeta[1] <= 1.0, f"{name}: zeta from {zeta[0]:.3g} to {zeta[1]:.3g} at {time:.3g}")
        expect(all(abs(u - 1e-3 * t) < 1e-6 for u, t in zip(opening, times)), f"{name}: the opening follows the load: {opening}")
        kind = CELLS.get(cell, (0, 3))[1]
        faces = LINES if kind == 3 else (kind,)
        kinds = {bodies.GetCellType(i) for i in range(bodies.GetNumberOfCells())}
        expect(kinds == ({5, 9} if cell == "mixed" else {CELLS[cell][0]}) and face.GetCellType(0) in faces, f"{name}: types of cells")
        expect([bodies.GetPointData().GetArray(i).GetName() for i in range(bodies.GetPointData().GetNumberOfArrays())] == ["displacement"]
               and {"body", "stress", "rotation"} == {bodies.GetCellData().GetArray(i).GetName() for i in range(bodies.GetCellData().GetNumberOfArrays())},
               f"{name}: arrays of the bodies")
        expect({"zeta", "jump", "traction", "contact", "mixity", "displacement"} ==
               {face.GetPointData().GetArray(i).GetName() for i in range(face.GetPointData().GetNumberOfArrays())}, f"{name}: arrays of the interface")
        expect(bodies.GetCellData().GetArray("stress").GetNumberOfComponents() == 6 and bodies.GetCellData().GetArray("stress").GetRange(-1)[1] > 1e6 and
               bodies.GetCellData().GetArray("body").GetRange() == (0.0, 1.0) and 0 < bodies.GetCellData().GetArray("rotation").GetRange(-1)[1] < 0.2,
               f"{name}: ranges")
        volume, area = size_of(bodies), size_of(face)
        expect(abs(volume / VOLUME[dimension] - 1) < 1e-6 and abs(area / AREA[dimension] - 1) < 1e-6, f"{name}: sizes {volume:.4g}, {area:.4g}")
        # What people do: warp, and cut.
        warped = simple.WarpByVector(Input=reader, Vectors=["POINTS", "displacement"], ScaleFactor=5.0)
        warped.UpdatePipeline(times[-1])
        expect(len(blocks_of(servermanager.Fetch(warped))) == 2, f"{name}: both blocks warp")
    return failures


def main():
    from support import delam, expect, finish, folder, write
    for cell in [*CELLS, "mixed"]:
        out = folder()
        path = write(mixed_scene() if cell == "mixed" else scene(cell))
        if cell == "mixed":
            with open(os.path.join(os.path.dirname(path), "mixed.msh"), "w", encoding="utf-8") as file:
                file.write(mixed_mesh())
        code, _, error = delam("run", path, "--out", out)
        expect(code == 0, f"a run with {cell} {error.strip()}")
        done = subprocess.run(["pvpython", "--force-offscreen-rendering", os.path.abspath(__file__), out, cell], capture_output=True, text=True,
                              timeout=300, check=False)
        sys.stdout.write(done.stdout)
        expect(done.returncode == 0, f"pvpython on {cell}: {done.stderr.strip()[-500:]}")
    finish()


if len(sys.argv) == 3:
    sys.exit(1 if view(*sys.argv[1:]) else 0)
main()
