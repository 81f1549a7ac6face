#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that the figures of RESULTS.md are at most 150 commits old. Exit status 1 if they are older, 77 where the
history does not say."""
from __future__ import annotations

import argparse
import os
import pathlib
import re
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
PAGE = HERE / "RESULTS.md"
LIMIT = 150
COMMIT = re.compile(r"\bcommit\s+([0-9a-f]{12})\b")  # as readme.py writes it; lines wrap
RENEW = ("renew the page: bash verify/run.sh --report, then /usr/bin/python3 verify/report/readme.py out/report "
         "(a block whose cases did not pass, or whose timings scattered, stays as it was)")


class Skipped(Exception):
    """Why the history cannot tell the age."""


class Old(Exception):
    """What is wrong with the page."""


def git(root: pathlib.Path, *arguments: str) -> subprocess.CompletedProcess:
    """Runs git on this folder, whatever repository the environment names."""
    env = {key: value for key, value in os.environ.items() if not key.startswith("GIT_")}
    command = ["git", "-C", str(root), *arguments]
    try:
        return subprocess.run(command, env=env, text=True, capture_output=True, check=False)
    except FileNotFoundError as error:
        raise Skipped("git is not installed") from error


def shallow(root: pathlib.Path) -> bool:
    """Refuses folders without a history of their own; tells whether the history is cut off."""
    top = git(root, "rev-parse", "--show-toplevel")
    if top.returncode != 0:
        why = top.stderr.strip().splitlines()
        raise Skipped(f"no history of git{': ' + why[0] if why else ''}")
    if pathlib.Path(top.stdout.strip()).resolve() != root.resolve():
        raise Skipped(f"no history of git: these sources lie in a repository of something else ({top.stdout.strip()})")
    if git(root, "rev-parse", "--verify", "--quiet", "HEAD^{commit}").returncode != 0:
        raise Skipped("no history of git: the repository has no commit")
    return git(root, "rev-parse", "--is-shallow-repository").stdout.strip() == "true"


def commits_since(root: pathlib.Path, commit: str, cut_off: bool) -> int:
    """Commits of HEAD that the commit does not have."""
    known = git(root, "rev-parse", "--verify", "--quiet", commit + "^{commit}").returncode == 0
    if cut_off and not (known and git(root, "merge-base", "--is-ancestor", commit, "HEAD").returncode == 0):
        raise Skipped(f"no history of git that is whole: this clone is shallow and its history does not reach back to commit {commit}")
    if not known:
        raise Old(f"RESULTS.md quotes commit {commit}, which this repository does not have; {RENEW}")
    return int(git(root, "rev-list", "--count", f"{commit}..HEAD").stdout)


def age(page: str, root: pathlib.Path) -> str:
    """The age of the oldest figures of a page, as a sentence."""
    commits = list(dict.fromkeys(COMMIT.findall(page)))
    if not commits:
        raise Old(f"RESULTS.md names no commit; {RENEW}")
    cut_off = shallow(root)
    ages = {commit: commits_since(root, commit, cut_off) for commit in commits}
    oldest = max(ages, key=ages.get)
    said = f"RESULTS.md has figures of commit {oldest}, {ages[oldest]} commits ago; at most {LIMIT} are allowed"
    if ages[oldest] > LIMIT:
        raise Old(f"{said}; {RENEW}")
    return said


def main(argv: list[str]) -> int:
    parser = argparse.ArgumentParser(prog="age.py", description=__doc__)
    parser.add_argument("--page", type=pathlib.Path, default=PAGE, help=argparse.SUPPRESS)
    parser.add_argument("--root", type=pathlib.Path, default=ROOT, help=argparse.SUPPRESS)
    a = parser.parse_args(argv)
    try:
        print(age(a.page.read_text(encoding="utf-8"), a.root))
        return 0
    except Skipped as why:
        print(f"skipped: {why}")
        return 77
    except Old as why:
        print(f"age.py: {why}", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
