# SPDX-License-Identifier: BSD-3-Clause
"""Runs the blocks of a page in a folder of its own, in their order."""
import os
import pathlib
import shutil
import subprocess
import sys
import threading

from blocks import difference

SITE = pathlib.Path(__file__).resolve().parents[1]
ROOT = SITE.parents[1]
LINKS = ("bindings", "examples", "include")  # of the sources, as commands on the pages name them
LIMIT = 600

sys.path[:0] = [str(ROOT / "bindings/julia/tools"), str(ROOT / "verify/abi")]
import check_julia  # noqa: E402
import syntax  # noqa: E402


class Failure(Exception):
    """What a block did that its page does not say."""


def fortran_sources():
    """The modules of the binding, in the order of compilation."""
    text = (ROOT / "bindings/fortran/sources.cmake").read_text(encoding="utf-8")
    names = text[text.index("set(DELAM_FORTRAN_MODULES") + len("set(DELAM_FORTRAN_MODULES"):].split(")")[0].split()
    return [ROOT / "bindings/fortran/src" / f"{name}.f90" for name in names]


def write_pkgconfig(build, folder):
    """A delam.pc of the build folder, for programs that are compiled against it without installing it."""
    folder.mkdir(parents=True, exist_ok=True)
    sources = " ".join(map(str, fortran_sources()))
    (folder / "delam.pc").write_text(
        f"fortrandir={ROOT}/bindings/fortran/src\nfortransources={sources}\n\n"
        f"Name: delam\nDescription: of a build folder\nVersion: 0\n"
        f"Cflags: -I{ROOT}/include -I{ROOT}/bindings/cpp/include\n"
        f"Libs: -L{build}/lib -Wl,-rpath,{build}/lib -ldelam\n", encoding="utf-8")


MAKING = threading.Lock()  # groups of pages share the tools
MADE = set()


def make_tools(build, work):
    """Makes the programs once, before any group runs them."""
    with MAKING:
        if (build, work) in MADE and (work / "bin").is_dir():
            return
        tools = work / "bin"
        tools.mkdir(parents=True, exist_ok=True)
        program = tools / "delam"
        program.write_text(f'#!/bin/sh\nexec {build}/bin/delam "$@"\n', encoding="utf-8")
        program.chmod(0o755)
        python = tools / "python3"
        if not python.is_symlink():
            python.symlink_to("/usr/bin/python3")
        write_pkgconfig(build, work / "pkgconfig")
        MADE.add((build, work))


def environment(build, work):
    """Programs and libraries are those of the build folder, Python is Debian's."""
    make_tools(build, work)
    tools = work / "bin"
    return {"PATH": f"{tools}:/usr/local/bin:/usr/bin:/bin", "PKG_CONFIG_PATH": str(work / "pkgconfig"),
            "DELAM_LIBRARY": f"{build}/lib", "PYTHONPATH": str(ROOT / "bindings/python/src"),
            "PYTHONDONTWRITEBYTECODE": "1", "OPENBLAS_NUM_THREADS": "1", "MPLBACKEND": "Agg", "LC_ALL": "C.UTF-8",
            "HOME": str(work), "TERM": "dumb", **{key: os.environ[key] for key in ("OPENBLAS_CORETYPE",)
                                                  if key in os.environ}}


class Sandbox:
    """A folder in which blocks run."""

    def __init__(self, build, work, name):
        self.build, self.folder = build, work / "pages" / name
        self.environment = environment(build, work)
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)
        for link in LINKS:
            (self.folder / link).symlink_to(ROOT / link)
        self.skipped, self.absent, self.ran, self.printed = [], [], 0, None
        self.written = {}

    def call(self, command, block, given=None):
        done = subprocess.run(command, cwd=self.folder, env=self.environment, input=given, text=True, timeout=LIMIT,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        self.printed = done.stdout
        wanted = int(block.words.get("exit", 0))
        if done.returncode != wanted:
            raise Failure(f"{block.place}: ends with {done.returncode} instead of {wanted}:\n{done.stdout[-3000:]}")

    def write(self, block):
        """A file, which some later block must use; a scene is checked at once."""
        name = block.words.get("file") or block.words["add"]
        path = self.folder / name
        if path.resolve().parent != self.folder.resolve():
            raise Failure(f"{block.place}: {name} is not in the folder of the page")
        with open(path, "w" if "file" in block.words else "a", encoding="utf-8") as file:
            file.write(block.text)
        self.written[name] = block

    def run(self, block):
        """Runs or compares one block."""
        if "skip" in block.words:
            if len(block.words["skip"]) < 10:
                raise Failure(f"{block.place}: no reason for which it is skipped")
            self.skipped.append((block.place, block.words["skip"]))
            return
        self.ran += 1
        if "output" in block.words:
            self.compare(block)
        elif "file" in block.words or "add" in block.words:
            self.write(block)
            if block.language == "toml":
                self.call(["delam", "check", block.words.get("file") or block.words["add"]], block)
        elif block.language == "bash":
            self.call(["bash", "-euo", "pipefail", "-c", block.text], block)
            for name in [name for name in self.written if name in block.text]:
                del self.written[name]
        elif block.language == "python":
            self.call(["python3", "-"], block, block.text)
        elif block.language == "julia":
            self.parse_julia(block)
        else:
            raise Failure(f"{block.place}: a block of {block.language} that is neither a file nor an output")

    def compare(self, block):
        if self.printed is None:
            raise Failure(f"{block.place}: no block before it printed anything")
        differs = difference(block.text, self.printed)
        if differs:
            raise Failure(f"{block.place}: the page shows\n    {differs[0]}\nand the run prints\n    {differs[1]}")

    def parse_julia(self, block):
        """There is no Julia in Debian 12: the text is parsed, its names and calls are compared with the package."""
        try:
            folder = syntax.fetch(self.build / "bindings/julia/parser")
        except syntax.Unavailable as missing:
            self.ran -= 1
            self.absent.append((block.place, f"not parsed: {missing}"))
            return
        package = check_julia.package_files()
        trees = syntax.parse({**package, block.place: block.text}, folder)
        header = check_julia.public_header.read(check_julia.HEADER)
        wrong = [line for line in check_julia.Check(header, trees) if block.place in line]
        if wrong:
            raise Failure(f"{block.place}: the Julia program: {wrong[0]}")

    def finish(self):
        """Every program that a page shows is used by it; scenes have been checked."""
        for name, block in self.written.items():
            if block.language not in ("toml",):
                raise Failure(f"{block.place}: no later block uses {name}")
