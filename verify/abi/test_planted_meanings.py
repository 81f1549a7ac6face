#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""test_planted_meanings.py SOURCE_FOLDER LIBRARY [quick]: the table of meanings is only seen at work at a break.

Each break of meaning/planted.py gives one argument, result or default another meaning on its way to the library or
back; the library's words about itself stay as they are. The row that BREAKS names must see it; by default the whole
table runs, and each line says which rows saw the break, with `quick` only the row named. Then breaks of the table's completeness: a new
function with an array, a new option, a default in the header that changes, a row that does not pass what it claims.
"""
import os
import re
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE]
import header as headers  # noqa: E402
import meanings  # noqa: E402
import table  # noqa: E402
from host import Missing  # noqa: E402
from planted import BREAKS, PlantedHost  # noqa: E402


class Test:
    def __init__(self, source, library, work, quick):
        self.quick, self.work, self.failures, self.checks = quick, work, [], 0
        self.header_path = os.path.join(source, "include", "delam", "delam.h")
        self.header = headers.read(self.header_path)
        self.baseline = table.read_baseline(meanings.BASELINE)
        self.library = library
        self.table = self.new_table()
        self.table.host = PlantedHost(self.header, self.table.host.library)

    def new_table(self, past=False):
        return meanings.Table(self.library, self.header, self.baseline, past)

    def failed(self, rows):
        """Lines of the rows that fail."""
        self.table.failures, self.table.numbers = [], {}
        self.table.rows(rows)
        return self.table.failures

    def expect(self, what, lines, message=None):
        """message: a regular expression that one of the lines must hold; None: there must be no line."""
        self.checks += 1
        if message is None and lines:
            self.failures.append(f"{what}: must pass: {lines[0]}")
        elif message is not None and not any(re.search(message, line) for line in lines):
            self.failures.append(f"{what}: nothing says '{message}': {lines[:3]}")

    # ---- meanings ----
    def meanings(self):
        rows = table.ROWS
        self.expect("no break", self.failed(rows))
        for what, (named, change) in BREAKS.items():
            self.table.host.planted = change
            lines = self.failed([row for row in rows if row.name == named or not self.quick])
            self.table.host.planted = {}
            seen = sorted({row.name for row in rows for line in lines if line.startswith(row.name + ": ")})
            if not self.quick:
                print(f"{what}: seen by {', '.join(seen) or 'nothing'}")
            self.expect(what, lines, "^" + re.escape(named) + ": ")
        self.expect("no break any more", self.failed(rows))

    # ---- completeness ----
    def gaps(self, edit=None, rows=None):
        header = self.header
        if edit is not None:
            with open(self.header_path, encoding="utf-8") as file:
                text = file.read()
            changed = edit(text)
            if changed == text:
                self.failures.append("an edit of the header changes nothing")
            path = os.path.join(self.work, "delam.h")
            with open(path, "w", encoding="utf-8") as file:
                file.write(changed)
            header = headers.read(path)
        host = meanings.Host(header, self.table.host.library)
        return list(meanings.gaps(header, host, table.ROWS if rows is None else rows))

    def completeness(self):
        self.expect("the table is complete", self.gaps())
        declared = ("/* Twists a mesh by angles: [count].\n"
                    " * [unit angles rad finite; null none; status argument; since 0.2] */\n"
                    "DELAM_API int32_t delam_mesh_twist(delam_mesh *mesh, int64_t count, const double *angles);\n")
        self.expect("a new function", self.gaps(lambda text: text.replace("/* Destroys a mesh;", declared +
                                                                          "/* Destroys a mesh;", 1)),
                    "^delam_mesh_twist: angles: no row of the table")
        self.expect("another default in words",
                    self.gaps(lambda text: text.replace("0 selects 1e-6", "0 selects 1e-3")),
                    "^delam_mesh_add_interface: .*0 selects 1e-3.* no row of the table")
        self.expect("a default in words that is gone",
                    self.gaps(lambda text: text.replace("0 selects 1e-6", "the least is 1e-6")),
                    "^'mesh_add_interface: 0 selects 1e-6': in the table, not in the header")
        called = ("/* Told of heat.\n * [null user; status -; thread call's; since 0.2] */\n"
                  "typedef void (*delam_heat_callback)(int32_t cell, void *user);\n")
        self.expect("a new callback", self.gaps(lambda text: text.replace("/* Creates a context", called +
                                                                          "/* Creates a context", 1)),
                    "^delam_heat_callback: no row of the table tells what it is given")
        self.expect("a new field", self.gaps(lambda text: text.replace(
            " *   reaction      [constraints][1]", " *   heat          [nodes][1]            F: heat\n"
            " *   reaction      [constraints][1]")), "^field heat: no row of the table")
        described = meanings.keys.described
        meanings.keys.described = lambda *of: {**described(*of), "novelty": None}
        self.expect("a new option", self.gaps(), "^option novelty: no row of the table observes its default")
        meanings.keys.described = described
        without = [row for row in table.ROWS if row.name != "nine constants"]
        self.expect("a row that is gone", self.gaps(rows=without),
                    "^delam_problem_set_orthotropic: constants: no row of the table")
        idle = table.Row("idle", lambda host, see: None, ["problem_set_orthotropic constants"], [], [])
        self.expect("a row that claims what it does not use", self.failed([idle]),
                    "^idle: claims delam_problem_set_orthotropic constants, but does not use it")

    # ---- past releases ----
    def past(self):
        """A library without a function and without an option: left out if it is older than they are."""
        rows = [row for row in table.ROWS if row.name in ("nine constants", "gluing")]
        for version, message in ("0.0", None), ("0.1", "^nine constants: .*set_orthotropic: the library does not have"):
            old = self.new_table(past=True)
            own = old.host._function
            old.host._function = lambda name, own=own: refuse(name) if name.endswith("orthotropic") else own(name)
            old.version = lambda version=version: tuple(int(n) for n in version.split("."))
            options = old.options()
            old.options = lambda options=options: options - {"gluing"}
            old.rows(rows)
            self.expect(f"a past release {version} without a function", old.failures, message)
            self.expect(f"a past release {version} without an option", old.left_out, "^gluing: no option gluing")
        other = dict(self.baseline)
        unit, numbers = other[("nine constants", "stress")]
        other[("nine constants", "stress")] = (unit, numbers[:4] + numbers[5:3:-1])
        moved = meanings.Table(self.library, self.header, other)
        moved.rows(rows)
        self.expect("another number in the baseline", moved.failures,
                    r"^nine constants: stress\[4\] is .*in the baseline")


def refuse(name):
    raise Missing(name)


def main():
    with tempfile.TemporaryDirectory() as work:
        test = Test(sys.argv[1], sys.argv[2], work, sys.argv[3:] == ["quick"])
        test.meanings()
        test.completeness()
        test.past()
    for failure in test.failures:
        print(failure)
    print(f"{test.checks} planted checks of meanings, {len(test.failures)} failures")
    sys.exit(1 if test.failures else 0)


if __name__ == "__main__":
    main()
