# SPDX-License-Identifier: BSD-3-Clause
"""Homogenised moduli of a hexagonal array of fibres, with glued, elastic and no interfaces, within bounds and against closed forms.

Bounds on the transverse moduli: Z. Hashin, J. Mech. Phys. Solids 13 (1965) 119-134. A fibre with springs k around it is in plane dilatation one
of the modulus K with 1/K = 1/K_f + 2/(k r), as the springs add the displacement p/k to p r/(2 K_f); with it the composite cylinders' modulus is exact for
these, and close for a hexagonal array."""
import csv
import os

from support import delam, expect, finish, folder, write

RADIUS, FRACTION = 5e-6, 0.4
MATRIX, FIBRE = (3.35e9, 0.35), (74e9, 0.2)

SCENE = """
schema = 1
[mesh]
generator = "fibre-cell"
arrangement = "hexagonal"
fraction = {fraction}
radius = {radius}
cells_around = 32
cell = "quad8"
[[materials]]
name = "epoxy"
young = {matrix[0]}
poisson = {matrix[1]}
[[materials]]
name = "glass"
young = {fibre[0]}
poisson = {fibre[1]}
[[bodies]]
name = "matrix"
material = "epoxy"
[[bodies]]
name = "fibre-*"
material = "glass"
[[laws]]
name = "springs"
normal_stiffness = {stiffness}
tangential_stiffness = {stiffness}
normal_onset = 1e6
tangential_onset = 1e6
normal_toughness = 2e6
tangential_toughness = 2e6
[[interfaces]]
all = true
{interface}
[[patterns]]
name = "p"
times = [0, 1]
values = [0, {strain}]
[time]
end = 1.0
steps = 1
[cell]
strain = [{components}]
[output]
columns = ["cell_stress_xx", "cell_stress_yy", "cell_stress_xy"]
"""


def moduli(young, poisson):
    """Bulk modulus in plane strain, shear modulus."""
    shear = young / (2 * (1 + poisson))
    return shear / (1 - 2 * poisson), shear


def stress(interface, parts, strain=1e-4, stiffness=1e15):
    """parts: of the strain, xx, yy and xy doubled."""
    given = ", ".join(f'{{ component = "{c}", pattern = "p", coefficient = {part} }}' if part else f'{{ component = "{c}" }}'
                      for c, part in zip(("xx", "yy", "xy"), parts))
    text = SCENE.format(fraction=FRACTION, radius=RADIUS, matrix=MATRIX, fibre=FIBRE, interface=interface, strain=strain,
                        components=given, stiffness=stiffness)
    out = os.path.join(folder(), "out")
    code, _, error = delam("run", write(text), "--out", out)
    if code != 0:
        print(error)
        return [0.0] * 3
    with open(os.path.join(out, "history.csv"), newline="", encoding="utf-8") as file:
        row = list(csv.DictReader(file))[-1]
    return [float(row[f"cell_stress_{c}"]) for c in ("xx", "yy", "xy")]


def dilated(interface, sign=1, **more):
    """Bulk modulus; a hexagonal array has the same stress both ways, and no shear."""
    xx, yy, xy = stress(interface, (1, 1, 0), sign * 1e-4, **more)
    expect(abs(xx - yy) < 2e-3 * abs(xx) and abs(xy) < 1e-6 * abs(xx), f"{interface}: isotropic in plane dilatation, {xx}, {yy}, {xy}")
    return (xx + yy) / (4 * sign * 1e-4)


def sheared(interface, **more):
    """Shear modulus along both axes of shear: the plane is isotropic. A dilatation on top keeps elastic interfaces open."""
    _, _, xy = stress(interface, (1, 1, 1), **more)
    xx, yy, _ = stress(interface, (1.5, 0.5, 0), **more)
    expect(abs((xx - yy) / 2 - xy) < 1e-3 * xy, f"{interface}: isotropic in shear, {(xx - yy) / 2e-4}, {xy / 1e-4}")
    return xy / 1e-4


k_m, g_m = moduli(*MATRIX)
k_f, g_f = moduli(*FIBRE)
f, m = FRACTION, 1 - FRACTION


def cylinders(inclusion):
    return k_m + f / (1 / (inclusion - k_m) + m / (k_m + g_m))


bulk = dilated("bonded = true")
lower, upper = cylinders(k_f), k_f + m / (1 / (k_m - k_f) + f / (k_f + g_f))
expect(lower < bulk < upper and bulk < 1.02 * lower, f"glued: bulk modulus {bulk:.6g} in [{lower:.6g}, {upper:.6g}], next to the lower bound")
shear = sheared("bonded = true")
lower = g_m + f / (1 / (g_f - g_m) + m * (k_m + 2 * g_m) / (2 * g_m * (k_m + g_m)))
upper = g_f + m / (1 / (g_m - g_f) + f * (k_f + 2 * g_f) / (2 * g_f * (k_f + g_f)))
expect(lower < shear < upper and shear < 1.1 * lower, f"glued: shear modulus {shear:.6g} in [{lower:.6g}, {upper:.6g}]")

# Springs, from hardly any to those that soften the fibre below the matrix.
before = bulk
for stiffness in (1e18, 1e16, 1e15, 3e14):
    soft = dilated('law = "springs"', stiffness=stiffness)
    inclusion = 1 / (1 / k_f + 2 / (stiffness * RADIUS))
    exact = cylinders(inclusion)
    expect(abs(soft - exact) < 0.02 * exact and soft < before, f"springs {stiffness:g}: bulk modulus {soft:.6g}, composite cylinders {exact:.6g}")
    before = soft
softer = sheared('law = "springs"', stiffness=1e15)
expect(softer < shear, f"springs: shear modulus {softer:.6g} below that of the glued array, {shear:.6g}")

# No interface: holes under tension, glued under pressure as nothing slides then.
holes, closed = dilated("contact = true"), dilated("contact = true", -1)
exact = cylinders(0.0)
expect(abs(holes - exact) < 0.02 * exact and holes < exact * (1 + 1e-3), f"no interface, tension: bulk modulus {holes:.6g}, composite cylinders {exact:.6g}")
expect(abs(closed - bulk) < 1e-3 * bulk, f"no interface, pressure: bulk modulus {closed:.6g}, glued {bulk:.6g}")
finish()
