#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""energy_balance.py SCENE.toml FOLDER: computes the four energies of the closing line anew, from history.csv, jumps.csv and the
last fields of fields.h5, for scenes in the plane with one bilinear law, no gaps and no dead forces: work from the
reactions (each between its values at the ends of a step), stored energy by Clapeyron's theorem, dissipated energy from
the adhesion of each pair (between its values in mode I and II; modes of other
criteria than Benzeggagh-Kenane may lie 1e-4 outside of them), released energy from jumps and pops."""
import csv
import json
import pathlib
import sys
import tomllib

import h5py
import numpy as np


def table(path):
    return list(csv.DictReader(path.open())) if path.exists() else []


def columns(rows, begin):
    return np.array([[float(row[k]) for k in row if k.split("_")[0] == begin and k != "load_potential"] for row in rows])


def dissipated_by(law, zeta, mode):
    """Per area: of the triangle under the law, what is neither left nor stored."""
    onset, toughness = law[f"{mode}_onset"], law[f"{mode}_toughness"]
    return toughness * (1 - zeta) / (1 - zeta + zeta * toughness / onset)


def recomputed(scene, folder):
    """name -> (what the closing line says, what the files say, how far the two may be apart)."""
    rows, law = table(folder / "history.csv"), tomllib.loads(scene.read_text())["laws"][0]
    said = json.loads((folder / "result.json").read_text())["energy_balance"]
    load, reaction = columns(rows, "load"), columns(rows, "reaction")
    work = np.sum(0.5 * (reaction[1:] + reaction[:-1]) * np.diff(load, axis=0))
    damages = np.diff([float(row["dissipated"]) for row in rows]) > 0
    within = np.sum(0.5 * np.abs(np.diff(reaction, axis=0) * np.diff(load, axis=0))[damages])
    jumps = sum(float(row["released"]) for row in table(folder / "jumps.csv"))
    pops = sum(float(row["popped"]) for row in rows)
    with h5py.File(folder / "fields.h5") as file:
        first, last = (file["steps"][name] for name in (min(file["steps"]), max(file["steps"])))
        lost = [sum(np.sum(interface["weights"][:] * (dissipated_by(law, last[name]["zeta"][:], mode)
                                                      - dissipated_by(law, first[name]["zeta"][:], mode)))
                    for name, interface in file["interfaces"].items()) for mode in ("normal", "tangential")]
    total = np.sum(0.5 * load[-1] * reaction[-1])
    return {"work": (said["last_work"], work, within), "stored": (said["stored"], total, 1e-7 * total),
            "dissipated": (said["dissipated"], sum(lost) / 2, abs(lost[1] - lost[0]) / 2 + 1e-4 * lost[0]),
            "released": (said["released"], jumps + pops, 1e-9 * abs(said["last_work"]))}


def differing(scene, folder):
    return [f"{name}: the closing line says {said}, the files {files}, allowed difference {most}"
            for name, (said, files, most) in recomputed(scene, folder).items() if not abs(said - files) <= most]


if __name__ == "__main__":
    sys.exit("\n".join(differing(*map(pathlib.Path, sys.argv[1:]))) or None)
