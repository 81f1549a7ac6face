# SPDX-License-Identifier: BSD-3-Clause
"""Scenes on generated cells: fibres come off, a weave is stretched along and across its yarns, and what is refused."""
import csv
import os
import subprocess

from support import DELAM, changed, delam, expect, expect_error, finish, folder, write

FIBRES = """
schema = 1
[mesh]
generator = "fibre-cell"
fibres = 5
fraction = 0.4
radius = 5e-6
seed = 3
cells_around = 12
[[materials]]
name = "resin"
young = 3e9
poisson = 0.35
[[materials]]
name = "glass"
young = 70e9
poisson = 0.2
[[bodies]]
name = "matrix"
material = "resin"
[[bodies]]
name = "fibre-*"
material = "glass"
[[laws]]
name = "sizing"
normal_stiffness = 1e15
tangential_stiffness = 1e15
normal_onset = 1.0
tangential_onset = 2.0
normal_toughness = 2.0
tangential_toughness = 4.0
[[interfaces]]
all = true
law = "sizing"
[[supports]]
set = "left"
fix = ["x"]
[[supports]]
set = "origin"
fix = ["y"]
[[patterns]]
name = "pull"
times = [0, 1]
values = [0, 1]
[[loads]]
set = "right"
component = ["x"]
pattern = "pull"
coefficient = 5e-7
[time]
end = 1.0
steps = 4
"""

WEAVE = """
schema = 1
[mesh]
generator = "weave"
spacing = 2e-3
width = 1.6e-3
thickness = 0.4e-3
h = 0.6e-3
[[materials]]
name = "resin"
young = 3e9
poisson = 0.35
[[materials]]
name = "yarn"
E1 = 140e9
E2 = 9e9
nu12 = 0.3
nu23 = 0.4
G12 = 5e9
[[bodies]]
name = "matrix"
material = "resin"
[[bodies]]
name = "w*"
material = "yarn"
[[interfaces]]
all = true
bonded = true
[[supports]]
set = "left"
fix = ["x"]
[[supports]]
set = "front"
fix = ["y"]
[[supports]]
set = "origin"
fix = ["z"]
[[patterns]]
name = "pull"
times = [0, 1]
values = [0, 1]
[[loads]]
set = "right"
component = ["x"]
pattern = "pull"
coefficient = 4e-6
[time]
end = 1.0
steps = 1
"""


def last_row(text):
    out = os.path.join(folder(), "out")
    code, _, error = delam("run", write(text), "--out", out)
    if code != 0:
        print(error)
        return None
    with open(os.path.join(out, "history.csv"), encoding="utf-8") as file:
        return {k: float(v) for k, v in list(csv.DictReader(file))[-1].items() if k not in ("solution", "mixity_rule")}


def fibres():
    code, out, _ = delam("check", write(FIBRES))
    expect(code == 0 and "5 fibres" in out, "check takes the cell and says what is in it")
    row = last_row(FIBRES)
    expect(row is not None and row["dissipated"] > 0 and row["debonded_length"] > 0, "fibres come off")
    bonded = last_row(changed('law = "sizing"', "bonded = true", FIBRES))
    expect(row is not None and bonded is not None and 0 < row["reaction"] < bonded["reaction"],
           "and the cell bears less than one whose fibres stay")


def weave():
    code, out, _ = delam("check", write(WEAVE))
    expect(code == 0 and "weave" in out, "check takes the weave and says what is in it")
    # Linear cells see the directions of the yarns as well, in less time.
    linear = changed("h = 0.6e-3", 'h = 0.6e-3\ncell = "tet4"', WEAVE)
    along = last_row(linear)
    # The weave is the same along both directions: so is its stiffness, but for the mesh.
    turned = changed('set = "right"\ncomponent = ["x"]', 'set = "back"\ncomponent = ["y"]', linear)
    across = last_row(turned)
    # Were the yarns' axes those of space, weft yarns would not be stiff along y.
    expect(along is not None and across is not None and abs(along["reaction"] / across["reaction"] - 1) < 0.02,
           "as stiff along the weft as along the warp")


def refused():
    def check(scene, old, new, *patterns):
        expect_error(delam("check", write(changed(old, new, scene))), 2, *patterns)

    check(FIBRES, '"fibre-cell"', '"braid"', r"mesh\.generator", "fibre-cell", "weave")
    check(FIBRES, "fraction = 0.4", "fraction = 0.9", r"scene\.toml:3: mesh: fraction = 0\.9: must be in \(0, ")
    check(FIBRES, "seed = 3", "sead = 3", r"mesh\.sead", "seed")
    check(FIBRES, "seed = 3", "h = 1e-6", r"mesh\.h: give either h or cells_around")
    check(FIBRES, "fibres = 5", 'fibres = 5\narrangement = "square"', r"mesh\.fibres: is for the random arrangement")
    check(FIBRES, "radius = 5e-6", "", r"mesh\.radius")
    check(FIBRES, "fibre-*", "yarn-*", "no body of the mesh")
    check(FIBRES, 'set = "left"', 'set = "west"', "no such set", "left")
    check(WEAVE, "width = 1.6e-3", "width = 2.6e-3", r"mesh\.width: must be in \(0, 0\.0019\]")
    check(WEAVE, "h = 0.6e-3", "h = 6e-3", r"mesh\.h: must be in")
    check(WEAVE, "h = 0.6e-3", "h = 1e-3\ngap = 0.01e-3", r"mesh\.h: generator weave with h = 0\.001, gap = 1e-05",
          "gap helps")
    check(WEAVE, "h = 0.6e-3", 'h = 0.6e-3\ncell = "hex8"', r"mesh\.cell")
    check(WEAVE, "h = 0.6e-3", 'h = 0.6e-3\nplane = "plane-stress"', r"mesh\.plane")


# Gmsh brings a hundred libraries, which take longer to load than a small analysis takes.
def loaded_when_asked():
    libraries = subprocess.run(["ldd", DELAM], capture_output=True, text=True, check=True).stdout
    expect("libdelam" in libraries, "ldd lists the library")
    expect("gmsh" not in libraries, "the program alone does not load Gmsh")


loaded_when_asked()
fibres()
weave()
refused()
finish()
