# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of a sweep: all load curves in one figure, and the peak of the reaction over each key."""
import os

import numpy as np

from measured.units import unit_of_key
from picture_style import axis, colours_of, name_axis, plt, save, scales_of


def numbers(sweep, which):
    """The values of a key in all runs as numbers; words by their place."""
    values = [point[which] for point in sweep.points]
    if all(isinstance(value, (int, float)) for value in values):
        return np.array(values, float), None
    words = list(dict.fromkeys(map(str, values)))
    return np.array([words.index(str(value)) for value in values], float), words


def named(sweep, key):
    """A key with the unit of its numbers, where the scene names units."""
    return axis(key, unit_of_key(key, sweep.units).strip())


def draw_curves(sweep, histories, about):
    """The colour is that of the first key."""
    values, words = numbers(sweep, 0)
    name = sweep.variations[0].path
    figure, ax = plt.subplots(figsize=(7.2, 4.6), constrained_layout=True)
    colours, scale = colours_of(values, sweep.variations[0].log)
    for number, history in histories.items():
        load = next(key for key in history if key == "load" or key.startswith("load_"))
        ax.plot(history[load], history[load.replace("load", "reaction", 1)], color=colours[number], linewidth=1.2)
    name_axis(ax.xaxis, "load", scales_of(about, "length"))
    name_axis(ax.yaxis, "reaction", scales_of(about, "force"))
    bar = figure.colorbar(scale, ax=ax, label=named(sweep, name))
    if words:
        bar.set_ticks(range(len(words)), labels=words)
    others = ", ".join(v.path for v in sweep.variations[1:])
    ax.set_title(f"{len(histories)} runs of {os.path.basename(sweep.scene)}" + (f", with {others} varied too" if others
                                                                                 else ""))
    save(figure, os.path.join(sweep.out, "curves.png"))


def draw_response(sweep, about):
    """One panel for each key; with two keys or more, the points of the others are beside each other."""
    count = len(sweep.variations)
    figure, axes = plt.subplots(1, count, figsize=(max(4.6, 3.6 * count), 3.8), sharey=True, squeeze=False,
                                constrained_layout=True)
    good = [number for number, row in sorted(sweep.rows.items()) if row["peak_reaction"] != ""]
    peaks = np.array([float(sweep.rows[number]["peak_reaction"]) for number in good])
    for which, ax in enumerate(axes[0]):
        values, words = numbers(sweep, which)
        at = values[good]
        order = np.argsort(at, kind="stable")
        ax.plot(at[order], peaks[order], "o-" if count == 1 else "o", color="#1f5a99", markersize=4.5)
        ax.set_xlabel(named(sweep, sweep.variations[which].path))
        if sweep.variations[which].log:
            ax.set_xscale("log")
        if words:
            ax.set_xticks(range(len(words)), words)
    name_axis(axes[0][0].yaxis, "largest reaction", scales_of(about, "force"))
    save(figure, os.path.join(sweep.out, "response.png"))
