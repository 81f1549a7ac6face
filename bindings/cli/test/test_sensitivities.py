# SPDX-License-Identifier: BSD-3-Clause
"""[output] sensitivities: the derivatives of the reactions by numbers of the laws are those of whole analyses whose laws
are a little different."""
import csv
import os
import re

from strip import strip
from support import SCENE, changed, delam, expect, expect_error, finish, folder, write

# A strip that is peeled and sheared, with a mode mixity of its own at each pair.
MIXED = strip("""criterion = "benzeggagh-kenane"
normal_stiffness = 1e13
tangential_stiffness = 1e13
normal_onset = 20.0
tangential_onset = 40.0
normal_toughness = 200.0
tangential_toughness = 500.0
onset_exponent = 1.8
toughness_exponent = 1.8
""", """[[patterns]]
name = "lift"
times = [0, 1, 2]
values = [0, 1.0, 0.2]
[[loads]]
point = [0.0, 0.002]
component = ["y"]
pattern = "lift"
coefficient = 2.5e-4
[[loads]]
point = [0.0, 0.002]
component = ["x"]
pattern = "lift"
coefficient = -6e-5
""", """[time]
end = 1.0
steps = 12
[solver]
step_control = "fixed"  # as where sensitivities are followed, so that the differences are of the same steps
damage_tolerance = 1e-11
""")
SPACE = MIXED.replace("dimension = 2", "dimension = 3\nwidth = 0.004").replace("divisions = 60", "divisions = [20, 2]")
SPACE = SPACE.replace("divisions = 2\nmaterial", "divisions = 1\nmaterial").replace(
    "upper = [0.03, 0.0] }\nfix = [\"x\", \"y\"]", "upper = [0.03, 0.004, 0.0] }\nfix = [\"x\", \"y\", \"z\"]").replace(
    "lower = [0.0, 0.0],", "lower = [0.0, 0.0, 0.0],").replace(
    "point = [0.0, 0.002]\ncomponent = [\"y\"]", "box = { lower = [0.0, 0.0, 0.002], upper = [0.0, 0.004, 0.002] }\n"
    "component = [\"z\"]").replace(
    "point = [0.0, 0.002]\ncomponent = [\"x\"]", "box = { lower = [0.0, 0.0, 0.002], upper = [0.0, 0.004, 0.002] }\n"
    "component = [\"x\"]")


