# SPDX-License-Identifier: BSD-3-Clause
"""Prints how many lines of each kind are tracked: code and documents that people write, data, generated files.

    python3 verify/style/lines.py [--list KIND]     the files of a kind, longest first
"""

import argparse
import collections
import fnmatch
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Files that nobody writes by hand: pattern (* also of folders), kind, reason. The first that fits counts.
NOT_WRITTEN = (
    ("bindings/fortran/src/delam_raw.f90", "generated", "make_raw.py writes it from the header"),
    ("bindings/julia/src/raw.jl", "generated", "generate_raw.py writes it from the header"),
    ("bindings/python/src/delam/_base/raw.py", "generated", "generate_raw.py writes it from the header"),
    ("bindings/cli/view/view.html", "generated", "bundle.sh bundles it; a build needs no npm"),
    ("examples/dcb-abaqus/dcb-abaqus.inp", "generated", "make_deck.py writes it, a deck as Abaqus has it"),
    ("examples/host-abaqus/delam_uel.inp", "generated", "`host_abaqus deck` writes it"),
    ("verify/report/headline.json", "generated", "figures of the last report that documents quote"),
    ("verify/report/pictures/*", "generated", "readme.py draws what documents show"),
    ("verify/abi/symbols*.txt", "generated", "update.sh writes the exported functions"),
    ("*/package-lock.json", "data", "npm pins packages by hash"),
    ("verify/abi/baseline/*", "data", "the released interface, with which abi/ compares"),
    ("verify/report/past/*", "data", "numbers of accepted reports"),
    ("verify/kept/????????/*", "data", "results, states and hosts of an earlier commit, byte for byte"),
    ("verify/cases/golden/*", "data", "saved states of earlier versions, and what they hold"),
    ("verify/fuzz/corpus/*", "data", "inputs that reach new branches"),
    ("verify/fuzz/regressions/*", "data", "inputs that once failed"),
    ("examples/*.png", "data", "the picture of the README"),
    ("*.csv", "data", "reference values"),
)
ENDINGS = {
    "C++": ".cpp .hpp .inc", "C": ".c .h", "Python": ".py .ipynb", "Fortran": ".f90", "Julia": ".jl",
    "JavaScript, pages": ".js .mjs .html .css .j2", "shell": ".sh run", "build": "CMakeLists.txt CMakePresets.json .cmake .in",
    "scenes, settings": ".toml .inp .geo .yml .json .xml Doxyfile", "documents": ".md LICENSE .txt",
}
KIND = {ending: kind for kind, endings in ENDINGS.items() for ending in endings.split()}


def kind_of(path):
    """Returns the kind of a tracked file; what no table knows is of the kind `other`."""
    for pattern, kind, _ in NOT_WRITTEN:
        if fnmatch.fnmatchcase(path, pattern):
            return kind
    name = pathlib.PurePath(path)
    return KIND.get(name.name) or KIND.get(name.suffix, "other")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--list", metavar="KIND", help="the files of this kind, longest first")
    wanted = parser.parse_args().list
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    files = collections.defaultdict(list)
    for path in filter(None, listed.split("\0")):
        if (ROOT / path).is_file():
            files[kind_of(path)].append(((ROOT / path).read_bytes().count(b"\n"), path))
    if wanted:
        for lines, path in sorted(files[wanted], reverse=True):
            print(f"{lines:7d} {path}")
        return
    for pattern, _, _ in NOT_WRITTEN:
        if not any(fnmatch.fnmatchcase(path, pattern) for found in files.values() for _, path in found):
            print(f"NOT_WRITTEN: no file is {pattern}")
    parts = sorted(files.items(), key=lambda part: (part[0] in ("data", "generated"), -sum(n for n, _ in part[1])))
    parts.append(("written by people", [file for kind, found in parts if kind not in ("data", "generated") for file in found]))
    parts.append(("all", [file for found in files.values() for file in found]))
    for kind, found in parts:
        print(f"{sum(n for n, _ in found):7d} lines {len(found):5d} files  {kind}")


if __name__ == "__main__":
    main()
