# SPDX-License-Identifier: BSD-3-Clause
"""The page of `delam view` in headless Chromium: what it shows of each step is what fields.h5 and history.csv have,
slider and charts move each other, nothing is fetched and nothing complains, at the widths of a desk and of a phone.

    test_view_browser.py FOLDER     keeps what drives the browser there; exit code 77 where a part of it is missing
"""
import csv
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

import h5py
import matplotlib.image
import numpy as np

from support import changed, delam, expect, finish, folder, write

HERE = pathlib.Path(__file__).resolve().parent.parent / "view/test"
SKIPPED = 77


def skip(why):
    print(f"skipped: {why}")
    sys.exit(SKIPPED)


def driver(kept):
    """Node's packages in `kept`, fetched unless those of the lock file are there."""
    kept = pathlib.Path(kept)
    lock = (HERE / "package-lock.json").read_bytes()
    stamp = kept / "fetched-lock.json"
    if stamp.exists() and stamp.read_bytes() == lock:
        return kept
    kept.mkdir(parents=True, exist_ok=True)
    for name in ("package.json", "package-lock.json"):
        shutil.copy(HERE / name, kept)
    command = ["npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund", "--fetch-retries=1", "--fetch-timeout=60000"]
    try:
        done = subprocess.run(command, cwd=kept, capture_output=True, text=True, timeout=300, check=False)
    except subprocess.TimeoutExpired:
        skip("the npm registry does not answer")
    if done.returncode != 0:
        # What comes but is not what was pinned is no absence.
        if "EINTEGRITY" in done.stderr:
            sys.exit(f"npm: the packages are not those of package-lock.json:\n{done.stderr}")
        skip(f"npm could not fetch what drives the browser: {done.stderr.strip()[:200]}")
    stamp.write_bytes(lock)
    return kept


CHROMIUM = shutil.which("chromium")
if CHROMIUM is None:
    skip("chromium is not installed (Debian: chromium)")
if shutil.which("node") is None or shutil.which("npm") is None:
    skip("npm is not installed (Debian: nodejs, npm)")
PACKAGES = driver(sys.argv[1])


def driven(scene, expected=0):
    out = folder()
    code, _, error = delam("run", write(scene), "--out", out)
    expect(code == expected, f"run: exit {code} {error.strip()[-200:]}")
    return out, drive(out)


def drive(out):
    code, said, error = delam("view", out)
    expect(code == 0, f"view: {said}{error}")
    pictures = folder()
    done = subprocess.run(["node", str(HERE / "drive.mjs"), str(PACKAGES), CHROMIUM, os.path.join(out, "view.html"), pictures],
                          capture_output=True, text=True, timeout=1500, check=False)
    if done.returncode != 0:
        expect(False, f"the page could be driven: {done.stderr.strip()[-1500:]}")
        finish()
    return json.loads(done.stdout), pictures


class Exact:
    """What the files of the result say of each step with fields."""

    def __init__(self, out):
        with open(os.path.join(out, "history.csv"), newline="", encoding="utf-8") as file:
            rows = {int(row["step"]): row for row in csv.DictReader(file)}
        self.steps, self.jumps = [], 0
        path = os.path.join(out, "jumps.csv")
        if os.path.exists(path):
            with open(path, newline="", encoding="utf-8") as file:
                debonded = [float(row["debonded"]) for row in csv.DictReader(file)]
            self.jumps = sum(length > 0.2 * max(debonded) for length in debonded)
        with h5py.File(os.path.join(out, "fields.h5"), "r") as file:
            for name in sorted(file["steps"]):
                of = file["steps"][name]
                zetas = [of[f"interface_{i}/zeta"][()] for i in range(len(file["interfaces"]))]
                self.steps.append({
                    "row": rows[int(of.attrs["step"])], "step": int(of.attrs["step"]),
                    "displacement": np.linalg.norm(of["displacement"][()], axis=1).max(),
                    "mean": [z.mean() for z in zetas], "least": [z.min() for z in zetas]})


def close(shown, exact, relative, absolute=1e-12):
    return abs(shown - exact) <= relative * abs(exact) + absolute


def number(text):
    return float(re.match(r"[-+.0-9e]+", text.replace("−", "-")).group(0))


def compare(exact, seen, what):
    step = exact.steps[seen["index"]]
    sums, readings = seen["sums"], seen["readings"]
    good = (seen["step"] == step["step"] and seen["slider"] == seen["index"] and
            f"step {step['step']} of" in seen["instant"])
    good = good and close(sums["displacement"], step["displacement"], 2e-5)
    for one, mean, least in zip(sums["adhesion"], step["mean"], step["least"], strict=True):
        good = good and close(one["mean"], mean, 2e-5) and close(one["least"], least, 2e-5)
    for key, column in (("x", "load"), ("y", "reaction"), ("stored", "stored_bulk"), ("dissipated", "dissipated"),
                        ("work", "work"), ("debonded", "debonded_length")):
        good = good and close(number(readings[key]), float(step["row"][column]), 6e-4)
    good = good and set(seen["rows"]) == {seen["index"]}
    expect(good, f"{what}: step {step['step']}, as the files have it: {seen['instant']}, {readings}")


def image(pictures, name):
    return matplotlib.image.imread(os.path.join(pictures, name))[..., :3]


def reddish(pixels):
    """Part of the picture in the colour of what is debonded."""
    return np.mean((pixels[..., 0] > 0.5) & (pixels[..., 1] < 0.35) & (pixels[..., 2] < 0.4))


