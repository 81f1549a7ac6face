# SPDX-License-Identifier: BSD-3-Clause
"""A wheel that holds the library, installed into an empty virtual environment: it loads its own libraries, computes
what the library of the build computes, and says its licences.

The environment is empty but for numpy, which pip would fetch and which is linked from the system here. Skipped without
venv, pip, patchelf or the library of the target delam_lgpl."""
import email
import importlib.util
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import zipfile

import support
import numpy as np

TOOLS = support.HERE.parent / "tools"
sys.path.insert(0, str(TOOLS))

import make_wheel  # noqa: E402

LIBRARY = os.environ.get("DELAM_LGPL", "")
READY = (os.path.exists(LIBRARY) and shutil.which("patchelf") and shutil.which("dpkg") and
         all(map(importlib.util.find_spec, ("venv", "ensurepip", "pip"))))
SCENE = """
import json, sys
sys.path.insert(0, sys.argv[1])
import numpy as np
import support, delam
history = delam.Solver(support.double_cantilever()).history(np.linspace(0.1, 1.0, 10))
brittle = delam.Solver(support.brittle_flexure(), not_converged="ignore").history(np.linspace(0.2, 2.0, 10))
maps = sorted({line.split(None, 5)[5].strip() for line in open("/proc/self/maps") if ".so" in line})
print(json.dumps({"location": delam.library_location(), "module": delam.__file__, "maps": maps,
                  "reaction": history["reaction:opening"].tolist(), "work": history["work"].tolist(),
                  "press": brittle["reaction:press"].tolist()}))
"""


def without(**more):
    """The environment without what could lead to another library."""
    kept = {name: value for name, value in os.environ.items()
            if not name.startswith(("DELAM", "PYTHON", "LD_", "PIP", "PKG_CONFIG", "VIRTUAL_ENV"))}
    return {**kept, "OPENBLAS_NUM_THREADS": "1", "PYTHONDONTWRITEBYTECODE": "1", **more}


@unittest.skipUnless(READY, "venv, pip, patchelf or the library of delam_lgpl is missing")
class Wheel(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.wheel = make_wheel.make(LIBRARY, cls.folder)
        subprocess.run([sys.executable, "-m", "venv", cls.folder / "env"], check=True, env=without())
        cls.python = cls.folder / "env" / "bin" / "python3"
        done = subprocess.run([cls.python, "-m", "pip", "install", "--no-index", "--no-deps", cls.wheel], text=True,
                              capture_output=True, env=without(HOME=str(cls.folder)), check=False)
        assert done.returncode == 0, done.stdout + done.stderr
        # The one thing that the environment takes from outside.
        (cls.folder / "numpy").mkdir()
        (cls.folder / "numpy" / "numpy").symlink_to(pathlib.Path(np.__file__).parent)
        cls.site = next((cls.folder / "env" / "lib").glob("python*/site-packages"))
        with zipfile.ZipFile(cls.wheel) as archive:
            cls.names = archive.namelist()
            cls.files = {name: archive.read(name) for name in cls.names}
        cls.info = next(name.split("/")[0] for name in cls.names if ".dist-info/" in name)

    def computed(self, python, **environment):
        done = subprocess.run([python, "-c", SCENE, support.HERE], capture_output=True, text=True, cwd=self.folder,
                              env=without(DELAM_TEST_INSTALLED="1", **environment), check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def test_it_computes_by_itself(self):
        ours = self.computed(self.python, PYTHONPATH=str(self.folder / "numpy"))
        self.assertTrue(ours["module"].startswith(str(self.site)), ours["module"])
        self.assertEqual(ours["location"], str(self.site / "delam" / "lib" / "libdelam.so.1"))
        held = {name.rsplit("/", 1)[1] for name in self.names if name.startswith("delam/lib/")}
        loaded = {pathlib.Path(path).name for path in ours["maps"] if path.startswith(str(self.site / "delam" / "lib"))}
        self.assertEqual(loaded, held)
        # numpy has a BLAS of its own; nothing else is the system's.
        strangers = [path for path in ours["maps"] if not path.startswith(str(self.folder)) and
                     re.search(r"delam|cholmod|metis|amd|suitesparse", pathlib.Path(path).name)]
        self.assertEqual(strangers, [])
        # The same library but for CHOLMOD's kernels: other roundings.
        tree = os.environ["DELAM_LIBRARY"]
        theirs = self.computed(sys.executable, DELAM_LIBRARY=tree, PYTHONPATH=str(support.SOURCES))
        self.assertEqual(theirs["location"], tree)
        for name in ("reaction", "work", "press"):
            np.testing.assert_allclose(ours[name], theirs[name], rtol=1e-8, atol=1e-9 * np.abs(theirs[name]).max())
        self.assertGreater(max(ours["reaction"]), 1e3)

    def test_what_it_needs_is_in_it_or_everywhere(self):
        held = {name.rsplit("/", 1)[1] for name in self.names if name.startswith("delam/lib/")}
        self.assertTrue({"libdelam.so.1", make_wheel.CHOLMOD} < held, held)
        for name in held:
            for other in make_wheel.needed(self.site / "delam" / "lib" / name):
                self.assertTrue(other in held or make_wheel.SYSTEM.match(other), f"{name} needs {other}")

    def test_licences(self):
        metadata = email.message_from_bytes(self.files[f"{self.info}/METADATA"])
        self.assertEqual(metadata["License-Expression"], "Apache-2.0 AND BSD-3-Clause AND GPL-3.0-or-later WITH "
                         "GCC-exception-3.1 AND LGPL-2.1-or-later")
        texts = metadata.get_all("License-File")
        self.assertEqual({f"{self.info}/licenses/{name}" for name in texts},
                         {name for name in self.names if "/licenses/" in name})
        self.assertTrue({"LICENSE", "libsuitesparse-dev.txt", "LGPL-2.1.txt", "GPL-3.txt"} <= set(texts), texts)
        self.assertIn(b"GNU LESSER GENERAL PUBLIC LICENSE", self.files[f"{self.info}/licenses/LGPL-2.1.txt"])
        for name in self.names:
            if name.startswith("delam/lib/"):
                self.assertIn(f"| {name.rsplit('/', 1)[1]} | ", metadata.get_payload())
        self.assertIn("Root-Is-Purelib: false\nTag: py3-none-linux_", self.files[f"{self.info}/WHEEL"].decode())

    def test_no_module_under_the_gpl(self):
        for name, data in self.files.items():
            self.assertIsNone(re.search(rb"cholmod_(super_\w+|updown|rowadd|sdmult|ssmult|drop)\.c", data), name)
        # Debian's library has them, and they would be seen.
        with self.assertRaisesRegex(make_wheel.WheelError, r"cholmod_\w+\.c, of CHOLMOD's GPL modules"):
            make_wheel.make(os.environ["DELAM_LIBRARY"], self.folder)

    def test_same_bytes_again(self):
        (self.folder / "again").mkdir()
        self.assertEqual(make_wheel.make(LIBRARY, self.folder / "again").read_bytes(), self.wheel.read_bytes())


if __name__ == "__main__":
    support.main()
