# SPDX-License-Identifier: BSD-3-Clause
"""delam sweep and delam fit: tables, resuming, and messages for wrong words."""
import csv
import os
import re
import shutil
import signal
import subprocess
import time

import numpy as np
from support import DELAM, SCENE, changed, expect, expect_error, finish, folder, start, write


def table(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def write_lines(path, *lines):
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")
    return path


def sweeps():
    scene = write(changed("steps = 20", 'steps = 5\n[solver]\nkinematics = "linear"'))
    out = os.path.join(folder(), "sweep")
    words = ["sweep", scene, "--vary", "laws.0.tangential_toughness=200:400:3", "--vary",
             "laws.0.kind=piecewise-linear,exponential", "--set", "laws.0.normal_toughness=400", "--out", out, "--jobs", "2"]
    code, shown, error = start(*words)
    expect(code == 0 and "wrote" in shown, f"a sweep over a grid: {error}")
    rows = table(os.path.join(out, "table.csv"))
    points = [(float(row["laws[0].tangential_toughness"]), row["laws[0].kind"]) for row in rows]
    expect(points == [(g, k) for g in (200, 300, 400) for k in ("piecewise-linear", "exponential")], f"all points: {points}")
    alone = os.path.join(folder(), "alone")
    code, _, error = start("run", scene, "--out", alone, "--set", "laws[0].tangential_toughness=300", "--set",
                           "laws[0].kind=exponential", "--set", "laws[0].normal_toughness=400")
    history = table(os.path.join(alone, "history.csv"))
    peak = max(float(row["reaction"]) for row in history)
    expect(float(rows[3]["peak_reaction"]) == peak and rows[3]["exit_code"] == "0", "a row has the numbers of its run")
    # Runs of a job share the condensed bodies; its results are those of a run alone, digit by digit.
    expect(history == table(os.path.join(out, rows[3]["run"].zfill(4), "history.csv")), "the history of a run is that of the run alone")
    expect(all(os.path.getsize(os.path.join(out, name)) > 5000 for name in ("curves.png", "response.png")), "pictures")

    expect(all(row["warnings"] == "1" for row in rows) and shown.count("warning of 6 of 6 runs (1, 2, 3, 4, 5, 6): ") == 1, f"warnings: {shown}")
    marked = os.path.join(out, "0003", "state.bin")
    before = os.stat(marked).st_mtime_ns
    shutil.rmtree(os.path.join(out, "0005"))
    code, _, error = start(*words)
    expect(code == 0 and os.stat(marked).st_mtime_ns == before and os.path.exists(os.path.join(out, "0005", "result.json")),
           f"the same command computes what is missing alone: {error}")
    expect(table(os.path.join(out, "table.csv")) == rows, "and the table is the same")
    other = [word.replace("200:400:3", "200:400:2") for word in words]
    expect_error(start(*other), 2, "holds another sweep, with other values: --replace")
    with open(os.path.join(out, "notes.txt"), "w", encoding="utf-8") as file:
        file.write("mine")
    code, _, error = start(*other, "--replace")
    expect(code == 0 and not os.path.exists(os.path.join(out, "0005")) and os.path.exists(os.path.join(out, "notes.txt")),
           f"--replace discards its runs and nothing else: {error}")

    named = write(changed("steps = 20", "steps = 5").replace("[geometry]", '[units]\nlength = "m"\nforce = "N"\n[geometry]', 1))
    code, shown, error = start("sweep", named, "--vary", "laws.0.tangential_toughness=300,400", "--out", out + "-units")
    expect("tangential_toughness 300 N/m  peak" in shown and re.search("peak [0-9.e+]* N/m  left", shown), f"units of the scene: {shown} {error}")

    code, shown, error = start("sweep", scene, "--vary", "laws.0.normal_toughness=50:250:3", "--out", out + "2")
    failed = table(os.path.join(out + "2", "table.csv"))[0]
    expect(code == 1 and failed["exit_code"] == "2" and "normal_toughness 50 < normal_onset 100" in failed["message"],
           f"a run that fails is a row with its message: {failed}")
    code, shown, error = start("sweep", scene, "--vary", "laws.0.normal_toughness=150:350", "--vary",
                               "materials.0.young=5e10:1e11:log", "--latin", "4", "--out", out + "3")
    values = np.array([[float(row["laws[0].normal_toughness"]), float(row["materials[0].young"])]
                       for row in table(os.path.join(out + "3", "table.csv"))])
    strata = [sorted(np.floor((values[:, 0] - 150) / 50)), sorted(np.floor(np.log2(values[:, 1] / 5e10) * 4))]
    expect(code == 0 and strata == [[0, 1, 2, 3]] * 2, f"a Latin hypercube has one point in each part: {values} {error}")


def interrupted_sweep():
    scene = write(changed("h = 0.0015", "h = 0.0005", changed("steps = 20", "steps = 2000")))
    out = os.path.join(folder(), "sweep")
    words = [DELAM, "sweep", scene, "--vary", "laws.0.normal_toughness=250:260:2", "--out", out]
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as child:
        deadline = time.monotonic() + 60
        while not os.path.exists(os.path.join(out, "0001", "running", "state.bin")) and time.monotonic() < deadline:
            time.sleep(0.05)
        child.send_signal(signal.SIGTERM)
        _, error = child.communicate(timeout=60)
    expect(child.returncode == 130 and "the same command goes on" in error, f"a sweep is interrupted: {error}")
    expect(not os.path.exists(os.path.join(out, "0002")), "no further run begins")
    # In the background of a script a shell has its programs ignore Ctrl-C.
    scene = write(changed("h = 0.0015", "h = 0.003", changed("steps = 20", "steps = 60")))
    words = [DELAM, "sweep", scene, "--vary", "laws.0.normal_toughness=250:260:2", "--out", out + "2"]
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_IGN)) as child:
        deadline = time.monotonic() + 60
        while not os.path.exists(os.path.join(out + "2", "0001")) and time.monotonic() < deadline:
            time.sleep(0.01)
        child.send_signal(signal.SIGINT)
        _, error = child.communicate(timeout=60)
    expect(child.returncode == 0, f"a sweep that was told to ignore Ctrl-C goes on: {child.returncode} {error}")