def judge(out, answer, pictures, what, red):
    exact = Exact(out)
    for found in answer["walks"]:
        at = f"{what}, {found['width']} wide"
        quiet(found, at)
        expect(found["steps"] == len(exact.steps) == len(found["seen"]) - 1, f"{at}: {found['steps']} steps")
        for seen in found["seen"]:
            compare(exact, seen, at)
        expect(found["seen"][0]["index"] == found["steps"] - 1, f"{at}: it begins with the last step")
        expect(found["clicked"]["index"] == found["clicked"]["target"] > 0, f"{at}: a click into the load curve chooses its step")
        compare(exact, found["clicked"], at)
        expect(found["trueScale"] == 1 and found["seen"][0]["scale"] == 5, f"{at}: scale 5 of the scene, then true scale")
        expect(found["played"] == found["steps"] - 1, f"{at}: played to the end")
        before, turned, near, fitted = found["cameras"]
        expect(before[:3] != turned[:3] and near[3] < turned[3] and fitted[3] != near[3], f"{at}: keys move the camera")
        expect(found["below"] == (found["width"] < 600), f"{at}: charts beneath the scene on a phone, beside it else")
        width = found["width"]
        # Scale and colours change the picture, and the last step is more debonded than the first.
        images = {name: image(pictures, f"{name}-{width}.png") for name in ("first", "last", "true", *found["colours"])}
        expect(reddish(images["last"]) > red * reddish(images["first"]) > 0,
               f"{at}: red {reddish(images['first']):.4f} of the first picture, {reddish(images['last']):.4f} of the last")
        for one, other in (("first", "last"), ("last", "true"), *((name, "body") for name in found["colours"][1:])):
            expect(images[one].shape != images[other].shape or np.mean(np.abs(images[one] - images[other])) > 1e-4,
                   f"{at}: pictures {one} and {other} differ")
        expect({"body", "u", "ux", "uy", "mises", "xx", "zz", "xy"} <= set(found["colours"]), f"{at}: colours {found['colours']}")
        pixel = 0.005  # of the height, at most
        expect(all(low <= top + pixel for low, top in found["heights"]), f"{at}: the legend ends above the body {found['heights']}")
        expect(found["jumps"] == exact.jumps, f"{at}: {found['jumps']} jumps are marked in the load curve, of {exact.jumps}")
        # One range for all steps: the largest displacement is that of the last step, and a middle one is shown.
        largest = max(step["displacement"] for step in exact.steps)
        said = found["legends"]["u"].splitlines()
        expect("displacement, all steps" in said and close(number(said[-1]), largest, 6e-3) and
               exact.steps[found["clicked"]["target"]]["displacement"] < 0.9 * largest, f"{at}: range {said}")
        expect("0 debonded" in found["legends"]["body"] and "upper" in found["legends"]["body"] and
               "stress, von Mises, all steps" in found["legends"]["mises"], f"{at}: legends {found['legends']['mises']!r}")
    quiet(answer["old"], f"{what}, dark, without DecompressionStream")
    compare(exact, answer["old"]["seen"][0], f"{what}, without DecompressionStream")
    blind = answer["blind"]
    expect(blind["state"] == "shown" and "no WebGL 2" in blind["said"] and blind["errors"] == [],
           f"{what}: said where there is no WebGL {blind['said']!r} {blind['errors']}")
    compare(exact, blind["seen"][0], f"{what}, without WebGL")
    expect(image(pictures, "dark-1280.png").mean() < 0.5 < image(pictures, "last-1280.png").mean(), f"{what}: dark where it is wished")


def quiet(found, what):
    expect(found["state"] == "drawn", f"{what}: drawn")
    expect(found["errors"] == [], f"{what}: nothing complains {found['errors']}")
    expect(len(found["requests"]) == 1 and found["requests"][0].endswith("/view.html"),
           f"{what}: nothing but the page is asked for {found['requests']}")
    expect(found["overflow"] <= 0, f"{what}: nothing is wider than the page ({found['overflow']})")
    expect(found["unnamed"] == [], f"{what}: all that can be used has a name {found['unnamed']}")


coarse = changed("steps = 20", "steps = 5", changed("h = 0.0015", "h = 0.003"))
out, (answer, pictures) = driven(coarse)
judge(out, answer, pictures, "2D", 1.5)
expect(answer["walks"][0]["title"] == "small ENF" and answer["walks"][0]["warnings"] == [], "2D: title, and no warning")

# The same as incomplete and not converged; the marks and the words are there.
about = json.loads(pathlib.Path(out, "result.json").read_text(encoding="utf-8"))
about.update(status="incomplete", reason="interrupted", steps_done=5, steps=9, not_converged=[3])
pathlib.Path(out, "result.json").write_text(json.dumps(about), encoding="utf-8")
answer, _ = drive(out)
said = " | ".join(answer["walks"][1]["warnings"])
expect("INCOMPLETE: 5 of 9 steps were computed: interrupted" in said and "Step 3 did not converge" in said, f"warnings: {said}")

solid = changed("dimension = 2", "dimension = 3\nwidth = 0.006", coarse)
solid = changed("point = [0.0, 0.0]", "box = { lower = [0, 0, 0], upper = [0, 0.006, 0] }", solid)
solid = changed("point = [0.120, 0.0]\nfix = [\"x\", \"y\"]",
                "box = { lower = [0.12, 0, 0], upper = [0.12, 0.006, 0] }\nfix = [\"x\", \"z\"]", solid)
solid = changed('fix = ["y"]', 'fix = ["y", "z"]', solid)
solid = changed("point = [0.060, 0.006]\ndirection = [0.0, -1.0]",
                "box = { lower = [0.06, 0, 0.006], upper = [0.06, 0.006, 0.006] }\ndirection = [0, 0, -1]", solid)
out, (answer, pictures) = driven(solid)
judge(out, answer, pictures, "3D", 1.2)

finish()
