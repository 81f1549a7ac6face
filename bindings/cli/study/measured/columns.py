# SPDX-License-Identifier: BSD-3-Clause
"""Which column of a table is the displacement, which the load, which the length of the crack."""
import re

import numpy as np

from _pictures.input_file import quoted
from command import Trouble
from measured.units import kind_of

# What test machines and people call them, in the order in which the columns are taken; whole words of a title.
WORDS = {
    "displacement": ("displacement", "opening", "cod", "extension", "deflection", "deformation", "stroke", "crosshead",
                     "position", "travel", "disp", "weg", "traverse", "traversenweg", "standardweg", "verformung",
                     "durchbiegung", "deplacement", "déplacement", "course", "allongement", "desplazamiento",
                     "spostamento", "delta", "δ", "x", "u", "d", "v", "w"),
    "force": ("force", "load", "reaction", "kraft", "standardkraft", "prüfkraft", "charge", "effort", "fuerza",
              "carga", "forza", "carico", "f", "p", "y"),
    "crack": ("crack", "delamination", "risslänge", "riss", "fissure", "grieta", "cricca", "a"),
    "time": ("time", "elapsed", "zeit", "prüfzeit", "testzeit", "versuchszeit", "messzeit", "laufzeit", "temps", "tiempo", "tempo", "t"),
}


def words_of(title):
    """In small letters, with ss for ß: Rißlänge is the older spelling."""
    return re.findall(r"[^\W\d_]+", title.lower().replace("ß", "ss"))


def found(table, kind):
    """The columns whose titles have a word of the kind, the best first."""
    filled = [k for k, column in enumerate(table.columns) if np.isfinite(column).any()]
    said = {k: words_of(table.titles[k]) for k in filled}
    ranks = {k: min((WORDS[kind].index(word) for word in words if word in WORDS[kind]), default=None)
             for k, words in said.items()}
    if kind == "crack":  # "Crack opening displacement" is none
        ranks = {k: rank for k, rank in ranks.items() if not set(said[k]) & {"opening", "displacement", "mouth"}}
    return sorted((k for k, rank in ranks.items() if rank is not None), key=lambda k: (ranks[k], k))


def _by_units(table, kind):
    wanted = {"displacement": "length", "force": "force", "time": "time"}[kind]
    return [k for k, unit in enumerate(table.units) if unit and kind_of(unit)[0] == wanted]


def named(table, name):
    """The column of this title, with or without its unit and capitals, or else of this number, from 1 on."""
    for same in (lambda a, b: a == b, lambda a, b: a.lower() == b.lower()):
        for k, title in enumerate(table.titles):
            full = f"{title} ({table.units[k]})"
            if title and (same(title, name) or same(full, name) or same(f"{title} [{table.units[k]}]", name)):
                return k
    if name.isascii() and name.isdigit() and 1 <= int(name) <= len(table.columns):
        return int(name) - 1
    known = ", ".join(table.titles) if any(table.titles) else f"columns 1 to {len(table.columns)}"
    raise Trouble(f"{table.path}: there is no column {quoted(name)}; it has: {known}")


def rivals(table, chosen):
    """Says which other columns could be meant: those whose titles or units are of a displacement or a load."""
    filled = [k for k, column in enumerate(table.columns) if np.isfinite(column).any()]
    cracks = found(table, "crack")
    kinds = ["length", "force"]
    others = [k for k in filled if k not in chosen and k not in cracks
              and (table.units[k] and kind_of(table.units[k])[0] in kinds or k in found(table, "displacement") + found(table, "force"))]
    return [f"not taken: {', '.join(label(table, k) for k in others)} (--columns X Y)"] if others else []


def guess(table, x_kind="displacement"):
    """The columns of x and y: those whose titles say what they are, or whose units do, or the first two that can be; None:
    there are none. A time is neither displacement nor load, and a column in mm is no load. A "load" beside a "force" is a
    displacement, as in our own tables."""
    x, y = found(table, x_kind), found(table, "force")
    if x_kind == "displacement" and not x and len(y) > 1:
        loads = [k for k in y if "load" in words_of(table.titles[k])]
        x, y = loads, [k for k in y if k not in loads]
    x = x or _by_units(table, x_kind)
    y = [k for k in y or _by_units(table, "force") if k not in x[:1]]
    taken = {*x[:1], *y[:1], *found(table, "time"), *_by_units(table, "time")}
    cracks = found(table, "crack")
    left = [k for k, column in enumerate(table.columns) if np.isfinite(column).any() and k not in taken]
    # "a" may be anything: it is taken where nothing else is left.
    left = [k for k in left if k not in cracks] if len(set(left) - set(cracks)) >= 2 - len(x[:1] + y[:1]) else left
    x = x[:1] or [k for k in left if k not in _by_units(table, "force")][:1]
    y = y[:1] or [k for k in left if k not in [*_by_units(table, "displacement"), *x]][:1]
    return x + y if x and y else None


def choose(table, names=None, x_kind="displacement"):
    """The columns of x and y: those with these names, or those of the guess."""
    if names:
        if len(names) != 2:
            raise Trouble(f"{table.path}: two columns are expected, x and y")
        return [named(table, name) for name in names]
    chosen = guess(table, x_kind)
    if chosen is None:
        listed = ", ".join(f"{k + 1} " + (label(table, k) if table.titles[k] else "without a title") for k in range(len(table.columns)))
        raise Trouble(f"{table.path}: neither titles nor units say which columns are {x_kind} and load: name two of {listed} with "
                      "--columns X Y, by their titles or numbers")
    return chosen


def label(table, k):
    """A column as a message names it."""
    name = quoted(table.titles[k]) if table.titles[k] else f"column {k + 1}"
    return name + (f" in {table.units[k]}" if table.units[k] else "")
