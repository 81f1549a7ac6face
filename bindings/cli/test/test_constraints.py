# SPDX-License-Identifier: BSD-3-Clause
"""Equations, couplings, obstacles and periodic cells of scene files: against the same scenes written otherwise, and closed forms."""
import csv
import json
import os

from support import delam, expect, expect_error, finish, folder, write

BLOCK = """
schema = 1
[geometry]
dimension = {dimension}
length = 2.0
{width}
divisions = {divisions}
[[materials]]
name = "m"
young = 8.0
poisson = 0.3
[[materials]]
name = "soft"
young = 2.0
poisson = 0.2
[[layers]]
name = "lower"
thickness = 0.5
divisions = 2
material = "m"
[[layers]]
name = "upper"
thickness = 0.5
divisions = 2
material = "{upper}"
[[interfaces]]
lower = "lower"
upper = "upper"
bonded = true
[[patterns]]
name = "p"
times = [0, 1]
values = [0, 1]
[time]
end = 1.0
steps = 1
"""


def block(dimension, text="", upper="m"):
    size = {2: {"width": "", "divisions": 8}, 3: {"width": "width = 1.5", "divisions": "[4, 3]"}}[dimension]
    return BLOCK.format(dimension=dimension, upper=upper, **size) + text


def last_row(text, *settings):
    out = os.path.join(folder(), "out")
    code, _, error = delam("run", write(text), "--out", out, *settings)
    if code != 0:
        print(error)
        return None
    with open(os.path.join(out, "history.csv"), newline="", encoding="utf-8") as file:
        row = list(csv.DictReader(file))[-1]
    with open(os.path.join(out, "result.json"), encoding="utf-8") as file:
        row["cell"] = json.load(file)["cell"]
    return {key: float(value) if isinstance(value, str) and key not in ("solution", "mixity_rule") else value
            for key, value in row.items()}


def near(row, key, wanted, what, tolerance=1e-9, size=None):
    scale = abs(wanted) if size is None else size
    expect(row is not None and abs(row[key] - wanted) <= tolerance * scale,
           f"{what}: {key} {row and row[key]}, {wanted} is expected")


def axes(dimension):
    return "[" + ", ".join(f'"{a}"' for a in "xyz"[:dimension]) + "]"


def at(dimension, x, z):
    return f"[{x}, {z}]" if dimension == 2 else f"[{x}, 0.5, {z}]"


