#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""doxygen_filter.py HEADER: the header as Doxygen reads it, to standard output.

The header is written for people who read it in an editor, without markup. Here comments become documentation: words as
they are, indented tables verbatim, the line in brackets as a list. Members of a struct refer to the comment above it.
Line numbers are kept only roughly.
"""
import os
import re
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import contract_lint as lint  # noqa: E402
import header as headers  # noqa: E402

DECLARATION = re.compile(r"\s*(?:DELAM_API|typedef|#define DELAM_(?!API|DELAM_H|EXPERIMENTAL_H|PETSC_H))")


def quiet(text):
    """Words in which nothing is a command, a link or an emphasis."""
    return re.sub(r"[\\@&<>#%$*~]", r"\\\g<0>", text).replace("`", "'")


def documentation(comment):
    fields, prose = lint.fields_of(comment)
    out, table = [], []

    def end_of_table():
        if table:
            out.extend(["@verbatim", *table, "@endverbatim"])
            table.clear()

    for line in prose.split("\n"):
        if line.startswith(" "):
            table.append(line)
        else:
            end_of_table()
            out.append(quiet(line))
    end_of_table()
    if fields:
        out.append("@par Contract")
        out.extend(f"- <b>{key}</b>: {quiet(value)}" for key, value in fields.items())
    return "\n".join(out)


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        text = file.read()
    out = [f"/** @file {os.path.basename(sys.argv[1])}\n"]
    at = 0
    first = True
    for match in headers.COMMENT.finditer(text):
        code = text[at:match.start()]
        at = match.end()
        line_before = code.rsplit("\n", 1)[-1]
        comment = headers.plain(match.group())
        if first:
            comment = comment.replace("SPDX-License-Identifier: BSD-3-Clause", "").strip()
            out.append(documentation(comment) + "\n*/")
            first = False
        elif comment.startswith("----"):  # a line that divides the header
            out.append(code)
        elif line_before.startswith(("#define", "typedef struct")):
            out.append(code + f"/**< {quiet(comment)} */")
        elif DECLARATION.match(text, at):
            out.append(code + f"/** {documentation(comment)}\n*/")
        else:
            out.append(code)
    out.append(text[at:])
    text = headers.STRUCT.sub(lambda struct: struct.group().replace(";\n", "; /**< See above. */\n"), "".join(out))
    # A comment stands for all constants of its list: those below the first refer to it.
    lines = text.split("\n")
    leader = ""
    for number, line in enumerate(lines):
        constant = re.match(r"#define (DELAM_(?!API|DELAM_H|EXPERIMENTAL_H|PETSC_H)\w+) \S+\s*$", line)
        if constant and lines[number - 1] == "*/":
            leader = constant.group(1)
        elif constant and leader:
            lines[number] = f"/** See {leader}. */\n{line}"
        elif not line.startswith("#define"):
            leader = ""
    print("\n".join(lines))


if __name__ == "__main__":
    main()
