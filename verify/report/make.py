#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the cases, each in a process of its own, writes their JSON and the report: see README.md."""
from __future__ import annotations

import argparse
import concurrent.futures
import ctypes
import datetime
import hashlib
import importlib.util
import json
import os
import pathlib
import platform
import shlex
import shutil
import signal
import subprocess
import sys
import threading
import time
import traceback

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.path.insert(0, str(HERE))

import case as case_module  # noqa: E402
import child  # noqa: E402
import judge  # noqa: E402
import resume  # noqa: E402
import schema  # noqa: E402
import words  # noqa: E402
from whole import write_json  # noqa: E402


DATE = "%Y-%m-%d %H:%M UTC"


MODULE_OF: dict[str, str] = {}  # of a case: the name of its file


def find_cases(folder: pathlib.Path, pattern: str = "*_*.py") -> list[case_module.Case]:
    found: list[case_module.Case] = []
    for path in sorted(folder.glob(pattern)):
        spec = importlib.util.spec_from_file_location(f"cases_{path.stem}", path)
        module = importlib.util.module_from_spec(spec)
        sys.path.insert(0, str(folder))
        try:
            spec.loader.exec_module(module)
        finally:
            sys.path.remove(str(folder))
        if hasattr(module, "cases"):
            of = module.cases()
            MODULE_OF.update((c.id, path.name) for c in of)
            found += of
    names = [c.id for c in found]
    twice = sorted({n for n in names if names.count(n) > 1})
    if twice:
        raise SystemExit(f"make.py: case ids are used twice: {', '.join(twice)}")
    return sorted(found, key=lambda c: (c.chapter, names.index(c.id)))


def library_of(build: pathlib.Path) -> dict:
    """The library that is judged, by its own words and by the digest of its file."""
    path = (build / "lib" / "libdelam.so").resolve()
    if not path.is_file():
        raise SystemExit(f"make.py: no {build}/lib/libdelam.so: build the library first (cmake --preset release && cmake --build --preset release)")
    loaded = ctypes.CDLL(str(path))
    loaded.delam_version.restype = loaded.delam_commit.restype = ctypes.c_char_p
    digest = hashlib.sha256(path.read_bytes()).hexdigest()
    version, commit = loaded.delam_version().decode(), loaded.delam_commit().decode()
    return {"version": version, "commit": commit, "sha256": digest, "name": f"{version}, {commit}, sha256 {digest[:12]}"}


def source_commit() -> str:
    run = subprocess.run(["git", "-C", str(ROOT), "describe", "--always", "--dirty", "--abbrev=12", "--exclude=*"], text=True,
                         capture_output=True, check=False)
    return run.stdout.strip() or "unknown"


def machine() -> dict:
    processor, memory = platform.processor() or "unknown", 0.0
    try:
        for line in pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                processor = line.split(":", 1)[1].strip()
                break
        for line in pathlib.Path("/proc/meminfo").read_text(encoding="utf-8").splitlines():
            if line.startswith("MemTotal"):
                memory = float(line.split()[1]) / 1024**2
    except OSError:
        pass
    release = platform.freedesktop_os_release() if hasattr(platform, "freedesktop_os_release") else {}
    return {"processor": processor, "cores": os.cpu_count(), "memory_GiB": round(memory, 1),
            "system": release.get("PRETTY_NAME", platform.platform()), "python": platform.python_version(),
            "openblas_coretype": case_module.common_kernels() or "chosen by OpenBLAS",
            "openblas_of_timings": os.environ.get("OPENBLAS_CORETYPE", "chosen by OpenBLAS"),
            "threads": os.environ.get("OPENBLAS_NUM_THREADS", "1")}


