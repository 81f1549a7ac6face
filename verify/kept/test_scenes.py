# SPDX-License-Identifier: BSD-3-Clause
"""Kept scenes give today what they gave: every column of history.csv and jumps.csv, and what result.json says was
computed. With each kind of kernels of OpenBLAS that this processor has, the same: no scene stands at a tie that
rounding decides."""
import json
import os
import pathlib
import platform
import re
import tempfile
import unittest

import support
from compare import Difference, lost_keys, told_differences
from support import MADE, read, scenes

DELAM = os.environ["DELAM"]
# Kernels, and the flag of the processor that they need.
KERNELS = {"Prescott": "pni", "Sandybridge": "avx", "Haswell": "avx2", "SkylakeX": "avx512f"}


def kernels_here():
    try:
        flags = re.search(r"^flags\s*:(.*)$", read(pathlib.Path("/proc/cpuinfo")), re.MULTILINE)
    except OSError:
        flags = None
    held = set(flags.group(1).split()) if flags else set()
    return [{"OPENBLAS_CORETYPE": kernel} for kernel, flag in KERNELS.items() if flag in held]


class Scenes(support.Kept):
    def expect_as_kept(self, made, scene, environment):
        kept = made / "results" / scene.stem
        with tempfile.TemporaryDirectory(dir=support.MEMORY) as name:
            out = pathlib.Path(name)
            code, _, error = support.run([DELAM, "run", scene, "--out", out], environment=environment)
            self.assertEqual(code, 0, error)
            files = {path.name: read(path) for path in out.iterdir() if path.suffix in (".csv", ".json")}
        data = f"scenes/{scene.stem}"
        self.expect_table(made, data, read(kept / "history.csv"), files["history.csv"])
        jumps = kept / "jumps.csv"
        if jumps.exists() and "jumps.csv" in files:
            self.expect_table(made, data + "/jumps", read(jumps), files["jumps.csv"])
        elif jumps.exists():  # it has no jump today
            self.expect_named(made, data + "/jumps", [Difference("file", "kept, but there is none today")])
        before, today = json.loads(read(kept / "result.json")), json.loads(files["result.json"])
        self.assertEqual(lost_keys(before, today), [], f"{data}: result.json has lost keys")
        told = told_differences(before, today)
        if platform.machine() != "x86_64":  # it covers the last bits of weights, which other machines round otherwise
            told = [difference for difference in told if difference.column != "scene_hash"]
        self.expect_named(made, data + "/result", told)

    def test_as_kept(self):
        for environment in ({}, *kernels_here()):
            for made in MADE:
                for scene in scenes(made):
                    with self.subTest(made=made.name, scene=scene.stem, **environment):
                        self.expect_as_kept(made, scene, environment)


if __name__ == "__main__":
    unittest.main()
