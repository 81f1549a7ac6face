#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""scenes.py [--brief] [--ranks 1,2,4] [--whole] [--loose] [NAME ...]

Scenes on several numbers of ranks, each compared with the program of one process and with the first of these numbers:
reactions, energies, debonded length, contact and the fields of all steps that are written. Without NAME: all of
small_scenes.py.

--brief   fewer scenes, each on 1 and 2 ranks, or on 1 and 4
--whole   larger scenes as well, on these ranks
--loose   with the scenes' own damage_tolerance instead of a small one
"""
import argparse
import csv
import os
import re
import time

import h5py
import numpy as np

import small_scenes
from launch import alone, expect, finish, folder, last_lines, on_ranks

TIGHT = "1e-10"
# What a comparison may differ by, of the largest value of its kind; by the size of damage_tolerance.
ALLOWED = {"tight": 1e-8, "loose": 2e-3}
# On more ranks than this, four or more to a core, only marches of few solves: each takes a quarter of a second there.
MANY, MOST_SOLVES = 4, 200
# A nearly incompressible body amplifies rounding. Scene: allowed of the tight comparison with the serial program.
ROUNDED = {"incompressible": 1e-7}
# Stresses and rotations are differences of displacements over a cell: rounding weighs more in them, by the displacement
# of a slender body over the elongation of its cells. Seen up to 3.1e-8.
DERIVED = {"stress": 1e-7, "rotation": 1e-7}
FIELDS = 'output.fields=["displacement", "stress", "rotation", "zeta", "jump", "traction", "contact"]'
# What follows from the state and its history. With the variational mixity rule, what is called dissipated depends on
# the way of the minimisation within a step, and only the split of the _slides does not.
ENERGIES = ("stored_bulk", "stored_interface", "work")
DISSIPATED = {"variational": ("stored_interface_slides", "dissipated_slides")}


class Result:
    def __init__(self, out):
        with open(os.path.join(out, "history.csv"), newline="", encoding="utf-8") as file:
            rows = list(csv.reader(file))
        rule = rows[-1][rows[0].index("mixity_rule")]
        self.energies = [*ENERGIES, *DISSIPATED.get(rule, ("dissipated", "released"))]
        self.rows = {name: np.array([float(row[i]) for row in rows[1:]]) for i, name in enumerate(rows[0])
                     if name not in ("solution", "mixity_rule")}
        self.adhesion, self.contact = [], []
        with h5py.File(os.path.join(out, "fields.h5"), "r") as file:
            self.steps = sorted(file["steps"])
            # Of nodes, of cells, and the places of interfaces: all steps.
            self.fields = {name: np.stack([file["steps"][step][name][()] for step in self.steps])
                           for name in ("displacement", "stress", "rotation")}
            self.fields["faces"] = np.concatenate([file["steps"][step][name]["displacement"][()].ravel()
                                                   for step in self.steps for name in sorted(file["interfaces"])])
            self.turned = [file["steps"][step].attrs["rotation_max"] for step in self.steps]
            last = file["steps"][self.steps[-1]]
            for name in sorted(file["interfaces"]):
                if "zeta" in last[name]:
                    self.adhesion.append(last[name]["zeta"][()].ravel())
                if "contact" in last[name]:
                    self.contact.append(last[name]["contact"][()].ravel() != 0)

    def differences(self, other):
        """Of every kind: the largest difference from the other, of the largest value of the kind."""
        def of(a, b, size):
            return float(np.abs(a - b).max() / size) if size > 0 else float(np.abs(a - b).max())
        a, b = self.rows, other.rows
        energy = max(np.abs(b[name]).max() for name in self.energies)
        found = {"reaction": max(of(a[name], b[name], np.abs(b[name]).max()) for name in b
                                 if name.startswith("reaction")),
                 "energy": max(of(a[name], b[name], energy) for name in self.energies),
                 "debonded": of(a["debonded_length"], b["debonded_length"], b["debonded_length"].max()),
                 "adhesion": max((of(*pair, 1.0) for pair in zip(self.adhesion, other.adhesion)), default=0.0),
                 "turned": of(np.array(self.turned), np.array(other.turned), max(other.turned))}
        if self.steps != other.steps or any(self.fields[name].shape != other.fields[name].shape
                                            for name in self.fields):
            raise ValueError(f"fields of other steps or shapes: {self.steps}, {other.steps}")
        found.update({name: of(self.fields[name], other.fields[name], np.abs(other.fields[name]).max(initial=0.0))
                      for name in self.fields})
        pairs = int(np.abs(a["contact_pairs"] - b["contact_pairs"]).max())
        changed = sum(int((x != y).sum()) for x, y in zip(self.contact, other.contact))
        return found, max(pairs, changed)


def counted(said):
    found = re.search(r"counts: solves (\S+) iterations (\S+) renewals (\S+)", said)
    return "/".join(found.groups()) if found else "-"


def solve(name, scene, words, ranks):
    """The result and a text of counts; None where the run fails. ranks: 0 for the serial program."""
    out = os.path.join(folder(), "out")
    if ranks == 0:
        code, said = alone("run", scene, "--out", out, *words)
    else:
        code, said = on_ranks(ranks, "--counts", "run", scene, "--out", out, *words)
    right = code in (0, 1) and os.path.exists(os.path.join(out, "result.json"))
    expect(right, f"{name}: {f'{ranks} ranks' if ranks else 'serial'} come to the end"
           + ("" if right else f": exit {code}: {last_lines(said)}"))
    expected = small_scenes.SAYS.get(name, {}).get(ranks, "")
    if expected:
        expect(expected in said, f"{name}: {ranks} ranks say: {expected}")
    return (Result(out), code, counted(said)) if right else None


def compared(name, what, result, reference, allowed, exact):
    if reference is None or len(reference.rows["step"]) != len(result.rows["step"]):
        expect(reference is None, f"{name}: {what}: the same number of steps")
        return
    found, changed = result.differences(reference)
    numbers = " ".join(f"{kind} {value:.1e}" for kind, value in found.items())
    right = changed == 0 or not exact
    for kind, value in found.items():
        right = right and value <= max(allowed, DERIVED.get(kind, 0.0))
    text = f"{name}: {what}: {numbers}, {changed} contact pairs differ"
    expect(right, text)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--ranks", default="1,2,4")
    parser.add_argument("--brief", action="store_true")
    parser.add_argument("--whole", action="store_true")
    parser.add_argument("--loose", action="store_true")
    parser.add_argument("name", nargs="*")
    options = parser.parse_args()
    scenes = small_scenes.quick()
    if options.whole:
        scenes.update(small_scenes.whole())
    if options.brief:
        scenes = {name: scene for name, scene in scenes.items() if name not in small_scenes.NOT_BRIEF}
    kind = "loose" if options.loose else "tight"
    for name in options.name or scenes:
        scene, settings = scenes[name]
        if kind == "tight":
            settings = [*settings, f"solver.damage_tolerance={TIGHT}"]
        words = [word for setting in [*settings, FIELDS] for word in ("--set", setting)]
        allowed = ALLOWED[kind]
        serial = solve(name, scene, words, 0)
        first = None
        counts = "1,4" if name in small_scenes.ON_FOUR else "1,2"
        solves = 0
        for ranks in map(int, (counts if options.brief else options.ranks).split(",")):
            if ranks > MANY and solves > MOST_SOLVES:
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
                compared(name, f"{ranks} ranks and the serial program", result, serial[0],
                         max(allowed, ROUNDED.get(name, 0.0)), kind == "tight")
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