# A cantilever and a rigid lever on two of its points: (1 + r) u_a - r u_b = -U moves as the forces that the lever passes on do.
for dimension in (2, 3):
    held = f'[[supports]]\nbox = {{ lower = {at(dimension, 0.0, 0.0).replace("0.5", "0.0")}, ' \
           f'upper = {at(dimension, 0.0, 1.0).replace("0.5", "1.5")} }}\nfix = {axes(dimension)}\n'
    up = "xyz"[dimension - 1]
    a, b = at(dimension, 1.0, 1.0), at(dimension, 2.0, 1.0)
    lever = block(dimension, held + f'''
[[equations]]
left = [{{ point = {a}, component = ["{up}"], coefficient = 1.4 }}, {{ point = {b}, component = ["{up}"], coefficient = -0.4 }}]
pattern = "p"
coefficient = -0.01
''')
    row = last_row(lever)
    force = row["reaction"] / -0.01 if row else 0.0
    down = [0.0] * (dimension - 1)
    forces = block(dimension, held + f'''
[[forces]]
point = {a}
force = {down + [1.4 * force]}
pattern = "p"
[[forces]]
point = {b}
force = {down + [-0.4 * force]}
pattern = "p"
''')
    expect(force < 0, f"{dimension}D: the lever is pressed down")
    near(last_row(forces), "stored_bulk", row["stored_bulk"] if row else 0.0, f"{dimension}D: a lever's equation is its forces")

    # The mean over a patch, by a load and by an equation.
    size = "0.5" if dimension == 2 else "[0.5, 1.0]"
    patch = f'patch = {{ centre = {at(dimension, 1.6, 1.0)}, length = {size}, face = "+{up}" }}'
    load = block(dimension, held + f'[[loads]]\n{patch}\ncomponent = ["{up}"]\npattern = "p"\ncoefficient = -0.01\n')
    mean = block(dimension, held + f'[[equations]]\nleft = [{{ {patch}, component = ["{up}"] }}]\npattern = "p"\ncoefficient = -0.01\n')
    whole = last_row(load)
    near(last_row(mean), "reaction", whole["reaction"] if whole else 0.0, f"{dimension}D: the mean of a patch")

    # A rigid nose: nodes that move with a control node.
    box = f'box = {{ lower = {at(dimension, 1.5, 1.0).replace("0.5,", "0.0,")}, upper = {at(dimension, 2.0, 1.0).replace("0.5,", "1.5,")} }}'
    direct = block(dimension, held + f'[[loads]]\n{box}\ncomponent = ["{up}"]\npattern = "p"\ncoefficient = -0.01\n')
    nose = block(dimension, held + f'''
[[controls]]
name = "nose"
[[couplings]]
{box}
component = ["{up}"]
control = "nose"
[[loads]]
control = "nose"
component = ["{up}"]
pattern = "p"
coefficient = -0.01
[[supports]]
control = "nose"
fix = {axes(dimension).replace(f', "{up}"', "")}
''')
    whole = last_row(direct)
    near(last_row(nose), "reaction", whole["reaction"] if whole else 0.0, f"{dimension}D: a rigid nose")
    if dimension == 3:  # cells with mid-side nodes as well
        quadratic = ("--set", "geometry.cell=hex20")
        whole = last_row(direct, *quadratic)
        near(last_row(nose, *quadratic), "reaction", whole["reaction"] if whole else 0.0, "a rigid nose, hex20")

    # A rigid grip that rotates. A moment bends a bar without lateral contraction as beam theory says.
    grip = block(dimension, held + f'''
[[controls]]
name = "grip"
at = {at(dimension, 2.0, 0.5)}
[[controls]]
name = "turn"
[[couplings]]
box = {{ lower = {at(dimension, 2.0, 0.0).replace("0.5", "0.0")}, upper = {at(dimension, 2.0, 1.0).replace("0.5", "1.5")} }}
component = {axes(dimension)}
control = "grip"
rotation = "turn"
ACTION
[[supports]]
control = "turn"
fix = {'["y"]' if dimension == 2 else '["x", "z"]'}
''').replace("poisson = 0.3", "poisson = 0.0\nformulation = \"incompatible\"")
    turn = 'component = ["x"]' if dimension == 2 else 'component = ["y"]'
    stiffness = 8.0 * (1.0 if dimension == 2 else 1.5) / 12 / 2.0
    row = last_row(grip.replace("ACTION", f'[[loads]]\ncontrol = "turn"\n{turn}\npattern = "p"\ncoefficient = 0.01'))
    near(row, "reaction", stiffness * 0.01 ** 2, f"{dimension}D: a grip is turned")
    moment = "[0.02, 0.0]" if dimension == 2 else "[0.0, 0.02, 0.0]"
    row = last_row(grip.replace("ACTION", f'[[forces]]\ncontrol = "turn"\nforce = {moment}\npattern = "p"'))
    near(row, "stored_bulk", 0.02 ** 2 / stiffness / 2, f"{dimension}D: a moment on a grip")
    # Both ends in one grip that is not at their centre: the block turns as a whole.
    whole = grip.replace(held, "").replace("at = " + at(dimension, 2.0, 0.5), "at = " + at(dimension, 0.25, 3.0))
    ends = whole.split("[[couplings]]")[1].split("ACTION")[0]
    whole = whole.replace("ACTION", "[[couplings]]" + ends.replace("2.0,", "0.0,") + f'''
[[supports]]
control = "grip"
fix = {axes(dimension)}
[[loads]]
control = "turn"
{turn}
pattern = "p"
''')
    row = last_row(whole)
    near(row, "stored_bulk", 0.0, f"{dimension}D: a grip on both ends turns the block", 1e-12, 1.0)
    expect_error(delam("check", write(grip.replace("ACTION", "").replace("at = " + at(dimension, 2.0, 0.5), ""))), 2,
                 "rotation", "is about the control node", "grip")

    # A rigid plane under the block, moved by its control node: it presses but does not pull.
    bottom = f'patch = {{ centre = {at(dimension, 1.0, 0.0).replace("0.5", "0.75")}, ' \
             f'length = {"2.0" if dimension == 2 else "[2.0, 1.5]"}, face = "-{up}" }}'
    top = f'box = {{ lower = {at(dimension, 0.0, 1.0).replace("0.5", "0.0")}, upper = {at(dimension, 2.0, 1.0).replace("0.5", "1.5")} }}'
    plane = block(dimension, f'''
[[controls]]
name = "plate"
[[obstacles]]
{bottom}
control = "plate"
[[supports]]
{top}
fix = {axes(dimension)}
[[supports]]
control = "plate"
fix = {axes(dimension).replace(f', "{up}"', "")}
[[loads]]
control = "plate"
component = ["{up}"]
pattern = "p"
coefficient = 0.01
''').replace("poisson = 0.3", "poisson = 0.0")
    # Without lateral contraction the force is E A d / h, with d = 0.01 the energy half of its work.
    area = 2.0 if dimension == 2 else 3.0
    near(last_row(plane), "reaction", 8.0 * area * 0.01 ** 2, f"{dimension}D: an obstacle presses")
    row = last_row(plane.replace("coefficient = 0.01", "coefficient = -0.01"))
    near(row, "reaction", 0.0, f"{dimension}D: and does not pull", 1e-12, 1.0)

