# SPDX-License-Identifier: BSD-3-Clause
"""The specimens of a series: several files, all or some tests of a file, each with what a table of sheets says of it."""
import collections
import copy
import csv
import os
import re

from _pictures.input_file import Unreadable, quoted
from command import Trouble, say
from measured.one_test import SPECIMEN, tests_of
from measured.table_file import decoded, read_tables
from measured.units import title_and_unit
from specimens.sheet import SAME, SHEET

ALL = "all"
FILES = ("marks", "calibration")  # columns of a table of sheets that name files, beside those of SHEET and "crack"
SHORT = {"b": "width", "a0": "notch", "l": "half-span", "c": "lever"}  # symbols of the standards
NUMBER = re.compile(r"[+-]?[\d.,]+(?:[eE][+-]?\d+)?")


class Member:
    """name: unique in the series; given: as of a command line for this specimen alone; trouble: why it is not evaluated."""

    def __init__(self, name, stem, path, specimen, trouble=""):
        self.name, self.stem, self.path, self.specimen, self.trouble = name, stem, path, specimen, trouble
        self.given, self.found, self.warnings, self.counted = None, None, [], True

    def names(self):
        """What a sheet or an option may call it."""
        return {self.name, self.stem, os.path.basename(self.path), self.specimen} - {""}


def is_series(given):
    return len(given.data) > 1 or len(given.specimen) > 1 or given.specimen == [ALL] or bool(given.sheets or given.leave_out)


def _chosen(path, wanted):
    """Name and --specimen of each test that is wanted of a file."""
    stem = os.path.splitext(os.path.basename(path))[0]
    if wanted != [ALL]:
        return [(stem if not one else one if not one.isdigit() else f"{stem} {one}", stem, one) for one in wanted or [""]]
    tests = tests_of(read_tables(path))
    if len(tests) == 1:
        return [(tests[0].name or stem, stem, "")]
    many = collections.Counter(test.name for test in tests)
    return [(test.name, stem, test.name) if test.name and many[test.name] == 1 else (f"{stem} {k + 1}", stem, str(k + 1))
            for k, test in enumerate(tests)]


def _wanted(given):
    """What --specimen says of each file."""
    count, files = len(given.specimen), len(given.data)
    if count <= 1 or given.specimen == [ALL]:
        return [given.specimen] * files
    if files == 1:
        return [given.specimen]
    if count != files:
        raise Trouble(f"--specimen: {count} are given for {files} files: all, one for all of them, or one for each is expected")
    return [[one] for one in given.specimen]


def members_of(given):
    """The specimens, in the order of the files; one for a file that cannot be read."""
    members = []
    for path, wanted in zip(given.data, _wanted(given)):
        try:
            members += [Member(name, stem, path, one) for name, stem, one in _chosen(path, wanted)]
        except (Trouble, Unreadable, OSError) as error:
            stem = os.path.splitext(os.path.basename(path))[0]
            members.append(Member(stem, stem, path, "", str(error)))
    twice = [key for key, many in collections.Counter((os.path.realpath(m.path), m.specimen) for m in members).items() if many > 1]
    if twice:
        raise Trouble(f"{quoted(twice[0][0])} is given twice" + (f" with the specimen {quoted(twice[0][1])}" if twice[0][1] else "") +
                      ": a specimen counts once in a mean")
    for part in (lambda m: f"{m.stem} {m.specimen}".strip(), lambda m: f"{m.path} {m.specimen}".strip()):
        many = collections.Counter(member.name for member in members)
        for member in members:
            member.name = part(member) if many[member.name] > 1 else member.name
    rows = sheets_of(given.sheets) if given.sheets else []
    for member in members:
        member.given = _given_of(member, given, rows)
    for row in rows:
        if not row["used"] and not any(member.trouble for member in members):
            raise Trouble(f"{given.sheets}: line {row['line']}: there is no specimen {quoted(row['specimen'])}; there are: "
                          f"{', '.join(member.name for member in members)}")
    return members


