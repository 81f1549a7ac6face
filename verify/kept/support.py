# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of kept data share: the folders, running programs, the verdict on a table."""
import os
import pathlib
import subprocess
import unittest

import changes
import compare

HERE = pathlib.Path(__file__).resolve().parent
MADE = sorted(path.parent for path in HERE.glob("*/scenes"))  # one folder for each commit that made data
# The program forces its files to disk, which takes longer than these analyses: in memory where the system has a folder.
MEMORY = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None
STATE = "state"  # the column of an entry that says a state is no longer read


def scenes(made):
    return sorted((made / "scenes").iterdir())


def run(command, **settings):
    """Exit code, standard output, standard error."""
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1", **settings.pop("environment", {})}
    done = subprocess.run([str(word) for word in command], env=environment, capture_output=True, text=True, check=False,
                          timeout=600, **settings)
    return done.returncode, done.stdout, done.stderr


def read(path):
    return path.read_text(encoding="utf-8")


class Kept(unittest.TestCase):
    """Differences from kept data are failures unless changes.json and CHANGELOG.md name them."""

    def expect_table(self, made, data, kept, found):
        """Both as texts of csv files."""
        kept, found = compare.table(kept), compare.table(found)
        self.assertEqual(compare.moved_columns(kept, found), [], f"{made.name} {data}")
        self.expect_named(made, data, compare.differences(kept, found))

    def expect_named(self, made, data, found):
        wrong = changes.judge(made.name, data, found, changes.entries(), changes.changelog())
        self.assertEqual(wrong, [], "\n" + "\n".join(wrong))

    def may_be_refused(self, made, data):
        """Whether an entry says that this state is of a format which is no longer read."""
        sentence = changes.of(made.name, data, changes.entries()).get(STATE)
        if sentence is not None:
            self.assertTrue(changes.named(sentence, changes.changelog()), f'CHANGELOG.md does not say "{sentence}"')
        return sentence is not None
