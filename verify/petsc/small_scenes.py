# SPDX-License-Identifier: BSD-3-Clause
"""Scenes of every kind that many processes solve, at a size that takes a second."""
import os

from launch import EXAMPLES, folder


def example(name, *settings):
    return os.path.join(EXAMPLES, name, name + ".toml"), [*settings, "output.every=1"]


def own(text, *settings, **files):
    """A scene of this file; files: name without .msh and its content."""
    place = folder()
    for name, content in {"scene.toml": text, **{name + ".msh": content for name, content in files.items()}}.items():
        with open(os.path.join(place, name), "w", encoding="utf-8") as file:
            file.write(content)
    return os.path.join(place, "scene.toml"), [*settings, "output.every=1"]


MATERIALS = """
schema = 1
[[materials]]
name = "arm"
young = 75e9
poisson = 0.3
expansion = 2e-5
[[materials]]
name = "stiff"
young = 200e9
poisson = 0.3
expansion = 0.0
[[laws]]
name = "glue"
normal_stiffness = 1e13
tangential_stiffness = 1e13
normal_onset = 20.0
tangential_onset = 20.0
normal_toughness = 250.0
tangential_toughness = 500.0
[output]
snapshots = [1.0]
[time]
end = 1.0
steps = 8
"""
BEAM = """
[geometry]
dimension = 2
length = 0.06
divisions = 24
[[layers]]
name = "lower"
thickness = 0.003
divisions = 2
material = "stiff"
[[layers]]
name = "upper"
thickness = 0.003
divisions = 2
material = "arm"
[[interfaces]]
lower = "lower"
upper = "upper"
law = "glue"
notch = [{ from = 0.0, to = 0.02 }]
"""
CLAMP = '[[supports]]\nbox = { lower = [0.06, 0.0], upper = [0.06, 0.006] }\nfix = ["x", "y"]\n'
HELD = '[[supports]]\nbox = { lower = [0.0, 0.0], upper = [0.06, 0.0] }\nfix = ["x", "y"]\n'
RISES = '[[patterns]]\nname = "{}"\ntimes = [0, 1]\nvalues = [0, {}]\n'

# The upper layer comes off by the strains of its heating, and is lifted: only a point and contact hold it in the end.
FLOATS = MATERIALS + BEAM + HELD + RISES.format("warm", 1000.0) + RISES.format("lift", 5e-4) + """
[[thermal]]
pattern = "warm"
layers = ["upper"]
[[loads]]
point = [0.03, 0.006]
component = ["y"]
pattern = "lift"
"""
# Dead forces open, but less than the limit load.
FORCES = MATERIALS + BEAM + CLAMP + RISES.format("pull", 2e4) + """
[[forces]]
patch = { centre = [0.0, 0.0045], length = 0.003, face = "-x" }
layer = "upper"
pattern = "pull"
force = [0.0, 1.0]
[[forces]]
patch = { centre = [0.0, 0.0015], length = 0.003, face = "-x" }
layer = "lower"
pattern = "pull"
force = [0.0, -1.0]
"""
# A rigid nose presses the middle, the notched end opens by a mean: contact, an obstacle, equations.
PUNCH = MATERIALS + BEAM + CLAMP + RISES.format("press", 1e-3) + RISES.format("open", 4e-4) + """
[[controls]]
name = "nose"
[[obstacles]]
patch = { centre = [0.04, 0.006], length = 0.005, face = "+y" }
control = "nose"
[[supports]]
control = "nose"
fix = ["x"]
[[loads]]
control = "nose"
direction = [0.0, -1.0]
pattern = "press"
[[supports]]
patch = { centre = [0.0, 0.0015], length = 0.003, face = "-x" }
layer = "lower"
fix = ["y"]
[[loads]]
patch = { centre = [0.0, 0.0045], length = 0.003, face = "-x" }
layer = "upper"
component = ["y"]
pattern = "open"
"""
PEEL = CLAMP + RISES.format("open", 8e-4) + """
[[loads]]
patch = { centre = [0.0, 0.0045], length = 0.003, face = "-x" }
layer = "upper"
direction = [0.0, 1.0]
pattern = "open"
[[loads]]
patch = { centre = [0.0, 0.0015], length = 0.003, face = "-x" }
layer = "lower"
direction = [0.0, -1.0]
pattern = "open"
"""
PEELED = MATERIALS + BEAM + PEEL
QUADRATIC = PEELED.replace("dimension = 2", 'dimension = 2\ncell = "quad8"')
TRIANGLES = PEELED.replace("dimension = 2", 'dimension = 2\ncell = "tri6"')
NEARLY = PEELED.replace("poisson = 0.3", 'poisson = 0.4999\nformulation = "mean-dilatation"', 1)
GRADIENT = PEELED.replace('name = "glue"', 'name = "glue"\ngradient = 1e-4')
GRIFFITH = PEELED.replace('name = "glue"', 'name = "glue"\nkind = "griffith"').replace(
    "normal_onset = 20.0\ntangential_onset = 20.0\n", "")
