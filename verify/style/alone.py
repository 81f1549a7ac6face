# SPDX-License-Identifier: BSD-3-Clause
"""alone.py BUILD: whether each C++ file of src/ and bindings/ compiles by itself, headers too.

BUILD compiles the files of a folder together (DELAM_UNITY), where one finds what another includes or defines. Here the
compiler reads each of them alone, with the flags of BUILD and without making code; a header has those of the file of its
name, or of one in its folder, or in the nearest one above it that has any.
"""
import json
import os
import re
import shlex
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def jobs(build):
    """Compiler and flags, and the folder to run in, by file."""
    with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as file:
        commands = json.load(file)
    out = {}
    for command in commands:
        if not command["file"].endswith((".cpp", ".cxx")):
            continue
        words = shlex.split(command["command"])
        at = words.index("-o")
        words = [word for word in words[:at] + words[at + 2:] if word not in ("-c", command["file"])]
        files = [command["file"]]
        if f"{os.sep}Unity{os.sep}" in command["file"]:
            with open(command["file"], encoding="utf-8") as file:
                files = re.findall(r'#include "(.*)"', file.read())
        for file in files:
            if os.path.relpath(file, ROOT).split(os.sep)[0] in ("src", "bindings"):
                out.setdefault(file, (words, command["directory"]))
    return out


def with_headers(files):
    """The same with the headers beside these files and below them, as git knows them."""
    by_folder = {os.path.dirname(file): job for file, job in sorted(files.items(), reverse=True)}
    listed = subprocess.run(["git", "ls-files", "src/*.hpp", "bindings/*.hpp"], cwd=ROOT, capture_output=True, text=True,
                            check=False).stdout.split()
    out = dict(files)
    for header in listed:
        path = os.path.join(ROOT, header)
        folder = os.path.dirname(path)
        while folder not in by_folder and folder != ROOT:
            folder = os.path.dirname(folder)
        job = files.get(path.removesuffix(".hpp") + ".cpp", by_folder.get(folder))
        if job:
            out[path] = job
    return out


def complaint(job):
    file, (words, folder) = job
    read = ["-x", "c++", "-include", file, os.devnull] if file.endswith(".hpp") else [file]
    done = subprocess.run([*words, "-fsyntax-only", *read], cwd=folder, capture_output=True, text=True, check=False)
    return f"{os.path.relpath(file, ROOT)}:\n{done.stderr}" if done.returncode != 0 else ""


def main():
    found = jobs(os.path.abspath(sys.argv[1]))
    if not found:
        sys.exit(f"{sys.argv[1]}: no file of src/ or bindings/ in its compile_commands.json")
    found = with_headers(found)
    with ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        complaints = [text for text in pool.map(complaint, found.items()) if text]
    print("".join(complaints), end="")
    print(f"{len(found)} files, {len(complaints)} do not compile by themselves")
    sys.exit(1 if complaints else 0)


if __name__ == "__main__":
    main()
