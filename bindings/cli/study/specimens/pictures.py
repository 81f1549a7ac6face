# SPDX-License-Identifier: BSD-3-Clause
"""The picture of an evaluation: the load curve with its points, and the toughness over the length of the crack."""
import os

import numpy as np

from picture_style import BLUE, GREY, ORANGE, RED, plt, save

# Below this number of places a method has points, not a curve; marks are drawn as they are.
CURVE = 40
JUMP = 0.1  # of the range of lengths: a curve of CURVE points that grows steadily has steps of a quarter of it
LIGHT, LINES = "#b9bec6", "#3a3f47"
MARKS = (("o", BLUE), ("s", ORANGE), ("^", RED), ("v", GREY))


def draw(out, test, curve, answers, points, bands, intervals=None, level=0.95):
    """Lengths in mm, loads in N, toughnesses in J/m2. bands: those of a fit with their intervals. intervals: by method and
    point, with their level."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4.2), constrained_layout=True)
    if curve.whole:
        x, y = curve.whole
        left.plot(1e3 * x, y, color=LIGHT, linewidth=0.8, label="with unloadings")
    left.plot(1e3 * curve.displacement, curve.load, color=GREY, linewidth=0.8)
    lines_of_offset(left, curve, points)
    # Points may coincide: the later ones are smaller.
    for point, (marker, size) in zip(points.points, (("o", 11), ("s", 8), ("D", 6), ("^", 4))):
        left.plot(1e3 * point.displacement, point.load, marker, color=RED, markersize=size, fillstyle="none",
                  label=point.name)
    left.set_xlabel("displacement (mm)")
    left.set_ylabel("load (N)")
    left.legend(fontsize="small", frameon=True, framealpha=0.9, edgecolor="none")
    drawn = at_points(right, answers, points) if one_crack(answers) else along_crack(right, answers, points)
    ends = bars(right, answers, points, intervals or {}, level)
    for key, value, low, high in bands:
        if low == low and high == high:
            right.axhspan(low, high, color=BLUE, alpha=0.15, label=f"fit with its interval: {key}")
        right.axhline(value, color=BLUE, linewidth=0.8, label=None if low == low and high == high else f"fit: {key}")
    right.set_ylabel("toughness (J/m²)")
    rates = np.concatenate(drawn + [ends] + [[end] for band in bands for end in band[1:] if end == end])
    right.set_ylim(min(0.0, 1.05 * np.min(rates)), 1.15 * max(np.max(rates), 0.0))
    right.legend(fontsize="small")
    figure.suptitle(f"{os.path.basename(curve.path)}: {test}", fontsize=10)
    save(figure, os.path.join(out, "evaluate.png"))


def lines_of_offset(ax, curve, points):
    """The initial line and that of the 5 % offset, up to the largest load."""
    top = float(np.max(curve.load))
    for part, style, name in ((0.0, "--", "initial line"), (0.05, ":", "5 % offset")):
        ends = points.zero + np.array([0.0, (1 + part) * points.compliance * top])
        ax.plot(1e3 * ends, [0.0, top], style, color=LINES, linewidth=1.0, label=name)


def one_crack(answers):
    """True if all toughnesses belong to one crack length: there is no R-curve."""
    return np.ptp(np.concatenate([answer.crack for answer in answers])) <= 0


def at_points(ax, answers, points):
    """Draws the toughness at the points of the standard; returns the toughnesses of each method."""
    names = [point.name for point in points.points]
    rates = [np.array([answer.at(point, points.zero) for point in points.points]) for answer in answers]
    for answer, rate, (marker, colour) in zip(answers, rates, MARKS):
        ax.plot(range(len(names)), rate, marker, color=colour, label=answer.name, fillstyle="none")
    ax.set_xticks(range(len(names)), names)
    ax.set_xlim(-0.5, len(names) - 0.5)
    ax.set_xlabel(f"point of the curve, crack {1e3 * answers[0].crack[0]:g} mm")
    return rates


def bars(ax, answers, points, intervals, level):
    """Draws the intervals of the methods: at each point, or over the crack length at the largest load, side by side.
    Returns their ends."""
    alone, ends = one_crack(answers), []
    shown = list(enumerate(points.points)) if alone else [(1e3 * points.points[-1].crack, points.points[-1])]
    step = 0.012 * np.ptp(ax.get_xlim())
    for k, answer in enumerate(answers):
        for place, point in shown:
            one = intervals.get(answer.name, {}).get(point.name)
            if one is None or one.low is None or place != place:
                continue
            colour = next((line.get_color() for line in ax.lines if line.get_label() == answer.name), GREY)
            label = None if ends else f"{100 * level:g} % intervals" + ("" if alone else " at the largest load")
            middle = place + step * (k - 0.5 * (len(answers) - 1))
            ax.errorbar([middle], [0.5 * (one.low + one.high)], yerr=0.5 * (one.high - one.low), color=colour, capsize=3,
                        linewidth=1.0, linestyle="none", label=label)
            ends += [one.low, one.high]
    return ends


def along_crack(ax, answers, points):
    """Draws the toughness over the crack length; returns the toughnesses of each method."""
    marks, drawn = iter(MARKS), []
    for answer in answers:
        crack, rate = answer.crack, answer.rate
        # A method for one crack length has no curve over lengths: its values at the points of the standard.
        if len(rate) >= CURVE and not np.ptp(crack) > 0:
            rate = np.array([answer.at(point, points.zero) for point in points.points])
            crack = np.full(len(rate), crack[0])
        style, colour = ("-", GREY) if len(rate) >= CURVE else next(marks)
        if len(rate) >= CURVE:  # no line through lengths that a crack has jumped over
            over = np.flatnonzero(np.abs(np.diff(crack)) > JUMP * np.ptp(crack)) + 1
            crack, rate = np.insert(crack, over, np.nan), np.insert(rate, over, np.nan)
        ax.plot(1e3 * crack, rate, style, color=colour, label=answer.name, fillstyle="none")
        drawn.append(rate[np.isfinite(rate)])
    ax.set_xlabel("crack length (mm)")
    return drawn
