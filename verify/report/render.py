#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""render.py OUT: pages from OUT/report.json, and from nothing else."""
from __future__ import annotations

import concurrent.futures
import json
import os
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import jinja2  # noqa: E402

import child  # noqa: E402
import schema  # noqa: E402
from words import NO_LEDGER, bound, expected, show  # noqa: E402

ORDER = ("failed", "refused as expected", "passed", "skipped")


def slug(status: str) -> str:
    return status.split()[0]


def counts(cases: list[dict]) -> dict:
    return {s: sum(c["status"] == s for c in cases) for s in schema.STATUSES}


def closest(cases: list[dict]) -> dict | None:
    """The case that uses most of its limit."""
    judged = []
    for c in cases:
        j = c["judgement"]["reference"]
        value, limit = j.get("value"), j.get("limit")
        if isinstance(value, (int, float)) and isinstance(limit, (int, float)) and value > 0 and limit > 0 and c["checks"]:
            judged.append((limit / value if j.get("sense") == ">=" else value / limit, c))
    return max(judged, key=lambda entry: entry[0])[1] if judged else None


# Widths in pixels: of a letter in a table, of a cell's margins, of the page's text at 1280, of a phone.
LETTER, MARGINS, PAGE, PHONE = 8.3, 15, 1088, 362


def _width(table: dict, i: int, text: int) -> float:
    """Heads and texts wrap at words, numbers do not; text: letters that a text takes in a line."""
    column = table["columns"][i]
    cells = [row[i] for row in table["rows"]]
    words = [*column["name"].split(), *column["unit"].split(), *(w for c in cells if isinstance(c, str) for w in c.split()), *(show(c) for c in cells if not isinstance(c, str))]
    letters = max([len(w) for w in words] + [min(len(c), text) for c in cells if isinstance(c, str)] + [3])
    return LETTER * min(letters, 30) + MARGINS


def _split(title: str, columns: list[dict], width: list[float], keys: list[int], room: float) -> list[tuple[str, list[int]]]:
    """Parts as titles and columns; every part has the keys."""
    found, now, words = [], list(keys), title
    for i, c in enumerate(columns):
        if i in keys:
            continue
        if len(now) > len(keys) and ("part" in c or sum(width[j] for j in now) + width[i] > room):
            found.append((words, now))
            now, words = list(keys), c["part"] if "part" in c else f"{words.removesuffix(', continued')}, continued"
        now.append(i)
    return [*found, (words, now)]


def parts(table: dict) -> list[dict]:
    """A table as parts that the page is wide enough for, each with the columns that name a row. A column that says {"part": words} begins one,
    so that what belongs together stays so; without key columns a table stays whole, and scrolls."""
    columns = table["columns"]
    width = [_width(table, i, 18) for i in range(len(columns))]
    phone = [_width(table, i, 0) for i in range(len(columns))]
    keys = [i for i, c in enumerate(columns) if c.get("key")]
    found = [(table["title"], list(range(len(columns))))]
    if keys and (sum(width) > PAGE or any("part" in c for c in columns)):
        found = _split(table["title"], columns, width, keys, PAGE)
        # As many parts as needed, of widths that are alike: no last one with a single column.
        for room in range(PAGE // 3, PAGE, 16):
            even = _split(table["title"], columns, width, keys, room)
            if len(even) == len(found):
                found = even
                break
    return [{"title": words, "note": table.get("note", "") if place == 0 else "", "columns": [columns[i] for i in of],
             "rows": [[row[i] for i in of] for row in table["rows"]], "scrolls": sum(phone[i] for i in of) > PHONE} for place, (words, of) in enumerate(found)]


def draw(plots_of: dict) -> dict:
    """Every plot by case and place; drawn at once on all cores."""
    import plots

    jobs = [(key, plot) for key, plot in plots_of.items()]
    if not jobs:
        return {}
    with concurrent.futures.ProcessPoolExecutor(min(os.cpu_count() or 1, 8)) as pool:
        return dict(zip([key for key, _ in jobs], pool.map(plots.both, [plot for _, plot in jobs])))


def environment() -> jinja2.Environment:
    env = jinja2.Environment(loader=jinja2.FileSystemLoader(HERE / "templates"), undefined=jinja2.StrictUndefined,
                             autoescape=jinja2.select_autoescape(["html", "html.j2"]), trim_blocks=True, lstrip_blocks=True)
    env.filters.update(show=show, slug=slug, bound=bound, expected=expected)
    env.globals.update(parts=parts, no_ledger=NO_LEDGER)
    return env


def pages(report: dict) -> dict:
    """Path under OUT -> text of the page."""
    for c in report["cases"]:
        schema.check(c)
    drawn = draw({(c["id"], i): plot for c in report["cases"] for i, plot in enumerate(c["plots"])})
    chapters = []
    for key, title in report["chapters"].items():
        of = sorted((c for c in report["cases"] if c["chapter"] == key), key=lambda c: ORDER.index(c["status"]))
        chapters.append({"key": key, "title": title, "cases": of, "counts": counts(of), "closest": closest(of),
                         "claims": [claim["text"] for claim in report["claims"] if claim["chapter"] == key],
                         "losses": [{"case": c, "texts": c["losses"]} for c in of if c["losses"]]})
    style = (HERE / "templates" / "style.css").read_text(encoding="utf-8")
    env = environment()
    everything = {"report": report, "chapters": chapters, "drawn": drawn, "style": style, "totals": counts(report["cases"]),
                  "failed": [c for c in report["cases"] if c["status"] == "failed"],
                  "skipped": [c for c in report["cases"] if c["status"] == "skipped"],
                  "losses": [entry for chapter in chapters for entry in chapter["losses"]],
                  "figures": [(c, f) for c in report["cases"] for f in c["figures"] if c["status"] == "passed"]}
    out = {"index.html": env.get_template("index.html.j2").render(**everything),
           "report.md": env.get_template("report.md.j2").render(**everything)}
    for c in report["cases"]:
        out[f"cases/{c['id']}.html"] = env.get_template("case.html.j2").render(**everything, case=c)
    return out


def main(argv: list[str]) -> int:
    if len(argv) != 1:
        print("usage: render.py OUT", file=sys.stderr)
        return 2
    child.follow()
    out = pathlib.Path(argv[0])
    report = json.loads((out / "report.json").read_text(encoding="utf-8"))
    made = pages(report)
    for old in (out / "cases").glob("*.html"):
        old.unlink()
    for name, text in made.items():
        path = out / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
