# SPDX-License-Identifier: BSD-3-Clause
"""Files of test machines: a table of numbers, whatever stands before it, and how its numbers are written.

Machines write a preamble of names and settings, titles, a row of units, numbers with a point or a comma, and between
them semicolons, tabs, commas or blanks, in UTF-8, UTF-16 or a code page of Windows. Which of these a file has is not
guessed from its first lines: every way is tried, and the one counts that makes rows of numbers of the most lines.
"""
import collections
import csv
import re
from dataclasses import dataclass, field

import numpy as np

from _pictures.input_file import MOST_CURVE, quoted, read_bytes
from command import Trouble
from measured.units import kind_of, title_and_unit

# Separator, decimal sign; of two that make as many rows, the first.
WAYS = (("\t", "."), ("\t", ","), (";", "."), (";", ","), (",", "."), (",", ","), (" ", "."), (" ", ","))
NAMES = {"\t": "tabs", ";": "semicolons", ",": "commas", " ": "blanks"}

TRIED = 2000  # lines that choose among the ways: more than a preamble has

NUMBER = {".": re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eEdD][+-]?\d+)?|[+-]?(?:nan|inf)", re.I),
          ",": re.compile(r"[+-]?(?:\d+(?:\.\d{3})*(?:,\d+)?|,\d+)(?:[eE][+-]?\d+)?|[+-]?(?:nan|inf)", re.I)}
# A date, a time of the day, or both.
STAMP = re.compile(r"\d{1,4}(?:[:/.-]\d{1,4}){2,}(?:[T ]+\d{1,2}(?::\d{1,2}){1,2})?(?:[.,]\d+)?(?:\s*[APap][Mm])?")


@dataclass
class Table:
    """titles and units: a text for each column, "" where the file has none. columns: an array for each, NaN where a row
    has nothing, or a date. said: what the file is like, for people."""
    path: str
    titles: list
    units: list
    columns: list
    said: list = field(default_factory=list)


def decoded(path):
    """The text of a file, and the encoding if it is not UTF-8."""
    try:
        data = read_bytes(path, MOST_CURVE)
    except FileNotFoundError as error:
        raise Trouble(f"{path}: cannot be read: {error.strerror}") from error
    for mark, name in ((b"\xff\xfe", "utf-16"), (b"\xfe\xff", "utf-16")):
        if data.startswith(mark):
            try:
                return data.decode(name), "UTF-16"
            except UnicodeDecodeError:
                raise Trouble(f"{path}: begins as UTF-16, but is none") from None
    if b"\0" in data:
        raise Trouble(f"{path}: this is no text: it has a zero byte at {data.index(0)}")
    try:
        return data.decode("utf-8-sig"), ""
    except UnicodeDecodeError:
        return data.decode("cp1252", "replace"), "Latin-1 (Windows-1252)"


def cells_of(line, separator):
    """The cells of one line, without quotes and blanks around them."""
    if separator == " ":
        return line.split()
    if '"' in line:
        try:
            return [cell.strip() for cell in next(csv.reader([line], delimiter=separator, skipinitialspace=True), [])]
        except csv.Error:
            return [line]
    return [cell.strip() for cell in line.split(separator)]


def number_of(cell, decimal):
    """A number as it is written; NaN for nothing and for dates; None: it is a text."""
    if NUMBER[decimal].fullmatch(cell):
        if decimal == ",":
            cell = cell.replace(".", "").replace(",", ".") if "," in cell else cell
        return float(cell.replace("d", "e").replace("D", "e"))
    return float("nan") if not cell or STAMP.fullmatch(cell) else None


def row_of(line, way, least=2):
    """The numbers of a line, or None where it is no row of a table: a text, or fewer numbers than the least."""
    row = [number_of(cell, way[1]) for cell in cells_of(line, way[0])]
    if any(value is None for value in row) or sum(value == value for value in row) < least:
        return None
    return row


