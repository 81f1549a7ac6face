# SPDX-License-Identifier: BSD-3-Clause
"""Checks sizes: lines of code at most 120 columns wide; in src, functions of at most 80 lines and files of at most 500;
READMEs of folders of at most 40 lines, as wide as code outside tables and blocks.

    python3 verify/style/sizes.py [--list]
"""

import argparse
import pathlib
import subprocess
import sys

import scanner

ROOT = pathlib.Path(__file__).resolve().parents[2]
WIDTH, FUNCTION, FILE, README = 120, 80, 500, 40
PYTHON = ("examples/", "verify/petsc/", "bindings/python/", "bindings/site/")  # the Python files whose width is checked
CODE = {".c", ".h", ".cpp", ".hpp", ".cmake", ".f90", ".jl"}
FOLDERS = ("include", "src", "bindings", "verify", "examples")


def sources():
    """Our own files below the folders, tracked or new; in a tarball all of them. Baselines are as they were released."""
    command = ["git", "ls-files", "--cached", "--others", "--exclude-standard", "--", *FOLDERS]
    listed = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    if listed.returncode == 0 and listed.stdout:
        paths = [ROOT / line for line in listed.stdout.splitlines()]
    else:
        paths = [p for folder in FOLDERS for p in (ROOT / folder).rglob("*")]
    kept = (p for p in paths if p.suffix in CODE or p.name in ("CMakeLists.txt", "README.md") or
            (p.suffix == ".py" and p.relative_to(ROOT).as_posix().startswith(PYTHON)))
    return sorted(p for p in kept if p.is_file() and "verify/abi/baseline/" not in p.as_posix())


def problems(name, text):
    """Lists what is too long in a file of this name, a line each."""
    lines = text.splitlines()
    page = name.endswith("README.md")
    if page and len(lines) > README:
        yield f"{name}: {len(lines)} lines, at most {README} in a README"
    for n, line in enumerate(lines, 1):
        if len(line) > WIDTH and not (page and line.startswith(("|", "    "))):
            yield f"{name}:{n}: {len(line)} columns, at most {WIDTH}"
    if not name.startswith("src/") or not name.endswith((".cpp", ".hpp")):
        return
    if len(lines) > FILE:
        yield f"{name}: {len(lines)} lines, at most {FILE} in src"
    for first, length in scanner.functions(text):
        if length > FUNCTION:
            yield f"{name}:{first}: a function of {length} lines, at most {FUNCTION} in src"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--list", action="store_true", help="print the length of every function of src, longest first")
    arguments = parser.parse_args()
    texts = {p.relative_to(ROOT).as_posix(): p.read_text(encoding="utf-8") for p in sources()}
    found = {name: list(scanner.functions(text)) for name, text in texts.items()
             if name.startswith("src/") and name.endswith((".cpp", ".hpp"))}
    if arguments.list:
        for length, name, first in sorted(((n, name, at) for name, list_ in found.items() for at, n in list_), reverse=True):
            print(f"{length:4d} {name}:{first}")
    wrong = [line for name, text in texts.items() for line in problems(name, text)]
    print(f"{len(texts)} files; {sum(map(len, found.values()))} functions in src")
    for line in wrong:
        print(line, file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
