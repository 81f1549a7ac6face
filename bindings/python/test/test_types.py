# SPDX-License-Identifier: BSD-3-Clause
"""mypy --strict accepts the package, and sees in a host's program what the hints forbid. Skipped without mypy (Debian:
mypy)."""
import importlib.util
import pathlib
import subprocess
import sys
import tempfile
import unittest

import support

HOST = '''import delam

mesh = delam.Mesh.layers(0.1, 50, [1.5e-3, 1.5e-3], [1, 1])
glue: delam.Interface = mesh.add_interface(0, 1)
problem = delam.Problem(mesh)
opening = problem.add_pattern("opening", [0, 1], [0, 6e-3])
problem.prescribe(mesh.find_node((0, 3e-3)), "y", {opening: 0.5})
solver = delam.Solver(problem)
state: bytes = solver.save()
peak: float = float(solver.history([0.5, 1.0])["reaction:opening"].max())
reveal_type(solver.field("traction", glue))
'''
WRONG = {'mesh.add_interface(0.5, "upper")': "arg-type", 'problem.prescribe(0, "y", 0)': "arg-type",
         "solver.save('state.bin').hex()": "attr-defined",
         "glue.pairs": "attr-defined", "solver.advance()": "call-arg"}


@unittest.skipUnless(importlib.util.find_spec("mypy"), "mypy is not installed")
class Checked(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)

    def mypy(self, *words):
        return subprocess.run([sys.executable, "-m", "mypy", "--strict", "--config-file",
                               support.HERE.parent / "pyproject.toml", "--cache-dir", self.folder / "cache", *words],
                              capture_output=True, text=True, cwd=support.SOURCES, check=False)

    def test_the_package(self):
        done = self.mypy("-p", "delam")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertRegex(done.stdout, r"^Success: no issues found in \d+ source files")

    def test_a_program(self):
        file = self.folder / "host.py"
        file.write_text(HOST + "\n".join(WRONG) + "\n", encoding="utf-8")
        done = self.mypy(str(file))
        self.assertIn('Revealed type is "numpy.ndarray[Any, numpy.dtype[numpy.floating[', done.stdout)
        lines = [line for line in done.stdout.splitlines() if ": error: " in line]
        first = len(HOST.splitlines()) + 1
        for number, (call, kind) in enumerate(WRONG.items(), first):
            found = [line for line in lines if f"host.py:{number}:" in line]
            self.assertTrue(found and any(f"[{kind}]" in line for line in found), f"{call}: {done.stdout}")
        self.assertEqual([line for line in lines if int(line.split(":")[1]) < first], [])


if __name__ == "__main__":
    support.main()
