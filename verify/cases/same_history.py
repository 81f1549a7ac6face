#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""same_history.py [--scene NAME] [--delam PROGRAM SCENE.toml] REFERENCE [HOST [ARGUMENT ...]]

Hosts of one scene write one history. Each is run with the name of a csv file behind its arguments.

HOST      beside REFERENCE: titles are equal, numbers up to 1e-12 of the largest of their column: one machine, one
          thread and one set of kernels for both. A host that exits with 77 is skipped, and so is this
--scene   the last of them has the values of the scene in examples/reference.csv
--delam   the command line writes REFERENCE's history byte for byte, and further columns behind
"""
import argparse
import csv
import os
import pathlib
import subprocess
import sys
import tempfile

TOLERANCE = 1e-12
SKIPPED = 77
TABLE = pathlib.Path(__file__).resolve().parents[2] / "examples" / "reference.csv"


class Failure(Exception):
    pass


def run(command):
    environment = dict(os.environ, OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1")
    done = subprocess.run(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode == SKIPPED:
        print(done.stdout.strip())
        sys.exit(SKIPPED)
    if done.returncode != 0:
        raise Failure(f"{' '.join(command)} exits with {done.returncode}:\n{done.stdout}")


def history(command, path):
    run([*command, str(path)])
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    if len(rows) < 3:
        raise Failure(f"{command[0]} wrote {len(rows)} lines, expected a title and two steps or more")
    return rows[0], [[float(text) for text in row] for row in rows[1:]]


def compare(reference, found, host):
    (titles, expected), (other_titles, rows) = reference, found
    if titles != other_titles or len(expected) != len(rows):
        raise Failure(f"columns {titles} in {len(expected)} rows, from {host} {other_titles} in {len(rows)}")
    worst = 0.0
    for column, title in enumerate(titles):
        largest = max(abs(row[column]) for row in expected)
        for step, (a, b) in enumerate(zip(expected, rows)):
            difference = abs(a[column] - b[column])
            if not difference <= TOLERANCE * largest:
                raise Failure(f"{title} of row {step}: {a[column]!r} in the reference, {b[column]!r} from {host}")
            worst = max(worst, difference / largest if largest > 0 else 0.0)
    print(f"{len(expected)} rows of {len(titles)} columns, largest relative difference {worst:g}")


def compare_with_table(scene, found, host):
    titles, rows = found
    with open(TABLE, newline="", encoding="utf-8") as file:
        wanted = [row for row in csv.DictReader(file) if row["scene"] == scene]
    if not wanted:
        raise Failure(f"{TABLE} has no rows of the scene {scene}")
    missing = sorted({row["quantity"] for row in wanted} - set(titles))
    if missing:
        raise Failure(f"{host} wrote no column {', '.join(missing)}")
    steps = {row[titles.index("step")]: row for row in rows}
    different = []
    for row in wanted:
        value, tolerance = float(row["value"]), float(row["tolerance"])
        here = steps[float(row["step"])][titles.index(row["quantity"])]
        if not abs(here - value) <= tolerance * abs(value):
            different.append(f"{row['quantity']} of step {row['step']}: {value!r} +- {tolerance:g} by {row['source']}, "
                             f"{here!r} from {host}")
    if different:
        raise Failure("\n".join(different))
    print(f"{len(wanted)} values of {TABLE.name}")


def compare_bytes(program, scene, path, folder):
    out = folder / "out"
    run([program, "run", scene, "--out", str(out)])
    expected = path.read_text(encoding="utf-8").splitlines()
    columns = expected[0].count(",") + 1
    found = [",".join(line.split(",")[:columns])
             for line in (out / "history.csv").read_text(encoding="utf-8").splitlines()]
    for number, (line, other) in enumerate(zip(expected, found), start=1):
        if line != other:
            raise Failure(f"line {number} of the history: {line}\nfrom {program}: {other}")
    if len(expected) != len(found):
        raise Failure(f"{len(expected)} lines, from {program} {len(found)}")
    print(f"{len(expected)} lines, byte for byte those of {program}")


def main():
    parser = argparse.ArgumentParser(description="one scene, several hosts, one history")
    parser.add_argument("--scene")
    parser.add_argument("--delam", nargs=2, metavar=("PROGRAM", "SCENE.toml"))
    parser.add_argument("reference")
    parser.add_argument("host", nargs=argparse.REMAINDER)
    options = parser.parse_args()
    try:
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            found = reference = history([options.reference], folder / "reference.csv")
            if options.host:
                found = history(options.host, folder / "host.csv")
                compare(reference, found, options.host[0])
            if options.scene:
                compare_with_table(options.scene, found, (options.host or [options.reference])[0])
            if options.delam:
                compare_bytes(*options.delam, folder / "reference.csv", folder)
    except Failure as failure:
        print(failure)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
