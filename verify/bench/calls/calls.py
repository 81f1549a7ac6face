#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""calls.py [--build FOLDER] [--rounds N] [--calls N] [--steps N]: what a call costs through each language.

FOLDER     the build folder (default build/release) with the targets bench_calls_c, _cpp and _fortran
A round runs each language once, in a process of its own, in an order that turns; Julia where it is. Prints medians and
quartiles of nanoseconds of processor time (Julia: of the wall clock), and the median over rounds of the difference to C
in the same round.
"""
import argparse
import os
import pathlib
import shutil
import statistics
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]


def commands(build):
    found = {}
    for language in ("c", "cpp", "fortran"):
        program = build / "verify" / f"calls_{language}"
        if program.exists():
            found[language] = [str(program)]
        else:
            print(f"left out: {program} is not built")
    found["python"] = ["/usr/bin/python3", str(HERE / "calls_python.py")]
    if shutil.which("julia"):
        package = ROOT / "bindings" / "julia"
        found["julia"] = ["julia", "--startup-file=no", f"--project={package}", str(HERE / "calls.jl")]
    else:
        print("left out: julia is not installed")
    return found


def main():
    parser = argparse.ArgumentParser(description="what a call of the library costs through each language")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build" / "release")
    parser.add_argument("--rounds", type=int, default=15)
    parser.add_argument("--calls", type=int, default=200000)
    parser.add_argument("--steps", type=int, default=2000)
    options = parser.parse_args()
    hosts = commands(options.build)
    if "c" not in hosts:
        sys.exit("nothing to compare with")
    environment = dict(os.environ, OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1",
                       PYTHONPATH=str(ROOT / "bindings" / "python" / "src"))
    environment.setdefault("DELAM_LIBRARY", str(options.build / "lib"))
    rounds, last = [], set()
    for number in range(options.rounds):
        order = list(hosts)[number % len(hosts):] + list(hosts)[:number % len(hosts)]
        times = {}
        for language in order:
            done = subprocess.run([*hosts[language], str(options.calls), str(options.steps)], check=True, text=True,
                                  capture_output=True, env=environment)
            per_call, per_step, value = map(float, done.stdout.split())
            times[language] = per_call, per_step
            last.add(round(value, 3))
        rounds.append(times)
    if len(last) != 1:
        sys.exit(f"the languages do not compute the same: {sorted(last)}")
    print(f"{options.rounds} rounds of {options.calls} calls and {options.steps} steps, ns: median (quartiles), "
          "over C in the same round")
    print(f"{'':8} {'value by key':>28} {'over C':>9} {'step (advance, commit)':>32} {'over C':>9}")
    for language in hosts:
        cells = []
        for column, width in ((0, 28), (1, 32)):
            times = [times[language][column] for times in rounds]
            over = statistics.median(times[language][column] - times["c"][column] for times in rounds)
            low, middle, high = statistics.quantiles(times, n=4)
            cells.append(f"{f'{middle:.0f} ({low:.0f} to {high:.0f})':>{width}} {over:9.0f}")
        print(f"{language:8} {' '.join(cells)}")


main()
