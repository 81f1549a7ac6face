# SPDX-License-Identifier: BSD-3-Clause
"""Checks that every folder of src has a README that names each of its files.

    python3 verify/style/readmes.py
"""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]


def problems(src):
    """Folders without README.md, and files whose name without its ending stands in none of it."""
    for folder in [src, *sorted(p for p in src.rglob("*") if p.is_dir())]:
        readme = folder / "README.md"
        if not readme.is_file():
            yield f"{folder.relative_to(src.parent)}: no README.md"
            continue
        words = set(re.findall(r"\w+", readme.read_text(encoding="utf-8")))
        for stem in sorted({p.stem for p in folder.glob("*.[ch]pp")} - words):
            yield f"{readme.relative_to(src.parent)}: does not name {stem}"


def main():
    wrong = list(problems(ROOT / "src"))
    for line in wrong:
        print(line, file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
