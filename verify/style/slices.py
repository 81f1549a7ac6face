# SPDX-License-Identifier: BSD-3-Clause
"""Checks that each test of the long tier is in one slice of verify/slices.sh, and that each slice runs something.

    python3 verify/style/slices.py BUILD
"""
import json
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
TABLE = """
source verify/stages.sh
source verify/slices.sh
for ((k = 1; k <= slices; ++k)); do
    printf '%s\\t%s\\t%s\\n' "$k" "${slice_tests[$k]:-}" "${slice_stages[$k]:-}"
done
declare -F | sed 's/declare -f/\\tfunction\\t/'
"""


def table():
    """(regular expression of tests, stages) by slice, and the names of all functions."""
    said = subprocess.run(["bash", "-euc", TABLE], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    rows = [line.split("\t") for line in said.splitlines()]
    functions = {row[2].strip() for row in rows if row[1] == "function"}
    slices = {int(row[0]): (row[1], [stage.split() for stage in row[2].split(";") if stage.split()])
              for row in rows if row[1] != "function"}
    return slices, functions


def long_tests(build):
    said = subprocess.run(["ctest", "--test-dir", build, "--label-regex", "^long$", "--show-only=json-v1"],
                          capture_output=True, text=True, check=True).stdout
    # Fixtures come along with the tests that need them.
    return [test["name"] for test in json.loads(said)["tests"]
            if any("long" in p["value"] for p in test["properties"] if p["name"] == "LABELS")]


def problems(slices, functions, tests):
    for name in tests:
        of = [k for k, (pattern, _) in slices.items() if pattern and re.search(pattern, name)]
        if len(of) != 1:
            yield f"{name} is in {f'the slices {of}' if of else 'no slice'}"
    for k, (pattern, stages) in slices.items():
        if pattern and not any(re.search(pattern, name) for name in tests):
            yield f"slice {k}: no test of the long tier is called {pattern}"
        if not pattern and not stages:
            yield f"slice {k} runs nothing"
        yield from (f"slice {k}: nothing is called {stage[0]}" for stage in stages if stage[0] not in functions)


def main():
    slices, functions = table()
    tests = long_tests(sys.argv[1])
    wrong = list(problems(slices, functions, tests))
    print(f"{len(tests)} long tests in {len(slices)} slices")
    for line in wrong:
        print(line, file=sys.stderr)
    return 1 if wrong or not tests else 0


if __name__ == "__main__":
    sys.exit(main())
