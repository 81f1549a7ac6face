# SPDX-License-Identifier: BSD-3-Clause
"""examples/run.sh: which names it knows, what it would run for each; the families of PANM 15 are checked, the other scenes are
run at a coarse size: those of SHORT here, all with the word "whole" (the long tier)."""
import os
import shlex
import subprocess
import sys

from coarse_scenes import COARSE, STIFF, coarse_run, scene_file, sound
from support import delam, draw, expect, finish

EXAMPLES = os.environ["DELAM_EXAMPLES"]
SIZES = ("1.0", "0.75", "0.5", "0.25", "0.1")
FAMILIES = ("enf-ductile", "enf-brittle-local", "enf-brittle-energetic", "mmf-ductile", "mmf-ductile-640",
            "mmf-ductile-converged", "mmf-brittle-energetic")


# Scenes whose pictures are drawn here, with those beyond the usual ones: each kind once.
PICTURES = {"fibre": ["stress-strain.png"], "laminate-thermal": ["stresses.png"], "dcb-3d": ["fronts.png", "cut.png"],
            "weave": ["stress-strain.png", "fronts.png", "cut.png"]}
WHOLE = sys.argv[1:] == ["whole"]
# These take a second or two each; the others are checked. test_plot draws fronts.
SHORT = {"dcb-3d", "dcb-abaqus", "dcb-elastica", "peel", "blister", "lap-joint", "enf-3d", "mmb", "fibre",
         "laminate-thermal"}
SHORT_PICTURES = {"fibre"}
SHORT_MESH = {"weave": ["mesh.h=0.9e-3", "mesh.gap=0.1e-3"]}


def script(*words):
    done = subprocess.run(["bash", os.path.join(EXAMPLES, "run.sh"), *words], capture_output=True, text=True,
                          check=False)
    return done.returncode, done.stdout, done.stderr


code, out, _ = script("--list")
names = out.split()
expected = {"enf", "enf-modified", "enf-modified-h0.1", *COARSE, *FAMILIES, *(f"{f}-h{h}" for f in FAMILIES for h in SIZES)}
expect(code == 0 and len(names) == len(set(names)) and set(names) == expected, "--list names all scenes, each once")

code, out, _ = script("--dry-run")
expect(code == 0 and "examples/enf/enf.toml --out out/enf\n" in out, "enf without a name")
code, out, _ = script("--dry-run", "mmf-ductile-640-h0.75")
runs = [line for line in out.splitlines() if " run " in line]
expect(code == 0 and len(runs) == 1 and
       runs[0].endswith("run examples/mmf-ductile-640/mmf-ductile-640.toml --out out/mmf-ductile-640-h0.75 "
                        "--set geometry.h=0.75e-3"), f"a size of a family: {runs}")
expect("plot.py out/mmf-ductile-640-h0.75" in out and "plot_family" not in out, "its pictures")
code, out, _ = script("--dry-run", "mmf-ductile")
expect(code == 0 and [f"out/mmf-ductile-h{h} " in out for h in SIZES] == [True] * 5, "a family runs all of its sizes")
expect("plot_family.py --out out/mmf-ductile " + " ".join(f"out/mmf-ductile-h{h}" for h in SIZES) in out,
       "and compares them")
code, out, _ = script("--dry-run", "enf", "enf-modified")
expect(code == 0 and "out/enf\n" in out and "out/enf-modified-h0.1 " in out and "plot_family" not in out,
       "several names; one size is not compared")
for name in ("fly", "enf-h1.0", "enf-ductile-h1", "enf-ductile-h2.0", "enf-modified-h1.0", "enf ", "*", ""):
    code, out, error = script("--dry-run", "enf", name)
    expect(code == 2 and out == "" and f'unknown scene "{name}"' in error and
           "enf-ductile-h{1.0,0.75,0.5,0.25,0.1}" in error, f'"{name}" is refused, and the known ones are listed')
expect(script("--fast")[0] == 2, "an unknown option is refused")
code, out, _ = script("enf", "--set", "time.steps=2", "dcb-3d", "--set", "geometry.divisions=[194,300]", "--resume", "--set",
                      "title=a b", "--out", "out/large", "mmf-ductile-h1.0", "--set", "time.end=1", "--dry-run")
