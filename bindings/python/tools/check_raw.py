#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compares src/delam/_base/raw.py with what clang reads in the public header: every function, argument, callback and
constant.

    check_raw.py [--header delam.h] [--raw raw.py]     exit 0: they agree; 1: they do not, each difference a line;
                                                        77: no clang

Nothing is shared with the generator: ctypes objects are turned back into C and put beside clang's spelling of the
types.
"""
import argparse
import ctypes
import json
import pathlib
import re
import shutil
import subprocess
import sys
import types

HERE = pathlib.Path(__file__).resolve().parent
HEADER = HERE.parents[2] / "include" / "delam" / "delam.h"
RAW = HERE.parent / "src" / "delam" / "_base" / "raw.py"
SKIPPED = 77

# clang's names of the fixed-width types on the platforms at hand; ctypes knows only the widths.
SPELLINGS = {ctypes.c_int32: "int32_t", ctypes.c_int64: "int64_t", ctypes.c_uint8: "uint8_t", ctypes.c_double: "double",
             ctypes.c_char: "char", ctypes.c_char_p: "char *", ctypes.c_void_p: "void *", None: "void"}


def find_clang():
    for name in ("clang", *(f"clang-{version}" for version in range(21, 12, -1))):
        if shutil.which(name):
            return name
    return None


def plain(kind):
    """A C type without const and with one blank before its stars."""
    words = re.sub(r"\bconst\b", " ", kind).replace("*", " * ").split()
    return re.sub(r"\* (?=\*)", "*", " ".join(words))


def split_signature(kind):
    """'int32_t (*)(double, void *)' or 'int32_t (double, void *)' as its result and its arguments."""
    result, arguments = re.fullmatch(r"(.*?)\s*(?:\(\*\))?\s*\((.*)\)", kind).groups()
    arguments = [plain(argument) for argument in arguments.split(",")] if arguments not in ("", "void") else []
    return plain(result), arguments


def read_header(clang, header):
    """What clang sees: {name: (result, [(argument, type)])}, {callback: (result, [type])}, {constant: value},
    {handles}."""
    command = [clang, "-x", "c", "-std=c99", "-fsyntax-only"]
    dump = [*command, "-Xclang", "-ast-dump=json", str(header)]
    tree = json.loads(subprocess.run(dump, check=True, capture_output=True).stdout)
    functions, callbacks, handles = {}, {}, set()
    for node in tree["inner"]:
        name = node.get("name", "")
        if not name.startswith("delam_"):
            continue
        if node["kind"] == "FunctionDecl":
            result, arguments = split_signature(node["type"]["qualType"])
            names = [child["name"] for child in node.get("inner", []) if child["kind"] == "ParmVarDecl"]
            if len(names) != len(arguments):
                raise SystemExit(f"check_raw: {name}: {len(arguments)} types but {len(names)} names")
            functions[name] = result, list(zip(names, arguments))
        elif node["kind"] == "TypedefDecl" and "(*)" in node["type"]["qualType"]:
            callbacks[name] = split_signature(node["type"]["qualType"])
        elif node["kind"] == "RecordDecl":
            handles.add(name)
    macros = subprocess.run([clang, "-x", "c", "-std=c99", "-E", "-dM", str(header)], check=True, capture_output=True,
                            text=True).stdout
    constants = {name: int(value) for name, value in re.findall(r"^#define (DELAM_\w+) (-?\d+)$", macros, re.MULTILINE)}
    return functions, callbacks, constants, handles


class Difference(list):
    def __call__(self, name, text):
        self.append(f"{name}: {text}")


def compare(raw, header):
    """Lines that say where the module `raw` and the header differ; empty when they agree."""
    functions, callbacks, constants, handles = header
    different = Difference()
    callback_types = {getattr(raw, name): name for name in callbacks if hasattr(raw, name)}

    def spell(kind):
        if kind in SPELLINGS:
            return SPELLINGS[kind]
        if kind in callback_types:
            return callback_types[kind]
        if isinstance(kind, type) and issubclass(kind, ctypes._Pointer):
            inner = spell(kind._type_)
            return inner + ("*" if inner.endswith("*") else " *")
        if isinstance(kind, type) and issubclass(kind, ctypes.Structure) and not hasattr(kind, "_fields_"):
            return kind.__name__
        return f"<{kind!r}>"

    for name in sorted(set(functions) | set(raw.FUNCTIONS)):
        if name not in raw.FUNCTIONS:
            different(name, "is in the header alone")
            continue
        if name not in functions:
            different(name, "is not in the header")
            continue
        result, arguments = functions[name]
        raw_result, raw_arguments = raw.FUNCTIONS[name]
        if spell(raw_result) != result:
            different(name, f"returns {result}, here {spell(raw_result)}")
        if len(raw_arguments) != len(arguments):
            different(name, f"takes {len(arguments)} arguments, here {len(raw_arguments)}")
            continue
        for (argument, kind), (raw_argument, raw_kind) in zip(arguments, raw_arguments):
            if argument != raw_argument:
                different(name, f"argument '{argument}', here '{raw_argument}'")
            if spell(raw_kind) != kind:
                different(name, f"argument '{argument}' is {kind}, here {spell(raw_kind)}")
    for name, (result, arguments) in callbacks.items():
        kind = getattr(raw, name, None)
        if kind is None:
            different(name, "is missing")
            continue
        here = spell(kind._restype_), [spell(argument) for argument in kind._argtypes_]
        if here != (result, arguments):
            different(name, f"is {result} ({', '.join(arguments)}), here {here[0]} ({', '.join(here[1])})")
    for name in sorted(handles):
        if not hasattr(raw, name):
            different(name, "is missing")
    here = {name: value for name, value in vars(raw).items() if name.startswith("DELAM_")}
    for name in sorted(set(constants) | set(here)):
        if constants.get(name) != here.get(name):
            different(name, f"is {constants.get(name, 'not there')}, here {here.get(name, 'not there')}")
    return different


def load(text, name="raw"):
    module = types.ModuleType(name)
    exec(compile(text, name, "exec"), vars(module))
    return module


def main():
    parser = argparse.ArgumentParser(description="compares the raw layer with the public header, as clang reads it")
    parser.add_argument("--header", type=pathlib.Path, default=HEADER)
    parser.add_argument("--raw", type=pathlib.Path, default=RAW)
    options = parser.parse_args()
    clang = find_clang()
    if clang is None:
        print("skipped: clang is not installed")
        sys.exit(SKIPPED)
    header = read_header(clang, options.header)
    differences = compare(load(options.raw.read_text(encoding="utf-8")), header)
    for line in differences:
        print(line)
    print(f"{len(header[0])} functions, {len(header[1])} callbacks, {len(header[2])} constants: "
          f"{len(differences) or 'no'} differences")
    sys.exit(1 if differences else 0)


if __name__ == "__main__":
    main()