# Two squares, one above the other, each with its own nodes at the interface.
SQUARES = """*NODE
1, 0, 0
2, 1, 0
3, 1, 1
4, 0, 1
5, 0, 1
6, 1, 1
7, 1, 2
8, 0, {top}
*ELEMENT, TYPE=CPE4, ELSET=LOWER
1, 1, 2, 3, 4
*ELEMENT, TYPE=CPE4, ELSET=UPPER
2, 5, 6, 7, 8
*NSET, NSET=BOTTOM
1, 2
*NSET, NSET=TOP
7, 8
"""


def changed_mesh():
    """The mesh is a file of its own, and the scene's text stays the same."""
    here = folder()
    mesh, scene, out = (os.path.join(here, name) for name in ("squares.inp", "scene.toml", "sweep"))

    def write_mesh(top):
        with open(mesh, "w", encoding="utf-8") as file:
            file.write(SQUARES.format(top=top))

    law = "\n".join(f"{mode}_{key}" for mode in ("normal", "tangential")
                    for key in ("stiffness = 100.0", "onset = 1.0", "toughness = 2.0"))
    with open(scene, "w", encoding="utf-8") as file:
        file.write(f"""schema = 1
mesh = {{ file = "squares.inp" }}
materials = [{{ name = "m", young = 8.0, poisson = 0.0 }}]
bodies = [{{ name = "*", material = "m" }}]
interfaces = [{{ all = true, law = "law" }}]
supports = [{{ set = "BOTTOM", fix = ["x", "y"] }}]
patterns = [{{ name = "p", times = [0, 1], values = [0, 0.001] }}]
loads = [{{ set = "TOP", component = ["y"], pattern = "p" }}]
time = {{ end = 1.0, steps = 1 }}
[[laws]]
name = "law"
{law}
""")
    words = ["sweep", scene, "--vary", "laws.0.normal_toughness=2,3", "--out", out]
    write_mesh(2)
    code, _, error = start(*words)
    expect(code == 0, f"a sweep over a mesh of a file: {error}")
    rows = table(os.path.join(out, "table.csv"))
    write_mesh(2.5)
    expect_error(start(*words), 2, "holds another sweep, with another mesh: --replace")
    expect(table(os.path.join(out, "table.csv")) == rows, "its table stays")
    code, _, error = start(*words, "--replace")
    expect(code == 0 and table(os.path.join(out, "table.csv")) != rows, f"--replace computes it with the new mesh: {error}")


