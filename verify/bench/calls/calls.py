#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""calls.py [--build FOLDER] [--rounds N] [--calls N] [--steps N]: what a call costs through each language.

FOLDER     the build folder (default build/release) with the targets bench_calls_c, _cpp and _fortran
A round runs each language once, in a process of its own, in an order that turns; Julia where it is. Prints medians and
quartiles of nanoseconds of processor time (Julia: of the wall clock), and the median over rounds of the difference to C
in the same round with its quartiles. Behind the times every program prints what its analysis ends with; these must be
those of C in every bit and every round: exit status 1 if they are not.
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


def compare(ends, rounds):
    """Every end of every language beside that of C: how many numbers, how many differ in a bit, and by how much."""
    wrong = 0
    reference = min(ends["c"])
    for language, found in ends.items():
        numbers = min(len(end) for end in found)
        differ, worst = 0, 0.0
        for end in found:
            pairs = list(zip(end, reference))
            differ += sum(a.hex() != b.hex() for a, b in pairs) + abs(len(end) - len(reference))
            worst = max([worst, *(abs(a - b) / max(abs(a), abs(b)) for a, b in pairs if a != b)])
        broken = sum(0.0 < v < 1.0 for v in reference[6:])
        print(f"values: {language}: {numbers} numbers in {rounds} rounds, {differ} not the bits of C, "
              f"relative difference {worst:.3g}, {broken} pairs partly damaged")
        wrong += differ
    return 1 if wrong or len(reference) < 7 else 0


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
    rounds, ends = [], {language: set() for language in hosts}
    for number in range(options.rounds):
        order = list(hosts)[number % len(hosts):] + list(hosts)[:number % len(hosts)]
        times = {}
        for language in order:
            done = subprocess.run([*hosts[language], str(options.calls), str(options.steps)], check=True, text=True,
                                  capture_output=True, env=environment)
            per_call, per_step, *end = map(float, done.stdout.split())
            times[language] = per_call, per_step
            ends[language].add(tuple(end))
        rounds.append(times)
    print(f"{options.rounds} rounds of {options.calls} calls and {options.steps} steps, ns: median (quartiles), "
          "over C in the same round")
    print(f"{'':8} {'value by key':>28} {'over C':>26} {'step (advance, commit)':>32} {'over C':>26}")
    for language in hosts:
        cells = []
        for column, width in ((0, 28), (1, 32)):
            times = [times[language][column] for times in rounds]
            least, over, most = statistics.quantiles((t[language][column] - t["c"][column] for t in rounds), n=4)
            low, middle, high = statistics.quantiles(times, n=4)
            cells += [f"{f'{middle:.0f} ({low:.0f} to {high:.0f})':>{width}}",
                      f"{f'{over:.0f} ({least:.0f} to {most:.0f})':>26}"]
        print(f"{language:8} {' '.join(cells)}")
    return compare(ends, options.rounds)


sys.exit(main())
