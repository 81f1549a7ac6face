# SPDX-License-Identifier: BSD-3-Clause
"""The files of a result, and what happens when they cannot be written."""
import csv
import json
import os
import re
import resource
import subprocess

import decks
import h5py
from support import DELAM, SCENE, brittle, changed, delam, expect, expect_error, finish, folder, read, write

HEADER = ("step,time,load,reaction,stored_bulk,stored_interface,dissipated,stored_interface_slides,dissipated_slides,"
          "work,lower,increment,upper,increment_lower,am_iterations,linear_iterations,"
          "contact_pairs,debonded_length,backtracks")

scene = write(SCENE)
out = os.path.join(folder(), "a", "b")
code, text, _ = delam("run", scene, "--out", out)
expect(code == 0 and "step 20/20" in text, "a run, with plain lines")
files = ["fields.h5", "fields.xdmf", "history.csv", "result.json", "state.bin"]
expect(sorted(os.listdir(out)) == files, "its files and no other")
rows = read(os.path.join(out, "history.csv")).decode().splitlines()
titles = rows[0].split(",")
expect(rows[0].startswith(HEADER) and len(set(titles)) == len(titles), "columns of history.csv")
expect(len(rows) == 22 and all(len(r.split(",")) == len(titles) for r in rows), "rows of history.csv")
values = [[float(x) for x in r.split(",")[:19]] for r in rows[1:]]
expect(values[0][:3] == [0, 0, 0] and values[-1][:3] == [20, 2, 0.006], "first and last row")
expect(all(v[3] > 0 for v in values[1:]), "the reaction is positive")
about = json.loads(read(os.path.join(out, "result.json")))
expect(about["status"] == "complete" and about["steps_done"] == 20, "result.json")
expect(about["unknowns"] == {"primal": 972, "dual": 162}, "numbers of unknowns")
provenance = ("version", "commit", "scene_hash", "scene_file_hash", "options", "command", "started", "ended")
expect(all(about[k] for k in provenance), "provenance")

# The concept is in every file of a result, in the words of the library's options.
concept = about["concept"]
expect(concept["solution"] == "local" and concept["mixity_rule"] == "converged", "the concept in result.json")
expect(all(str(about["options"][k]) == v or float(about["options"][k]) == float(v) for k, v in concept.items()),
       "it is that of the options")
buckling = ["buckling_modes", "buckling_time", "buckling_released"]
expect(titles[-7:] == ["solution", "mixity_rule", "pops", "popped", *buckling] and
       all(",local,converged," in r for r in rows[1:]),
       "the concept in each row of history.csv")
with h5py.File(os.path.join(out, "fields.h5")) as file:
    words = {k: v.decode() if isinstance(v, bytes) else v for k, v in file.attrs.items()}
    expect(all(words[k] == v for k, v in concept.items()), "the concept in fields.h5")
with h5py.File(os.path.join(out, "fields.h5")) as file:
    expect(len(file["steps"]) <= 20 and file["mesh/points"].shape == (486, 3), "steps and mesh in fields.h5")
    last = file["steps/00000020"]
    expect(last["displacement"].shape == (486, 3) and last["stress"].shape == (320, 6), "fields of the bodies")
    zeta = last["interface_0/zeta"][()]
    expect(zeta.shape == (81,) and (zeta[:20] == 0).all() and zeta.max() <= 1, "fields of the interface")
    first = file["steps/00000000/interface_0/zeta"][()]
    expect((first[:20] == 0).all() and (first[20:] == 1).all(), "the pair at the tip of the notch is bonded")
    with open(os.path.join(out, "fields.xdmf"), encoding="utf-8") as xdmf:
        for path in {p.split("<")[0] for p in xdmf.read().split("fields.h5:")[1:]}:
            if path not in file:
                expect(False, "fields.xdmf names " + path)

# What an engineer looks at first: how long the crack is and what drives it. In growth G is the toughness.
last = dict(zip(titles, rows[-1].split(",")))
expect(abs(float(last["energy_release_rate"]) / 250 - 1) < 0.02 and 0.03 < float(last["crack_length"]) < 0.12 and
       float(last["front_mixity"]) > 0.99 and float(last["process_zone_pairs"]) >= 3, "columns of the crack")
