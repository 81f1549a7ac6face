# SPDX-License-Identifier: BSD-3-Clause
"""The JSON Schema of scene files says the same as the program, and what else is made from the tables of keys: manual
pages, completion, JSON for programs."""
import glob
import json
import os
import re
import shutil
import subprocess
import tomllib

import jsonschema
from support import SCENE, changed, delam, expect, finish, folder, write

SOURCE = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
EXAMPLES = os.environ["DELAM_EXAMPLES"]
PROGRAM = json.loads(delam("schema")[1])
BUILT = os.path.join("share", "delam", "scene.schema.json")  # below the build folder
VALIDATOR = jsonschema.Draft4Validator(PROGRAM)

# A plate of two bodies for scenes with [mesh], as Gmsh writes it.
MESH = """
schema = 1
[mesh]
generator = "fibre-cell"
fraction = 0.3
radius = 1.0
arrangement = "square"
cells_around = 8
[[bodies]]
name = "*"
material = "m"
[[materials]]
name = "m"
young = 1.0
poisson = 0.3
[[interfaces]]
all = true
bonded = true
[[patterns]]
name = "pull"
times = [0, 1]
values = [0, 0.01]
[cell]
strain = [{ component = "xx", pattern = "pull" }]
[time]
end = 1.0
steps = 2
"""
ELASTIC = "young = 75e9\npoisson = 0.3"
LAW = 'name = "ductile"\n'
LOAD = "direction = [0.0, -1.0]\n"

