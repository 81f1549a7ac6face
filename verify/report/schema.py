# SPDX-License-Identifier: BSD-3-Clause
"""The JSON of a case: what must be there, of which kind. Checked when it is written and when it is read."""
from __future__ import annotations

import math

from case import CHAPTERS, REFERENCE_KINDS

STATUSES = ("passed", "failed", "skipped", "refused as expected")
VERDICTS = {"reference": ("pass", "fail", "none"), "past": ("pass", "fail", "new", "elsewhere", "none")}
TEXTS = ("id", "chapter", "title", "requirement", "geometry", "materials", "supports", "units", "reason", "command", "commit",
         "library")
LISTS = ("tables", "orders", "plots", "figures", "checks", "warnings", "losses")
SCALES = ("linear", "log")
SENSES = ("<=", ">=")


class Invalid(ValueError):
    """What is wrong, and where."""


def _number(value) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _finite(value, where: str) -> None:
    if not _number(value):
        raise Invalid(f"{where}: {value!r} is not a number")
    if not math.isfinite(value):
        raise Invalid(f"{where}: {value} is not finite")


def _need(data: dict, keys, where: str) -> None:
    if not isinstance(data, dict):
        raise Invalid(f"{where}: an object is expected, not {type(data).__name__}")
    for key in keys:
        if key not in data:
            raise Invalid(f"{where}: \"{key}\" is missing")


def _table(table: dict, where: str) -> None:
    _need(table, ("title", "columns", "rows"), where)
    where = f"{where} \"{table['title']}\""
    for column in table["columns"]:
        _need(column, ("name", "unit"), f"{where}, columns")
    names = [c["name"] for c in table["columns"]]
    if len(set(names)) != len(names):
        raise Invalid(f"{where}: two columns have the same name")
    for r, row in enumerate(table["rows"]):
        if len(row) != len(names):
            raise Invalid(f"{where}, row {r}: {len(row)} cells for {len(names)} columns")
        for column, cell in zip(table["columns"], row):
            place = f"{where}, row {r}, column \"{column['name']}\""
            if cell is None:
                if not column.get("optional"):
                    raise Invalid(f"{place}: no value (NaN or empty), and the column is not optional")
            elif _number(cell):
                _finite(cell, place)
            elif not isinstance(cell, str):
                raise Invalid(f"{place}: {cell!r} is neither a number nor a text")


def _plot(plot: dict, where: str) -> None:
    _need(plot, ("title", "x", "y", "series"), where)
    where = f"{where} \"{plot['title']}\""
    for name in ("x", "y"):
        _need(plot[name], ("label", "unit", "scale"), f"{where}, axis {name}")
        if plot[name]["scale"] not in SCALES:
            raise Invalid(f"{where}, axis {name}: scale {plot[name]['scale']!r} is none of {', '.join(SCALES)}")
    if not plot["series"]:
        raise Invalid(f"{where}: nothing is drawn")
    for s in plot["series"]:
        _need(s, ("name", "role", "x", "y"), f"{where}, series")
        place = f"{where}, series \"{s['name']}\""
        if len(s["x"]) != len(s["y"]) or not s["x"]:
            raise Invalid(f"{place}: {len(s['x'])} x for {len(s['y'])} y")
        for end in ("low", "high"):
            if end in s and len(s[end]) != len(s["y"]):
                raise Invalid(f"{place}: {len(s[end])} values of {end} for {len(s['y'])} y")
            for value in s.get(end, ()):
                _finite(value, f"{place}, {end}")
        names = plot["x"].get("bars")
        if names is not None and any(x not in range(len(names)) for x in s["x"]):
            raise Invalid(f"{place}: a bar without a name")
        for x, y in zip(s["x"], s["y"]):
            _finite(x, f"{place}, x")
            if y is not None:
                _finite(y, f"{place}, y")
    for mark in plot.get("marks", []):
        _need(mark, ("kind", "label"), f"{where}, marks")


