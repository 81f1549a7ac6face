# SPDX-License-Identifier: BSD-3-Clause
"""Mean, standard deviation and coefficient of variation of a series, and what in it does not belong together."""
from dataclasses import dataclass

import numpy as np

from measured.chance import student

LEAST = 5  # specimens for each test condition: ASTM D5528, D7905 and D6671, and ISO 15024, ask for so many at least
ASKED = {"dcb": "ISO 15024 and ASTM D5528", "enf": "ASTM D7905", "mmb": "ASTM D6671"}
# These are the same for all specimens of one test condition; SI, as said, by the factor.
SAME_FOR_ALL = (("span", "mm", 1e3), ("lever", "mm", 1e3), ("E1", "GPa", 1e-9), ("E2", "GPa", 1e-9), ("G13", "GPa", 1e-9))
# These are measured on each: from this part of the middle one on, a slip of the sheet is likely. Saws are off by 1 %, plates
# by 3 %, and a notch of 50 mm that is broken in begins 3 mm later. Half of it tells such notches, twice of it misses a
# width of 20 mm among those of 25 mm.
MEASURED, DIFFERS = (("width", "width"), ("arm", "arm"), ("notch", "notch")), 0.1
# Grubbs' test for one outlier, at this confidence for the whole series (F. E. Grubbs, Technometrics 11 (1969) 1-21; ASTM
# E178 offers 90 to 99 %).
OUTLIER = 0.95


@dataclass
class Statistics:
    """Of the values of a series; None: there are too few values for it. low, high: the interval of the mean."""
    count: int
    mean: float = None
    deviation: float = None
    variation: float = None
    low: float = None
    high: float = None


def statistics_of(values, level):
    values, count = np.asarray(values, float), len(values)
    if count < 2:
        return Statistics(count, float(values[0]) if count else None)
    mean, deviation = float(np.mean(values)), float(np.std(values, ddof=1))
    half = student(level, count - 1) * deviation / np.sqrt(count)
    return Statistics(count, mean, deviation, deviation / abs(mean) if mean else None, mean - half, mean + half)


def outlier_in(values):
    """The place of the value that Grubbs' test calls an outlier; None: there is none, or fewer than 3 values."""
    count = len(values)
    if count < 3 or not np.std(values) > 0:
        return None
    off = np.abs(values - np.mean(values)) / np.std(values, ddof=1)
    t = student(1 - (1 - OUTLIER) / count, count - 2)
    place = int(np.argmax(off))
    return place if off[place] > (count - 1) / np.sqrt(count) * t / np.sqrt(count - 2 + t ** 2) else None


def _named(names):
    return ", ".join(names[:6]) + (", .." if len(names) > 6 else "")


def disagreements(members):
    """Sentences about numbers of the sheets that differ."""
    for key, unit, size in SAME_FOR_ALL:
        groups = {}
        for member in members:
            value = member.found.sheet.get(key)
            text = "none" if value is None else f"{size * value:.6g} {unit}"
            groups.setdefault(text, []).append(member.name)
        if len(groups) > 1:
            yield (f"--{key} differs: {'; '.join(f'{text} ({_named(names)})' for text, names in groups.items())}: one series has one "
                   f"{'material' if key[0] in 'EG' else 'fixture'}, and a mean over several means little")
    for k, member in enumerate(members):
        same = [other.name for other in members[:k] if np.array_equal(other.found.curve.displacement, member.found.curve.displacement)
                and np.array_equal(other.found.curve.load, member.found.curve.load)]
        if same:
            yield f"{member.name} has the same curve as {same[0]}: is one file a copy of the other?"
    for key, name in MEASURED:
        values = np.array([member.found.sheet[key] for member in members])
        middle = float(np.median(values))
        odd = [f"{1e3 * value:.4g} mm ({member.name})" for value, member in zip(values, members) if abs(value / middle - 1) > DIFFERS]
        if odd:
            yield (f"--{name} differs: {', '.join(odd[:6])}, where most have {1e3 * middle:.4g} mm: is it a slip of the sheet? A mean is of "
                   "specimens of one size")


def columns_of(members):
    """Method and point of each toughness that some specimen has, in the order of the methods."""
    found, points = {}, []
    for member in members:
        for method, rates in member.found.values().items():
            found.setdefault(method, set()).update(rates)
            points += [name for name in rates if name not in points]
    order = [name for name in ("visual", "NL", "5 %", "max") if name in points]
    order += [name for name in points if name not in order]
    return [(method, point) for method, rates in found.items() for point in order if point in rates]


def values_of(members, method, point):
    """The members that have this value, and the values."""
    having = [(member, member.found.values().get(method, {}).get(point)) for member in members]
    having = [(member, value) for member, value in having if value is not None]
    return [member for member, _ in having], [value for _, value in having]