# What is wrong in each is in the power of a schema to say.
BROKEN = {
    "a key that is not known": changed("young =", "yuong ="),
    "a table that is not known": SCENE + "[tiem]\nend = 1.0\n",
    "no schema": changed("schema = 1\n", ""),
    "another schema": changed("schema = 1", "schema = 2"),
    "a title that is no text": changed('title = "small ENF"', "title = 3"),
    "no time": SCENE[:SCENE.index("[time]")],
    "no materials": changed('[[materials]]\nname = "arm"\n' + ELASTIC, ""),
    "no dimension": changed("dimension = 2\n", ""),
    "four dimensions": changed("dimension = 2", "dimension = 4"),
    "a dimension with a decimal point": changed("dimension = 2", "dimension = 2.5"),
    "a width in the plane": changed("length = 0.120", "length = 0.120\nwidth = 0.1"),
    "no width in space": changed("dimension = 2", "dimension = 3"),
    "a plane in space": changed("dimension = 2", 'dimension = 3\nwidth = 0.0015\nplane = "plane-stress"'),
    "a length of zero": changed("length = 0.120", "length = 0.0"),
    "neither h nor divisions": changed("h = 0.0015\n", ""),
    "both h and divisions": changed("h = 0.0015", "h = 0.0015\ndivisions = 80"),
    "a cell that is not known": changed("h = 0.0015", 'h = 0.0015\ncell = "quad5"'),
    "a modulus below zero": changed("young = 75e9", "young = -75e9"),
    "a modulus in words": changed("young = 75e9", 'young = "stiff"'),
    "Poisson's ratio of a liquid": changed("poisson = 0.3", "poisson = 0.5"),
    "no Poisson's ratio": changed("poisson = 0.3\n", ""),
    "isotropic and orthotropic": changed("young = 75e9", "young = 75e9\nE1 = 75e9"),
    "half of the constants of a ply": changed(ELASTIC, "E1 = 1e9\nE2 = 1e9\nG12 = 1e9"),
    "an orthotropic material without G13": changed(
        ELASTIC, "E1 = 1e9\nE2 = 1e9\nE3 = 1e9\nnu12 = 0.2\nnu13 = 0.2\nnu23 = 0.2\nG12 = 1e9\nG23 = 1e9"),
    "an expansion with two entries": changed("young = 75e9", "young = 75e9\nexpansion = [1e-6, 1e-6]"),
    "a formulation that is not known": changed("young = 75e9", 'young = 75e9\nformulation = "reduced"'),
    "a layer without thickness": changed("thickness = 0.003\n", ""),
    "a layer without material": changed('material = "arm"\n', ""),
    "an angle and axes": changed("thickness = 0.003", "thickness = 0.003\nangle = 45.0\naxes = [[1, 0, 0], [0, 1, 0]]"),
    "one axis": changed("thickness = 0.003", "thickness = 0.003\naxes = [[1, 0, 0]]"),
    "a body in a scene of layers": SCENE + '[[bodies]]\nname = "a"\nmaterial = "arm"\n',
    "a law of no kind": changed(LAW, LAW + 'kind = "cubic"\n'),
    "an onset of Griffith's": changed(LAW, LAW + 'kind = "griffith"\n'),
    "no plateau": changed(LAW, LAW + 'kind = "trapezoidal"\n'),
    "a plateau of the bilinear law": changed(LAW, LAW + "plateau = 0.5\n"),
    "no stiffness": changed("normal_stiffness = 125e9\n", ""),
    "no onset": changed("normal_onset = 100.0\n", ""),
    "an onset and a strength": changed(LAW, LAW + "normal_strength = 1e6\n"),
    "a gradient below zero": changed(LAW, LAW + "gradient = -1.0\n"),
    "a criterion that is not known": changed(LAW, LAW + 'criterion = "bk"\n'),
    "a softening with three numbers": changed(LAW, LAW + 'kind = "tabulated"\nsoftening = [[0, 1, 2], [1, 0, 2]]\n'),
    "an interface without law": changed('law = "ductile"\n', ""),
    "an interface with law, yet bonded": changed('law = "ductile"\n', 'law = "ductile"\nbonded = true\n'),
    "a notch where all is bonded": changed('law = "ductile"\n', "bonded = true\n"),
    "an interface of bodies between layers": changed('law = "ductile"\n', 'law = "ductile"\na = "lower"\n'),
    "a notch without end": changed("from = 0.0, to = 0.030", "from = 0.0"),
    "a notch by range and box": changed("from = 0.0, to = 0.030", "from = 0.0, to = 0.030, lower = [0.0, 0.0]"),
    "an adhesion of two": changed("notch = [{ from = 0.0, to = 0.030 }]",
                                  "adhesion = [{ from = 0.0, to = 0.030, value = 2.0 }]"),
    "a support nowhere": SCENE + '[[supports]]\nfix = ["x"]\n',
    "a support at two places": SCENE + "[[supports]]\npoint = [0.0, 0.0]\nfix = [\"x\"]\n"
                                       "box = { lower = [0, 0], upper = [1, 1] }\n",
    "a support at a set of a block": SCENE + '[[supports]]\nset = "left"\nfix = ["x"]\n',
    "a support along w": changed('fix = ["y"]', 'fix = ["w"]'),
    "a support along nothing": SCENE + "[[supports]]\npoint = [0.0, 0.0]\n",
    "a point with one coordinate": changed("point = [0.0, 0.0]", "point = [0.0]"),
    "a patch without face": SCENE + '[[supports]]\nfix = ["x"]\npatch = { centre = [0, 0], length = 0.003 }\n',
    "a load without pattern": changed('pattern = "press"\n', ""),
    "a load with terms and a pattern": changed(LOAD, LOAD + 'terms = [{ pattern = "press" }]\n'),
    "a traction at a point": SCENE + '[[forces]]\npoint = [0, 0]\npattern = "press"\ntraction = [0, 1]\n',
    "a force and a traction": SCENE + '[[forces]]\npattern = "press"\ntraction = [0, 1]\nforce = [0, 1]\n'
                                      'patch = { centre = [0, 0], length = 0.003, face = "-y" }\n',
    "a pattern without values": changed("values = [0.0, 0.006]\n", ""),
    "a strain of four components": SCENE + '[[eigenstrains]]\npattern = "press"\nstrain = [0, 0, 0, 0]\n',
    "a law that is false": changed('law = "ductile"\n', "law = false\nbonded = true\n"),
    "a name that is a number": SCENE + '[[supports]]\nname = 3\npoint = [0.0, 0.0]\nfix = ["x"]\n',
    "no terms": changed('pattern = "press"\n', "terms = []\n"),
    "instants, and an end that is false": changed("end = 2.0\nsteps = 20", "instants = [0, 1]\nend = false"),
    "no steps": changed("steps = 20\n", ""),
    "half a step": changed("steps = 20", "steps = 0.5"),
    "instants and steps": changed("steps = 20", "steps = 20\ninstants = [0, 1]"),
    "one instant": changed("end = 2.0\nsteps = 20", "instants = [0.0]"),
    "an option that is not known": SCENE + "[solver]\ndamage_tolerence = 1e-5\n",
    "an option out of range": SCENE + "[solver]\ndamage_tolerance = -1.0\n",
    "an option in other words": SCENE + '[solver]\nminimisation = "fast"\n',
    "an option and its alias": SCENE + "[solver]\njump_tolerance = 0.1\ninstability_tolerance = 0.1\n",
    "a field that is not known": SCENE + '[output]\nfields = ["strss"]\n',
    "fields at every zeroth step": SCENE + "[output]\nevery = 0\n",
    "a unit that is a number": SCENE + "[units]\nlength = 1\n",
    "a mesh from nowhere": changed('generator = "fibre-cell"\n', "", MESH),
    "two meshes": changed('generator = "fibre-cell"\n', 'generator = "fibre-cell"\nfile = "a.msh"\n', MESH),
    "a mesh and a block": MESH + "[geometry]\ndimension = 2\nlength = 1.0\nh = 0.1\n",
    "a yarn among fibres": changed("radius = 1.0\n", "radius = 1.0\nspacing = 1.0\n", MESH),
    "a gap of a square arrangement": changed("radius = 1.0\n", "radius = 1.0\ngap = 0.1\n", MESH),
    "fibres without fraction": changed("fraction = 0.3\n", "", MESH),
    "layers of a mesh": changed("all = true\n", 'lower = "a"\nupper = "b"\n', MESH),
    "all bodies, and one": changed("all = true\n", 'all = true\na = "b"\n', MESH),
    "a gap without projection": changed("all = true\n", "all = true\ngap = 0.1\n", MESH),
    "a strain along xxx": changed('component = "xx"', 'component = "xxx"', MESH),
    "a stress without pattern": changed("[cell]\n", '[cell]\nstress = [{ component = "yy" }]\n', MESH),
}


