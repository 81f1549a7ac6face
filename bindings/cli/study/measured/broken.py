# SPDX-License-Identifier: BSD-3-Clause
"""The break of a specimen at the end of a test: the load falls to zero at once and stays there, while the machine goes on."""
import numpy as np

NOTHING = 0.05  # of the largest load: load cells creep and drift by less, and no arm that is still bent carries so little
# Before a break there was this part at least: a crack that has run through the specimen, or an unloading, comes down to
# nothing by and by. A drop of ENF or MMB keeps a third and more of the load, and the load rises again behind it.
SUDDEN = 0.15
AT_ONCE = 0.005  # of the range of x, within which the load falls: some points of it may lie on the way
BACK = 0.01  # of the range of x, by which a machine that unloads goes back before the load is gone


def broken_at(x, y):
    """The place of the first point behind the break; None: there is none. x, y: turned, along the way of the test."""
    largest, wide = np.max(y), np.ptp(x)
    carrying = np.flatnonzero(y >= NOTHING * largest)
    if not largest > 0 or not carrying.size or carrying[-1] + 1 >= len(y):
        return None
    gone = int(carrying[-1]) + 1
    if x[gone] < np.max(x[:gone]) - BACK * wide:
        return None
    first = gone - 1
    while first > 0 and abs(x[gone] - x[first - 1]) <= AT_ONCE * wide:
        first -= 1
    before = float(np.max(y[max(0, first - 1):gone]))
    if not before >= SUDDEN * largest:
        return None
    level = 0.8 * before
    while y[gone - 1] < level:
        gone -= 1
    return gone


def said_of_break(x, rows, unit):
    """x: where it breaks, with its unit; rows: how many are left out."""
    return (f"the load drops to zero at {x:.4g}{' ' * bool(unit)}{unit}: the specimen breaks there, and the {rows} row"
            f"{'s' * (rows > 1)} behind {'are' if rows > 1 else 'is'} left out")
