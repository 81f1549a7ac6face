#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes src/delam/_base/raw.py from the public header.

    generate_raw.py [--header delam.h] [--out raw.py]     without --out the text goes to standard output

The header is read by verify/abi/header.py, which refuses by line whatever is not of the interface's few forms.
"""
import argparse
import pathlib
import sys
import textwrap

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]
HEADER = ROOT / "include" / "delam" / "delam.h"
sys.path.insert(0, str(ROOT / "verify" / "abi"))

import header as public_header  # noqa: E402

SCALARS = {"int32_t": "c_int32", "int64_t": "c_int64", "uint8_t": "c_uint8", "double": "c_double"}


def ctypes_type(header, text):
    """The ctypes expression of a type of C."""
    base, stars = text.replace("const ", "").rstrip("*"), text.count("*")
    if base == "void":
        inner, stars = {0: ("None", 0), 1: ("c_void_p", 0)}.get(stars, (None, 0))
    elif base == "char":
        # Text to be read is a bytes object; a buffer to be written must not pass for one.
        inner, stars = ("c_char_p", stars - 1) if text.startswith("const") else ("c_char", stars)
    else:
        named = base in header.callbacks or (base in header.handles and stars > 0)
        inner = SCALARS.get(base) or (base if named else None)
    if inner is None or stars < 0:
        raise public_header.HeaderError(f"{header.path}: type '{text}' has no place in the interface")
    return "POINTER(" * stars + inner + ")" * stars


def python_text(header):
    lines = [
        "# SPDX-License-Identifier: BSD-3-Clause",
        '"""The C interface, one to one. Generated from delam.h by tools/generate_raw.py: change that, not this."""',
        "from ctypes import (CDLL, CFUNCTYPE, POINTER, Structure, c_char, c_char_p, c_double, c_int32, c_int64,",
        "                    c_uint8, c_void_p)",
        "from typing import Any",
        "",
    ]
    lines += [f"{name} = {value}" for name, value in header.constants.items()]
    for name in header.handles:
        lines += ["", "", f"class {name}(Structure):", '    """Opaque."""']
    lines += ["", ""]
    for function in header.callbacks.values():
        kinds = [ctypes_type(header, kind) for kind in public_header.types_of(function)]
        lines += wrapped(f"{function.name} = CFUNCTYPE(", kinds, ")")
    lines += ["", "# Name: (result, ((argument, type), ...))",
              "FUNCTIONS: dict[str, tuple[Any, tuple[tuple[str, Any], ...]]] = {"]
    for name, function in header.functions.items():
        returned = ctypes_type(header, function.result)
        pairs = [f'("{p.name}", {ctypes_type(header, p.type)})' for p in function.parameters]
        if not pairs:
            lines.append(f'    "{name}": ({returned}, ()),')
        elif len(pairs) == 1:
            lines.append(f'    "{name}": ({returned}, ({pairs[0]},)),')
        else:
            lines += wrapped(f'    "{name}": ({returned}, (', pairs, ")),")
    lines += [
        "}",
        "",
        "",
        "def bind(library: CDLL) -> list[str]:",
        '    """Gives the functions of a loaded library their types; returns the names that it lacks."""',
        "    missing = []",
        "    for name, (result, arguments) in FUNCTIONS.items():",
        "        try:",
        "            function = getattr(library, name)",
        "        except AttributeError:",
        "            missing.append(name)",
        "            continue",
        "        function.restype = result",
        "        function.argtypes = [kind for _, kind in arguments]",
        "    return missing",
        "",
    ]
    return "\n".join(lines)


def wrapped(head, items, tail):
    """head item, item, ... tail in lines of at most 120 columns."""
    one = head + ", ".join(items) + tail
    if len(one) <= 120:
        return [one]
    indent = " " * (len(head) - len(head.lstrip()) + 4)
    body = textwrap.wrap(", ".join(item.replace(" ", "\0") for item in items), 120, initial_indent=indent,
                         subsequent_indent=indent, break_long_words=False, break_on_hyphens=False)
    body[-1] += tail
    if len(body[-1]) > 120:
        body[-1:] = [body[-1][:-len(tail)], indent[4:] + tail]
    return [head, *(line.replace("\0", " ") for line in body)]


def main():
    parser = argparse.ArgumentParser(description="writes the raw layer from the public header")
    parser.add_argument("--header", type=pathlib.Path, default=HEADER)
    parser.add_argument("--out", type=pathlib.Path)
    options = parser.parse_args()
    try:
        text = python_text(public_header.read(options.header))
    except (public_header.HeaderError, OSError) as error:
        sys.exit(f"generate_raw: {error}")
    if options.out:
        options.out.write_text(text, encoding="utf-8")
    else:
        sys.stdout.write(text)


if __name__ == "__main__":
    main()
