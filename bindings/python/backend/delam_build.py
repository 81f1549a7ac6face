# SPDX-License-Identifier: BSD-3-Clause
"""Build backend of the package (PEP 517 and 660), in the standard library alone: an installation needs nothing from
anywhere.

The wheel that pip makes of the sources is pure Python; tools/make_wheel.py makes one that holds the library. Same
sources, same bytes: entries are sorted and carry a fixed date, or SOURCE_DATE_EPOCH."""
import base64
import gzip
import hashlib
import io
import os
import pathlib
import tarfile
import time
import tomllib
import zipfile

HERE = pathlib.Path(__file__).resolve().parent.parent
SOURCES = HERE / "src"
TAG = "py3-none-any"
# What an sdist takes along besides the sources.
TREES = ("backend", "notebooks", "src", "test", "tools")
FILES = ("pyproject.toml", "README.md", "LICENSE", "CMakeLists.txt")


def _project():
    with open(HERE / "pyproject.toml", "rb") as file:
        return tomllib.load(file)["project"]


def _date():
    return max(int(os.environ.get("SOURCE_DATE_EPOCH", 315532800)), 315532800)  # 1980, where zip files begin


def _licence():
    """Beside the package in an sdist, at the top of the repository otherwise."""
    return next((path for path in (HERE / "LICENSE", HERE.parents[1] / "LICENSE") if path.is_file()), None)


def _metadata(licence=(), notes=""):
    """licence: lines that say under which licences a wheel is that holds more than our code; notes: on what it
    holds."""
    project = _project()
    lines = [f"Metadata-Version: {'2.4' if licence else '2.1'}", f"Name: {project['name']}",
             f"Version: {project['version']}", f"Summary: {project['description']}",
             *(licence or [f"License: {project['license']['text']}"]), f"Requires-Python: {project['requires-python']}"]
    lines += [f"Requires-Dist: {requirement}" for requirement in project.get("dependencies", [])]
    for extra, requirements in project.get("optional-dependencies", {}).items():
        lines.append(f"Provides-Extra: {extra}")
        lines += [f'Requires-Dist: {requirement}; extra == "{extra}"' for requirement in requirements]
    readme = (HERE / project["readme"]).read_text(encoding="utf-8")
    return "\n".join([*lines, "Description-Content-Type: text/markdown", "", readme + notes]).encode()


def _name():
    project = _project()
    return f"{project['name']}-{project['version']}"


def _dist_info(tag=TAG, metadata=None):
    pure = str(tag == TAG).lower()
    wheel = f"Wheel-Version: 1.0\nGenerator: delam_build\nRoot-Is-Purelib: {pure}\nTag: {tag}\n"
    files = {"METADATA": metadata or _metadata(), "WHEEL": wheel.encode()}
    if _licence():
        files["LICENSE"] = _licence().read_bytes()
    return files


def _wheel(folder, contents, tag=TAG, metadata=None, licences=None):
    """Writes a wheel of {name in the archive: bytes}; RECORD comes last. licences: more texts, {name: bytes}."""
    contents = dict(sorted(contents.items()))
    info = f"{_name()}.dist-info"
    about = {**_dist_info(tag, metadata), **{f"licenses/{name}": data for name, data in (licences or {}).items()}}
    contents.update((f"{info}/{name}", data) for name, data in sorted(about.items()))
    record = []
    for name, data in contents.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        record.append(f"{name},sha256={digest},{len(data)}")
    contents[f"{info}/RECORD"] = "\n".join([*record, f"{info}/RECORD,,", ""]).encode()
    file = f"{_name()}-{tag}.whl"
    with zipfile.ZipFile(pathlib.Path(folder) / file, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in contents.items():
            entry = zipfile.ZipInfo(name, time.gmtime(_date())[:6])
            entry.external_attr = 0o100644 << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, data)
    return file


def _modules():
    return {path.relative_to(SOURCES).as_posix(): path.read_bytes()
            for pattern in ("*.py", "py.typed") for path in (SOURCES / "delam").rglob(pattern)}


def get_requires_for_build_wheel(config_settings=None):
    return []


get_requires_for_build_sdist = get_requires_for_build_wheel
get_requires_for_build_editable = get_requires_for_build_wheel


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    folder = pathlib.Path(metadata_directory) / f"{_name()}.dist-info"
    folder.mkdir()
    for name, data in _dist_info().items():
        (folder / name).write_bytes(data)
    return folder.name


prepare_metadata_for_build_editable = prepare_metadata_for_build_wheel


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    return _wheel(wheel_directory, _modules())


def build_binary_wheel(wheel_directory, files, tag, licence, licences, notes):
    """A wheel that holds the library. files: {name in the package: bytes}; tag: of the platform; licence: SPDX
    expression of all that it holds; licences: {name: text} of what is not ours; notes: Markdown for its description."""
    own = ["LICENSE"] if _licence() else []
    lines = [f"License-Expression: {licence}", *(f"License-File: {name}" for name in (*own, *sorted(licences)))]
    contents = {**_modules(), **{f"delam/{name}": data for name, data in files.items()}}
    texts = {**licences, **({"LICENSE": _licence().read_bytes()} if own else {})}
    return _wheel(wheel_directory, contents, f"py3-none-{tag}", _metadata(lines, notes), texts)


def build_editable(wheel_directory, config_settings=None, metadata_directory=None):
    return _wheel(wheel_directory, {"__editable__.delam.pth": f"{SOURCES}\n".encode()})


def build_sdist(sdist_directory, config_settings=None):
    contents = {name: (HERE / name).read_bytes() for name in FILES if (HERE / name).is_file()}
    if _licence():
        contents["LICENSE"] = _licence().read_bytes()
    for tree in TREES:
        for path in (HERE / tree).rglob("*"):
            if path.is_file() and "__pycache__" not in path.parts:
                contents[path.relative_to(HERE).as_posix()] = path.read_bytes()
    contents["PKG-INFO"] = _metadata()
    file = f"{_name()}.tar.gz"
    with (open(pathlib.Path(sdist_directory) / file, "wb") as raw,
          gzip.GzipFile("", "wb", mtime=_date(), fileobj=raw) as packed,
          tarfile.open(fileobj=packed, mode="w", format=tarfile.PAX_FORMAT) as archive):
        for name, data in sorted(contents.items()):
            entry = tarfile.TarInfo(f"{_name()}/{name}")
            entry.size, entry.mtime, entry.mode = len(data), _date(), 0o644
            archive.addfile(entry, io.BytesIO(data))
    return file
