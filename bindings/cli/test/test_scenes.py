# SPDX-License-Identifier: BSD-3-Clause
"""Bad scenes: every message names the place, the value and what is allowed; good ones pass `check`."""
import json
import re
import subprocess

from support import DELAM, SCENE, changed, delam, expect, expect_error, finish, start, write


def refuse(text, *patterns, code=2):
    expect_error(delam("check", write(text)), code, *patterns)


scene = write(SCENE)
code, out, _ = answer = start("check", scene)
expect(code == 0 and "unknowns" in out and "left out" in out, "check prints the plan")
words = re.search(r"\neffort      about ([\d.]+) s and (\d+) MiB.*\n(note: .*\n)*\nHow it is computed", out)
found = json.loads(start("check", scene, "--json", "--set", "time.steps=40")[1])["effort"]
expect(words and 1.1 * float(words[1]) < found["seconds"] < 2.2 * float(words[1]) and abs(found["bytes"] / 2**20 - int(words[2])) < 1,
       f"what it takes stands before the plan, of twice as many steps twice as much: {out[:1500]} {found}")
expect(delam("check", scene) == answer, "a program that is already loaded prints the same")
expect("initial state" not in out, "check solves a small scene")
# Dense blocks of 2000 rows, more than 2 s at the nominal rate: planned, not factored.
code, out, error = delam("check", scene, "--set", "geometry.h=120e-6", "--set", "solver.reduction=feti", "--set", "solver.subdomains=1")
expect(code == 0 and re.search(r"\nFETI: used, .*total FETI: 2 subdomains.*\n(.*\n)*initial state: left out, .*predicted to take [\d.]+ s", out),
       "check plans a large scene: " + out + error)
code, _, error = delam("check", scene, "--set", "geometry.h=120e-6", "--set", "solver.reduction=feti", "--set", "solver.subdomains=1",
                       "--set", "output.columns=[\"frnt\"]")
expect(code == 2 and "did you mean" in error, "with its columns: " + error)
code, out, _ = start("--version")
expect(code == 0 and out.startswith("delam "), "--version")
code, out, _ = start("--help")
expect(code == 0 and "Exit codes" in out, "--help documents the exit codes")
expect(delam("run")[0] == 2 and delam("fly")[0] == 2, "wrong usage is exit 2")
expect(start() == start("help") and start()[0] == 0, "without a word the program lists its commands, as help does")

refuse(changed("young = 75e9", "yuong = 75e9"), r"scene\.toml:10: materials\[0\]\.yuong", "did you mean 'young'")
refuse(changed("young = 75e9", "E = 75e9"), r"materials\[0\]\.E: unknown key \(did you mean 'young'\?\)")
refuse(changed("poisson = ", "nu = "), r"materials\[0\]\.nu: unknown key \(did you mean 'poisson'\?\)")
refuse(changed("[time]", "[tiem]"), "tiem", "did you mean 'time'")
refuse(changed("young = 75e9", "young = -75e9"), r"scene\.toml:10: materials\[0\]\.young", "-75000000000", "> 0")
refuse(changed("poisson = 0.3", "poisson = 0.5"), r"materials\[0\]\.poisson", "0.5", r"in \(-1, 0.5\)")
refuse(changed("young = 75e9", "young = nan"), r"materials\[0\]\.young", "nan")
refuse(changed("thickness = 0.003", "thickness = inf"), r"layers\[0\]\.thickness", "inf")
refuse(changed("values = [0.0, 0.006]", "values = [0.0, nan]"), r"patterns\[0\]\.values\[1\]", "nan")
refuse(changed("young = 75e9", 'young = "stiff"'), r"materials\[0\]\.young", "number")
refuse(changed('fix = ["x", "y"]', 'fix = ["y"]'), "scene.toml")
refuse(changed('material = "arm"', 'material = "amr"'), r"layers\[0\]\.material", "did you mean 'arm'")
refuse(changed('law = "ductile"', 'law = "brittle"'), r"interfaces\[0\]\.law", "defined: ductile")
refuse(changed("normal_toughness = 250.0", "normal_toughness = 50.0"), r"laws\[0\]")
refuse(changed("normal_onset = 100.0\n", ""), r"laws\[0\]", "normal_onset")
refuse(changed("tangential_toughness = 250.0", "tangential_toughness = 250.0\ngradient = -1.0"), r"laws\[0\]\.gradient", ">= 0")
for kappa, words in (("0.0", "gradient term: left out"), ("2.5e-3", r"gradient term: used.*kappa = 0\.0025 couples")):
    answer = delam("check", write(changed("tangential_toughness = 250.0", "tangential_toughness = 250.0\ngradient = " + kappa)))
    expect(answer[0] == 0 and re.search(words, " ".join(answer[1].split())), "check tells of the gradient term: " + answer[1])
