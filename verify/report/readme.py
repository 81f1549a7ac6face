#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""readme.py OUT: headline figures and pictures of a report into the README, between its markers.

    readme.py OUT        from OUT/report.json: headline.json, pictures/, and the block in README.md
    readme.py --check    exit status 1 if the block is not the one that headline.json makes"""
from __future__ import annotations

import argparse
import json
import pathlib
import string
import sys
import textwrap

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.path.insert(0, str(HERE))

from words import show  # noqa: E402

BEGIN, END = "<!-- report:begin (verify/report/readme.py) -->", "<!-- report:end -->"
SPEED_BEGIN, SPEED_END = "<!-- speed:begin (verify/report/readme.py) -->", "<!-- speed:end -->"
# Figures by their names in the JSON, and pictures by case and place; only of cases that passed.
FIGURES = ["feti_direct_worst", "feti_direct_kkt", "balance_defect", "jump_mm"]
PICTURES = [("b-ledger", 0), ("b-jump-instant", 0), ("a-feti-direct", 1)]
# The table of speed: a row is what it is called, and the middle of the names of its figures. Only a report that has all of them renews it.
SPEED = [("0.5 mm", "ductile_0.5"), ("0.1 mm, one thread", "ductile_0.1"), ("0.1 mm, OpenMP as Debian's CHOLMOD sets it", "ductile_0.1_shipped")]
SPEED_COLUMNS = [("unknowns", "unknowns"), ("whole march", "seconds"), ("in linear solves", "lse"), ("baseline over this", "ratio"), ("memory, factorisations", "memory")]
# Sentences with figures, each between markers of its own (NAME:begin, NAME:end), by name: whether the full report alone renews it, and the words.
SENTENCES = {
    "jumps": (False, "Brittle end-notched flexure, 40 steps, points as supports, cells of 1 mm: the crack jumps at {jump_local_mm:.2f} mm (local), "
                     "{jump_backtracking_mm:.2f} mm (with backtracking) and {jump_energetic_mm:.2f} mm (energetic, in the same step as an exhaustive scan); on patches as "
                     "supports, located by bisection and on finer meshes, at {jump_mm:.3f} mm, where beam theory has 0.281."),
    "precision": (True, "At the error in the load that 4-node cells of 0.25 mm have, 8-node cells are {equal_error_reaction_quad8:.0f} times and incompatible 4-node ones "
                        "{equal_error_reaction_quad4-incompatible:.0f} times as fast; at their error in the dissipated energy, which the spacing of the pairs decides, "
                        "{equal_error_dissipated_quad8:.1f} and {equal_error_dissipated_quad4-incompatible:.1f} times."),
}
# Beyond it two series of the same solve differ by more than the digits that are quoted.
NOISE = 0.1


class Refused(Exception):
    """What the README asks for and the report does not have."""


def gather(report: dict, figures=None, pictures=None) -> dict:
    """What the README quotes, from the report alone."""
    figures, pictures = FIGURES if figures is None else figures, PICTURES if pictures is None else pictures
    good = {c["id"]: c for c in report["cases"] if c["status"] == "passed"}
    found = {f["name"]: {**{k: f[k] for k in ("name", "value", "unit", "text")}, "case": c["id"]} for c in good.values() for f in c["figures"]}
    lost = [name for name in figures if name not in found]
    lost += [f"picture {i} of {case}" for case, i in pictures if case not in good or i >= len(good[case]["plots"])]
    if lost:
        raise Refused("not in the report, or of a case that did not pass: " + ", ".join(lost))
    drawn = []
    for case, i in pictures:
        plot = good[case]["plots"][i]
        drawn.append({"file": f"verify/report/pictures/{case}-{i + 1}.svg", "case": case, "plot": i, "title": plot["title"],
                      "caption": plot.get("caption", "")})
    statuses = ("passed", "failed", "refused as expected", "skipped")
    return {"date": report["date"], "counts": {s: sum(c["status"] == s for c in report["cases"]) for s in statuses}, "command": report["command"], "commit": report["commit"], "processor": report["machine"]["processor"],
            "cores": report["machine"]["cores"], "figures": [found[name] for name in figures], "pictures": drawn}


def block(head: dict) -> str:
    lines = [BEGIN, "", f"Measured on {head['date']}, commit {head['commit']}, {head['processor']}, {head['cores']} cores, by", "",
             f"    {head['command']}", "", "Cases: " + ", ".join(f"{n} {s}" for s, n in head["counts"].items()) + ".", "", "| | | case |", "|---|---|---|"]
    for f in head["figures"]:
        lines.append(f"| {f['text']} | {show(f['value'])} {f['unit']}".rstrip() + f" | {f['case']} |")
    lines.append("")
    for p in head["pictures"]:
        lines += [f"![{p['title']}. {p['caption']}]({p['file']})", ""]
    return "\n".join([*lines, END])


def speed(report: dict) -> dict | None:
    """The table of speed, or None where the report has not all of it, or the machine was too busy: timings are of one report, never of two."""
    found = {f["name"]: f for c in report["cases"] if c["status"] == "passed" for f in c["figures"]}
    rows = []
    for title, scene in SPEED:
        figures = [found.get(f"speed_{scene}_{key}") for _, key in SPEED_COLUMNS]
        noise = found.get(f"speed_{scene}_noise")
        if None in figures or noise is None or noise["value"] > NOISE:
            return None
        rows.append([title, *(f["value"] for f in figures)])
    return {**{k: report[k] for k in ("date", "commit", "command")}, "processor": report["machine"]["processor"], "rows": rows}


def sentences(report: dict) -> dict:
    """What of SENTENCES this report has all figures for."""
    found = {f["name"]: f["value"] for c in report["cases"] if c["status"] == "passed" for f in c["figures"]}
    told = {}
    for name, (full, words) in SENTENCES.items():
        wanted = [field for _, field, _, _ in string.Formatter().parse(words) if field]
        if not (full and report["quick"]) and all(field in found for field in wanted):
            told[name] = {"text": words.format(**found), "figures": {field: found[field] for field in wanted}, "date": report["date"], "commit": report["commit"],
                          "command": report["command"]}
    return told


def sentence_marks(name: str) -> tuple[str, str]:
    return f"<!-- {name}:begin (verify/report/readme.py) -->", f"<!-- {name}:end -->"


def sentence_block(name: str, told: dict) -> str:
    begin, end = sentence_marks(name)
    text = f"{told['text']} (`{told['command']}`, {told['date'][:10]}, commit {told['commit']}.)"
    return "\n".join([begin, *textwrap.wrap(text, 140, break_on_hyphens=False), end])


def two_digits(value) -> str:
    """Timings have no more."""
    return show(value) if isinstance(value, str) or value >= 1000 else show(float(f"{value:.2g}"))


def speed_block(table: dict) -> str:
    lines = [SPEED_BEGIN, "", f"{table['processor']}, {table['date']}, commit {table['commit']}:", "", "| cells | " + " | ".join(name for name, _ in SPEED_COLUMNS) + " |",
             "|---" * (len(SPEED_COLUMNS) + 1) + "|"]
    for title, *values in table["rows"]:
        cells = [two_digits(v) + (" s" if key == "seconds" else "") for v, (_, key) in zip(values, SPEED_COLUMNS)]
        lines.append("| " + " | ".join([title, *cells]) + " |")
    return "\n".join([*lines, "", SPEED_END])


def between(text: str, begin: str = BEGIN, end: str = END) -> str:
    if text.count(begin) != 1 or text.count(end) != 1 or text.index(begin) > text.index(end):
        raise Refused(f"the README must have one \"{begin}\" and one \"{end}\" after it")
    return text[text.index(begin):text.index(end) + len(end)]


def differences(readme: str, head: dict, root: pathlib.Path) -> list[str]:
    """Why README and headline.json do not agree; empty if they do."""
    try:
        written = between(readme)
    except Refused as error:
        return [str(error)]
    wanted = block(head).splitlines()
    got = written.splitlines()
    wrong = [f"README has \"{a}\", headline.json gives \"{b}\"" for a, b in zip(got, wanted) if a != b]
    if len(got) != len(wanted):
        wrong.append(f"README's block has {len(got)} lines, headline.json gives {len(wanted)}")
    if head.get("speed"):
        try:
            if between(readme, SPEED_BEGIN, SPEED_END) != speed_block(head["speed"]):
                wrong.append("README's table of speed is not the one that headline.json gives")
        except Refused as error:
            wrong.append(str(error))
    for name, told in head.get("sentences", {}).items():
        try:
            if between(readme, *sentence_marks(name)) != sentence_block(name, told):
                wrong.append(f"README's sentence \"{name}\" is not the one that headline.json gives")
        except Refused as error:
            wrong.append(str(error))
    return wrong + [f"{p['file']} is missing" for p in head["pictures"] if not (root / p["file"]).is_file()]


def main(argv: list[str]) -> int:
    parser = argparse.ArgumentParser(prog="readme.py", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", nargs="?", type=pathlib.Path)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--readme", type=pathlib.Path, default=ROOT / "README.md")
    a = parser.parse_args(argv)
    if a.check == (a.out is not None):
        parser.error("either OUT or --check")
    text = a.readme.read_text(encoding="utf-8")
    if a.check:
        wrong = differences(text, json.loads((HERE / "headline.json").read_text(encoding="utf-8")), ROOT)
        for line in wrong:
            print(f"readme.py: {line}", file=sys.stderr)
        return 1 if wrong else 0
    report = json.loads((a.out / "report.json").read_text(encoding="utf-8"))
    try:
        head, old = gather(report), between(text)
        before = json.loads((HERE / "headline.json").read_text(encoding="utf-8"))
        # A report without all of the timing cases leaves the table of the last one that had them, with its date.
        timed = speed(report) or before.get("speed")
        if timed:
            head["speed"] = timed
            text = text.replace(between(text, SPEED_BEGIN, SPEED_END), speed_block(timed))
        head["sentences"] = {**before.get("sentences", {}), **sentences(report)}
        for name, told in head["sentences"].items():
            text = text.replace(between(text, *sentence_marks(name)), sentence_block(name, told))
    except Refused as error:
        print(f"readme.py: {error}", file=sys.stderr)
        return 1
    import plots

    (HERE / "pictures").mkdir(exist_ok=True)
    cases = {c["id"]: c for c in report["cases"]}
    for p in head["pictures"]:
        (ROOT / p["file"]).write_text(plots.svg(cases[p["case"]]["plots"][p["plot"]], plots.WIDE) + "\n", encoding="utf-8")
    (HERE / "headline.json").write_text(json.dumps(head, indent=1) + "\n", encoding="utf-8")
    a.readme.write_text(text.replace(old, block(head)), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
