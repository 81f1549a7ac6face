# SPDX-License-Identifier: BSD-3-Clause
"""Measured curves: two columns of a CSV file."""
import csv

import numpy as np

from _pictures.input_file import MOST_CURVE, quoted, read_text
from marches import LEAST, MOST, Trouble


class CurveData:
    """x increases; y is what the model shall meet there, times `scale`."""

    def __init__(self, path, columns=None, scale=1.0):
        self.path = path
        header, rows = self._read(path)
        names = columns if columns else header[:2] if header else ["0", "1"]
        if len(names) != 2:
            raise Trouble(f"{path}: two columns are expected, x and y")
        known = header if header else [str(i) for i in range(len(rows[0]))]
        for name in names:
            if name not in known:
                raise Trouble(f"{path}: there is no column {quoted(name)}; it has: {', '.join(known)}")
        where = [known.index(name) for name in names]
        self.x, self.y = np.array([[row[i] for i in where] for row in rows]).T
        if len(self.x) < 2:
            raise Trouble(f"{path}: at least 2 points are expected")
        self._require_numbers(names[0], self.x, "")
        self._require_numbers(names[1], self.y, "")
        self.y = self.y * scale
        self._require_numbers(names[1], self.y, f" times --scale {scale:g}")
        wrong = np.flatnonzero(np.diff(self.x) <= 0)
        if wrong.size:
            raise Trouble(f"{path}: {names[0]} must increase, but is {self.x[wrong[0]]:g} and then "
                          f"{self.x[wrong[0] + 1]:g}; of a curve with unloading, give the part before, or take the time as x")

    def _require_numbers(self, name, column, times):
        """Finite, and with squares that are numbers too: the fit adds them up."""
        size = np.abs(column)
        wrong = np.flatnonzero(~((size == 0) | (size >= LEAST) & (size <= MOST)))
        if wrong.size:
            k = int(wrong[0])
            raise Trouble(f"{self.path}: row {k + 1} of the numbers: {quoted(name)}{times} is {column[k]:g}: 0, or a finite "
                          f"number from {LEAST:g} to {MOST:g}, is expected")

    @staticmethod
    def _read(path):
        try:
            text = read_text(path, MOST_CURVE)
        except FileNotFoundError as error:
            raise Trouble(f"{path}: cannot be read: {error.strerror}") from error
        lines = [line for line in text.splitlines() if line.strip() and not line.lstrip().startswith("#")]
        if not lines:
            raise Trouble(f"{path}: there are no numbers")
        comma = ";" if ";" in lines[0] else "," if "," in lines[0] else "\t" if "\t" in lines[0] else " "
        try:
            table = [[cell.strip() for cell in row if cell.strip() or comma != " "]
                     for row in csv.reader(lines, delimiter=comma)]
        except csv.Error as error:
            raise Trouble(f"{path}: {error}") from error
        header = None
        try:
            [float(cell) for cell in table[0]]
        except ValueError:
            header = table.pop(0)
        rows = []
        for number, row in enumerate(table):
            try:
                rows.append([float(cell) if cell else np.nan for cell in row])
            except ValueError as error:
                raise Trouble(f"{path}: row {number + 1} of the numbers: {str(error)[:100]}") from error
            if len(row) != len(header or table[0]):
                raise Trouble(f"{path}: row {number + 1} of the numbers has {len(row)} columns, {len(header or table[0])} are expected")
        if not rows:
            raise Trouble(f"{path}: there are no numbers")
        return header, rows
