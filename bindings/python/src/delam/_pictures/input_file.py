# SPDX-License-Identifier: BSD-3-Clause
"""Files that are read: regular ones alone, for a pipe may wait for ever and a device may have no end; and none that is
larger than its reader allows. Both are refused before a byte is read. Standard library alone: the studies and the
pictures of the command line read with it as the package does."""
from __future__ import annotations

import array
import contextlib
import csv
import errno
import io
import json
import os
import stat
from collections.abc import Iterator
from typing import Any, BinaryIO

# In bytes, by what a file holds; bindings/cli/MANUAL.md, Limits, has the same.
MOST_SCENE = 16 << 20
MOST_MESH = 1 << 30  # a deck, without what it includes
MOST_CURVE = 64 << 20
MOST_RESULT = 64 << 20  # result.json
MOST_TABLE = 1 << 30  # history.csv, jumps.csv
MOST_SWEEP = 256 << 20  # sweep.json
LAST_WORDS = 1 << 20  # so much of a log is searched for its last message

# A byte of deflated data stands for at most so many bytes (https://zlib.net/zlib_tech.html); other filters that delam
# uses change no size.
MOST_INFLATED = 1032

SHOWN = 60  # characters of a text that a message quotes


class Unreadable(ValueError):
    """Why a file is not read; the text names it."""


def quoted(text: str) -> str:
    """A text within a message."""
    return f'"{text[:SHOWN]}..."' if len(text) > SHOWN else f'"{text}"'


def reason(error: OSError) -> str:
    """Returns the message of the system, or for too many open files the command that helps."""
    if error.errno in (errno.EMFILE, errno.ENFILE):
        return "too many open files: raise the limit with ulimit -n"
    return error.strerror or str(error)


def _require_regular(path: str, mode: int) -> None:
    kinds = ((stat.S_ISREG, ""), (stat.S_ISDIR, "a folder"), (stat.S_ISFIFO, "a pipe"), (stat.S_ISSOCK, "a socket"))
    kind = next((word for test, word in kinds if test(mode)), "a device")
    if kind:
        raise Unreadable(f"{path}: cannot be read: it is {kind}, and a regular file is expected")


def _opened(path: str) -> int:
    """A descriptor of a regular file. FileNotFoundError: there is none."""
    try:
        _require_regular(path, os.stat(path).st_mode)
        # Something else may have taken its place: a pipe must not wait here.
        descriptor = os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC)
    except FileNotFoundError:
        raise
    except (OSError, ValueError) as error:
        if isinstance(error, Unreadable):
            raise
        said = reason(error) if isinstance(error, OSError) else str(error)
        raise Unreadable(f"{path}: cannot be read: {said}") from None
    try:
        _require_regular(path, os.fstat(descriptor).st_mode)
    except BaseException:
        os.close(descriptor)
        raise
    return descriptor


class _Part(io.RawIOBase):
    """The bytes that a file had when it was opened; what is added later is not read."""

    def __init__(self, path: str, descriptor: int, left: int) -> None:
        super().__init__()
        self._path, self._file, self._left = path, os.fdopen(descriptor, "rb", buffering=0), left

    def readable(self) -> bool:
        return True

    def readinto(self, into: Any) -> int:
        try:
            got = self._file.readinto(memoryview(into)[:self._left]) or 0
        except OSError as error:
            raise Unreadable(f"{self._path}: cannot be read: {reason(error)}") from None
        self._left -= got
        return got

    def close(self) -> None:
        self._file.close()
        super().close()


def opened(path: str | os.PathLike[str], most: int) -> BinaryIO:
    """A regular file of at most so many bytes, for reading. Unreadable says what is wrong; FileNotFoundError: there is
    none."""
    name = os.fspath(path)
    descriptor = _opened(name)
    size = os.fstat(descriptor).st_size
    if size > most:
        os.close(descriptor)
        raise Unreadable(f"{name}: cannot be read: it has {size} bytes, and at most {most} are allowed")
    return io.BufferedReader(_Part(name, descriptor, size))


def read_bytes(path: str | os.PathLike[str], most: int) -> bytes:
    with opened(path, most) as file:
        return file.read()


def read_text(path: str | os.PathLike[str], most: int) -> str:
    """UTF-8, with or without a mark at its beginning."""
    try:
        return read_bytes(path, most).decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise Unreadable(f"{os.fspath(path)}: cannot be read: byte {error.start} is not UTF-8") from None


