# SPDX-License-Identifier: BSD-3-Clause
"""Checks the rooms of each house of C++: its folders, and which of them include one another.

The READMEs of a house have tables of the rooms of a folder: its folders, and `FOLDER/.` for its own files. A room may
include what its row names, and every name stands further down the table; so the structure has no circle, at any depth.
An arrow that a table allows but no file needs is refused as well: the tables are the structure, not a fence around it.
No two concepts (a header and its source are one) include each other, by whatever detour. A folder holds at most nine
folders and twelve concepts. No two houses have a header of the same path.

    python3 verify/style/arrows.py [--list]
"""

import argparse
import collections
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
HOUSES = ("src", "bindings/cli/src")
FOLDERS, CONCEPTS, ARROWS = 9, 12, 30  # at most: folders in a folder, concepts in a folder, arrows between the rooms of a folder
BESIDE = {"petsc"}  # libdelam-petsc, a library of its own, lies in the house of libdelam and counts as no room of it
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.M)
ROW = re.compile(r"^\| `(?P<room>[a-z/_]+/\.?)` \|(?P<what>[^|]*)\|(?P<uses>[^|]*)\|$", re.M)


def allowed(readmes):
    """Returns room -> rooms it may include, from the tables of the texts, in their order."""
    rows = [m for text in readmes for m in ROW.finditer(text)]
    return {m["room"].removesuffix("/"): re.findall(r"[a-z_]+(?:/[a-z_]+)*(?:/\.)?", m["uses"]) for m in rows}


def folder(path):
    """Returns the folder of a path below its house; "." for the house itself."""
    return pathlib.PurePosixPath(path).parent.as_posix()


def rooms(a, b):
    """Returns the rooms of two files within the folder that holds both; the same twice if both are its own files."""
    first, second = a.split("/"), b.split("/")
    depth = 0
    while depth < min(len(first), len(second)) - 1 and first[depth] == second[depth]:
        depth += 1
    return tuple("/".join(parts[:depth] + [parts[depth] if len(parts) > depth + 1 else "."]) for parts in (first, second))


def includes(house):
    """Returns path -> paths it includes, both below the house; includes of other houses are left out."""
    paths = {p.relative_to(house).as_posix(): p for p in sorted(house.rglob("*.[ch]pp"))}
    return {name: sorted(set(INCLUDE.findall(path.read_text(encoding="utf-8"))) & set(paths)) for name, path in paths.items()}


def arrows_between(included):
    """Returns (from, to) -> one include that shows it, for rooms; the house's own files may include everything."""
    out = {}
    for name, others in included.items():
        for other in others:
            of, to = rooms(name, other)
            if of not in (to, "."):
                out.setdefault((of, to), f"{name} includes {other}")
    return out


def concepts_of(included):
    """Returns concept -> concepts it includes; a header and its source are one concept."""
    out = collections.defaultdict(set)
    for name, others in included.items():
        own = name.rsplit(".", 1)[0]
        out[own] |= {other.rsplit(".", 1)[0] for other in others} - {own}
    return out


def circles(graph):
    """Returns the strongly connected sets of more than one node (Tarjan, SIAM J. Comput. 1 (1972) 146)."""
    number, low, stack, out = {}, {}, [], []

    def visit(node):
        number[node] = low[node] = len(number)
        stack.append(node)
        for other in sorted(graph.get(node, ())):
            if other not in number:
                visit(other)
            if other in stack:
                low[node] = min(low[node], low[other])
        if low[node] == number[node]:
            members = stack[stack.index(node):]
            del stack[stack.index(node):]
            if len(members) > 1:
                out.append(sorted(members))

    for node in sorted(graph):
        if node not in number:
            visit(node)
    return out


def of_table(uses, arrows, house):
    """Yields where the tables of a house and the includes differ."""
    order = list(uses)
    for (a, b), example in sorted(arrows.items()):
        if a not in uses or b not in uses:
            yield f"{house}: {a if a not in uses else b} is in no table of a README: {example}"
        elif b not in uses[a]:
            yield f"{house}: {a} -> {b} is in no table of a README: {example}"
    for a, targets in uses.items():
        for b in targets:
            if b not in uses:
                yield f"{house}: {a} -> {b}: there is no such room"
            elif order.index(b) <= order.index(a):
                yield f"{house}: {a} -> {b} points up the table"
            elif (a, b) not in arrows:
                yield f"{house}: {a} -> {b} is in a table, but no file needs it"


def of_rooms(concepts, house):
    """Yields folders with too many folders or concepts."""
    inside, below = collections.Counter(), collections.defaultdict(set)
    for concept in concepts:
        inside[folder(concept)] += 1
        parts = pathlib.PurePosixPath(concept).parts
        for n in range(len(parts) - 1):
            if parts[n] not in BESIDE:
                below["/".join(parts[:n]) or "."].add(parts[n])
    for name, count in sorted(inside.items()):
        if count > CONCEPTS:
            yield f"{house}/{name}: {count} concepts, at most {CONCEPTS} in a folder"
    for name, folders in sorted(below.items()):
        if len(folders) > FOLDERS:
            yield f"{house}/{name}: {len(folders)} folders, at most {FOLDERS} in a folder"


def by_folder(arrows):
    """Returns folder -> number of arrows between its rooms."""
    return collections.Counter(a.rpartition("/")[0] or "." for a, _ in arrows)


def problems(house, readmes, included):
    """Returns what is wrong with one house, a line each. readmes: their texts."""
    arrows, concepts = arrows_between(included), concepts_of(included)
    out = list(of_table(allowed(readmes), arrows, house)) + list(of_rooms(concepts, house))
    out += [f"{house}: a circle of files: {', '.join(members)}" for members in circles(concepts)]
    out += [f"{house}/{name}: {count} arrows between its rooms, at most {ARROWS}"
            for name, count in by_folder(arrows).items() if count > ARROWS]
    return out


def twice(headers):
    """Yields headers that two houses have under one path. headers: house -> paths."""
    seen = {}
    for house, paths in headers.items():
        for path in paths:
            if path.endswith(".hpp") and seen.setdefault(path, house) != house:
                yield f"{seen[path]}/{path} and {house}/{path}: one include would mean two files"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--list", action="store_true", help="print every arrow with an include that shows it")
    arguments = parser.parse_args()
    included = {house: includes(ROOT / house) for house in HOUSES}
    wrong = list(twice(included))
    for house, of in included.items():
        readmes = [p.read_text(encoding="utf-8") for p in sorted((ROOT / house).rglob("README.md"))]
        wrong += problems(house, readmes, of)
        arrows = arrows_between(of)
        if arguments.list:
            for (a, b), example in sorted(arrows.items()):
                print(f"{house}: {a} -> {b}: {example}")
        counts = ", ".join(f"{name} {count}" for name, count in sorted(by_folder(arrows).items()))
        print(f"{house}: {len({folder(name) for name in of} - {'.'})} folders; arrows {counts}; "
              f"{len(concepts_of(of))} concepts, {len(circles(concepts_of(of)))} circles")
    for line in wrong:
        print(line, file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
