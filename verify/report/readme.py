#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""readme.py OUT: writes headline figures and pictures of a report into RESULTS.md, and a summary into the top README, between
their markers.

    readme.py OUT        from OUT/report.json: headline.json, pictures/, the blocks in RESULTS.md, the summary in the top README;
                         from a report that --only made, the table of speed and the sentences alone
    readme.py --check    exit status 1 if a block, the table of speed, a sentence or the summary is missing, or differs from
                         what headline.json gives"""
from __future__ import annotations

import argparse
import json
import pathlib
import string
import sys
import textwrap

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
PAGE, TOP = HERE / "RESULTS.md", ROOT / "README.md"
PAGE_FOLDER = "verify/report/"
sys.path.insert(0, str(HERE))

from words import LEFT_OUT, show  # noqa: E402

BEGIN, END = "<!-- report:begin (verify/report/readme.py) -->", "<!-- report:end -->"
SUMMARY_BEGIN, SUMMARY_END = "<!-- summary:begin (verify/report/readme.py) -->", "<!-- summary:end -->"
SPEED_BEGIN, SPEED_END = "<!-- speed:begin (verify/report/readme.py) -->", "<!-- speed:end -->"
# Figures by their names in the JSON, and pictures by case and place; only of cases that passed.
FIGURES = ["feti_direct_worst", "feti_direct_kkt", "balance_defect", "jump_mm"]
PICTURES = [("b-ledger", 0), ("b-jump-instant", 0), ("a-feti-direct", 1)]
# The table of speed: a row is what it is called, and the middle of the names of its figures. Only a report that has all of them renews it.
SPEED = [("0.5 mm", "ductile_0.5"), ("0.1 mm, one thread", "ductile_0.1"), ("0.1 mm, OpenMP as Debian's CHOLMOD sets it", "ductile_0.1_shipped")]
# Head, name of the figure, what follows the number.
SPEED_COLUMNS = [("unknowns", "unknowns", ""), ("whole analysis", "seconds", " s"), ("in linear solves", "lse", ""), ("baseline over this", "ratio", " times"),
                 ("peak memory over one factorisation's", "memory", " times")]
# What the block of speed must say for itself while no report has made it.
BY_HAND = "Measured by hand with `delam_bench`, not yet by the report"
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
    """What the pages need and the report or the page does not have."""


def when(report: dict, cases: list[dict]) -> str:
    """When these cases ran; a report with --only holds older ones too."""
    dates = sorted({c.get("date", report["date"]) for c in cases})
    return dates[0] if len(cases) == 0 or dates[0][:10] == dates[-1][:10] else f"{dates[0]} to {dates[-1]}"


def whole(report: dict) -> str:
    """The command that makes all of the cases; that of the report may have renewed some of them, or their pasts."""
    return report["command"].split(" --only")[0].removesuffix(" --accept")


def of_some_cases(report: dict) -> bool:
    """True if --only has left out cases that no report before it had made there."""
    return any(c["status"] == "skipped" and c["reason"] == LEFT_OUT for c in report["cases"])


def gather(report: dict, figures=None, pictures=None) -> dict:
    """What the pages quote, from the report alone."""
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
    return {"date": when(report, list(good.values())), "counts": {s: sum(c["status"] == s for c in report["cases"]) for s in statuses}, "command": whole(report), "commit": report["commit"],
            "processor": report["machine"]["processor"],
            "cores": report["machine"]["cores"], "figures": [found[name] for name in figures], "pictures": drawn}


def block(head: dict) -> str:
    lines = [BEGIN, "", f"Measured on {head['date']}, commit {head['commit']}, {head['processor']}, {head['cores']} cores, by", "",
             f"    {head['command']}", "", "Cases: " + ", ".join(f"{n} {s}" for s, n in head["counts"].items()) + ".", "", "| | | case |", "|---|---|---|"]
    for f in head["figures"]:
        lines.append(f"| {f['text']} | {show(f['value'])} {f['unit']}".rstrip() + f" | {f['case']} |")
    lines.append("")
    for p in head["pictures"]:
        lines += [f"![{p['title']}. {p['caption']}]({p['file'].removeprefix(PAGE_FOLDER)})", ""]
    return "\n".join([*lines, END])


def summary_block(head: dict) -> str:
    """The last report in one sentence, for the top README."""
    counts = ", ".join(f"{n} {s}" for s, n in head["counts"].items() if n or s in ("passed", "failed"))
    text = (f"The last verification report, of {head['date'][:10]} (commit {head['commit']}): of its cases, {counts}. Its figures, losses first, are in "
            f"[{PAGE_FOLDER}{PAGE.name}]({PAGE_FOLDER}{PAGE.name}).")
    return "\n".join([SUMMARY_BEGIN, *textwrap.wrap(text, 120, break_on_hyphens=False, break_long_words=False), SUMMARY_END])


def speed(report: dict) -> dict | None:
    """The table of speed, or None where the report has not all of it, or the machine was too busy: timings are of one report, never of two."""
    if report.get("quick"):
        return None
    found = {f["name"]: (f, c) for c in report["cases"] if c["status"] == "passed" for f in c["figures"]}
    rows, of, noise = [], [], []
    for title, scene in SPEED:
        figures = [found.get(f"speed_{scene}_{key}") for _, key, _ in SPEED_COLUMNS]
        scatter = found.get(f"speed_{scene}_noise")
        if None in figures or scatter is None or scatter[0]["value"] > NOISE:
            return None
        of.append(figures[0][1])
        noise.append(scatter[0]["value"])
        rows.append([title, *(f["value"] for f, _ in figures), priced(of[-1])])
    machine = report["machine"]
    return {"date": when(report, of), "commit": report["commit"], "command": f"{whole(report)} --only {' '.join(c['id'] for c in of)}", "processor": machine["processor"],
            "cores": machine["cores"], "kernels": machine.get("openblas_of_timings", "unknown"), "noise": max(noise), "rows": rows,
            "losses": [[title, text] for (title, _), c in zip(SPEED, of) for text in c["losses"]]}


def priced(case: dict) -> str:
    """How the baseline got its time, in the words of the case: measured, or priced from counted factorisations."""
    for t in case["tables"]:
        names = [c["name"] for c in t["columns"]]
        if "method" in names and "note" in names:
            for row in t["rows"]:
                if row[names.index("method")] == "baseline":
                    return row[names.index("note")]
    return "measured"


def sentences(report: dict) -> dict:
    """What of SENTENCES this report has all figures for."""
    found = {f["name"]: f["value"] for c in report["cases"] if c["status"] == "passed" for f in c["figures"]}
    told = {}
    for name, (full, words) in SENTENCES.items():
        wanted = [field for _, field, _, _ in string.Formatter().parse(words) if field]
        if not (full and report["quick"]) and all(field in found for field in wanted):
            told[name] = {"text": words.format(**found), "figures": {field: found[field] for field in wanted}, "date": report["date"], "commit": report["commit"],
                          "command": whole(report)}
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
    lines = [SPEED_BEGIN, ""]
    if table["losses"]:
        lines += ["Losses and missed goals:", ""]
        for title in dict.fromkeys(title for title, _ in table["losses"]):
            lines += textwrap.wrap(f"- {title}: " + "; ".join(text for name, text in table["losses"] if name == title), 140, subsequent_indent="  ", break_on_hyphens=False)
        lines.append("")
    lines += ["| cells | " + " | ".join(name for name, _, _ in SPEED_COLUMNS) + " |", "|---" * (len(SPEED_COLUMNS) + 1) + "|"]
    for title, *values, how in table["rows"]:
        cells = [two_digits(v) + unit + (f", {how}" if key == "ratio" and how != "measured" else "") for v, (_, key, unit) in zip(values, SPEED_COLUMNS)]
        lines.append("| " + " | ".join([title, *cells]) + " |")
    said = (f"Medians of three rounds that take turns, on {table['processor']}, {table['cores']} cores, BLAS kernels {table['kernels']}; two series of the same solve differ by "
            f"{two_digits(100 * table['noise'])} % at most. Extrapolated: the baseline is priced from counted factorisations, of which a part was timed. {table['date']}, commit "
            f"{table['commit']}, by")
    return "\n".join([*lines, "", *textwrap.wrap(said, 140, break_on_hyphens=False), "", f"    {table['command']}", "", SPEED_END])


def between(text: str, begin: str = BEGIN, end: str = END) -> str:
    if text.count(begin) != 1 or text.count(end) != 1 or text.index(begin) > text.index(end):
        raise Refused(f"the page must have one \"{begin}\" and one \"{end}\" after it")
    return text[text.index(begin):text.index(end) + len(end)]


def top_differences(readme: str, head: dict) -> list[str]:
    """Why the summary in the top README and headline.json do not agree; empty if they do."""
    try:
        same = between(readme, SUMMARY_BEGIN, SUMMARY_END) == summary_block(head)
        return [] if same else ["the summary in README.md is not the one that headline.json gives"]
    except Refused as error:
        return [f"README.md: {error}"]


def differences(page: str, head: dict, root: pathlib.Path) -> list[str]:
    """Why RESULTS.md and headline.json do not agree; empty if they do."""
    try:
        written = between(page)
    except Refused as error:
        return [str(error)]
    wanted = block(head).splitlines()
    got = written.splitlines()
    wrong = [f"the page has \"{a}\", headline.json gives \"{b}\"" for a, b in zip(got, wanted) if a != b]
    if len(got) != len(wanted):
        wrong.append(f"the page's block has {len(got)} lines, headline.json gives {len(wanted)}")
    # Markers are missing whatever headline.json has: what is not there cannot be compared.
    try:
        table = between(page, SPEED_BEGIN, SPEED_END)
        if head.get("speed"):
            if table != speed_block(head["speed"]):
                wrong.append("the page's table of speed is not the one that headline.json gives")
        elif BY_HAND not in table:
            wrong.append(f"headline.json has no table of speed, and the page's does not say \"{BY_HAND}\"")
    except Refused as error:
        wrong.append(str(error))
    told_of = head.get("sentences", {})
    wrong += [f"headline.json has no sentence \"{name}\"" for name in SENTENCES if name not in told_of]
    for name in dict.fromkeys([*SENTENCES, *told_of]):
        try:
            text, told = between(page, *sentence_marks(name)), told_of.get(name)
            if told and text != sentence_block(name, told):
                wrong.append(f"the page's sentence \"{name}\" is not the one that headline.json gives")
        except Refused as error:
            wrong.append(str(error))
    return wrong + [f"{p['file']} is missing" for p in head["pictures"] if not (root / p["file"]).is_file()]


def main(argv: list[str]) -> int:
    parser = argparse.ArgumentParser(prog="readme.py", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", nargs="?", type=pathlib.Path)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--page", type=pathlib.Path, default=PAGE,
                        help="a copy of RESULTS.md to try it on: headline.json, pictures and the top README do not change")
    a = parser.parse_args(argv)
    if a.check == (a.out is not None):
        parser.error("either OUT or --check")
    text, top = a.page.read_text(encoding="utf-8"), TOP.read_text(encoding="utf-8")
    if a.check:
        head = json.loads((HERE / "headline.json").read_text(encoding="utf-8"))
        wrong = differences(text, head, ROOT) + top_differences(top, head)
        for line in wrong:
            print(f"readme.py: {line}", file=sys.stderr)
        return 1 if wrong else 0
    report = json.loads((a.out / "report.json").read_text(encoding="utf-8"))
    try:
        before = json.loads((HERE / "headline.json").read_text(encoding="utf-8"))
        partial = of_some_cases(report)
        head, old = dict(before) if partial else gather(report), between(text)
        # A report without all of the timing cases leaves the table of the last one that had them, with its date.
        timed = speed(report) or before.get("speed")
        if timed:
            head["speed"] = timed
            text = text.replace(between(text, SPEED_BEGIN, SPEED_END), speed_block(timed))
        else:
            print("readme.py: the table of speed stays as it is: not all of its cases passed with a scatter below "
                  f"{NOISE:.0%}", file=sys.stderr)
        head["sentences"] = {**before.get("sentences", {}), **sentences(report)}
        for name, told in head["sentences"].items():
            text = text.replace(between(text, *sentence_marks(name)), sentence_block(name, told))
        if not partial:
            top = top.replace(between(top, SUMMARY_BEGIN, SUMMARY_END), summary_block(head))
    except Refused as error:
        print(f"readme.py: {error}", file=sys.stderr)
        return 1
    if a.page.resolve() != PAGE:
        a.page.write_text(text.replace(old, block(head)), encoding="utf-8")
        return 0
    import plots

    (HERE / "pictures").mkdir(exist_ok=True)
    cases = {c["id"]: c for c in report["cases"]}
    for p in [] if partial else head["pictures"]:
        (ROOT / p["file"]).write_text(plots.svg(cases[p["case"]]["plots"][p["plot"]], plots.WIDE) + "\n", encoding="utf-8")
    (HERE / "headline.json").write_text(json.dumps(head, indent=1) + "\n", encoding="utf-8")
    a.page.write_text(text.replace(old, block(head)), encoding="utf-8")
    TOP.write_text(top, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
