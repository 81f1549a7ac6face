# SPDX-License-Identifier: BSD-3-Clause
"""--set: a value instead of the scene file's, as strictly checked, recorded, and part of what --resume compares."""
import json
import os
import re
import resource

from support import SCENE, changed, delam, expect, expect_error, finish, folder, read, write

scene = write(SCENE)


def refuse(setting, *patterns):
    expect_error(delam("check", scene, "--set", setting), 2, "^delam: --set", *patterns)


def described(path, *settings):
    words = [word for setting in settings for word in ("--set", setting)]
    code, out, error = delam("check", path, *words)
    expect(code == 0, f"{settings}: {error.strip()}")
    # But for the first line, which names the file.
    return out.split("\n", 1)[1] if code == 0 else error


def like(edited, *settings):
    expect(described(scene, *settings) == described(write(edited)), f"{' '.join(settings)} is like editing the file")


like(changed("h = 0.0015", "h = 0.003"), "geometry.h=3e-3")
like(changed("normal_onset = 100.0", "normal_onset = 90.0"), "laws[0].normal_onset=90")
like(changed("normal_onset = 100.0", "normal_onset = 90.0"), "laws.0.normal_onset=90")
like(changed("to = 0.030", "to = 0.045"), "interfaces[0].notch[0].to=0.045")
like(changed("values = [0.0, 0.006]", "values = [0.0, 0.003]"), "patterns[0].values[1]=0.003")
like(changed('title = "small ENF"', 'title = "ENF, coarse"'), "title=ENF, coarse")
like(changed('title = "small ENF"', 'title = "3 mm"'), 'title="3 mm"')
like(changed("steps = 20", "steps = 5\n[solver]\nminimisation = \"alternate\"\nminimisation_limit = 50"),
     "time.steps=7", "solver.minimisation=alternate", "solver.minimisation_limit=50", "time.steps=5")
like(changed("steps = 20", "steps = 20\n[solver]\nminimisation = \"alternate\"\ngluing = \"redundant\""),
     "solver.minimisation=staggered", "solver.multipliers=redundant")
like(changed("steps = 20", "steps = 20\n[output]\nsnapshots = [0.5, 1.0]"), "output.snapshots=[0.5, 1.0]")

# A word that is missing, or of another kind, is named, with what it means and where more stands.
for words, wanted in (((), "run: scene SCENE is required: scene file"), ((scene,), "run: --out FOLDER is required: folder for the results"),
                      ((scene, "--out"), "run: --out: 1 required FOLDER missing"),
                      ((scene, "--out", scene + "-out", "more"), "run: .*more")):
    expect_error(delam("run", *words), 2, "^delam: " + wanted, "`delam help run` tells more$")

refuse("geometry.h=0.0007", r"geometry\.h", "evenly", "h = 0.00075 divides all")
refuse("geometry.hh=1", r"geometry\.hh", "did you mean 'h'")
refuse("tiem.steps=3", "tiem", "did you mean 'time'")
refuse("solver.damage_tolerence=1e-5", r"solver\.damage_tolerence", "did you mean 'damage_tolerance'")
refuse("solver.minimisation=fast", r"solver\.minimisation", '"fast"', "alternate")
refuse("materials[0].young=-1", r"materials\[0\]\.young", "-1", "> 0")
refuse("materials[0].young=stiff", r"materials\[0\]\.young", '"stiff"', "number")
refuse("time.steps=2.5", r"time\.steps", "2.5 has a decimal point")
refuse('output.snapshots=[0.5, "a"]', r"output\.snapshots\[1\]", "number")
refuse("laws[1].normal_onset=1", r"laws\[1\]\.normal_onset", "laws has 1 entry")
refuse("laws.1.normal_onset=1", r"laws has 1 entry")
refuse("laws.0.normal_onset=-1", r"laws\[0\]\.normal_onset", "-1")
refuse("layers.thickness=1", r"layers is a list: layers\[0\] is its first entry")
refuse("laws[0].criterion=bk", r"laws\[0\]\.criterion", '"bk"', "benzeggagh-kenane")
refuse("laws[0].gradient=-1", r"laws\[0\]\.gradient", "-1", ">= 0")
refuse("solver.backtracking=true", r"solver\.backtracking", "true", "auto, off, on")
refuse('output.columns=["frontt"]', r"output\.columns", "did you mean 'front'")
refuse("geometry[0]=1", "geometry is no list")
refuse("geometry.h.x=1", r"geometry\.h is no table")
refuse("solver[0].x=1", "solver is not there")
refuse("geometry.h=", r"geometry\.h", "there is no value")
refuse("geometry.h=1.5mm", r"geometry\.h", "1.5mm", "as in TOML")
refuse("geometry.h=1\n[solver]", r"geometry\.h", "as in TOML")
refuse("geometry.h", "KEY=VALUE is expected")
for key in ("", "a b", "laws[0", "laws[x].kind", "geometry..h", ".h", "geometry.", "[0]"):
    refuse(key + "=1", "is no key")

# The file keeps its place in messages that are not about a setting.
bad = write(changed("poisson = 0.3", "poisson = 0.7"))
expect_error(delam("check", bad, "--set", "materials[0].young=1e9"), 2, r"scene\.toml:11: materials\[0\]\.poisson")

out = folder()
settings = ("--set", "time.steps=6", "--set", "title=ENF, set")
code, _, error = delam("run", *settings, scene, "--out", out)
expect(code == 0, f"a run with settings before its scene {error}")
about = json.loads(read(os.path.join(out, "result.json")))
expect(about["scene"]["settings"] == ["time.steps=6", "title=ENF, set"] and about["scene"]["title"] == "ENF, set",
       "result.json records them")
expect(about["steps"] == 6 and about["scene"]["shortest_edge"] == 0.0015, "they act")
expect("complete already" in delam("run", scene, "--out", out, *settings, "--resume")[1], "the same settings resume")
other = write(changed("steps = 20", "steps = 6", changed("small ENF", "ENF, set")))
expect("complete already" in delam("run", other, "--out", out, "--resume")[1], "so does a file that says the same")
expect_error(delam("run", scene, "--out", out, "--resume"), 2, "the scene, with its --set, is not the one")
expect_error(delam("run", scene, "--out", out, "--set", "time.steps=7", "--resume"), 2, "is not the one")

# What a person is told to type brings the settings along.
narrow = folder()
limits = {"preexec_fn": lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))}
_, _, error = delam("run", scene, "--out", narrow, "--set", "title=it's one", **limits)
expect(re.search(r"delam run \S+ --out \S+ --set 'title=it'\\''s one'", error),
       f"the hint is whole: {error.splitlines()}")
# What can be set is listed, and each default of the list can be set.
code, out, _ = delam("options", "--json")
listed = json.loads(out)
expect(code == 0 and len(listed["options"]) > 20 and len({row["key"] for row in listed["options"]}) ==
       len(listed["options"]), "options as JSON")
for row in listed["options"]:
    value = row["default"]
    inside = row["type"] == "text" or row["bounds"]["lower"] is None or float(value) >= row["bounds"]["lower"]
    expect(inside, f"default of {row['key']} is in its bounds: {value}, {row['range']}")
code, text, _ = delam("options")
expect(code == 0 and all(f"\n{row['key']}" in text for law in listed["laws"] for row in law["parameters"]),
       "all parameters of laws in the list for people")
expect(all(f"\n{row['key']}" in text for row in listed["options"]), "all options in the list for people")
finish()