def check(data: dict) -> dict:
    """Returns data, or raises Invalid. What was skipped or crashed has no numbers; what passed must have them."""
    where = f"case {data.get('id', '?')}" if isinstance(data, dict) else "case"
    _need(data, (*TEXTS, *LISTS, "reference", "ledger", "judgement", "status", "seconds"), where)
    for key in TEXTS:
        if not isinstance(data[key], str):
            raise Invalid(f"{where}: \"{key}\" is not a text")
    for key in LISTS:
        if not isinstance(data[key], list):
            raise Invalid(f"{where}: \"{key}\" is not a list")
    for key in ("title", "requirement", "geometry", "materials", "supports", "units"):
        if not data[key].strip():
            raise Invalid(f"{where}: \"{key}\" is empty")
    if data["chapter"] not in CHAPTERS:
        raise Invalid(f"{where}: chapter {data['chapter']!r} is none of {', '.join(CHAPTERS)}")
    if data["status"] not in STATUSES:
        raise Invalid(f"{where}: status {data['status']!r} is none of {', '.join(STATUSES)}")
    _finite(data["seconds"], f"{where}, seconds")
    ran = data["status"] in ("passed", "refused as expected")
    _need(data["reference"], ("kind", "source", "uncertainty"), f"{where}, reference")
    if data["reference"]["kind"] not in REFERENCE_KINDS and (ran or data["reference"]["kind"]):
        raise Invalid(f"{where}: reference of kind {data['reference']['kind']!r} is none of {', '.join(REFERENCE_KINDS)}")
    if ran and not (data["reference"]["source"].strip() and data["reference"]["uncertainty"].strip()):
        raise Invalid(f"{where}: the reference has no source or no uncertainty")
    for i, table in enumerate(data["tables"]):
        _table(table, f"{where}, table {i}")
    if isinstance(data["ledger"], str) and not data["ledger"].strip():
        raise Invalid(f"{where}: \"ledger\" is empty: a table, or why there is none")
    if data["ledger"] is not None and not isinstance(data["ledger"], str):
        _table(data["ledger"], f"{where}, ledger")
        if not data["ledger"]["rows"]:
            raise Invalid(f"{where}, ledger: no analysis")
    for i, plot in enumerate(data["plots"]):
        _plot(plot, f"{where}, plot {i}")
    for o in data["orders"]:
        _need(o, ("of", "by", "fitted", "expected", "tolerance"), f"{where}, orders")
        for key in ("fitted", "expected", "tolerance"):
            _finite(o[key], f"{where}, order of {o['of']}, {key}")
    for f in data["figures"]:
        _need(f, ("name", "value", "unit", "text"), f"{where}, figures")
        _finite(f["value"], f"{where}, figure {f['name']}")
    for c in data["checks"]:
        _need(c, ("what", "value", "limit", "sense", "why"), f"{where}, checks")
        if c["sense"] not in SENSES:
            raise Invalid(f"{where}, check {c['what']}: sense {c['sense']!r}")
        for key in ("value", "limit"):
            _finite(c[key], f"{where}, check {c['what']}, {key}")
        if not c["why"].strip():
            raise Invalid(f"{where}, check {c['what']}: no reason for its limit")
    for kind, allowed in VERDICTS.items():
        _need(data["judgement"].get(kind), ("verdict",), f"{where}, judgement, {kind}")
        if data["judgement"][kind]["verdict"] not in allowed:
            raise Invalid(f"{where}, judgement, {kind}: {data['judgement'][kind]['verdict']!r} is none of {', '.join(allowed)}")
    if ran and data["judgement"]["reference"]["verdict"] != "pass":
        raise Invalid(f"{where}: {data['status']}, but the judgement against the reference is "
                      f"{data['judgement']['reference']['verdict']!r}")
    if ran and data["judgement"]["past"]["verdict"] == "fail":
        raise Invalid(f"{where}: {data['status']}, but it differs from its own past")
    if data["status"] in ("failed", "skipped", "refused as expected") and not data["reason"].strip():
        raise Invalid(f"{where}: {data['status']} without a reason")
    return data
