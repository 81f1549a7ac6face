#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""file_faults.py [--every N] [--jobs N] [SCENARIO ...]

Each operation on a file fails once (file_faults.c), in every way of using the program that reads or writes: run, over
an earlier result, resume, sweep, import, view, check. After each: an exit code that is documented; where it is not 0, a
message in one line or a few; nothing of anybody else is touched; an earlier result is whole or the new one is; and the
same command, undisturbed, comes to the end that it would have come to.

--every  only every N-th operation of a scenario, and its first and last
"""
import argparse
import errno
import itertools
import json
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

HERE = os.path.dirname(os.path.realpath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "..", "bindings", "cli", "test"))

from support import DELAM, changed  # noqa: E402

SHIM = os.environ["DELAM_FILE_FAULTS"]
CODES = [errno.EIO, errno.ENOSPC, errno.EACCES, errno.EMFILE]  # in turn
DOCUMENTED = (0, 1, 2, 3, 4)
NOTES = "a file of somebody else\n"
SMALL = changed("steps = 20", "steps = 4", changed("h = 0.0015", "h = 0.003"))
DECK = """*HEADING
two blocks
*NODE
1, 0, 0
2, 1, 0
3, 1, 1
4, 0, 1
5, 1, 1
6, 0, 1
7, 1, 2
8, 0, 2
*ELEMENT, TYPE=CPE4, ELSET=LOWER
1, 1, 2, 3, 4
*ELEMENT, TYPE=CPE4, ELSET=UPPER
2, 6, 5, 7, 8
*ELEMENT, TYPE=COH2D4, ELSET=GLUE
3, 4, 3, 5, 6
*SOLID SECTION, ELSET=LOWER, MATERIAL=STEEL
*SOLID SECTION, ELSET=UPPER, MATERIAL=STEEL
*COHESIVE SECTION, ELSET=GLUE, MATERIAL=BOND, RESPONSE=TRACTION SEPARATION
*MATERIAL, NAME=STEEL
*ELASTIC
200000, 0.3
*MATERIAL, NAME=BOND
*ELASTIC, TYPE=TRACTION
100000, 100000, 100000
*DAMAGE INITIATION, CRITERION=QUADS
10, 10, 10
*DAMAGE EVOLUTION, TYPE=ENERGY
0.1
*NSET, NSET=BOTTOM
1, 2
*NSET, NSET=TOP
7, 8
*STEP
*STATIC
0.25, 1
*BOUNDARY
BOTTOM, 1, 2
TOP, 2, 2, 0.001
*END STEP
"""


def write(path, text):
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def read(path):
    with open(path, "rb") as file:
        return file.read()


def call(words, folder, **more):
    """The program in a folder: exit code and what it said, both streams."""
    done = subprocess.run([DELAM, *words], cwd=folder, env={**os.environ, **more}, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=120, check=False)
    return done.returncode, done.stdout.decode(errors="replace"), done.stderr.decode(errors="replace")


def must(words, folder):
    code, said, error = call(words, folder)
    if code != 0:
        raise SystemExit(f"{' '.join(words)}: exit {code}: {said}{error}")


def published(folder):
    """True if a folder holds a whole result: the files are as result.json says."""
    path = os.path.join(folder, "result.json")
    if not os.path.exists(path):
        return False
    about = json.loads(read(path))
    for name, content in about["files"].items():
        bytes_ = read(os.path.join(folder, name))
        value, most = 0, 2 ** 64 - 1
        whole = bytes_ + bytes(-len(bytes_) % 8)
        for (word,) in struct.iter_unpack("<Q", whole + struct.pack("<Q", len(bytes_))):
            value = ((value << 29 & most | value >> 35) ^ word) * 0x9e3779b97f4a7c15 & most
        if len(bytes_) != content["bytes"] or f"w{value ^ value >> 32:016x}" != content["hash"]:
            raise AssertionError(f"{name} is not as result.json says")
    return True


class Scenario:
    """One way of using the program. prepare() fills a folder; `words` is the command in which operations fail, `again`
    the one that goes on; results are the files that count in the end."""

    def __init__(self, name, words, again, results):
        self.name, self.words, self.again, self.results = name, words, again, results

    def prepare(self, folder):
        write(os.path.join(folder, "scene.toml"), SMALL)
        write(os.path.join(folder, "notes.txt"), NOTES)
        write(os.path.join(folder, "deck.inp"), DECK)
        out = os.path.join(folder, "out")
        if self.name == "run":
            return
        os.mkdir(out)
        write(os.path.join(out, "notes.txt"), NOTES)
        if self.name == "again":
            must(["run", "scene.toml", "--out", "out", "--set", "time.steps=2"], folder)
        if self.name in ("view", "complete"):
            must(["run", "scene.toml", "--out", "out"], folder)
        if self.name == "view":
            must(["view", "out"], folder)
        if self.name == "resume":
            interrupted(folder)
        if self.name == "import":
            must(["import", "deck.inp", "--out", "imported.toml"], folder)

    def right(self, folder):
        """Checks what always holds, also after a failure."""
        for path in ("notes.txt", os.path.join("out", "notes.txt")):
            whole = os.path.join(folder, path)
            if (path == "notes.txt" or self.name != "run") and read(whole).decode() != NOTES:
                raise AssertionError(f"{path} is changed")
        out = os.path.join(folder, "out")
        there = published(out)
        if self.name in ("view", "complete") and not there:
            raise AssertionError("the result is gone")
        if self.name == "again" and not there and not os.path.exists(os.path.join(out, "running", "state.bin")):
            raise AssertionError("neither the earlier result is there nor the new one")


def interrupted(folder):
    """A run that was killed when two steps were saved."""
    with subprocess.Popen([DELAM, "run", "scene.toml", "--out", "out"], cwd=folder, stdout=subprocess.PIPE,
                          text=True) as process:
        for line in process.stdout:
            if line.startswith("step 2/"):
                process.kill()
                break
    if not os.path.exists(os.path.join(folder, "out", "running", "state.bin")):
        raise SystemExit("nothing is left of the run that was killed")


RUN = ["history.csv", "state.bin", "fields.h5", "fields.xdmf"]
OUT = [os.path.join("out", name) for name in RUN]
SWEEP = ["sweep", "scene.toml", "--vary", "laws.0.normal_toughness=200,300", "--out", "out"]
SCENARIOS = {one.name: one for one in (
    Scenario("run", ["run", "scene.toml", "--out", "out"], ["run", "scene.toml", "--out", "out", "--resume"], OUT),
    Scenario("again", ["run", "scene.toml", "--out", "out"], ["run", "scene.toml", "--out", "out"], OUT),
    Scenario("resume", ["run", "scene.toml", "--out", "out", "--resume"],
             ["run", "scene.toml", "--out", "out", "--resume"], OUT),
    Scenario("complete", ["run", "scene.toml", "--out", "out", "--resume"],
             ["run", "scene.toml", "--out", "out", "--resume"], OUT),
    Scenario("sweep", SWEEP, SWEEP, [os.path.join("out", "table.csv"), *(os.path.join("out", run, "history.csv")
                                                                       for run in ("0001", "0002"))]),
    Scenario("import", ["import", "deck.inp", "--out", "imported.toml", "--replace"],
             ["import", "deck.inp", "--out", "imported.toml", "--replace"], ["imported.toml"]),
    Scenario("view", ["view", "out"], ["view", "out"], [os.path.join("out", "view.html")]),
    Scenario("check", ["check", "deck.inp"], ["check", "deck.inp"], []),
)}


class Faults:
    def __init__(self, scenario, base):
        self.scenario = scenario
        self.template = os.path.join(base, scenario.name)
        os.mkdir(self.template)
        scenario.prepare(self.template)
        whole = os.path.join(base, scenario.name + "-whole")
        shutil.copytree(self.template, whole, symlinks=True)
        count = os.path.join(base, scenario.name + "-count")
        code, said, error = self.call(whole, scenario.words, FAULTS_COUNT=count)
        if code != 0:
            raise SystemExit(f"{scenario.name}: undisturbed: exit {code}: {said}{error}")
        self.operations = read(count).decode(errors="replace").splitlines()
        self.expected = {path: read(os.path.join(whole, path)) for path in scenario.results}
        self.names = listing(whole)
        self.base = base

    @staticmethod
    def call(folder, words, **more):
        return call(words, folder, LD_PRELOAD=SHIM, FAULTS_FOLDER=folder, **more)

    def at(self, number):
        """Describes the fault after the operation of this number has failed; "": nothing."""
        folder = os.path.join(self.base, f"{self.scenario.name}-{number}")
        shutil.copytree(self.template, folder, symlinks=True)
        code = CODES[number % len(CODES)]
        what = f"{self.scenario.name} {number}: {self.operations[number - 1].replace(folder, '')}: " \
               f"{errno.errorcode[code]}"
        try:
            status, said, error = self.call(folder, self.scenario.words, FAULTS_AT=str(number), FAULTS_CODE=str(code))
            wrong = self.judge(folder, status, said, error)
        except (AssertionError, OSError, ValueError, KeyError, subprocess.TimeoutExpired) as trouble:
            wrong = str(trouble) or repr(trouble)
        shutil.rmtree(folder)
        return f"{what}: {wrong}" if wrong else ""

    def judge(self, folder, status, said, error):
        if status not in DOCUMENTED:
            return f"exit {status}: {error.strip()[-300:]}"
        if status != 0 and not re.search(r"^delam: \S.{8,}", error, re.M):
            # A run of a sweep says it in its log, and the sweep in its table.
            if not (self.scenario.name == "sweep" and re.search(r"^run .*  \S", said, re.M)):
                return f"exit {status} without a message: {said[-200:]} | {error[-200:]}"
        if re.search(r"Traceback|terminate called|HDF5-DIAG|what\(\)", said + error):
            return f"no message for people: {error[-300:]}"
        if status == 0:
            self.compare(folder, "said to be done")
        self.scenario.right(folder)
        code, more, trouble = call(self.scenario.again, folder)
        if code != 0:
            return (f"exit {status} ({error.strip()[-120:]}), then it does not go on: exit {code}: "
                    f"{(more + trouble)[-300:]}")
        self.compare(folder, "gone on with")
        self.scenario.right(folder)
        left = listing(folder) - self.names
        if left:
            return f"left over: {sorted(left)}"
        return ""

    def compare(self, folder, how):
        for path, bytes_ in self.expected.items():
            if read(os.path.join(folder, path)) != bytes_:
                raise AssertionError(f"{path}, {how}, is not what it would have been")


def listing(folder):
    return {os.path.relpath(os.path.join(at, name), folder) for at, folders, files in os.walk(folder)
            for name in itertools.chain(folders, files)}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("scenario", nargs="*", choices=[[], *SCENARIOS])
    options = parser.parse_args()
    base = os.path.realpath(tempfile.mkdtemp(prefix="delam_faults_"))
    wrong, points = [], 0
    try:
        for name in options.scenario or SCENARIOS:
            faults = Faults(SCENARIOS[name], base)
            last = len(faults.operations)
            numbers = sorted({*range(1, last + 1, options.every), last} if last else set())
            with ThreadPoolExecutor(options.jobs) as pool:
                found = [text for text in pool.map(faults.at, numbers) if text]
            for text in found:
                print(f"FAIL  {text}", flush=True)
            print(f"{name}: {len(numbers)} of {last} operations failed in turn, {len(found)} not survived", flush=True)
            wrong += found
            points += len(numbers)
    finally:
        shutil.rmtree(base)
    print(f"{points} points, {len(wrong)} not survived")
    return 1 if wrong or points == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