# Periodic cells. Two glued layers across the last axis in closed form (Backus, J. Geophys. Res. 67, 1962).
def backus(dimension):
    """Moduli of the layered medium by components; the last axis is n, the others are t."""
    part, mean = ((8.0, 0.3), (2.0, 0.2)), 0.5
    values = {"1/M": 0.0, "lambda/M": 0.0, "inplane": 0.0, "off": 0.0, "1/mu": 0.0, "mu": 0.0}
    for young, poisson in part:
        lam, mu = young * poisson / ((1 + poisson) * (1 - 2 * poisson)), young / (2 * (1 + poisson))
        m = lam + 2 * mu
        for key, value in (("1/M", 1 / m), ("lambda/M", lam / m), ("inplane", m - lam ** 2 / m),
                           ("off", lam - lam ** 2 / m), ("1/mu", 1 / mu), ("mu", mu)):
            values[key] += mean * value
    c, names = {}, ("xx", "yy", "zz")[:dimension]
    normal = names[-1]
    for i in names:
        for j in names:
            across = 1 / values["1/M"]
            if i == normal and j == normal:
                c[i, j] = across
            elif normal in (i, j):
                c[i, j] = values["lambda/M"] * across
            else:
                c[i, j] = values["inplane" if i == j else "off"] + values["lambda/M"] ** 2 * across
    for name in ("xy",) if dimension == 2 else ("xy", "yz", "zx"):
        c[name, name] = 1 / values["1/mu"] if normal[0] in name else values["mu"]
    return c


