# SPDX-License-Identifier: BSD-3-Clause
"""Interfaces of a body in space, seen in plan."""
import numpy as np
from matplotlib.collections import LineCollection

from result import axis, plt

LARGEST = 6  # interfaces in one picture

PIECES = {3: [[0, 1, 2]], 4: [[0, 1, 2], [0, 2, 3]], 6: [[0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]],
          8: [[0, 4, 7], [4, 1, 5], [5, 2, 6], [6, 3, 7], [4, 5, 6], [4, 6, 7]]}


def chosen_interfaces(file):
    """Names in their order; of many the largest alone."""
    names = sorted(file["interfaces"], key=lambda name: int(name.rsplit("_", 1)[1]))
    if len(names) > LARGEST:
        names = sorted(names, key=lambda name: -file["interfaces"][name]["weights"][()].sum())[:LARGEST]
    return names


def plan_of(points):
    """A function from places [n][3] to plan [n][2]: from above, or along the normal of an interface that does not lie."""
    middle = points.mean(0)
    spread = np.linalg.svd(points - middle, full_matrices=False)[2]
    if abs(spread[2, 2]) > 0.5:
        return lambda at: at[:, :2]
    return lambda at: (at - middle) @ spread[:2].T


def triangles_of(faces):
    """Faces as triangles; a corner that is there twice leaves none."""
    triangles = np.concatenate([faces[:, piece] for piece in PIECES[faces.shape[1]]])
    return triangles[[len(set(t)) == 3 for t in triangles]]


def lines_of(group, plan):
    """The fronts of one interface at one step, each [points][2] in plan."""
    if "front_points" not in group:
        return []
    at = plan(group["front_points"][()])
    starts, closed = group["front_starts"][()], group["front_closed"][()]
    lines = []
    for f in range(len(starts) - 1):
        line = at[starts[f]:starts[f + 1]]
        lines.append(np.concatenate([line, line[:1]]) if closed[f] else line)
    return [line for line in lines if len(line) > 1]


def plot_fronts(result, file, title_of, colours):
    """Adhesion at the last step in plan, and over it the fronts of all stored steps, by time. None where there is no front."""
    steps = [file["steps"][name] for name in sorted(file["steps"])]
    times = np.array([float(step.attrs["time"]) for step in steps])
    panels = []
    for name in chosen_interfaces(file):
        if name not in steps[-1] or "zeta" not in steps[-1][name]:
            continue
        plan = plan_of(file["interfaces"][name]["points"][()])
        fronts = [lines_of(step[name], plan) for step in steps]
        if any(fronts):
            panels.append((name, plan, fronts))
    if not panels:
        return None
    shapes = [np.ptp(plan(file["interfaces"][name]["points"][()]), axis=0) for name, plan, _ in panels]
    heights = [min(max(8.0 * shape[1] / shape[0], 1.2), 6.0) for shape in shapes]
    figure, axes = plt.subplots(len(panels), 1, figsize=(10.0, sum(heights) + 0.5 * len(panels) + 1.2), squeeze=False,
                                height_ratios=heights, layout="constrained")
    shades = plt.get_cmap("gray")
    scale = plt.Normalize(times[0], times[-1])
    for ax, (name, plan, fronts) in zip(axes[:, 0], panels):
        interface = file["interfaces"][name]
        at = plan(interface["points"][()])
        drawn = ax.tripcolor(at[:, 0], at[:, 1], triangles_of(interface["faces"][()]), steps[-1][name]["zeta"][()],
                             cmap=colours, vmin=0, vmax=1, shading="gouraud")
        for time, lines in zip(times, fronts):
            ax.add_collection(LineCollection(lines, colors=[shades(scale(time))], linewidths=1.3))
        ax.set_aspect("equal")
        ax.grid(False)
        ax.set_title(title_of(interface), fontsize=9, loc="left")
        ax.set_xlabel(axis("along the first direction" if len(panels) > 1 else "x", result.length))
        ax.set_ylabel(axis("across" if len(panels) > 1 else "y", result.length))
    bar = figure.colorbar(drawn, ax=axes, shrink=0.7, aspect=25, pad=0.01)
    bar.set_label("adhesion ζ at the end")
    bar.outline.set_visible(False)
    figure.suptitle(result.title(f"fronts in plan, black to white: t = {times[0]:.4g} to {times[-1]:.4g}"), fontsize=11)
    return figure
