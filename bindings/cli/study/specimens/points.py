# SPDX-License-Identifier: BSD-3-Clause
"""Points of a load curve at which standards evaluate: the initial compliance, the 5 % offset, the largest load."""
from dataclasses import dataclass

import numpy as np

from command import Trouble

# The initial line goes through the points between these parts of the largest load: below is the slack of the fixture,
# above the crack may grow. From 0.05 to 0.4 and 0.2 to 0.6, its compliance on beams of test_evaluate.py is within 0.5 %.
LOW, HIGH = 0.1, 0.5


@dataclass
class Point:
    """name, place among the points of the curve, displacement, load; crack: its length, where the file has it."""
    name: str
    place: int
    displacement: float
    load: float
    crack: float = float("nan")


def initial_line(displacement, load, path):
    """The compliance of the initial straight line, and where it meets the axis of displacements."""
    top = int(np.argmax(load))
    rising = np.arange(len(load)) <= top
    chosen = rising & (load >= LOW * load[top]) & (load <= HIGH * load[top])
    if chosen.sum() < 3:
        raise Trouble(f"{path}: {int(chosen.sum())} points lie between {100 * LOW:g} and {100 * HIGH:g} % of the largest load "
                      "before it: at least 3 are expected for the initial compliance")
    compliance, zero = np.polyfit(load[chosen], displacement[chosen], 1)
    if not compliance > 0:
        raise Trouble(f"{path}: the load does not rise with the displacement at first")
    return float(compliance), float(zero)


def standard_points(displacement, load, path):
    """The compliance, and the points "5 %" and "max": where the curve meets the line with a compliance 5 % larger, or
    its largest load if that comes first, and its largest load (ISO 15024, 9.2; ASTM D5528, 11.1)."""
    compliance, zero = initial_line(displacement, load, path)
    top = int(np.argmax(load))
    beyond = displacement - zero > 1.05 * compliance * load
    # From the last point of the initial line on: the slack below it lies beyond the line, too.
    first = int(np.flatnonzero(load[:top + 1] >= HIGH * load[top])[0])
    found = np.flatnonzero(beyond[first:top + 1])
    offset = first + int(found[0]) if found.size else top
    return compliance, zero, [Point("5 %" if found.size else "5 % (after the largest load, which is taken)", offset,
                                    float(displacement[offset]), float(load[offset])),
                              Point("max", top, float(displacement[top]), float(load[top]))]
