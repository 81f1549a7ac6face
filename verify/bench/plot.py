#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws what delam_bench measured: plot.py RESULT.json PICTURE (png, pdf or svg).

precision: work-precision diagram, error of the load-displacement curve and of the dissipated energy against time, one
           line an element, one marker a mesh; thin lines: other numbers of steps.
march:     cost of every method in linear-solve equivalents, one group a scene.
growth:    time against unknowns, with the fitted exponents.
energetic: load-displacement curves of the three marches of the finest scene, and their cost.
"""
import json
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

METHODS = ("baseline", "feti", "condensed", "accelerated")
CONCEPTS = ("local", "backtracking", "energetic")


def precision(result, figure):
    axes = figure.subplots(1, 2, sharex=True)
    rows = [r for r in result["rows"] if r.get("complete") and r["delta"] == 1e-5]
    colours = {name: f"C{i}" for i, name in enumerate(dict.fromkeys(r["element"] for r in rows))}
    for axis, key, title in (
        (axes[0], "error_reaction", "load-displacement curve"),
        (axes[1], "error_dissipated", "dissipated energy"),
    ):
        for name, colour in colours.items():
            for steps in sorted({r["steps"] for r in rows}):
                # The error of the mesh alone where it is not zero by definition.
                line = [r for r in rows if (r["element"], r["steps"]) == (name, steps) and r[key + "_mesh"] > 0]
                line.sort(key=lambda r: -r["h_mm"])
                main = steps == 40
                axis.plot(
                    [r["seconds"]["median"] for r in line],
                    [r[key + "_mesh"] if main else r[key] for r in line],
                    "o-" if main else ".:",
                    color=colour,
                    linewidth=1.8 if main else 0.7,
                    label=f"{name}, error of the mesh" if main else None,
                )
                for r in line if main else ():
                    axis.annotate(f"{r['h_mm']:g}", (r["seconds"]["median"], r[key + "_mesh"]), fontsize=7)
        reference = result["reference"]["reaction" if "reaction" in key else "dissipated"]["error_h"]
        axis.axhline(reference, color="grey", linestyle="--", linewidth=0.8)
        axis.set(xscale="log", yscale="log", xlabel="time, s", ylabel="relative L1 error", title=title)
        axis.grid(True, which="both", alpha=0.3)
    axes[0].legend(fontsize=8)


def march(result, figure):
    axis = figure.subplots()
    labels = []
    for i, (name, scene) in enumerate(result["scenes"].items()):
        threads, series = next(iter(scene["threads"].items()))
        labels.append(f"{name}\n{threads} thread(s)")
        for j, method in enumerate(METHODS):
            m = series.get("methods", {}).get(method, {})
            if "lse" not in m:
                continue
            hatch = None if m["label"] == "measured" else "//"
            place = i + 0.2 * (j - 1.5)
            axis.bar(place, m["lse"], 0.18, color=f"C{j}", hatch=hatch, label=method if i == 0 else None)
            axis.annotate(f"{m['lse']:.3g}", (place, m["lse"]), ha="center", fontsize=7)
    axis.set(yscale="log", ylabel="linear-solve equivalents, 40 steps (hatched: extrapolated or capped)")
    axis.set_xticks(range(len(labels)), labels)
    axis.legend(fontsize=8)


def methods(result, figure):
    axes = figure.subplots(1, 2, sharey=True)
    for axis, key, name in ((axes[0], "error_reaction", "reaction"), (axes[1], "error_dissipated", "dissipated energy")):
        for j, method in enumerate(METHODS):
            found = [mesh["methods"][method] for mesh in result["meshes"]]
            points = [(m[key], m["total_s"]["median"]) for m in found if key in m]
            if points:
                axis.plot(*zip(*points), "o-", color=f"C{j}", label=method)
        axis.set(xscale="log", yscale="log", xlabel=f"error of the {name}, mesh alone")
        axis.grid(True, which="both", alpha=0.3)
    axes[0].set(ylabel="time, s")
    axes[0].legend(fontsize=8)


def growth(result, figure):
    axes = figure.subplots(1, len(result["families"]), squeeze=False)[0]
    for axis, (name, family) in zip(axes, result["families"].items()):
        for j, method in enumerate(("one linear solve",) + METHODS):
            points = []
            for series in family["scenes"].values():
                if "error" in series:
                    continue
                m = series["methods"].get(method, {})
                if method == "one linear solve":
                    points.append((series["primal_dofs"], series["lse_s"]["median"]))
                elif "total_s" in m and not m["label"].startswith("stopped"):
                    points.append((series["primal_dofs"], m["total_s"]["median"]))
            if not points:
                continue
            slope = family.get("exponents", {}).get(method, {}).get("total")
            label = method if slope is None else f"{method}, n^{slope:.2f}"
            axis.plot(*zip(*sorted(points)), "o-", color=f"C{j}", label=label)
        axis.set(xscale="log", yscale="log", xlabel="unknowns n", ylabel="time, s", title=name)
        axis.grid(True, which="both", alpha=0.3)
        axis.legend(fontsize=8)


def energetic(result, figure):
    axes = figure.subplots(1, 2)
    labels = []
    for i, (name, scene) in enumerate(result["scenes"].items()):
        threads, series = next(iter(scene["threads"].items()))
        labels.append(f"{name}\n{threads} thread(s)")
        last = i == len(result["scenes"]) - 1
        for j, concept in enumerate(CONCEPTS):
            m = series.get("methods", {}).get(concept, {})
            if "lse" not in m:
                continue
            axes[1].bar(i + 0.27 * (j - 1), m["lse"], 0.25, color=f"C{j}")
            axes[1].annotate(f"{m['lse']:.3g}", (i + 0.27 * (j - 1), m["lse"]), ha="center", fontsize=7)
            if last:
                history = m["history"]
                load = [0.0] + [1e3 * x for x in history["load"]]
                style = ("-", "--", "-.")[j]
                axes[0].plot(load, [0.0] + history["reaction"], style, color=f"C{j}", label=concept)
                axes[0].set_title(name)
    axes[0].set(xlabel="load, mm", ylabel="reaction, N/m")
    axes[0].legend(fontsize=8)
    axes[0].grid(True, alpha=0.3)
    axes[1].set(ylabel="linear-solve equivalents of the whole march")
    axes[1].set_xticks(range(len(labels)), labels)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    with open(sys.argv[1], encoding="utf-8") as file:
        data = json.load(file)
    figure = plt.figure(figsize=(11, 5), layout="constrained")
    draw = {"precision": precision, "methods": methods, "march": march, "growth": growth, "energetic": energetic}
    draw[data["table"]](data["result"], figure)
    machine = data["machine"]
    note = f"{machine['processor']}, {machine['blas_core']}, {machine['commit']}"
    figure.text(0.995, 0.005, note, ha="right", fontsize=6)
    figure.savefig(sys.argv[2], dpi=130)


if __name__ == "__main__":
    main()