refuse(changed("tangential_toughness = 250.0", "tangential_toughness = 250.0\ntoughness_exponent_1 = 0.3\n"
               "toughness_exponent_2 = 0.3"), r"laws\[0\]")
LAW = 'name = "ductile"\n'
for words in ('kind = "exponential"\n', 'kind = "trapezoidal"\nplateau = 0.4\n',
              'kind = "tabulated"\nsoftening = [[0, 1], [0.3, 0.5], [1, 0]]\n',
              'criterion = "power"\nonset_exponent = 1.0\n',
              'criterion = "benzeggagh-kenane"\ntoughness_exponent = 1.7\nonset_exponent = 1.7\n', 'gradient = 0.0\n'):
    answer = delam("check", write(changed(LAW, LAW + words)))
    expect(answer[0] == 0, "accepted: " + words.replace("\n", "; ") + answer[2])
griffith = changed(LAW, LAW + 'kind = "griffith"\n')
for mode in ("normal", "tangential"):
    griffith = griffith.replace(mode + "_onset = 100.0\n", "")
expect(delam("check", write(griffith))[0] == 0, "Griffith's law has no onset")
refuse(changed(LAW, LAW + 'kind = "griffith"\n'), r"laws\[0\]\.normal_onset")
refuse(changed(LAW, LAW + 'kind = "cubic"\n'), r"laws\[0\]\.kind", "exponential")
refuse(changed(LAW, LAW + 'kind = "trapezoidal"\n'), r"laws\[0\]", "plateau")
refuse(changed(LAW, LAW + 'kind = "trapezoidal"\nplateau = 1.0\n'), r"laws\[0\]\.plateau", ">= 0 and < 1")
refuse(changed(LAW, LAW + 'plateau = 0.5\n'), r"laws\[0\]\.plateau")
refuse(changed(LAW, LAW + 'gradient = -1.0\n'), r"laws\[0\]\.gradient", ">= 0")
refuse(changed(LAW, LAW + 'kind = "tabulated"\n'), r"laws\[0\]", "softening: is missing")
refuse(changed(LAW, LAW + 'kind = "tabulated"\nsoftening = [[0, 1], [0.5, 1.5], [1, 0]]\n'),
       r"laws\[0\]\.softening\[1\]\[1\]")
refuse(changed(LAW, LAW + 'kind = "tabulated"\nsoftening = [[0, 1], [0.5], [1, 0]]\n'), r"laws\[0\]\.softening\[1\]")
refuse(changed(LAW, LAW + 'kind = "tabulated"\nsoftening = [[0, 1], [0.5, 0.2], [0.6, 0.3], [1, 0]]\n'),
       r"laws\[0\]\.softening", "must not rise")
refuse(changed(LAW, LAW + 'criterion = "bk"\n'), r"laws\[0\]\.criterion", "benzeggagh-kenane")
refuse(changed(LAW, LAW + 'criterion = "power"\nonset_exponent_1 = 2.0\n'),
       r"laws\[0\]\.onset_exponent_1", "criterion power")
