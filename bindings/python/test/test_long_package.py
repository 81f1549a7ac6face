# SPDX-License-Identifier: BSD-3-Clause
"""Installation in a virtual environment without network: pip alone takes seconds, so the long tier runs it.

Skipped without venv and pip (Debian: python3-venv, python3-pip)."""
import importlib.util
import pathlib
import subprocess
import sys
import tempfile
import unittest

import support
from test_package import LIBRARY, PACKAGE, location, without_library


@unittest.skipUnless(LIBRARY, "DELAM_LIBRARY is not set")
@unittest.skipUnless(all(map(importlib.util.find_spec, ("venv", "ensurepip", "pip"))), "venv and pip are not installed")
class Installed(unittest.TestCase):
    def test_pip_in_a_virtual_environment(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            # No index and no proxy that works: whatever reaches for the network fails.
            offline = without_library(PIP_NO_INDEX="1", PIP_DISABLE_PIP_VERSION_CHECK="1",
                                      https_proxy="http://127.0.0.1:9", http_proxy="http://127.0.0.1:9",
                                      HOME=str(folder), PIP_ROOT_USER_ACTION="ignore")
            subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", str(folder / "env")], check=True)
            python = folder / "env" / "bin" / "python3"
            before = sorted(PACKAGE.rglob("*"))
            done = subprocess.run([folder / "env" / "bin" / "pip", "install", str(PACKAGE)], capture_output=True,
                                  text=True, env=offline)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertEqual([path for path in sorted(PACKAGE.rglob("*")) if "__pycache__" not in path.parts],
                             [path for path in before if "__pycache__" not in path.parts],
                             "the sources were written to")
            self.assertEqual(location(python, folder, DELAM_LIBRARY=LIBRARY), LIBRARY)
            shown = subprocess.run([python, "-c", "import delam; print(delam.__file__)"], capture_output=True,
                                   text=True, check=True, cwd=folder, env=without_library(DELAM_LIBRARY=LIBRARY))
            self.assertTrue(shown.stdout.startswith(str(folder / "env")), shown.stdout)
            csv = folder / "enf.csv"
            subprocess.run([python, support.ROOT / "examples" / "enf" / "enf.py", csv], check=True, cwd=folder,
                           env=without_library(DELAM_LIBRARY=LIBRARY))
            self.assertEqual(len(csv.read_text(encoding="utf-8").splitlines()), 42)
            removed = subprocess.run([python, "-m", "pip", "uninstall", "-y", "delam"], capture_output=True, text=True,
                                     env=offline)
            self.assertEqual(removed.returncode, 0, removed.stderr)
            self.assertIn("No module named 'delam'", location(python, folder, DELAM_LIBRARY=LIBRARY))


if __name__ == "__main__":
    support.main()
