# SPDX-License-Identifier: BSD-3-Clause
"""Finds the functions of a C++ file: where each begins, how many lines it has. Reads tokens, not the layout."""

import re

SCOPE = re.compile(r"^(inline\s+)?(namespace|class|struct|union|enum|extern\s*\"\")\b|^extern\s*\"\"")
ACCESS = re.compile(r"\s*(?:public|protected|private)\s*:(?!:)")
TEMPLATE = re.compile(r"\s*template\s*<")


def blank(match):
    """The same lines, without what stands in them."""
    return re.sub(r"[^\n]", " ", match.group())


def bare(text):
    """The code alone: comments and preprocessor lines blank, literals empty, every character at its place."""
    pattern = re.compile(
        r"//[^\n]*|/\*.*?\*/|R\"(?P<mark>[^(\s]*)\(.*?\)(?P=mark)\"|\"(?:\\.|[^\"\\\n])*\"|(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])+'",
        re.S,
    )

    def replaced(match):
        if match.group().startswith("/"):
            return blank(match)
        inside = re.sub(r"[^\n]", " ", match.group()[1:-1])
        return '"' + '"' + inside if '"' in match.group()[-1] else "0" + inside + " "

    code = pattern.sub(replaced, text)
    return re.sub(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", blank, code, flags=re.M)


def closing(code, n):
    """The place of the brace that closes the one at n."""
    depth = 0
    for m in re.compile(r"[{}]").finditer(code, n):
        depth += 1 if m.group() == "{" else -1
        if depth == 0:
            return m.start()
    raise ValueError("a brace that nothing closes")


def skip_angles(code, n):
    """Behind the angle bracket that closes the one at n."""
    depth = 0
    while n < len(code):
        depth += {"<": 1, ">": -1}.get(code[n], 0)
        n += 1
        if depth == 0:
            return n
    return n


def declaration(head, start):
    """Returns the text before a brace, and where it begins: without access specifiers and parameters of a template."""
    while True:
        m = ACCESS.match(head) or TEMPLATE.match(head)
        if not m:
            break
        cut = m.end() if m.group().rstrip().endswith(":") else skip_angles(head, m.end() - 1)
        head, start = head[cut:], start + cut
    lead = len(head) - len(head.lstrip())
    return head.strip(), start + lead


def initialises_member(head):
    """True if a brace behind this head belongs to a member in a constructor's list, not to the function's body."""
    depth, colon = 0, False
    for n, c in enumerate(head):
        depth += {"(": 1, ")": -1}.get(c, 0)
        single = c == ":" and head[n - 1 : n] != ":" and head[n + 1 : n + 2] != ":"
        colon = colon or (single and depth == 0 and ")" in head[:n])
    return colon and re.search(r"[\w>]$", head) is not None


def functions(text):
    """(first line, number of lines) of each function, top to bottom; a lambda counts with what holds it."""
    code = bare(text)
    mark = re.compile(r"[;{}()]")
    start, n, depth = 0, 0, 0  # start of the declaration at hand; depth of round brackets
    while (m := mark.search(code, n)) is not None:
        n = m.end()
        c = m.group()
        if c in "()":
            depth += 1 if c == "(" else -1
        elif c == "{":
            head, first = declaration(code[start : m.start()], start)
            if depth == 0 and SCOPE.match(head) and "(" not in head:
                start = n
                continue
            end = closing(code, m.start())
            n = end + 1
            if depth > 0 or ")" not in head or initialises_member(head):
                code = code[: m.start()] + blank_braces(code[m.start() : n]) + code[n:]
                continue  # a value, or a member's: the declaration goes on
            line = code.count("\n", 0, first)
            yield line + 1, code.count("\n", 0, end) - line + 1
            start = n
        elif depth == 0:
            start = n


def blank_braces(piece):
    """Square brackets in place of the braces around a value, so that nothing takes it for a body."""
    return "[" + re.sub(r"[^\n]", " ", piece[1:-1]) + "]"
