# SPDX-License-Identifier: BSD-3-Clause
"""Two judgements of a case: against its reference, and against the library's own past. Both are made here from the numbers;
what a case says about itself is not believed."""
from __future__ import annotations

import json
import math
import pathlib
import re

import orders

PAST_RELATIVE = 1e-6
PAST_ORDER = 1e-4        # a fitted order: differences of small errors
COUNT_BAND = 0.20       # of counts of iterations
ROUNDING_GROWTH = 10.0  # a value of the size of rounding may move below this multiple of the largest past one of its kind
ROUNDING_FLOOR = 1e-14  # the largest past one counts as at least this
REFIT = 1e-6            # an order that is handed in with its data must be the one fitted to them
NUMBER = re.compile(r"-?[0-9.]+(e[-+]?[0-9]+)?( \([0-9]+\))?")  # a key that is a number, with the count of rows that share it
# Counts of what did not converge: more than 0 fails, unless the column says that it may.
UNCONVERGED = ("not_converged", "not converged", "stalled", "limit", "diverged")


def _unconverged(data: dict) -> list[str]:
    found = []
    for table in data["tables"]:
        for i, column in enumerate(table["columns"]):
            counts = column["name"].lower() in UNCONVERGED and not column.get("may")
            for r, row in enumerate(table["rows"]):
                cell = row[i]
                if counts and isinstance(cell, (int, float)) and cell != 0:
                    found.append(f"{table['title']}, row {r + 1}: {column['name']} {cell:g}")
                elif isinstance(cell, str) and not column.get("may"):
                    word = cell.strip().lower()
                    if word in ("limit", "not converged", "not_converged") or word.startswith(("failed:", "diverged")):
                        found.append(f"{table['title']}, row {r + 1}: {cell}")
    return found


def _order_verdict(o: dict) -> tuple[bool, str]:
    least = "at least " if o.get("sense") == "at least" else ""
    text = f"order of {o['of']} in {o['by']}: {o['fitted']:.3f}, expected {least}{o['expected']:g} within {o['tolerance']:g}"
    if "sizes" in o:
        try:
            again = orders.fit(o["sizes"], o["errors"])
        except ValueError as error:
            return False, f"order of {o['of']}: {error}"
        if not abs(again - o["fitted"]) <= REFIT * max(1.0, abs(again)):
            return False, f"order of {o['of']}: stated {o['fitted']:.6f}, but its data have {again:.6f}"
    off = o["fitted"] - o["expected"]
    good = off >= -o["tolerance"] if o.get("sense") == "at least" else abs(off) <= o["tolerance"]
    return bool(good), text


def _closeness(c: dict) -> float:
    """How much of the limit is used: above 1 is a violation."""
    value, limit = c["value"], c["limit"]
    if not (math.isfinite(value) and math.isfinite(limit)):
        return math.inf
    if c["sense"] == ">=":
        if value >= limit:
            return limit / value if value > 0 and limit > 0 else 0.0
        return limit / value if value > 0 else math.inf
    if value <= limit:
        return value / limit if limit > 0 and value > 0 else 0.0
    return value / limit if limit > 0 else math.inf


def against_reference(data: dict) -> dict:
    """Every check within its limit, every order as expected, nothing that did not converge; a case without any is no evidence."""
    lost = _unconverged(data)
    if lost:
        return {"verdict": "fail", "value": float(len(lost)), "limit": 0.0, "sense": "<=", "why": "not converged: " + "; ".join(lost[:4])}
    if not data["reference"].get("kind"):
        return {"verdict": "none", "value": None, "limit": None, "why": "the case names no reference"}
    if not data["checks"] and not data["orders"]:
        if data.get("refused"):
            return {"verdict": "pass", "value": None, "limit": None, "why": "refused: " + data["refused"]}
        return {"verdict": "none", "value": None, "limit": None, "why": "the case compares nothing with its reference"}
    for o in data["orders"]:
        good, text = _order_verdict(o)
        if not good:
            return {"verdict": "fail", "value": o["fitted"], "limit": o["expected"], "why": text}
    if not data["checks"]:
        worst = max(data["orders"], key=lambda o: abs(o["fitted"] - o["expected"]))
        return {"verdict": "pass", "value": worst["fitted"], "limit": worst["expected"], "why": _order_verdict(worst)[1]}
    # What decides is what failed; else the upper bound that is nearest to its limit: a lower one says that there was something to judge.
    failed = [c for c in data["checks"] if not (c["value"] <= c["limit"] if c["sense"] == "<=" else c["value"] >= c["limit"])]
    above = [c for c in data["checks"] if c["sense"] == "<="]
    worst = max(failed or above or data["checks"], key=_closeness)
    return {"verdict": "fail" if failed else "pass", "value": worst["value"], "limit": worst["limit"], "sense": worst["sense"],
            "why": f"{worst['what']}: {worst['value']:.3g} {worst['sense']} {worst['limit']:.3g}{' does not hold' if failed else ''}; {worst['why']}"}


