# SPDX-License-Identifier: BSD-3-Clause
"""How the numbers of a file are written: what stands between them, their decimal sign, groups of thousands, and what
machines write where they have no number.

Machines write a preamble of names and settings, titles, a row of units, numbers with a point or a comma, and between
them semicolons, tabs, commas or blanks. Which of these a file has is not guessed from its first lines: every way is
tried, and the one counts that makes rows of numbers of the most lines.
"""
import collections
import csv
import re
from dataclasses import dataclass

# Separators with decimal signs: of two that make as many rows, the first one counts.
WAYS = (("\t", "."), ("\t", ","), (";", "."), (";", ","), (",", "."), (",", ","), (" ", "."), (" ", ","))
NAMES = {"\t": "tabs", ";": "semicolons", ",": "commas", " ": "blanks"}

# Signs that stand between thousands: apostrophes, and blanks that do not break a line; besides, the other one of point and comma.
GROUPS = "['’ \u00a0\u2009\u202f]"


def _number(decimal, other):
    """A number with this decimal sign; thousands may be grouped, which begins with no zero: 0,123 is none of them."""
    grouped = "|".join(rf"[1-9]\d{{0,2}}(?:{sign}\d{{3}})+(?:{decimal}\d*)?" for sign in (GROUPS, other))
    return re.compile(rf"[+-]?(?:{grouped}|\d+{decimal}?\d*|{decimal}\d+)(?:[eEdD][+-]?\d+)?|[+-]?(?:nan|inf)", re.I)


NUMBER = {".": _number(r"\.", ","), ",": _number(",", r"\.")}
# A date, a time of the day, or both.
STAMP = re.compile(r"\d{1,4}(?:[:/.-]\d{1,4}){2,}(?:[T ]+\d{1,2}(?::\d{1,2}){1,2})?(?:[.,]\d+)?(?:\s*[APap][Mm])?")
# These stand for no number: those of machines, of Excel in English and German, and strokes or stars.
MISSING = re.compile(r"[-–—]+|\*+|\?+|#?n/?a|null|#(?:nv|num!|zahl!|value!|wert!|div/0!|ref!|bezug!)|overload|overflow", re.I)


@dataclass(frozen=True)
class Form:
    """separator, decimal sign, number of columns; texts: the columns that have words beside the numbers; least: the number
    of columns without those of remarks that rows without one leave out, 0 where there are none."""
    separator: str
    decimal: str
    width: int
    texts: frozenset = frozenset()
    least: int = 0


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
    """A number as it is written; NaN for nothing, for dates and for what stands for no number; None: it is a text."""
    cell = cell.replace("\u2212", "-")
    if NUMBER[decimal].fullmatch(cell):
        cell = re.sub(GROUPS, "", cell).replace(",." [decimal == ","], "").replace(",", ".")
        return float(cell.replace("d", "e").replace("D", "e"))
    return float("nan") if not cell or STAMP.fullmatch(cell) or MISSING.fullmatch(cell) else None


def row_of(line, form, least=2):
    """The numbers of a line, NaN in columns of words; None where it is no row: a text elsewhere, or fewer numbers than
    the least."""
    row = [number_of(cell, form.decimal) for cell in cells_of(line, form.separator)]
    row = [float("nan") if value is None and k in form.texts else value for k, value in enumerate(row)]
    if any(value is None for value in row) or sum(value == value for value in row) < least:
        return None
    return row


def _grouped_alone(rows):
    """True if commas group thousands in these cells and none has a point: then they are rather decimal commas."""
    return any("," in cell for cell in rows) and not any("." in cell for cell in rows)


def _remarks(lines):
    """For each width, the columns that have words in some lines and in none a number: remarks and events of an operator.
    lines: their widths, their columns of words and of numbers."""
    found = {}
    for width in {many for many, _, _ in lines}:
        of_width = [(texts, filled) for many, texts, filled in lines if many == width]
        numbers = frozenset().union(*(filled for texts, filled in of_width if not texts))
        found[width] = frozenset().union(*(texts for texts, _ in of_width)) - numbers
    return found


def form_of(lines):
    """The form with which most lines are rows; None: no line is. A column that is empty in most rows, and has a remark in
    the others, is one of words. Columns of words beside numbers count if they make more than twice as many rows: a results
    table before the curve may have none."""
    strict, loose, lines_of_best = (0, None), (0, None), 0
    for separator, decimal in WAYS:
        if separator != " " and not any(separator in line for line in lines):
            continue
        counts, written, alone = collections.Counter(), [], set()
        for line in lines:
            cells = cells_of(line, separator)
            row = [number_of(cell, decimal) for cell in cells]
            filled = frozenset(k for k, value in enumerate(row) if value is not None and value == value)
            if len(filled) >= 2:
                counts[(len(row), frozenset(k for k, value in enumerate(row) if value is None), filled)] += 1
                written += [cells[k] for k in sorted(filled)]
            elif not filled and len(row) > 2:  # a remark between two rows, if no number of the table stands over it
                alone.add((len(row), frozenset(k for k, value in enumerate(row) if value is None)))
        if not counts or decimal == "." and _grouped_alone(written):
            continue
        remarks = _remarks([*counts, *((width, texts, frozenset()) for width, texts in alone)])
        by_texts = collections.Counter()
        for (width, texts, _), rows in counts.items():
            by_texts[(width, texts)] += rows
        for (width, texts), rows in by_texts.items():
            # Of two decimal signs with as many rows, the one with which more lines are rows of any width.
            same = strict[1] is not None and strict[1].separator == separator and rows == strict[0]
            if not texts and (rows > strict[0] or same and sum(counts.values()) > lines_of_best):
                lines_of_best = sum(counts.values())
                known = frozenset().union(*(some for many, some in [*by_texts, *alone] if many == width and some <= remarks[width]))
                full = max([width] + [many for many, some, filled in counts if some and min(some) >= width > max(filled)])
                strict = rows, Form(separator, decimal, full, known | frozenset(range(width, full)), width)
        (width, texts), _ = by_texts.most_common(1)[0]
        rows = sum(count for (many, some), count in by_texts.items() if many == width and some <= texts)
        if texts and (rows > loose[0] or rows == loose[0] and len(texts) < len(loose[1].texts)):
            loose = rows, Form(separator, decimal, width, texts)
    return loose[1] if loose[0] > 2 * strict[0] else strict[1]
