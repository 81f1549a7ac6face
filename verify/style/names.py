# SPDX-License-Identifier: BSD-3-Clause
"""Checks with pyflakes that no Python file of the tree uses a name that nothing defines, and that none imports or sets one
that nothing uses. A line with `noqa` is left out.

    python3 verify/style/names.py
"""
import pathlib
import sys

import pyflakes.api

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Reporter:
    """Collects what pyflakes finds."""

    def __init__(self, text):
        self.lines = text.splitlines()
        self.found = []

    def unexpectedError(self, filename, message):
        self.found.append(f"{filename}: {message}")

    def syntaxError(self, filename, message, line, _offset, _text):
        self.found.append(f"{filename}:{line}: {message}")

    def flake(self, message):
        if "noqa" not in self.lines[message.lineno - 1]:
            self.found.append(str(message))


def findings(text, name):
    """What is wrong in one text."""
    reporter = Reporter(text)
    pyflakes.api.check(text, name, reporter)
    return reporter.found


def main():
    files = sorted(f for folder in ("src", "bindings", "verify", "examples") for f in (ROOT / folder).rglob("*.py"))
    found = [f for file in files for f in findings(file.read_text(encoding="utf-8"), str(file))]
    print("\n".join(found))
    print(f"{len(files)} files, {len(found)} findings")
    return 1 if found or not files else 0


if __name__ == "__main__":
    sys.exit(main())
