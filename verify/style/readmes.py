# SPDX-License-Identifier: BSD-3-Clause
"""Checks that every file of src is named in the README of its folder or of a folder above it, that each path to a file of
the repository, in a text or a comment, leads to one, that the functions of a load step are where src/README.md says, and
that the top level has nothing else than what is agreed.

    python3 verify/style/readmes.py
"""

import pathlib
import re
import subprocess
import sys

import scanner

ROOT = pathlib.Path(__file__).resolve().parents[2]
# A path to a file, from the root of the repository or from a folder above the file that names it; NAME and FAMILY stand
# for names of the reader.
PATH = re.compile(r"(?<![\w/.-])(?:src|verify|bindings|examples|include)/(?!NAME|FAMILY)[\w./-]+"
                  r"\.(?:cpp|hpp|h|inc|py|sh|md|cmake|toml|csv|inp|f90|jl|js)(?!\w)")
# What is in the past tense, what names made-up paths, and what names files where they are installed.
STEPS = 12  # lines that follow one load step in src/README.md
STEP = re.compile(r"^(?P<number>\d+)\. `(?P<file>[\w/.]+)`: `(?P<function>[\w:]+)` ", re.M)
UNREAD = ("CHANGELOG.md", "verify/style/test_sizes.py", "verify/packaging/components.sh")


# Beside names that begin with a dot.
TOP = {"CMakeLists.txt", "CMakePresets.json", "README.md", "LICENSE", "CHANGELOG.md", "CONTRIBUTING.md", "include", "src",
       "bindings", "verify", "examples"}


def strange(names):
    """Yields what else the top level has, of the paths that git tracks."""
    for top in sorted({name.split("/")[0] for name in names} - TOP):
        if not top.startswith("."):
            yield f"{top}: the top level has no such file or folder"


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


def defines(text, function):
    """True if a C++ file defines this function: its qualified name stands before the parameters and the body."""
    lines = text.splitlines()
    heads = (" ".join(lines[first - 1:first - 1 + length]).split("{")[0] for first, length in scanner.functions(text))
    return any(re.search(rf"(?<![\w:.>]){re.escape(function)}\(", head) for head in heads)


def misled(src):
    """Yields what is wrong with the lines of src/README.md that follow one load step, each with a file and a function."""
    steps = list(STEP.finditer((src / "README.md").read_text(encoding="utf-8")))
    if [int(step["number"]) for step in steps] != list(range(1, STEPS + 1)):
        yield f"{src.name}/README.md: the lines of a load step are not numbered 1 to {STEPS}"
    for step in steps:
        path = src / step["file"]
        if not (path.is_file() and defines(path.read_text(encoding="utf-8"), step["function"])):
            yield f"{src.name}/README.md: {step['file']} does not define {step['function']}"


def lost(root, names):
    """Yields paths that the files of these names, relative to root, name and that lead nowhere."""
    for name in names:
        try:
            text = (root / name).read_text(encoding="utf-8")
        except UnicodeDecodeError:
            continue
        for path in sorted(set(PATH.findall(text))):
            if not any((root / folder / path).exists() for folder in pathlib.Path(name).parents):
                yield f"{name}: {path} is not there"


def main():
    names = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=False).stdout.splitlines()
    wrong = [*strange(names), *problems(ROOT / "src"), *misled(ROOT / "src"),
             *lost(ROOT, [name for name in names if name not in UNREAD and (ROOT / name).is_file()])]
    for line in wrong:
        print(line, file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