def numbers(data: dict) -> dict:
    """Every number of the case by a name that survives new rows: table, keys of its row (else its place), column. A hole of a column that a
    cap on the time may cut off (`capped`) is None."""
    out = {}
    for table in data["tables"]:
        keys = [i for i, c in enumerate(table["columns"]) if c.get("key")]
        seen: dict[str, int] = {}
        for r, row in enumerate(table["rows"]):
            who = ", ".join(f"{row[i]:g}" if isinstance(row[i], float) else str(row[i]) for i in keys) if keys else f"row {r + 1}"
            seen[who] = seen.get(who, 0) + 1
            if seen[who] > 1:
                who += f" ({seen[who]})"
            for i, c in enumerate(table["columns"]):
                if i not in keys and c.get("past") != "free" and isinstance(row[i], (int, float)):
                    out[f"{table['title']} | {who} | {c['name']}"] = (float(row[i]), c.get("past", PAST_RELATIVE))
                elif c.get("capped") and row[i] is None:
                    out[f"{table['title']} | {who} | {c['name']}"] = None
    for f in data["figures"]:
        if f.get("past") != "free":
            out[f"figure | {f['name']}"] = (float(f["value"]), f.get("past", PAST_RELATIVE))
    for o in data["orders"]:
        if o.get("past") != "free":
            out[f"order | {o['of']} | {o['by']}"] = (float(o["fitted"]), o.get("past", PAST_ORDER))
    return out


def _kind(name: str) -> str:
    """Names of one column whose rows differ in numbers alone (states of an analysis, sizes) are of one kind."""
    parts = name.split(" | ")
    if len(parts) == 3:
        parts[1] = ", ".join(key for key in parts[1].split(", ") if not NUMBER.fullmatch(key))
    return " | ".join(parts)


def _largest_of_kind(accepted: dict) -> dict:
    largest: dict[str, float] = {}
    for name, value in accepted.items():
        largest[_kind(name)] = max(largest.get(_kind(name), ROUNDING_FLOOR), abs(value))
    return largest


def _excess(now: float, then: float, rule, largest: float) -> float:
    """Difference over what is allowed; above 1 is a violation. Of rounding, one value may be small by chance: the largest of its kind counts."""
    if rule == "rounding":
        return abs(now) / (ROUNDING_GROWTH * largest)
    allowed = (COUNT_BAND if rule == "count" else float(rule)) * abs(then)
    if rule == "count":
        allowed = max(allowed, 2.0)
    if now == then:
        return 0.0
    return abs(now - then) / allowed if allowed > 0 else math.inf


def by_row(numbers: dict) -> dict:
    """Numbers of a past by row: {table and keys: {column: number}}."""
    rows: dict = {}
    for name, number in numbers.items():
        row, _, column = name.rpartition(" | ")
        rows.setdefault(row, {})[column] = number
    return rows


def by_name(rows: dict) -> dict:
    """The inverse of by_row()."""
    return {f"{row} | {column}" if row else column: number for row, cells in rows.items() for column, number in cells.items()}


