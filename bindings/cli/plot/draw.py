#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""`delam check --draw`: draws a scene that the program has read. Argument: JSON with the file, and the descriptor from
which to read what is drawn (src/command/drawing.cpp). Needs Debian's python3-numpy and python3-matplotlib."""
import json
import os
import sys

HERE = os.path.dirname(os.path.realpath(__file__))
# What draws is beside this script where that is installed, and in the Python package among the sources.
sys.path[:0] = [HERE, os.path.join(HERE, "..", "..", "python", "src", "delam"), os.path.join(HERE, "study"),
                os.path.join(HERE, "..", "study")]

import command  # noqa: E402

if __name__ == "__main__":
    command.begin("delam: check")

from packages import require  # noqa: E402

require("numpy", "matplotlib", "h5py")

from _pictures.drawing import scene_figure  # noqa: E402
from _pictures.result import for_files, save  # noqa: E402

for_files()


def main():
    given = json.loads(sys.argv[1])
    with os.fdopen(given["descriptor"], encoding="utf-8") as between:
        scene = json.load(between)
    save(scene_figure(scene), given["file"])
    return 0


if __name__ == "__main__":
    command.run(main)
