#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""gate.py CHECK OPTIONS: does the library keep what its header promises? Each check prints what is wrong by name and
exits with 1.

symbols    exported functions = declared ones = symbols.txt; SONAME, version nodes, hidden visibility; which functions
           of CHOLMOD are used
static     global names of the static library = symbols.txt and the experimental ones; no section groups
baseline   every declaration and constant of the baseline's header stands in today's, unchanged
abidiff    the library's own debug information against the baseline (libabigail)
abixml     no check: what a new baseline would be

--base: HEADER is that of a library on top of libdelam, whose functions, nodes and SONAME have the header's name too:
petsc.h, delam_petsc_, DELAM_PETSC_1, libdelam-petsc.so.1.
"""
import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import header as headers  # noqa: E402

HERE = os.path.dirname(os.path.abspath(__file__))
EXPERIMENTAL = "delam_experimental_"
SKIPPED = 77
# Core, Check, Cholesky, Partition and CAMD are under the LGPL; the other modules are not.
CHOLMOD = {"cholmod_l_" + name for name in
           ("start", "finish", "camd", "analyze_ordering", "analyze_p", "factorize", "solve2", "free_factor", "free_dense", "ensure_dense",
            "realloc", "free", "change_factor")}


def output(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True, env={**os.environ, "LC_ALL": "C"}).stdout


def read_list(path):
    """name -> version that brought it."""
    found = {}
    with open(path, encoding="utf-8") as file:
        for number, line in enumerate(file, 1):
            words = line.split("#")[0].split()
            if not words:
                continue
            if len(words) != 2 or not re.fullmatch(r"\d+\.\d+", words[1]):
                raise SystemExit(f"{path}:{number}: expected a name and a version such as 0.1, found '{line.strip()}'")
            found[words[0]] = words[1]
    return found


def exported(library):
    """name -> version node of what the dynamic symbol table defines, nodes themselves left out."""
    found = {}
    for line in output("nm", "-D", "--defined-only", library).splitlines():
        kind, symbol = line.split()[-2:]
        name, _, node = symbol.partition("@")
        if kind != "A":
            found[name] = node.lstrip("@")
    return found


def read_header(path, base):
    """Reads delam.h or, with `base`, which is delam.h, the header of a library on top."""
    return headers.read(path, headers.read(base), promised=True) if base else headers.read(path)


def check_symbols(options):
    wrong = []
    header = read_header(options.header, options.base)
    part = os.path.basename(options.header)[:-2] if options.base else ""
    experimental = {}
    if options.experimental and os.path.exists(options.experimental):
        experimental = headers.read(options.experimental, header).functions
    declared = {**header.functions, **experimental}
    listed = read_list(options.list)
    found = exported(options.library)
    for name in sorted(set(declared) - set(found)):
        wrong.append(f"{name}: declared, but the library does not export it")
    for name in sorted(set(found) - set(declared)):
        wrong.append(f"{name}: exported, but no public header declares it")
    for name in sorted(set(header.functions) - set(listed)):
        wrong.append(f"{name}: not in {options.list}; list it with its version (verify/abi/update.sh)")
    for name in sorted(set(listed) - set(header.functions)):
        wrong.append(f"{name}: since {listed[name]} in {options.list}, but {options.header} does not declare it any "
                     "more")
    for name in sorted(experimental):
        if not name.startswith(EXPERIMENTAL):
            wrong.append(f"{name}: names of the experimental header start with {EXPERIMENTAL}")
    for name in sorted(header.functions):
        if name.startswith(EXPERIMENTAL):
            wrong.append(f"{name}: an experimental name in the promised header")

    for name in sorted(header.functions):
        if part and not name.startswith(f"delam_{part}_"):
            wrong.append(f"{name}: names of {part}.h start with delam_{part}_")

    abi = (headers.read(options.base) if options.base else header).constants.get("DELAM_ABI", "")
    for name, node in sorted(found.items()):
        expected = f"DELAM_{part.upper()}_{abi}" if part else f"DELAM_{abi}"
        if name.startswith(EXPERIMENTAL):
            expected = "DELAM_EXPERIMENTAL"
        if node != expected:
            wrong.append(f"{name}: version node '{node}', expected {expected}")
    soname = re.findall(r"\(SONAME\).*\[(.*)\]", output("readelf", "-d", options.library))
    wanted = f"libdelam-{part}.so.{abi}" if part else f"libdelam.so.{abi}"
    if soname != [wanted]:
        wrong.append(f"SONAME {', '.join(soname) or 'is missing'}, but DELAM_ABI {abi} of the header asks for {wanted}")

    if options.archive:
        visible = set()
        for line in output("readelf", "-Ws", *options.archive).splitlines():
            words = line.split()
            if len(words) == 8 and words[4] in ("GLOBAL", "WEAK") and words[5] == "DEFAULT" and words[6] != "UND":
                if re.match(r"_ZN?K?5delam|_ZT[VIS]N5delam", words[7]):
                    visible.add(words[7])
        for name in sorted(visible)[:5]:
            wrong.append(f"{name}: visible outside its file; compile with -fvisibility=hidden")
    if options.cholmod:
        undefined = output("nm", "-D", "--undefined-only", options.library).splitlines()
        needed = {line.split()[-1].split("@")[0] for line in undefined}
        for name in sorted(n for n in needed if n.startswith("cholmod_") and n not in CHOLMOD):
            wrong.append(f"{name}: a function of CHOLMOD that is not known to be in the modules under the LGPL")
    if not wrong:
        print(f"{len(found)} functions, {len(experimental)} of them experimental, {', '.join(soname)}")
    return wrong


def check_static(options):
    wrong = []
    expected = set(read_list(options.list))
    if options.experimental and os.path.exists(options.experimental):
        expected |= set(headers.read(options.experimental, headers.read(options.header)).functions)
    found = set()
    archive = options.archive[0]
    for line in output("nm", "--extern-only", "--defined-only", archive).splitlines():
        words = line.split()
        if len(words) == 3:
            found.add(words[2])
    for name in sorted(expected - found):
        wrong.append(f"{name}: in {options.list} or experimental.h, but not global in {archive}")
    for name in sorted(found - expected):
        wrong.append(f"{name}: global in {archive}, but neither in {options.list} nor in experimental.h")
    groups = [line for line in output("readelf", "--section-groups", "--wide", archive).splitlines()
              if "group section" in line]
    if groups:
        wrong.append(f"{archive}: {len(groups)} section groups, which a linker exchanges for the host's of the "
                     f"same name: {groups[0].strip()}")
    if not wrong:
        print(f"{len(found)} global names, no section groups")
    return wrong


def check_baseline(options):
    wrong = []
    old_base = os.path.join(os.path.dirname(options.baseline_header), "delam.h") if options.base else None
    old = read_header(options.baseline_header, old_base)
    new = read_header(options.header, options.base)
    for name, function in {**old.functions, **old.callbacks}.items():
        today = new.functions.get(name) or new.callbacks.get(name)
        if today is None:
            wrong.append(f"{name}: in the baseline, gone from the header")
        elif today.signature() != function.signature():
            wrong.append(f"{name}: '{today.signature()}', in the baseline '{function.signature()}'")
    for name, value in old.constants.items():
        if new.constants.get(name) != value:
            wrong.append(f"{name}: {new.constants.get(name, 'gone')}, in the baseline {value}")
    for name in old.handles:
        if name not in new.handles:
            wrong.append(f"{name}: a handle of the baseline, gone from the header")
    if options.list:
        for name in sorted(set(read_list(options.list)) - set(old.functions)):
            wrong.append(f"{name}: listed, but not in the baseline: run verify/abi/update.sh")
    if not wrong:
        print(f"{len(old.functions)} functions, {len(old.callbacks)} callbacks, {len(old.constants)} constants as in "
              "the baseline")
    return wrong


def abixml(library, header):
    """The exported functions of a library and the types of its public header, without places in the sources: those
    would change with every edit and say nothing of the interface."""
    with tempfile.TemporaryDirectory() as folder:
        outside = os.path.join(folder, "outside")
        with open(outside, "w", encoding="utf-8") as file:
            file.write(f"[suppress_function]\nsymbol_name_regexp = ^{EXPERIMENTAL}\ndrop = yes\n")
        text = output("abidw", "--header-file", header, "--drop-private-types", "--exported-interfaces-only",
                      "--no-elf-needed", "--no-corpus-path", "--no-comp-dir-path", "--no-architecture",
                      "--suppressions", outside, library)
    return re.sub(r" path='[^']*/src/", " path='src/", re.sub(r" (filepath|line|column)='[^']*'", "", text))


def check_abidiff(options):
    if shutil.which("abidiff") is None or shutil.which("abidw") is None:
        print("skipped: abidiff is not there (Debian: abigail-tools)")
        sys.exit(SKIPPED)
    if ".debug_info" not in output("readelf", "-SW", options.library):
        return [f"{options.library}: no debug information, abidiff would compare names alone"]
    if options.base and " ompi_" not in output("nm", "-D", "--undefined-only", options.library):
        print("skipped: the baseline has the types of Open MPI, the library those of another MPI")
        sys.exit(SKIPPED)
    with tempfile.TemporaryDirectory() as folder:
        # Both sides through abidw: given headers and a library, abidiff 2.2 takes a changed parameter of a callback for
        # private.
        today = os.path.join(folder, "today.abi")
        with open(today, "w", encoding="utf-8") as file:
            file.write(abixml(options.library, options.header))
        run = subprocess.run(["abidiff", "--no-added-syms", options.baseline, today], capture_output=True, text=True,
                             check=False)
    if run.returncode != 0:
        return [run.stdout + run.stderr, f"abidiff ended with {run.returncode}, must be 0"]
    print("abidiff: no change")
    return []


def check_abixml(options):
    sys.stdout.write(abixml(options.library, options.header))
    return []


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("check", choices=("symbols", "static", "baseline", "abidiff", "abixml"))
    parser.add_argument("--library")
    parser.add_argument("--archive", nargs="+", help="static archive, or the objects themselves: of the objects that "
                        "the library is linked from (symbols), or the static library (static)")
    parser.add_argument("--header", required=True)
    parser.add_argument("--base", help="delam.h, where HEADER is that of a library on top of libdelam")
    parser.add_argument("--experimental", help="header outside the promise")
    parser.add_argument("--list")
    parser.add_argument("--cholmod", action="store_true", help="check what is taken from CHOLMOD")
    parser.add_argument("--baseline", help="default: baseline/delam.abi, or with --base that of HEADER's name")
    parser.add_argument("--baseline-header", help="default: baseline/delam/delam.h, or with --base that of HEADER's name")
    options = parser.parse_args()
    name = os.path.basename(options.header)[:-2] if options.base else "delam"
    options.baseline = options.baseline or os.path.join(HERE, "baseline", f"{name}.abi")
    options.baseline_header = options.baseline_header or os.path.join(HERE, "baseline", "delam", f"{name}.h")
    try:
        wrong = {"symbols": check_symbols, "static": check_static, "baseline": check_baseline,
                 "abidiff": check_abidiff, "abixml": check_abixml}[options.check](options)
    except headers.HeaderError as error:
        wrong = [str(error)]
    for line in wrong:
        print(line)
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
