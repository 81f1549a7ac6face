# SPDX-License-Identifier: BSD-3-Clause
"""A report that was interrupted goes on with what it has judged, and with nothing else."""
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import planted  # sets the path

import case
import resume

HERE = pathlib.Path(__file__).resolve().parent
STUB = 'const char* delam_version(void) { return "0.0.0"; }\nconst char* delam_commit(void) { return "%s"; }\n'
HARNESS = """#!/bin/sh
echo harness >> "$(dirname "$0")/../../out/ran.txt"
echo '{"table": "shared", "columns": ["a"], "rows": [[1.0]]}'
"""


def build(folder: pathlib.Path, commit: str) -> pathlib.Path:
    (folder / "lib").mkdir(parents=True)
    (folder / "bin").mkdir()
    (folder / "stub.c").write_text(STUB % commit, encoding="utf-8")
    library = folder / "lib" / "libdelam.so"
    subprocess.run(["cc", "-shared", "-fPIC", "-o", str(library), str(folder / "stub.c")], check=True)
    program = folder / "bin" / "delam_harness"
    program.write_text(HARNESS, encoding="utf-8")
    program.chmod(0o755)
    return folder


def gone(pid: int) -> bool:
    """A process that has ended, or waits to be taken note of."""
    try:
        return pathlib.Path(f"/proc/{pid}/stat").read_text(encoding="utf-8").rpartition(")")[2].split()[0] == "Z"
    except OSError:
        return True


def until(what, seconds=30.0):
    end = time.monotonic() + seconds
    while not what():
        if time.monotonic() > end:
            raise AssertionError("it took too long")
        time.sleep(0.02)