def check(what, condition):
    expect(condition, what)


def valid(text):
    return VALIDATOR.is_valid(tomllib.loads(text))


def checked(text):
    """What `delam check --json` prints of a scene."""
    code, out, error = delam("check", "--json", write(text))
    found = json.loads(out)
    expect(found["correct"] == (code == 0) and not error, f"the exit code says the same: {code} {error}")
    return found


def test_schema_of_the_build():
    jsonschema.Draft4Validator.check_schema(PROGRAM)
    with open(os.path.join(os.path.dirname(os.path.dirname(os.environ["DELAM"])), BUILT), encoding="utf-8") as file:
        check("the build has what `delam schema` prints", json.load(file) == PROGRAM)


def test_examples():
    root = os.path.dirname(EXAMPLES)
    with open(os.path.join(root, "examples", "run.sh"), encoding="utf-8") as file:
        preset = re.search(r"cmake --build --preset (\w+) --target delam_cli\n", file.read())
    schema = os.path.join(root, "build", preset.group(1), BUILT)  # once examples/run.sh has built the program
    files = sorted(glob.glob(os.path.join(EXAMPLES, "*", "*.toml")))
    check("there are examples", len(files) >= 20)
    for path in files:
        with open(path, encoding="utf-8") as file:
            text = file.read()
        first = re.match(r"#:schema (\S+)\n", text)
        check(f"{os.path.basename(path)} names the schema",
              first and os.path.normpath(os.path.join(os.path.dirname(path), first.group(1))) == schema)
        check(f"{os.path.basename(path)} is valid", valid(text))


