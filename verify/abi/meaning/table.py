# SPDX-License-Identifier: BSD-3-Clause
"""The table: rows that observe what arguments and options mean, and what a row can say of a library."""
import importlib
import math

MODULES = ("mesh", "pairing", "law", "problem", "loads", "solver", "values", "options", "energetic", "operators",
           "calls")


class Row:
    """tells: the places whose entries the row tells apart, "function parameter" or "function parameter key"; options:
    whose defaults it observes; says: the defaults in words of the header that it observes, "function: words"."""

    def __init__(self, name, run, tells, options, says):
        self.name, self.run, self.tells, self.options, self.says = name, run, tells, options, says


ROWS = []


def load():
    """Fills ROWS, from all files of rows."""
    for module in MODULES:
        importlib.import_module(f"rows_{module}")


def row(name, tells=(), options=(), says=()):
    def take(run):
        ROWS.append(Row(name, run, tuple(tells), tuple(options), tuple(says)))
        return run
    return take


def flat(value):
    if isinstance(value, (list, tuple)):
        return [number for entry in value for number in flat(entry)]
    return [value]


def whole(value):
    return [int(n) if n == n and n == int(n) else n for n in flat(value)]


class See:
    """The results of a row: failures, and the numbers that a baseline keeps, (row, what) -> (unit, numbers)."""

    def __init__(self, row_name):
        self.row, self.failures, self.numbers = row_name, [], {}

    def _fail(self, text):
        self.failures.append(f"{self.row}: {text}")

    def near(self, what, got, expected, unit="1", rel=1e-9, scale=None):
        """Equal up to rounding, `rel` of the largest number expected."""
        got, expected = flat(got), flat(expected)
        size = scale if scale is not None else max((abs(e) for e in expected), default=0.0)
        assert "; " not in what
        self.numbers[(self.row, what)] = (unit, [0.0 if abs(n) <= rel * size else n for n in got])
        if len(got) != len(expected):
            return self._fail(f"{what}: {len(got)} numbers, expected {len(expected)}")
        for place, (value, wanted) in enumerate(zip(got, expected)):
            if not abs(value - wanted) <= rel * size + 1e-300:
                where = f"[{place}]" if len(got) > 1 else ""
                return self._fail(f"{what}{where} is {value:.10g} {unit}, expected {wanted:.10g}")

    def equal(self, what, got, expected, unit="-"):
        """Whole numbers: counts, indices, statuses."""
        got, expected = whole(got), whole(expected)
        self.numbers[(self.row, what)] = (unit, got)
        if got != expected:
            place = next((i for i, (a, b) in enumerate(zip(got, expected)) if a != b), min(len(got), len(expected)))
            where = f"[{place}]" if len(expected) > 1 or len(got) > 1 else ""
            a, b = (v[place] if place < len(v) else "nothing" for v in (got, expected))
            self._fail(f"{what}{where} is {a}, expected {b}")

    def recorded(self, what, got, unit="-"):
        """For the baseline alone."""
        size = max(map(abs, flat(got)), default=0.0)
        self.numbers[(self.row, what)] = (unit, whole(got) if unit == "-" else
                                          [0.0 if abs(n) <= 1e-9 * size else n for n in flat(got)])

    def that(self, what, holds):
        if not holds:
            self._fail(what)

    def differ(self, what, one, other):
        if one == other:
            self._fail(f"{what}: both give {one}")


HEAD = ("# SPDX-License-Identifier: BSD-3-Clause\n"
        "# What arguments, options and their defaults meant, as numbers (../meanings.py). Written by update.sh.\n"
        "# row; what; unit (-: whole numbers, equal; else equal up to rounding); numbers\n")


def line_of(place, unit, numbers):
    texts = [str(n) if unit == "-" else f"{n:.10g}" for n in numbers]
    return "; ".join([*place, unit, " ".join(texts)])


def read_baseline(path):
    found = {}
    with open(path, encoding="utf-8") as file:
        for line in file:
            if line.strip() and not line.startswith("#"):
                name, what, unit, numbers = line.rstrip("\n").split("; ")
                kept = [int(n) if unit == "-" else float(n) for n in numbers.split()]
                found[(name, what)] = (unit, kept)
    return found


def close(unit, a, b, size):
    if unit == "-":
        return a == b
    return math.isclose(a, b, rel_tol=1e-6, abs_tol=1e-7 * size) or (math.isnan(a) and math.isnan(b))


def against(baseline, numbers, seen_rows):
    """Lists differences from the baseline; rows that did not run are left out."""
    for (name, what), (unit, old) in baseline.items():
        if name not in seen_rows:
            continue
        new_unit, new = numbers.get((name, what), (None, None))
        if new is None:
            yield f"{name}: {what}: in the baseline, not observed any more"
        elif new_unit != unit or len(new) != len(old):
            yield f"{name}: {what}: {len(new)} numbers in {new_unit}, in the baseline {len(old)} in {unit}"
        else:
            size = max((abs(n) for n in old), default=0.0)
            for place, (a, b) in enumerate(zip(new, old)):
                if not close(unit, a, b, size):
                    yield f"{name}: {what}[{place}] is {a:.10g} {unit}, in the baseline {b:.10g}"
                    break
