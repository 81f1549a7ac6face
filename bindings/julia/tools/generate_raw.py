#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes src/raw.jl from the public header.

    generate_raw.py [--header delam.h] [--out raw.jl]     without --out the text goes to standard output

The header is read by verify/abi/header.py, which refuses by line whatever is not of the interface's few forms.
"""
import argparse
import pathlib
import sys
import textwrap

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]
HEADER = ROOT / "include" / "delam" / "delam.h"
RAW = HERE.parent / "src" / "raw.jl"
sys.path.insert(0, str(ROOT / "verify" / "abi"))

import header as public_header  # noqa: E402

# Int is as wide as the machine's words and must not be written where C says how wide a number is.
SCALARS = {"int32_t": "Int32", "int64_t": "Int64", "uint8_t": "UInt8", "double": "Cdouble"}
RESERVED = {"baremodule", "begin", "break", "catch", "const", "continue", "do", "else", "elseif", "end", "export",
            "false", "finally", "for", "function", "global", "if", "import", "in", "let", "local", "macro", "module",
            "quote", "return", "struct", "true", "try", "using", "where", "while", "libdelam"}
WIDTH = 120


def julia_type(header, text):
    """The type of Julia that a ccall passes for a type of C."""
    words = text.replace("const ", "")
    base, stars = words.rstrip("*"), words.count("*")
    if base in header.callbacks and stars == 0:
        return base
    if base == "void":
        inner, stars = "Cvoid", stars
    elif base == "char":
        # Text to be read ends with a zero, which Cstring sees to; a buffer to be written is one of bytes.
        inner, stars = ("Cstring", stars - 1) if text.startswith("const") else ("UInt8", stars)
    else:
        inner = SCALARS.get(base) or (base if base in header.handles and stars > 0 else None)
    if inner is None or stars < 0:
        raise public_header.HeaderError(f"{header.path}: type '{text}' has no place in the interface")
    return "Ptr{" * stars + inner + "}" * stars


def argument_name(name):
    return name + "_" if name in RESERVED else name


def wrapped(head, items, tail, indent):
    """head item, item, ... tail, in lines of at most WIDTH columns, the later ones under the first item."""
    one = head + ", ".join(items) + tail
    if len(one) <= WIDTH:
        return [one]
    text = textwrap.fill(", ".join(items), WIDTH - len(tail), initial_indent=head, subsequent_indent=" " * indent,
                         break_long_words=False, break_on_hyphens=False)
    return (text + tail).split("\n")


def julia_text(header):
    lines = [
        "# SPDX-License-Identifier: BSD-3-Clause",
        '"""',
        "The C interface, one to one. Generated from delam.h by tools/generate_raw.py: change that, not this.",
        "",
        "Arguments are as in C: indices from 0 unless an `index_base` says so, `C_NULL` where nothing is meant. An",
        "array is passed as it is, a number to be written as a `Ref`; nothing is checked.",
        '"""',
        "module Raw",
        "",
        "# The SONAME: what library.jl has loaded under its full path is found again by it.",
        f'const libdelam = "libdelam.so.{header.constants["DELAM_ABI"]}"',
        "",
    ]
    lines += [f"const {name} = Int32({value})" for name, value in header.constants.items()]
    lines += ["", "# Opaque."]
    lines += [f"mutable struct {name} end" for name in header.handles]
    for function in header.callbacks.values():
        result = julia_type(header, function.result)
        kinds = [julia_type(header, parameter.type) for parameter in function.parameters]
        comma = "," if len(kinds) == 1 else ""
        lines += ["", f"# @cfunction(f, {result}, ({', '.join(kinds)}{comma}))"]
        lines += [f"const {function.name} = Ptr{{Cvoid}}"]
    for function in header.functions.values():
        names = [argument_name(parameter.name) for parameter in function.parameters]
        typed = [f"{name}::{julia_type(header, parameter.type)}" for name, parameter in zip(names, function.parameters)]
        head = f"function {function.name}("
        call = f"    @ccall libdelam.{function.name}("
        lines += [""]
        lines += wrapped(head, names, ")", len(head))
        lines += wrapped(call, typed, f")::{julia_type(header, function.result)}", 8)
        lines += ["end"]
    names = [f":{name}" for name in header.functions]
    lines += ["", "const FUNCTIONS = ("]
    lines += textwrap.wrap(", ".join(names) + ",", WIDTH, initial_indent="    ", subsequent_indent="    ")
    lines += [")", "", "end", ""]
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description="writes the raw layer from the public header")
    parser.add_argument("--header", type=pathlib.Path, default=HEADER)
    parser.add_argument("--out", type=pathlib.Path)
    options = parser.parse_args()
    try:
        text = julia_text(public_header.read(options.header))
    except (public_header.HeaderError, OSError) as error:
        sys.exit(f"generate_raw: {error}")
    if options.out:
        options.out.write_text(text, encoding="utf-8")
    else:
        sys.stdout.write(text)


if __name__ == "__main__":
    main()
