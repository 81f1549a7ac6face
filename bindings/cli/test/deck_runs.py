# SPDX-License-Identifier: BSD-3-Clause
"""What tests of decks do with one: import it, run it to its history, see it refused."""
import csv
import math
import os

from support import delam, expect, expect_error, folder, write

NOT_NUMBERS = ("solution", "mixity_rule")


def imported(text):
    """The scene, and what is said of it."""
    code, scene, said = delam("import", write(text, "deck.inp"))
    expect(code == 0, f"import: exit {code} {said.strip()[:300]}")
    return scene, said


def refused(text, *patterns):
    expect_error(delam("import", write(text, "deck.inp")), 2, *patterns)


def history(text, *words, name="deck.inp", **others):
    """Rows of history.csv, what is said, and the folder of the result; others: files beside the deck, by name."""
    place = folder()
    for other, content in others.items():
        write(content, other.replace("_", "."), place)
    out = os.path.join(place, "out")
    code, said, error = delam("run", write(text, name, place), "--out", out, *words)
    expect(code == 0, f"exit {code}: {error.strip()[:400]}")
    if code != 0:
        return [], said + error, out
    with open(os.path.join(out, "history.csv"), newline="", encoding="utf-8") as file:
        rows = [{key: float(value) for key, value in line.items() if key not in NOT_NUMBERS}
                for line in csv.DictReader(file)]
    return rows, said + error, out


def close(what, found, wanted, allowed=1e-9):
    expect(math.isclose(found, wanted, rel_tol=allowed, abs_tol=1e-14), f"{what}: {found}, {wanted} is expected")