def analysis(text, settings=()):
    out = os.path.join(folder(), "out")
    # Rotations stay small where sensitivities are followed.
    small = ["solver.kinematics=linear", *settings]
    code, _, error = delam("run", write(text), "--out", out, *sum((["--set", s] for s in small), []))
    expect(code == 0, f"the analysis converges: {error}")
    with open(os.path.join(out, "history.csv"), encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def number(text, key):
    """The value of a key of the only law."""
    return float(re.search(rf"^{key} = (\S+)$", text, re.M).group(1))


def compare(what, text, keys, settings=(), step=1e-5, jumps=False):
    """Each derivative against central differences; relative to the largest of the analysis. jumps: it has some, and
    what follows them does not depend on them here. Where the rounding of an analysis, at whose end the damage comes to rest a
    little earlier or later, hides the derivative, differences of three times the length decide."""
    allowed = 1e-6
    paths = [f"laws[0].{key}" for key in keys]
    history = analysis(text, [*settings, "output.sensitivities=" + str(paths)])
    expect(any(float(row["jumps"]) for row in history) == jumps, f"{what}: jumps: {jumps}")
    expect(all(float(row["sensitivities_unknown"]) == 0 for row in history), f"{what}: all adhesions are known")
    expect(any(0 < float(row["dissipated"]) for row in history), f"{what}: something is damaged")
    for key, path in zip(keys, paths):
        value = number(text, key)
        exact = [float(row["reaction/" + path]) for row in history]
        for length in (step, 3 * step):
            ends = [analysis(text, [*settings, f"{path}={value * (1 + sign * length)!r}"]) for sign in (1, -1)]
            differences = [(float(a["reaction"]) - float(b["reaction"])) / (2 * length * value) for a, b in zip(*ends)]
            largest = max(map(abs, differences))
            worst = max(abs(a - b) for a, b in zip(exact, differences)) / largest
            if worst < allowed:
                break
        expect(largest > 0 and worst < allowed, f"{what}, {key}: relative difference {worst:.1e}, at most {allowed:g}")


TOUGH = ["normal_toughness", "tangential_toughness", "toughness_exponent"]
compare("mixed mode", MIXED, [*TOUGH, "normal_onset", "tangential_onset", "onset_exponent", "normal_stiffness"])
compare("mixed mode, unloaded", MIXED.replace("end = 1.0\nsteps = 12", "end = 1.6\nsteps = 16"), TOUGH)
compare("the mixity of the step before", MIXED, TOUGH, ["solver.mixity_rule=frozen"], jumps=True)
compare("exponential", MIXED.replace('name = "glue"', 'name = "glue"\nkind = "exponential"'), TOUGH[:2])
compare("trapezoidal", MIXED.replace('name = "glue"', 'name = "glue"\nkind = "trapezoidal"\nplateau = 0.3'),
        [*TOUGH[:2], "plateau"], step=1e-4)  # smaller differences show the rounding of the analysis
compare("by strengths", MIXED.replace("normal_onset = 20.0", "normal_strength = 2e7").replace(
    "tangential_onset = 40.0", "tangential_strength = 2.5e7"), ["normal_strength", "tangential_strength"])
compare("FETI", MIXED, TOUGH[:1], ["solver.reduction=feti", "solver.linear_tolerance=1e-14"])
compare("in space", SPACE, TOUGH[:2])
SHEARED = SPACE.replace("\ntangential_stiffness = 1e13", "\ntangential_stiffness = 1e13\nsecond_tangential_stiffness = 3e12")
SHEARED = SHEARED.replace('law = "glue"\n', 'law = "glue"\nshear_axis = [0.8, 0.6, 0]\n')
compare("two shears", SHEARED, ["tangential_stiffness", "second_tangential_stiffness", "tangential_toughness"])
TWO = SHEARED.replace("\ntangential_onset = 40.0", "\ntangential_onset = 40.0\nsecond_tangential_onset = 25.0").replace(
    "\ntangential_toughness = 500.0", "\ntangential_toughness = 500.0\nsecond_tangential_toughness = 800.0")
SECOND = ["tangential_toughness", "second_tangential_toughness", "second_tangential_onset", "second_tangential_stiffness"]
compare("two toughnesses in shear", TWO, SECOND)
compare("two toughnesses in shear, of the step before", TWO, SECOND[:2], ["solver.mixity_rule=frozen"])
compare("sliding", changed("end = 2.0\nsteps = 20", "end = 2.0\nsteps = 20\n[solver]\ndamage_tolerance = 1e-11"),
        ["tangential_toughness", "tangential_onset"], jumps=True)

# Two interfaces with one law: the number changes in both.
THREE = MIXED.replace('[[laws]]', '[[layers]]\nname = "top"\nthickness = 0.001\ndivisions = 2\nmaterial = "arm"\n[[laws]]')
THREE = THREE.replace("[[supports]]", '[[interfaces]]\nlower = "upper"\nupper = "top"\nlaw = "glue"\n'
                      "notch = [{ from = 0.0, to = 0.004 }]\n[[supports]]").replace("0.002]", "0.003]")
compare("two interfaces", THREE, TOUGH[:1])


def refused(settings, *patterns, text=MIXED):
    expect_error(delam("check", write(text), *sum((["--set", s] for s in settings), [])), 2, *patterns)


refused(['output.sensitivities=["laws[1].normal_toughness"]'], r"output\.sensitivities", "there are 1 laws")
refused(['output.sensitivities=["normal_toughness"]'], r"laws\[0\]\.normal_toughness, for example")
refused(['output.sensitivities=["laws[0].criterion"]'], "is no number of a law")
refused(['output.sensitivities=["laws[0].gradient"]'], "gradient")
refused(['output.sensitivities=["laws[0].second_tangential_toughness"]'], "equal numbers, which are one number",
        text=TWO.replace("second_tangential_toughness = 800.0", "second_tangential_toughness = 500.0"))
refused(['output.sensitivities=["laws[0].plateau"]'], "plateau")
refused(['output.sensitivities=["laws[0].normal_strength"]'], "normal_strength", "not 0")
refused(['output.sensitivities=["laws[0].normal_toughness"]', "laws[0].gradient=1e-3"], "gradient term")
refused(['output.sensitivities=["laws[0].normal_toughness"]', "solver.mixity_rule=variational", "laws[0].normal_onset=60",
         "laws[0].tangential_onset=80", "laws[0].tangential_toughness=210"], "sensitivities are not followed")

# A run that goes on from a saved state knows nothing of the derivatives before it.
code, _, error = delam("run", write(SCENE), "--out", os.path.join(folder(), "out"), "--resume",
                       "--set", 'output.sensitivities=["laws[0].normal_toughness"]')
expect(code == 0, f"nothing to resume: the run starts anew: {error}")
finish()
