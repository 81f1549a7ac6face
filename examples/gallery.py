#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""gallery.py OUT FOLDER ...: OUT/index.html, with a picture of each result and a link to its page (delam view)."""
import html
import json
import os
import shutil
import sys

# The first that a result has: what it looks like, in space before it is cut.
PICTURES = ("snapshots.png", "cut.png", "load-displacement.png")
STYLE = """
* { box-sizing: border-box; }
:root { --paper: #fff; --ink: #1d2127; --soft: #5a616b; --line: #cdd2d9; --accent: #1f5a99; --red: #b3451a; }
@media (prefers-color-scheme: dark) {
  :root { --paper: #15181c; --ink: #e8eaed; --soft: #a5acb6; --line: #3d444d; --accent: #7db3ee; --red: #f08a4b; } }
body { margin: 0 auto; max-width: 84rem; padding: 0.8rem; background: var(--paper); color: var(--ink);
  font: 15px/1.4 system-ui, sans-serif; }
h1 { font-size: 1.3rem; margin: 0 0 0.2rem; } h2 { font-size: 1rem; margin: 0.4rem 0 0; }
p { margin: 0.1rem 0; color: var(--soft); font-size: 0.85rem; overflow-wrap: anywhere; }
p.warning { color: var(--red); }
ul { list-style: none; margin: 1rem 0; padding: 0; display: grid; gap: 1rem;
  grid-template-columns: repeat(auto-fill, minmax(min(100%, 21rem), 1fr)); }
li a { display: block; height: 100%; border: 1px solid var(--line); border-radius: 6px; padding: 0.6rem; color: inherit;
  text-decoration: none; }
li a:hover, li a:focus-visible { border-color: var(--accent); outline: 2px solid var(--accent); }
img { width: 100%; height: 13rem; object-fit: contain; background: #fff; border-radius: 4px; }
"""


def card(folder, out):
    with open(os.path.join(folder, "result.json"), encoding="utf-8") as file:
        about = json.load(file)
    name = os.path.basename(os.path.normpath(folder))
    scene = about["scene"]
    picture = next((p for p in PICTURES if os.path.exists(os.path.join(folder, p))), None)
    lines = [f'<li><a href="{html.escape(os.path.relpath(os.path.join(folder, "view.html"), out))}">']
    if picture:
        copy = f"{name}.png"
        shutil.copyfile(os.path.join(folder, picture), os.path.join(out, copy))
        what = f"{picture.removesuffix('.png')} of {name}"
        lines.append(f'<img loading="lazy" alt="{html.escape(what)}" src="{html.escape(copy)}">')
    named = [f"{about['concept'][key]} {noun}" for key, noun in (("solution", "solution"), ("mixity_rule", "mixity"))
             if key in about["concept"]]
    words = [f"{scene['dimension']}D", *named, f"{about['steps_done']} steps",
             f"{about['unknowns']['primal']:,} unknowns"]
    lines.append(f"<h2>{html.escape(scene['title'] or name)}</h2>")
    lines.append(f"<p>{html.escape(name)}: {html.escape(', '.join(words))}</p>")
    if about["status"] != "complete":
        lines.append(f'<p class="warning">incomplete: {about["steps_done"]} of {about["steps"]} steps</p>')
    if about["not_converged"]:
        number = len(about["not_converged"])
        lines.append(f'<p class="warning">{number} {"step" if number == 1 else "steps"} did not converge</p>')
    jumps = about["jumps"]["count"]
    if jumps:
        lines.append(f"<p>{jumps} {'jump' if jumps == 1 else 'jumps'} of the state</p>")
    return "\n".join([*lines, "</a></li>"])


def main():
    if len(sys.argv) < 3:
        print("usage: gallery.py OUT FOLDER ...", file=sys.stderr)
        return 2
    out, folders = sys.argv[1], sys.argv[2:]
    os.makedirs(out, exist_ok=True)
    page = "\n".join([
        '<!doctype html>\n<html lang="en"><head><meta charset="utf-8">',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        '<meta name="color-scheme" content="light dark">',
        f"<title>Examples of delam</title><style>{STYLE}</style></head><body>",
        "<h1>Examples of delam</h1>",
        "<p>Each opens as a page with the deformed body, its load curve and its energies, step by step.</p><ul>",
        *(card(folder, out) for folder in folders), "</ul></body></html>\n"])
    path = os.path.join(out, "index.html")
    with open(path + ".new", "w", encoding="utf-8") as file:
        file.write(page)
    os.replace(path + ".new", path)
    print(f"{path}: {len(folders)} results")
    return 0


if __name__ == "__main__":
    sys.exit(main())