# In space the last columns are means along the front: G is within 10 % of the toughness although one or two pairs lie in
# the process zone, and growth dissipates the toughness per area. A straight front has the same G at each of its points.
wide = os.path.join(folder(), "wide")
text_of_wide = decks.hand(False).replace("values = [0, 0.001]", "values = [0, 0.002]")
asked = '[output]\ncolumns = ["energy_release_rate_mean"]\n[time]'
means = ["crack_area", "energy_release_rate_mean", "front_mixity_mean", "process_zone_pairs_mean"]
expect(delam("run", write(text_of_wide.replace("[time]", asked)), "--out", wide)[0] == 0, "a beam in space")
with open(os.path.join(wide, "history.csv"), newline="", encoding="utf-8") as file:
    table = csv.DictReader(file)
    ending = ["energy_release_rate_mean", "solution", "mixity_rule", means[0], *means[2:], "pops", "popped", *buckling]
    expect(table.fieldnames[-11:] == ending, f"last columns {table.fieldnames[-11:]}")
    grown = [{key: float(row[key]) for key in (*means, "energy_release_rate", "dissipated")} for row in table
             if int(row["step"]) >= 10]
rates = [row["energy_release_rate_mean"] for row in grown]
expect(len(rates) == 11 and all(abs(rate / decks.G_I - 1) < 0.1 for rate in rates), f"mean rates {rates}")
expect(all(row["energy_release_rate_mean"] <= row["energy_release_rate"] * (1 + 1e-9) < 1.1 * row["energy_release_rate_mean"]
           for row in grown), "the largest is close to them")
per_area = (grown[-1]["dissipated"] - grown[0]["dissipated"]) / (grown[-1]["crack_area"] - grown[0]["crack_area"])
expect(abs(per_area / decks.G_I - 1) < 0.05, f"dissipated per area {per_area}")
expect(all(row["front_mixity_mean"] < 1e-6 for row in grown), "a beam that opens has no shear at its front")