def blank(case: case_module.Case, library: dict, command: str) -> dict:
    """A record without any result yet."""
    return {**case.head(), "reference": {"kind": "", "source": "", "uncertainty": ""}, "tables": [], "orders": [], "ledger": None,
            "plots": [], "figures": [], "checks": [], "warnings": [], "losses": [],
            "judgement": {"reference": {"verdict": "none", "value": None, "limit": None, "why": "not judged"},
                          "past": {"verdict": "none", "worst": None, "limit": None, "why": "not judged"}},
            "status": "failed", "reason": "", "command": command, "commit": library["commit"], "library": library["name"],
            "seconds": 0.0, "kernels": case_module.kernels(), "timing": case.timing,
            "date": datetime.datetime.now(datetime.timezone.utc).strftime(DATE), "expected_seconds": case.expected, "quick": False}


def ended(case, library, command, status: str, reason: str, seconds: float = 0.0) -> dict:
    data = blank(case, library, command)
    data.update(status=status, reason=reason, seconds=round(seconds, 3))
    return data


def run_here(case: case_module.Case, context: case_module.Context, past: pathlib.Path, library: dict) -> dict:
    """Runs, judges and checks one case in this process; only a crash gets past this."""
    start = time.monotonic()
    again = shlex.join(["bash", "verify/run.sh", "--report", *(["--quick"] if context.quick else []), "--only", case.id])
    data = {**blank(case, library, again), "quick": context.quick}

    def failed(reason: str, status: str = "failed") -> dict:
        out = ended(case, library, data["command"], status, reason, time.monotonic() - start)
        return schema.check(out)

    try:
        answer = case.run(context)
    except case_module.Skip as why:
        return failed(str(why), "skipped")
    except case_module.Failed as why:
        return failed(str(why))
    except BaseException as error:  # whatever a case does wrong is that case's failure
        where = traceback.extract_tb(error.__traceback__)[-1]
        return failed(f"{type(error).__name__}: {error} ({pathlib.Path(where.filename).name}:{where.lineno})")
    if context.commands:
        data["command"] = again + "\n" + "\n".join(dict.fromkeys(context.commands))
    if not isinstance(answer, dict):
        return failed("the case handed back no result")
    data.update(answer)
    data["seconds"] = round(time.monotonic() - start, 3)
    try:
        # Numbers first: what is not finite must not be judged.
        schema.check({**data, "status": "failed", "reason": "not judged yet"})
        judge.judge(data, past, context.quick)
        schema.check(data)
    except schema.Invalid as error:
        return failed(f"the result is not sound: {error}")
    except Exception as error:
        return failed(f"the result cannot be judged: {type(error).__name__}: {error}")
    return data


def publish(new: pathlib.Path, out: pathlib.Path, everything: bool) -> None:
    """The finished report in the place of the one before; what is no longer part of it goes. JSON of other cases stays unless everything was
    run. Ctrl-C waits for the end."""
    before = {s: signal.signal(s, signal.SIG_IGN) for s in (signal.SIGINT, signal.SIGTERM)}
    try:
        for part in ("json", "cases") if everything else ("cases",):
            if (new / part).is_dir():
                (out / part).mkdir(parents=True, exist_ok=True)
                kept = {path.name for path in (new / part).iterdir()}
                for path in (out / part).iterdir():
                    if path.name not in kept:
                        path.unlink()
        for path in sorted(p for p in new.rglob("*") if p.is_file() and p != new / resume.RECORD):
            (out / path.relative_to(new)).parent.mkdir(parents=True, exist_ok=True)
            os.replace(path, out / path.relative_to(new))
        shutil.rmtree(new, ignore_errors=True)
    finally:
        for s, handler in before.items():
            signal.signal(s, handler)


def render(folder: pathlib.Path) -> int:
    """Draws the pages in a process group of its own, which ends with this one."""
    drawing = child.start([sys.executable, str(HERE / "render.py"), str(folder)])
    try:
        return drawing.wait()
    finally:
        child.end(drawing)


