#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of a result of `delam run`: plot.py DIR writes DIR/load-displacement.png, energies.png and snapshots.png,
stress-strain.png where the history has averages of both, stresses.png of plane scenes with prescribed strains,
fronts.png of fronts in space.

Reads DIR/history.csv, fields.h5 and result.json. Needs Debian's python3-numpy, python3-matplotlib and python3-h5py.
"""
import os
import sys

import h5py

from cells import ZETA, text_of
from curves import plot_averages, plot_energies, plot_load
from fronts import plot_fronts
from result import Result
from snapshots import plot_snapshots
from stresses import plot_stresses


def plot_plan(result):
    """Fronts in space, where there are some."""
    if result.about["scene"]["dimension"] == 2:
        return
    with h5py.File(os.path.join(result.folder, "fields.h5"), "r") as file:
        figure = plot_fronts(result, file, lambda interface: text_of(interface.attrs["name"]), ZETA)
    if figure is not None:
        result.stamp(figure)
        result.save(figure, "fronts.png")


def main():
    if len(sys.argv) != 2 or sys.argv[1] in ("-h", "--help"):
        print("usage: plot.py DIR", file=sys.stderr)
        return 2
    folder = sys.argv[1]
    try:
        result = Result(folder)
    except FileNotFoundError as error:
        print(f"plot.py: {folder} holds no result: {error.filename} is missing", file=sys.stderr)
        return 2
    plot_load(result)
    plot_averages(result)
    plot_energies(result)
    plot_snapshots(result)
    plot_stresses(result)
    plot_plan(result)
    return 0


if __name__ == "__main__":
    sys.exit(main())
