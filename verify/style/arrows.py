# SPDX-License-Identifier: BSD-3-Clause
"""Checks that the folders of src include one another only along the arrows listed in src/README.md.

A folder may include what stands below it in that list, and nothing else; so the structure has no circle. An arrow that
the list allows but no file needs any more is refused as well: the list is the structure, not a fence around it.

    python3 verify/style/arrows.py [--list]
"""

import argparse
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.M)
ROW = re.compile(r"^\| `(?P<folder>[a-z/_]+)/` \|(?P<what>[^|]*)\|(?P<uses>[^|]*)\|$", re.M)


def allowed(readme):
    """Folder -> folders it may include, from the table of the README, top to bottom."""
    rows = [(m["folder"], re.findall(r"[a-z_]+(?:/[a-z_]+)?", m["uses"])) for m in ROW.finditer(readme)]
    if not rows:
        raise SystemExit("src/README.md: no table of folders found")
    return dict(rows)


def place(path, folders):
    """The longest listed folder that holds this path below src."""
    parts = pathlib.PurePosixPath(path).parts[:-1]
    for n in range(len(parts), 0, -1):
        if "/".join(parts[:n]) in folders:
            return "/".join(parts[:n])
    return None


def found(src, folders):
    """(from, to) -> one file that shows it."""
    arrows = {}
    for path in sorted(src.rglob("*.[ch]pp")):
        name = path.relative_to(src).as_posix()
        here = place(name, folders)
        if here is None:
            raise SystemExit(f"src/{name}: its folder is not in the table of src/README.md")
        for included in INCLUDE.findall(path.read_text(encoding="utf-8")):
            there = place(included, folders)
            if there is not None and there != here:
                arrows.setdefault((here, there), f"src/{name} includes {included}")
    return arrows


def problems(uses, arrows):
    order = list(uses)
    out = []
    for (a, b), example in sorted(arrows.items()):
        if b not in uses[a]:
            out.append(f"{a} -> {b} is not in the table of src/README.md: {example}")
    for a, targets in uses.items():
        for b in targets:
            if b not in uses:
                out.append(f"{a} -> {b}: there is no such folder")
            elif order.index(b) <= order.index(a):
                out.append(f"{a} -> {b} points up the table of src/README.md")
            elif (a, b) not in arrows:
                out.append(f"{a} -> {b} is in the table of src/README.md, but no file needs it")
    return out


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--list", action="store_true", help="print every arrow with a file that shows it")
    arguments = parser.parse_args()
    uses = allowed((ROOT / "src/README.md").read_text(encoding="utf-8"))
    arrows = found(ROOT / "src", uses)
    if arguments.list:
        for (a, b), example in sorted(arrows.items()):
            print(f"{a} -> {b}: {example}")
    wrong = problems(uses, arrows)
    top = {(a.split("/")[0], b.split("/")[0]) for a, b in arrows}
    top = {(a, b) for a, b in top if a != b}
    print(f"{len(arrows)} arrows between {len(uses)} folders; {len(top)} between the {len({a for a, _ in top} | {b for _, b in top})} of src")
    if len(top) > 30:
        wrong.append(f"{len(top)} arrows between the folders of src, at most 30 are wanted")
    for line in wrong:
        print(line, file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
