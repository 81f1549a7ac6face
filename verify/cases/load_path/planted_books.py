#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""planted_books.py: the closing numbers of some examples are those of their files (books.py), and an error that is
planted in one of the four books is found. Skipped without the program (DELAM)."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import books

EXAMPLES = pathlib.Path(__file__).resolve().parents[3] / "examples"
# One mode with a process zone, one that jumps, mixed mode, and single pairs that pop.
SCENES = (("enf", ("time.steps=20",)),
          ("enf", ("time.steps=10", "laws[0].normal_onset=249", "laws[0].tangential_onset=249")),
          ("mmb", ("time.steps=20",)), ("dcb-alfano", ("time.steps=40",)))
failures = 0


def expect(condition, what):
    global failures
    print(("ok    " if condition else "FAIL  ") + what)
    failures += 0 if condition else 1


def planted(folder, book, mixed):
    """Makes the closing number of a book wrong, as an error of the program would: work by the sign of the reaction in
    the last step, the others by 1 % of what is dissipated, in mixed mode dissipated energy by twice its value."""
    path = folder / "result.json"
    about = json.loads(path.read_text())
    balance = about["energy_balance"]
    kept = path.read_text()
    if book == "work":
        before, last = books.table(folder / "history.csv")[-2:]
        balance["last_work"] -= 2 * (float(last["load"]) - float(before["load"])) * float(last["reaction"])
    else:
        balance[book] += (2.0 if book == "dissipated" and mixed else 0.01) * balance["dissipated"]
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
            wrong = books.differing(scene, folder)
            expect(not wrong, f"{name} {' '.join(settings)}: {wrong or 'the files give the closing numbers'}")
            for book in ("work", "stored", "dissipated", "released"):
                heal = planted(folder, book, name == "mmb")
                expect([line.split(":")[0] for line in books.differing(scene, folder)] == [book],
                       f"{name}: an error in {book} is found, and in no other book")
                heal()
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
