#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""check_raw.py HEADER RAW [--fortran GFORTRAN] [--cc GCC]: does the module delam_raw fit the header?

Two compilers are asked, and no code is shared with make_raw.py: gcc (-aux-info) for the prototypes of the header,
gfortran (-fc-prototypes) for those of the module. Names, results, number of arguments and their classes must be equal:
width and kind of scalars, what data pointers point to and whether it may be written, callbacks, handles, and whether a
handle is passed itself or by its address (gfortran prints both as void *, so that is read from the module's text).
"""
import argparse
import os
import re
import subprocess
import sys
import tempfile

SCALARS = {
    "int": "int32", "int32_t": "int32", "long": "int64", "int64_t": "int64", "long int": "int64", "double": "double",
    "void": "void", "char": "char", "signed char": "byte", "uint8_t": "byte", "unsigned char": "byte", "short": "int16",
    "float": "float", "_Bool": "bool", "long long": "int64",
}


def run(command):
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise SystemExit(f"check_raw.py: {' '.join(command[:2])} failed:\n{done.stdout}{done.stderr}")
    return done.stdout


def classify(words, callbacks=()):
    """Class of a C type: 'double', 'pointer to const double', 'handle', 'address of handle', 'callback'."""
    stars = words.count("*")
    const = bool(re.match(r"\s*const\b", words))
    name = " ".join(words.replace("*", " ").replace("const", " ").split())
    if name in callbacks:
        return "callback"
    scalar = SCALARS.get(name)
    if stars == 0:
        return scalar or f"unknown type '{name}'"
    if scalar is None or scalar == "void":
        return "handle" if stars == 1 else "address of handle"
    if stars > 1:
        return "address of handle"
    return f"pointer to {'const ' if const else ''}{scalar}"


def split_prototype(line):
    match = re.match(r"\s*(?:extern )?(.*?)(\w+) ?\((.*)\);", line)
    result, name, words = match[1], match[2], match[3].strip()
    return name, result, [] if words in ("", "void") else [word.strip() for word in words.split(",")]


def header_side(path, cc):
    """Classes of every function and callback type of the header, and its numbers."""
    plain = run([cc, "-std=c99", "-E", "-P", path])
    callbacks = re.findall(r"typedef \w+ \(\*(delam_\w+)\)", plain)
    macros = run([cc, "-std=c99", "-dM", "-E", path])
    numbers = dict(re.findall(r"^#define (DELAM_\w+) (-?\d+)\s*$", macros, flags=re.M))
    with tempfile.TemporaryDirectory() as folder:
        # A callback's type, written as a function, is read like all others; its name is taken then.
        text = plain
        for name in callbacks:
            function = rf"\1 {name}_signature\2; typedef int *{name};"
            text = re.sub(rf"typedef (\w+) \(\*{name}\)(\([^)]*\));", function, text)
        source, prototypes = os.path.join(folder, "header.c"), os.path.join(folder, "header.txt")
        with open(source, "w", encoding="utf-8") as file:
            file.write(text)
        run([cc, "-std=c99", "-fsyntax-only", "-aux-info", prototypes, source])
        with open(prototypes, encoding="utf-8") as file:
            lines = re.findall(r"\*/ (.*\bdelam_\w+ \(.*\);)", file.read())
    functions = {}
    for line in lines:
        name, result, arguments = split_prototype(line)
        called_back = name.endswith("_signature")
        classes = [classify(result)] + [classify(words, callbacks) for words in arguments]
        if called_back:
            # The library hands its texts over as addresses; a callback gets them as type(c_ptr).
            classes = ["handle" if c == "pointer to const char" else c for c in classes]
        if classes[0].startswith("pointer"):
            classes[0] = "handle"
        functions[name.removesuffix("_signature")] = classes
    return functions, numbers


def by_address(text):
    """Of each procedure, the names of type(c_ptr) arguments that are not passed by value."""
    found = {}
    procedure = r"\n *(?:function|subroutine) (\w+)\((.*?)\n *end (?:function|subroutine)"
    for name, body in re.findall(procedure, text, flags=re.S):
        found[name] = {dummy for attributes, dummy in re.findall(r"type\(c_ptr\)(.*?) :: (\w+)", body)
                       if "value" not in attributes}
    return found


def fortran_side(path, fortran):
    with tempfile.TemporaryDirectory() as folder:
        printed = run([fortran, "-std=f2008ts", "-fc-prototypes", "-fsyntax-only", "-J", folder, path])
    with open(path, encoding="utf-8") as file:
        text = file.read()
    references = by_address(text)
    functions = {}
    for line in re.findall(r"^\w.*\b\w+ \(.*\);$", printed, flags=re.M):
        line = re.sub(r"int \(\*(\w+)\)\(\)", r"callback \1", line)
        name, result, arguments = split_prototype(line)
        classes = [classify(result)]
        for words in arguments:
            kind, dummy = re.match(r"(.*?)(\w+)$", words).groups()
            one = "callback" if kind.strip() == "callback" else classify(kind)
            if one == "handle" and dummy in references.get(name, ()):
                one = "address of handle"
            classes.append(one)
        functions[name] = classes
    numbers = dict(re.findall(r"integer\(c_int32_t\), parameter :: (DELAM_\w+) = (-?\d+)", text))
    if "DELAM_HEADER_ABI" in numbers:
        numbers["DELAM_ABI"] = numbers.pop("DELAM_HEADER_ABI")
    return functions, numbers


def compare(header, raw):
    problems = []
    for what, c, f in (("function", header[0], raw[0]), ("number", header[1], raw[1])):
        for name in sorted(set(c) | set(f)):
            if name not in f:
                problems.append(f"{what} {name} is not in the module")
            elif name not in c:
                problems.append(f"{what} {name} is not in the header")
            elif c[name] != f[name]:
                problems.append(f"{name}: the header has {c[name]}, the module {f[name]}")
    return problems


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("header")
    parser.add_argument("raw")
    parser.add_argument("--fortran", default="gfortran")
    parser.add_argument("--cc", default="gcc")
    arguments = parser.parse_args()
    header = header_side(arguments.header, arguments.cc)
    raw = fortran_side(arguments.raw, arguments.fortran)
    problems = compare(header, raw)
    print("\n".join(problems) if problems else f"{len(header[0])} signatures and {len(header[1])} numbers agree")
    return 1 if problems or not header[0] else 0


if __name__ == "__main__":
    sys.exit(main())