def read_case(path: pathlib.Path, case: case_module.Case, library: dict, command: str, quick: bool) -> dict:
    """The JSON of a case as this report may use it: sound, of this case, of its tier, and of this very library."""
    try:
        data = schema.check(json.loads(path.read_text(encoding="utf-8")))
    except (OSError, ValueError) as error:
        return ended(case, library, command, "failed", f"its JSON cannot be used: {error}")
    if data["id"] != case.id:
        return ended(case, library, command, "failed", f"its JSON is that of {data['id']}")
    if data["library"] != library["name"] or data["commit"] != library["commit"]:
        return ended(case, library, command, "failed", f"stale: its JSON is of library {data['library']}, the report of {library['name']}")
    if data["status"] != "skipped" and data.get("quick", False) != quick and data["tables"]:
        return ended(case, library, command, "failed", f"stale: its JSON is of the {'full' if quick else 'quick'} report")
    return data


class Runner:
    """Starts cases as child processes and keeps what became of them."""

    def __init__(self, arguments, library: dict):
        self.arguments, self.library = arguments, library
        self.running: dict[int, subprocess.Popen] = {}
        self.lock = threading.Lock()

    def __call__(self, case: case_module.Case) -> dict:
        a = self.arguments
        path = a.out / "new" / "json" / f"{case.id}.json"
        path.unlink(missing_ok=True)
        command = [sys.executable, str(HERE / "make.py"), "--child", case.id, "--module", MODULE_OF[case.id], "--out", str(a.out), "--build", str(a.build),
                   "--cases", str(a.cases), "--past", str(a.past), *(["--quick"] if a.quick else [])]
        again = shlex.join(["bash", "verify/run.sh", "--report", *(["--quick"] if a.quick else []), "--only", case.id])
        start = time.monotonic()
        log = a.out / "log" / f"{case.id}.txt"
        log.parent.mkdir(parents=True, exist_ok=True)
        with open(log, "w", encoding="utf-8") as output:
            process = child.start(command, stdout=output, stderr=subprocess.STDOUT, cwd=ROOT,
                                  env=case_module.environment(a.build / "lib", case.timing and not a.quick))
            with self.lock:
                self.running[process.pid] = process
            try:
                status = process.wait(timeout=case.seconds)
            except subprocess.TimeoutExpired:
                status = None
            finally:
                self.end(process)
        seconds = time.monotonic() - start
        if status is None:
            data = ended(case, self.library, again, "failed", f"stopped: it took more than its limit of {case.seconds:g} s", seconds)
        elif status != 0:
            tail = " / ".join(log.read_text(encoding="utf-8", errors="replace").strip().splitlines()[-3:])
            how = f"signal {signal.Signals(-status).name}" if status < 0 else f"exit status {status}"
            data = ended(case, self.library, again, "failed", f"crashed ({how})" + (f": {tail}" if tail else ""), seconds)
        else:
            data = read_case(path, case, self.library, again, a.quick)
        write_json(path, data)
        return data

    def end(self, process: subprocess.Popen) -> None:
        with self.lock:
            self.running.pop(process.pid, None)
        child.end(process)

    def end_all(self) -> None:
        """The waiting threads see their children end and go."""
        for pid in list(self.running):
            child.kill(pid)


def chosen(case: case_module.Case, only: list[str]) -> bool:
    return not only or case.id in only or case.chapter in only


