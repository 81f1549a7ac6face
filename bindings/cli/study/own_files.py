# SPDX-License-Identifier: BSD-3-Clause
"""Files of studies: whose they are says the program (delam own), and they are written whole or not at all."""
import contextlib
import os
import subprocess

from analyses import OUTPUT, Trouble, hold, program

NEW = os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW | os.O_CLOEXEC


def _own(*words):
    done = subprocess.run([program(), "own", *words], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                          errors="replace", check=False)
    if done.returncode != 0:
        raise Trouble(done.stderr.strip().removeprefix("delam: ") or f"{program()} own: exit code {done.returncode}",
                      done.returncode)


def claim(folder, names, known):
    """Marks a folder, which is made, as the study's. Names of files or folders that the study writes: if one of them is
    there, and neither a marker nor `known` says whose it is, the folder is refused. Links always are."""
    there = [name for name in names if os.path.lexists(os.path.join(folder, name))]
    _own("claim", folder, *there, *(["--known"] if known else []))


def discard(folders):
    """Removes folders of results; none of them if one holds anything else."""
    if folders:
        _own("discard", *folders)


def open_new(path):
    """A file that was not there, for text, and its name: PATH.new, with a number where something has this name."""
    for k in range(1000):  # left behind by studies that were killed, each of them one
        name = path + ".new" + (f"-{k}" if k else "")
        try:
            return os.fdopen(os.open(name, NEW, 0o666), "w", encoding="utf-8"), name
        except FileExistsError:
            continue
        except OSError as error:
            raise Trouble(f"cannot write {name}: {error.strerror}", OUTPUT) from error
    raise Trouble(f"cannot write {path}: 1000 files named {path}.new-K are in the way", OUTPUT)


def write_file(path, text):
    """Beside and renamed: whole or not at all."""
    file, name = open_new(path)
    try:
        with file:
            file.write(text)
        os.replace(name, path)
    except OSError as error:
        os.unlink(name)
        raise Trouble(f"cannot write {path}: {error.strerror}", OUTPUT) from error


@contextlib.contextmanager
def owned(folder, names, others=()):
    """The folder of a study while it writes these files there. others: files of another kind of study, which these replace."""
    held = hold(folder)
    try:
        claim(folder, [*names, *others], False)
        yield
        for name in others:
            with contextlib.suppress(FileNotFoundError):
                os.unlink(os.path.join(folder, name))
    finally:
        with contextlib.suppress(OSError):
            os.unlink(os.path.join(folder, "study.lock"))
        held.close()
