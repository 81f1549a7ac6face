# SPDX-License-Identifier: BSD-3-Clause
"""Labels of a drawing in rows above and below it, none over another, each at a vertical line to what it names."""
import random
import textwrap
from dataclasses import dataclass

WRAPPED = 46  # characters in a line: three such labels stand side by side in a page
# So many orders of the labels are tried. With half of them, a line passes behind a text in eight drawings of examples/
# and of three specimens of `delam new`; with all of them, and with twice as many, in six (`delam check --draw` of
# each).
ORDERS = 40
GAP, BESIDE, EDGE = 0.12, 0.05, 0.02  # inches: between texts, from a line to its text, from a text to other lines


@dataclass
class Label:
    """The text, the place that it names and, once it is placed, its left end and its row. Lengths are in inches."""
    text: str
    x: float
    y: float
    colour: str
    width: float = 0.0
    left: float = 0.0
    row: int = -1

    @property
    def lines(self):
        return textwrap.wrap(self.text, WRAPPED, break_long_words=True) or [""]


def _free(label, left, row, placed):
    """True if the text there covers no other one, crosses no line to a text above it, and its own line crosses none."""
    right = left + label.width
    for other in placed:
        begin, end = other.left - EDGE, other.left + other.width + EDGE
        if other.row == row and left < end + GAP and right > begin - GAP:
            return False
        if other.row < row and begin < label.x < end or other.row > row and left - EDGE < other.x < right + EDGE:
            return False
    return True


def _placed(labels, width):
    """Places the labels in this order; returns how many found no free place. Those get a row of their own."""
    placed, failures = [], 0
    for label in labels:
        sides = (label.x + BESIDE, label.x - BESIDE - label.width)
        sides = [left for left in sides if left >= 0 and left + label.width <= width]
        highest = max((other.row for other in placed), default=-1) + 1
        tried = ((row, left) for row in range(highest + 1) for left in sides)
        at = next((one for one in tried if _free(label, one[1], one[0], placed)), None)
        if at is None:
            failures += 1
            at = highest, min(max(label.x + BESIDE, 0.0), width - label.width)
        label.row, label.left = at
        placed.append(label)
    return failures


def place(labels, width):
    """Chooses row (0 is next to the drawing) and left end of each label within 0 and `width`; returns the number of
    rows. From right to left each text finds a row on the right of its line; where texts at the right edge need another
    order, some are tried, the same ones each time."""
    orders = [sorted(labels, key=lambda one: -one.x), sorted(labels, key=lambda one: one.x)]
    mixed = random.Random(0)
    orders += [mixed.sample(labels, len(labels)) for _ in range(ORDERS)]
    _placed(min(orders, key=lambda order: _placed(order, width)), width)
    return max((label.row for label in labels), default=-1) + 1
