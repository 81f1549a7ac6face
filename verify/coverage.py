# SPDX-License-Identifier: BSD-3-Clause
"""Measures which lines and branches of src the quick tests of the library reach, and writes a table by folder.

    python3 verify/coverage.py [--list FOLDER]

Builds with the preset `coverage` (gcc, gcov), runs the quick tests of units and cases, and lets gcovr (Debian's package)
read what they have left. Branches that only an exception takes are not counted: gcc adds one to nearly every call.
--list prints the lines of a folder with a branch that no test takes, from the last run.
"""
import argparse
import collections
import json
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
BUILD = ROOT / "build" / "coverage"
FOUND = BUILD / "coverage.json"
TABLE = ROOT / "verify" / "COVERAGE.md"
SELECTED = ("--label-regex", "^quick$", "--tests-regex", "^(unit|case)/")
# The interface in C, and each room of the library that computes.
FOLDERS = ("base", "body", "capi", "evolution", "law", "linalg", "mesh", "reduction", "scene")


def programs():
    """Returns the programs that these tests run, which are targets of the build; no other one is needed."""
    listed = subprocess.run(["ctest", "--test-dir", BUILD, *SELECTED, "--show-only=json-v1"], check=True, capture_output=True).stdout
    return sorted(test["name"].replace("/", "_") for test in json.loads(listed)["tests"])


def measure():
    """Builds, runs the tests and leaves what gcovr has found in FOUND; returns false if a test fails."""
    subprocess.run(["cmake", "--preset", "coverage"], cwd=ROOT, check=True)
    subprocess.run(["cmake", "--build", "--preset", "coverage", "--target", "delam", *programs()], cwd=ROOT, check=True)
    for old in BUILD.rglob("*.gcda"):
        old.unlink()
    # Check starts each test in a process of its own, which leaves nothing where it is killed.
    tests = subprocess.run(["ctest", "--test-dir", BUILD, "-j2", *SELECTED],
                           env={**os.environ, "CK_FORK": "no", "CK_DEFAULT_TIMEOUT": "0"}, check=False)
    subprocess.run(["gcovr", "--root", ROOT, "--filter", str(ROOT / "src") + "/", "--exclude-throw-branches",
                    "--exclude-unreachable-branches", "--json", FOUND, BUILD], check=True)
    return tests.returncode == 0


def files():
    """Yields (path from src, lines of gcovr) of each file."""
    for file in json.loads(FOUND.read_text(encoding="utf-8"))["files"]:
        yield file["file"].removeprefix("src/"), [line for line in file["lines"] if not line["gcovr/noncode"]]


def rooms():
    """Returns {room: [lines, lines reached, branches, branches taken]}; a room is a folder or one in a large folder."""
    counts = collections.defaultdict(lambda: [0, 0, 0, 0])
    for path, lines in files():
        parts = path.split("/")[:-1]
        if not parts or parts[0] not in FOLDERS:
            continue
        for room in {parts[0], "/".join(parts[:2])}:
            count = counts[room]
            for line in lines:
                count[0] += 1
                count[1] += line["count"] > 0
                count[2] += len(line["branches"])
                count[3] += sum(branch["count"] > 0 for branch in line["branches"])
    return counts


def table():
    """Returns the table as Markdown."""
    commit = subprocess.run(["git", "describe", "--always", "--dirty"], cwd=ROOT, capture_output=True, text=True,
                            check=False).stdout.strip()
    out = ["# Coverage", "", f"Written by `python3 verify/coverage.py` at {commit}: what the quick tests `unit/` and "
           "`case/` reach in `src`.", "", "| folder | lines | reached | branches | taken |", "|---|---|---|---|---|"]
    for room, (lines, reached, branches, taken) in sorted(rooms().items()):
        out.append(f"| `{room}` | {lines} | {share(reached, lines)} | {branches} | {share(taken, branches)} |")
    return "\n".join(out) + "\n"


def share(part, whole):
    return f"{100 * part / whole:.1f} %" if whole else "-"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--list", metavar="FOLDER")
    folder = parser.parse_args().list
    if folder is not None:
        for path, lines in files():
            if path.startswith(folder.rstrip("/") + "/"):
                for line in lines:
                    left = sum(branch["count"] == 0 for branch in line["branches"])
                    if left or line["count"] == 0:
                        print(f"src/{path}:{line['line_number']}: {left} of {len(line['branches'])} branches"
                              + (", never reached" if line["count"] == 0 else ""))
        return 0
    passed = measure()
    TABLE.write_text(table(), encoding="utf-8")
    print(TABLE.read_text(encoding="utf-8"), end="")
    return 0 if passed else 1


if __name__ == "__main__":
    sys.exit(main())
