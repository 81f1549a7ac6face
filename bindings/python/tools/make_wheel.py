#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes a wheel that holds libdelam and what it needs beyond the C and C++ runtime, for pip in an empty environment:

    make_wheel.py --library build/release/lgpl/libdelam.so --out FOLDER

The library must be the one that the target delam_lgpl builds, without code under the GPL (src/package/lgpl.cmake). The
shared libraries that it needs get names of their own and find each other in their folder, so that they are neither
mistaken for those of the system nor of other packages. Their licences are those of the Debian packages that they come
from. Needs patchelf, binutils and dpkg."""
import argparse
import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "backend"))

import delam_build  # noqa: E402

# What every Linux with Python has; the list of PEP 600, as far as it is needed.
SYSTEM = re.compile(r"(ld-linux[-\w]*|libc|libm|libdl|librt|libpthread|libgcc_s|libstdc\+\+)\.so\.\d+$")
FOLDER = "lib"  # in the package, where _base/library.py looks
# Our own part of the wheel, and of what we have built of Debian's archives.
CHOLMOD = "libdelam-cholmod.so"
# SPDX expressions of what may come along, by the source package of Debian. A library of another one is refused:
# somebody has to read its licence first.
LICENCES = {"suitesparse": "LGPL-2.1-or-later AND BSD-3-Clause", "metis": "Apache-2.0", "openblas": "BSD-3-Clause",
            "gcc-12": "GPL-3.0-or-later WITH GCC-exception-3.1", "quadmath": "LGPL-2.1-or-later"}


class WheelError(Exception):
    """Why there is no wheel."""


def run(*words):
    try:
        return subprocess.run([str(word) for word in words], check=True, capture_output=True, text=True).stdout
    except FileNotFoundError:
        raise WheelError(f"{words[0]} is not installed") from None
    except subprocess.CalledProcessError as error:
        raise WheelError(f"{' '.join(map(str, words))}: {error.stderr.strip()}") from None


def needed(file):
    return re.findall(r"\(NEEDED\).*\[(.+)\]", run("readelf", "-d", file))


def resolved(file):
    """{name: path} of the libraries that the loader finds for a file, all in all."""
    found = dict(re.findall(r"^\s*(\S+) => (/\S+)", run("ldd", file), re.M))
    lost = re.findall(r"^\s*(\S+) => not found", run("ldd", file), re.M)
    if lost:
        raise WheelError(f"{file} needs {', '.join(lost)}, which the loader does not find")
    return found


def bundled(library):
    """{name: path} of what has to come along: all that the library needs, but for the system's."""
    paths, names, waiting = resolved(library), {}, needed(library)
    while waiting:
        name = waiting.pop()
        if name in names or SYSTEM.match(name):
            continue
        names[name] = pathlib.Path(paths[name]).resolve()
        waiting += needed(names[name])
    return dict(sorted(names.items()))


class Origin:
    """A Debian package: name, version, source package, its licence and texts."""

    def __init__(self, package):
        fields = run("dpkg-query", "-W", "-f=${Package}\t${Version}\t${source:Package}\t${source:Version}", package)
        self.package, self.version, self.source, self.source_version = fields.split("\t")
        self.texts = {f"{self.package}.txt": pathlib.Path(f"/usr/share/doc/{self.package}/copyright").read_bytes()}
        # Whole texts that the file refers to.
        for name in set(re.findall(rb"/usr/share/common-licenses/([\w.+-]*[\w+])", *self.texts.values())):
            path = pathlib.Path("/usr/share/common-licenses") / name.decode()
            if path.is_file():
                self.texts[f"{path.resolve().name}.txt"] = path.read_bytes()

    @classmethod
    def of(cls, file):
        """The package that a file is from."""
        # Files of the root folder and of /usr are the same, but dpkg may know them by the other name.
        for name in (str(file), str(file).removeprefix("/usr"), f"/usr{file}"):
            found = subprocess.run(["dpkg", "-S", name], capture_output=True, text=True, check=False)
            if found.returncode == 0:
                return cls(found.stdout.split(": ")[0])
        raise WheelError(f"{file} is in no Debian package, so that its licence is not known")

    def licence(self, name):
        key = "quadmath" if name.startswith("libquadmath") else self.source
        if key not in LICENCES:
            raise WheelError(f"{name} is from {self.source}, whose licence nobody has read yet (LICENCES)")
        return LICENCES[key]


def refuse_gpl(files):
    """The GPL modules of CHOLMOD name their files in messages: a library that holds them is not for this wheel."""
    for name, path in files.items():
        found = re.findall(rb"\w*cholmod_(?:super_numeric|updown|sdmult)\.c", path.read_bytes())
        if found:
            raise WheelError(f"{name} ({path}) holds {found[0].decode()}, of CHOLMOD's GPL modules: give --library the "
                             "one that the target delam_lgpl builds")


