# SPDX-License-Identifier: BSD-3-Clause
"""Two stiffnesses in shear in a scene: the axes of the interface, given or those of the material of the lower layer, and
what is refused."""
import csv
import os

from strip import strip
from support import delam, expect, expect_error, finish, folder, write

LAW = """normal_stiffness = 1e13
tangential_stiffness = 1e13
second_tangential_stiffness = 2e12
normal_onset = 20.0
tangential_onset = 40.0
normal_toughness = 200.0
tangential_toughness = 500.0
"""
PLANE = strip(LAW, """[[patterns]]
name = "pull"
times = [0, 1]
values = [0, 1.0]
[[loads]]
point = [0.0, 0.002]
component = ["x"]
pattern = "pull"
coefficient = -6e-5
""", "[time]\nend = 1.0\nsteps = 8\n[solver]\nstep_control = \"fixed\"\ndamage_tolerance = 1e-11\n")
SPACE = PLANE.replace("dimension = 2", "dimension = 3\nwidth = 0.004").replace("divisions = 60", "divisions = [20, 2]")
SPACE = SPACE.replace("divisions = 2\nmaterial", "divisions = 1\nmaterial").replace(
    "upper = [0.03, 0.0] }\nfix = [\"x\", \"y\"]", "upper = [0.03, 0.004, 0.0] }\nfix = [\"x\", \"y\", \"z\"]").replace(
    "lower = [0.0, 0.0],", "lower = [0.0, 0.0, 0.0],").replace(
    "point = [0.0, 0.002]", "box = { lower = [0.0, 0.0, 0.002], upper = [0.0, 0.004, 0.002] }")
AXIS = 'law = "glue"\nshear_axis = '


def history(text):
    out = os.path.join(folder(), "out")
    code, _, error = delam("run", write(text), "--out", out)
    expect(code == 0, f"it runs: {error}")
    with open(os.path.join(out, "history.csv"), encoding="utf-8", newline="") as file:
        return [(float(row["reaction"]), float(row["dissipated"])) for row in csv.DictReader(file)]


def along(axis):
    return SPACE.replace('law = "glue"', AXIS + axis)


def apart(a, b):
    return max(abs(p[0] - q[0]) for p, q in zip(a, b)) / max(abs(p[0]) for p in a)


first, second = history(along("[1, 0, 0]")), history(along("[0, 3, 5]"))
expect(first[-1][1] > 0, "something is damaged")
expect(apart(first, second) > 0.01, "the axis decides which stiffness resists the load")
expect(history(SPACE) == first, "without axes the first tangent lies along x")
exchanged = SPACE.replace("tangential_stiffness = 1e13", "tangential_stiffness = 2e12", 1).replace(
    "second_tangential_stiffness = 2e12", "second_tangential_stiffness = 1e13")
expect(apart(history(exchanged), second) < 1e-9, f"a quarter turn exchanges the stiffnesses: {apart(history(exchanged), second):.1e}")
same = SPACE.replace("second_tangential_stiffness = 2e12", "second_tangential_stiffness = 1e13")
expect(history(same) == history(SPACE.replace("second_tangential_stiffness = 2e12\n", "")), "equal numbers are one number")
# The axis 1 of the lower layer: an isotropic material with an angle has directions, too.
expect(apart(history(SPACE.replace('name = "lower"', 'name = "lower"\nangle = 90', 1)), second) < 1e-9,
       "axis 1 of the lower layer")
expect(apart(history(SPACE.replace('name = "upper"', 'name = "upper"\nangle = 90', 1)), first) < 1e-9,
       "the upper layer has no say")

# Onset and toughness of the second shear: an exchange of the axes exchanges them.
TWO = SPACE.replace("\ntangential_onset = 40.0", "\ntangential_onset = 40.0\nsecond_tangential_onset = 15.0").replace(
    "\ntangential_toughness = 500.0", "\ntangential_toughness = 500.0\nsecond_tangential_toughness = 900.0")
TURNED = SPACE.replace("\ntangential_stiffness = 1e13\nsecond_tangential_stiffness = 2e12",
                       "\ntangential_stiffness = 2e12\nsecond_tangential_stiffness = 1e13").replace(
    "\ntangential_onset = 40.0", "\ntangential_onset = 15.0\nsecond_tangential_onset = 40.0").replace(
    "\ntangential_toughness = 500.0", "\ntangential_toughness = 900.0\nsecond_tangential_toughness = 500.0")
two, across = history(TWO), history(TWO.replace('law = "glue"', AXIS + "[0, 1, 0]"))
expect(0 < apart(two, first) < 1e-3, f"nearly all slides along the first axis, whose numbers stay: {apart(two, first):.1e}")
expect(apart(across, second) > 0.01, "the numbers of the second shear decide where the load slides along it")
expect(apart(history(TURNED), across) < 1e-9, "a quarter turn exchanges onsets and toughnesses")
equal = TWO.replace("second_tangential_onset = 15.0", "second_tangential_onset = 40.0").replace(
    "second_tangential_toughness = 900.0", "second_tangential_toughness = 500.0")
expect(history(equal) == history(SPACE), "equal onsets and toughnesses are one number")

expect_error(delam("check", write(along("[0, 0, 1]"))), 2, r"interfaces\[0\]", "is the normal there")
expect_error(delam("check", write(along("[0, 0, 0]"))), 2, r"interfaces\[0\]\.shear_axis", "length 0")
expect_error(delam("check", write(along("[1, 0]"))), 2, r"interfaces\[0\]\.shear_axis")
expect_error(delam("check", write(PLANE)), 2, "one direction of sliding")
expect_error(delam("check", write(PLANE.replace('law = "glue"', AXIS + "[1, 0, 0]"))), 2, "shear_axis", "3D")
strength = SPACE.replace("tangential_onset = 40.0", "tangential_strength = 2.8e7")
expect_error(delam("check", write(strength)), 2, "tangential_strength", "give tangential_onset")
code, _, error = delam("check", write(strength.replace("second_", "second_tangential_strength = 9e6\nsecond_", 1)))
expect(code == 0, f"two strengths: {error}")
expect_error(delam("check", write(TWO.replace("second_tangential_onset = 15.0", "second_tangential_onset = 15.0\n"
                                              "second_tangential_strength = 9e6"))), 2, "give one")
variational = TWO.replace("[solver]", '[solver]\nmixity_rule = "variational"')
expect_error(delam("check", write(variational)), 2, "two onsets or toughnesses in shear", "use mixity_rule = frozen or converged")
finish()