expect(about["front_unresolved"] == [] and "warning: in " not in text, "a resolved process zone is not mentioned")
# Rotations become large where they count, and a scene that keeps them small is told what it leaves out.
turned = [line for line in text.splitlines() if "rotations are large (kinematics = auto)" in line]
expect(about["rotation_max"] > 0.1 and len(turned) == 1 and "small rotations leave out" in turned[0], f"rotations become large: {turned}")
expect(about["small_rotations"] is None and "(solver.kinematics" not in text and "bodies buckle" not in text, "and leave out nothing")
code, text, _ = delam("run", scene, "--out", folder(), "--set", "solver.kinematics=linear")
expect(code == 0 and re.search(r"cells rotate by up to 0\.15\d rad: .*\(solver.kinematics = .corotational. does not\)", text), "small ones are told of")
blister = read(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../../examples/blister/blister.toml")).decode()
# A rule that large rotations do not know keeps the film flat.
unknown = 'mixity_rule = "variational"'
for line, brief, asks in (("", "false", False), ("", "true", False), ('kinematics = "linear"', "false", False), (unknown, "false", True)):
    flat = folder()
    code, closing, _ = delam("run", write(blister.replace('kinematics = "corotational"', line)), "--out", flat, "--set", "time.steps=2",
                             "--set", "output.fields=[]", "--set", f"output.brief={brief}")
    ended = json.loads(read(os.path.join(flat, "result.json")))
    small = ended["small_rotations"]
    expect((ended["mesh_error"] is None) == (brief == "true"), f"the error of the mesh, brief = {brief}: {ended['mesh_error']}")
    expect(code == 0 and ("the bodies buckle in step" in closing) == (line == ""), f"a film rises, {line or 'default'}: {closing[-300:]}")
    expect(("the stresses at the end are" in closing) == asks and ("delam check` tells why" in closing) == asks, f"or would, {line}: {closing[-300:]}")
    expect(abs(small["buckling_ratio"] / 3.25 - 1) < 0.02 if asks else small is None or small["buckling_ratio"] is None, f"its ratio: {small}")
with h5py.File(os.path.join(out, "fields.h5")) as file:
    point = file["steps/00000020/interface_0"]
    expect(point["front_points"].shape == (1, 3) and abs(point["front_points"][0, 0] - float(last["crack_length"])) < 1e-12 and
           abs(point["front_rates"][0].sum() - float(last["energy_release_rate"])) < 1e-9, "the front in fields.h5")
expect("zone        \"lower-upper\", about" in delam("check", scene)[1], "check predicts the process zone")
weak = write(SCENE.replace("125e9", "125e13").replace("onset = 100.0", "onset = 1.0").replace("250.0", "25.0"))
code, _, error = delam("check", weak)
expect(code == 0 and "a spacing of" in error and '"lower-upper"' in error, "check warns of too few pairs in it")
other = folder()
code, closing, _ = delam("run", weak, "--out", other, "--set", 'output.columns=["stress_xx:upper", "strain_yy", "rotation_max"]')
steps = json.loads(read(os.path.join(other, "result.json")))["front_unresolved"]
expect(code == 0 and steps and "a crack grew with fewer than 3 pairs" in closing, f"unresolved growth in {steps} closes the run")
expect(",stress_xx:upper,strain_yy,rotation_max,solution" in read(os.path.join(other, "history.csv")).decode(), "columns of averages")
expect_error(delam("check", write(changed("steps = 20", 'steps = 4\n[output]\ncolumns = ["stress_xx:middle"]'))), 2, "no such value")

# A law that does not soften keeps its crack far beyond the toughness: both are told, and with energetic solutions neither.
hard = changed('name = "ductile"', 'name = "ductile"\nkind = "griffith"')
hard = "".join(line for line in hard.splitlines(True) if "onset" not in line)
for solution, told in (("local", True), ("energetic", False)):
    waits = folder()
    code, closing, words = delam("run", write(hard), "--out", waits, "--set", "time.steps=4", "--set", f'solver.solution="{solution}"',
                                 "--set", "laws.0.normal_stiffness=1e16", "--set", "laws.0.tangential_stiffness=1e16")
    times = json.loads(read(os.path.join(waits, "result.json")))["energy_release_rate_over_toughness"]
    expect(("the law does not soften" in closing + words) == told and (times is not None and times > 1.25) == told and
           ("times the largest toughness" in closing) == told, f"{solution}: {times}, {closing[-400:]}")

two = changed("[[loads]]", '[[patterns]]\nname = "side"\ntimes = [0, 2]\nvalues = [0, 1]\n[[forces]]\n'
              'point = [0.03, 0.006]\nforce = [0.0, -100.0]\npattern = "side"\n[[loads]]')
two = changed("steps = 20", 'steps = 4\n[output]\nevery = 3\nsnapshots = [1.0]\ncolumns = ["front"]', two)
other = folder()
expect(delam("run", write(two), "--out", other)[0] == 0, "two patterns and a dead force")
rows = read(os.path.join(other, "history.csv")).decode().splitlines()
several = HEADER.replace("load,reaction", "load_press,reaction_press,load_side,reaction_side")
expect(rows[0].startswith(several) and rows[0].endswith(",".join([",load_potential,front,solution,mixity_rule,pops,popped", *buckling])),
       "columns with several patterns and dead forces")
with h5py.File(os.path.join(other, "fields.h5")) as file:
    expect(sorted(file["steps"]) == ["00000000", "00000002", "00000003", "00000004"],
           "every third step, snapshot and last")


coarse = changed("h = 0.0015", "h = 0.003", changed("steps = 20", "steps = 2"))
for cell, nodes, topology in (("tri6", 6, "Triangle_6"), ("quad8", 8, "Quadrilateral_8"), ("quad9", 9, "Quadrilateral_9")):
    other = folder()
    expect(delam("run", write(changed("dimension = 2", f'dimension = 2\ncell = "{cell}"', coarse)), "--out", other)[0] == 0,
           f"a run with {cell}")
    with h5py.File(os.path.join(other, "fields.h5")) as file:
        expect(file["mesh/cells"].shape == (160 if nodes == 6 else 80, nodes), f"cells of {cell}")
        expect(file["interfaces/interface_0/faces"].shape == (40, 3), f"faces of {cell}")
    xdmf = read(os.path.join(other, "fields.xdmf")).decode()
    expect(f'TopologyType="{topology}"' in xdmf and 'TopologyType="Edge_3"' in xdmf, f"XDMF names {topology}")


def violated(out_folder, eta):
    """The rule, from the rows."""
    lines = read(os.path.join(out_folder, "history.csv")).decode().splitlines()
    table = [dict(zip(lines[0].split(",")[:19], map(float, line.split(",")[:19]))) for line in lines[2:]]
    return [int(r["step"]) for r in table
            if max(r["lower"] - r["increment_lower"], r["increment"] - r["upper"]) >
            eta * max(abs(r["stored_bulk"] + r["stored_interface"]), abs(r["work"]))]


def line_of(steps):
    return "two-sided estimate violated in steps: " + ", ".join(map(str, steps)) + " (tolerance eta ="


expect(about["estimate_violated"] == violated(out, 1e-3), "the two-sided estimate at the default tolerance")
expect(("two-sided" in text) == bool(violated(out, 1e-3)), "a closing line only where it is violated")
strict = write(changed("steps = 20", "steps = 20\n[solver]\nbacktracking_tolerance = 1e-9", brittle()))
close = folder()
code, text, _ = delam("run", strict, "--out", close)
steps = violated(close, 1e-9)
expect(code == 0 and steps and line_of(steps) in text, f"violated in {steps}: the closing line names them")
expect(json.loads(read(os.path.join(close, "result.json")))["estimate_violated"] == steps, "so does result.json")
expect(line_of(steps) in delam("run", strict, "--out", close, "--resume")[1], "and a resumed run")
with open("/dev/full", "w", encoding="utf-8") as full:
    blind = folder()
    done = subprocess.run([DELAM, "run", strict, "--out", blind], stdout=full, stderr=subprocess.PIPE, text=True,
                          check=False)
    expect(done.returncode == 3 and "standard output" in done.stderr, f"run > /dev/full: exit {done.returncode}")
    expect(read(os.path.join(blind, "history.csv")) == read(os.path.join(close, "history.csv")), "the result is whole")

limited = changed("steps = 20", "steps = 8\n[solver]\nminimisation_limit = 1")
stiff = folder()
expect_error(delam("run", write(limited), "--out", stiff), 1, "did not converge")
expect(json.loads(read(os.path.join(stiff, "result.json")))["not_converged"], "the steps are listed")

# As root every folder is writable, but nothing can be below a file.
expect_error(delam("run", scene, "--out", scene + "/out"), 3, "cannot write .*scene.toml/out")

# A full disk, small enough to fail in the analysis and then while the result is put together; the earlier result stays.
before = {name: read(os.path.join(out, name)) for name in os.listdir(out)}
largest = max(len(b) for b in before.values())
for limit in (1000, 20000, largest - 1000):
    answer = delam("run", scene, "--out", out,
                   preexec_fn=lambda n=limit: resource.setrlimit(resource.RLIMIT_FSIZE, (n, n)))
    # Before the first state is saved there is nothing to promise; the fields of the initial state take more than 20 kB.
    expect_error(answer, 3, "cannot write .*running/", "File too large",
                 r"\d+ of 2\d finished steps are saved in .*--resume" if limit > 20000 else "nothing is saved yet")
    after = {name: read(os.path.join(out, name)) for name in os.listdir(out) if name != "running"}
    expect(after == before, f"files of at most {limit} bytes: the earlier result stays")
code, text, _ = delam("run", scene, "--out", out, "--resume")
expect(code == 0 and read(os.path.join(out, "history.csv")) == before["history.csv"], "resumed once there is room")
expect("running" not in os.listdir(out), "nothing is left over")

# Full in the middle of a run that is over within a second: it goes on from its first step, and says so.
many = write(changed("steps = 20", "steps = 200\n[output]\nevery = 1000\nsnapshots = [2.0]"))
straight, halted = folder(), folder()
expect(delam("run", many, "--out", straight)[0] == 0, "200 steps")
answer = delam("run", many, "--out", halted, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (50000, 50000)))
expect_error(answer, 3, "cannot write .*running/history.csv", r"\n\d+ of \d\d+ finished steps are saved in .*running; once",
             "go on with: delam run .* --resume")
code, text, _ = delam("run", many, "--out", halted, "--resume")
expect(code == 0 and "resumed after step" in text, "it goes on once there is room: " + text.split("\n")[1])
expect(read(os.path.join(halted, "history.csv")) == read(os.path.join(straight, "history.csv")), "to the same end")
finish()
