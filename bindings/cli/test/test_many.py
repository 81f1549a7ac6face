# SPDX-License-Identifier: BSD-3-Clause
"""The import of decks with many objects takes work in proportion to their number: instructions are counted by valgrind,
which does the same on every machine, for n objects of a kind and for twice as many. And what a small deck may stand for
is bounded. `whole`: all kinds, with more objects."""
import os
import re
import subprocess
import sys

from many_decks import KINDS, REFUSED, finished, instances, squares
from support import DELAM, expect, expect_error, finish, folder, start

MOST = 2.2  # of twice as many objects: sorting them takes 2.2 times from 500 on, and less for more
QUICK = ("bodies that touch", "continued keyword lines", "one pair of many bodies", "boundaries")
WHOLE = sys.argv[1:] == ["whole"]


def deck(text):
    path = os.path.join(folder(), "deck.inp")
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    return path


def instructions(text):
    """Of an import, and its exit code. The caches need no simulation for this."""
    counts = os.path.join(folder(), "counts")
    done = subprocess.run(["valgrind", "--tool=cachegrind", "--cache-sim=no", f"--cachegrind-out-file={counts}", DELAM, "import",
                           deck(text), "--out", os.path.join(folder(), "scene.toml")], capture_output=True, text=True,
                          timeout=600, check=False)
    found = re.search(r"I\s+refs:\s+([\d,]+)", done.stderr)
    return int(found[1].replace(",", "")) if found else 0, done.returncode


def grows():
    number = 2000 if WHOLE else 500
    for kind in KINDS if WHOLE else QUICK:
        few, code = instructions(KINDS[kind](number))
        many, other = instructions(KINDS[kind](2 * number))
        expect(code == other == (2 if kind in REFUSED else 0) and few > 0 and many <= MOST * few,
               f"{2 * number} {kind}: {many / max(few, 1):.3f} times the {few / 1e6:.0f} million instructions of {number}")


def bounds():
    """A few lines that stand for more than a machine can hold."""
    part = "*PART, NAME=P\n" + squares(20000, sections=False) + "*END PART\n"
    copies = part + "".join(f"*INSTANCE, NAME=I{k}, PART=P\n*END INSTANCE\n" for k in range(500))
    expect_error(start("import", deck(copies)), 2, "deck.inp:\\d+: \\*INSTANCE",
                 "with it the instances have 20\\d{6} nodes, elements and members of sets: at most 20000000")
    sets = squares(20000, one=True) + "".join(f"*NSET, NSET=X{k}, GENERATE\n1, 80000\n" for k in range(2000))
    if WHOLE:
        expect_error(start("import", deck(finished(sets))), 2, "deck.inp:\\d+: \\*NSET", "more than 100000000 members")
    one_place = re.sub(r"\n[\d.]+, 0\.0, 0\.0\n\*END INSTANCE", "\n*END INSTANCE", instances(2000))
    expect_error(start("import", deck(one_place)), 2, "touch, and 1000000 pairs of bodies before", "do bodies lie in one place?")
    twice = finished(squares(1) + "*NSET, NSET=A, NSET=B\n1\n")
    expect_error(start("import", deck(twice)), 2, "deck.inp:\\d+", "the parameter NSET is given twice")


if not any(os.access(os.path.join(path, "valgrind"), os.X_OK) for path in os.environ["PATH"].split(os.pathsep)):
    print("valgrind is not there")
    sys.exit(77)
grows()
bounds()
finish()
