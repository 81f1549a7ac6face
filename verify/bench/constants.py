#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""What half and twice of the library's constants do: the measurement behind the comments that say so.

    constants.py FOLDER --list                              every constant that can be varied, FILE_NAME
    constants.py FOLDER [--factors 0.5,2] [--within 1e-5] [--require] [--targets unit_test_mortar,..] NAMES -- COMMAND
                                                            runs COMMAND with each constant whose FILE_NAME matches the
                                                            expression NAMES, times each factor

FOLDER holds a copy of the sources in which each `constexpr double` outside functions is multiplied by a number of the
environment, and its build; each call copies the files that have changed since. COMMAND finds that library by
DELAM_LIBRARY (Python) or LD_LIBRARY_PATH (programs of the tests); unit tests are targets of that build, and programs in
FOLDER/build/verify. A line for each run says its exit status, and how many
lines of its output differ from those of the library as it is by more than --within of a number, seconds aside, and by
how much at most.

With --require, the exit status is 1 if a line differs, or if no constant has such a name: a constant that decides is a
part of the method, and is called so where it stands.

    constants.py /tmp/constants 'least_motion|rigid_jumps' -- \\
        /usr/bin/python3 verify/cases/contact/random_scenes.py --scenes 250 --outcomes
"""
import argparse
import itertools
import math
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
CONSTANT = re.compile(r"^( *)(inline )?(static )?constexpr double ([^;{\[]+);", re.M)
NUMBER = re.compile(r"[-+]?\d+\.?\d*(?:e[-+]?\d+)?")
# Constants that stand in constant expressions or in lambdas without captures.
FIXED = {"law/softening/law_kind.hpp", "law/admissible.cpp", "mesh/selection.cpp"}
FACTOR = """#ifdef __cplusplus
#include <cstdlib>
#include <string>
inline double delam_factor(const char* name) {
    const char* factor = std::getenv((std::string("DELAM_FACTOR_") + name).c_str());
    return factor != nullptr ? std::atof(factor) : 1.0;
}
#endif
"""


def varied(stem, text, names):
    """The text of a file in which constants have factors; adds their names."""
    def replaced(m):
        parts = [part.split("=", 1) for part in m.group(4).split(",")]
        if any(len(part) < 2 or "numeric_limits" in part[1] for part in parts):
            return m.group()
        made = []
        for name, value in ((p[0].strip(), p[1].strip()) for p in parts):
            names.append(f"{stem}_{name}")
            made.append(f'{name} = ({value}) * delam_factor("{stem}_{name}")')
        kind = "static inline " if m.group(3) else m.group(2) or ""
        return f"{m.group(1)}{kind}const double {', '.join(made)};"
    return CONSTANT.sub(replaced, text)


def copied(sources, names):
    """Copies the tracked files that differ, with factors in those of the library; adds the names of its constants."""
    tracked = subprocess.run(["git", "-C", ROOT, "ls-files", "-z"], check=True, capture_output=True).stdout
    wanted = {pathlib.Path(name) for name in tracked.decode().split("\0") if name and (ROOT / name).is_file()}
    for where in sorted(wanted):
        content, target = (ROOT / where).read_bytes(), sources / where
        in_library = where.parts[0] == "src" and where.parts[1] != "petsc" and where.suffix in (".cpp", ".hpp")
        if in_library and where.relative_to("src").as_posix() not in FIXED:
            content = varied(where.stem, content.decode(), names).encode()
        if not target.exists() or target.read_bytes() != content:
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_bytes(content)
            target.chmod((ROOT / where).stat().st_mode)
    for path in (path for path in sources.rglob("*") if path.is_file() and path.relative_to(sources) not in wanted):
        path.unlink()


def make(folder, targets):
    """Copies and builds the library; the names of its constants."""
    names = []
    copied(folder / "sources", names)
    if not (folder / "build/build.ninja").exists():
        (folder / "factor.hpp").write_text(FACTOR, encoding="utf-8")
        subprocess.run(["cmake", "-S", folder / "sources", "-B", folder / "build", "--preset", "release",
                        "-DDELAM_BUILD_TESTS=ON", f"-DCMAKE_CXX_FLAGS=-include {folder}/factor.hpp"], check=True)
    subprocess.run(["cmake", "--build", folder / "build", "--target", "delam", *targets], check=True)
    return names


def run(folder, command, factors):
    """Exit status and lines of a command with the library in the folder."""
    library = folder / "build" / "lib"
    environment = {**os.environ, "DELAM_LIBRARY": str(library / "libdelam.so"), "LD_LIBRARY_PATH": str(library),
                   "PYTHONPATH": str(ROOT / "bindings" / "python" / "src"), "OPENBLAS_NUM_THREADS": "1",
                   **{f"DELAM_FACTOR_{name}": str(factor) for name, factor in factors.items()}}
    made = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    return made.returncode, (made.stdout + made.stderr).splitlines()


def difference(one, other):
    """The largest relative difference of the numbers of two lines; infinite if their words differ."""
    if one is None or other is None:
        return math.inf
    bare = [re.sub(r"\d+\.?\d* s\b", "", line) for line in (one, other)]
    if NUMBER.sub("#", bare[0]) != NUMBER.sub("#", bare[1]):
        return math.inf
    pairs = zip(*(map(float, NUMBER.findall(line)) for line in bare))
    return max((abs(a - b) / max(abs(a), abs(b)) for a, b in pairs if abs(a - b) > 1e-12), default=0.0)


def main():
    own = sys.argv[1:]
    command = own[own.index("--") + 1:] if "--" in own else []
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("names", nargs="?", default="")
    parser.add_argument("--factors", default="0.5,2")
    parser.add_argument("--targets", default="")
    parser.add_argument("--within", type=float, default=1e-5)
    parser.add_argument("--require", action="store_true")
    parser.add_argument("--list", action="store_true")
    arguments = parser.parse_args(own[:own.index("--")] if command else own)
    folder = arguments.folder.resolve()
    names = make(folder, arguments.targets.split(",") if arguments.targets else [])
    if arguments.list or not command:
        print("\n".join(names))
        return 0
    status, lines = run(folder, command, {})
    print(f"as it is: exit status {status}, {len(lines)} lines", flush=True)
    runs, wrong = 0, 0 if lines else 1
    for name, factor in itertools.product(names, arguments.factors.split(",")):
        if not re.search(arguments.names, name):
            continue
        now, found = run(folder, command, {name: factor})
        apart = [difference(one, other) for one, other in itertools.zip_longest(lines, found)]
        count, words = sum(by > arguments.within for by in apart), sum(math.isinf(by) for by in apart)
        largest = max((by for by in apart if math.isfinite(by)), default=0.0)
        print(f"{name} times {factor}: exit status {now}, {count} lines differ, {words} of them in words, numbers by "
              f"{largest:.2g} at most", flush=True)
        runs, wrong = runs + 1, wrong + (now != status or count > 0)
    print(f"{runs} runs, {wrong} of them with another result")
    return 1 if arguments.require and (wrong > 0 or runs == 0) else 0


if __name__ == "__main__":
    sys.exit(main())
