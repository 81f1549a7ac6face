#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of a result of `delam run`: plot.py DIR writes DIR/load-displacement.png, energies.png and snapshots.png,
stress-strain.png where the history has averages of both, stresses.png of plane scenes with prescribed strains,
fronts.png of fronts in space, cut.png of bodies in space. --cut y=0.01 says where to cut.

Reads DIR/history.csv, fields.h5 and result.json. Needs Debian's python3-numpy, python3-matplotlib and python3-h5py.
"""
import os
import sys

import h5py

from cells import ZETA, text_of
from curves import plot_averages, plot_energies, plot_load
from cut import plane_of, plot_cut
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
    words = sys.argv[1:]
    if len(words) not in (1, 3) or words[0].startswith("-") or words[1:2] not in ([], ["--cut"]):
        print("usage: plot.py DIR [--cut x=PLACE | --cut y=PLACE | --cut z=PLACE]", file=sys.stderr)
        return 2
    folder = words[0]
    try:
        plane = plane_of(words[2]) if len(words) == 3 else None
    except ValueError:
        print(f"plot.py: --cut {words[2]}: it takes x, y or z, =, and a number, like y=0.01", file=sys.stderr)
        return 2
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
    plot_cut(result, plane)
    return 0


if __name__ == "__main__":
    sys.exit(main())
