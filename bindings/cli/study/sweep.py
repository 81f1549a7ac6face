#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""One scene with many values: `delam sweep SCENE --vary KEY=FROM:TO:NUMBER --out DIR`.

Runs the scene for each combination of values (or for a Latin hypercube of ranges), as many at once as --jobs, and writes
DIR/table.csv (a row for each run), curves.png (the load curves), response.png (the peak of the reaction over each key).
The results are in DIR/0001, DIR/0002, ... The same command goes on after an interruption.
"""
import csv
import io
import json
import os
import re
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import command

if __name__ == "__main__":
    command.begin("delam: sweep")

from packages import require  # noqa: E402

require("numpy", "matplotlib")

import numpy as np  # noqa: E402

from _pictures.input_file import MOST_MESH, MOST_SCENE, MOST_SWEEP, Unreadable, read_bytes, read_json  # noqa: E402
from command import complain, loading, on_interrupt, say  # noqa: E402
from analyses import (DONE, INTERRUPTED, NOT_CONVERGED, WRONG, Check, Trouble, analyse, end_all,  # noqa: E402
                     given_words, hold, last_words, read_about, read_history, refuse_foreign_log,  # noqa: E402
                     refuse_set, run_study, setting, warnings_of)
from fit_model import with_hint  # noqa: E402
from measured.units import unit_of_key  # noqa: E402
from own_files import claim, discard, write_file  # noqa: E402
from variations import Variation, grid, latin  # noqa: E402

RESULTS = ["exit_code", "steps", "peak_reaction", "load_at_peak", "last_reaction", "dissipated", "released", "jumps",
           "not_converged", "warnings", "message"]
FILES = ["sweep.json", "table.csv", "curves.png", "response.png"]
OF_A_SWEEP = {"scene": "another text of the scene file", "set": "other --set", "vary": "other keys",
              "points": "other values", "scene_hash": "another mesh"}  # members of sweep.json


class Sweep:
    """The runs of a sweep, as they are defined in DIR/sweep.json."""

    def __init__(self, given):
        self.scene, self.out, self.common = given.scenes[0], given.out, given.set
        self.variations = [Variation(text) for text in given.vary]
        if not self.variations:
            raise Trouble("--vary: at least one is expected")
        paths = [variation.path for variation in self.variations]
        refuse_set(paths, self.common, "--vary")
        if len(set(paths)) < len(paths):
            raise Trouble("--vary: a key is given twice")
        self.points = grid(self.variations) if given.latin == 0 else latin(self.variations, given.latin, given.seed)
        self.known = None  # what sweep.json says of the sweep before in this folder
        self.ended = threading.Event()
        self.rows, self.warnings = {}, {}  # by the number of the run
        self.units = ("", "")  # of length and force; a result has them
        self.unit = ""  # of the reaction
        self.lock = threading.Lock()
        self.began = time.monotonic()

    def read(self):
        try:
            self.text = read_bytes(self.scene, MOST_MESH if self.scene.lower().endswith(".inp") else MOST_SCENE
                                   ).decode("utf-8", "replace")
        except FileNotFoundError as error:
            raise Trouble(f"{self.scene}: cannot be read: {error.strerror}") from error
        self.definition = {"scene": self.text, "set": self.common, "vary": [v.path for v in self.variations],
                           "points": [list(point) for point in self.points]}
        self.place = os.path.join(self.out, "sweep.json")

    def refuse_other(self, replace):
        """Refuses the folder of another sweep."""
        if not os.path.lexists(self.place):
            return
        try:
            known = read_json(self.place, MOST_SWEEP)
        except Unreadable:
            known = None
        if not isinstance(known, dict) or not all(isinstance(known.get(key), list) for key in ("set", "vary", "points")):
            raise Trouble(f"{self.place} is of no sweep: move it away, or choose another folder")
        self.known = known
        now = json.loads(json.dumps(self.definition))
        other = [what for key, what in OF_A_SWEEP.items()
                 if known.get(key) != now.get(key) and not (key == "scene_hash" and None in (known.get(key), now.get(key)))]
        if other and not replace:
            raise Trouble(f"{self.out} holds another sweep, with {' and '.join(other)}: --replace discards it")

    def require_scene(self):
        """Refuses a sweep of which no run is a scene, before anything is written; as a rule the first one is."""
        first = None
        for point in self.points:
            answer = Check(self.scene, self.settings(point))
            if not answer.errors:
                # The mesh's file is no part of the text.
                self.definition["scene_hash"] = answer.found.get("scene_hash")
                return
            first = first or self.words_of_error(answer)
        raise Trouble(f"no run is a scene, e.g. {first}")

    def words_of_error(self, answer):
        """Of a key that is varied, as it was given, and with the one that may be meant."""
        key = answer.errors[0]["key"]
        if key not in [v.path for v in self.variations] or self.scene.lower().endswith(".inp"):
            return answer.words
        return f"--vary {with_hint(answer.words.removeprefix('--set: '), key, self.scene)}"

    def define(self, replace):
        """Notes what the sweep is."""
        self.refuse_other(replace)
        claim(self.out, FILES + self.runs(len(self.points)), self.known is not None)
        if replace and self.known:
            self.discard()
        write_file(self.place, json.dumps(self.definition, indent=1))

    def runs(self, count):
        """Names of folders and logs of the first `count` runs that are there."""
        there = set(os.listdir(self.out))
        return [name for k in range(count) for name in (self.name(k), self.name(k) + ".log") if name in there]

    def discard(self):
        """The results of the sweep before, and nothing else that lies in the folder."""
        runs = self.runs(len(self.known["points"]))
        claim(self.out, runs, True)  # no link, no folder in the place of a log
        files = [os.path.join(self.out, name) for name in [n for n in runs if n.endswith(".log")] + FILES[1:]]
        for path in files:  # all of them before the first is removed
            refuse_foreign_log(path)
        discard([os.path.join(self.out, name) for name in runs if not name.endswith(".log")])
        for path in files:
            if os.path.lexists(path):
                os.remove(path)

    def can_resume(self, out):
        """Sensitivities are followed from the initial state on: only a complete result is kept then."""
        try:
            complete = read_about(out)["status"] == "complete"
        except (OSError, Unreadable, KeyError):
            complete = False
        return complete or not any("sensitivities" in text for text in (self.text, *self.common))

    def settings(self, point):
        return self.common + [setting(v.path, value) for v, value in zip(self.variations, point)]

    @staticmethod
    def name(number):
        return f"{number + 1:04d}"

    def folder(self, number):
        return os.path.join(self.out, self.name(number))

    def run_one(self, number):
        """The exit code of a run; a result that is complete already is taken as it is."""
        out = self.folder(number)
        if self.ended.is_set():
            return
        code = analyse(self.scene, out, self.settings(self.points[number]), resume=self.can_resume(out))
        with self.lock:
            if code == INTERRUPTED or self.ended.is_set():
                return
            self.rows[number] = self.row(number, code)
            self.write_table()
            done, all_of_them = len(self.rows), len(self.points)
            left = (time.monotonic() - self.began) / done * (all_of_them - done)
            values = ", ".join((f"{v.path} {value:.6g}" if isinstance(value, float) else f"{v.path} {value}") + unit_of_key(v.path, self.units)
                               for v, value in zip(self.variations, self.points[number]))
            say(f"run {done}/{all_of_them}  {values}  {self.words(number)}  left {left:.0f} s")

    def words(self, number):
        row = self.rows[number]
        return row["message"] or f"peak {row['peak_reaction']:.4g}{self.unit}"

    def row(self, number, code):
        row = dict.fromkeys(RESULTS, "")
        row["exit_code"] = code
        out = self.folder(number)
        if code not in (DONE, NOT_CONVERGED):
            row["message"] = last_words(out)
            return row
        history, about = read_history(out), read_about(out)
        self.units = tuple(about["units"][key] for key in ("length", "force"))
        if all(self.units):
            self.unit = f" {self.units[1]}" + f"/{self.units[0]}" * (about["scene"]["dimension"] == 2)
        self.warnings[number] = warnings_of(out)
        loads = [name for name in history if name == "load" or name.startswith("load_")]
        reaction = history[loads[0].replace("load", "reaction", 1)]
        peak = int(np.argmax(np.abs(reaction)))
        row.update(steps=len(reaction) - 1, peak_reaction=reaction[peak], load_at_peak=history[loads[0]][peak],
                   last_reaction=reaction[-1], dissipated=history["dissipated"][-1],
                   released=history["released"][-1], jumps=int(history["jumps"].sum()),
                   not_converged=len(about["not_converged"]), warnings=len(self.warnings[number]))
        return row

    def said_of_warnings(self):
        """A line for each kind of warning: which runs have it, and what it says in the first of them."""
        kinds = {}
        for number in sorted(self.warnings):
            for text in self.warnings[number]:
                kinds.setdefault(re.sub(r"[-+]?[0-9][0-9.e+-]*", "#", text), (text, []))[1].append(number + 1)
        for text, runs in kinds.values():
            runs = sorted(set(runs))
            which = ", ".join(map(str, runs[:8])) + (", .." if len(runs) > 8 else "")
            yield f"warning of {len(runs)} of {len(self.points)} runs ({which}): {text}"

    def write_table(self):
        text = io.StringIO()
        table = csv.writer(text, lineterminator="\n")
        table.writerow(["run", *(v.path for v in self.variations), *RESULTS])
        for number in sorted(self.rows):
            row = self.rows[number]
            table.writerow([number + 1, *self.points[number],
                            *(repr(float(row[key])) if isinstance(row[key], float) else row[key] for key in RESULTS)])
        write_file(os.path.join(self.out, "table.csv"), text.getvalue())

    def stop(self, *_):
        """Every run keeps its finished steps."""
        self.ended.set()
        end_all()

    def run(self, jobs):
        on_interrupt(self.stop)
        with ThreadPoolExecutor(jobs) as pool:
            for result in [pool.submit(self.run_one, number) for number in range(len(self.points))]:
                result.result()
        return not self.ended.is_set()


def main():
    given = given_words()
    sweep = Sweep(given)
    sweep.read()
    sweep.refuse_other(given.replace)
    sweep.require_scene()
    held = hold(given.out)  # until the end
    sweep.define(given.replace)
    if not sweep.run(given.jobs):
        complain(f"interrupted after {len(sweep.rows)} of {len(sweep.points)} runs; the same command goes on")
        return INTERRUPTED
    good = {number: read_history(sweep.folder(number)) for number, row in sweep.rows.items()
            if row["exit_code"] in (DONE, NOT_CONVERGED)}
    written = ["table.csv"]
    if good:
        with loading():
            from sweep_pictures import draw_curves, draw_response  # Matplotlib loads for a second
        about = read_about(sweep.folder(min(good)))
        draw_curves(sweep, good, about)
        draw_response(sweep, about)
        written += ["curves.png", "response.png"]
    held.close()
    for line in sweep.said_of_warnings():
        say(line)
    failed = len(sweep.points) - len(good)
    if not good and all(row["exit_code"] == WRONG for row in sweep.rows.values()):
        raise Trouble(f"no run is a scene, e.g. {sweep.rows[0]['message'].removeprefix('delam: ')}")
    say(f"wrote {sweep.out}: {', '.join(written)}" + (f"; {failed} runs failed" if failed else ""))
    return DONE if not failed and all(row["exit_code"] == DONE for row in sweep.rows.values()) else NOT_CONVERGED


if __name__ == "__main__":
    run_study(main)