refuse(changed("h = 0.0015", "h = 0.0007"), r"geometry\.h", "evenly", "h = 0.00075 divides all")
# 0.0024 divides the length, not the thicknesses; what is suggested has to divide both.
odd = changed("h = 0.0015", "h = 0.0024")
answer = delam("check", write(odd))
expect_error(answer, 2, r"layers\[0\]\.thickness", "h = [0-9.e-]+ divides all lengths and thicknesses")
better = re.search(r"h = ([0-9.e-]+) divides all", answer[2])
expect(better and delam("check", write(changed("h = 0.0024", "h = " + better.group(1), odd)))[0] == 0,
       "the suggested h is accepted")
refuse(changed("point = [0.060, 0.006]", "point = [0.0604, 0.006]"), r"loads\[0\]\.point", "nearest", "upper")
refuse(changed("point = [0.060, 0.006]", "point = [0.060, 0.003]"), r"loads\[0\]\.point", "lower, upper", "layer")
refuse(changed("schema = 1", "schema = 2"), "schema", "2")
refuse(changed("schema = 1\n", ""), "schema", "missing")
refuse(changed("steps = 20", "steps = 0"), r"time\.steps", "0 is not allowed: from 1 to 100000000")
refuse(changed("steps = 20", "steps = 6.0"), r"time\.steps", "6.0 has a decimal point")
refuse(SCENE + "[solver]\nsubdomains = 2.5\n", r"solver\.subdomains", "2.5", "from 0 to 1000000")
refuse(changed("end = 2.0\nsteps = 20", "instants = [0, 1, 1]"), r"time\.instants", "strictly increasing")
refuse(SCENE + "[solver]\ndamage_tolerence = 1e-5\n", r"solver\.damage_tolerence", "did you mean 'damage_tolerance'")
refuse(SCENE + "[solver]\ndamage_tolerance = -1.0\n", r"solver\.damage_tolerance")
refuse(SCENE + "[solver]\nmultipliers = \"redundant\"\ngluing = \"redundant\"\n", r"solver\.multipliers",
       "means the same as gluing")
refuse(SCENE + "[solver]\ninstability_size = -1.0\n", r"solver\.instability_size", "0 < value < 1e9")
refuse(SCENE + "[solver]\npreconditioner = 3\n", r"solver\.preconditioner", "text")
refuse(SCENE + '[output]\nfields = ["strss"]\n', r"output\.fields", "did you mean 'stress'")
refuse(SCENE + '[output]\ncolumns = ["frnt"]\n', r"output\.columns", "front")
refuse(SCENE + "x = = 1\n", r"scene\.toml:\d+", "TOML")
expect_error(delam("check", "/nowhere/scene.toml"), 2, "/nowhere/scene.toml", "No such file")

patch = changed("point = [0.060, 0.006]", 'patch = { centre = [0.060, 0.006], length = 0.002, face = "+y" }')
expect(delam("check", write(patch))[0] == 0, "a load on a patch")
refuse(changed('face = "+y"', 'face = "-y"', patch), r"loads\[0\]\.patch", "boundary face")
force = changed("[time]", '[[patterns]]\nname = "gravity"\ntimes = [0, 2]\nvalues = [0, 1]\n[[forces]]\n'
                'point = [0.06, 0.006]\nforce = [0.0, -10.0]\npattern = "gravity"\n[time]')
expect(delam("check", write(force))[0] == 0, "dead forces")


def warned(text, *parts):
    code, _, error = delam("check", write(text))
    expect(code == 0 and all(p in error for p in parts), f"a warning with {parts}: {error.strip()}")


expect(delam("check", write(SCENE))[2] == "", "no warning where nothing is odd")


# What the library doubts before anything is solved; the names are those of the scene.
warned(changed("normal_toughness = 250.0", "normal_toughness = 150.0"),
       'warning: interface "lower-upper": the normal onset is 0.667 of the toughness', "hardly softens")
warned(changed("normal_toughness = 250.0", "normal_toughness = 250e3"),
       'interface "lower-upper": it debonds at a normal jump of about 2 G/s = 0.1,', "units that fit together?")
