# SPDX-License-Identifier: BSD-3-Clause
"""Files of test machines: tables of numbers, whatever stands before, between and behind them."""
from dataclasses import dataclass, field

import numpy as np

from _pictures.input_file import MOST_CURVE, quoted, read_bytes
from command import Trouble
from measured.number_forms import MISSING, NAMES, cells_of, form_of, number_of, row_of
from measured.units import kind_of, title_and_unit

TRIED = 2000  # lines that choose among the forms: more than a preamble has
# Fewer rows, or a smaller part of the longest table, are no table of a test: machines write results before and behind it,
# a row for a specimen. In test_tables.py, 2 rows take such a results table for one more test; 10 rows, and half and twice of
# the part, find the same.
LEAST_ROWS, LEAST_PART = 5, 0.05


@dataclass
class Table:
    """titles and units: a text for each column, "" where the file has none. columns: an array for each, NaN where a row
    has nothing, or a date; texts: the words of the columns that have them. lines: the line of each row. above: the cells
    of the line above the titles. name: of the specimen. blocks: of how many runs of rows it is. said: what the file is
    like, for people."""
    path: str
    titles: list
    units: list
    columns: list
    texts: dict
    lines: np.ndarray
    above: list = field(default_factory=list)
    name: str = ""
    blocks: int = 1
    said: list = field(default_factory=list)

    def part(self, rows, columns=None, name=""):
        """Some of the rows and columns; columns: a range."""
        chosen = list(range(len(self.columns))) if columns is None else list(columns)
        return Table(self.path, [self.titles[k] for k in chosen], [self.units[k] for k in chosen],
                     [self.columns[k][rows] for k in chosen],
                     {at: [self.texts[k][row] for row in np.arange(len(self.lines))[rows]]
                      for at, k in enumerate(chosen) if k in self.texts},
                     self.lines[rows], [cell for k, cell in enumerate(self.above) if k in chosen], name, self.blocks, self.said)


BINARY = ((b"PK\x03\x04", "a workbook (.xlsx) or another archive"), (b"\xd0\xcf\x11\xe0", "a workbook (.xls)"),
          (b"\x1f\x8b", "a compressed file"))
EXPORT = "export the test as text (CSV or TXT) from the program of the machine"


