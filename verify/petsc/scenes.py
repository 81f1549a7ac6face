#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""scenes.py [--brief] [--ranks 1,2,4] [--part I/N] [--loose] [--repeat] [NAME ...]

Scenes on several numbers of ranks, each compared with the program of one process and with the first of these numbers:
reactions, energies, debonded length, contact and the fields of all steps (comparison.py). Without NAME: those of
small_scenes.quick().

--brief   fewer scenes, each on 2 ranks, or on 4
--part    each N-th of the scenes, from the I-th on
--loose   with the scenes' own damage_tolerance instead of a small one
--repeat  only: with it, two runs on the same ranks differ by no more than the manual of the command line says
"""
import argparse
import os
import re
import time

import small_scenes
from comparison import ALLOWED, FIELDS, ROUNDED, Result, compared
from launch import alone, expect, finish, folder, last_lines, on_ranks

TIGHT = "1e-10"
# Between two runs on the same ranks, of the largest value of its kind: bindings/cli/MANUAL.md promises it.
REPEATED = 1e-6
# On several ranks, only analyses of so many solves: one takes 15 ms on 2 and 4 ranks, 0.1 s on 8 and 0.7 to 1 s on 16
# where there are two cores, so that an analysis ends within a minute.
MOST_SOLVES = {2: 5000, 4: 5000, 8: 300, 16: 60}
# In s. Beside other programs a rank that waits for a message gets its processor back milliseconds later, and analyses
# have taken six times as long.
LIMIT = 600


def counted(said):
    found = re.search(r"counts: solves (\S+) iterations (\S+) renewals (\S+)", said)
    return "/".join(found.groups()) if found else "-"


def solve(name, scene, words, ranks):
    """The result and a text of counts; None where the run fails. ranks: 0 for the serial program."""
    out = os.path.join(folder(), "out")
    if ranks == 0:
        code, said = alone("run", scene, "--out", out, *words)
    else:
        code, said = on_ranks(ranks, "--counts", "run", scene, "--out", out, *words, limit=LIMIT)
    right = code in (0, 1) and os.path.exists(os.path.join(out, "result.json"))
    expect(right, f"{name}: {f'{ranks} ranks' if ranks else 'serial'} come to the end"
           + ("" if right else f": exit {code}: {last_lines(said)}"))
    expected = small_scenes.SAYS.get(name, {}).get(ranks, "")
    if expected:
        expect(expected in said, f"{name}: {ranks} ranks say: {expected}")
    return (Result(out), code, counted(said)) if right else None


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--ranks", default="1,2,4")
    parser.add_argument("--brief", action="store_true")
    parser.add_argument("--part", default="1/1")
    parser.add_argument("--loose", action="store_true")
    parser.add_argument("--repeat", action="store_true")
    parser.add_argument("name", nargs="*")
    options = parser.parse_args()
    scenes = small_scenes.quick()
    if options.brief:
        scenes = {name: scene for name, scene in scenes.items() if name not in small_scenes.NOT_BRIEF}
    kind = "loose" if options.loose or options.repeat else "tight"
    part, parts = map(int, options.part.split("/"))
    known = {**small_scenes.quick(), **small_scenes.whole()}
    for name in options.name or list(scenes)[part - 1::parts]:
        scene, settings = known[name]
        if kind == "tight":
            settings = [*settings, f"solver.damage_tolerance={TIGHT}"]
        # Ranks take steps whole (step_control = auto) and keep rotations small (kinematics = auto); the serial program
        # does so where it is asked.
        settings = [*settings, "solver.kinematics=linear"]
        if not any("step_control" in setting for setting in settings):
            settings = [*settings, "solver.step_control=fixed"]
        words = [word for setting in [*settings, FIELDS] for word in ("--set", setting)]
        if options.repeat:
            for ranks in map(int, options.ranks.split(",")):
                runs = [solve(name, scene, words, ranks) for _ in range(2)]
                if None not in runs:
                    compared(name, f"{ranks} ranks twice", runs[0][0], runs[1][0], REPEATED, False)
            continue
        allowed = max(ALLOWED[kind], ROUNDED.get(name, 0.0))
        serial = solve(name, scene, words, 0)
        first = None
        counts = "4" if name in small_scenes.ON_FOUR else "2"
        solves = 0
        for ranks in map(int, (counts if options.brief else options.ranks).split(",")):
            if solves > MOST_SOLVES.get(ranks, solves):
                print(f"      {name}: {ranks} ranks: left out, {solves} solves")
                continue
            begun = time.monotonic()
            found = solve(name, scene, words, ranks)
            if found is None:
                continue
            result, code, effort = found
            took = time.monotonic() - begun
            solves = int(effort.split("/")[0])
            if serial is not None:
                compared(name, f"{ranks} ranks and the serial program", result, serial[0], allowed,
                         kind == "tight")
                expect(code == serial[1], f"{name}: {ranks} ranks end as the serial program does: {code}, {serial[1]}")
            if ranks == 1 and name in small_scenes.UNTOUCHED:
                rarely = solve(name, scene, [*words, "--set", "output.every=1000"], 1)
                expect(rarely is not None and rarely[2] == effort,
                       f"{name}: fields of each step take no solve: {effort}, rarely {rarely and rarely[2]}")
            if first is None:
                first = (ranks, result)
            else:
                compared(name, f"{ranks} ranks and {first[0]}", result, first[1], allowed, kind == "tight")
            print(f"      {name}: {ranks} ranks: {effort} solves, iterations, renewals; {took:.1f} s", flush=True)
    finish()


if __name__ == "__main__":
    main()
