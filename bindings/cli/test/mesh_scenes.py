# SPDX-License-Identifier: BSD-3-Clause
"""What tests of meshes share: a scene around a mesh file, its run, and the force of a bar that is stretched."""
import csv
import os

from support import delam, expect

YOUNG, STRETCH = 8.0, 1e-3
HEAD = """
schema = 1
[[materials]]
name = "m"
young = 8.0
poisson = 0.0
[[bodies]]
name = "*"
material = "m"
[[laws]]
name = "law"
normal_stiffness = 100.0
tangential_stiffness = 100.0
normal_onset = 1.0
tangential_onset = 1.0
normal_toughness = 2.0
tangential_toughness = 2.0
[time]
end = 1.0
steps = 1
[[patterns]]
name = "p"
times = [0, 1]
values = [0, 1]
"""
BONDED = '[[interfaces]]\nall = true\nbonded = true\n'


def pulled(axis, stretch=STRETCH):
    """The top is moved away from the bottom, which is held."""
    axes = '"x", "y"' if axis == "y" else '"x", "y", "z"'
    return (f'[[supports]]\nset = "bottom"\nfix = [{axes}]\n'
            f'[[loads]]\nset = "top"\ncomponent = ["{axis}"]\npattern = "p"\ncoefficient = {stretch}\n')


def scene(place, mesh, text, keys=""):
    path = os.path.join(place, "scene.toml")
    with open(path, "w", encoding="utf-8") as file:
        file.write(HEAD + f'[mesh]\nfile = "{mesh}"\n{keys}' + text)
    return path


def last_row(place, path):
    """The last row of a run, as numbers; None where it failed."""
    out = os.path.join(place, "out")
    code, _, error = delam("run", path, "--out", out)
    if code != 0:
        print(error)
        return None
    with open(os.path.join(out, "history.csv"), newline="", encoding="utf-8") as file:
        row = list(csv.DictReader(file))[-1]
    return {key: float(value) for key, value in row.items() if key not in ("solution", "mixity_rule")}


def near(value, wanted, tolerance=1e-9):
    return abs(value - wanted) <= tolerance * abs(wanted)


def stretched(place, mesh, axis, area, height, what, text=BONDED, keys=""):
    """Without lateral strain the force is E A d / h, whatever the cells: any node out of place would show."""
    row = last_row(place, scene(place, mesh, text + pulled(axis), keys))
    force = YOUNG * area * STRETCH / height
    # The reaction is conjugate to the factor: force times coefficient.
    expect(row is not None and near(row["reaction"], force * STRETCH) and
           near(row["stored_bulk"], force * STRETCH / 2),
           f"{what}: {row and row['reaction']}, {force * STRETCH} is expected")