def decoded(path):
    """The text of a file, and the encoding if it is not UTF-8."""
    try:
        data = read_bytes(path, MOST_CURVE)
    except FileNotFoundError as error:
        raise Trouble(f"{path}: cannot be read: {error.strerror}") from error
    for begin, what in BINARY:
        if data.startswith(begin):
            raise Trouble(f"{path}: this is {what}, and no text: {EXPORT}")
    name = "utf-16" if data.startswith((b"\xff\xfe", b"\xfe\xff")) else ""
    # The file has no mark at its beginning, but every other byte of its numbers is a zero.
    for begin, order in ((1, "utf-16-le"), (0, "utf-16-be")):
        if not name and len(data) > 3 and data[begin::2].count(0) > 0.9 * (len(data) // 2):
            name = order
    if name:
        try:
            return data.decode(name), "UTF-16"
        except UnicodeDecodeError as error:
            raise Trouble(f"{path}: begins as UTF-16, but is none from byte {error.start} on: {EXPORT} again") from None
    if b"\0" in data:
        raise Trouble(f"{path}: this is no text: it has a zero byte at {data.index(0)}: {EXPORT}")
    try:
        return data.decode("utf-8-sig"), ""
    except UnicodeDecodeError:
        return data.decode("cp1252", "replace"), "Latin-1 (Windows-1252)"


def _is_units(cells):
    """True if a line is a row of units: most of its texts are, in brackets or not."""
    texts = [cell.strip("[]() ") for cell in cells if cell.strip("[]() -")]
    return bool(texts) and sum(kind_of(text)[0] is not None for text in texts) > len(texts) / 2


def _header(lines, form):
    """Titles and units of the columns from the lines that stand just before the numbers, and how many lines these are."""
    width = form.width
    titles, units, taken = [""] * width, [""] * width, 0
    for line in reversed(lines[-3:]):
        cells = cells_of(line.lstrip("#"), form.separator)
        if all(not cell or MISSING.fullmatch(cell) for cell in cells):  # a line of strokes
            taken += 1
            continue
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


def _is_aside(line, form):
    """True of a line that is no row and ends none: a comment, or a remark in its own column without numbers beside it."""
    if line.lstrip().startswith("#"):
        return True
    cells = cells_of(line, form.separator)
    return len(cells) == form.width and bool(form.texts) and all(not cell or k in form.texts for k, cell in enumerate(cells))


def _runs(lines, form):
    """Begin and end of the runs of rows among the lines. Comments may stand in them, and short rows."""
    runs, begin, last = [], None, 0
    for k, (_, line) in enumerate(lines):
        row = row_of(line, form, 2 if begin is None else 1)
        if row is not None and len(row) <= form.width and (begin is not None or len(row) >= (form.least or form.width)):
            begin, last = k if begin is None else begin, k
        elif begin is not None and not _is_aside(line, form):
            runs.append((begin, last + 1))
            begin = None
    return runs + ([(begin, last + 1)] if begin is not None else [])


def _require_rows(path, lines, form, run, after):
    """Refuses lines between two runs if each of them looks like a row in which something is wrong."""
    wrong = []
    for number, line in lines[run[1]:after]:
        if _is_aside(line, form):
            continue
        cells = cells_of(line, form.separator)
        texts = [cell for k, cell in enumerate(cells) if number_of(cell, form.decimal) is None and k not in form.texts]
        if texts and not len(texts) < len(cells) == form.width or _is_units(cells):
            return
        wrong.append((number, texts, len(cells)))
    if wrong:
        number, texts, many = wrong[0]
        raise Trouble(f"{path}: row {run[1] - run[0] + 1} of the numbers (line {number}) " + (
            f"has {quoted(texts[0])}, which is no number: correct it, or leave the cell empty" if texts else
            f"has {many} columns, {form.width} are expected: correct the row, or remove it"))


def read_tables(path):
    """The tables of a file, one for each run of rows; Trouble says why there is none."""
    text, encoding = decoded(path)
    every = [(k + 1, line) for k, line in enumerate(text.replace("\r\n", "\n").replace("\r", "\n").split("\n"))]
    lines = [(number, line) for number, line in every if line.strip()]
    if not lines:
        raise Trouble(f"{path}: the file is empty: rows with at least 2 numbers are expected")
    form = form_of([line for _, line in lines[:TRIED]])
    if form is None:
        raise Trouble(f"{path}: there are no numbers: rows with at least 2 of them are expected, displacement and load")
    runs = _runs(lines, form)
    for run, following in zip(runs, runs[1:]):
        _require_rows(path, lines, form, run, following[0])
    end = runs[-1][1]
    if end < len(lines) and number_of(cells_of(lines[end][1], form.separator)[0], form.decimal) is not None:
        _require_rows(path, lines, form, runs[-1], end + 1)  # a last row with a fault: results begin with a word
    longest = max(end - begin for begin, end in runs)
    least = max(LEAST_ROWS, LEAST_PART * longest) if longest >= LEAST_ROWS else longest
    runs = [(begin, end) for begin, end in runs if end - begin >= least]
    tables, before = [], 0
    for begin, end in runs:
        titles, units, used = _header([line for _, line in lines[before:begin]], form)
        if tables and not any(titles + units):
            titles, units = tables[-1].titles, tables[-1].units
        chosen = [(number, line) for number, line in lines[begin:end] if not _is_aside(line, form)]
        rows = [(row_of(line, form, 0) + [float("nan")] * form.width)[:form.width] for _, line in chosen]
        cells = [cells_of(line, form.separator) + [""] * form.width for _, line in chosen] if form.texts else []
        above = [line for _, line in lines[before:begin - used]]
        table = Table(path, titles, units, list(np.array(rows).T), {k: [row[k] for row in cells] for k in form.texts},
                      np.array([number for number, _ in chosen]), cells_of(above[-1], form.separator) if above else [])
        table.name = _name(table.above)
        said = [encoding] if encoding else []
        if above:
            said.append(f"{len(above)} line{'s' if len(above) > 1 else ''} before the table")
        said.append(f"{NAMES[form.separator]} between {'numbers with decimal commas' if form.decimal == ',' else 'numbers'}")
        table.said = said
        tables.append(table)
        before = end
    behind = len(lines) - before
    tables[-1].said = tables[-1].said + ([f"{behind} line{'s' if behind > 1 else ''} of text behind it"] if behind else [])
    return tables


def _name(cells):
    """What the line above a table calls it: "DCB-01" of "Specimen;DCB-01"."""
    words = [cell for cell in cells if cell]
    return words[-1].rpartition(":")[2].strip() if words and len(words) <= 2 else ""
