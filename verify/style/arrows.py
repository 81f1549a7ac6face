# SPDX-License-Identifier: BSD-3-Clause
"""Checks the rooms of each house, in C++ and in Python: its folders, and which of them include or import one another.

The READMEs of a house have tables of the rooms of a folder: its folders, and `FOLDER/.` for its own files. A room may
include what its row names, and every name stands further down the table; so the structure has no circle, at any depth.
An arrow that a table allows but no file needs is refused as well: the tables are the structure, not a fence around it.
No two concepts (a header and its source, or a module) need each other, by whatever detour. A folder holds at most nine
folders and twelve concepts. No two houses have a header of the same path.

Every import of a module counts, wherever it stands: in a function, for type checkers alone, or by a text that names
the module relative to its own, as importlib takes it.

    python3 verify/style/arrows.py [--list]
"""

import argparse
import ast
import collections
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
HOUSES = {"src": "src", "bindings/cli/src": "bindings/cli/src",  # the house, and the folder of the READMEs with its tables
          "bindings/python/src/delam": "bindings/python"}
FOLDERS, CONCEPTS, ARROWS = 9, 12, 30  # at most: folders in a folder, concepts in a folder, arrows between the rooms of a folder
BESIDE = {"petsc"}  # libdelam-petsc, a library of its own, lies in the house of libdelam and counts as no room of it
MODULE = re.compile(r"\.*\w+(\.\w+)+|\.+\w+")  # a text that may name a module: with a dot
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


def texts_of(house):
    """Returns path below the house -> text, of its sources."""
    paths = sorted(p for p in house.rglob("*") if p.suffix in (".cpp", ".hpp", ".py"))
    return {p.relative_to(house).as_posix(): p.read_text(encoding="utf-8") for p in paths}


def needs(texts, package):
    """Returns path -> paths it includes or imports, all below the house; those of other houses are left out.

    package: the name of the house as Python imports it."""
    return {name: sorted(set(imports(name, text, texts, package) if name.endswith(".py") else INCLUDE.findall(text)) & set(texts))
            for name, text in texts.items()}


def imports(name, text, paths, package):
    """Yields the paths of the modules that a module imports. paths: those of the house."""
    at = (package, *pathlib.PurePosixPath(name).parent.parts)
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            found = [module(alias.name, at, paths) for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            base = "." * node.level + (node.module or "")
            dot = "" if base.endswith(".") else "."
            found = [module(f"{base}{dot}{alias.name}", at, paths) or module(base, at, paths) for alias in node.names]
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            found = [module(node.value, at, paths)] if MODULE.fullmatch(node.value) else []
        else:
            continue
        yield from filter(None, found)


def module(dotted, at, paths):
    """Returns the path of the module that a name with dots means in a folder, or None. at: the folder, from the package on."""
    level = len(dotted) - len(dotted.lstrip("."))
    parts = [part for part in dotted.split(".") if part]
    if level:
        parts = [*at[:len(at) - level + 1], *parts]
    below = "/".join(parts[1:])
    known = (f"{below}.py", f"{below}/__init__.py".lstrip("/")) if parts[:1] == [at[0]] else ()
    return next((path for path in known if path in paths), None)


def arrows_between(included):
    """Returns (from, to) -> one example that shows it, for rooms; the house's own files may need everything."""
    out = {}
    for name, others in included.items():
        for other in others:
            of, to = rooms(name, other)
            if of not in (to, "."):
                out.setdefault((of, to), f"{name} needs {other}")
    return out


def concepts_of(included):
    """Returns concept -> concepts it needs; a header and its source are one concept, and so is a module."""
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
    included = {house: needs(texts_of(ROOT / house), pathlib.PurePath(house).name) for house in HOUSES}
    wrong = list(twice(included))
    for house, of in included.items():
        readmes = [p.read_text(encoding="utf-8") for p in sorted((ROOT / HOUSES[house]).rglob("README.md"))]
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
