# SPDX-License-Identifier: BSD-3-Clause
"""What a case is, what it is given, and the words it hands its results back in."""
from __future__ import annotations

import ctypes
import dataclasses
import fcntl
import hashlib
import json
import math
import os
import pathlib
import shlex
import subprocess
import sys

import whole

CHAPTERS = {
    "a": "FETI and condensed against the direct solve",
    "b": "Energy inequalities and convergence",
    "c": "Speed against error",
    "d": "Numerical stability on hard cases",
    "e": "Published coupons and closed forms",
    "f": "Binary interface and language bindings",
    "g": "Growth of cost with size",
    "h": "Mixed mode, jumps and their ledger, with default options",
}

REFERENCE_KINDS = ("closed form", "manufactured", "published", "other code", "exhaustive scan", "Richardson", "direct solver",
                   "own past", "physics")


@dataclasses.dataclass(frozen=True)
class Case:
    """One page of the report. `run(context)` returns a dict made with `result()`; it is called in a process of its own."""

    id: str
    chapter: str
    title: str
    requirement: str  # what must hold, in words that can be false
    geometry: str
    materials: str
    supports: str
    units: str
    run: object
    quick: bool = False    # also part of --quick
    timing: bool = False   # measures time: runs alone, but in the quick report, which judges none
    seconds: float = 600.0  # limit; passing it fails the case
    expected: float = 60.0  # seconds on two cores, of the full report

    def head(self) -> dict:
        return {key: getattr(self, key)
                for key in ("id", "chapter", "title", "requirement", "geometry", "materials", "supports", "units")}


class Skip(Exception):
    """The case cannot be run here: what is missing. It stays in the report, as skipped."""


class Failed(Exception):
    """The case cannot give its answer: why."""


class Context:
    """The build that is judged, and the ways to it: programs as JSON, the Python package. Commands are kept for the page."""

    def __init__(self, root: pathlib.Path, build: pathlib.Path, out: pathlib.Path, quick: bool, seconds: float = 600.0):
        self.root, self.build, self.out, self.quick, self.seconds = root, build, out, quick, seconds
        self.commands: list[str] = []

    @property
    def library(self) -> pathlib.Path:
        return self.build / "lib"

    def program(self, name: str) -> pathlib.Path:
        for place in ("verify", "verify/bench", "verify/harness", "bin", "bindings/cli"):
            path = self.build / place / name
            if path.is_file() and os.access(path, os.X_OK):
                return path
        raise Skip(f"{name} was not built in {self.build.name}")

    def command(self, name: str, *arguments: str, stdout_json: bool = True, check: bool = True) -> object:
        """Runs a program of the build and returns its JSON (or text). An exit status other than 0 fails the case. The page shows the command
        with the report in its usual folder, wherever it is made."""
        program = self.program(name)
        self.commands.append(shlex.join([name, *(a.replace(str(self.out), "out/report") for a in arguments)]))
        run = subprocess.run([str(program), *arguments], cwd=self.root, text=True, capture_output=True, check=False,
                             env=environment(self.library, timing=True))  # kernels: those of the case's own process
        if check and run.returncode != 0:
            tail = " / ".join(run.stderr.strip().splitlines()[-3:])
            raise Failed(f"{name} {shlex.join(arguments)} ended with status {run.returncode}: {tail}")
        if not stdout_json:
            return run.stdout
        try:
            return json.loads(run.stdout)
        except ValueError as error:
            raise Failed(f"{name} {shlex.join(arguments)} printed no JSON: {error}") from error

    def harness(self, table: str, *arguments: str) -> "Rows":
        """A table of delam_harness. The same call of several cases is made once in a report."""
        arguments = (*arguments, *(("--quick",) if self.quick else ()))
        key = hashlib.sha256(shlex.join([table, *arguments]).encode()).hexdigest()[:16]
        raw = self.out / "raw"
        raw.mkdir(parents=True, exist_ok=True)
        path = raw / f"{table}-{key}.json"
        with open(raw / f"{table}-{key}.lock", "w", encoding="utf-8") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            if path.is_file():
                self.commands.append(shlex.join(["delam_harness", "--json", *arguments, table]))
                data = json.loads(path.read_text(encoding="utf-8"))
            else:
                data = self.command("delam_harness", "--json", *arguments, table)
                whole.write_text(path, json.dumps(data))
        return Rows(data)

    def python(self):
        """The package `delam`, over the library of this build."""
        os.environ["DELAM_LIBRARY"] = str(self.library)
        package = str(self.root / "bindings" / "python" / "src")
        if package not in sys.path:
            sys.path.insert(0, package)
        import delam  # the library of the build, not one that happens to be installed

        return delam


