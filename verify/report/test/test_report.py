# SPDX-License-Identifier: BSD-3-Clause
"""make.py and render.py on planted cases, over a library that has no more than a version: what goes wrong must be seen."""
import html.parser
import json
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

import planted  # sets the path

import case
import plots
import render
import schema

HERE = pathlib.Path(__file__).resolve().parent
STUB = 'const char* delam_version(void) { return "0.0.0"; }\nconst char* delam_commit(void) { return "%s"; }\n'
# What the reason must say.
CAUGHT = {"crash": "SIGSEGV", "leave": "the last words", "hang": "limit of 2 s", "fail": "the mesh was refused", "error": "KeyError", "column": 'no column "b"',
          "nan": "not finite", "hole": "not optional", "short": "4 cells for 5 columns", "unknown": "names no reference", "nothing": "compares nothing",
          "sign": "error at the finest level", "factor": "error at the finest level", "converged": "not converged", "none": "no result"}


class References(html.parser.HTMLParser):
    """Whatever a browser would fetch."""

    FETCHED = {"src", "srcset", "href", "xlink:href", "data", "poster", "action", "background"}

    def __init__(self):
        super().__init__()
        self.links, self.fetched, self.tags, self.text = [], [], [], []

    def handle_starttag(self, tag, attributes):
        self.tags.append(tag)
        for name, value in attributes:
            if name in self.FETCHED:
                (self.links if tag == "a" else self.fetched).append(value or "")
            elif name.startswith("on"):
                self.tags.append("script")

    def handle_data(self, data):
        self.text.append(data)


