# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of the command line share: a small scene, running the program, expectations."""
import atexit
import contextlib
import functools
import importlib
import io
import os
import re
import shutil
import subprocess
import sys
import tempfile

DELAM = os.environ["DELAM"]
SERVE = os.environ.get("DELAM_SERVE")  # keeps the program loaded (serve.c)
failures = []

SCENE = """
schema = 1
title = "small ENF"
[geometry]
dimension = 2
length = 0.120
h = 0.0015
[[materials]]
name = "arm"
young = 75e9
poisson = 0.3
[[layers]]
name = "lower"
thickness = 0.003
material = "arm"
[[layers]]
name = "upper"
thickness = 0.003
material = "arm"
[[laws]]
name = "ductile"
normal_stiffness = 125e9
tangential_stiffness = 125e9
normal_onset = 100.0
tangential_onset = 100.0
normal_toughness = 250.0
tangential_toughness = 250.0
[[interfaces]]
lower = "lower"
upper = "upper"
law = "ductile"
notch = [{ from = 0.0, to = 0.030 }]
[[supports]]
point = [0.0, 0.0]
fix = ["y"]
[[supports]]
point = [0.120, 0.0]
fix = ["x", "y"]
[[patterns]]
name = "press"
times = [0.0, 2.0]
values = [0.0, 0.006]
[[loads]]
point = [0.060, 0.006]
direction = [0.0, -1.0]
pattern = "press"
[time]
end = 2.0
steps = 20
"""


def changed(old, new, scene=SCENE):
    assert old in scene, old
    return scene.replace(old, new, 1)


def brittle():
    """A short notch under a brittle interface: the crack jumps, and that step violates the two-sided estimate."""
    scene = changed("to = 0.030", "to = 0.0045")
    for mode in ("normal", "tangential"):
        scene = changed(mode + "_onset = 100.0", mode + "_onset = 250.0", scene)
    return scene


def folder():
    """A new folder, which goes with this process."""
    path = tempfile.mkdtemp(prefix="delam_cli_")
    atexit.register(shutil.rmtree, path, ignore_errors=True)
    return path


def write(text, name="scene.toml", place=None):
    path = os.path.join(place or folder(), name)
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    return path


def start(*words, **options):
    """The program itself: exit code, standard output, standard error."""
    done = subprocess.run([DELAM, *words], capture_output=True, text=True, timeout=200, check=False, **options)
    return done.returncode, done.stdout, done.stderr


class Served:
    """The program that is loaded once."""

    def __init__(self):
        self.process = subprocess.Popen([DELAM], env={**os.environ, "LD_PRELOAD": SERVE}, stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE)
        atexit.register(self.process.communicate)  # it ends with its standard input
        self.shown = [os.path.join(folder(), name) for name in ("out", "err")]

    def run(self, words):
        texts = [*self.shown, DELAM, *words]
        request = f"{len(texts)}\n".encode() + b"".join(os.fsencode(text) + b"\0" for text in texts)
        self.process.stdin.write(request)
        self.process.stdin.flush()
        code = int(self.process.stdout.readline())
        return code, *(read(path).decode() for path in self.shown)


@functools.cache
def served():
    return Served()


def delam(*words, **options):
    """Exit code, standard output, standard error; started anew only where there is no other way."""
    return served().run(words) if SERVE and not options else start(*words, **options)


def draw(script, *words):
    """A script of plot/ in this process, which imports Matplotlib once: exit code, standard error."""
    path = os.path.dirname(os.environ["DELAM_PLOT"])
    if path not in sys.path:
        sys.path.insert(0, path)
    before, sys.argv = sys.argv, [script, *words]
    error = io.StringIO()
    try:
        with contextlib.redirect_stderr(error):
            module = importlib.import_module(script)
            importlib.import_module("matplotlib").rcParams["savefig.dpi"] = 60  # drawn and packed in half the time
            code = importlib.import_module("command").reported(module.main)
    finally:
        sys.argv = before
    return code, error.getvalue()


def expect(condition, what):
    print(("ok    " if condition else "FAIL  ") + what)
    if not condition:
        failures.append(what)


def expect_error(answer, code, *patterns):
    """The exit code, one readable message, nothing that looks like a crash."""
    status, _, error = answer
    shown = error.strip().replace("\n", " | ")
    expect(status == code and all(re.search(p, error) for p in patterns) and error.startswith("delam: "),
           f"exit {code} and {patterns}: got exit {status}: {shown}")


def read(path):
    with open(path, "rb") as file:
        return file.read()


def finish():
    sys.exit(1 if failures else 0)
