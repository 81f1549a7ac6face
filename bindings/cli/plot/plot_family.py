#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Results of `delam run` side by side: plot_family.py [--out OUT] DIR... writes OUT/load-displacement.png and
OUT/energies.png (OUT: by default the folder that holds them all).

One curve a result; the legend names what differs among them (cell size, solution, mixity rule, steps), the title what
does not. Needs Debian's python3-numpy and python3-matplotlib.
"""
import argparse
import os
import sys

HERE = os.path.dirname(os.path.realpath(__file__))
# What draws is beside this script where that is installed, and in the Python package among the sources.
sys.path[:0] = [HERE, os.path.join(HERE, "..", "..", "python", "src", "delam"), os.path.join(HERE, "study"),
                os.path.join(HERE, "..", "study")]

import command  # noqa: E402

if __name__ == "__main__":
    command.begin("plot_family.py")

from packages import require  # noqa: E402

require("numpy", "matplotlib")

import numpy as np  # noqa: E402

from _pictures.result import GREY, Result, axis, early_end, for_files, name_axis, plt, save, zoom  # noqa: E402
from command import complain  # noqa: E402

for_files()

# Okabe and Ito's colours, told apart by all; the last one, yellow, is too light for a line.
DISTINCT = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"]
DASHES = ["-", "-.", ":"]


def differences(results):
    """For each result a dictionary of what is not the same in all, and what is."""
    named = [{"name": result.name(), **result.concept()} for result in results]
    keys = [key for concept in named for key in concept]
    keys = list(dict.fromkeys(keys))
    same = [key for key in keys if len({concept.get(key) for concept in named}) == 1]
    return ([{key: concept.get(key, "") for key in keys if key not in same} for concept in named],
            {key: named[0][key] for key in same})


class Curves:
    """How each result is drawn and called."""

    def __init__(self, results):
        self.results = sorted(results, key=lambda r: -r.about["scene"]["shortest_edge"])
        self.own, self.common = differences(self.results)
        self.labels = [", ".join(text for text in own.values() if text) or os.path.basename(result.folder)
                       for own, result in zip(self.own, self.results)]
        number = len(self.results)
        sizes_only = all(set(own) <= {"h"} for own in self.own)
        self.styles = []
        for i in range(number):
            # An ordered thing gets ordered colours: light and broad for coarse cells, dark and thin for fine ones, so
            # that what lies below stays visible where curves coincide.
            part = i / max(1, number - 1)
            colour = plt.cm.viridis(0.9 * (1 - part)) if sizes_only else DISTINCT[i % len(DISTINCT)]
            local = self.own[i].get("solution", "").startswith("local")
            dash = "--" if local else DASHES[i // len(DISTINCT) % len(DASHES)]
            width = 3.2 - (2.2 if sizes_only else 1.6) * part
            self.styles.append({"color": colour, "linestyle": dash, "linewidth": width})

    def early(self):
        """Pairs of a result and the step up to which it is worth a closer look."""
        pairs = [(result, early_end(result)) for result in self.results]
        return [pair for pair in pairs if pair[1] is not None]

    def each(self):
        return zip(self.results, self.labels, self.styles)

    def title(self, what):
        common = dict(self.common)
        name = common.pop("name", "several scenes")
        rest = ", ".join(common.values())
        return f"{name} – {what}" + (f"\n{rest}" if rest else "")

    def finish(self, figure, axes, path):
        """Legend and stamp below everything else."""
        handles, labels = axes.get_legend_handles_labels()
        widest = max(map(len, labels))
        columns = min(len(labels), max(1, int(figure.get_size_inches()[0] / (0.7 + 0.068 * widest))))
        rows = -(-len(labels) // columns)
        height = figure.get_size_inches()[1]
        foot = (0.35 + 0.22 * rows) / height
        figure.get_layout_engine().set(rect=(0, foot, 1, 1 - foot))
        figure.legend(handles, labels, loc="lower center", bbox_to_anchor=(0.5, 0.2 / height), ncols=columns)
        commits = sorted({result.about["commit"][:13] for result in self.results})
        figure.text(0.995, 0.004, f"delam {self.results[0].about['version']} · commit {', '.join(commits)}", ha="right",
                    va="bottom", fontsize=7, color=GREY)
        save(figure, path)


def notes(result):
    return "" if result.about["status"] == "complete" else " (incomplete)"


def plot_load(curves, out):
    closer = curves.early()
    figure, axes = plt.subplots(1, 2 if closer else 1, figsize=(12.4 if closer else 8.2, 5.4), squeeze=False,
                                layout="constrained")
    for result, label, style in curves.each():
        x, y = result.load_curve()
        failed = set(result.about["not_converged"])
        bad = np.array([int(step) in failed for step in result.history["step"]])
        for ax in axes[0]:
            ax.plot(x, y, label=label + notes(result), **style)
            if bad.any():
                ax.plot(x[bad], y[bad], "x", color=style["color"], label=label + ", not converged")
    curves.results[0].label_load(axes[0])
    if closer:
        end = max(result.load_curve()[0][step] for result, step in closer)
        zoom(axes[0, 1], end, [result.load_curve() for result in curves.results])
        axes[0, 1].set_title("the beginning", fontsize=10, loc="left")
    figure.suptitle(curves.title("load and displacement"), fontsize=11)
    curves.finish(figure, axes[0, 0], os.path.join(out, "load-displacement.png"))


def plot_energies(curves, out):
    closer = curves.early()
    rows = 2 if closer else 1
    figure, axes = plt.subplots(rows, 3, figsize=(13.2, 1.1 + 3.8 * rows), squeeze=False, layout="constrained")
    drawn = [[], [], []]
    for result, label, style in curves.each():
        h = result.history
        stored = h["stored_bulk"] + h["stored_interface"] + h.get("load_potential", 0)
        for column, y in enumerate((stored, h["dissipated"], stored + h["dissipated"])):
            drawn[column].append((h["time"], y))
            for ax in axes[:, column]:
                ax.plot(h["time"], y, label=label + notes(result), **style)
        for ax in axes[:, 2]:
            ax.plot(h["time"], h["work"] + stored[0], **{**style, "linestyle": (0, (1, 2)), "linewidth": 1.2})
    first = curves.results[0]
    titles = ("stored (bodies and interfaces)", "dissipated", "total; dotted: work of the loads")
    for column, title in enumerate(titles):
        axes[0, column].set_title(title, fontsize=10, loc="left")
        axes[-1, column].set_xlabel(axis("time", first.time))
        if closer:
            zoom(axes[1, column], max(result.history["time"][step] for result, step in closer), drawn[column])
            axes[1, column].set_title("the beginning", fontsize=10, loc="left")
    for row in axes:
        name_axis(row[0].yaxis, "energy", first.scales("energy"))
    figure.suptitle(curves.title("energetics"), fontsize=11)
    curves.finish(figure, axes[0, 0], os.path.join(out, "energies.png"))


def main():
    parser = argparse.ArgumentParser(description="results of `delam run` side by side, a curve each")
    parser.add_argument("--out", metavar="OUT", help="folder for the pictures (the one that holds all DIRs)")
    parser.add_argument("folders", metavar="DIR", nargs="+", help="a result")
    words = parser.parse_args()
    results = []
    for folder in words.folders:
        try:
            results.append(Result(os.path.normpath(folder)))
        except FileNotFoundError as error:
            complain(f"{folder} holds no result: {error.filename} is missing")
            return 2
    units = {(result.length, result.force, result.time, result.patterns()[0][1]) for result in results}
    if len(units) > 1:
        complain("the results have different units or kinds of loads, so they share no axes")
        return 2
    out = words.out or os.path.commonpath([os.path.dirname(os.path.abspath(folder)) for folder in words.folders])
    os.makedirs(out, exist_ok=True)
    curves = Curves(results)
    plot_load(curves, out)
    plot_energies(curves, out)
    return 0


if __name__ == "__main__":
    command.run(main)
