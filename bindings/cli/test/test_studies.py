# SPDX-License-Identifier: BSD-3-Clause
"""delam sweep and delam fit: tables, resuming, what is found from curves, and messages for wrong words."""
import csv
import json
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import time

import numpy as np
from strip import strip
from support import DELAM, SCENE, changed, expect, expect_error, finish, folder, start, write

# A strip that is peeled; its zone has a dozen pairs.
PEEL = strip("""normal_stiffness = 1e13
tangential_stiffness = 1e13
normal_strength = 1.2e7
tangential_strength = 1.2e7
normal_toughness = 200.0
tangential_toughness = 400.0
""", """[[patterns]]
name = "lift"
times = [0, 1]
values = [0, 4e-4]
[[loads]]
point = [0.0, 0.002]
component = ["y"]
pattern = "lift"
""", """[time]
end = 1.0
steps = 40
[output]
every = 100
""")
TRUTH = {"laws[0].normal_toughness": 200.0, "laws[0].normal_strength": 1.2e7}


def table(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def curve(path, rows, noise=0.0, seed=1, scale=1.0, every=2):
    """What a test machine might write: with a header, and every second point."""
    errors = random.Random(seed)
    with open(path, "w", encoding="utf-8") as file:
        file.write("# specimen 7\ndisplacement;force\n")
        for row in rows[2::every]:
            force = float(row["reaction"]) * (1 + noise * errors.gauss(0, 1)) * scale
            file.write(f"{float(row['load'])!r};{force!r}\n")
    return path


def write_lines(path, *lines):
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")
    return path


def sweeps():
    scene = write(changed("steps = 20", "steps = 5"))
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
    expect(all(os.path.getsize(os.path.join(out, name)) > 5000 for name in ("curves.png", "response.png")), "pictures")

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
    with_data("", "no numbers")
    with_data("load,force\n0.001,1\n", "at least 2 points")
    with_data("load,force\n0.002,1\n0.001,2\n", "load must increase")
    with_data("load,force\n0.001,1\n0.002,x\n", "row 2 of the numbers")
    with_data("load,force\n0.001,1\n0.002,inf\n", "is inf: 0, or a finite number")
    with_data("load,force\n1.0,1\n2.0,2\n", "goes from 1 to 2, .* from 0 to 0.006: other units")
    with_data("time,force\n1.0,1\n20,2\n", "time goes from 1 to 20, .* from 0 to 2: other units", "laws.0.normal_toughness", "--x", "time")
    with_data(good, "no column \"strain\"", "laws.0.normal_toughness", "--columns", "strain", "force")
    with_data(good, "must be less than the upper", "laws.0.normal_toughness=2:1")
    with_data(good, "not between 300 and 400", "laws.0.normal_toughness=300:400")
    with_data(good, "no number", "solver.damage_tolerance")
    with_data(good, r"laws\[0\].plateau: is for kind trapezoidal", "laws.0.plateau")
    with_data(good, r"laws\[0\].toughness: unknown key .*'normal_toughness'", "laws.0.toughness")
    with_data(good, r"laws\[0\].toughness: unknown key .*'normal_toughness'", "laws.0.toughness@200")
    with_data(good, "laws has 1 entry, counted from 0", "laws.3.normal_toughness")
    refused("2 curves for 1 scenes", "fit", scene, "--data", data, data, "--parameters", "laws.0.normal_toughness")
    # Names of columns are known when a march has ended.
    expect_error(start("fit", scene, "--data", data, "--parameters", "laws.0.normal_toughness", "--y", "reactoin", "--out", out), 2,
                 "no column \"reactoin\"")


def fits():
    """Without noise the truth, with its derivatives; a modulus by differences."""
    scene, out = write(PEEL), os.path.join(folder(), "out")
    code, _, error = start("run", scene, "--out", out)
    expect(code == 0, f"the truth: {error}")
    rows = table(os.path.join(out, "history.csv"))
    expect(not any(float(row["jumps"]) for row in rows), "it has no jumps")
    data = curve(os.path.join(folder(), "curve.csv"), rows, scale=0.02)
    fit = os.path.join(folder(), "fit")
    words = ["--data", data, "--scale", "50", "--set", "solver.damage_tolerance=1e-9"]
    code, shown, error = start("fit", scene, *words, "--parameters", "laws.0.normal_toughness=100:500@260",
                               "laws.0.normal_strength=5e6:3e7@1.5e7", "--out", fit)
    expect(code == 0, f"a fit: {error}")
    with open(os.path.join(fit, "fit.json"), encoding="utf-8") as file:
        found = json.load(file)
    for row in found["parameters"]:
        truth = TRUTH[row["key"]]
        expect(abs(row["value"] - truth) < 1e-5 * truth, f"{row['key']} is found: {row}")
    expect(found["marches"] <= 25, f"few marches, for they have derivatives: {found['marches']}")
    expect("95 % interval" in shown and os.path.getsize(os.path.join(fit, "fit.png")) > 5000, "words and a picture")
    residuals = [float(row["residual"]) for row in table(os.path.join(fit, "fit.csv"))]
    expect(len(residuals) == 20 and max(map(abs, residuals)) < 1e-2 * max(float(r["reaction"]) for r in rows),
           "residuals are listed")
    code, shown, error = start("fit", scene, *words, "--parameters", "materials.0.young=1e10:1e12@60e9", "--out", fit)
    with open(os.path.join(fit, "fit.json"), encoding="utf-8") as file:
        young = json.load(file)["parameters"][0]["value"]
    expect(code == 0 and abs(young - 70e9) < 1e-3 * 70e9, f"a modulus: {young} {error}")
    code, shown, error = start("fit", scene, *words, "--parameters", "laws.0.normal_toughness",
                               "output.displacement_scale@5", "--out", fit)
    expect(code == 4 and "does not depend on output.displacement_scale for load from" in error and "toughness" not in error,
           f"a parameter that changes nothing is named: {error}")
    # Metres for kilometres: all of the data lie where nothing is damaged.
    short = write_lines(data + "2", "load,force", "1e-7,1", "2e-7,2", "4e-7,4")
    code, shown, error = start("fit", scene, "--data", short, "--parameters", "laws.0.normal_toughness", "--out", fit)
    expect(code == 4 and re.search("warning: .* load ends at 4e-07, that of .* at 0.0004: other units", error) and
           "does not depend on laws[0].normal_toughness for load from 1e-07 to 4e-07: " in error and "apart" not in error,
           f"one parameter, and data in other units: {error}")


def without_packages():
    study = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "study")
    for name, needed in (("sweep", "numpy, matplotlib"), ("fit", "numpy, scipy, matplotlib")):
        done = subprocess.run(["/usr/bin/python3", "-S", os.path.join(study, name + ".py"), "{}"], capture_output=True, text=True,
                              check=False)
        expect(done.returncode == 2 and done.stderr.startswith(f"delam: {name}: /usr/bin/python3 has no {needed};") and
               "python3-" + needed.replace(", ", ", python3-") in done.stderr and done.stderr.count("\n") == 1,
               f"without packages: {done.stderr}")


