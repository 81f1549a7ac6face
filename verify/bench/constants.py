#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""What half and twice of the library's constants do: the measurement behind the comments that say so.

    constants.py FOLDER --list                              every constant that can be varied, FILE_NAME
    constants.py FOLDER [--factors 0.5,2] [--within 1e-5] [--require] [--targets unit_test_mortar,..] NAMES -- COMMAND
                                                            runs COMMAND with each constant whose FILE_NAME matches the
                                                            expression NAMES, times each factor

FOLDER holds a copy of the sources in which each `constexpr double`, each whole number in a table here, each row of
scene/limits.inc and base/restarts.inc (limits_NAME), and each number of the scripts of bindings/cli/study whose name has
capitals only is multiplied by a number of the environment, and its build; each call copies the files that have changed
since. COMMAND finds that library by DELAM_LIBRARY (Python) or LD_LIBRARY_PATH
(programs of the tests); unit tests are targets of that build, and programs in FOLDER/build/verify. A line for each run
says its exit status, how many lines of its output differ from those of the library as it is by more than --within of a
number, but for seconds, and by how much at most. Lines `cost WORDS: NUMBER` are no results: it says by which factors they
change.

With --require, the exit status is 1 if a line differs, or if no constant has such a name: a constant that decides is a
part of the method, and is called so where it stands.

    constants.py /tmp/constants 'least_motion|rigid_jumps' -- \\
        /usr/bin/python3 verify/cases/contact/random_scenes.py --scenes 250 --outcomes

Numbers of scripts are those of a command that runs in the copy:

    constants.py /tmp/constants '^(descent|profiles)_' --targets delam_cli --longest 900 -- \\
        /usr/bin/python3 /tmp/constants/sources/bindings/cli/test/test_fits.py outcomes

--table FILE writes a table of the differences and costs; CONSTANTS.md has that of all constants with analyses.py.
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
CONSTANT = re.compile(r"^( *)(inline )?(static )?constexpr (double|int|std::size_t|std::int64_t|std::ptrdiff_t) ([^;{\[]+);", re.M)
# The tables of numbers that steer (scene/limits.inc, base/restarts.inc), as members of structures.
TABLE = "#define DELAM_STEERING(type, name, value, reason) type name = value;"
VARIED_TABLE = ("#define DELAM_STEERING(type, name, value, reason) \\\n"
                "    type name = delam_scaled<type>(static_cast<double>(value) * delam_factor(\"limits_\" #name));")
# A number of a script, with what stands behind it.
SCRIPT_CONSTANT = re.compile(r"^([A-Z][A-Z_]*) = ((?:np\.log\()?[-\d.e]+\)?)(?= *(?:#|$))", re.M)
SCRIPTS = pathlib.Path("bindings/cli/study")
SCRIPT_FACTOR = """import os


def varied(name, value):
    return type(value)(value * float(os.environ.get("DELAM_FACTOR_" + name, "1")))
"""
ROW = re.compile(r"^DELAM_STEERING\([^,]+, (\w+), ([^,]+),", re.M)
NUMBER = re.compile(r"[-+]?\d+\.?\d*(?:e[-+]?\d+)?")
COST = re.compile(r"^cost (.*): (\S+)$")
# Constants that stand in constant expressions or in lambdas without captures.
FIXED = {"law/softening/law_kind.hpp", "law/admissible.cpp", "mesh/selection.cpp"}
# Whole numbers that steer; others are sizes of arrays, formats and limits of types. Half of an odd one is the larger part.
WHOLE = {"adhesion_after_most_growths", "adhesion_after_most_halvings", "body_reactions_dense_reactions",
         "box_tree_leaf_size", "candidate_energies_forgotten", "candidate_energies_largest_dense_zone",
         "contact_levels_coarsest", "converged_increment_most_turns", "coupled_damage_halvings",
         "coupled_damage_idle_limit", "coupled_damage_limit", "curved_displacement_most_steps",
         "dissection_few_vertices", "elimination_order_few_rows", "face_point_most_steps",
         "jump_variables_short_equation", "load_path_most_refused", "path_dissipation_mixity_halvings",
         "path_dissipation_parts", "search_most_contacts", "search_seeds",
         "step_control_smooth_levels", "row_table_most_rows", "stepper_most_starts", "sweep_fine", "sweep_fine_mixity",
         "sweep_small_zone", "sweep_turns", "turned_cell_most_polar_steps", "zone_energies_energy_contact_steps",
         "zone_energies_most_solved", "zone_energies_recheck_factor", "zone_energies_rounds_outside",
         "zone_energies_spare_rows"}