def _given_of(member, given, rows):
    """The command line of one specimen: what its sheet says counts instead of what stands for all."""
    own = copy.copy(given)
    own.data, own.specimen, own.sheet = [member.path], [member.specimen] if member.specimen else [], dict(given.sheet)
    exact = [row for row in rows if row["specimen"] == member.name]
    of_file = [row for row in rows if row not in exact and row["specimen"] in member.names()]
    for twice in (exact, of_file):
        if len(twice) > 1:
            raise Trouble(f"{given.sheets}: lines {', '.join(str(row['line']) for row in twice)} are of one specimen, {member.name}")
    mine = of_file + exact  # what is said of a specimen counts before what is said of its file
    for row in mine:
        row["used"] = True
        for key, other, _ in SAME:
            if row["sheet"].keys() & {key, other}:
                own.sheet.pop(key, None)
                own.sheet.pop(other, None)
        own.sheet |= row["sheet"]
        own.crack, own.marks = row["crack"] or own.crack, row["marks"] or own.marks
        own.calibration = row["calibration"] or own.calibration
    return own


def _key_of(title):
    """The key of a column, or ""."""
    words = re.sub(r"[\s_]+", "-", title.strip().lower())
    known = {key.lower(): key for key in (*SHEET, *FILES, "crack")} | SHORT
    return "specimen" if words in SPECIMEN | {"file", "name"} else known.get(words, "")


def sheets_of(path):
    """The rows of a table of sheets: specimen, line, sheet (texts as options have them), marks, calibration, crack. Titles
    are the names of options, with units behind them; files are named from the folder of the table on."""
    lines = [(k + 1, line) for k, line in enumerate(decoded(path)[0].splitlines()) if line.strip() and not line.startswith("#")]
    if not lines:
        raise Trouble(f"{path}: the file is empty: a line of titles, and one for each specimen are expected")
    separator = next((one for one in ";\t," if one in lines[0][1]), ",")
    cells = list(csv.reader([line for _, line in lines], delimiter=separator))
    titles = [title_and_unit(cell) for cell in cells[0]]
    keys = [_key_of(title) for title, _ in titles]
    taken = [key for key in keys if key]
    if "specimen" not in keys or len(taken) < 2 or len(set(taken)) < len(taken):
        raise Trouble(f"{path}: titles are expected, each once: \"Specimen\" and some of {', '.join(SHEET)}, crack, {', '.join(FILES)}; it "
                      f"has: {', '.join(quoted(cell) for cell in cells[0])}")
    others = [title for (title, _), key in zip(titles, keys) if not key and title]
    say(f"{path}: sheets of {len(cells) - 1} specimens: {', '.join(key for key in keys if key and key != 'specimen')}"
        + (f"; not taken: {', '.join(quoted(title) for title in others)}" if others else ""))
    rows = []
    for (line, _), texts in zip(lines[1:], cells[1:]):
        row = {"specimen": "", "line": line, "sheet": {}, "marks": "", "calibration": [], "crack": "", "used": False}
        for key, (_, unit), text in zip(keys, titles, (text.strip() for text in texts)):
            if key in SHEET and text:
                plain = NUMBER.fullmatch(text)
                row["sheet"][key] = (text.replace(",", ".") if separator != "," else text) + (unit if plain else "")
            elif key and text:
                row[key] = text
        if not row["specimen"]:
            raise Trouble(f"{path}: line {line} names no specimen")
        beside = os.path.dirname(path)
        row["marks"] = os.path.join(beside, row["marks"]) if row["marks"] else ""
        if row["calibration"]:
            pairs = [word.partition("=") for word in row["calibration"].split()]
            row["calibration"] = [f"{length}{sign}{os.path.join(beside, name)}" for length, sign, name in pairs]
        rows.append(row)
    return rows
