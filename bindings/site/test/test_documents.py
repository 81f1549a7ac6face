# SPDX-License-Identifier: BSD-3-Clause
"""The fenced blocks of the documents that the site shows: each is run here, or by a test that is named here."""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import tomllib
import unittest

import jsonschema

SITE = pathlib.Path(__file__).resolve().parents[1]
ROOT = SITE.parents[1]
BUILD = pathlib.Path(os.environ["DELAM"]).resolve().parents[1]
sys.path.insert(0, str(SITE / "tools"))

import blocks  # noqa: E402
import generate  # noqa: E402
import links  # noqa: E402
import sandbox  # noqa: E402
from stage import Stage  # noqa: E402

# Languages of the blocks of each document, and what runs them.
KNOWN = {"README.md": (["c"], "here"), "bindings/cli/SCENE.md": (["toml", "toml"], "here"),
         "bindings/python/MANUAL.md": (["python", "python"], "python/readme"),
         "bindings/julia/MANUAL.md": (["julia"], "julia/check (parsed, not run)"),
         "src/petsc/CLUSTER.md": (["bash"], "nothing: it submits a job to a cluster")}


def fenced(path):
    return re.findall(r"(?ms)^```([a-z]+)[^\n]*\n(.*?)^```$", path.read_text(encoding="utf-8"))


class Documents(unittest.TestCase):
    def test_every_block_is_known(self):
        with tempfile.TemporaryDirectory() as out:
            stage = Stage(ROOT, SITE, pathlib.Path(out) / "source", None)
            stage.generated = generate.PAGES
            stage.gather()
        documents = [path for path in stage.documents if path.is_file() and stage.pages not in path.parents]
        found = {path.relative_to(ROOT).as_posix(): [language for language, _ in fenced(path)] for path in documents}
        self.assertEqual({name: languages for name, languages in found.items() if languages},
                         {name: languages for name, (languages, _) in KNOWN.items() if name in found})
        self.assertTrue({"README.md", "bindings/cli/SCENE.md"} <= set(found))

    def test_links(self):
        """Links of all documents lead to files of the repository and to headings, also outside of the site."""
        listed = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=False)
        if listed.returncode != 0:
            self.skipTest("no clone of the repository")
        names = listed.stdout.split("\n")[:-1]
        number, wrong = links.of_documents(ROOT, names)
        self.assertEqual(wrong, [])
        self.assertGreater(number, 250)

    def test_dead_links_of_documents(self):
        """What is dead is found: a file that is not there or not in the repository, a heading, a place outside."""
        good = "[x](in/b.md#two-words-code) [y](in) [z](#a) [w](https://example.org)"
        planted = {good: None, "[x](c.md)": "c.md is not there", "[x](in/b.md#three)": "in/b.md has no heading #three",
                   "[x](#b)": "a.md has no heading #b", "[x](built.txt)": "built.txt is not in the repository",
                   "[x][1]\n\n[1]: c.md": "c.md is not there", '![x](c.png "title")': "c.png is not there",
                   "[x](../../etc)": "../../etc leads out of the repository",
                   "[w](htps://example.org)": "htps://example.org: unknown scheme htps",
                   "[w](https://)": "https://: no host"}
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            (root / "in").mkdir()
            other = "# B\n\n## Two words, `code`\n\n```text\n[no](link.md)\n```\n"
            (root / "in/b.md").write_text(other, encoding="utf-8")
            (root / "built.txt").write_text("", encoding="utf-8")
            for text, words in planted.items():
                (root / "a.md").write_text(f"# A\n\n{text}\n", encoding="utf-8")
                number, wrong = links.of_documents(root, ["a.md", "in/b.md"])
                self.assertEqual([f"a.md: {words}"] if words else [], wrong, text)
                self.assertGreater(number, 0)

    def test_readme(self):
        text = (ROOT / "README.md").read_text(encoding="utf-8")
        commands = re.search(r"(?m)^ +(gcc .* peel && ./peel)$", text)[1]
        shown = re.search(r"(?m)^ +(\d+ N/m, .*)$", text)[1]
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "peel.c").write_text(fenced(ROOT / "README.md")[0][1], encoding="utf-8")
            done = subprocess.run(["bash", "-euc", commands], cwd=folder, capture_output=True, text=True, check=True,
                                  env=sandbox.environment(BUILD, pathlib.Path(folder)))
        self.assertTrue(blocks.same_line(shown, done.stdout), (shown, done.stdout))

    def test_parts_of_scenes(self):
        done = subprocess.run([os.environ["DELAM"], "schema"], capture_output=True, text=True, check=True)
        schema = json.loads(done.stdout)
        for key in ("required", "allOf", "dependencies"):  # what holds of a whole scene
            schema.pop(key, None)
        for _, text in fenced(ROOT / "bindings/cli/SCENE.md"):
            jsonschema.Draft4Validator(schema).validate(tomllib.loads(text))
            broken = re.sub(r"(?m)^pattern", "patern", text)
            with self.assertRaises(jsonschema.ValidationError):
                jsonschema.Draft4Validator(schema).validate(tomllib.loads(broken))


if __name__ == "__main__":
    unittest.main()