def main(argv: list[str]) -> int:
    parser = argparse.ArgumentParser(prog="make.py", description=__doc__)
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "out" / "report")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build" / "release")
    parser.add_argument("--quick", action="store_true", help="the part that takes one to two minutes")
    parser.add_argument("--only", nargs="+", default=[], metavar="ID|CHAPTER", help="run these; the others stay as they are")
    parser.add_argument("--resume", action="store_true", help="goes on with an interrupted report: what it judged is kept")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, help="cases at once, without --quick of those that do not measure time")
    parser.add_argument("--accept", action="store_true", help="the numbers of what passed its reference are the new past")
    parser.add_argument("--no-pages", action="store_true", help="judge only: report.json and json/, no pages (their pictures take three minutes)")
    parser.add_argument("--list", action="store_true", help="names the cases")
    parser.add_argument("--cases", type=pathlib.Path, default=HERE / "cases", help=argparse.SUPPRESS)
    parser.add_argument("--past", type=pathlib.Path, default=HERE / "past", help=argparse.SUPPRESS)
    parser.add_argument("--child", help=argparse.SUPPRESS)
    parser.add_argument("--module", default="*_*.py", help=argparse.SUPPRESS)
    a = parser.parse_args(argv)
    a.out, a.build, a.cases, a.past = a.out.resolve(), a.build.resolve(), a.cases.resolve(), a.past.resolve()
    cases = find_cases(a.cases, a.module)
    if a.list:
        for c in cases:
            print(f"{c.chapter}  {c.id:<32} {'quick' if c.quick else '     '} {'timing' if c.timing else '      '} {c.expected:6.0f} s  {c.title}")
        return 0
    library = library_of(a.build)
    if a.child:
        child.follow()
        case = next(c for c in cases if c.id == a.child)
        context = case_module.Context(ROOT, a.build, a.out, a.quick, case.seconds)
        write_json(a.out / "new" / "json" / f"{case.id}.json", run_here(case, context, a.past, library))
        return 0
    unknown = [o for o in a.only if o not in case_module.CHAPTERS and o not in [c.id for c in cases]]
    if unknown:
        raise SystemExit(f"make.py: neither a case nor a chapter: {', '.join(unknown)} (--list names them)")
    try:
        with resume.alone(a.out):
            return report(a, cases, library)
    except resume.Refused as why:
        say(f"make.py: {why}")
        return 2
    except KeyboardInterrupt:
        say("make.py: interrupted; no report was written, the one before stays as it was; --resume goes on")
        return 1


def say(text: str) -> None:
    print(text, file=sys.stderr, flush=True)


def take_up(a, wanted: list[case_module.Case], library: dict, run: dict) -> dict:
    """The results that an interrupted report has left for this one, by their cases. Without --resume it is given up."""
    new = a.out / "new"
    before = resume.record(new)
    if not a.resume or before is None:
        if a.resume:
            say(f"--resume: {new} has no interrupted report; this one starts anew")
        elif before:
            say(resume.farewell(new, before, run["of"]))
        resume.begin(a.out, run)
        return {}
    resume.same(before, run["of"])
    kept = {}
    for c in wanted:
        data = read_case(new / "json" / f"{c.id}.json", c, library, run["command"], a.quick)
        if resume.judged(data):
            kept[c.id] = data
    ends = sorted(data["date"] for data in kept.values())
    say(f"resumed: the report of {before['begun']} was interrupted; {len(kept)} of its {len(wanted)} cases are kept"
        + (f", which ended from {ends[0]} to {ends[-1]}" if kept else ""))
    again = {"resumed": run["begun"], "kept": len(kept)}
    run.update(begun=before["begun"], interruptions=[*before["interruptions"], again])
    resume.go_on(a.out, run, list(kept))
    return kept


def run_all(a, wanted: list[case_module.Case], library: dict, results: dict) -> None:
    """Runs the cases that have no result yet."""
    done = len(results)

    def tell(data: dict) -> None:
        nonlocal done
        done += 1
        results[data["id"]] = data
        why = f": {data['reason']}" if data["reason"] else ""
        say(f"[{done}/{len(wanted)}] {data['status']:<8} {data['id']} ({data['seconds']:.1f} s){why}")

    runner = Runner(a, library)
    # The long ones first: the last one to end decides.
    # The quick report judges no time: nothing in it needs the machine for itself.
    rest = [c for c in wanted if c.id not in results]
    alone = [c for c in rest if c.timing and not a.quick]
    free = sorted((c for c in rest if c not in alone), key=lambda c: -c.expected)
    with concurrent.futures.ThreadPoolExecutor(max(1, a.jobs)) as pool:
        try:
            for future in concurrent.futures.as_completed([pool.submit(runner, c) for c in free]):
                tell(future.result())
        except KeyboardInterrupt:
            # What waits is not begun, what runs is ended: else the pool would wait for all of them.
            pool.shutdown(wait=False, cancel_futures=True)
            runner.end_all()
            raise
    for c in alone:
        tell(runner(c))


