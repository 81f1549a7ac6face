# SPDX-License-Identifier: BSD-3-Clause
"""Finds and loads libdelam. In this order:

1. the environment variable DELAM_LIBRARY, a file or a folder; if it is set, nothing else is tried
2. next to this package (delam/libdelam.so.N, delam/lib/libdelam.so.N)
3. the loader's paths: LD_LIBRARY_PATH, ldconfig
4. pkg-config's libdir of delam
"""
from __future__ import annotations

import ctypes
import ctypes.util
import os
import pathlib
import subprocess
from collections.abc import Iterator

from . import raw

SONAME = f"libdelam.so.{raw.DELAM_ABI}"
VARIABLE = "DELAM_LIBRARY"


def _from_variable(value: str) -> str:
    path = pathlib.Path(value)
    if path.is_dir():
        path = next((path / name for name in (SONAME, "libdelam.so") if (path / name).exists()), path / SONAME)
    return str(path)


def _pkg_config() -> str | None:
    try:
        found = subprocess.run(["pkg-config", "--variable=libdir", "delam"], capture_output=True, text=True,
                               check=False)
    except OSError:
        return None
    folder = found.stdout.strip()
    return str(pathlib.Path(folder) / SONAME) if found.returncode == 0 and folder else None


def _candidates() -> Iterator[tuple[str, str]]:
    """Names to try, each with a description of its origin."""
    package = pathlib.Path(__file__).resolve().parents[1]
    for beside in (package / SONAME, package / "lib" / SONAME):
        if beside.exists():
            yield str(beside), "next to the package"
    yield SONAME, "the loader's paths"
    name = ctypes.util.find_library("delam")
    if name and name != SONAME:
        yield name, "ldconfig"
    path = _pkg_config()
    if path:
        yield path, "pkg-config"


def load() -> tuple[ctypes.CDLL, str]:
    """The library with typed functions, and its path; ImportError lists what was tried."""
    tried = []
    candidates: list[tuple[str, str]] | Iterator[tuple[str, str]]
    if os.environ.get(VARIABLE):
        candidates = [(_from_variable(os.environ[VARIABLE]), VARIABLE)]
    else:
        candidates = _candidates()
    for path, where in candidates:
        try:
            library = ctypes.CDLL(path)
        except OSError as error:
            tried.append(f"{where}: {error}")
            continue
        return _checked(library, path), path
    raise ImportError(f"libdelam was not found. Set {VARIABLE} to {SONAME} or to its folder, or install it where the "
                      f"loader looks. Tried:\n  " + "\n  ".join(tried))


def _checked(library: ctypes.CDLL, path: str) -> ctypes.CDLL:
    missing = raw.bind(library)
    if "delam_abi" in missing:
        raise ImportError(f"{path} is no libdelam: it has no function delam_abi")
    abi = library.delam_abi()
    if abi != raw.DELAM_ABI:
        raise ImportError(f"{path} has ABI {abi}, this package needs {raw.DELAM_ABI}: install matching versions")
    if missing:
        version = library.delam_version().decode()
        raise ImportError(f"{path} is libdelam {version} without {', '.join(missing)}: it is older than this package")
    return library


library, location = load()