# Mixed mode in space, of cells with mid-side nodes.
SOLID = MATERIALS + """
[geometry]
dimension = 3
length = 0.03
width = 0.01
divisions = [8, 2]
cell = "tet10"
[[layers]]
name = "lower"
thickness = 0.002
divisions = 1
material = "arm"
[[layers]]
name = "upper"
thickness = 0.001
divisions = 1
material = "arm"
[[interfaces]]
lower = "lower"
upper = "upper"
law = "glue"
notch = [{ from = 0.0, to = 0.01 }]
[[supports]]
box = { lower = [0.03, 0.0, 0.0], upper = [0.03, 0.01, 0.003] }
fix = ["x", "y", "z"]
[[loads]]
box = { lower = [0.0, 0.0, 0.003], upper = [0.0, 0.01, 0.003] }
component = ["z"]
pattern = "open"
""" + RISES.format("open", 1e-3)


def unmatched(partitions=0, triangles=False):
    """Two blocks of quadrilaterals, 12 below 17, as text of Gmsh. partitions: of each block, one behind the other, from
    the left below and from the right above, so that few cells have their own partition across the interface. triangles:
    the upper quadrilaterals are halved."""
    def tags(group, place):
        if partitions == 0:
            return f"2 {group} {group}"
        part = int(place * partitions)
        return f"4 {group} {group} 1 {1 + (part if group == 1 else partitions - 1 - part)}"

    nodes, cells, bodies = [], [], ((1, 0.0, 12, "lower"), (2, 0.003, 17, "upper"))
    for group, bottom, count, _ in bodies:
        first = len(nodes) + 1
        nodes += [(0.06 * i / count, bottom + 0.0015 * j) for j in range(3) for i in range(count + 1)]
        for j in range(2):
            for i in range(count):
                a = first + j * (count + 1) + i
                corners = (a, a + 1, a + count + 2, a + count + 1)
                halves = [corners[:3], (corners[0], *corners[2:])] if triangles and group == 2 else [corners]
                cells += [(tags(group, (i + 0.5) / count), *half) for half in halves]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(bodies))]
    lines += [f'2 {group} "{name}"' for group, _, _, name in bodies] + ["$EndPhysicalNames", "$Nodes", str(len(nodes))]
    lines += [f"{i} {x!r} {y!r} 0" for i, (x, y) in enumerate(nodes, start=1)] + ["$EndNodes", "$Elements",
                                                                                 str(len(cells))]
    lines += [f"{i} {len(c) - 2} {c[0]} {' '.join(map(str, c[1:]))}" for i, c in enumerate(cells, start=1)]
    return "\n".join([*lines, "$EndElements", ""])


PROJECTED = MATERIALS + """
[mesh]
file = "blocks.msh"
[[bodies]]
name = "*"
material = "arm"
[[interfaces]]
a = "lower"
b = "upper"
law = "glue"
projected = true
notch = [{ lower = [0.0, 0.003], upper = [0.02, 0.003] }]
""" + CLAMP + RISES.format("open", 8e-4) + """
[[loads]]
point = [0.0, 0.006]
component = ["y"]
pattern = "open"
[[loads]]
point = [0.0, 0.0]
direction = [0.0, -1.0]
pattern = "open"
"""
# Fewer cells than ranks.
TINY = PEELED.replace("divisions = 24", "divisions = 3").replace("divisions = 2", "divisions = 1")
# One of two equal poles would debond first, and rounding would choose it: the right one has less adhesion.
CELL = ("mesh.cells_around=16", "time.steps=10", "time.end=0.6",
        "interfaces[0].adhesion=[{ lower = [12e-6, 6e-6], upper = [19e-6, 14e-6], value = 0.8 }]")

# Left to the long tier, like others of the quick one.
NOT_BRIEF = ("thermal", "triangles", "incompressible", "gradient", "mixed-variational", "two-interfaces", "solid")
# What delam-mpi says on a number of ranks.
SAYS = {"partitioned": {1: "divided anew, because the mesh file has 2 partitions, and there are 1 ranks",
                        2: "each of the 2 ranks has a partition of the mesh file",
                        4: "divided anew, because the mesh file has 2 partitions, and there are 4 ranks"}}