def test_broken_scenes():
    check("the scenes themselves are right", all(valid(text) and checked(text)["correct"] for text in (SCENE, MESH)))
    check("there are 50 broken scenes and more", len(BROKEN) >= 50)
    for what, text in BROKEN.items():
        found = checked(text)
        check(f"{what}: refused by the program", not found["correct"])
        check(f"{what}: {found.get('errors')}: refused by the schema", not valid(text))


def test_error_as_json():
    error = checked(changed("young = 75e9", "young = -1.0"))["errors"][0]
    check(f"place and message: {error}", error["key"] == "materials[0].young" and error["line"] == 10
          and error["file"].endswith("scene.toml") and "-1 is not allowed" in error["message"])
    error = checked(changed('law = "ductile"', 'law = "brittle"'))["errors"][0]
    check(f"a name that refers to nothing: {error}", error["key"] == "interfaces[0].law")
    error = checked(changed("normal_toughness = 250.0", "normal_toughness = 50.0"))["errors"][0]
    check(f"what the library refuses: {error}", error["key"] == "laws[0]" and "normal_toughness" in error["message"])
    error = checked("schema = ")["errors"][0]
    check(f"no TOML: {error}", error["line"] == 1 and "TOML" in error["message"])


def test_check_as_json():
    found = checked(SCENE)
    check(f"numbers of unknowns: {found['unknowns']}", found["unknowns"] == {"primal": 972, "dual": 162})
    check(f"interface: {found['interfaces']}", found["interfaces"] == [
        {"name": "lower-upper", "pairs": 81, "kind": "law", "law": "ductile", "regions": 1}])
    check("time", found["time"] == {"from": 0.0, "to": 2.0, "steps": 20})
    check("warnings are a list", isinstance(found["warnings"], list) and found["plan"])
    code, out, error = delam("check", "--json", "--no-plan", write(SCENE))
    without = json.loads(out)
    check(f"all but the plan: {error}", code == 0 and not without["plan"] and "effort" not in without
          and all(value == found[key] for key, value in without.items() if key not in ("plan", "file")))
    code, out, error = delam("check", "--no-plan", write(SCENE))
    check(f"nor is it told: {out}", code == 0 and "unknowns" in out and "How it is computed" not in out and "effort" not in out)
    code, _, error = delam("check", "--no-plan", write(changed("young = 75e9", "young = -1.0")))
    check(f"what is wrong is found nevertheless: {error}", code == 2 and "young" in error)


def test_progress_as_json():
    def events_of(text):
        out = delam("run", write(text), "--out", os.path.join(folder(), "out"), "--progress", "json")[1]
        return [json.loads(line) for line in out.splitlines()]

    events = events_of(changed("steps = 20", "steps = 4"))
    steps = [event for event in events if event["event"] == "step"]
    check(f"one event for each step: {steps}", [step["step"] for step in steps] == [1, 2, 3, 4])
    check("with time and load", [step["time"] for step in steps] == [0.5, 1.0, 1.5, 2.0]
          and abs(steps[-1]["load"] - 0.006) < 1e-12 and all(step["converged"] for step in steps))
    check("the end is the last", events[-1] == {"event": "end", "exit_code": 0})
    check("lines are events as well", any("wrote" in event.get("text", "") for event in events))
    events = events_of(changed("young = 75e9", "young = -1.0"))
    check(f"errors are events: {events}", events[0]["event"] == "error" and "young" in events[0]["message"]
          and events[-1] == {"event": "end", "exit_code": 2})


def test_every_key_is_explained():
    with open(os.path.join(SOURCE, "SCENE.md"), encoding="utf-8") as file:
        words = set(re.findall(r"[A-Za-z_0-9]+", " ".join(re.findall(r"`([^`]*)`", file.read()))))
    solver = PROGRAM["definitions"]["solver"]["properties"]  # `delam options` lists them
    for name, table in [("", PROGRAM), *PROGRAM["definitions"].items()]:
        missing = [key for key in table["properties"] if key not in words and key not in solver]
        check(f"SCENE.md explains the keys of {name or 'the file'}, but not {missing}", not missing)
        silent = [key for key, row in table["properties"].items() if not row.get("description")]
        check(f"the schema explains the keys of {name or 'the file'}, but not {silent}", not silent)


