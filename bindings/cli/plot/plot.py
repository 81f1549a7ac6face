#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of a result of `delam run`: plot.py DIR writes DIR/load-displacement.png, energies.png and snapshots.png,
stress-strain.png where the history has averages of both, stresses.png of plane scenes with prescribed strains,
fronts.png of fronts in space, cut.png of bodies in space. --cut y=0.01 says where to cut.

Reads DIR/history.csv, fields.h5 and result.json. Needs Debian's python3-numpy, python3-matplotlib and python3-h5py.
"""
import os
import sys

HERE = os.path.dirname(os.path.realpath(__file__))
# What draws is beside this script where that is installed, and in the Python package among the sources.
sys.path[:0] = [HERE, os.path.join(HERE, "..", "..", "python", "src", "delam"), os.path.join(HERE, "study"),
                os.path.join(HERE, "..", "study")]

import command  # noqa: E402

if __name__ == "__main__":
    command.begin("plot.py")

from packages import require  # noqa: E402

require("numpy", "matplotlib", "h5py")

from _pictures.curves import averages_figure, energies_figure, load_figure  # noqa: E402
from _pictures.cut import cut_figure, plane_of  # noqa: E402
from _pictures.fronts import fronts_figure  # noqa: E402
from _pictures.input_file import Unreadable  # noqa: E402
from _pictures.result import Nothing, Result, for_files  # noqa: E402
from _pictures.snapshots import snapshots_figure  # noqa: E402
from _pictures.stresses import stresses_figure  # noqa: E402
from command import complain  # noqa: E402

for_files()
PICTURES = {"load-displacement.png": load_figure, "stress-strain.png": averages_figure, "energies.png": energies_figure,
            "snapshots.png": snapshots_figure, "stresses.png": stresses_figure, "fronts.png": fronts_figure}


def write(result, name, draw, *arguments):
    try:
        figure = draw(result, *arguments)
    except Nothing as reason:
        if not reason.expected:
            complain(f"{reason}, so no {name}")
        return
    except Unreadable:
        raise
    except (KeyError, IndexError, ValueError, TypeError) as error:
        raise Unreadable(f"{result.folder}: the result lacks what {name} shows, or is damaged: {error}") from error
    result.save(figure, name)


def main():
    words = sys.argv[1:]
    if len(words) not in (1, 3) or words[0].startswith("-") or words[1:2] not in ([], ["--cut"]):
        complain("usage: plot.py DIR [--cut x=PLACE | --cut y=PLACE | --cut z=PLACE]")
        return 2
    folder = words[0]
    try:
        plane = plane_of(words[2]) if len(words) == 3 else None
    except ValueError:
        complain(f"--cut {words[2]}: it takes x, y or z, =, and a number, like y=0.01")
        return 2
    try:
        result = Result(folder)
    except FileNotFoundError as error:
        complain(f"{folder} holds no result: {error.filename} is missing")
        return 2
    for name, draw in PICTURES.items():
        write(result, name, draw)
    write(result, "cut.png", cut_figure, plane)
    return 0


if __name__ == "__main__":
    command.run(main)
