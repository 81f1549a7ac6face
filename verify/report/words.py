# SPDX-License-Identifier: BSD-3-Clause
"""Numbers as people read them; the same in the pages and in the README."""
import math

# The reason of a case that a report has not run.
LEFT_OUT = "left out by --only"

# Where a case has no energy ledger and no word of its own about it: why.
NO_LEDGER = {
    "a": "None: states are compared one by one, at the adhesion that an analysis had; what each of them stores is a column "
         "of the tables.",
    "b": "None: nothing is analysed.",
    "c": "None here: the program that takes the times records no ledger; energies are columns where methods are compared, "
         "and such analyses are recorded in chapters (b) and (e).",
    "d": "None: many small scenes in place of one analysis. The energies of each are recorded again from its fields, outside "
         "the library; where a table has the columns, they are ledger and defect.",
    "e": "None here: fields, tractions and loads are compared, and energies among them where there is a reference.",
    "f": "None: interfaces and bindings are compared, no analysis is evaluated.",
    "g": "None: cost is measured, no analysis is evaluated.",
    "h": "None: every case of this chapter records one.",
}


def bound(of: dict) -> str:
    """The limit of a check or a judgement with its sense; that of an order is the order expected, within a tolerance."""
    if of.get("limit") is None:
        return show(None)
    return {"<=": "≤ ", ">=": "≥ "}.get(of.get("sense"), "") + show(of["limit"])


def expected(order: dict) -> str:
    return ("at least " if order.get("sense") == "at least" else "") + show(order["expected"])


def show(value) -> str:
    """Four digits, powers of ten where they are shorter."""
    if value is None:
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, str):
        return value
    if not math.isfinite(value):
        return str(value)
    if value == int(value) and abs(value) < 1e6:
        return f"{int(value):,}".replace(",", "\u202f") if abs(value) >= 10000 else str(int(value))
    size = abs(value)
    if 1e-3 <= size < 1e5:
        return f"{value:.4g}" if size < 9999.5 else f"{value:,.0f}".replace(",", "\u202f")
    if 1e5 <= size < 1e6:
        return f"{value:,.0f}".replace(",", "\u202f")
    mantissa, exponent = f"{value:.2e}".split("e")
    return f"{mantissa}e{int(exponent)}"
