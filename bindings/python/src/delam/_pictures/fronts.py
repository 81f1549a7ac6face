# SPDX-License-Identifier: BSD-3-Clause
"""Interfaces of a body in space, seen in plan."""
import numpy as np
from matplotlib.collections import LineCollection

from .cells import ZETA, text_of
from .result import Nothing, fields_of, name_axis, plt
from .section import PIECES

LARGEST = 8  # interfaces in one picture


def chosen_interfaces(file):
    """Names in their order; of many the largest alone."""
    names = sorted(file["interfaces"], key=lambda name: int(name.rsplit("_", 1)[1]))
    if len(names) > LARGEST:
        names = sorted(names, key=lambda name: -file["interfaces"][name]["weights"][()].sum())[:LARGEST]
    return names


def main_axes(points):
    """Their middle, and the directions of their largest, second and least extent."""
    middle = points.mean(0)
    return middle, np.linalg.svd(points - middle, full_matrices=False)[2]


def seen_from_above(points):
    """True if an interface is closer to horizontal than to vertical."""
    return abs(main_axes(points)[1][2, 2]) > 0.5


def plan_of(points):
    """A function from places [n][3] to plan [n][2]: from above, or along the normal of an interface that does not
    lie."""
    if seen_from_above(points):
        return lambda at: at[:, :2]
    middle, spread = main_axes(points)
    return lambda at: (at - middle) @ spread[:2].T


def triangles_of(faces):
    """Faces as triangles; a corner that is there twice leaves none."""
    triangles = faces[:, PIECES[faces.shape[1]]].reshape(-1, 3)
    return triangles[[len(set(t)) == 3 for t in triangles]]


def sides_of(group):
    """The sides of an interface around a body, upper and lower: name, which nodes, which triangles. One side with all
    of them where it does not fold."""
    points, weights, triangles = group["points"][()], group["weights"][()], triangles_of(group["faces"][()])
    up = np.array([0.0, 0.0, 1.0]) if seen_from_above(points) else main_axes(points)[1][2]
    nodes = group["frames"][()].reshape(-1, 3, 3)[:, 0] @ up > 0
    corners = points[triangles]
    faces = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) @ up > 0
    if min(weights[nodes].sum(), weights[~nodes].sum()) < 0.1 * weights.sum():
        return [("", np.ones(len(points), bool), np.ones(len(triangles), bool))]
    height = points @ up
    if np.average(height[nodes], weights=weights[nodes]) < np.average(height[~nodes], weights=weights[~nodes]):
        nodes, faces = ~nodes, ~faces
    return [(", upper side", nodes, faces), (", lower side", ~nodes, ~faces)]


def nearest(points, places):
    """The number of the nearest point to each place."""
    size = (points ** 2).sum(1)
    parts = [np.argmin(size - 2 * places[i:i + 1000] @ points.T, axis=1) for i in range(0, len(places), 1000)]
    return np.concatenate(parts) if parts else np.empty(0, int)


def lines_of(group, plan, points, side):
    """The fronts of one interface at one step as far as they lie on a side of it, each [points][2] in plan."""
    if "front_points" not in group:
        return []
    places = group["front_points"][()]
    at = plan(places)
    starts, closed = group["front_starts"][()], group["front_closed"][()]
    on_side = np.ones(len(places), bool) if side.all() else side[nearest(points, places)]
    lines = []
    for f in range(len(starts) - 1):
        order = np.arange(starts[f], starts[f + 1])
        if closed[f] and len(order):
            order = np.append(order, order[0])
        parts = np.split(order, np.flatnonzero(np.diff(on_side[order])) + 1)
        lines += [at[part] for part in parts if on_side[part[:1]].all()]
    return [line for line in lines if len(line) > 1]


def fronts_figure(result):
    """Adhesion at the last step in plan, and over it the fronts of all stored steps, by time."""
    if result.about["scene"]["dimension"] == 2:
        raise Nothing("fronts are drawn of scenes in space")
    with fields_of(result) as file:
        figure = draw_fronts(result, file)
    result.stamp(figure)
    return figure


def draw_fronts(result, file):
    steps = [file["steps"][name] for name in sorted(file["steps"])]
    times = np.array([float(step.attrs["time"]) for step in steps])
    panels = []
    for name in chosen_interfaces(file):
        if name not in steps[-1] or "zeta" not in steps[-1][name]:
            continue
        points = file["interfaces"][name]["points"][()]
        plan = plan_of(points)
        sides = [(title, faces, [lines_of(step[name], plan, points, nodes) for step in steps])
                 for title, nodes, faces in sides_of(file["interfaces"][name])]
        if any(any(fronts) for _, _, fronts in sides):
            panels += [(name, plan, *side) for side in sides]
    if not panels:
        raise Nothing("no interface has a front")
    columns = 1 if len(panels) < 3 else 2
    rows = -(-len(panels) // columns)
    width = 10.0 if columns == 1 else 6.5
    shapes = [np.ptp(plan(file["interfaces"][name]["points"][()]), axis=0) for name, plan, *_ in panels]
    heights = [min(max(0.8 * width * shape[1] / shape[0], 1.2), 6.0) for shape in shapes]
    heights = [max(heights[r:r + columns]) for r in range(0, len(panels), columns)]
    figure, axes = plt.subplots(rows, columns, figsize=(columns * width, sum(heights) + 0.8 * rows + 0.9),
                                squeeze=False, height_ratios=heights, layout="constrained")
    shades = plt.get_cmap("gray")
    scale = plt.Normalize(times[0], times[-1])
    for ax, (name, plan, title, seen, fronts) in zip(axes.flat, panels):
        interface = file["interfaces"][name]
        at = plan(interface["points"][()])
        drawn = ax.tripcolor(at[:, 0], at[:, 1], triangles_of(interface["faces"][()])[seen],
                             steps[-1][name]["zeta"][()], cmap=ZETA, vmin=0, vmax=1, shading="gouraud")
        for time, lines in zip(times, fronts):
            ax.add_collection(LineCollection(lines, colors=[shades(scale(time))], linewidths=1.3))
        ax.set_aspect("equal")
        ax.grid(False)
        ax.set_title(text_of(interface.attrs["name"]) + title, fontsize=9, loc="left")
        above = seen_from_above(interface["points"][()])
        name_axis(ax.xaxis, "x" if above else "along the first direction", result.scales("length"))
        name_axis(ax.yaxis, "y" if above else "across", result.scales("length"), np.abs(ax.get_xlim()).max())
    for ax in axes.flat[len(panels):]:
        ax.axis("off")
    bar = figure.colorbar(drawn, ax=axes, shrink=0.7, aspect=25 * rows, pad=0.01)
    bar.set_label("adhesion ζ at the end")
    bar.outline.set_visible(False)
    figure.suptitle(result.title(f"fronts in plan, black to white: t = {times[0]:.4g} to {times[-1]:.4g}"), fontsize=11)
    return figure
