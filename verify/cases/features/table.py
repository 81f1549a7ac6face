#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""table.py plane|space [--write]

Runs every feature with every other, and three at a time, in the plane or in space, and compares the table with the one
in TABLE.md, or writes it there. Fails if an entry fails or the page is stale. table.py plane FEATURE ... runs these
features together and says what comes of them."""
import itertools
import logging
import pathlib
import re
import string
import sys
import textwrap

from judge import FAILED, REFUSED, WORKS, outcome
from scene import DEFAULTS, ENGINE, FEATURES, FETI, SPACE

PAGE = pathlib.Path(__file__).resolve().parent / "TABLE.md"
WIDTH = 120


def together(features):
    """True if a scene can have all of them: one of each group."""
    groups = [feature.group for feature in features if feature.group]
    return len(groups) == len(set(groups))


def names(features):
    return " x ".join(feature.name for feature in features)


class Table:
    def __init__(self, dimension):
        self.dimension, self.with_all = dimension, (SPACE,) if dimension == "space" else ()
        self.entries = {}  # outcomes by features

    def judge(self, features):
        letter, text = outcome((*self.with_all, *features))
        # How many substeps a step takes, rounding decides.
        entry = self.entries[features] = letter, re.sub(r"\b\d+ substeps", "several substeps", text)
        if entry[0] != WORKS:
            print(f"{self.dimension}: {names(features)}: {entry[0]} {entry[1]}", flush=True)

    def run(self):
        for feature in FEATURES:
            self.judge((feature,))
        for two in filter(together, itertools.combinations(FEATURES, 2)):
            self.judge(two)
        # What is the default anyway is in all pairs, and three of which two are refused are refused. The engine, and in
        # space FETI, take most of the time.
        left_out = {*DEFAULTS, ENGINE, *([FETI] if self.with_all else [])}
        chosen = [feature for feature in FEATURES if feature not in left_out]
        for three in filter(together, itertools.combinations(chosen, 3)):
            if all(self.entries[two][0] == WORKS for two in itertools.combinations(three, 2)):
                self.judge(three)

    def failures(self):
        return sum(letter == FAILED for letter, _ in self.entries.values())

    def count(self, size):
        letters = [entry[0] for features, entry in self.entries.items() if len(features) == size]
        return f"{letters.count(WORKS)} work, {letters.count(REFUSED)} are refused, {letters.count(FAILED)} fail"

    def rows(self):
        yield " " * 19 + " ".join(string.ascii_lowercase[: len(FEATURES)])
        for i, row in enumerate(FEATURES):
            letters = [self.entries.get((column, row), (".",))[0] for column in FEATURES[:i]]
            yield f"{string.ascii_lowercase[i]} {row.name:16} {' '.join([*letters, self.entries[row,][0]])}"

    def page(self):
        """The part of the page between the markers."""
        lines = ["", "```", *self.rows(), "```", "",
                 f"Pairs: {self.count(2)}. Three at a time, where the pairs work: {self.count(3)}.", ""]
        for features, (letter, text) in self.entries.items():
            if letter != WORKS:
                lines += textwrap.wrap(f"{names(features)}: {text}", WIDTH, initial_indent="- ", subsequent_indent="  ")
        return "\n".join(lines) + "\n"


def main():
    logging.disable(logging.CRITICAL)
    dimension, *words = sys.argv[1:]
    table = Table(dimension)
    chosen = [feature for feature in FEATURES if feature.name in words]
    if chosen:
        print(*outcome((*table.with_all, *chosen)))
        return 0
    table.run()
    part = table.page()
    print(part)
    begin, end = f"<!-- {dimension}: table.py writes this -->\n", f"<!-- {dimension} ends -->"
    before, rest = PAGE.read_text(encoding="utf-8").split(begin)
    kept, after = rest.split(end)
    if words == ["--write"]:
        PAGE.write_text(before + begin + part + end + after, encoding="utf-8")
        kept = part
    if kept != part:
        print(f"the table of {PAGE} is stale: python3 {sys.argv[0]} {dimension} --write", file=sys.stderr)
    return 1 if table.failures() or kept != part else 0


if __name__ == "__main__":
    sys.exit(main())
