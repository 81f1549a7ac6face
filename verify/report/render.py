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

import schema  # noqa: E402
from words import NO_LEDGER, show  # noqa: E402

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
    env.filters.update(show=show, slug=slug)
    env.globals["no_ledger"] = NO_LEDGER
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
                         "losses": [{"case": c, "text": text} for c in of for text in c["losses"]]})
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
