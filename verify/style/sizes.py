# SPDX-License-Identifier: BSD-3-Clause
"""Checks sizes: lines of code at most 120 columns wide; in src and verify, functions of at most 80 lines and files of at
most 500; READMEs of folders of at most 40 lines, as wide as code outside tables and blocks. In src and bindings/cli/src, a
class has at most 25 public methods, and its members are defined in its header and one .cpp.

    python3 verify/style/sizes.py [--list | --classes]

Constructors, destructors, deleted functions and what overrides a base's method are not counted, overloads one by one.

The functions of verify that are longer are in a table here with the number of lines that they have. The numbers only
sink: a function that has become shorter is refused until its number is, too.
"""

import argparse
import ast
import pathlib
import subprocess
import sys

import classes
import scanner

ROOT = pathlib.Path(__file__).resolve().parents[2]
WIDTH, FUNCTION, FILE, README, METHODS = 120, 80, 500, 40, 25
PYTHON = ("examples/", "verify/petsc/", "bindings/python/", "bindings/site/")  # the Python files whose width is checked
CODE = {".c", ".h", ".cpp", ".hpp", ".cmake", ".f90", ".jl"}
FOLDERS = ("include", "src", "bindings", "verify", "examples")
CLASSES = ("src/", "bindings/cli/src/")  # where classes are ruled
# Files of verify whose length is checked, and those of them in which functions are found.
LONG, SCANNED = (".c", ".h", ".cpp", ".hpp", ".py", ".sh"), (".c", ".h", ".cpp", ".hpp", ".py")
RELEASED = ("verify/abi/baseline/", "verify/kept/8aed94c5/")  # as they were
# Lines of the functions of verify that are longer, by file.
LONGER = {
    "verify/abi/contract_lint.py": [111],
    "verify/abi/experimental_calls.c": [140],
    "verify/abi/host.c": [86],
    "verify/bench/critical.cpp": [89],
    "verify/bench/energetic_series.cpp": [84],
    "verify/bench/precision.cpp": [148],
    "verify/bench/series.cpp": [117],
    "verify/bench/size_table.cpp": [90],
    "verify/fuzz/petsc_calls.cpp": [100],
    "verify/harness/sets.cpp": [120],
    "verify/petsc/test_engine.cpp": [94],
    "verify/reference/acceptance.cpp": [109],
    "verify/reference/direct.cpp": [127],
    "verify/report/cases/b_energy.py": [125, 110],
    "verify/report/cases/b_energy_convergence.py": [123, 109],
    "verify/report/cases/b_energy_jumps.py": [115, 108],
    "verify/report/cases/c_speed.py": [108, 96],
    "verify/report/cases/d_stability.py": [106],
    "verify/report/cases/g_growth.py": [94],
}


def sources():
    """Our own files below the folders, tracked or new; in a tarball all of them. Baselines are as they were released."""
    command = ["git", "ls-files", "--cached", "--others", "--exclude-standard", "--", *FOLDERS]
    listed = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    if listed.returncode == 0 and listed.stdout:
        paths = [ROOT / line for line in listed.stdout.splitlines()]
    else:
        paths = [p for folder in FOLDERS for p in (ROOT / folder).rglob("*")]
    names = {p: p.relative_to(ROOT).as_posix() for p in paths}
    kept = (p for p, name in names.items() if p.suffix in CODE or p.name in ("CMakeLists.txt", "README.md") or
            (name.startswith("verify/") and name.endswith(LONG)) or (p.suffix == ".py" and name.startswith(PYTHON)))
    return sorted(p for p in kept if p.is_file() and not names[p].startswith(RELEASED[0]))


def functions(name, text):
    """(first line, number of lines) of the functions of a file of src or verify."""
    if name.endswith(".py"):
        return [(node.lineno, node.end_lineno - node.lineno + 1) for node in ast.walk(ast.parse(text))
                if isinstance(node, ast.FunctionDef)]
    ruled = name.startswith("src/") and name.endswith((".cpp", ".hpp"))
    return list(scanner.functions(text)) if ruled or (name.startswith("verify/") and name.endswith(SCANNED)) else []


def problems(name, text, longer=None):
    """Lists what is too long in a file of this name, a line each. longer: the table of functions that are."""
    lines = text.splitlines()
    page = name.endswith("README.md")
    if page and len(lines) > README:
        yield f"{name}: {len(lines)} lines, at most {README} in a README"
    for n, line in enumerate(lines if not name.endswith((".py", ".sh")) or name.startswith(PYTHON) else (), 1):
        if len(line) > WIDTH and not (page and line.startswith(("|", "    "))):
            yield f"{name}:{n}: {len(line)} columns, at most {WIDTH}"
    in_verify = name.startswith("verify/") and not name.startswith(RELEASED)
    if name.endswith(LONG if in_verify else (".cpp", ".hpp")) and (in_verify or name.startswith("src/")):
        if len(lines) > FILE:
            yield f"{name}: {len(lines)} lines, at most {FILE} in src and verify"
        known = list((LONGER if longer is None else longer).get(name, ()))
        for first, length in sorted(functions(name, text), key=lambda f: -f[1]):
            allowed = known.pop(0) if known else FUNCTION
            if length > allowed:
                yield f"{name}:{first}: a function of {length} lines, at most {allowed} here"
            elif allowed > max(length, FUNCTION):
                yield f"{name}:{first}: a function of {length} lines, {allowed} in the table of sizes.py: lower it"


def classes_of(texts):
    """The classes of the folders in which they are ruled."""
    return classes.find({name: text for name, text in texts.items()
                         if name.startswith(CLASSES) and name.endswith((".cpp", ".hpp", ".h"))})


def wide_classes(found):
    """Lists the classes with too many public methods, and those with members in several files, a line each."""
    for c in found:
        if len(c.methods) > METHODS:
            yield f"{c.file}:{c.line}: {c.key} has {len(c.methods)} public methods, at most {METHODS}"
        if len(c.elsewhere) > 1:
            yield f"{c.file}:{c.line}: {c.key} has members in {', '.join(sorted(c.elsewhere))}: at most one .cpp"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--list", action="store_true", help="print the length of every function of src and verify, longest first")
    parser.add_argument("--classes", action="store_true", help="print the number of public methods of every class, most first")
    arguments = parser.parse_args()
    texts = {p.relative_to(ROOT).as_posix(): p.read_text(encoding="utf-8") for p in sources()}
    found = {name: functions(name, text) for name, text in texts.items()
             if name.startswith("src/") or (name.startswith("verify/") and not name.startswith(RELEASED))}
    if arguments.list:
        for length, name, first in sorted(((n, name, at) for name, list_ in found.items() for at, n in list_), reverse=True):
            print(f"{length:4d} {name}:{first}")
    ruled = classes_of(texts)
    if arguments.classes:
        for c in sorted(ruled, key=lambda c: -len(c.methods)):
            print(f"{len(c.methods):4d} {c.key} {c.file}:{c.line}")
    wrong = [line for name, text in texts.items() for line in problems(name, text)]
    wrong += wide_classes(ruled)
    wrong += [f"{name}: in a table of sizes.py, but not there" for name in sorted(set(LONGER) - set(texts))]
    print(f"{len(texts)} files; {sum(map(len, found.values()))} functions in src and verify; {len(ruled)} classes")
    for line in wrong:
        print(line, file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