warned(changed("to = 0.030", "to = 30"), 'interface "lower-upper": no pair adheres at the start')
for share in (0.49, 0.51):  # of the toughness; the bound is half of it
    told = delam("check", write(changed("normal_toughness = 250.0", f"normal_toughness = {100 / share}")))[2]
    expect(("hardly softens" in told) == (share > 0.5), f"an onset of {share} of the toughness: {told}")


def proposals(text):
    """By `check`: those of the JSON object, and the warnings."""
    code, out, _ = delam("check", write(text), "--json")
    expect(code == 0, "a scene with proposals is correct")
    found = json.loads(out)
    return found["proposals"], found["warnings"]


# The law of the ENF is far softer than its layers; pasted, the numbers leave nothing to propose, and the peaks as they were.
soft, _ = proposals(SCENE)
expect(len(soft) == 1 and soft[0]["law"] == "ductile" and soft[0]["interfaces"] == ["lower-upper"], f"a proposal: {soft}")
keys = soft[0]["keys"]
expect(abs(keys["normal_stiffness"] - 50 * 75e9 / 0.003) < 1e-9 * 1.25e15 and abs(keys["normal_strength"] - 5e6) < 1, f"{keys}")
expect("propose     law \"ductile\", normal_stiffness = 1.25e+15" in delam("check", write(SCENE))[1], "the same for people")


def pasted(text, keys):
    lines = [line for line in text.splitlines() if line.split(" = ")[0] not in
             set(keys) | {key.replace("strength", "onset") for key in keys}]
    at = lines.index('name = "ductile"') + 1
    return "\n".join(lines[:at] + [f"{key} = {value!r}" for key, value in keys.items()] + lines[at:])


stiff = pasted(SCENE, keys)
expect(proposals(stiff) == ([], []), "with the numbers pasted, nothing is left to propose")
# Strengths too high for the mesh: those proposed give three pairs, the most that they can.
strong = changed("normal_strength = 5000000.0", "normal_strength = 40e6", stiff)
found, warnings = proposals(strong)
expect(len(found) == 1 and set(found[0]["keys"]) == {"normal_strength", "tangential_strength"}, f"strengths: {found}")
expect(any("process zone" in text for text in warnings), "and a warning")
expect(found[0]["keys"]["tangential_strength"] == 5e6 and found[0]["keys"]["normal_strength"] < 40e6, "only what is too strong is lowered")
lowered = pasted(strong, found[0]["keys"])
expect(proposals(lowered) == ([], []), "with the strengths pasted, three pairs are in the zone")
more = dict(found[0]["keys"], normal_strength=1.01 * found[0]["keys"]["normal_strength"])
expect(proposals(pasted(strong, more))[1] != [], "one per cent more is too much")
expect(proposals(strong + '\n[solver]\nsolution = "energetic"\n')[0] == [], "energetic solutions need no zone")

warned(changed("to = 0.030", "to = 30"),
       "warning: interfaces[0].notch[0] ends at 30, the interface at 0.12: nothing adheres")
warned(changed("from = 0.0, to", "from = -1, to"),
       "warning: interfaces[0].notch[0] begins at -1, the interface at 0\n")
warned(changed("to = 0.030", "to = 0.12"), "warning: interfaces[0]: nothing adheres")
warned(changed("to = 0.030", "to = 0.0304"),
       "warning: interfaces[0].notch[0] ends at x = 0.0304, between two pairs: the tip of the crack is the next pair, at 0.0315\n")
warned(changed("to = 0.030", "to = 0.03149999"),
       "ends at x = 0.0315, between two pairs: the tip of the crack is the next pair, at 0.0315, 1e-08 away\n")
warned(changed("from = 0.0, to", "from = 0.0106, to"),
       "warning: interfaces[0].notch[0] begins at x = 0.0106, between two pairs: the tip of the crack is the next pair, at 0.0105\n")
warned(changed("point = [0.060, 0.006]", "point = [0.0604, 0.006]\ntolerance = 5e-4"),
       "warning: loads[0].point is [0.0604, 0.006], its node is at [0.06, 0.006], 0.0004 away")
