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
        """Relative links of all documents lead to files, also where the site does not show them."""
        listed = subprocess.run(["git", "ls-files", "*.md"], cwd=ROOT, capture_output=True, text=True, check=False)
        if listed.returncode != 0:
            self.skipTest("no clone of the repository")
        number = 0
        for name in listed.stdout.split():
            text = re.sub(r"(?ms)^```.*?^```", "", (ROOT / name).read_text(encoding="utf-8"))
            for link in re.findall(r"\]\(([^)#\s]+)(?:#[^)]*)?\)", text):
                if re.match(r"[a-z]+:", link):
                    continue
                number += 1
                self.assertTrue(((ROOT / name).parent / link).exists(), f"{name}: {link}")
        self.assertGreater(number, 50)

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
