# SPDX-License-Identifier: BSD-3-Clause
"""Compares tables and results of today with kept ones, by the names of their columns and keys.

Tolerances. The default `damage_tolerance` bounds changes of tractions by 1e-5 of their peaks. Measured on the kept
scenes, as shares of the largest number of a column: other kernels of the BLAS move no number by more than 1e-6. Other
algorithms for the same solution (`reduction`, `minimisation`) and tighter tolerances move energies and forces by up to
8e-6, and places and energy release rates of fronts, which depend on few pairs, by up to 9e-5.
"""
import collections
import csv
import math

TOLERANCE = 1e-5
FRONT_TOLERANCE = 1e-4
FRONTS = ("crack_length", "front", "energy_release_rate", "process_zone")
# Of these any version may change what they cost: present, but not compared.
COSTS = {"am_iterations", "linear_iterations", "search_candidates"}
# Differences of energies are small beside those that they are made of: one scale for all energies of a table.
ENERGIES = {"stored_bulk", "stored_interface", "dissipated", "stored_interface_slides", "dissipated_slides", "work",
            "lower", "increment", "upper", "increment_lower", "search_margin", "search_gap", "released", "defect",
            "defect_slides", "mixity_error", "load_potential", "stored", "recorded_work"}
# In a pure mode nothing but rounding: a share, whose scale is 1.
SHARES = {"front_mixity"}

# Keys of result.json that tell what was computed. The others are in the tables, or are dates and texts.
TOLD = ("status", "concept", "steps", "steps_done", "not_converged", "estimate_violated", "estimate_hollow",
        "front_unresolved", "scene_hash", "scene_content_hash", "options", "unknowns", "layers", "patterns", "cell",
        "output", "units", "scene.dimension", "scene.shortest_edge", "scene.schema", "scene.settings")

Table = collections.namedtuple("Table", "titles rows")
Difference = collections.namedtuple("Difference", "column text")


def table(text):
    """Of the text of a csv file: its titles, and its rows as texts."""
    titles, *rows = csv.reader(text.splitlines())
    return Table(titles, rows)


def number(text):
    try:
        return float(text)
    except ValueError:
        return None


def numbers(found, column):
    """None for a column of texts."""
    values = [number(row[column]) for row in found.rows]
    return None if None in values else values


def largest(values):
    return max((abs(v) for v in values if math.isfinite(v)), default=0.0)


def scale_of(title, values, energies):
    if title in SHARES:
        return 1.0
    return energies if title in ENERGIES else largest(values)


def tolerance_of(title):
    return FRONT_TOLERANCE if title.startswith(FRONTS) else TOLERANCE


def same(a, b, bound):
    return a == b or (math.isnan(a) and math.isnan(b)) or abs(a - b) <= bound


def moved_columns(kept, found):
    """The kept titles must be the first of today's, in their order: no change may be named that breaks this."""
    if found.titles[:len(kept.titles)] == kept.titles:
        return []
    at = next((i for i, pair in enumerate(zip(kept.titles, found.titles)) if pair[0] != pair[1]), len(found.titles))
    now = f"is now {found.titles[at]}" if at < len(found.titles) else "is missing"
    return [f"column {at + 1} was {kept.titles[at]} and {now}: columns keep names and order, new ones come last"]


def differences(kept, found):
    """Of two tables whose kept columns are in place: the first difference of each column."""
    if len(kept.rows) != len(found.rows):
        return [Difference("rows", f"{len(kept.rows)} rows kept, {len(found.rows)} today")]
    energies = max((largest(numbers(kept, i) or []) for i, t in enumerate(kept.titles) if t in ENERGIES), default=0.0)
    out = []
    for i, title in enumerate(kept.titles):
        if title in COSTS:
            continue
        before, today = numbers(kept, i), numbers(found, i)
        if before is None or today is None:
            unlike = [k for k, (a, b) in enumerate(zip(kept.rows, found.rows)) if a[i] != b[i]]
        else:
            bound = tolerance_of(title) * scale_of(title, before, energies)
            unlike = [k for k, (a, b) in enumerate(zip(before, today)) if not same(a, b, bound)]
        if unlike:
            k = unlike[0]
            out.append(Difference(title, f"row {k}: {kept.rows[k][i]} kept, {found.rows[k][i]} today"))
    return out


def flat(value, path=""):
    """Numbers and texts of a JSON value by their paths; a list is one value."""
    if not isinstance(value, dict):
        return {path: value}
    out = {}
    for key, inner in value.items():
        out.update(flat(inner, f"{path}.{key}" if path else key))
    return out


def of_key(path, keys):
    return any(path == key or path.startswith(key + ".") for key in keys)


def lost_keys(kept, found):
    """Keys of a kept result.json that today's lacks. What is null or a list in one of them has no keys inside."""
    today = flat(found)
    return [path for path in flat(kept)
            if path not in today and not any(of_key(path, [p]) or of_key(p, [path]) for p in today)]


def told_differences(kept, found):
    """Of two result.json: what they say was computed."""
    before, today = flat(kept), flat(found)
    return [Difference(path, f"{before[path]!r} kept, {today[path]!r} today") for path in before
            if of_key(path, TOLD) and path in today and before[path] != today[path]]