ON_FOUR = ("ductile", "fibres", "dcb-3d", "plies-3d", "tiny")
# Parts that nothing holds move rigidly in them; what is written changes no solve. On one rank: on several the solves
# differ from run to run, by rounding.
UNTOUCHED = ("floats",)


def quick():
    """Name: scene file and settings."""
    return {
        "ductile": example("enf-ductile", "geometry.h=0.003", "time.steps=8", "time.end=1.6"),
        "ductile-1e9": example("enf-ductile", "geometry.h=0.003", "time.steps=6", "laws[0].normal_stiffness=1e9",
                               "laws[0].tangential_stiffness=1e9", "laws[0].tangential_onset=20.0"),
        "brittle-local": example("enf-brittle-local", "geometry.h=0.003", "time.steps=6", "time.end=1.2"),
        "brittle-energetic": example("enf-brittle-energetic", "geometry.h=0.003", "time.steps=6", "time.end=1.2"),
        "mixed-frozen": example("mmf-ductile", "geometry.h=0.0015", "time.steps=8", "time.end=1.2"),
        "mixed-converged": example("mmf-ductile-converged", "geometry.h=0.003", "time.steps=3", "time.end=0.6"),
        "mixed-variational": example("mmf-ductile", "geometry.h=0.003", "time.steps=6", "time.end=1.2",
                                     "solver.mixity_rule=variational"),
        "stiff-1e17": example("mmf-brittle-energetic", "geometry.h=0.003", "time.steps=2", "solver.solution=local",
                              "laws[0].normal_stiffness=1e17", "laws[0].tangential_stiffness=1e17"),
        "two-interfaces": example("dcb-double", "geometry.divisions=40", "time.steps=4", "time.end=0.2"),
        "prescribed-mean": example("mmb", "geometry.divisions=100", "time.steps=3", "time.end=0.6"),
        # Not at frozen mixity: its last step jumps, the toughness of a pair is then that of the mixity at which an
        # iteration of the step has met it, and the way of the iterations differs between runs by rounding.
        "thermal": example("laminate-thermal", "geometry.h=0.0005", "time.steps=5"),
        "fibre": example("fibre", *CELL),
        "fibres": example("fibres-30", "mesh.fibres=3", "mesh.cells_around=12", "time.steps=5",
                          "solver.reduction=auto"),
        "dcb-3d": example("dcb-3d", "geometry.divisions=[16, 2]", "time.steps=4"),
        # Several local solutions: by Newton's method each operator finds its own.
        "plies-3d": example("laminate-8", "geometry.divisions=[4, 3]", "time.steps=4", "solver.minimisation=alternate"),
        "cross-ply-3d": example("laminate-enf", "geometry.divisions=[20, 2]", "time.steps=3",
                                "loads[0].box.lower=[0.048, 0.0, 0.003]", "loads[0].box.upper=[0.049, 0.030, 0.003]"),
        "floats": own(FLOATS),
        "forces": own(FORCES, "time.steps=4"),
        "punch": own(PUNCH),
        "quadratic": own(QUADRATIC, "time.steps=4"),
        "triangles": own(TRIANGLES, "time.steps=4"),
        "incompressible": own(NEARLY),
        "gradient": own(GRADIENT, "time.steps=3"),
        "griffith": own(GRIFFITH),
        "solid": own(SOLID),
        "tiny": own(TINY),
        "projected": own(PROJECTED, blocks=unmatched()),
        "partitioned": own(PROJECTED, blocks=unmatched(2)),
        "mixed-cells": own(PROJECTED, "time.steps=2", "time.end=0.12", blocks=unmatched(triangles=True)),
    }


def whole():
    """Scenes of the size of their files, or nearly."""
    return {
        "whole-ductile": example("enf-ductile"),
        "whole-brittle-local": example("enf-brittle-local"),
        # The first steps, in which the interface begins to break: 40 of its length take 12,000 solves.
        "whole-mixed-converged": example("mmf-ductile-converged", "time.end=0.6", "time.steps=12"),
        "whole-two-interfaces": example("dcb-double", "geometry.divisions=120", "time.end=0.35", "time.steps=21"),
        "whole-dcb-3d": example("dcb-3d", "geometry.divisions=[40, 6]", "time.steps=28"),
        "whole-plies-3d": example("laminate-8", "geometry.divisions=[10, 6]", "time.steps=20"),
        "whole-fibres": example("fibres-30", "mesh.fibres=6", "mesh.cells_around=16", "time.steps=12",
                                "solver.reduction=auto"),
        "whole-thermal": example("laminate-thermal", "geometry.h=0.00025"),
    }
