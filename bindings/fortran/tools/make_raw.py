#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""make_raw.py HEADER [--out FILE | --compare FILE]: the Fortran module delam_raw, an interface for each function.

--compare exits with 1 and the first differences when FILE is not what the header gives.

C scalars become arguments by value, arrays `name(*)`, handles type(c_ptr). Pointers to data are `optional`: absent is
NULL (TS 29113, -std=f2008ts; Fortran 2018 has it too). C does not say whether a pointer to be written means one number
or many: the comment of the function does, which speaks of *name or of name.
"""
import argparse
import difflib
import pathlib
import re
import sys
import textwrap

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "verify" / "abi"))

import header as public_header  # noqa: E402

KINDS = {
    "int32_t": "integer(c_int32_t)",
    "int64_t": "integer(c_int64_t)",
    "uint8_t": "integer(c_int8_t)",
    "double": "real(c_double)",
}


class Parameter:
    def __init__(self, parameter, comment, name):
        self.name = parameter.name
        self.const = parameter.type.startswith("const ")
        self.stars = parameter.type.count("*")
        self.type = parameter.type.replace("const ", "").rstrip("*")
        words = re.findall(rf"(\*?)\b{self.name}\b", comment)
        if name and self.stars == 1 and not self.const and self.type in KINDS and not words:
            raise SystemExit(f"make_raw.py: {name}: the comment says nothing of {self.name}: one number or many?")
        self.single = "*" in words


def declarations(header):
    """Macros with numbers, opaque types, callbacks and functions, in the order of the header."""
    def plain(function):
        told = "" if function.callback else function.name
        return (function.result.replace("*", " *"), function.name,
                [Parameter(p, function.comment, told) for p in function.parameters])

    return (list(header.constants.items()), header.handles, [plain(f) for f in header.callbacks.values()],
            [plain(f) for f in header.functions.values()])


def argument(function, p, opaque, callbacks, called_back):
    """Declaration of one dummy argument."""
    intent = "intent(in)" if p.const else "intent(inout)"
    if p.type in callbacks:
        return "type(c_funptr), value"
    if p.type == "void" or (p.type in opaque and p.stars == 1):
        return "type(c_ptr), value"
    if p.type in opaque:
        return "type(c_ptr), intent(inout)"
    if p.type == "char":
        if p.stars == 2:
            return "type(c_ptr), intent(inout), optional"
        if called_back:
            return "type(c_ptr), value"
        return f"character(kind=c_char), {intent}"
    if p.type not in KINDS:
        raise SystemExit(f"make_raw.py: {function}: no Fortran type for '{p.type}' of {p.name}")
    if p.stars == 0:
        return f"{KINDS[p.type]}, value"
    return f"{KINDS[p.type]}, {intent}" + ("" if called_back else ", optional")


def is_array(p, opaque, called_back):
    if p.stars == 0 or p.type in opaque or p.type == "void" or p.stars == 2 or called_back:
        return False
    if p.type == "char" or p.const:
        return True
    return not p.single


def interface(function, opaque, callbacks, called_back=False):
    result, name, parameters = function
    kind = "subroutine" if result == "void" else "function"
    label = "" if called_back else f', name="{name}"'
    words = f"{kind} {name}({', '.join(p.name for p in parameters)}) bind(c{label})"
    value = {"void": "", "const char *": "text"}.get(result, "status" if result == "int32_t" else "count_")
    if any(p.name == value for p in parameters):
        value += "_"
    if value:
        words += f" result({value})"
    lines = []
    wrapped = textwrap.wrap(words, 108, break_long_words=False, break_on_hyphens=False)
    for i, part in enumerate(wrapped):
        lines.append("    " + ("    " if i else "") + part + (" &" if i + 1 < len(wrapped) else ""))
    lines.append("      import :: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, c_double")
    for p in parameters:
        rank = "(*)" if is_array(p, opaque, called_back) else ""
        lines.append(f"      {argument(name, p, opaque, callbacks, called_back)} :: {p.name}{rank}")
    if value:
        lines.append(f"      {'type(c_ptr)' if '*' in result else KINDS[result]} :: {value}")
    lines.append(f"    end {kind} {name}")
    return lines


def module(header):
    macros, opaque, callbacks, functions = declarations(header)
    names = {c[1] for c in callbacks}
    lines = ["! SPDX-License-Identifier: BSD-3-Clause",
             "! Written by bindings/fortran/tools/make_raw.py from include/delam/delam.h: change these, not this file.",
             "! Everything here is as in C: indices from 0, texts end with c_null_char, an absent array is NULL.",
             "module delam_raw",
             "  use, intrinsic :: iso_c_binding, only: c_ptr, c_funptr, c_char, c_int8_t, c_int32_t, c_int64_t, &",
             "                                         c_double",
             "  implicit none",
             "  public",
             ""]
    taken = {name.lower() for _, name, _ in functions}
    for name, value in macros:
        # Fortran does not tell DELAM_ABI from delam_abi().
        if name.lower() in taken:
            name = name.replace("DELAM_", "DELAM_HEADER_")
        lines.append(f"  integer(c_int32_t), parameter :: {name} = {value}")
    lines += ["", "  ! Signatures of callbacks; pass c_funloc of a bind(c) procedure."]
    lines.append("  abstract interface")
    for callback in callbacks:
        lines += interface(callback, opaque, names, called_back=True)
    lines += ["  end interface", "", "  interface"]
    for function in functions:
        lines += interface(function, opaque, names)
    lines += ["  end interface", "end module delam_raw", ""]
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("header")
    parser.add_argument("--out")
    parser.add_argument("--compare")
    arguments = parser.parse_args()
    try:
        text = module(public_header.read(arguments.header))
    except public_header.HeaderError as error:
        sys.exit(f"make_raw.py: {error}")
    if arguments.compare:
        with open(arguments.compare, encoding="utf-8") as file:
            present = file.read()
        if present != text:
            difference = difflib.unified_diff(present.splitlines(), text.splitlines(), arguments.compare, "the header",
                                              lineterm="", n=1)
            print("\n".join(list(difference)[:30]))
            print(f"{arguments.compare} is not what {arguments.header} gives: run make_raw.py --out")
            return 1
        print(f"{arguments.compare}: as the header says")
        return 0
    if arguments.out:
        with open(arguments.out, "w", encoding="utf-8") as file:
            file.write(text)
    else:
        sys.stdout.write(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