FACTOR = """#ifdef __cplusplus
#include <cmath>
#include <cstdlib>
#include <string>
inline double delam_factor(const char* name) {
    const char* factor = std::getenv((std::string("DELAM_FACTOR_") + name).c_str());
    return factor != nullptr ? std::atof(factor) : 1.0;
}
template <class T>
T delam_scaled(double value) {
    return static_cast<T>(static_cast<T>(0.5) != T(0) ? value : std::floor(value + 0.5));
}
#endif
"""

HEADING = """# Constants of the sources

Written by `constants.py FOLDER {command}`: what factors on each constant do to the analyses of that command, by the file
and the name of the constant (limits_: of scene/limits.inc and base/restarts.inc). Difference: the largest of the numbers
of a result, relative, or how many lines of results differ in words. Cost: counts of solves and iterations over those with
the constant itself. Where neither changes, no analysis came to the constant: it guards, or it is of another input.

| constant | value | {factors} |
|---|{rule}
"""


def varied(stem, text, names):
    """The text of a file in which constants have factors; adds their names and values."""
    def replaced(m):
        number = m.group(4)
        parts = [part.split("=", 1) for part in m.group(5).split(",")]
        if any(len(part) < 2 or "numeric_limits" in part[1] for part in parts):
            return m.group()
        if number != "double" and any(f"{stem}_{part[0].strip()}" not in WHOLE for part in parts):
            return m.group()
        made = []
        for name, value in ((p[0].strip(), p[1].strip()) for p in parts):
            names[f"{stem}_{name}"] = value
            scaled = f'({value}) * delam_factor("{stem}_{name}")'
            made.append(f"{name} = {scaled if number == 'double' else f'static_cast<{number}>(std::llround({scaled}))'}")
        kind = "static inline " if m.group(3) else m.group(2) or ""
        return f"{m.group(1)}{kind}const {number} {', '.join(made)};"
    return CONSTANT.sub(replaced, text.replace(TABLE, VARIED_TABLE))


def varied_script(stem, text, names):
    """The text of a script in which numbers have factors; adds their names and values."""
    def replaced(m):
        names[f"{stem}_{m.group(1)}"] = m.group(2)
        return f'{m.group(1)} = __import__("script_factor").varied("{stem}_{m.group(1)}", {m.group(2)})'
    return SCRIPT_CONSTANT.sub(replaced, text)


def copied(sources, names):
    """Copies the tracked files that differ, with factors in those of the library; adds the names and values of its constants."""
    tracked = subprocess.run(["git", "-C", ROOT, "ls-files", "-z"], check=True, capture_output=True).stdout
    wanted = {pathlib.Path(name) for name in tracked.decode().split("\0") if name and (ROOT / name).is_file()}
    for where in sorted(wanted):
        content, target = (ROOT / where).read_bytes(), sources / where
        in_library = where.parts[0] == "src" and where.parts[1] != "petsc" and where.suffix in (".cpp", ".hpp")
        if in_library and where.relative_to("src").as_posix() not in FIXED:
            content = varied(where.stem, content.decode(), names).encode()
        if where.suffix == ".py" and where.is_relative_to(SCRIPTS):
            content = varied_script(where.stem, content.decode(), names).encode()
        if where.as_posix() in ("src/scene/limits.inc", "src/base/restarts.inc"):
            names.update((f"limits_{name}", value) for name, value in ROW.findall(content.decode()))
        if not target.exists() or target.read_bytes() != content:
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_bytes(content)
            target.chmod((ROOT / where).stat().st_mode)
    for path in (path for path in sources.rglob("*") if path.is_file() and path.relative_to(sources) not in wanted):
        path.unlink()


def make(folder, targets):
    """Copies and builds the library; its constants and their values."""
    names = {}
    copied(folder / "sources", names)
    for name, text in (("factor.hpp", FACTOR), ("script_factor.py", SCRIPT_FACTOR)):
        factor = folder / name
        if not factor.exists() or factor.read_text(encoding="utf-8") != text:
            factor.write_text(text, encoding="utf-8")
    if not (folder / "build/build.ninja").exists():
        subprocess.run(["cmake", "-S", folder / "sources", "-B", folder / "build", "--preset", "release",
                        "-DDELAM_BUILD_TESTS=ON", f"-DCMAKE_CXX_FLAGS=-include {folder}/factor.hpp"], check=True)
    subprocess.run(["cmake", "--build", folder / "build", "--target", "delam", *targets], check=True)
    return names


