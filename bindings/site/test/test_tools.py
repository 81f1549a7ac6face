# SPDX-License-Identifier: BSD-3-Clause
"""The tools of the site find what is planted: blocks that fail, outputs that differ, links that are dead."""
import contextlib
import io
import os
import pathlib
import sys
import tempfile
import unittest

SITE = pathlib.Path(__file__).resolve().parents[1]
ROOT = SITE.parents[1]
BUILD = pathlib.Path(os.environ["DELAM"]).resolve().parents[1]
sys.path.insert(0, str(SITE / "tools"))

import blocks  # noqa: E402
import cpp_reference  # noqa: E402
import generate  # noqa: E402
import links  # noqa: E402
import run_blocks  # noqa: E402
from stage import Stage, StageError  # noqa: E402

PROGRAM = """```c file=x.c
int main(void) { return 3; }
```
"""
# What is on a page, and words of the message.
PLANTED = [
    ("```bash\nfalse\n```\n", "ends with 1 instead of 0"),
    ("```bash exit=2\ntrue\n```\n", "ends with 0 instead of 2"),
    ("```bash\necho 1.25\n```\n```text output\n1.28\n```\n", "the page shows\n    1.28"),
    ("```bash\necho 1.25\n```\n```text output\n1.25\n2\n```\n", "nothing more is printed"),
    ("```bash\nprintf 'a\\nb\\n'\n```\n```text output\na\n```\n", "nothing more is shown"),
    ("```text output\n1\n```\n", "no block before it printed anything"),
    ("```python\n1 / 0\n```\n", "ZeroDivisionError"),
    ("```toml file=s.toml\nschema = 1\nunknown = 2\n```\n", "unknown"),
    (PROGRAM + "```bash\ngcc x.c -o x && ./x\n```\n", "ends with 3"),
    (PROGRAM, "no later block uses x.c"),
    ("```c file=x.c\nint main(void) { return }\n```\n```bash\ngcc x.c\n```\n", "expected expression"),
    ("```fortran file=x.f90\nprogram x\n  y =\nend\n```\n```bash\ngfortran x.f90\n```\n", "Invalid character"),
    ("```\nwords\n```\n", "a block without a language"),
    ("```ruby\nputs 1\n```\n", "nothing runs blocks of the language 'ruby'"),
    ("```bash skipped=\"no\"\ntrue\n```\n", "unknown word"),
    ("```bash skip=\"\"\ntrue\n```\n", "no reason for which it is skipped"),
    ("```bash\ntrue\n", "a block without an end"),
    ("```c\nint x;\n```\n", "neither a file nor an output"),
    ("```text file=../x.txt\nx\n```\n", "not in the folder of the page"),
]


def run(pages, *words, build=BUILD):
    """(exit code, all that is printed) of the runner on pages {name: text}."""
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        for name, text in pages.items():
            (folder / "pages" / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / "pages" / name).write_text(text, encoding="utf-8")
        out = io.StringIO()
        before, sys.argv = sys.argv, ["run_blocks.py", "--build", str(build), "--work", str(folder / "work"), "--pages",
                                      str(folder / "pages"), *words]
        try:
            with contextlib.redirect_stdout(out), contextlib.redirect_stderr(out):
                code = run_blocks.main()
        finally:
            sys.argv = before
        return code, out.getvalue()


