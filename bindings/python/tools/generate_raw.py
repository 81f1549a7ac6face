#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes src/delam/_base/raw.py from the public header.

    generate_raw.py [--header delam.h] [--out raw.py]     without --out the text goes to standard output

The header keeps to a small part of C: integer macros, opaque structs, callback types, functions. That part is read
here; whatever else turns up is refused with its line, so nothing of the interface can be passed over in silence.
"""
import argparse
import pathlib
import re
import sys
import textwrap

HERE = pathlib.Path(__file__).resolve().parent
HEADER = HERE.parents[2] / "include" / "delam" / "delam.h"

SCALARS = {"int32_t": "c_int32", "int64_t": "c_int64", "uint8_t": "c_uint8", "double": "c_double"}


class HeaderError(Exception):
    """A line of the header that is outside the part of C read here."""


class Header:
    def __init__(self, text):
        self.constants = {}
        self.handles = []
        self.callbacks = {}
        self.functions = {}
        self._read(self._without_comments(text))

    @staticmethod
    def _without_comments(text):
        """Comments become blanks; line breaks stay, so that lines keep their numbers."""
        return re.sub(r"/\*.*?\*/", lambda m: re.sub(r"[^\n]", " ", m.group()), text, flags=re.DOTALL)

    def _read(self, text):
        statement, begin = "", 0
        cplusplus = False
        for number, line in enumerate(text.split("\n"), start=1):
            line = line.strip()
            if not line:
                continue
            if line.startswith("#"):
                if re.match(r"#\s*ifdef\s+__cplusplus", line):
                    cplusplus = True
                elif re.match(r"#\s*endif", line):
                    cplusplus = False
                self._directive(number, line)
                continue
            if cplusplus:
                continue
            if not statement:
                begin = number
            statement += " " + line
            while ";" in statement:
                head, statement = statement.split(";", 1)
                self._statement(begin, " ".join(head.split()))
                statement, begin = statement.strip(), number
        if statement:
            raise HeaderError(f"line {begin}: '{statement}' is not closed by a semicolon")

    def _directive(self, number, line):
        constant = re.fullmatch(r"#define (DELAM_[A-Z0-9_]+) (-?\d+)", line)
        if constant:
            self.constants[constant[1]] = int(constant[2])
        elif not re.match(r"#\s*(ifndef|ifdef|if defined|include|else|endif)\b|"
                          r"#define DELAM_\w+_H$|#define DELAM_API\b", line):
            raise HeaderError(f"line {number}: '{line}' is no integer constant")

    def _statement(self, number, text):
        handle = re.fullmatch(r"typedef struct (\w+) (\w+)", text)
        callback = re.fullmatch(r"typedef (.+?)\(\s*\*\s*(\w+)\)\s*\((.*)\)", text)
        function = re.fullmatch(r"DELAM_API (.+?)(\w+)\s*\((.*)\)", text)
        if handle and handle[1] == handle[2]:
            self.handles.append(handle[1])
        elif callback:
            self.callbacks[callback[2]] = self._signature(number, callback[1], callback[3])
        elif function:
            if function[2] in self.functions:
                raise HeaderError(f"line {number}: {function[2]} is declared twice")
            self.functions[function[2]] = self._signature(number, function[1], function[3])
        else:
            raise HeaderError(f"line {number}: '{text}' is not understood")

    def _signature(self, number, returned, parameters):
        arguments = []
        if parameters.strip() != "void":
            for parameter in parameters.split(","):
                match = re.fullmatch(r"(.*?[\s*])(\w+)", parameter.strip())
                if not match:
                    raise HeaderError(f"line {number}: '{parameter.strip()}' has no name or no type")
                arguments.append((match[2], self._type(number, match[1])))
        return self._type(number, returned), arguments

    def _type(self, number, text):
        """The ctypes expression of a C type."""
        stars = text.count("*")
        words = [word for word in text.replace("*", " ").split() if word != "const"]
        base = words[0] if len(words) == 1 else None
        if base == "void":
            inner, stars = {0: ("None", 0), 1: ("c_void_p", 0)}.get(stars, (None, 0))
        elif base == "char":
            # Text to be read is a bytes object; a buffer to be written must not pass for one.
            inner, stars = ("c_char_p", stars - 1) if "const" in text else ("c_char", stars)
        else:
            inner = SCALARS.get(base) or (base if base in self.handles or base in self.callbacks else None)
            if base in self.handles and stars == 0:
                inner = None
        if inner is None or stars < 0:
            raise HeaderError(f"line {number}: type '{text.strip()}' has no place in the interface")
        for _ in range(stars):
            inner = f"POINTER({inner})"
        return inner


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
    for name, (returned, arguments) in header.callbacks.items():
        lines += wrapped(f"{name} = CFUNCTYPE(", [returned] + [kind for _, kind in arguments], ")")
    lines += ["", "# Name: (result, ((argument, type), ...))",
              "FUNCTIONS: dict[str, tuple[Any, tuple[tuple[str, Any], ...]]] = {"]
    for name, (returned, arguments) in header.functions.items():
        pairs = [f'("{argument}", {kind})' for argument, kind in arguments]
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
        text = python_text(Header(options.header.read_text(encoding="utf-8")))
    except (HeaderError, OSError) as error:
        sys.exit(f"generate_raw: {options.header}: {error}")
    if options.out:
        options.out.write_text(text, encoding="utf-8")
    else:
        sys.stdout.write(text)


if __name__ == "__main__":
    main()