def run(folder, command, factors, longest):
    """Exit status and lines of a command with the library in the folder; none after so many seconds."""
    library = folder / "build" / "lib"
    environment = {**os.environ, "DELAM_LIBRARY": str(library / "libdelam.so"), "LD_LIBRARY_PATH": str(library),
                   "PYTHONPATH": f"{ROOT / 'bindings' / 'python' / 'src'}:{folder}", "OPENBLAS_NUM_THREADS": "1",
                   "DELAM": os.environ.get("DELAM", str(folder / "build" / "bin" / "delam")), "PYTHONDONTWRITEBYTECODE": "1",
                   **{f"DELAM_FACTOR_{name}": str(factor) for name, factor in factors.items()}}
    try:
        made = subprocess.run(command, env=environment, capture_output=True, text=True, check=False, timeout=longest)
    except subprocess.TimeoutExpired:
        return "none", []
    return made.returncode, (made.stdout + made.stderr).splitlines()


def parted(lines):
    """The lines that are results, and the costs by their words."""
    costs = {m.group(1): float(m.group(2)) for m in map(COST.match, lines) if m}
    return [line for line in lines if not COST.match(line)], costs


def difference(one, other):
    """The largest relative difference of the numbers of two lines; infinite if their words differ."""
    if one is None or other is None:
        return math.inf
    bare = [re.sub(r"\d+\.?\d* s\b|/tmp/\S+", "", line) for line in (one, other)]  # times, and names of temporary files
    if NUMBER.sub("#", bare[0]) != NUMBER.sub("#", bare[1]):
        return math.inf
    pairs = zip(*(map(float, NUMBER.findall(line)) for line in bare))
    return max((abs(a - b) / max(abs(a), abs(b)) for a, b in pairs if abs(a - b) > 1e-12), default=0.0)


def write_table(path, own, factors, found):
    """Writes the rows that are known so far; own: the words of the command line."""
    rows = (f"| `{name}` | {value} | {' | '.join(cell)} |\n" for name, value, cell in found)
    heading = HEADING.format(command=" ".join(["NAMES", *own[own.index("--"):]]), rule="---|" * (1 + len(factors)),
                             factors=" | ".join(f"times {one}" for one in factors))
    path.write_text(heading + "".join(rows), encoding="utf-8")


def main():
    own = sys.argv[1:]
    command = own[own.index("--") + 1:] if "--" in own else []
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("names", nargs="?", default="")
    parser.add_argument("--factors", default="0.5,2")
    parser.add_argument("--targets", default="")
    parser.add_argument("--within", type=float, default=1e-5)
    parser.add_argument("--longest", type=float, default=120.0,
                        help="s for a run: half of a number that grows by itself may never end (default: 120)")
    parser.add_argument("--require", action="store_true")
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--table", type=pathlib.Path)
    arguments = parser.parse_args(own[:own.index("--")] if command else own)
    folder = arguments.folder.resolve()
    names = make(folder, arguments.targets.split(",") if arguments.targets else [])
    if arguments.list or not command:
        print("\n".join(names))
        return 0
    status, lines = run(folder, command, {}, arguments.longest)
    lines, costs = parted(lines)
    print(f"as it is: exit status {status}, {len(lines)} lines", flush=True)
    runs, wrong, cells = 0, 0 if lines else 1, {}
    for name, factor in itertools.product(names, arguments.factors.split(",")):
        if not re.search(arguments.names, name):
            continue
        now, found = run(folder, command, {name: factor}, arguments.longest)
        found, other = parted(found)
        ratios = [other[what] / cost for what, cost in costs.items() if what in other and cost]
        if now == status and len(found) == len(lines):
            apart = [difference(one, other) for one, other in zip(lines, found)]
        else:  # lines that only one of them has
            apart = [math.inf] * max(1, len(set(lines) ^ set(found)))
        count, words = sum(by > arguments.within for by in apart), sum(math.isinf(by) for by in apart)
        largest = max((by for by in apart if math.isfinite(by)), default=0.0)
        print(f"{name} times {factor}: exit status {now}, {count} lines differ, {words} of them in words, numbers by "
              f"{largest:.2g} at most" + (f"; costs times {min(ratios):.2f} to {max(ratios):.2f}" if ratios else ""), flush=True)
        told = f"{largest:.0e}" + (f", {min(ratios):.2f} to {max(ratios):.2f}" if ratios else "")
        cells.setdefault(name, []).append("no end" if now == "none" else "an error" if now != status else
                                          f"{words} lines" if words else told)
        runs, wrong = runs + 1, wrong + (now != status or count > 0)
        if arguments.table:
            write_table(arguments.table, own, arguments.factors.split(","),
                        [(one, names[one], cell) for one, cell in cells.items()])
    print(f"{runs} runs, {wrong} of them with another result")
    return 1 if arguments.require and (wrong > 0 or runs == 0) else 0


if __name__ == "__main__":
    sys.exit(main())