class Blocks(unittest.TestCase):
    def test_planted(self):
        for text, words in PLANTED:
            with self.subTest(text):
                code, printed = run({"page.md": text})
                self.assertEqual(code, 1, printed)
                self.assertIn(words, printed)

    def test_good_pages_pass(self):
        page = ("```bash\necho 'peak 1.2503 N, left 0:07'\n```\n```text output\npeak 1.25 N, left ...\n```\n"
                "```python file=x.py\nprint(1)\nprint(2)\nprint(3)\n```\n```bash\npython3 x.py\n```\n"
                "```text output\n1\n...\n3\n```\n```{figure} run:x.png\nwords\n```\n")
        code, printed = run({"page.md": page})
        self.assertEqual(code, 0, printed)
        self.assertIn("5 blocks run, 0 skipped", printed)

    def test_pages_of_a_folder_follow_each_other(self):
        pages = {"t/01.md": "```bash\necho 7 > x\n```\n", "t/02.md": "```bash\ncat x\n```\n```text output\n7\n```\n"}
        self.assertEqual(run(pages)[0], 0)
        self.assertEqual(run({"01.md": pages["t/01.md"], "02.md": pages["t/02.md"]})[0], 1)

    def test_number_of_skipped_blocks(self):
        page = {"page.md": "```bash skip=\"needs a licence\"\nabaqus\n```\n"}
        self.assertEqual(run(page, "--skipped", "1")[0], 0)
        code, printed = run(page)
        self.assertEqual(code, 1)
        self.assertIn("1 blocks are skipped; 0 are expected", printed)

    def test_julia(self):
        code, printed = run({"page.md": "```julia\nusing Delam\nmesh = Mash(lengths=0.1)\n```\n"})
        if "not run here" in printed:
            self.skipTest(printed)
        self.assertEqual(code, 1, printed)
        self.assertIn("Mash", printed)

    def test_digits(self):
        for shown, printed, same in (("1.25", "1.2549", True), ("1.25", "1.2561", False), ("3", "2", False),
                                     ("42244", "42245", True), ("42244", "42246", False),
                                     ("1.50e-05", "1.505e-05", True), ("a 1", "b 1", False), ("1e3", "1000", True),
                                     ("... 5 mm", "left 5 mm", True), ("x ... 5", "x y 7", False)):
            self.assertEqual(blocks.same_line(shown, printed), same, (shown, printed))

    def test_every_page_has_blocks_that_the_runner_sees(self):
        """No block of a page hides behind indentation or another fence."""
        for path in sorted((SITE / "pages").rglob("*.md")):
            text = path.read_text(encoding="utf-8")
            self.assertNotIn("~~~", text, path)
            self.assertNotRegex(text, r"(?m)^[ \t]+```", str(path))
            found = blocks.blocks_of(text, path.name)
            self.assertEqual(len(found), sum(line.startswith("```") and not line.startswith("```{") and line != "```"
                                             for line in text.splitlines()), path)


class Links(unittest.TestCase):
    def checked(self, files):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in files.items():
                (pathlib.Path(folder) / name).write_text(text, encoding="utf-8")
            return links.check(pathlib.Path(folder))

    def test_planted(self):
        good = {"a.html": '<a href="b.html#here">x</a><img src="p.png"><a href="https://example.org/x">y</a>',
                "b.html": '<h1 id="here">b</h1>', "p.png": ""}
        inside, addresses, wrong, pages = self.checked(good)
        self.assertEqual((inside, len(addresses), wrong, pages), (2, 1, [], 2))
        for old, new, words in (("b.html#here", "c.html", "no such file"), ("#here", "#there", "no such place"),
                                ("p.png", "../p.png", "leads out of the site"),
                                ("https://example.org", "https://", "no host"),
                                ("https:", "htps:", "unknown scheme"), ("example.org", "exam ple.org", "no host")):
            wrong = self.checked({**good, "a.html": good["a.html"].replace(old, new)})[2]
            self.assertEqual(len(wrong), 1, (old, new))
            self.assertIn(words, wrong[0])


class Staging(unittest.TestCase):
    """Links of documents, as they are in the tree."""

    def staged(self, page):
        with tempfile.TemporaryDirectory(dir=SITE) as site:
            site = pathlib.Path(site)
            (site / "pages").mkdir()
            (site / "pages/index.md").write_text(page, encoding="utf-8")
            stage = Stage(ROOT, site, site / "out", site / "results")
            stage.gather()
            return (site / "out/index.md").read_text(encoding="utf-8"), stage

    def test_kinds_of_links(self):
        text, stage = self.staged("[a,\nof two lines](../../../../README.md#a-first-program) "
                                  "[b](../../../../examples/enf)\n\n"
                                  "[c](../../../../LICENSE) `[d](nowhere.md)` <https://example.org>\n")
        self.assertEqual(text, "[a,\nof two lines](tree/README.md#a-first-program) [b](tree/examples/enf/index.md)\n\n"
                               "[c](tree/LICENSE) `[d](nowhere.md)` <https://example.org>\n")
        self.assertGreater(len(stage.documents), 25)

    def test_all_pages_and_documents(self):
        with tempfile.TemporaryDirectory() as out:
            stage = Stage(ROOT, SITE, pathlib.Path(out) / "source", None)
            stage.generated = generate.PAGES
            stage.gather()
            self.assertGreater(stage.links["inside"], 170)
            index = (stage.out / "reference/index.md").read_text(encoding="utf-8")
            self.assertIn("(options.md)", index, "the file of a generated page leads to that page")
            self.assertGreater(len(stage.wanted), 30)

    def test_generated_pages(self):
        build = pathlib.Path(os.environ["DELAM"]).resolve().parents[1]
        made = generate.pages(build)
        pages = [page for page in generate.PAGES.values() if not page.startswith("notebook/")]
        self.assertEqual(sorted(made), sorted(pages))
        for page, text in made.items():
            self.assertTrue(text.startswith("# "), page)

    def test_dead_links(self):
        for page, words in (("[x](../../../../README.md#no-such-place)\n", "README.md has no heading #no-such-place"),
                            ("# A heading\n\n[x](#other)\n", "has no heading #other"),
                            ("[x](nowhere.md)\n", "nowhere.md is not there"), ("[x](/etc/passwd)\n", "is not there"),
                            ("```{figure} run:out/x.png\n```\n", "no block makes out/x.png")):
            with self.assertRaisesRegex(StageError, words):
                self.staged(page)