def past_text(stored: dict) -> str:
    """A past as JSON, with a line for each row of numbers, so that a difference shows what has changed, and one for what a run says of itself."""
    parts = [f'"id": {json.dumps(stored["id"])}']
    for tier in sorted(set(stored) - {"id"}):
        head = json.dumps({name: value for name, value in stored[tier].items() if name != "numbers"}, sort_keys=True)
        rows = ",\n".join(f" {json.dumps(row)}: {json.dumps(cells, sort_keys=True)}" for row, cells in sorted(stored[tier]["numbers"].items()))
        parts.append(f'"{tier}": {head[:-1]}, "numbers": {{\n{rows}}}}}')
    return "{" + ",\n".join(parts) + "}\n"


def past_path(folder: pathlib.Path, case_id: str) -> pathlib.Path:
    return folder / f"{case_id}.json"


def against_past(data: dict, folder: pathlib.Path, quick: bool) -> dict:
    path = past_path(folder, data["id"])
    tier = "quick" if quick else "full"
    stored = json.loads(path.read_text(encoding="utf-8")).get(tier) if path.is_file() else None
    if stored is None:
        return {"verdict": "new", "worst": None, "limit": 1.0, "why": f"no accepted run of the {tier} report yet"}
    now, then = numbers(data), by_name(stored["numbers"])
    if not then and not any(now.values()):
        return {"verdict": "none", "worst": None, "limit": 1.0, "why": "nothing of it has a past: timings, or tests that pass or fail"}
    lost = [name for name in then if name not in now]
    if lost:
        return {"verdict": "fail", "worst": None, "limit": 1.0,
                "why": f"{len(lost)} numbers of the accepted run are missing, first: {lost[0]}"}
    worst, what = 0.0, "all equal"
    largest = _largest_of_kind(then)
    for name, value in then.items():
        if now[name] is None:  # on a slower machine; the table says so
            continue
        rule = now[name][1]
        excess = _excess(now[name][0], value, rule, largest[_kind(name)])
        if excess > worst:
            of = f", of its kind at most {largest[_kind(name)]:.9g}" if rule == "rounding" else ""
            worst, what = excess, f"{name}: {now[name][0]:.9g}, accepted {value:.9g}{of}"
    # Other kernels of BLAS round differently, and iterations multiply that: a difference is told, but is no verdict.
    here, there = data.get("kernels", ""), stored.get("kernels", "")
    verdict = "pass" if worst <= 1.0 else "fail" if here == there else "elsewhere"
    if verdict == "elsewhere":
        what += f"; here BLAS has kernels for {here or 'an unknown processor'}, then for {there or 'an unknown processor'}"
    return {"verdict": verdict, "worst": min(worst, 1e300), "limit": 1.0,
            "why": f"{len(then)} numbers of {stored['date']} ({stored['commit']}); difference over tolerance at worst {worst:.2g}: {what}"}


def accept(data: dict, folder: pathlib.Path, quick: bool, date: str) -> None:
    path = past_path(folder, data["id"])
    stored = json.loads(path.read_text(encoding="utf-8")) if path.is_file() else {"id": data["id"]}
    stored["quick" if quick else "full"] = {"date": date, "commit": data["commit"], "kernels": data.get("kernels", ""),
                                            "numbers": by_row({name: found[0] for name, found in numbers(data).items() if found})}
    folder.mkdir(parents=True, exist_ok=True)
    path.write_text(past_text(stored), encoding="utf-8")


def judge(data: dict, folder: pathlib.Path, quick: bool) -> dict:
    """Fills judgement and status of a case that ran."""
    with_reference = against_reference(data)
    with_past = against_past(data, folder, quick)
    data["judgement"] = {"reference": with_reference, "past": with_past}
    if with_reference["verdict"] == "none":
        data["status"], data["reason"] = "failed", "no evidence: " + with_reference["why"]
    elif with_reference["verdict"] == "fail":
        data["status"], data["reason"] = "failed", "against the reference: " + with_reference["why"]
    elif with_past["verdict"] == "fail":
        data["status"], data["reason"] = "failed", "against its own past: " + with_past["why"]
    elif data.get("refused"):
        data["status"], data["reason"] = "refused as expected", data["refused"]
    else:
        data["status"], data["reason"] = "passed", ""
    return data
