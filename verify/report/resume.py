# SPDX-License-Identifier: BSD-3-Clause
"""A report that was interrupted: what it was of, what of it counts, and whether another run may go on with it."""
from __future__ import annotations

import contextlib
import fcntl
import hashlib
import json
import os
import pathlib
import shutil
import subprocess

import case
from whole import UNFINISHED, write_json

RECORD = "run.json"  # in the folder of the new report, from its beginning until it is published


class Refused(Exception):
    """Why a report may not be begun or resumed."""


@contextlib.contextmanager
def alone(out: pathlib.Path):
    """Refuses a second report in the same folder while one is being made; the system ends this with the process."""
    out.mkdir(parents=True, exist_ok=True)
    folder = os.open(out, os.O_RDONLY | os.O_DIRECTORY)
    try:
        lock(folder, out)
        yield
    finally:
        os.close(folder)


def lock(folder: int, out: pathlib.Path) -> None:
    try:
        fcntl.flock(folder, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError as error:
        raise Refused(f"another report is being made in {out}; wait for its end or choose another folder (--out)"
                      ) from error
    except OSError:
        pass  # a file system without locks


def changes(root: pathlib.Path, cases: pathlib.Path) -> str:
    """A digest of the cases and of what git does not have of the sources; without the past, which --accept writes."""
    digest = hashlib.sha256()
    for path in sorted(cases.glob("*.py")):
        digest.update(path.read_bytes())
    difference = subprocess.run(["git", "-C", str(root), "diff", "HEAD", "--", ".", ":!verify/report/past"],
                                capture_output=True, check=False)
    digest.update(difference.stdout)
    return digest.hexdigest()[:12]


def identity(library: dict, source: str, machine: dict, quick: bool, only: list[str]) -> dict:
    """What all cases of one report have in common, in the words of a refusal."""
    return {"library": library["name"], "sources": source, "report": "quick" if quick else "full",
            "cases": " ".join(sorted(set(only))) or "all", "processor": machine["processor"], "cores": machine["cores"],
            "BLAS kernels": case.kernels() or "of another BLAS", "BLAS kernels of cases": machine["openblas_coretype"],
            "BLAS kernels of timings": machine["openblas_of_timings"], "threads": machine["threads"]}


def record(new: pathlib.Path) -> dict | None:
    """The record of the report that was interrupted; None without one."""
    try:
        found = json.loads((new / RECORD).read_text(encoding="utf-8"))
        return found if {"begun", "of", "interruptions"} <= found.keys() else None
    except (OSError, ValueError, AttributeError):
        return None


def differences(before: dict, of: dict) -> list[str]:
    """In what the interrupted report is another one than this."""
    was = before["of"]
    keys = dict.fromkeys([*of, *was])
    return [f'{key} "{was.get(key)}" then, "{of.get(key)}" now' for key in keys if was.get(key) != of.get(key)]


def same(before: dict, of: dict) -> None:
    """Refuses to mix two reports, in a sentence that names both."""
    unlike = differences(before, of)
    if unlike:
        raise Refused(f"the interrupted report of {before['begun']} is another one and cannot go on: "
                      f"{'; '.join(unlike)}; without --resume this one starts anew")


def farewell(new: pathlib.Path, before: dict, of: dict) -> str:
    """What is lost of an interrupted report that does not go on."""
    cases = len(list((new / "json").glob("*.json")))
    how = "it was another one" if differences(before, of) else "--resume would have gone on with it"
    return f"the interrupted report of {before['begun']}, with {cases} cases, is given up; {how}"


def judged(data: dict) -> bool:
    """Whether a case has got its judgement. A crash, a limit or an error without numbers may be the
    interruption itself: such a case runs again."""
    return data["judgement"]["reference"]["verdict"] != "none"


def begin(out: pathlib.Path, run: dict) -> None:
    """Empties the folders of the new report and of its tables, then says what it is of."""
    new = out / "new"
    (new / RECORD).unlink(missing_ok=True)  # first: what is left of the others counts no longer
    for folder in (new, out / "raw"):
        shutil.rmtree(folder, ignore_errors=True)
    write_json(new / RECORD, run)


def go_on(out: pathlib.Path, run: dict, kept: list[str]) -> None:
    """Leaves of the interrupted report the JSON of the kept cases and whole tables."""
    new = out / "new"
    write_json(new / RECORD, run)
    wanted = {new / RECORD, *(new / "json" / f"{name}.json" for name in kept)}
    for folder, stays in ((new, wanted.__contains__), (out / "raw", is_table)):
        for path in sorted(folder.rglob("*"), reverse=True):
            if path.is_dir():
                remove_if_empty(path)
            elif not stays(path):
                path.unlink()


def is_table(path: pathlib.Path) -> bool:
    """A table of delam_harness that is there completely."""
    if path.suffix != ".json" or path.name.endswith(UNFINISHED):
        return False
    try:
        return bool(case.Rows(json.loads(path.read_text(encoding="utf-8"))))
    except (ValueError, TypeError, KeyError, AttributeError, case.Failed):
        return False


def remove_if_empty(folder: pathlib.Path) -> None:
    with contextlib.suppress(OSError):
        folder.rmdir()