def read_end(path: str | os.PathLike[str], count: int) -> bytes:
    """The last bytes of a regular file of any size."""
    descriptor = _opened(os.fspath(path))
    with os.fdopen(descriptor, "rb") as file:
        file.seek(max(0, os.fstat(descriptor).st_size - count))
        return file.read(count)


def read_json(path: str | os.PathLike[str], most: int) -> dict[str, Any]:
    """The object that a file of JSON is."""
    name, text = os.fspath(path), read_text(path, most)
    try:
        found = json.loads(text)
    except RecursionError:
        raise Unreadable(f"{name}: lists and objects lie within each other too deeply") from None
    except ValueError as error:
        raise Unreadable(f"{name}: this is no JSON: {error}") from None
    if not isinstance(found, dict):
        raise Unreadable(f"{name}: one object of JSON is expected")
    return found


WORDS = ("solution", "mixity_rule", "name")  # columns of texts; all others are numbers


def read_columns(path: str | os.PathLike[str], most: int = MOST_TABLE
                 ) -> dict[str, array.array[float] | list[str]]:
    """The columns of a table with titles, by title: numbers, or the texts of WORDS."""
    name = os.fspath(path)
    with opened(path, most) as raw, io.TextIOWrapper(raw, encoding="utf-8", newline="") as file:
        lines = csv.reader(file)
        try:
            titles = next(lines, [])
            if not titles or len(set(titles)) < len(titles):
                raise Unreadable(f"{name}: a first line with titles, each another one, is expected")
            columns: list[array.array[float] | list[str]] = [[] if title in WORDS else array.array("d")
                                                             for title in titles]
            for row in lines:
                if len(row) != len(titles):
                    raise Unreadable(f"{name}:{lines.line_num}: {len(row)} columns: {len(titles)} are expected")
                for k, text in enumerate(row):
                    column = columns[k]
                    if isinstance(column, list):
                        column.append(text)
                        continue
                    try:
                        column.append(float(text))
                    except ValueError:
                        raise Unreadable(f"{name}:{lines.line_num}: {quoted(titles[k])}: {quoted(text)} is no number"
                                         ) from None
        except csv.Error as error:
            raise Unreadable(f"{name}:{lines.line_num}: {error}") from None
        except UnicodeDecodeError:
            raise Unreadable(f"{name}: cannot be read: it is not UTF-8") from None
    return dict(zip(titles, columns))


# ---- files of HDF5

_known: set[tuple[int, int, int, int]] = set()  # files of which all data sets are known to fit


def _require_own(path: str, file: Any, about: os.stat_result) -> None:
    """Refuses links, which may lead to pipes, devices and other people's files, and data sets that claim more than the
    file can hold."""
    import h5py
    key = (about.st_dev, about.st_ino, about.st_size, about.st_mtime_ns)
    if key in _known:
        return

    def visit(link: bytes, info: Any) -> str | None:
        name = quoted(link.decode("utf-8", "replace"))
        if info.type != h5py.h5l.TYPE_HARD:
            return f"{name} is a link, where delam writes none"
        data = h5py.h5o.open(file.id, link)
        if not isinstance(data, h5py.h5d.DatasetID):
            return None
        made = data.get_create_plist()
        if made.get_external_count() > 0 or made.get_layout() == h5py.h5d.VIRTUAL:
            return f"{name} lies in another file, where delam writes none"
        stored = data.get_storage_size()
        size = data.get_space().get_simple_extent_npoints() * data.get_type().get_size()
        if size > MOST_INFLATED * stored:
            return f"{name} claims {size} bytes, and the {stored} that are stored cannot stand for so many"
        return None

    found = file.id.links.visit(visit, info=True)
    if found is not None:
        raise Unreadable(f"{path}: {found}")
    _known.add(key)


@contextlib.contextmanager
def fields_file(path: str | os.PathLike[str]) -> Iterator[Any]:
    """A file of HDF5, open for reading. Unreadable: it is damaged, or not what delam writes."""
    import h5py
    name = os.fspath(path)
    descriptor = _opened(name)
    try:
        about = os.fstat(descriptor)
    finally:
        os.close(descriptor)
    try:
        with h5py.File(name, "r") as file:
            _require_own(name, file, about)
            yield file
    except OSError as error:
        said = reason(error) if error.errno in (errno.EMFILE, errno.ENFILE) else "it is damaged, or no file of HDF5"
        raise Unreadable(f"{name}: cannot be read: {said}") from None