class TestOfTheCppReference(unittest.TestCase):
    """Doxygen's XML of a header with one class, written by hand: the test needs no Doxygen."""

    HEADER = """// What hosts include. @no command
namespace delam {
// A mesh.
class Mesh {
public:
    // Returns the handle; see #get.
    int get() const { return 1; }
    int size() const { return delam_mesh_size(get()); }
    int bare() const { return 2; }
    int columns;  // of <each> row
};
"""
    MEMBER = """<memberdef kind="function" prot="public"><type/><definition>int delam::Mesh::{0}</definition>
<argsstring>() const</argsstring><name>{0}</name><briefdescription/><detaileddescription>{1}</detaileddescription>
<location bodyfile="mesh.hpp" bodystart="{2}" bodyend="{2}"/></memberdef>"""
    C = """<doxygen><memberdef kind="function" id="c_size"><name>delam_mesh_size</name><detaileddescription>
<para>Returns the sizes, e.g. of nodes. More words.</para></detaileddescription></memberdef></doxygen>"""

    def test_comments_become_documentation_and_lines_stay(self):
        lines = cpp_reference.as_documentation(self.HEADER).split("\n")
        self.assertEqual(lines[0], "// What hosts include. @no command")
        self.assertEqual(lines[5], "    /// Returns the handle; see \\#get.")
        self.assertEqual(lines[9], "    int columns;  ///< of \\<each\\> row")
        self.assertEqual(len(lines), len(self.HEADER.split("\n")))

    def completed(self, members):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "c").mkdir()
            (folder / "c/delam_8h.xml").write_text(self.C)
            (folder / "mesh.hpp").write_text(self.HEADER)
            (folder / "classdelam_1_1Mesh.xml").write_text(
                '<doxygen><compounddef kind="class" id="m"><compoundname>delam::Mesh</compoundname><sectiondef>'
                + "".join(self.MEMBER.format(*member) for member in members)
                + "</sectiondef><detaileddescription/></compounddef></doxygen>")
            (folder / "namespacedelam.xml").write_text('<doxygen><compounddef kind="namespace"/></doxygen>')
            cpp_reference.complete(folder, folder / "c", folder)
            self.assertEqual(cpp_reference.left_out(folder, "```{doxygenclass} delam::Mesh\n"), [])
            self.assertEqual(cpp_reference.left_out(folder, "words on delam::Mesh\n"), ["delam::Mesh"])
            return (folder / "classdelam_1_1Mesh.xml").read_text()

    def test_members_name_the_functions_of_c(self):
        text = self.completed([("get", "<para>Returns the handle.</para>", 7), ("size", "", 8)])
        self.assertIn('C: <ref refid="c_size" kindref="member">delam_mesh_size</ref>. '
                      "Returns the sizes, e.g. of nodes.</para>", text)
        self.assertEqual(text.count("c_size"), 1)

    def test_a_member_without_a_word_is_an_error(self):
        with self.assertRaisesRegex(cpp_reference.Undocumented, "int delam::Mesh::bare"):
            self.completed([("bare", "", 9)])


if __name__ == "__main__":
    outcome = unittest.main(exit=False).result
    for _, why in outcome.skipped:
        print(f"skipped: {why}")
    sys.exit(1 if not outcome.wasSuccessful() else 77 if outcome.skipped else 0)
