# SPDX-License-Identifier: BSD-3-Clause
"""Runs every fenced block of the site's pages, each folder of pages (the tutorial) or page in a folder of its own.

    run_blocks.py --build BUILD --work FOLDER [--pages FOLDER] [--only NAME ...] [--skipped N] [--update] [--jobs N]

The pages of a folder are run in the order of their names, and a later one finds what an earlier one left. --skipped
is the number of blocks that may say that they are not run; any other number is an error. --update writes what was
printed in the place of lines `?` of blocks `text output`, and of whole blocks that differ and have no `...`.
"""
import argparse
import pathlib
import shutil
import sys
import time
from concurrent.futures import ThreadPoolExecutor

from blocks import BlockError, blocks_of, difference, filled
from sandbox import Failure, SITE, Sandbox


def groups(pages):
    """{name of a sandbox: pages}: a page at the top has its own, a folder has one."""
    found = {}
    for path in sorted(pages.rglob("*.md")):
        parent = path.parent.relative_to(pages)
        name = path.stem if str(parent) == "." else str(parent)
        found.setdefault(name, []).append(path)
    return found


def fill(path, block, printed):
    """The block shows what was printed."""
    text = filled(block.text, printed) if "?\n" in block.text or "..." in block.text else None
    if text is None and "..." in block.text:
        return
    shown = (text or printed).rstrip().splitlines()
    lines = path.read_text(encoding="utf-8").splitlines(keepends=True)
    first, length = block.line - 1, len(block.text.splitlines())
    lines[first:first + length] = [line.rstrip() + "\n" for line in shown]
    path.write_text("".join(lines), encoding="utf-8")


def run_page(sandbox, path, name, update):
    """Number of its blocks."""
    number = 0
    while True:
        blocks = blocks_of(path.read_text(encoding="utf-8"), name)
        if number == len(blocks):
            return number
        block = blocks[number]
        if update and "output" in block.words and sandbox.printed and difference(block.text, sandbox.printed):
            fill(path, block, sandbox.printed)
            block = blocks_of(path.read_text(encoding="utf-8"), name)[number]
        sandbox.run(block)
        number += 1


def run_group(build, work, name, paths, pages, update):
    """(seconds, the sandbox with what it did, trouble or None)."""
    began = time.monotonic()
    sandbox = Sandbox(build, work, name)
    trouble = None
    try:
        for path in paths:
            run_page(sandbox, path, path.relative_to(pages).as_posix(), update)
        sandbox.finish()
    except (Failure, BlockError) as error:
        trouble = str(error)
    return time.monotonic() - began, sandbox, trouble


def calls_gmsh(path):
    """True if a line of the page calls the program gmsh."""
    return any(line.startswith("gmsh ") for line in path.read_text(encoding="utf-8").splitlines())


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=pathlib.Path, required=True)
    parser.add_argument("--work", type=pathlib.Path, required=True)
    parser.add_argument("--pages", type=pathlib.Path, default=SITE / "pages")
    parser.add_argument("--only", nargs="+", default=[])
    parser.add_argument("--skipped", type=int, default=0)
    parser.add_argument("--update", action="store_true")
    parser.add_argument("--jobs", type=int, default=2)
    given = parser.parse_args()
    build, work = given.build.resolve(), given.work.resolve()
    chosen = {name: paths for name, paths in groups(given.pages.resolve()).items()
              if not given.only or name in given.only}
    if not chosen:
        print("no pages", file=sys.stderr)
        return 2
    if shutil.which("gmsh") is None and any(calls_gmsh(path) for paths in chosen.values() for path in paths):
        print("skipped: gmsh is not installed (verify/packages.sh: DELAM_SITE_PACKAGES)")
        return 77
    ran, skipped, failed = 0, [], 0
    with ThreadPoolExecutor(given.jobs) as pool:
        jobs = {name: pool.submit(run_group, build, work, name, paths, given.pages.resolve(), given.update)
                for name, paths in chosen.items()}
        for name, job in jobs.items():
            seconds, sandbox, trouble = job.result()
            ran += sandbox.ran
            skipped += sandbox.skipped
            print(f"{name}: {len(chosen[name])} pages, {sandbox.ran} blocks, {seconds:.1f} s")
            for place, reason in sandbox.absent:
                print(f"  not run here: {place}: {reason}")
            for place, reason in sandbox.skipped:
                print(f"  skipped: {place}: {reason}")
            if trouble:
                failed += 1
                print(f"FAILED {trouble}", file=sys.stderr)
    print(f"{ran} blocks run, {len(skipped)} skipped, {failed} pages or folders failed")
    if not given.only and len(skipped) != given.skipped:
        print(f"FAILED {len(skipped)} blocks are skipped; {given.skipped} are expected", file=sys.stderr)
        failed += 1
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