warned(changed("length = 0.002", "length = 0.2", patch), "warning: loads[0].patch reaches from x = -0.04 to 0.16")
warned(changed("values = [0.0, 0.006]", "values = [0.001, 0.006]"), 'patterns[0] "press" is 0.001 at the start',
       "its stored energy is not in `work`")
_, out, _ = delam("check", write(changed("poisson = 0.3", "poisson = 0.495")))
expect("note: " in out and "locks" in out, "a note where cells lock")
_, out, _ = delam("check", write(changed("dimension = 2", 'dimension = 2\ncell = "tri3"')))
expect("note: " in out and "bending" in out, "a note where triangles are too stiff")

quadratic = changed("dimension = 2", 'dimension = 2\ncell = "quad8"')
_, out, error = delam("check", write(changed("h = 0.0015", "h = 0.003", quadratic)))
expect(error == "" and "note: " not in out, "one quadratic cell across the thickness is enough")
refuse(changed("dimension = 2", 'dimension = 2\ncell = "hex20"'), r"geometry\.cell", "quad8")
bending = changed("poisson = 0.3", 'poisson = 0.3\nformulation = "incompatible"')
expect(delam("check", write(bending))[0] == 0, "incompatible modes")
refuse(changed("dimension = 2", 'dimension = 2\ncell = "tri6"', bending), r"materials\[0\]", "no cells with such modes",
       "quad4 and hex8")
mean = changed("poisson = 0.3", 'poisson = 0.4999\nformulation = "mean-dilatation"')
answer = delam("check", write(mean))
expect(answer[0] == 0 and "locks" not in answer[1], "nearly incompressible: " + answer[2])
refuse(changed("dimension = 2", 'dimension = 2\ncell = "tri3"', mean), r"materials\[0\]", "tri3", "constant already")
refuse(changed("dimension = 2", 'dimension = 2\nplane = "plane-stress"', mean), "no formulation locks")
refuse(changed("incompatible", "reduced", bending), r"materials\[0\]\.formulation", "incompatible")


ISOTROPIC = "young = 75e9\npoisson = 0.3"
PLY = "E1 = 135e9\nE2 = 9e9\nnu12 = 0.24\nnu23 = 0.46\nG12 = 5.2e9"
FULL = ("E1 = 135e9\nE2 = 9e9\nE3 = 9e9\nnu12 = 0.24\nnu13 = 0.24\nnu23 = 0.46\n"
        "G12 = 5.2e9\nG13 = 5.2e9\nG23 = 3.082191780821918e9")
UPPER = 'name = "upper"\nthickness = 0.003'
ply = changed(ISOTROPIC, PLY)


def hash_of(text):
    code, out, error = delam("check", write(text))
    expect(code == 0, "a ply: " + error)
    return re.search(r"scene hash +(\w+)", out).group(1) if code == 0 else error


expect(hash_of(ply) == hash_of(changed(ISOTROPIC, FULL)), "the short form of a ply is the full one")
turned = {words: hash_of(changed(UPPER, UPPER + "\n" + words, ply))
          for words in ("angle = 0.0", "angle = 90", "angle = -270.0", "angle = 45.0", "axes = [[0, 0, 2], [1, 0, 0]]")}
expect(turned["angle = 90"] == turned["angle = -270.0"] == turned["axes = [[0, 0, 2], [1, 0, 0]]"], "quarter turns are exact")
expect(len(set(turned.values())) == 3, "angles matter")
refuse(changed(ISOTROPIC, "E1 = 135e9\n" + ISOTROPIC), r"materials\[0\]\.young", "either")
refuse(changed("G12 = 5.2e9", "G12 = 5.2e9\nG13 = 5.2e9", ply), r"materials\[0\]\.E3", "missing", "transversely isotropic")
refuse(changed("nu23 = 0.46\n", "", ply), r"materials\[0\]\.nu23", "missing")
refuse(changed("E2 = 9e9", "E2 = -9e9", ply), r"materials\[0\]\.E2", "> 0")
refuse(changed("nu12 = 0.24", "nu12 = 4.0", ply), r"materials\[0\]", "nu12 = 4 is outside", "3.87", "nu21")
refuse(changed("nu23 = 0.46", "nu23 = 1.0", ply), r"materials\[0\]\.nu23", "in \\(-1, 1\\)")
laminates = {words: hash_of(changed(UPPER, UPPER + "\ndivisions = 4\n" + words, ply))
             for words in ("angle = 90", "angles = [90]", "angles = [90, 90]", "angles = [0, 90]", "angles = [90, 0]")}