def rugged():
    """A curve that depends on its parameter in ripples: its interval is doubted, and less misfit beside it is taken."""
    import fit  # pylint: disable=import-outside-toplevel
    from types import SimpleNamespace  # pylint: disable=import-outside-toplevel

    class Made(fit.Fit):
        """Lines of several slopes through p + ripple sin(25 p), and noise. The truth is 1.6."""

        def __init__(self, ripple):  # pylint: disable=super-init-not-called
            parameter = SimpleNamespace(path="p", start=1.0, lower=0.2, upper=5.0)
            self.model = SimpleNamespace(parameters=[parameter], data=[None])
            self.start, self.y, self.slopes = np.ones(1), np.zeros(40), np.linspace(0.2, 1, 40)
            self.noise, self.ripple = 0.05 * np.random.default_rng(3).standard_normal(40), ripple

        def _at(self, scaled):
            p = scaled[0]
            moved = p - 1.6 + self.ripple * (np.sin(25 * p) - np.sin(25 * 1.6))
            return moved * self.slopes + self.noise, (self.slopes * (1 + 25 * self.ripple * np.cos(25 * p)))[:, None]

    for ripple, doubted in ((0.0, []), (0.02, []), (0.05, ["p"])):
        found, said = Made(ripple).best(0.95)
        expect(said == doubted and abs(found.x[0] - 1.6) < 0.02, f"ripples of {ripple}: {said}, p = {found.x[0]}")
    fitted = Made(0.1)
    once, best = fitted.run(np.ones(1)), fitted.best(0.95)[0]
    expect(np.sum(best.fun ** 2) < 0.9 * np.sum(once.fun ** 2), f"less misfit beside it: {once.cost}, {best.cost}")


def alike():
    """Parameters that move the curve in the same way are named, and no other."""
    import fit  # pylint: disable=import-outside-toplevel
    from marches import Trouble  # pylint: disable=import-outside-toplevel
    from types import SimpleNamespace  # pylint: disable=import-outside-toplevel
    slopes = np.array([[1.0, 1.0, 2.0], [2.0, 0.0, 4.0], [3.0, 1.0, 6.0], [4.0, 1.0, 8.0]])
    model = SimpleNamespace(parameters=[SimpleNamespace(path=name) for name in ("one", "other", "twice")])
    try:
        fit.estimates(SimpleNamespace(model=model, start=np.ones(3)), SimpleNamespace(jac=slopes, x=np.ones(3), fun=np.ones(4)), 0.95)
        said = ""
    except Trouble as trouble:
        said = str(trouble)
    expect("do not tell these parameters apart: one, twice; give fewer" in said, f"parameters that do the same: {said}")


