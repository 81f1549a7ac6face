# SPDX-License-Identifier: BSD-3-Clause
"""Texts beside a drawing: labels in rows above and below it, none over another, each at a vertical line to what it
names; and dimension lines of layers in the plane: thicknesses, the whole length, and lengths between what holds and
moves the layers and the ends of notches. Lengths on the paper are in inches."""
import random
import textwrap
from dataclasses import dataclass

import numpy as np

from .result import GREY, plt

WRAPPED = 46  # characters in a line: three such labels stand side by side in a page
# So many orders of the labels are tried. With half of them, a line passes behind a text in eight drawings of examples/
# and of three specimens of `delam new`; with all of them, and with twice as many, in six (`delam check --draw` of
# each).
ORDERS = 40
GAP, BESIDE, EDGE = 0.12, 0.05, 0.02  # inches: between texts, from a line to its text, from a text to other lines
MOST_LAYERS = 8  # of more the thicknesses stand too close to be read
NARROW = 0.06  # of the length: a roller or a nose has a place, a longer support does not
DOWN, APART = 0.46, 0.24  # from the bodies to the first line, and from there to the next
RIGHT, ARROW, SIZE = 0.34, 0.04, 9  # from the bodies to the lines of thicknesses; half of the width of a tick; points


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
    rows, and how many labels found no free place. From right to left each text finds a row on the right of its
    line; where texts at the right edge need another order, some are tried, the same ones each time."""
    orders = [sorted(labels, key=lambda one: -one.x), sorted(labels, key=lambda one: one.x)]
    mixed = random.Random(0)
    orders += [mixed.sample(labels, len(labels)) for _ in range(ORDERS)]
    failures = _placed(min(orders, key=lambda order: _placed(order, width)), width)
    return max((label.row for label in labels), default=-1) + 1, failures


def layers_of(scene, points):
    """Returns lower and upper ends of bodies that lie on each other over the whole length, by the number of the body;
    nothing if the bodies are anything else."""
    body = np.asarray(scene["body"])
    bodies = np.unique(body)
    if scene["dimension"] != 2 or len(bodies) > MOST_LAYERS:
        return {}
    offsets, nodes = np.asarray(scene["offsets"]), np.asarray(scene["faces"])
    owner = np.repeat(body, np.diff(offsets))
    low, high = points[:, :2].min(0), points[:, :2].max(0)
    rounding, ends, out = 1e-6 * (high - low).max(), low[1], {}
    for b in sorted(bodies, key=lambda one: points[nodes[owner == one], 1].min()):
        at = points[nodes[owner == b], :2]
        if max(abs(at[:, 0].min() - low[0]), abs(at[:, 0].max() - high[0]), abs(at[:, 1].min() - ends)) > rounding:
            return {}
        ends = at[:, 1].max()
        out[int(b)] = float(at[:, 1].min()), float(ends)
    return out


def stations(scene, points):
    """Returns the places between which lengths are measured: the ends, narrow supports and loads, ends of notches. A
    patch of the scene has its centre, which may lie between nodes, and other supports the middle of their nodes."""
    low, high = points[:, 0].min(), points[:, 0].max()
    found = [low, high]
    for mark in scene["marks"]:
        x = np.asarray(mark["points"], float).reshape(-1, 3)[:, 0]
        if len(x) and np.ptp(x) < NARROW * (high - low):
            found.append(mark["centre"][0] if "centre" in mark else 0.5 * (x.min() + x.max()))
    for one in scene["interfaces"]:
        offsets, nodes = np.asarray(one["offsets"]), np.asarray(one["faces"], int)
        open_faces = np.repeat(np.asarray(one["adhesion"], float) <= 0, np.diff(offsets))
        x = points[nodes[open_faces], 0]
        if one["law"] and len(x):
            found += [x.min(), x.max()]
    found = np.sort(found)
    return found[np.concatenate([[True], np.diff(found) > 1e-3 * (high - low)])]


def _line(figure, begin, end, text):
    """Draws a line between two places of the page, with a tick at each end and the number on it, or beneath where the
    line is too short for that."""
    width, height = figure.get_size_inches()
    begin, end = np.asarray(begin), np.asarray(end)
    length = np.linalg.norm(end - begin)
    across = ARROW * np.array([-(end - begin)[1], (end - begin)[0]]) / length
    for one, other in ((begin, end), (begin - across, begin + across), (end - across, end + across)):
        figure.add_artist(plt.Line2D([one[0] / width, other[0] / width], [one[1] / height, other[1] / height],
                                     color=GREY, linewidth=0.8, transform=figure.transFigure, zorder=2))
    label = figure.text(*(0.5 * (begin + end) / (width, height)), text, fontsize=SIZE, ha="center", va="center",
                        zorder=3, color="#33373d", bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.8})
    upright = begin[0] == end[0]
    box = label.get_window_extent(figure.canvas.get_renderer())
    if (box.height if upright else box.width) / figure.dpi > length - 0.06:
        shift = (0.16, 0.0) if upright else (0.0, -0.13)
        label.set_position((0.5 * (begin + end) + shift) / (width, height))


def draw_dimensions(figure, scene, points, layers, box, scale, unit):
    """box: left, bottom, right, top of the bodies; scale: inches per length along x and y; unit: factor and name."""
    factor, name = unit
    at = stations(scene, points)
    low = points[:, :2].min(0)

    def number(length):
        return f"{factor * length:.4g}" if factor * length < 9999.5 else f"{factor * length:.0f}"

    def x_of(x):
        return box[0] + scale[0] * (x - low[0])

    for begin, end in zip(at[:-1], at[1:]) if len(at) > 2 else ():
        _line(figure, (x_of(begin), box[1] - DOWN), (x_of(end), box[1] - DOWN), number(end - begin))
    below = box[1] - DOWN - APART
    _line(figure, (box[0], below), (box[2], below), f"{number(at[-1] - at[0])} {name}".rstrip())
    for begin, end in layers.values():
        y = [box[1] + scale[1] * (one - low[1]) for one in (begin, end)]
        _line(figure, (box[2] + RIGHT, y[0]), (box[2] + RIGHT, y[1]), number(end - begin))
