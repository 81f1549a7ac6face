# SPDX-License-Identifier: BSD-3-Clause
"""The picture of a series: all load curves, and all R-curves with their mean."""
import os

import numpy as np

from picture_style import GREY, plt, save
from series.statistics import values_of

BESIDE = 0.06  # of the distance of two points, between specimens that stand side by side
MANY = 10  # specimens with a colour of their own; more have one colour, and no legend
LEAST_MEAN = 2  # R-curves of which a mean is drawn
GRID = 60  # places of the mean


def draw(out, test, members, columns, found):
    """Lengths in mm, loads in N, toughnesses in J/m2. The R-curves are those of the method that most specimens have."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.4), constrained_layout=True)
    shown = [member for member in members if member.found]
    colours = plt.get_cmap("tab10").colors if len(shown) <= MANY else [GREY]
    methods = list(dict(columns))
    method = max(methods, key=lambda name: len(values_of(shown, name, "max")[0]))
    points = [point for name, point in columns if name == method]
    answers = [next((one for one in member.found.answers if one.name == method), None) for member in shown]
    curves = [(member, answer) for member, answer in zip(shown, answers) if answer is not None]
    along = all(np.ptp(answer.crack) > 0 for _, answer in curves)
    for k, member in enumerate(shown):
        colour = colours[k % len(colours)]
        left.plot(1e3 * member.found.curve.displacement, member.found.curve.load, color=colour, linewidth=0.9,
                  linestyle="-" if member.counted else ":", label=member.name + ("" if member.counted else " (left out)"))
        if answers[k] is None:
            continue
        if along:
            many = len(answers[k].rate) > GRID
            right.plot(1e3 * answers[k].crack, answers[k].rate, "-" if many else "o-" if member.counted else "o:", color=colour, markersize=4,
                       linewidth=0.7, alpha=0.8)
        else:
            rates = [answers[k].at(point, member.found.points.zero) for point in member.found.points.points]
            shift = BESIDE * (k - 0.5 * (len(shown) - 1)) / max(1.0, len(shown) / 8)
            right.plot(np.arange(len(rates)) + shift, rates, "o" if member.counted else "x", color=colour, markersize=4)
    counted = [answer for member, answer in curves if member.counted]
    if along:
        mean_along(right, counted)
        right.set_xlabel("crack length (mm)")
    else:
        means(right, points, method, found)
    left.set_xlabel("displacement (mm)")
    left.set_ylabel("load (N)")
    if len(shown) <= MANY:
        left.legend(fontsize="small", framealpha=0.9, edgecolor="none")
    right.set_ylabel("toughness (J/m²)")
    right.set_ylim(bottom=0.0)
    if right.get_legend_handles_labels()[0]:
        right.legend(fontsize="small", loc="lower right")
    right.set_title(method, fontsize=10)
    figure.suptitle(f"{test}: {sum(member.counted for member in shown)} specimens", fontsize=10)
    save(figure, os.path.join(out, "series.png"))


def mean_curve(answers):
    """Lengths, mean and standard deviation of R-curves, where all of them have values; None: they have no length in common."""
    sorted_ones = [(answer.crack[order], answer.rate[order]) for answer in answers for order in [np.argsort(answer.crack)]]
    low, high = max(crack[0] for crack, _ in sorted_ones), min(crack[-1] for crack, _ in sorted_ones)
    if len(answers) < LEAST_MEAN or not high > low:
        return None
    at = np.linspace(low, high, GRID)
    rates = np.array([np.interp(at, crack, rate) for crack, rate in sorted_ones])
    return at, rates.mean(0), rates.std(0, ddof=1)


def mean_along(ax, answers):
    found = mean_curve(answers)
    if found is None:
        return
    at, mean, deviation = found
    ax.fill_between(1e3 * at, mean - deviation, mean + deviation, color=GREY, alpha=0.2, linewidth=0, label="± standard deviation")
    ax.plot(1e3 * at, mean, color="black", linewidth=1.8, label="mean, where all have values")


def means(ax, points, method, found):
    """The mean at each point, with its standard deviation."""
    for k, point in enumerate(points):
        one = found[method, point]
        if one.mean is not None:
            ax.errorbar(k, one.mean, yerr=one.deviation or 0.0, color="black", fmt="_", markersize=16, capsize=4,
                        label="mean ± standard deviation" if k == 0 else None)
    ax.set_xticks(range(len(points)), points)
    ax.set_xlim(-0.5, len(points) - 0.5)
    ax.set_xlabel("point of the curve")
