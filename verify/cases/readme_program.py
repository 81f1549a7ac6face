#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""readme_program.py README LIBRARY INCLUDE COMPILER: the C program in the README compiles as it stands, without a warning, and prints
what the README says it prints. The crack grows steadily in it, so that its energy release rate is the toughness of the law.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

TOUGHNESS = 250.0
STRICT = ["-std=c99", "-Wall", "-Wextra", "-pedantic", "-Werror"]


def numbers(line):
    return [float(word) for word in re.findall(r"\d+(?:\.\d+)?(?= [NJ])", line)]


def run(command, **options):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **options)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))} exits with {done.returncode}:\n{done.stdout}")
    return done.stdout


def main():
    readme, library, include, compiler = map(pathlib.Path, sys.argv[1:])
    text = readme.read_text(encoding="utf-8")
    programs = re.findall(r"^```c\n(.*?)^```", text, re.M | re.S)
    printed = re.findall(r"^ {4}(\d+ N/m, [\d.]+ J/m2)$", text, re.M)
    if len(programs) != 1 or len(printed) != 1:
        sys.exit(f"{readme} has {len(programs)} C programs and {len(printed)} lines of what it prints, expected one of each")
    with tempfile.TemporaryDirectory() as folder:
        source, program = pathlib.Path(folder, "peel.c"), pathlib.Path(folder, "peel")
        source.write_text(programs[0], encoding="utf-8")
        run([compiler, *STRICT, f"-I{include}", source, library, f"-Wl,-rpath,{library.parent}", "-o", program])
        found = run([program], env=dict(os.environ, OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1")).strip()
    print(f"{len(programs[0].splitlines())} lines print: {found}")
    if found != printed[0]:
        sys.exit(f"the README says: {printed[0]}")
    rate = numbers(found)[1]
    if not abs(rate - TOUGHNESS) <= 2e-3 * TOUGHNESS:
        sys.exit(f"energy release rate {rate} J/m2, expected {TOUGHNESS} within 0.2 %")


if __name__ == "__main__":
    main()
