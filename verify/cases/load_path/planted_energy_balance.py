#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""planted_energy_balance.py: the closing numbers of some examples are those of their files (energy_balance.py), and an error that is
planted in one of the four energies is found. Skipped without the program (DELAM)."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import energy_balance

EXAMPLES = pathlib.Path(__file__).resolve().parents[3] / "examples"
# One mode with a process zone, one that jumps, mixed mode, and single pairs that pop; rotations are small.
LINEAR = "solver.kinematics=linear"
SCENES = (("enf", (LINEAR, "time.steps=20")),
          ("enf", (LINEAR, "time.steps=10", "laws[0].normal_onset=249", "laws[0].tangential_onset=249")),
          ("mmb", ("time.steps=20",)), ("dcb-alfano", ("time.steps=40",)))
failures = 0


def expect(condition, what):
    global failures
    print(("ok    " if condition else "FAIL  ") + what)
    failures += 0 if condition else 1


def planted(folder, energy, mixed):
    """Makes the closing number of an energy wrong, as an error of the program would: work by the sign of the reaction in
    the last step, the others by 1 % of what is dissipated, in mixed mode dissipated energy by twice its value."""
    path = folder / "result.json"
    about = json.loads(path.read_text())
    balance = about["energy_balance"]
    kept = path.read_text()
    if energy == "work":
        before, last = energy_balance.table(folder / "history.csv")[-2:]
        balance["last_work"] -= 2 * (float(last["load"]) - float(before["load"])) * float(last["reaction"])
    else:
        balance[energy] += (2.0 if energy == "dissipated" and mixed else 0.01) * balance["dissipated"]
    path.write_text(json.dumps(about))
    return lambda: path.write_text(kept)


def main():
    if "DELAM" not in os.environ:
        return 77
    for name, settings in SCENES:
        scene = EXAMPLES / name / f"{name}.toml"
        with tempfile.TemporaryDirectory() as place:
            folder = pathlib.Path(place) / "out"
            words = [word for setting in settings for word in ("--set", setting)]
            subprocess.run([os.environ["DELAM"], "run", scene, "--out", folder, *words], check=True, capture_output=True)
            wrong = energy_balance.differing(scene, folder)
            expect(not wrong, f"{name} {' '.join(settings)}: {wrong or 'the files give the closing numbers'}")
            for energy in ("work", "stored", "dissipated", "released"):
                heal = planted(folder, energy, name == "mmb")
                expect([line.split(":")[0] for line in energy_balance.differing(scene, folder)] == [energy],
                       f"{name}: an error in {energy} is found, and in no other energy")
                heal()
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