def test_manual_pages():
    for page, known in (("delam", ["run", "--resume", "--progress", "EXIT CODES"]),
                        ("delam-scene", ["normal_stiffness", "GEOMETRY", "thickness"])):
        text = delam("man", page)[1]
        plain = text.replace("\\-", "-")
        check(f"{page} has {known}", text.startswith(".TH") and all(word in plain for word in known))
        if not shutil.which("groff"):
            continue
        shown = subprocess.run(["groff", "-man", "-Tutf8", "-ww"], input=text, capture_output=True, text=True,
                               check=False)
        check(f"groff sets {page} without a warning: {shown.stderr[:300]}",
              shown.returncode == 0 and not shown.stderr)


def completed(words):
    """What bash offers for the last of the words."""
    script = delam("completion", "bash")[1]
    quoted = " ".join(f"'{word}'" for word in words)
    done = subprocess.run(["bash", "-c", f"{script}\nCOMP_WORDS=({quoted}); COMP_CWORD={len(words) - 1}\n"
                           "compopt() { :; }; _delam; printf '%s\\n' \"${COMPREPLY[@]}\""],
                          capture_output=True, text=True, check=True)
    check(f"bash says nothing else: {done.stderr}", not done.stderr)
    return done.stdout.split()


def test_completion():
    check("commands", "run" in completed(["delam", ""]) and completed(["delam", "ch"]) == ["check"])
    check("options", "--resume" in completed(["delam", "run", "--"]))
    check("values of an option", completed(["delam", "run", "--progress", ""]) == ["text", "json"])
    check("keys of --set", set(completed(["delam", "run", "a.toml", "--set", "solver.min"])) ==
          {"solver.minimisation=" + kind for kind in ("auto", "alternate", "accelerated", "staggered")}
          | {"solver.minimisation_limit="})
    check("their values, as bash splits them",
          completed(["delam", "run", "--set", "solver.contact", "=", "al"]) == ["always"])
    here = folder()
    for name in ("a.toml", "b.inp", "c.txt"):
        with open(os.path.join(here, name), "w", encoding="utf-8"):
            pass
    offered = completed(["delam", "check", here + "/"])
    check(f"scenes alone: {offered}", sorted(map(os.path.basename, offered)) == ["a.toml", "b.inp"])
    for shell in ("zsh", "fish"):
        if shutil.which(shell):
            # fish complains of options of `complete` only where it runs them; zsh needs its functions for that.
            done = subprocess.run([shell] if shell == "fish" else [shell, "-n"], input=delam("completion", shell)[1], capture_output=True,
                                  text=True, check=False)
            check(f"{shell} reads its script: {done.stderr}", done.returncode == 0 and not done.stderr)
    if shutil.which("zsh"):
        # _arguments and compadd work while a line is completed only; here they show what they are given.
        stubs = """
            compadd() { if [[ $1 == -S ]]; then print -l -- "$2"${^${(P)4}}; else print -l -- ${^${(P)2}}" "; fi }
            _arguments() { local spec=${(M)@:#\\*--set\\[*}; eval "${spec##*:}" }
            CURRENT=4 words=(delam run a.toml --set)
        """
        done = subprocess.run(["zsh", "-f"], input=stubs + delam("completion", "zsh")[1], capture_output=True, text=True, check=False)
        offered = done.stdout.splitlines()
        check(f"zsh puts a blank behind a value, and none behind KEY= {done.stderr}", "solver.contact=always " in offered and
              "geometry.length=" in offered and "geometry.length= " not in offered)


for test in [value for name, value in list(globals().items()) if name.startswith("test_")]:
    test()
finish()