def build(folder: pathlib.Path, commit: str) -> pathlib.Path:
    (folder / "lib").mkdir(parents=True)
    (folder / "stub.c").write_text(STUB % commit, encoding="utf-8")
    subprocess.run(["cc", "-shared", "-fPIC", "-o", str(folder / "lib" / "libdelam.so"), str(folder / "stub.c")], check=True)
    return folder


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.base = pathlib.Path(cls.folder.name)
        cls.build, cls.newer = build(cls.base / "build", "aaaaaaaaaaaa"), build(cls.base / "newer", "bbbbbbbbbbbb")
        cls.out = cls.base / "out"
        cls.run_ = cls.make(cls.build, cls.out)
        cls.report = json.loads((cls.out / "report.json").read_text(encoding="utf-8"))
        cls.cases = {c["id"][2:]: c for c in cls.report["cases"]}

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @classmethod
    def make(cls, build_folder, out, *more):
        return subprocess.run([sys.executable, str(planted.REPORT / "make.py"), "--build", str(build_folder), "--out", str(out), "--jobs", "4",
                               "--cases", str(HERE / "cases"), "--past", str(cls.base / "past"), *more], text=True, capture_output=True, check=False)

    def page(self, name):
        parser = References()
        text = (self.out / name).read_text(encoding="utf-8")
        parser.feed(text)
        return text, parser

    def test_what_went_wrong_is_caught(self):
        self.assertEqual(set(self.cases), {*CAUGHT, "right", "skip", "refused"})
        for name, word in CAUGHT.items():
            self.assertEqual(self.cases[name]["status"], "failed", name)
            self.assertIn(word, self.cases[name]["reason"], name)
        self.assertEqual(self.cases["right"]["status"], "passed", self.cases["right"]["reason"])
        self.assertEqual(self.cases["refused"]["status"], "refused as expected")
        self.assertEqual((self.cases["skip"]["status"], self.cases["skip"]["reason"]), ("skipped", "no Fortran compiler"))

    def test_exit_status_and_progress(self):
        self.assertEqual(self.run_.returncode, 1, self.run_.stderr)
        for name in self.cases:
            self.assertIn(f" t-{name} ", self.run_.stderr)
        self.assertIn(f"{len(CAUGHT)} failed", self.run_.stderr)

    def test_every_record_is_sound(self):
        for c in self.report["cases"]:
            schema.check(c)
            schema.check(json.loads((self.out / "json" / f"{c['id']}.json").read_text(encoding="utf-8")))

    def test_every_case_is_in_the_pages(self):
        index, parsed = self.page("index.html")
        markdown = (self.out / "report.md").read_text(encoding="utf-8")
        words = " ".join(" ".join(parsed.text).split())
        for c in self.report["cases"]:
            self.assertIn(f"cases/{c['id']}.html", parsed.links)
            self.assertIn(f'id="case-{c["id"]}"', index)
            self.assertIn(f"`{c['id']}`", markdown)
            _, own = self.page(f"cases/{c['id']}.html")
            text = " ".join(" ".join(own.text).split())
            self.assertIn(c["status"], text)
            if c["reason"]:
                self.assertIn(c["reason"], words)
                self.assertIn(c["reason"], text)
                self.assertIn(c["reason"], markdown)
            for part in ("geometry", "materials", "supports", "units", "requirement", "commit"):
                self.assertIn(c[part], text)
        self.assertIn("limit ≤ 0.01, error at the finest level: 0.0075 <= 0.01", markdown)
        # Failures come first.
        self.assertLess(index.index('id="failures"'), index.index('id="claims"'))

    def test_every_case_that_ran_shows_a_ledger_or_says_why_not(self):
        for name, words in (("right", ("Energy ledger", "one step", "J/m", "lower, sum")), ("refused", ("None here",))):
            _, parsed = self.page(f"cases/t-{name}.html")
            text = " ".join(" ".join(parsed.text).split())
            for word in words:
                self.assertIn(word, text, name)
        self.assertIn("lower, sum (J/m)", (self.out / "report.md").read_text(encoding="utf-8"))

    def test_losses_are_shown_and_escaped(self):
        index, parsed = self.page("index.html")
        self.assertIn("twice as slow as <b>the baseline</b>", " ".join(parsed.text))
        self.assertNotIn("<b>the baseline</b>", index)

    def test_commands_name_no_folder_of_this_machine(self):
        program = self.base / "with-program" / "bin" / "analysis"
        program.parent.mkdir(parents=True)
        program.write_text("#!/bin/sh\necho \"$2\"\n", encoding="utf-8")
        program.chmod(0o755)
        context = case.Context(planted.REPORT.parent.parent, program.parent.parent, self.out, True)
        self.assertEqual(context.command("analysis", "--out", str(self.out / "analyses" / "x"), stdout_json=False).strip(), str(self.out / "analyses" / "x"))
        self.assertEqual(context.commands, ["analysis --out out/report/analyses/x"])

    def test_no_external_references(self):
        for page in (self.out / "index.html", *sorted((self.out / "cases").glob("*.html"))):
            text, parsed = self.page(page.relative_to(self.out))
            for address in parsed.fetched:
                self.assertTrue(address.startswith("data:image/svg+xml;base64,"), f"{page.name}: {address[:80]}")
            for address in parsed.links:
                self.assertFalse(re.match(r"[a-z]+:|//", address), f"{page.name}: {address}")
                target = (page.parent / address.split("#")[0]).resolve() if address.split("#")[0] else page
                self.assertTrue(target.is_file(), f"{page.name}: {address}")
            for tag in ("script", "link", "iframe", "object", "embed", "base"):
                self.assertNotIn(tag, parsed.tags, page.name)
            self.assertNotRegex(text, r"@import|url\(", page.name)

    def test_pictures_hold_nothing_external(self):
        import base64

        text, _ = self.page("cases/t-right.html")
        found = re.findall(r"data:image/svg\+xml;base64,([A-Za-z0-9+/=]+)", text)
        self.assertEqual(len(found), 2, "one for a desktop, one for a phone")
        for code in found:
            svg = base64.b64decode(code).decode("utf-8")
            for address in re.findall(r'href="([^"]*)"', svg):
                self.assertTrue(address.startswith("#"), address)
            self.assertNotRegex(svg, r"<(script|image|foreignObject|metadata)")

    def test_stale_json_is_caught(self):
        out = self.base / "stale"
        shutil.copytree(self.out, out)
        run = self.make(self.newer, out, "--only", "t-refused")
        self.assertEqual(run.returncode, 1)
        cases = {c["id"]: c for c in json.loads((out / "report.json").read_text(encoding="utf-8"))["cases"]}
        self.assertEqual(cases["t-refused"]["status"], "refused as expected")
        self.assertEqual(cases["t-right"]["status"], "failed")
        self.assertIn("stale", cases["t-right"]["reason"])
        self.assertIn("aaaaaaaaaaaa", cases["t-right"]["reason"])

    def test_json_that_was_spoilt_is_caught(self):
        out = self.base / "spoilt"
        shutil.copytree(self.out, out)
        path = out / "json" / "t-right.json"
        path.write_text(path.read_text(encoding="utf-8").replace('"error"', '"eror"', 1)[:-40], encoding="utf-8")
        self.make(self.build, out, "--only", "t-refused", "--no-pages")
        cases = {c["id"]: c for c in json.loads((out / "report.json").read_text(encoding="utf-8"))["cases"]}
        self.assertEqual(cases["t-right"]["status"], "failed")
        self.assertIn("cannot be used", cases["t-right"]["reason"])

    def test_quick_leaves_out_visibly(self):
        out = self.base / "quick"
        self.make(self.build, out, "--quick", "--only", "t-right", "t-refused", "--no-pages")
        cases = {c["id"]: c for c in json.loads((out / "report.json").read_text(encoding="utf-8"))["cases"]}
        self.assertEqual((cases["t-right"]["status"], cases["t-right"]["reason"]), ("skipped", "not part of --quick"))
        self.assertEqual(cases["t-fail"]["reason"], "left out by --only")

    def test_accept_and_the_past(self):
        out = self.base / "accepted"
        run = self.make(self.build, out, "--only", "t-right", "--accept", "--no-pages")
        self.assertEqual(run.returncode, 0, run.stderr)
        path = self.base / "past" / "t-right.json"
        stored = json.loads(path.read_text(encoding="utf-8"))
        stored["full"]["numbers"]["figure"]["bar_error"] *= 1.001
        path.write_text(json.dumps(stored), encoding="utf-8")
        try:
            run = self.make(self.build, out, "--only", "t-right", "--no-pages")
            self.assertEqual(run.returncode, 1)
            self.assertIn("own past", run.stderr)
        finally:
            path.unlink()

    def test_interrupted_the_report_before_stays(self):
        out = self.base / "interrupted"
        shutil.copytree(self.out, out)

        def kept():
            return {p.relative_to(out): p.read_bytes() for p in out.rglob("*") if p.is_file() and p.relative_to(out).parts[0] not in ("log", "raw", "new")}

        before = kept()
        # What runs the tests in the background may have told them to ignore Ctrl-C.
        run = subprocess.Popen([sys.executable, str(planted.REPORT / "make.py"), "--build", str(self.build), "--out", str(out), "--jobs", "1", "--cases", str(HERE / "cases"),
                                "--past", str(self.base / "past")], text=True, stderr=subprocess.PIPE, preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
        for line in run.stderr:
            if line.startswith("[1/"):
                break
        run.send_signal(signal.SIGINT)
        said = run.stderr.read()
        run.stderr.close()
        self.assertEqual(run.wait(), 1)
        self.assertIn("interrupted", said)
        self.assertEqual(kept(), before)

    def test_unknown_names_are_refused(self):
        run = self.make(self.build, self.base / "unknown", "--only", "t-nonsense")
        self.assertNotEqual(run.returncode, 0)
        self.assertIn("t-nonsense", run.stderr)


class Pages(unittest.TestCase):
    def test_wide_tables_are_split_and_lose_nothing(self):
        columns = [case.column("time", key=True), *(case.column(f"quantity {i}", "relative") for i in range(20)), case.column("gap", "relative", part="KKT")]
        whole = case.table("T", columns, [[t, *(1.234e-12 * (i + 1) for i in range(21))] for t in (0.5, 1.0)])
        parts = render.parts(whole)
        self.assertGreater(len(parts), 2)
        self.assertEqual([p["title"] for p in parts][-1], "KKT")
        for p in parts:
            self.assertEqual(p["columns"][0]["name"], "time")
            self.assertEqual([row[0] for row in p["rows"]], [0.5, 1.0])
            self.assertTrue(p["scrolls"] or len(p["columns"]) < 5)
        self.assertEqual([c["name"] for p in parts for c in p["columns"][1:]], [c["name"] for c in columns[1:]])
        self.assertEqual([v for p in parts for v in p["rows"][1][1:]], whole["rows"][1][1:])
        narrow = case.table("N", columns[:3], [row[:3] for row in whole["rows"]])
        self.assertEqual(len(render.parts(narrow)), 1)

    def test_bars_need_names_and_whole_spreads(self):
        data = planted.sound(status="passed")
        data["judgement"]["reference"]["verdict"] = "pass"
        bars = case.plot("B", case.axis("", bars=["C++", "Python"]), case.axis("step", "us"), [case.series("s", "first", [0, 1], [0.1, 9.0], low=[-0.1, 8.0], high=[0.2, 9.5])])
        data["plots"] = [bars]
        schema.check(data)
        two = {**bars, "series": [bars["series"][0], {**bars["series"][0], "name": "t", "role": "second"}]}
        self.assertIn("<svg", plots.svg(two, plots.NARROW))
        self.assertIn("<svg", plots.svg(bars, plots.NARROW))
        for spoil in ({"x": [0, 2]}, {"low": [0.0]}, {"high": [float("nan"), 1.0]}):
            spoilt = {**bars, "series": [{**bars["series"][0], **spoil}]}
            with self.assertRaises(schema.Invalid):
                schema.check({**data, "plots": [spoilt]})


class RealCases(unittest.TestCase):
    def test_the_cases_of_the_report_can_be_listed(self):
        run = subprocess.run([sys.executable, str(planted.REPORT / "make.py"), "--list"], text=True, capture_output=True, check=False)
        self.assertEqual(run.returncode, 0, run.stderr)
        names = [line.split()[1] for line in run.stdout.splitlines()]
        self.assertEqual(len(names), len(set(names)))
        self.assertIn("a-feti-direct", names)


if __name__ == "__main__":
    unittest.main()