class Resume(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.base = pathlib.Path(folder.name)
        self.build, self.out = build(self.base / "build", "aaaaaaaaaaaa"), self.base / "out"
        self.out.mkdir()

    def command(self, *more, of=None):
        return [sys.executable, str(planted.REPORT / "make.py"), "--build", str(of or self.build),
                "--out", str(self.out), "--jobs", "1", "--no-pages", "--cases", str(HERE / "counted"),
                "--past", str(self.base / "past"), *more]

    def make(self, *more, of=None, **variables):
        return subprocess.run(self.command(*more, of=of), text=True, capture_output=True, check=False,
                              env={**os.environ, **variables})

    def ran(self):
        """What ran since the last call, but for waiting."""
        path = self.out / "ran.txt"
        lines = path.read_text(encoding="utf-8").splitlines() if path.is_file() else []
        path.unlink(missing_ok=True)
        return [line for line in lines if not line.startswith("waits")]

    def waiting(self):
        """The processes of the case that waits."""
        path = self.out / "ran.txt"
        lines = path.read_text(encoding="utf-8").splitlines() if path.is_file() else []
        return [int(pid) for line in lines if line.startswith("waits") for pid in line.split()[1:]]

    def interrupted(self, how=signal.SIGKILL, *more):
        """Begins a report and ends it by a signal while a case waits; what it said."""
        (self.out / "wait").touch()
        # What runs the tests in the background may have told them to ignore Ctrl-C.
        run = subprocess.Popen(self.command(*more), text=True, stderr=subprocess.PIPE,
                               preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
        until(self.waiting)
        pids = self.waiting()
        run.send_signal(how)
        said = run.stderr.read()
        run.stderr.close()
        run.wait()
        until(lambda: all(gone(pid) for pid in pids))
        (self.out / "wait").unlink()
        return said

    def report(self):
        return json.loads((self.out / "report.json").read_text(encoding="utf-8"))

    def contents(self, *without):
        return {p.relative_to(self.out): p.read_bytes() for p in self.out.rglob("*")
                if p.is_file() and p.relative_to(self.out).parts[0] not in ("log", "ran.txt", "wait", *without)}

    def refused(self, run, *words):
        self.assertEqual(run.returncode, 2, run.stderr)
        for word in ("cannot go on", "without --resume", *words):
            self.assertIn(word, run.stderr)
        self.assertEqual(self.ran(), [])

    def test_what_was_judged_is_kept_after_any_end(self):
        for how in (signal.SIGINT, signal.SIGTERM, signal.SIGKILL):
            with self.subTest(how=how):
                said = self.interrupted(how)
                self.assertEqual("--resume goes on" in said, how != signal.SIGKILL, said)
                self.assertEqual(self.ran(), ["right", "wrong", "nothing", "harness", "first"])
                first = json.loads((self.out / "new" / "json" / "t-right.json").read_text(encoding="utf-8"))
                run = self.make("--resume")
                self.assertEqual(run.returncode, 1, run.stderr)
                self.assertIn("3 of its 7 cases are kept", run.stderr)
                self.assertIn(f"from {first['date']}", run.stderr)
                # An error without numbers may have come from the interruption; the table is there already.
                self.assertEqual(self.ran(), ["nothing", "wait", "second", "last"])
                report = self.report()
                passed = {c["id"][2:] for c in report["cases"] if c["status"] == "passed"}
                self.assertEqual(passed, {"right", "first", "wait", "second", "last"})
                self.assertEqual([i["kept"] for i in report["interruptions"]], [3])
                self.assertNotIn("--resume", report["command"])
                self.assertEqual(len(list((self.out / "json").glob("*"))), 7)
                self.assertFalse((self.out / "new").exists())
                self.assertFalse((self.out / "run.json").exists())

    def test_the_report_before_stays_until_the_new_one_is_complete(self):
        self.make()
        before = self.contents("raw")
        self.ran()
        self.interrupted()
        self.assertEqual(self.contents("raw", "new"), before)
        self.ran()
        self.interrupted(signal.SIGKILL, "--resume")
        self.assertEqual(self.contents("raw", "new"), before)
        self.ran()
        run = self.make("--resume")
        self.assertEqual(self.ran(), ["nothing", "wait", "second", "last"], run.stderr)
        self.assertEqual([i["kept"] for i in self.report()["interruptions"]], [3, 3])

    def test_halves_never_count(self):
        self.interrupted()
        self.ran()
        folder = self.out / "new" / "json"
        text = (folder / "t-right.json").read_text(encoding="utf-8")
        (folder / "t-right.json").write_text(text[:len(text) // 2], encoding="utf-8")
        (folder / "t-wait.json.unfinished").write_text(text, encoding="utf-8")
        (folder / "t-second.json").write_text(text, encoding="utf-8")  # of another case
        (folder / "t-last.json").write_text("", encoding="utf-8")
        run = self.make("--resume")
        self.assertIn("2 of its 7 cases are kept", run.stderr)
        self.assertEqual(self.ran(), ["right", "nothing", "wait", "second", "last"])
        self.assertEqual(len(list((self.out / "json").glob("*"))), 7)

    def test_tables_are_kept_only_when_complete(self):
        self.interrupted()
        self.ran()
        (table,) = (self.out / "raw").glob("*.json")
        text = table.read_text(encoding="utf-8")
        self.assertTrue(resume.is_table(table))
        for spoilt in ("", "{}", "[]", text[:20], text.replace("[[1.0]]", "[]")):
            table.write_text(spoilt, encoding="utf-8")
            self.assertFalse(resume.is_table(table), spoilt)
        (self.out / "raw" / "ctest-1").mkdir()
        for name in ("ctest-1/junit.xml", "bench-analysis-1.json", table.name + ".unfinished"):
            (self.out / "raw" / name).touch()
        self.make("--resume")
        self.assertEqual(self.ran(), ["nothing", "wait", "harness", "second", "last"])
        left = {p.name for p in (self.out / "raw").iterdir()}
        self.assertEqual(left, {table.name, table.stem + ".lock"})

    def test_another_report_is_not_mixed_in(self):
        newer = build(self.base / "newer", "bbbbbbbbbbbb")
        self.interrupted()
        self.ran()
        before = self.contents()
        self.refused(self.make("--resume", of=newer), "aaaaaaaaaaaa", "bbbbbbbbbbbb")
        self.refused(self.make("--resume", "--quick"), 'report "full" then, "quick" now')
        self.refused(self.make("--resume", "--only", "t-right"), 'cases "all" then, "t-right" now')
        self.refused(self.make("--resume", OPENBLAS_CORETYPE="Nehalem"), "BLAS kernels", '"Nehalem" now')
        record = self.out / "new" / "run.json"
        text = record.read_text(encoding="utf-8")
        for key in ("processor", "cores", "sources"):
            data = json.loads(text)
            data["of"][key] = "another"
            record.write_text(json.dumps(data), encoding="utf-8")
            self.refused(self.make("--resume"), f'{key} "another" then')
        record.write_text(text, encoding="utf-8")
        self.assertEqual(self.contents(), before)
        self.make("--resume")
        self.assertEqual(self.ran(), ["nothing", "wait", "second", "last"])

    def test_a_changed_case_is_another_report(self):
        cases = self.base / "cases"
        shutil.copytree(HERE / "counted", cases)
        shutil.copy(HERE / "planted.py", self.base)
        self.interrupted(signal.SIGKILL, "--cases", str(cases))
        self.ran()
        with open(cases / "e_counted.py", "a", encoding="utf-8") as file:
            file.write("# changed\n")
        self.refused(self.make("--resume", "--cases", str(cases)), "sources")

    def test_without_the_flag_it_starts_anew(self):
        self.interrupted()
        self.ran()
        run = self.make()
        self.assertIn("with 4 cases, is given up; --resume would have gone on with it", run.stderr)
        self.assertEqual(self.ran(), ["right", "wrong", "nothing", "harness", "first", "wait", "second", "last"])
        self.assertEqual(self.report()["interruptions"], [])
        self.interrupted()
        self.assertIn("it was another one", self.make("--only", "t-right").stderr)

    def test_without_an_interrupted_report_it_starts(self):
        for _ in range(2):  # nor does a complete one count
            run = self.make("--resume", "--only", "t-first")
            self.assertIn("has no interrupted report; this one starts anew", run.stderr)
            self.assertEqual(self.ran(), ["harness", "first"])
        (self.out / "new" / "json").mkdir(parents=True)
        shutil.copy(self.out / "json" / "t-first.json", self.out / "new" / "json")  # nothing says what it is of
        self.assertIn("starts anew", self.make("--resume", "--only", "t-first").stderr)
        self.assertEqual(self.ran(), ["harness", "first"])

    def test_a_part_goes_on_as_the_same_part(self):
        self.make()
        self.interrupted(signal.SIGKILL, "--only", "t-wait", "t-right")
        self.ran()
        run = self.make("--resume", "--only", "t-right", "t-wait")
        self.assertIn("1 of its 2 cases are kept", run.stderr)
        self.assertEqual(self.ran(), ["wait"])
        self.assertEqual(sum(c["status"] == "passed" for c in self.report()["cases"]), 5)

    def test_two_reports_at_once_are_refused(self):
        (self.out / "wait").touch()
        with subprocess.Popen(self.command(), stderr=subprocess.DEVNULL) as other:
            until(self.waiting)
            before = self.contents()
            for more in ((), ("--resume",)):
                run = self.make(*more)
                self.assertEqual(run.returncode, 2)
                self.assertIn("another report is being made", run.stderr)
            self.assertEqual(self.contents(), before)
            (self.out / "wait").unlink()
            self.assertEqual(other.wait(), 1)

    def test_a_table_is_written_whole_or_not_at_all(self):
        context = case.Context(planted.REPORT.parent.parent, self.build, self.out, True)
        context.harness("shared")
        self.assertEqual(sorted(p.suffix for p in (self.out / "raw").iterdir()), [".json", ".lock"])


if __name__ == "__main__":
    unittest.main()