def kernels() -> str:
    """The kernels that OpenBLAS has chosen in this process; "" for another BLAS."""
    try:
        name = ctypes.CDLL("libopenblas.so.0").openblas_get_corename
    except (OSError, AttributeError):
        return ""
    name.restype = ctypes.c_char_p
    return name().decode()


def common_kernels() -> str:
    """Kernels that most machines have, "" for this one without them."""
    try:
        return "Haswell" if " avx2 " in pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8") else ""
    except OSError:
        return ""


def environment(library: pathlib.Path, timing: bool = False) -> dict:
    """One thread of linear algebra a process: cases share the cores, and sums keep their order. Unless time is measured, BLAS takes the same
    kernels on every machine that has them: else the last digits, and with them counts of iterations, would be those of the machine."""
    env = dict(os.environ)
    env["LD_LIBRARY_PATH"] = os.pathsep.join(filter(None, [str(library), env.get("LD_LIBRARY_PATH")]))
    env["DELAM_LIBRARY"] = str(library)
    for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "OMP_THREAD_LIMIT"):
        env.setdefault(name, "1")
    if not timing and common_kernels():
        env["OPENBLAS_CORETYPE"] = common_kernels()
    return env


class Rows:
    """Columns and rows as a program printed them; a column that is asked for and missing fails the case by name."""

    def __init__(self, data: dict):
        self.name, self.note = data.get("table", "?"), data.get("note", "")
        self.columns, self.rows = list(data["columns"]), [list(row) for row in data["rows"]]
        if not self.rows:
            raise Failed(f"table {self.name} has no rows")

    def index(self, column: str) -> int:
        if column not in self.columns:
            raise Failed(f"table {self.name} has no column \"{column}\" (it has {', '.join(self.columns)})")
        return self.columns.index(column)

    def column(self, name: str) -> list:
        i = self.index(name)
        return [number(row[i]) for row in self.rows]

    def where(self, **wanted) -> "Rows":
        picked = [row for row in self.rows if all(row[self.index(k)] == v for k, v in wanted.items())]
        if not picked:
            raise Failed(f"table {self.name} has no rows with " + ", ".join(f"{k} = {v}" for k, v in wanted.items()))
        return Rows({"table": self.name, "note": self.note, "columns": self.columns, "rows": picked})

    def values(self, column: str) -> list:
        """The distinct values, in the order of their first row."""
        return list(dict.fromkeys(self.column(column)))

    def table(self, title: str, columns: list[dict], note: str = "") -> dict:
        """A table of the report: each column says {"from": its name in the program, ...} and how it is to be shown."""
        out = []
        for row in self.rows:
            out.append([number(row[self.index(c.get("from", c["name"]))]) for c in columns])
        return table(title, [{k: v for k, v in c.items() if k != "from"} for c in columns], out, note)


def number(cell):
    """Programs print what is not a number as text; in the report it is a hole (null), which a column must allow."""
    if isinstance(cell, str) and cell.strip().lower() in ("nan", "-nan", "inf", "-inf", "-"):
        return None
    return cell


# What a case hands back.

def column(name: str, unit: str = "", **more) -> dict:
    """more: part (words: on the page a new part of the table begins here), from (the program's name), key (names its row), optional (may be empty), past ("free", "count", "rounding" or a
    relative tolerance), may (True: a count of what did not converge that is allowed to be more than 0), capped (True: empty where a cap on the time cut it off,
    which the past forgives)."""
    return {"name": name, "unit": unit, **more}


def table(title: str, columns: list[dict], rows: list[list], note: str = "") -> dict:
    return {"title": title, "columns": columns, "rows": rows, "note": note}


def check(what: str, value, limit, why: str, sense: str = "<=") -> dict:
    """One comparison with the reference: value sense limit."""
    return {"what": what, "value": value, "limit": limit, "sense": sense, "why": why}


def axis(label: str, unit: str = "", scale: str = "linear", **more) -> dict:
    """more, of x: bars, names at 0, 1, ...: its series are drawn as bars over them."""
    return {"label": label, "unit": unit, "scale": scale, **more}