runs = [line for line in out.splitlines() if " run " in line]
here = os.path.join(os.getcwd(), "out/large")  # a relative folder is in that of the call
words = [shlex.split(line)[2:] for line in runs]
expect(code == 0 and words == [
    ["examples/enf/enf.toml", "--out", "out/enf", "--set", "time.steps=2"],
    ["examples/dcb-3d/dcb-3d.toml", "--out", here, "--set", "geometry.divisions=[194,300]", "--resume", "--set",
     "title=a b"],
    ["examples/mmf-ductile/mmf-ductile.toml", "--out", "out/mmf-ductile-h1.0", "--set", "geometry.h=1.0e-3", "--set",
     "time.end=1"]], f"options belong to the name before them: {runs}")
expect(f"plot.py {shlex.quote(here)}\n" in out, "pictures in the folder of --out")
code, out, _ = script("--dry-run", "mmf-ductile", "--set", "time.steps=2")
expect(code == 0 and out.count(" --set time.steps=2\n") == 5, "options of a family go to all of its sizes")
for words in (["--set", "a=1"], ["enf", "--set"], ["enf", "--set", "a"], ["enf", "--out", ""], ["enf", "--out", "--resume"],
              ["mmf-ductile", "--out", "out/a"], ["enf", "--out", "a", "mmb", "--out", "a"]):
    code, out, error = script("--dry-run", *words)
    expect(code == 2 and out == "" and error, f"{words} is refused")

code, out, _ = script("--dry-run", "dcb-abaqus")
expect(code == 0 and "run examples/dcb-abaqus/dcb-abaqus.inp --out out/dcb-abaqus\n" in out, "a deck of Abaqus is run as it is")
made = subprocess.run([sys.executable, os.path.join(EXAMPLES, "dcb-abaqus", "make_deck.py")], capture_output=True, text=True,
                      check=True).stdout
with open(scene_file(EXAMPLES, "dcb-abaqus"), encoding="utf-8") as file:
    expect(made == file.read(), "make_deck.py writes the deck of dcb-abaqus")

for family in (*FAMILIES, "enf-modified", "enf"):
    path = os.path.join(EXAMPLES, family, family + ".toml")
    for h in SIZES[:1] if family == "enf" or not WHOLE else SIZES[:3]:
        code, out, error = delam("check", path, "--set", f"geometry.h={h}e-3")
        dofs = {"1.0": "1936 primal, 242 dual", "0.75": "3220 primal, 322 dual", "0.5": "6748 primal, 482 dual"}[h]
        expect(code == 0 and dofs in out, f"{family}, h = {h} mm: the unknowns of PANM 15 {error.strip()}")
        if family != "enf":
            concept = "energetic" if "energetic" in family or "modified" in family else "local"
            rule = "converged" if "converged" in family or family == "mmf-brittle-energetic" else "frozen"
            expect(f"solution = {concept}, mixity_rule = {rule}" in out, f"{family}: {concept}, {rule}")

stiff, settings, checks = STIFF
for name, settings, checks in (*((name, *row) for name, row in COARSE.items()),
                               (stiff, [*settings, "layers[0].divisions=2", "layers[1].divisions=2"], checks)):
    scene = scene_file(EXAMPLES, name)
    if not WHOLE and name not in SHORT and checks is COARSE[name][1]:
        settings = [*settings, *SHORT_MESH.get(name, [])]
        code, _, error = delam("check", scene, *(word for setting in settings for word in ("--set", setting)))
        expect(code == 0, f"{name} is sound {error.strip()}")
        continue
    run = coarse_run(scene, settings)
    for check in (sound, *checks) if run else ():
        check(name, run)
    if run and name in PICTURES and (WHOLE or name in SHORT_PICTURES):
        code, error = draw("plot", run.out)
        made = {picture for picture in os.listdir(run.out) if picture.endswith(".png")}
        wanted = {"load-displacement.png", "energies.png", "snapshots.png", *PICTURES[name]}
        small = [p for p in made if os.path.getsize(os.path.join(run.out, p)) < 10000]
        expect(code == 0 and made == wanted and not small, f"{name}: pictures {sorted(made)} {error.strip()[-200:]}")
finish()
