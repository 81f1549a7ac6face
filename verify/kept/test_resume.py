# SPDX-License-Identifier: BSD-3-Clause
"""Runs that were interrupted when the data were made go on today, to the kept end; or, where changes.json and
CHANGELOG.md say that their state is no longer read, the program refuses and says why."""
import os
import pathlib
import shutil
import tempfile
import unittest

import support
from support import MADE, read, scenes

DELAM = os.environ["DELAM"]


class Resume(support.Kept):
    def resumed(self, made, name, out):
        scene = next(path for path in scenes(made) if path.stem == name)
        shutil.copytree(made / "interrupted" / name, out)
        return support.run([DELAM, "run", scene, "--out", out, "--resume"])

    def expect_end(self, made, name):
        data = f"interrupted/{name}"
        begun = read(made / data / "running" / "history.csv").splitlines()
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder) / "result"
            code, said, error = self.resumed(made, name, out)
            if self.may_be_refused(made, data):
                self.assertEqual((code, "run again without --resume" in error), (2, True), f"exit code {code}: {error}")
                return
            self.assertEqual(code, 0, error)
            self.assertIn(f"resumed after step {len(begun) - 2}\n", said)
            history = read(out / "history.csv")
        kept = read(made / "results" / name / "history.csv")
        self.assertTrue(1 < len(begun) < len(kept.splitlines()), "the run was interrupted on its way")
        self.expect_table(made, data, kept, history)

    def test_to_the_kept_end(self):
        for made in MADE:
            for path in sorted((made / "interrupted").iterdir()):
                with self.subTest(made=made.name, run=path.name):
                    self.expect_end(made, path.name)

    def test_another_format(self):
        """A state of a format that no version wrote: refused with a sentence, and the state stays."""
        made = MADE[0]
        name = sorted(path.name for path in (made / "interrupted").iterdir())[0]
        with tempfile.TemporaryDirectory() as folder:
            copy = pathlib.Path(folder) / "made"
            shutil.copytree(made, copy)
            state = copy / "interrupted" / name / "running" / "state.bin"
            state.write_bytes(state.read_bytes().replace(b"delam state 3", b"delam state 9", 1))
            out = pathlib.Path(folder) / "result"
            code, _, error = self.resumed(copy, name, out)
            self.assertEqual((code, "of another version" in error), (2, True), f"exit code {code}: {error}")
            self.assertEqual((out / "running" / "state.bin").read_bytes(), state.read_bytes())


if __name__ == "__main__":
    unittest.main()