def report(a, cases: list[case_module.Case], library: dict) -> int:
    started, start = datetime.datetime.now(datetime.timezone.utc), time.monotonic()
    source = source_commit()  # before an accepted past is written beside it
    command = shlex.join(["bash", "verify/run.sh", "--report", *(["--quick"] if a.quick else []), *(["--only", *a.only] if a.only else []), *(["--accept"] if a.accept else [])])
    new = a.out / "new"  # the new report grows in a folder of its own; until it is whole, the one before stays
    wanted = [c for c in cases if chosen(c, a.only) and (c.quick or not a.quick)]
    here = machine()
    sources = f"{source}, sha256 {resume.changes(ROOT, a.cases)}"
    run = {"begun": started.strftime(DATE), "command": command, "interruptions": [],
           "of": resume.identity(library, sources, here, a.quick, a.only)}

    def stop(*_):
        raise KeyboardInterrupt

    signal.signal(signal.SIGTERM, stop)
    say(f"report: {len(wanted)} of {len(cases)} cases, {a.jobs} at once, library {library['name']}")
    results = take_up(a, wanted, library, run)
    run_all(a, wanted, library, results)
    everything = []
    for c in cases:
        path = a.out / "json" / f"{c.id}.json"
        if c.id in results:
            everything.append(results[c.id])
        elif a.only and path.is_file():
            everything.append(read_case(path, c, library, command, a.quick))
        else:
            why = "not part of --quick" if a.quick and not c.quick else words.LEFT_OUT
            everything.append(ended(c, library, f"bash verify/run.sh --report --only {c.id}", "skipped", why))
    if a.accept:
        for data in everything:
            if data["id"] in results and data["judgement"]["reference"]["verdict"] == "pass":
                before = data["judgement"]["past"]
                judge.accept(data, a.past, a.quick, started.strftime("%Y-%m-%d"))
                judge.judge(data, a.past, a.quick)
                # Compared with itself it would always pass: what counts is the comparison with the one before.
                data["judgement"]["past"] = before if before["verdict"] == "pass" else {
                    **before, "verdict": "new", "worst": None, "why": f"accepted by this run; against the one before: {before['why']}"}
                write_json(new / "json" / f"{data['id']}.json", data)
                say(f"accepted: {data['id']}")
    import claims

    warnings = []
    if not source.startswith(library["commit"]):
        warnings.append(f"The library is of commit {library['commit']}, the sources beside it are {source}.")
    write_json(new / "report.json", {
        "title": "libdelam: verification report", "date": run["begun"], "interruptions": run["interruptions"],
        "command": command, "quick": a.quick, "commit": library["commit"], "source": source, "library": library, "machine": here,
        "seconds": round(time.monotonic() - start, 1), "chapters": case_module.CHAPTERS, "claims": claims.CLAIMS,
        "warnings": warnings, "cases": everything})
    drawn = 0
    if not a.no_pages:
        say("drawing the pages")
        drawn = render(new)
    publish(new, a.out, not a.only)
    if a.no_pages:  # pages of an earlier report would contradict this one
        shutil.rmtree(a.out / "cases", ignore_errors=True)
        for page in ("index.html", "report.md"):
            (a.out / page).unlink(missing_ok=True)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    counts = {s: sum(d["status"] == s for d in everything) for s in schema.STATUSES}
    say(", ".join(f"{n} {s}" for s, n in counts.items()) + f"; {a.out / ('report.json' if a.no_pages else 'index.html')}")
    return 1 if counts["failed"] or drawn else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
