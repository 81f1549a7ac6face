# SPDX-License-Identifier: BSD-3-Clause
"""Wheel, sdist, and how the library is found; test_long_package installs the package."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
import tomllib
import unittest
import zipfile

import support

PACKAGE = support.HERE.parent
LIBRARY = os.environ.get("DELAM_LIBRARY", "")
sys.path.insert(0, str(PACKAGE / "backend"))

import delam_build  # noqa: E402


class Backend(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_wheel(self):
        name = delam_build.build_wheel(self.folder)
        self.assertEqual(name, "delam-0.2.0-py3-none-any.whl")
        with zipfile.ZipFile(self.folder / name) as wheel:
            self.assertIsNone(wheel.testzip())
            names = wheel.namelist()
            record = wheel.read("delam-0.2.0.dist-info/RECORD").decode().splitlines()
            metadata = wheel.read("delam-0.2.0.dist-info/METADATA").decode()
        self.assertEqual({line.split(",")[0] for line in record}, set(names))
        modules = {path.relative_to(PACKAGE / "src").as_posix() for path in (PACKAGE / "src" / "delam").rglob("*.py")}
        self.assertEqual({name for name in names if name.startswith("delam/")}, modules | {"delam/py.typed"})
        self.assertIn("delam-0.2.0.dist-info/LICENSE", names)
        self.assertIn("\nRequires-Dist: numpy", metadata)
        self.assertIn('\nRequires-Dist: meshio; extra == "meshes"', metadata)
        first = (self.folder / name).read_bytes()
        delam_build.build_wheel(self.folder)
        self.assertEqual((self.folder / name).read_bytes(), first)

    def test_wheel_from_sdist_is_the_same(self):
        name = delam_build.build_sdist(self.folder)
        self.assertEqual(name, "delam-0.2.0.tar.gz")
        with tarfile.open(self.folder / name) as archive:
            archive.extractall(self.folder)
        root = self.folder / "delam-0.2.0"
        self.assertTrue((root / "PKG-INFO").is_file())
        subprocess.run([sys.executable, "-c", "import delam_build; delam_build.build_wheel('..')"],
                       cwd=root / "backend", check=True)
        (self.folder / "here").mkdir()
        wheel = delam_build.build_wheel(self.folder / "here")
        self.assertEqual((root / wheel).read_bytes(), (self.folder / "here" / wheel).read_bytes())

    def test_one_version(self):
        project = tomllib.loads((PACKAGE / "pyproject.toml").read_text(encoding="utf-8"))["project"]
        top = re.search(r"project\(delam VERSION ([\d.]+)",
                        (support.ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))[1]
        import delam
        self.assertEqual((project["version"], delam.__version__, delam.library_version()), (top, top, top))


def without_library(**more):
    """An environment in which nothing tells where the library is."""
    environment = {name: value for name, value in os.environ.items()
                   if name not in ("DELAM_LIBRARY", "LD_LIBRARY_PATH", "PYTHONPATH", "PKG_CONFIG_PATH")}
    return {**environment, "PYTHONDONTWRITEBYTECODE": "1", "PKG_CONFIG_LIBDIR": "/nowhere", **more}


def location(python, folder, **environment):
    """Where an interpreter finds the library, or what it says instead."""
    done = subprocess.run([python, "-c", "import delam; print(delam.library_location())"], cwd=folder,
                          capture_output=True, text=True, env=without_library(**environment))
    return done.stdout.strip() if done.returncode == 0 else done.stderr.strip()


@unittest.skipUnless(LIBRARY, "DELAM_LIBRARY is not set")
class Finding(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.place = pathlib.Path(cls.folder.name)
        shutil.copytree(PACKAGE / "src" / "delam", cls.place / "delam", ignore=shutil.ignore_patterns("__pycache__"))
        library = pathlib.Path(LIBRARY)
        cls.file = next(library.glob("libdelam.so.1")) if library.is_dir() else library
        cls.installed = cls.place / "installed"
        cls.installed.mkdir()
        (cls.installed / "libdelam.so.1").symlink_to(cls.file.resolve())

    def find(self, **environment):
        return location(sys.executable, self.place, **environment)

    def test_variable(self):
        self.assertEqual(self.find(DELAM_LIBRARY=str(self.file)), str(self.file))
        self.assertEqual(self.find(DELAM_LIBRARY=str(self.installed)), str(self.installed / "libdelam.so.1"))

    def test_variable_is_not_overruled(self):
        words = self.find(DELAM_LIBRARY="/nowhere/libdelam.so.1", LD_LIBRARY_PATH=str(self.installed))
        self.assertRegex(words, "ImportError: libdelam was not found(.|\n)*DELAM_LIBRARY: /nowhere/libdelam.so.1")

    def test_next_to_the_package(self):
        (self.place / "delam" / "lib").mkdir()
        beside = self.place / "delam" / "lib" / "libdelam.so.1"
        beside.symlink_to(self.file.resolve())
        try:
            self.assertEqual(self.find(), str(beside))
        finally:
            beside.unlink()
            beside.parent.rmdir()

    def test_loader(self):
        self.assertEqual(self.find(LD_LIBRARY_PATH=str(self.installed)), "libdelam.so.1")

    @unittest.skipUnless(shutil.which("pkg-config"), "pkg-config is not installed")
    def test_pkg_config(self):
        (self.place / "delam.pc").write_text(f"libdir={self.installed}\nName: delam\nDescription: -\nVersion: 1\n",
                                             encoding="utf-8")
        self.assertIn(self.find(PKG_CONFIG_LIBDIR=str(self.place)),
                      (str(self.installed / "libdelam.so.1"), "libdelam.so.1"))

    def test_what_is_no_library_of_ours(self):
        import ctypes.util
        other = ctypes.util.find_library("m")
        self.assertIn("is no libdelam: it has no function delam_abi", self.find(DELAM_LIBRARY=other))

    @unittest.skipUnless(shutil.which("cc"), "there is no C compiler")
    def test_another_abi_and_missing_functions(self):
        for abi, words in ((7, "has ABI 7, this package needs 1"),
                           (1, "is libdelam 0.0.1 without delam_commit, delam_status_name")):
            source, library = self.place / "other.c", self.place / "other.so"
            source.write_text(f"int delam_abi(void) {{ return {abi}; }}\n"
                              'const char *delam_version(void) { return "0.0.1"; }\n', encoding="utf-8")
            subprocess.run(["cc", "-shared", "-fPIC", "-o", str(library), str(source)], check=True)
            self.assertIn(words, self.find(DELAM_LIBRARY=str(library)))


if __name__ == "__main__":
    support.main()
