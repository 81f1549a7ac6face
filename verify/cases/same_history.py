#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""same_history.py REFERENCE HOST [ARGUMENT ...]: two hosts of one scene write the same history.

Each is run with the name of a csv file behind its arguments. Titles are equal, numbers up to 1e-12 of the largest of
their column: one machine, one thread and one set of kernels for both.
"""
import csv
import os
import subprocess
import sys
import tempfile

TOLERANCE = 1e-12


def history(command, path):
    environment = dict(os.environ, OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1")
    subprocess.run([*command, path], check=True, env=environment)
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    return rows[0], [[float(text) for text in row] for row in rows[1:]]


def main():
    reference, host = sys.argv[1], sys.argv[2:]
    with tempfile.TemporaryDirectory() as folder:
        titles, expected = history([reference], os.path.join(folder, "reference.csv"))
        other_titles, found = history(host, os.path.join(folder, "host.csv"))
    if titles != other_titles or len(expected) != len(found) or len(expected) < 2:
        print(f"columns {titles} in {len(expected)} rows, from {host[0]} {other_titles} in {len(found)}")
        return 1
    worst = 0.0
    for column, title in enumerate(titles):
        largest = max(abs(row[column]) for row in expected)
        for step, (a, b) in enumerate(zip(expected, found)):
            difference = abs(a[column] - b[column])
            if not difference <= TOLERANCE * largest:
                print(f"{title} of row {step}: {a[column]!r} in the reference, {b[column]!r} from {host[0]}")
                return 1
            worst = max(worst, difference / largest if largest > 0 else 0.0)
    print(f"{len(expected)} rows of {len(titles)} columns, largest relative difference {worst:g}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