def series(name: str, role: str, x: list, y: list, **more) -> dict:
    """role picks colour and marker (palette.py). more: line ("solid", "dashed", "none"), marker (False: none), unfilled (True: open markers, for
    bounds), low and high: ends of its spread."""
    return {"name": name, "role": role, "x": list(x), "y": list(y), **more}


def plot(title: str, x: dict, y: dict, curves: list[dict], marks: list[dict] = (), caption: str = "") -> dict:
    """marks: {"kind": "horizontal" | "vertical", "value", "label"} or {"kind": "slope", "order", "label"}."""
    return {"title": title, "x": x, "y": y, "series": list(curves), "marks": list(marks), "caption": caption}


def figure(name: str, value: float, unit: str, text: str, **more) -> dict:
    """A headline number that the README may quote, by its name. more: past, as of a column."""
    return {"name": name, "value": value, "unit": unit, "text": text, **more}


def order(of: str, by: str, fitted: float, expected: float, tolerance: float, sizes=None, errors=None, sense: str = "about") -> dict:
    """An observed order. With sizes and errors judge.py fits it again; sense "at least": faster is fine."""
    out = {"of": of, "by": by, "fitted": fitted, "expected": expected, "tolerance": tolerance, "sense": sense}
    if sizes is not None:
        out["sizes"], out["errors"] = list(sizes), list(errors)
    return out


def result(reference: dict, *, tables=(), orders=(), ledger=None, plots=(), figures=(), checks=(), warnings=(), losses=(),
           refused: str = "") -> dict:
    """refused: the library's own words, where the expected outcome is a refusal. losses: where something else is
    better. ledger: a table (`ledger_of`), or a phrase that says why there is none; None: the phrase of the chapter
    (words.py)."""
    return {"reference": reference, "tables": list(tables), "orders": list(orders), "ledger": ledger, "plots": list(plots),
            "figures": list(figures), "checks": list(checks), "warnings": list(warnings), "losses": list(losses),
            "refused": refused}


LEDGER_VALUES = ("stored_bulk", "stored_interface", "dissipated", "work", "lower", "increment_lower", "increment", "upper")


def ledger_of(analyses: dict, unit: str, slack: float = 1e-9) -> dict:
    """The energy ledger of analyses, by name: each the values of the public API after every step, lists by their names,
    the initial state first. Sums of the two-sided estimate beside what was recorded; beyond: steps outside of it by more
    than `slack` of the largest energy. With "released", what jumps set free in each step, it is a column too."""
    rows, gone = [], any("released" in at for at in analyses.values())
    for name, at in analyses.items():
        bulk, interface, spent, work, lower, own, now, upper = ([float(v) for v in at[key]] for key in LEDGER_VALUES)
        slack_here = slack * max(max(abs(v) for v in bulk), max(abs(v) for v in work))
        gained, released = bulk[-1] + interface[-1] - bulk[0] - interface[0], sum(at["released"] if "released" in at else ())
        beyond = sum(max(low - a, b - up) > slack_here for low, a, b, up in zip(lower, own, now, upper))
        rows.append([name, bulk[-1], interface[-1], spent[-1], *([released] if gone else []), work[-1],
                     gained + spent[-1] + released - work[-1], sum(lower), sum(now), sum(upper), beyond])
    energies = ("stored, bodies", "stored, interface", "dissipated", *(["released"] if gone else []), "work", "defect",
                "lower, sum", "increments, sum", "upper, sum")
    columns = [column("analysis", "", key=True), *(column(what, unit) for what in energies),
               column("beyond a bound", "steps")]
    return table("At the end of the analysis", columns, rows,
                 "An analysis: all load steps of a scene in turn. As the library records it, by its public values. Defect: growth of what is stored, and dissipated"
                 + (" and released" if gone else "") + ", less the work; bounds and increments are summed over the steps.")


def reference(kind: str, source: str, uncertainty: str) -> dict:
    return {"kind": kind, "source": source, "uncertainty": uncertainty}


def largest(values) -> float:
    """Of the numbers among them; a case whose every value is missing has no answer."""
    found = [float(v) for v in values if isinstance(v, (int, float)) and not isinstance(v, bool)]
    if not found:
        raise Failed("no numbers to take the largest of")
    if any(math.isnan(v) for v in found):
        return math.nan
    return max(found)