expect(laminates["angles = [90]"] == laminates["angles = [90, 90]"] == laminates["angle = 90"], "plies of one angle")
expect(len(set(laminates.values())) == 3, "the order of plies matters")
refuse(changed(UPPER, UPPER + "\ndivisions = 4\nangles = [0, 90, 0]", ply), r"layers\[1\]\.angles", "3 plies", "4 cells")
refuse(changed(UPPER, UPPER + "\nangles = [0]\nangle = 0", ply), r"layers\[1\]\.angles", "one of")
refuse(changed(UPPER, UPPER + "\nangle = 45.0\naxes = [[1, 0, 0], [0, 1, 0]]", ply), r"layers\[1\]\.axes", "one of")
refuse(changed(UPPER, UPPER + "\naxes = [[1, 0, 0]]", ply), r"layers\[1\]\.axes", "a list of 2")
refuse(changed(UPPER, UPPER + "\naxes = [[1, 0, 0], [2, 0, 0]]", ply), r"layers\[1\]", "parallel")

HOT = changed("poisson = 0.3", "poisson = 0.3\nexpansion = 2.3e-5")
WARM = '[[patterns]]\nname = "warm"\ntimes = [0, 1]\nvalues = [0, 50]\n'
THERMAL = WARM + '[[thermal]]\npattern = "warm"\n'
STRAIN = WARM + '[[eigenstrains]]\npattern = "warm"\nstrain = [2.3e-5, 2.3e-5, 2.3e-5]\n'
warm = hash_of(changed("[time]", THERMAL + "[time]", HOT))
expect(warm == hash_of(changed("[time]", STRAIN + "[time]")), "expansion times temperature is an eigenstrain")
expect(warm == hash_of(changed("[time]", THERMAL + 'layers = ["lower", "upper"]\n[time]',
                               changed("2.3e-5", "[2.3e-5, 2.3e-5, 2.3e-5]", HOT))), "the same along all axes")
expect(warm != hash_of(changed("[time]", THERMAL + 'layers = ["upper"]\n[time]', HOT)), "one layer is heated")
refuse(changed("[time]", THERMAL + "[time]"), r"thermal\[0\]\.pattern", 'material "arm" of layer "lower" has no expansion')
refuse(changed("[time]", THERMAL + 'layers = ["uper"]\n[time]', HOT), r"thermal\[0\]\.layers", "did you mean 'upper'")
refuse(changed("[time]", THERMAL.replace('pattern = "warm"', 'pattern = "press"') + "[time]", HOT), r"thermal\[0\]",
       "drives prescribed displacements already")
refuse(changed("[time]", STRAIN.replace(", 2.3e-5]", "]") + "[time]"), r"eigenstrains\[0\]\.strain", "2 entries", "3 .*or 6")
refuse(changed("2.3e-5", "[2.3e-5, 0.0]", HOT), r"materials\[0\]\.expansion")

with open("/dev/full", "w", encoding="utf-8") as full:
    for words in (("check", write(SCENE)), ("--help",)):
        done = subprocess.run([DELAM, *words], stdout=full, stderr=subprocess.PIPE, text=True, check=False)
        expect(done.returncode == 3 and "standard output" in done.stderr,
               f"{words[0]} > /dev/full: exit {done.returncode}")
expect_error(delam("run", write(SCENE), "--out", ""), 2, "--out", "empty")
finish()
