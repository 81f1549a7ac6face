# SPDX-License-Identifier: BSD-3-Clause
"""Checks that every file of src is named in the README of its folder or of a folder above it.

    python3 verify/style/readmes.py
"""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]


def problems(src):
    """Yields top folders without README.md, and files whose name without its ending stands in no README above them."""
    for folder in [src, *sorted(p for p in src.iterdir() if p.is_dir())]:
        if not (folder / "README.md").is_file():
            yield f"{folder.relative_to(src.parent)}: no README.md"
    words = {p.parent: set(re.findall(r"\w+", p.read_text(encoding="utf-8"))) for p in src.rglob("README.md")}
    for stem in sorted({p.with_suffix("") for p in src.rglob("*.[ch]pp")}):
        above = [folder for folder in stem.parents if folder.is_relative_to(src)]
        if not any(stem.name in words.get(folder, ()) for folder in above):
            yield f"{stem.relative_to(src.parent)}: named in no README of its folder or of one above it"


def main():
    wrong = list(problems(ROOT / "src"))
    for line in wrong:
        print(line, file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
