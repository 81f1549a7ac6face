# SPDX-License-Identifier: BSD-3-Clause
"""The test of one specimen from a file that may have several: one below the other, side by side, or told apart by a
column. Blocks of one test are joined."""
import re

import numpy as np

from _pictures.input_file import quoted
from command import Trouble
from measured.columns import found, guess, words_of
from measured.table_file import LEAST_ROWS, read_tables

SPECIMEN = {"specimen", "sample", "probe", "probekörper", "prüfling", "éprouvette", "eprouvette", "probeta", "provino"}
# A block goes on with the test before it if x begins no farther from its end than this part of the range: tests begin
# at the displacement 0 again. Half and twice of it join the same in test_tables.py.
NEAR = 0.1
SHOWN = 6  # tests that a message lists


def _sides(table):
    """Groups of columns with the same titles, but for numbers in them: a test each."""
    plain = [re.sub(r"[\d_.]+", "", title).strip().lower() for title in table.titles]
    width = len(plain)
    for many in range(2, width // 2 + 1):
        if width % many or not all(plain[:many]) or any(plain[k] != plain[k - many] for k in range(many, width)):
            continue
        sides = []
        for begin in range(0, width, many):
            columns = range(begin, begin + many)
            rows = np.any([np.isfinite(table.columns[k]) for k in columns], axis=0)
            if rows.any():
                side = table.part(rows, columns)
                side.name = next((cell for cell in side.above if cell), "")
                sides.append(side)
        if all(found(side, "displacement") and found(side, "force") for side in sides):
            return sides
    return [table]


def _by_column(table):
    """Parts of a table that a column of specimens tells apart."""
    for k, title in enumerate(table.titles):
        if not SPECIMEN & set(words_of(title)):
            continue
        names = table.texts.get(k) or [f"{value:g}" for value in table.columns[k]]
        places = [0] + [at for at in range(1, len(names)) if names[at] != names[at - 1]] + [len(names)]
        sizes = np.diff(places)
        if len(sizes) > 1 and sizes.min() >= LEAST_ROWS and len({names[at] for at in places[:-1]}) == len(sizes):
            return [table.part(slice(begin, end), name=names[begin]) for begin, end in zip(places, places[1:])]
    return [table]


def _by_breaks(table):
    """Parts of a table between which the time begins again, or where an empty line stands."""
    time = found(table, "time")[:1]
    gaps = np.flatnonzero(np.diff(table.lines) > 1) + 1
    gaps = gaps if len(gaps) * LEAST_ROWS < len(table.lines) else gaps[:0]  # a file with every other line empty
    again = np.flatnonzero(np.diff(table.columns[time[0]]) < 0) + 1 if time else gaps[:0]
    places = [0, *(int(at) for at in np.union1d(gaps, again)), len(table.lines)]
    if len(places) == 2 or np.min(np.diff(places)) < LEAST_ROWS:
        return [table]
    return [table.part(slice(begin, end)) for begin, end in zip(places, places[1:])]


def _goes_on(first, second):
    """True if a table goes on with the test of the one before it: in its time, or where it has none in x."""
    if first.titles != second.titles:
        return False
    time = found(first, "time")[:1]
    if time:
        ends, begins = (table.columns[time[0]][np.isfinite(table.columns[time[0]])] for table in (first, second))
        if len(ends) and len(begins) and begins[0] >= ends[-1]:
            return True
    x = (guess(first) or [0])[0]
    ends, begins = (table.columns[x][np.isfinite(table.columns[x])] for table in (first, second))
    if not len(ends) or not len(begins):
        return True
    return abs(begins[0] - ends[-1]) <= NEAR * np.ptp(np.concatenate([ends, begins]))


def _joined(first, second):
    table = first.part(slice(None), name=first.name)
    table.columns = [np.concatenate(pair) for pair in zip(first.columns, second.columns)]
    table.texts = {k: first.texts[k] + second.texts[k] for k in first.texts}
    table.lines = np.concatenate([first.lines, second.lines])
    table.blocks = first.blocks + 1
    return table


def tests_of(tables):
    """The tests of a file, whose tables these are."""
    tests, told = [], False
    for table in tables:
        apart = [one for side in _sides(table) for one in _by_column(side)]
        told = told or len(apart) > 1
        parts = apart if len(apart) > 1 else _by_breaks(table)
        for part in parts:
            if tests and not told and _goes_on(tests[-1], part):
                tests[-1] = _joined(tests[-1], part)
            else:
                tests.append(part)
    return tests


def _listed(tests):
    """The tests as a message names them."""
    words = [f"{k + 1}" + (f" {quoted(test.name)}" if test.name else "") + f" (lines {test.lines[0]} to {test.lines[-1]})"
             for k, test in enumerate(tests[:SHOWN])]
    return ", ".join(words) + (", .." if len(tests) > SHOWN else "")


def read_test(path, specimen="", option="--specimen 1"):
    """The table of one test. specimen: its name or its number from 1 on, where the file has several; option: what takes the
    first one, for a message."""
    tests = tests_of(read_tables(path))
    if not specimen and len(tests) > 1:
        raise Trouble(f"{path}: the file has {len(tests)} tests: {_listed(tests)}: {option}, for example, takes the first one")
    chosen = [test for test in tests if test.name == specimen] if specimen else tests
    if not chosen and re.fullmatch(r"\d{1,6}", specimen) and 1 <= int(specimen) <= len(tests):
        chosen = [tests[int(specimen) - 1]]
    if not chosen:
        raise Trouble(f"{path}: there is no specimen {quoted(specimen)}: the file has {len(tests)} test"
                      f"{'s' if len(tests) > 1 else ''}: {_listed(tests)}")
    test = chosen[0]
    said = list(test.said)
    rows = f"{len(test.lines)} rows from line {test.lines[0]} on"
    if test.blocks > 1:
        rows += f" in {test.blocks} blocks, which are joined"
    at = next((k for k, text in enumerate(said) if "behind it" in text), len(said))
    said.insert(at, rows)
    if len(tests) > 1:
        said.insert(0, f"specimen {quoted(specimen)} of {len(tests)} tests")
    test.said = said
    return test