for dimension in (2, 3):
    moduli = backus(dimension)
    names = ("xx", "yy", "xy") if dimension == 2 else ("xx", "yy", "zz", "xy", "yz", "zx")
    volume = 2.0 if dimension == 2 else 3.0
    # A skew set of periods of the same lattice is the same medium.
    lattices = {2: ("[[2.0, 0.0], [0.0, 1.0]]",), 3: ("[[2.0, 0.0, 0.0], [0.0, 1.5, 0.0], [0.0, 0.0, 1.0]]",
                                                         "[[0.0, 0.0, 1.0], [2.0, 0.0, 0.0], [0.0, 1.5, 0.0]]")}[dimension]
    columns = ", ".join(f'"cell_strain_{n}", "cell_stress_{n}"' for n in names)
    for periods in lattices:
        for component in names:
            cell = f'[cell]\nperiods = {periods}\nstrain = [' + ", ".join(
                f'{{ component = "{n}"' + (', pattern = "p", coefficient = 0.01 }' if n == component else " }") for n in names) + "]\n"
            row = last_row(block(dimension, cell + f"[output]\ncolumns = [{columns}]\n", "soft"))
            for n in names:
                near(row, f"cell_stress_{n}", 0.01 * moduli.get((n, component), 0.0), f"{dimension}D strain {component}", 1e-9, 0.1)
                near(row, f"cell_strain_{n}", 0.01 if n == component else 0.0, f"{dimension}D strain {component}", 1e-12, 0.01)
            near(row, "reaction", volume * 1e-4 * moduli[component, component], f"{dimension}D: reaction is volume times stress")
            expect(row is not None and abs(row["cell"]["volume"] - volume) < 1e-12, "volume of the cell")
    # All moduli at once: a pattern for each component, which need not do anything.
    more = "".join(f'[[patterns]]\nname = "p{n}"\ntimes = [0]\nvalues = [0]\n' for n in names[1:])
    cell = f'[cell]\nperiods = {lattices[0]}\nstrain = [' + ", ".join(f'{{ component = "{n}", pattern = "p{n}" }}' for n in names) + "]\n"
    row = last_row(block(dimension, more + cell, "soft").replace('name = "p"', 'name = "pxx"').replace("values = [0, 1]", "values = [0, 0.01]"))
    tangent = row["cell"]["tangent"] if row else []
    order = row["cell"]["tangent_patterns"] if row else []
    worst = max((abs(tangent[order.index("p" + i)][order.index("p" + j)] - moduli.get((i, j), 0.0)) for i in names for j in names), default=1.0)
    expect(worst < 1e-9 * 10, f"{dimension}D: the homogenised tangent is that of the layers, to {worst:.1e}")
    # A prescribed shear stress; what is not given is free of stress.
    shear = names[-1]
    cell = f'[cell]\nperiods = {lattices[0]}\nstress = [{{ component = "{shear}", pattern = "p", coefficient = 0.02 }}]\n'
    row = last_row(block(dimension, cell + f"[output]\ncolumns = [{columns}]\n", "soft"))
    near(row, f"cell_strain_{shear}", 0.02 / moduli[shear, shear], f"{dimension}D: shear under stress")
    near(row, "load_potential", -volume * 0.02 * 0.02 / moduli[shear, shear], f"{dimension}D: potential of the stress")
    for n in names:
        near(row, f"cell_stress_{n}", 0.02 if n == shear else 0.0, f"{dimension}D: stress as prescribed", 1e-9, 0.02)

# A plate that repeats in its plane alone: uniaxial stress, so E of one material; the thickness counts into the volume.
plate = block(3, '''
[cell]
periods = [[2.0, 0.0, 0.0], [0.0, 1.5, 0.0]]
strain = [{ component = "xx", pattern = "p", coefficient = 0.01 }]
[output]
columns = ["cell_stress_xx", "cell_strain_yy", "cell_strain_xy"]
''')
row = last_row(plate)
near(row, "cell_stress_xx", 0.08, "plate")
near(row, "cell_strain_yy", -0.003, "plate")
near(row, "reaction", 3.0 * 0.08 * 0.01, "plate")

# What is refused.
cell = block(2, '[cell]\nperiods = [[2.0, 0.0], [0.0, 1.0]]\nstrain = [{ component = "xx", pattern = "p" }]\n')
for old, new, *patterns in (
        ('"xx"', '"zz"', r"component: \"zz\": xx, yy or xy is expected"),
        ("[0.0, 1.0]]", "[4.0, 0.0]]", r"periods: 2 vectors have components along 1 axes"),
        ("[0.0, 1.0]]", "[2.0, 1e-12]]", r"cell: periods: they lie in a line"),
        ("periods = [[2.0, 0.0], [0.0, 1.0]]\n", "", r"periods: is needed"),
        ('"p" }]', '"p" }]\nstress = [{ component = "xx", pattern = "p" }]', r'"xx" is given twice'),
        ('strain = [{ component = "xx", pattern = "p" }]', 'stress = [{ component = "xx" }]', r"pattern: is needed: a stress"),
        ("[2.0, 0.0]", "[1.0, 0.0]", r"the mesh is 2 periods long in direction 0"),
        ('pattern = "p" }', 'pattern = "q" }', r'"q": no such pattern')):
    expect_error(delam("check", write(cell.replace(old, new, 1))), 2, *patterns)
