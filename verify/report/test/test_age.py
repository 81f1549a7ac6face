# SPDX-License-Identifier: BSD-3-Clause
"""age.py on repositories of a few empty commits: old figures fail, and where there is no history it is skipped."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import planted  # sets the path

import age
import readme

# Nothing of the user's settings may change these repositories.
ALONE = {key: value for key, value in os.environ.items() if not key.startswith("GIT_")}
ALONE.update(GIT_CONFIG_GLOBAL=os.devnull, GIT_CONFIG_SYSTEM=os.devnull)


def git(folder, *arguments, words=None):
    command = ["git", "-C", str(folder), *arguments]
    return subprocess.run(command, env=ALONE, text=True, input=words, capture_output=True, check=True).stdout.strip()


def repository(folder, commits):
    """Empty commits, one after the other; their names, oldest first."""
    folder.mkdir(parents=True)
    git(folder, "init", "--quiet", "--initial-branch=main")
    one = "commit refs/heads/main\ncommitter A <a@b.c> {} +0000\ndata 1\n.\n"
    stream = "".join(one.format(1000 + i) for i in range(commits))
    git(folder, "fast-import", "--quiet", words=stream)
    return git(folder, "rev-list", "--reverse", "main").split()


def page(*commits):
    return "\n".join(f"Measured on 2000-01-01 00:00 UTC, commit {commit[:12]}, P, 2 cores, by" for commit in commits)


@unittest.skipUnless(shutil.which("git"), "git is not installed")
class Age(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.base = pathlib.Path(cls.folder.name)
        cls.root = cls.base / "full"
        cls.commits = repository(cls.root, age.LIMIT + 2)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def run_(self, text, root=None, **variables):
        path = self.base / "RESULTS.md"
        path.write_text(text, encoding="utf-8")
        program = planted.REPORT / "age.py"
        command = [sys.executable, str(program), "--page", str(path), "--root", str(root or self.root)]
        return subprocess.run(command, text=True, capture_output=True, check=False, env={**ALONE, **variables})

    def passes(self, run, commits):
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        self.assertIn(f"{commits} commits ago", run.stdout)

    def fails(self, run, *words):
        self.assertEqual(run.returncode, 1, run.stdout + run.stderr)
        for word in ("bash verify/run.sh --report", "readme.py out/report", *words):
            self.assertIn(word, run.stderr)

    def skips(self, run, words):
        self.assertEqual(run.returncode, 77, run.stdout + run.stderr)
        self.assertIn("skipped: ", run.stdout)
        self.assertIn(words, run.stdout)

    def test_the_limit(self):
        self.passes(self.run_(page(self.commits[-1])), 0)
        self.passes(self.run_(page(self.commits[1])), age.LIMIT)
        self.fails(self.run_(page(self.commits[0])), self.commits[0][:12], f"{age.LIMIT + 1} commits ago")

    def test_the_oldest_block_counts(self):
        self.fails(self.run_(page(self.commits[-1], self.commits[0])), self.commits[0][:12])
        wrapped = page(self.commits[0]).replace("commit ", "commit\n")
        self.fails(self.run_(page(self.commits[-1]) + wrapped), self.commits[0][:12])

    def test_a_library_with_changes_counts_as_its_commit(self):
        self.fails(self.run_(page(self.commits[0]).replace(", P", "+, P")), self.commits[0][:12])

    def test_a_page_without_a_commit_fails(self):
        self.fails(self.run_("nothing"), "names no commit")

    def test_an_unknown_commit_fails_in_a_full_clone(self):
        self.fails(self.run_(page("0" * 12)), "does not have")

    def test_a_shallow_clone_is_skipped(self):
        for depth in (1, 20):
            clone = self.base / f"shallow-{depth}"
            git(self.base, "clone", "--quiet", "--depth", str(depth), f"file://{self.root}", str(clone))
            self.skips(self.run_(page(self.commits[5]), clone), "shallow")
            self.skips(self.run_(page("0" * 12), clone), "shallow")
            self.passes(self.run_(page(self.commits[-1]), clone), 0)
        self.passes(self.run_(page(self.commits[-11]), clone), 10)
        # A commit that was fetched by itself says nothing about what lies between.
        git(clone, "fetch", "--quiet", "--depth", "1", "origin", self.commits[5])
        self.skips(self.run_(page(self.commits[5]), clone), "shallow")

    def test_sources_without_history_are_skipped(self):
        archive = self.base / "archive"
        archive.mkdir()
        self.skips(self.run_(page(self.commits[0]), archive), "no history")
        inner = self.root / "unpacked"
        inner.mkdir()
        self.skips(self.run_(page(self.commits[0]), inner), "something else")
        empty = self.base / "empty"
        empty.mkdir()
        git(empty, "init", "--quiet")
        self.skips(self.run_(page(self.commits[0]), empty), "no commit")
        self.skips(self.run_(page(self.commits[0]), PATH=str(archive)), "git is not installed")

    def test_the_repository_of_the_environment_is_not_asked(self):
        self.fails(self.run_(page(self.commits[0]), GIT_DIR=str(self.base / "nowhere")), self.commits[0][:12])

    def test_it_reads_what_readme_writes(self):
        commit = self.commits[0][:12]
        head = {"date": "2000-01-01 00:00 UTC", "commit": commit, "processor": "P", "cores": 2, "command": "c",
                "counts": {}, "figures": [], "pictures": []}
        told = {"text": "word " * 40, "command": "c", "date": "2000-01-01", "commit": commit}
        speed = {**head, "kernels": "k", "noise": 0.01, "losses": [], "rows": []}
        for block in (readme.block(head), readme.sentence_block("jumps", told), readme.speed_block(speed)):
            self.assertEqual(age.COMMIT.findall(block), [commit])


if __name__ == "__main__":
    unittest.main()