def _way(lines):
    """The way that makes most rows with one number of columns."""
    best, most = None, 0
    for way in WAYS:
        if way[0] != " " and not any(way[0] in line for line in lines):
            continue
        widths = collections.Counter(len(row) for row in (row_of(line, way) for line in lines) if row is not None)
        rows = widths.most_common(1)[0][1] if widths else 0
        if rows > most:
            best, most = way, rows
    return best


def _is_units(cells):
    """True if a line is a row of units: most of its texts are, in brackets or not."""
    texts = [cell.strip("[]() ") for cell in cells if cell.strip("[]() -")]
    return bool(texts) and sum(kind_of(text)[0] is not None for text in texts) > len(texts) / 2


def _header(lines, separator, width):
    """Titles and units of the columns from the lines that stand just before the numbers, and how many lines these are."""
    titles, units, taken = [""] * width, [""] * width, 0
    for line in reversed(lines[-2:]):
        cells = cells_of(line.lstrip("#"), separator)
        if len(cells) < 2 or len(cells) > width + 1 or not any(cells):
            break
        cells = (cells + [""] * width)[:width]
        taken += 1
        if _is_units(cells) and not any(units):
            units = [cell.strip("[]() ") for cell in cells]
            continue
        parted = [title_and_unit(cell) for cell in cells]
        titles = [title for title, _ in parted]
        units = [own or unit for (_, own), unit in zip(parted, units)]
        break
    return titles, units, taken


def _rows(path, lines, way, first):
    """All rows from the first on, and the place of the last one. Comments may stand between them, and texts behind the
    last one."""
    rows, last = [], first
    width = len(row_of(lines[first][1], way))
    for at in range(first, len(lines)):
        number, line = lines[at]
        row = row_of(line, way, 1)
        if row is not None and len(row) <= width:
            rows.append(row + [float("nan")] * (width - len(row)))
            last = at
        elif not line.lstrip().startswith("#"):
            cells = cells_of(line, way[0])
            wrong = [cell for cell in cells if number_of(cell, way[1]) is None]
            if len(wrong) < len(cells) == width or any(row_of(text, way) for _, text in lines[at + 1:]):
                raise Trouble(f"{path}: row {len(rows) + 1} of the numbers (line {number}) " + (
                    f"has {quoted(wrong[0])}, which is no number" if wrong else
                    f"has {len(cells)} columns, {width} are expected"))
            break
    return rows, last


def read_table(path):
    """The table of a file; Trouble says why there is none."""
    text, encoding = decoded(path)
    every = [(k + 1, line) for k, line in enumerate(text.replace("\r\n", "\n").replace("\r", "\n").split("\n"))]
    lines = [(number, line) for number, line in every if line.strip()]
    if not lines:
        raise Trouble(f"{path}: the file is empty: rows with at least 2 numbers are expected")
    way = _way([line for _, line in lines[:TRIED]])
    if way is None:
        raise Trouble(f"{path}: there are no numbers: rows with at least 2 of them are expected")
    found = [row_of(line, way) for _, line in lines[:TRIED]]
    width = collections.Counter(len(row) for row in found if row is not None).most_common(1)[0][0]
    first = next(k for k, row in enumerate(found) if row is not None and len(row) == width)
    rows, last = _rows(path, lines, way, first)
    titles, units, used = _header([line for _, line in lines[:first]], way[0], width)
    said = [] if not encoding else [encoding]
    if first - used > 0:
        said.append(f"{first - used} line{'s' if first - used > 1 else ''} before the table")
    said.append(f"{NAMES[way[0]]} between {'numbers with decimal commas' if way[1] == ',' else 'numbers'}")
    said.append(f"{len(rows)} rows from line {lines[first][0]} on")
    if last + 1 < len(lines):
        behind = len(lines) - last - 1
        said.append(f"{behind} line{'s' if behind > 1 else ''} of text behind them")
    return Table(path, titles, units, list(np.array(rows).T), said)