def gathered(library, work):
    """Copies into `work` with new names, which know each other: {name in the wheel: (path, path of the original)}."""
    files = bundled(library)
    refuse_gpl({library.name: library, **files})
    soname = re.search(r"\(SONAME\).*\[(.+)\]", run("readelf", "-d", library))[1]
    names = {}
    for name, path in files.items():
        stem, _, version = name.partition(".so")
        digest = hashlib.sha256(path.read_bytes()).hexdigest()[:8]
        names[name] = name if name == CHOLMOD else f"{stem}-{digest}.so{version}"
    result = {}
    for name, path, new in [(soname, library, soname), *((name, path, names[name]) for name, path in files.items())]:
        copy = work / new
        shutil.copyfile(path, copy)
        copy.chmod(0o755)
        run("strip", "--strip-unneeded", copy)
        # One change a call: patchelf 0.14 mixes up several.
        for change in (("--set-soname", new), ("--set-rpath", "$ORIGIN"),
                       *(("--replace-needed", old, names[old]) for old in needed(copy) if old in names)):
            run("patchelf", *change, copy)
        result[new] = copy, path
    return result


def newest(files, prefix):
    """The highest version of the symbols of a prefix that files ask for, "2.34" for instance."""
    found = {tuple(map(int, version.split("."))) for file in files
             for version in re.findall(rf"\({prefix}_([\d.]+)\)", run("objdump", "-T", file))}
    return ".".join(map(str, max(found))) if found else "0"


def described(files, origins):
    """The table of what the wheel holds, and from where."""
    rows = ["| file | from | source package | licence |", "|---|---|---|---|"]
    for name, origin in origins.items():
        if origin is None:
            rows.append(f"| {name} | this project | | BSD-3-Clause |")
        else:
            rows.append(f"| {name} | Debian {origin.package} {origin.version} "
                        f"| {origin.source} {origin.source_version} | {origin.licence(name)} |")
    paths = [path for path, _ in files.values()]
    return f"""
## Libraries in this wheel

This wheel holds libdelam and the shared libraries that it needs, in `delam/{FOLDER}`. It needs Linux with glibc
{newest(paths, "GLIBC")} and a libstdc++ with GLIBCXX_{newest(paths, "GLIBCXX")} or newer.

{chr(10).join(rows)}

`{CHOLMOD}` is made of CHOLMOD's modules Core, Check, Cholesky, Partition and CAMD (LGPL-2.1-or-later) and of
AMD, CAMD, COLAMD, CCOLAMD and SuiteSparse_config (BSD-3-Clause), as Debian has compiled them; CHOLMOD's modules under
the GPL are left out. You may replace it, and the other libraries, by versions of your own: put them into their place
under the same name.
The sources of all of them are in Debian's source packages named above (https://snapshot.debian.org); the texts of
their licences are in the folder `licenses` beside this file.
"""


def make(library, out):
    """Writes the wheel and returns its path."""
    library = pathlib.Path(os.path.realpath(library))
    with tempfile.TemporaryDirectory() as work:
        files = gathered(library, pathlib.Path(work))
        origins = {name: None if path == library else
                   Origin("libsuitesparse-dev") if name == CHOLMOD else Origin.of(path)
                   for name, (_, path) in files.items()}
        licences = {name: text for origin in origins.values() if origin for name, text in origin.texts.items()}
        kinds = sorted({part for name, origin in origins.items() if origin
                        for part in origin.licence(name).split(" AND ")} | {"BSD-3-Clause"})
        contents = {f"{FOLDER}/{name}": path.read_bytes() for name, (path, _) in files.items()}
        tag = sysconfig.get_platform().replace("-", "_").replace(".", "_")
        name = delam_build.build_binary_wheel(out, contents, tag, " AND ".join(kinds), licences,
                                              described(files, origins))
    return pathlib.Path(out) / name


def main():
    parser = argparse.ArgumentParser(description="a wheel that holds the library")
    parser.add_argument("--library", type=pathlib.Path, required=True, help="libdelam.so of the target delam_lgpl")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("."), help="folder of the wheel")
    words = parser.parse_args()
    words.out.mkdir(parents=True, exist_ok=True)
    try:
        wheel = make(words.library, words.out)
    except WheelError as error:
        sys.exit(f"make_wheel: {error}")
    print(f"{wheel} ({wheel.stat().st_size / 1e6:.1f} MB)")


if __name__ == "__main__":
    main()