def long_fits():
    """Three mixed-mode bending tests with 2 % of noise; and whether the intervals cover the truth as often as they say."""
    covered, trials = coverage()
    for key, count in covered.items():
        expect(count >= 90, f"{key}: the 95 % intervals of {trials} fits cover the truth {count} times")
    truth = {"laws[0].normal_toughness": 212.0, "laws[0].tangential_toughness": 774.0, "laws[0].toughness_exponent": 2.1}
    here = folder()
    scenes, curves = [], []
    with open(os.path.join(os.environ["DELAM_EXAMPLES"], "mmb", "mmb.toml"), encoding="utf-8") as file:
        bending = file.read()
    for name, ratio, end in (("20", 2.1, 0.006), ("50", 0.826, 0.003), ("80", 0.54, 0.003)):
        text = bending
        for old, new in (("coefficient = 1.826", f"coefficient = {1 + ratio}"),
                         ("coefficient = -0.826", f"coefficient = {-ratio}"), ("values = [0.0, 0.0024]", f"values = [0.0, {end}]"),
                         ("divisions = 500", "divisions = 400"), ("stiffness = 1e15", "stiffness = 1e14"),
                         ("normal_onset = 1.8", "normal_strength = 3e7"),
                         ("tangential_onset = 6.572", "tangential_strength = 5e7")):
            text = changed(old, new, text) if old != "stiffness = 1e15" else text.replace(old, new)
        scenes.append(write(text))
        out = os.path.join(here, name)
        # As dense as a test machine writes; with 40 points a curve, the intervals alone are 3 to 9 % wide either way.
        code, _, error = start("run", scenes[-1], "--out", out, "--set", "time.steps=400")
        expect(code == 0, f"mixed-mode bending, {name} %: {error}")
        curves.append(curve(out + ".csv", table(os.path.join(out, "history.csv")), noise=0.02, seed=int(name), every=1))
    fit = os.path.join(here, "fit")
    code, _, error = start("fit", *scenes, "--data", *curves, "--parameters", "laws.0.normal_toughness=50:1000@300",
                           "laws.0.tangential_toughness=100:3000@600", "laws.0.toughness_exponent=0.3:6@1.5", "--out", fit, "--set", "time.steps=400", "--jobs", "2", "--weights", "relative")
    expect(code == 0, f"a fit of three curves: {error}")
    with open(os.path.join(fit, "fit.json"), encoding="utf-8") as file:
        for row in json.load(file)["parameters"]:
            off = row["value"] / truth[row["key"]] - 1
            expect(abs(off) < 0.03, f"{row['key']} from three curves with 2 % of noise: off by {100 * off:.2f} %")


def coverage(trials=100):
    """How often the intervals of fits to noisy curves cover the truth."""
    import fit  # pylint: disable=import-outside-toplevel
    from curve_data import CurveData  # pylint: disable=import-outside-toplevel
    from fit_model import Model, Parameter  # pylint: disable=import-outside-toplevel
    from types import SimpleNamespace  # pylint: disable=import-outside-toplevel
    scene, out = write(PEEL), os.path.join(folder(), "out")
    start("run", scene, "--out", out)
    rows = table(os.path.join(out, "history.csv"))
    covered = dict.fromkeys(TRUTH, 0)
    here = folder()
    os.makedirs(os.path.join(here, "work"))
    given = SimpleNamespace(set=[], out=here, jobs=1, x="load", y="reaction")
    for trial in range(trials):
        data = [CurveData(curve(os.path.join(here, "curve.csv"), rows, noise=0.02, seed=1000 + trial))]
        parameters = [Parameter("laws.0.normal_toughness=100:500"), Parameter("laws.0.normal_strength=5e6:3e7")]
        with open(os.devnull, "w", encoding="utf-8") as silent:
            before, sys.stdout = sys.stdout, silent
            try:
                one = fit.Fit(Model([scene], data, parameters, given), "curve")
                values = fit.estimates(one, one.run(np.ones(len(one.start))), 0.95)
            finally:
                sys.stdout = before
        for key, (low, high) in zip(TRUTH, values[2]):
            covered[key] += low < TRUTH[key] < high
    return covered, trials


sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "study"))
if sys.argv[1:] == ["whole"]:
    long_fits()
else:
    for part in (sweeps, interrupted_sweep, changed_mesh, wrong_words, fits, rugged, alike, without_packages):
        part()
finish()