strip = cell.replace(", [0.0, 1.0]]", "]").replace('"xx"', '"yy"')
expect_error(delam("check", write(strip)), 2, r"no period along y")
lever = block(2, '[[supports]]\nbox = { lower = [0, 0], upper = [0, 1] }\nfix = ["x", "y"]\n[[equations]]\n'
                 'left = [{ point = [1.0, 1.0], component = ["y"] }]\npattern = "p"\n')
for old, new, *patterns in (
        ('component = ["y"]', 'component = ["x", "y"]', r"component: has 2 entries: 1 is expected"),
        ('[{ point = [1.0, 1.0], component = ["y"] }]', "[]", r"left: is empty"),
        ("point = [1.0, 1.0]", "point = [1.01, 1.0]", r"no node within"),
        ("point = [1.0, 1.0]", "box = { lower = [0, 0], upper = [1, 1] }", r"box: unknown key"),
        ("point = [1.0, 1.0], ", "", r"give one of point, patch, control \(0 are given\)"),
        ("point = [1.0, 1.0]", 'control = "nose"', r'"nose": no such control node; none is defined')):
    expect_error(delam("check", write(lever.replace(old, new, 1))), 2, *patterns)
twice = lever + '[[equations]]\nleft = [{ point = [1.0, 1.0], component = ["y"] }]\npattern = "p"\n'
expect_error(delam("check", write(twice)), 2, r"equations\[1\], line \d+, constraint 13 .* follows from other constraints")
expect_error(delam("check", write(lever + '[[equations]]\nleft = [{ point = [0.0, 0.0], component = ["y"] }]\npattern = "p"\n')),
             2, r"equations\[1\], line \d+, constraint .* contradicts other constraints")
expect_error(delam("check", write(cell + '[[supports]]\nbox = { lower = [0, 0], upper = [0, 1] }\nfix = ["x"]\n')),
             2, r"cell holds its lower corner by itself \(leave out supports there\)")
flat = cell.replace("dimension = 2", 'dimension = 2\nplane = "plane-stress"') + '[output]\ncolumns = ["cell_strain_zz"]\n'
expect_error(delam("run", write(flat), "--out", os.path.join(folder(), "out")), 2, r'"cell_strain_zz": no such value')
loose = block(2, '[[supports]]\nbox = { lower = [0, 0], upper = [0, 1] }\nfix = ["x", "y"]\n[[controls]]\nname = "nose"\n[[loads]]\n'
                 'point = [1.0, 1.0]\ncomponent = ["y"]\npattern = "p"\n[[obstacles]]\n'
                 'patch = { centre = [1.5, 1.0], length = 1.0, face = "+y" }\ncontrol = "nose"\n[[supports]]\ncontrol = "nose"\nfix = ["x"]\n')
free = loose[:loose.index("[[obstacles]]")].replace('point = [1.0, 1.0]\ncomponent', 'control = "nose"\ncomponent')
expect_error(delam("check", write(free + '[[patterns]]\nname = "f"\ntimes = [0, 1]\nvalues = [0, 1]\n[[forces]]\ncontrol = "nose"\nforce = [1, 0]\npattern = "f"\n')),
             2, r'missing support: control node "nose" can translate along x')
expect_error(delam("check", write(loose.replace('control = "nose"\nfix', 'control = "nose"\nlayer = "lower"\nfix'))), 2, r"layer: is not for a control node")
unheld = block(2, '[[supports]]\nbox = { lower = [0, 0], upper = [0, 1] }\nfix = ["x", "y"]\n[[controls]]\nname = "nose"\n'
                  '[[couplings]]\nbox = { lower = [2, 0], upper = [2, 1] }\ncomponent = ["y"]\ncontrol = "nse"\n')
expect_error(delam("check", write(unheld)), 2, r"no such control node \(did you mean 'nose'\?\)")
expect_error(delam("check", write(unheld.replace('box = { lower = [2, 0], upper = [2, 1] }', 'patch = { centre = [2, 0.5], length = 1, face = "+x" }'))),
             2, r"patch: unknown key")
finish()