def wrong_words():
    scene = write(SCENE)
    out = os.path.join(folder(), "out")

    def refused(pattern, *words):
        expect_error(start(*words, "--out", out), 2, pattern)
        expect(not os.path.exists(out), "and nothing is written")

    refused("no key of a scene", "sweep", scene, "--vary", "laws[0=1:2:3")
    refused("FROM:TO:NUMBER", "sweep", scene, "--vary", "laws.0.normal_onset=1:2")
    refused("must be less", "sweep", scene, "--vary", "laws.0.normal_onset=2:1:3")
    refused("more than 0 for log", "sweep", scene, "--vary", "laws.0.normal_onset=0:1:3:log")
    refused("at least 2 values", "sweep", scene, "--vary", "laws.0.normal_onset=1:2:1")
    refused(r"\"0.3-0.7\" is no value: .* 0.3:0.7:5, .* 0.3,0.5,0.7", "sweep", scene, "--vary", "laws.0.normal_toughness=0.3-0.7")
    refused("no run is a scene, e.g. .*unknown key.*'normal_toughness'", "sweep", scene, "--vary", "laws.0.normal_tougness=250,300")
    refused("no run is a scene, e.g. .*normal_toughness 50 < normal_onset 100", "sweep", scene, "--vary",
            "laws.0.normal_toughness=50:90:3")
    refused("given twice", "sweep", scene, "--vary", "time.end=1,2", "--vary", "time.end=3,4")
    refused("cannot be read", "sweep", "/nowhere/a.toml", "--vary", "time.end=1,2")
    data = os.path.join(folder(), "data.csv")

    def with_data(text, pattern, *words):
        with open(data, "w", encoding="utf-8") as file:
            file.write(text)
        refused(pattern, "fit", scene, "--data", data, "--parameters", *(words or ["laws.0.normal_toughness"]))

    good = "load,force\n0.001,1\n0.002,2\n"
    with_data("", "the file is empty")
    with_data("load,force\n0.001,1\n", "at least 2 points")
    with_data("load,force\n0.002,1\n0.002,2\n", "\"load\" must increase")
    with_data("load,force\n0.002,2\n0.001,1\n", "\"load\" must increase")
    with_data("load,force\n0.001,1\n0.002,x\n", "row 2 of the numbers")
    with_data("load,force\n0.001,1\n0.002,inf\n", "is inf: 0, or a finite number")
    with_data("load,force\n1.0,1\n2.0,2\n", "goes from 1 to 2, .* from 0 to 0.006: let the values .* are the units the same")
    with_data("time,force\n1.0,1\n20,2\n", r'time \("time"\) goes from 1 to 20, .* from 0 to 2: give it a later end .* are the units the same', "laws.0.normal_toughness", "--x", "time")
    with_data(good, "no column \"strain\"", "laws.0.normal_toughness", "--columns", "strain", "force")
    with_data("Weg (mm),Kraft (N)\n0.1,1\n0.2,2\n", "\"Weg\" in mm is no y to compare with \"reaction\" of the scene: a force or a force per length",
              "laws.0.normal_toughness", "--columns", "Kraft", "Weg")
    with_data(good, "must be less than the upper", "laws.0.normal_toughness=2:1")
    with_data(good, "not between 300 and 400", "laws.0.normal_toughness=300:400")
    with_data(good, "no number", "solver.damage_tolerance")
    with_data(good, r"laws\[0\].plateau: is for kind trapezoidal", "laws.0.plateau")
    with_data(good, r"laws\[0\].toughness: unknown key .*'normal_toughness'", "laws.0.toughness")
    with_data(good, r"laws\[0\].toughness: unknown key .*'normal_toughness'", "laws.0.toughness@200")
    with_data(good, "laws has 1 entry, counted from 0", "laws.3.normal_toughness")
    refused("2 curves for 1 scene:", "fit", scene, "--data", data, data, "--parameters", "laws.0.normal_toughness")
    # Names of columns are known when an analysis has ended.
    expect_error(start("fit", scene, "--data", data, "--parameters", "laws.0.normal_toughness", "--y", "reactoin", "--out", out), 2,
                 "no column \"reactoin\"")


def without_packages():
    study = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "study")
    for name, needed in (("sweep", "numpy, matplotlib"), ("fit", "numpy, scipy, matplotlib")):
        done = subprocess.run(["/usr/bin/python3", "-S", os.path.join(study, name + ".py"), "{}"], capture_output=True, text=True,
                              check=False)
        expect(done.returncode == 2 and done.stderr.startswith(f"delam: {name}: /usr/bin/python3 has no {needed};") and
               "python3-" + needed.replace(", ", ", python3-") in done.stderr and done.stderr.count("\n") == 1,
               f"without packages: {done.stderr}")


for part in (sweeps, interrupted_sweep, changed_mesh, wrong_words, without_packages):
    part()
finish()
