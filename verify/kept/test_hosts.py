# SPDX-License-Identifier: BSD-3-Clause
"""Hosts in C with today's library: those compiled when the data were made, and the same sources compiled with today's
header. Both give the kept numbers, and go on from the kept states."""
import os
import pathlib
import platform
import sys
import unittest

import support
from support import MADE, read

LIBRARY = pathlib.Path(os.environ["DELAM_LIBRARY"]).resolve().parent
COMPILED = pathlib.Path(os.environ["DELAM_KEPT_HOSTS"])  # today: COMPILED/MADE/HOST
SKIPPED = 77


class Hosts(support.Kept):
    kept = False  # the programs compiled when the data were made

    def hosts(self):
        for made in MADE:
            for source in sorted(made.glob("hosts/*.c")):
                program = source.with_suffix("") if self.kept else COMPILED / made.name / source.stem
                with self.subTest(made=made.name, host=source.stem):
                    yield made, source, program

    def output(self, program, *words):
        return support.run([program, *words], environment={"LD_LIBRARY_PATH": str(LIBRARY)})

    def test_numbers(self):
        for made, source, program in self.hosts():
            code, said, error = self.output(program)
            self.assertEqual(code, 0, error)
            self.expect_table(made, f"hosts/{source.stem}", read(source.with_suffix(".csv")), said)

    def test_states(self):
        for made, source, program in self.hosts():
            data = f"hosts/{source.stem}/state"
            code, said, error = self.output(program, "load", source.with_suffix(".state"))
            if self.may_be_refused(made, data):
                self.assertTrue(code == 1 and "DELAM_ERROR_SNAPSHOT" in error, error)
                continue
            self.assertEqual(code, 0, error)
            titles, *rows = read(source.with_suffix(".csv")).splitlines()
            after = len(said.splitlines()) - 1
            self.assertTrue(0 < after < len(rows), f"{after} steps after the state")
            self.expect_table(made, data, "\n".join([titles, *rows[-after:]]), said)


def main():
    """Argument: kept, for the programs of then."""
    Hosts.kept = sys.argv[1:] == ["kept"]
    if Hosts.kept and (sys.platform, platform.machine()) != ("linux", "x86_64"):
        print(f"skipped: the kept programs are of Linux on x86-64, this is {sys.platform} on {platform.machine()}")
        return SKIPPED
    return 0 if unittest.main(argv=sys.argv[:1], exit=False).result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
