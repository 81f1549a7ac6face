# SPDX-License-Identifier: BSD-3-Clause
"""What the tests share: where the package is, the exit code of a skipped test, the end-notched flexure scene."""
import os
import pathlib
import sys
import unittest

HERE = pathlib.Path(__file__).resolve().parent
SOURCES = HERE.parent / "src"
ROOT = HERE.parents[2]
SKIPPED = 77

# One thread of the linear algebra in all hosts: only then are equal digits a claim about the hosts.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
if not os.environ.get("DELAM_TEST_INSTALLED"):
    sys.path.insert(0, str(SOURCES))


def main():
    """Runs the tests of the calling file; exit code 77 where one was skipped and none failed, with the reason."""
    program = unittest.main(exit=False)
    if not program.result.wasSuccessful():
        sys.exit(1)
    if program.result.skipped:
        for test, reason in program.result.skipped:
            print(f"skipped: {test}: {reason}")
        sys.exit(SKIPPED)
