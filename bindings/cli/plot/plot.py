#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of a result of `delam run`: plot.py DIR writes DIR/load-displacement.png, energies.png and snapshots.png,
stress-strain.png where the history has averages of both, stresses.png of plane scenes with prescribed strains,
fronts.png of fronts in space.

Reads DIR/history.csv, fields.h5 and result.json. Needs Debian's python3-numpy, python3-matplotlib and python3-h5py.
"""
import os
import sys

import h5py
import matplotlib
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from fronts import chosen_interfaces, plan_of, plot_fronts, triangles_of
from result import BLUE, GREEN, GREY, ORANGE, RED, Result, axis, early_end, plt, zoom

# Pale tones of the bodies, by turns; fibre-1 and fibre-2 have the same.
BODIES = ["#f4f1e8", "#dde5ee", "#e6ebdf"]
ZETA = matplotlib.colors.LinearSegmentedColormap.from_list(
    "zeta", ["#b3122a", "#f2a541", "#f5e9b8", "#2b6cb0", "#0b2e59"])


def text_of(attribute):
    return attribute.decode() if isinstance(attribute, bytes) else str(attribute)


def plot_load(result):
    """A picture for each pattern; of a single one also the beginning where that is where things happen."""
    patterns = result.patterns()
    number = len(patterns)
    closer = early_end(result) if number == 1 else None
    columns = number if closer is None else 2
    figure, axes = plt.subplots(1, columns, figsize=((6.8 if columns == 1 else 6.0) * columns, 4.4), squeeze=False,
                                layout="constrained")
    failed = set(result.about.get("not_converged", []))
    bad = [i for i, step in enumerate(result.history["step"]) if int(step) in failed]
    for p, (name, _, _, _) in enumerate(patterns):
        x, y = result.load_curve(p)
        drawn = axes[0] if number == 1 else axes[0][p:p + 1]
        for ax in drawn:
            # Markers show the steps, where there is room between them.
            ax.plot(x, y, color=BLUE, marker="o" if len(x) <= 100 else None, markersize=3)
            if bad:
                ax.plot(x[bad], y[bad], "x", color=RED, label="not converged")
                ax.legend()
        result.label_load(drawn, p)
        if number > 1:
            drawn[0].set_title(name, fontsize=10)
        elif closer is not None:
            zoom(drawn[1], x[closer], [(x, y)])
            drawn[1].set_title("the beginning", fontsize=10, loc="left")
    figure.suptitle(result.title("load and displacement"), fontsize=11)
    result.stamp(figure)
    result.save(figure, "load-displacement.png")


def plot_averages(result):
    """Average stress over average strain."""
    averages = result.averages()
    if not averages:
        return
    factor, unit = result.stress_unit()
    figure, ax = plt.subplots(figsize=(6.8, 4.4), layout="constrained")
    for component, strain, stress in averages:
        colour = BLUE if len(averages) == 1 else None
        line, = ax.plot(100 * strain, stress / factor, label=component, color=colour)
        # The stiffness of the beginning, as far as the picture is high.
        if strain[1] != strain[0]:
            slope = (stress[1] - stress[0]) / (strain[1] - strain[0])
            end = min(np.abs(strain).max(), 1.05 * np.abs(stress).max() / abs(slope)) if slope else 0
            ax.plot([0, 100 * end], [0, slope * end / factor], color=line.get_color(), linewidth=0.8, linestyle=":")
    ax.set_xlabel("average strain [%]")
    ax.set_ylabel(axis("average stress", unit))
    if len(averages) > 1:
        ax.legend()
    else:
        ax.set_title(averages[0][0], fontsize=10, loc="left")
    figure.suptitle(result.title("average stress and strain"), fontsize=11)
    result.stamp(figure)
    result.save(figure, "stress-strain.png")


def draw_energies(ax, result):
    """The curves of the slides' energetics."""
    h = result.history
    stored = h["stored_bulk"] + h["stored_interface"] + h.get("load_potential", 0)
    curves = [("stored, bodies", h["stored_bulk"], {"color": BLUE}),
              ("stored, interfaces", h["stored_interface"], {"color": GREEN})]
    if "load_potential" in h:
        curves.append(("potential of the dead loads", h["load_potential"], {"color": GREY}))
    curves += [("dissipated", h["dissipated"], {"color": RED}), ("total", stored + h["dissipated"], {"color": "black"}),
               ("work", h["work"] + stored[0], {"color": ORANGE, "linestyle": "--"})]
    for label, y, style in curves:
        ax.plot(h["time"], y, label=label, **style)
    for i, instant in enumerate(result.jump_times()):
        ax.axvline(instant, color=GREY, linestyle=":", linewidth=1.0, label="located jump" if i == 0 else None)
    return [(h["time"], y) for _, y, _ in curves]


def plot_energies(result):
    h = result.history
    t = h["time"]
    closer = early_end(result)
    if closer is None:
        figure, (top, bottom) = plt.subplots(2, 1, figsize=(7.2, 7.4), sharex=True, height_ratios=[3, 2],
                                              layout="constrained")
    else:
        figure = plt.figure(figsize=(12.4, 7.4), layout="constrained")
        grid = figure.add_gridspec(2, 2, height_ratios=[3, 2])
        top, bottom = figure.add_subplot(grid[0, 0]), figure.add_subplot(grid[1, :])
        beginning = figure.add_subplot(grid[0, 1])
        zoom(beginning, t[closer], draw_energies(beginning, result))
        beginning.set_title("the beginning", fontsize=10, loc="left")
        beginning.set_xlabel(axis("time", result.time))
        top.set_xlabel(axis("time", result.time))
    draw_energies(top, result)
    top.set_ylabel(axis("energy", result.energy))
    # Above the axes: nowhere inside is free of curves in every result.
    top.legend(ncols=3, loc="lower left", bbox_to_anchor=(0, 1.0), fontsize=8)

    # The band of the two-sided estimate, cumulated and seen from its middle; at the scale of the work it is a line.
    lower, increment, upper = (np.cumsum(h[name]) for name in ("lower", "increment", "upper"))
    middle = 0.5 * (lower + upper)
    bottom.fill_between(t, lower - middle, upper - middle, color=BLUE, alpha=0.18, linewidth=0,
                        label="lower .. upper bound")
    bottom.plot(t, increment - middle, color="black", label="stored + dissipated")
    bottom.axhline(0, color=ORANGE, linestyle="--", linewidth=1.2, label="work, (lower + upper)/2")
    bottom.set_ylabel(axis("cumulated, minus work", result.energy))
    bottom.set_xlabel(axis("time", result.time))
    bottom.legend(loc="upper left", bbox_to_anchor=(0, -0.2), ncols=3, fontsize=8)
    # As the run judged it: the picture and its closing line must not disagree.
    broken = len(result.about.get("estimate_violated", []))
    eta = result.about["options"]["backtracking_tolerance"]
    bottom.set_title(("two-sided estimate: met in every step" if broken == 0 else
                      f"two-sided estimate: violated in {broken} of {len(t) - 1} steps") + f" (tolerance {eta:g})",
                     fontsize=9, loc="left")
    returns = int(np.sum(h["backtracks"]))
    if returns:
        bottom.set_title(f"returns to earlier steps: {returns}", fontsize=9, loc="right")
    room = max(np.max(np.abs(upper - middle), initial=0), np.max(np.abs(increment - middle), initial=0))
    if room > 0:
        bottom.set_ylim(-1.15 * room, 1.15 * room)
    figure.suptitle(result.title("energies"), fontsize=11)
    result.stamp(figure)
    result.save(figure, "energies.png")


def cell_blocks(file):
    """The cells of each type; rows of a mixed mesh end with -1."""
    cells = file["mesh/cells"][()]
    number = (cells >= 0).sum(1)
    return [cells[number == n][:, :n] for n in np.unique(number)]


def ring_edges(cells):
    """The edges of each plane cell; quadratic ones as two lines each."""
    corners = {3: 3, 4: 4, 6: 3, 8: 4, 9: 4}[cells.shape[1]]
    ring = [[i, (i + 1) % corners] for i in range(corners)]
    if cells.shape[1] > 4:
        ring = [pair for i, (a, b) in enumerate(ring) for pair in ([a, corners + i], [corners + i, b])]
    return np.concatenate([cells[:, pair] for pair in ring])


def body_tones(file):
    """The tone of each body, by its name without numbers."""
    number = file["mesh/body"][()].max() + 1
    stems = [text_of(file["mesh"].attrs[f"body_{b}"]).rstrip("-0123456789") for b in range(number)]
    return [list(dict.fromkeys(stems)).index(stem) % len(BODIES) for stem in stems]


def cell_outlines(file):
    """The corners of all plane cells of one kind and one tone, and the tone."""
    cells, body = file["mesh/cells"][()], file["mesh/body"][()]
    number = (cells >= 0).sum(1)
    tone = np.array(body_tones(file))[body]
    for n in np.unique(number):
        for t in np.unique(tone[number == n]):
            yield cells[(number == n) & (tone == t)][:, :{3: 3, 4: 4, 6: 3, 8: 4, 9: 4}[n]], BODIES[t]


def boundary_edges(blocks):
    """Edges of plane cells that belong to one cell only, and all edges."""
    edges = np.concatenate([ring_edges(cells) for cells in blocks])
    _, index, count = np.unique(np.sort(edges, 1), axis=0, return_index=True, return_counts=True)
    return edges[index[count == 1]], edges[index]


def cell_faces(cells):
    """The faces of each solid cell by their corners; the last corner of a triangle is there twice."""
    cells = cells[:, :{4: 4, 8: 8, 10: 4, 20: 8}[cells.shape[1]]]
    local = {8: [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]],
             4: [[0, 2, 1, 1], [0, 1, 3, 3], [1, 2, 3, 3], [2, 0, 3, 3]]}[cells.shape[1]]
    return np.concatenate([cells[:, f] for f in local])


def boundary_faces(blocks):
    """Faces of solid cells that belong to one cell only, by their corners."""
    faces = np.concatenate([cell_faces(cells) for cells in blocks])
    # A triangle is found again whichever of its corners is there twice.
    key = np.sort(faces, 1)
    triangle = faces[:, 2] == faces[:, 3]
    if triangle.any():
        key[triangle] = np.concatenate([np.full((triangle.sum(), 1), -1), np.sort(faces[triangle][:, :3], 1)], 1)
    _, index, count = np.unique(key, axis=0, return_index=True, return_counts=True)
    return faces[index[count == 1]]


def snapshot_steps(file, instants):
    """The stored step nearest to each instant, each once."""
    names = sorted(file["steps"])
    times = np.array([float(file["steps"][n].attrs["time"]) for n in names])
    chosen = []
    for instant in instants:
        k = int(np.argmin(np.abs(times - instant)))
        if times[0] <= instant <= times[-1] + 1e-9 * max(1.0, abs(times[-1])) and k not in chosen:
            chosen.append(k)
    return [(times[k], file["steps"][names[k]]) for k in (chosen or [len(names) - 1])]


def four_digits(value):
    """Four digits, without an exponent as long as that is short."""
    return f"{value:.0f}" if 1e3 <= abs(value) < 1e7 else f"{value:.4g}"


def load_text(result, time):
    """Load and reaction at the row of this time; of a cell the average strain and stress that it prints."""
    row = int(np.argmin(np.abs(result.history["time"] - time)))
    averages = result.averages()
    if result.cell and averages:
        component, strain, stress = averages[0]
        factor, unit = result.stress_unit()
        return (f"strain {component} {100 * strain[row]:.3g} %, stress {four_digits(stress[row] / factor)} {unit}")
    _, drives, load, reaction = result.patterns()[0]
    return (f"load {four_digits(result.history[load][row])}" + (f" {result.length}" if drives != "force" else "") +
            (f", reaction {four_digits(result.history[reaction][row])} {result.force}" if drives != "force" else ""))


def draw_stress(ax, moved, file, step, factor, largest):
    """Cells by their stress along x; what came off is white between them."""
    cells, stress = file["mesh/cells"][()], step["stress"][:, 0] / factor
    number = (cells >= 0).sum(1)
    for n in np.unique(number):
        of = number == n
        corners = cells[of][:, :{3: 3, 4: 4, 6: 3, 8: 4, 9: 4}[n]]
        drawn = PolyCollection(moved[corners], cmap="RdBu_r", edgecolors="face", linewidths=0.1, norm=plt.Normalize(-largest, largest))
        drawn.set_array(stress[of])
        ax.add_collection(drawn)
    return drawn


def plot_stresses(result):
    """Of a plane scene with prescribed strains: stress along x, where most cells have less than the colours end at."""
    output = result.about["output"]
    if not result.prescribed_strains() or result.about["scene"]["dimension"] != 2 or "stress" not in output["fields"]:
        return
    factor, unit = result.stress_unit()
    with h5py.File(os.path.join(result.folder, "fields.h5"), "r") as file:
        shots = snapshot_steps(file, output["snapshots"])
        points = file["mesh/points"][:, :2]
        if "displacement" not in shots[0][1]:
            return
        height = min(4.0, 0.75 + 10 * np.ptp(points[:, 1]) / np.ptp(points[:, 0]))
        figure, axes = plt.subplots(len(shots), 1, squeeze=False, layout="constrained",
                                    figsize=(11.0, 1.0 + len(shots) * height))
        for ax, (time, step) in zip(axes.flat, shots):
            moved = points + output["displacement_scale"] * step["displacement"][:, :2]
            largest = np.percentile(np.abs(step["stress"][:, 0]), 99) / factor or 1.0
            drawn = draw_stress(ax, moved, file, step, factor, largest)
            outline, _ = boundary_edges(cell_blocks(file))
            ax.add_collection(LineCollection(moved[outline], colors="#50555c", linewidths=0.5))
            ax.autoscale_view()
            ax.set_aspect("equal")
            ax.axis("off")
            ax.set_title(f"t = {time:.6g}   {load_text(result, time)}", fontsize=9, loc="left")
            bar = figure.colorbar(drawn, ax=ax, shrink=0.9, aspect=12, pad=0.01)
            bar.set_label(axis("stress xx", unit), fontsize=8)
            bar.outline.set_visible(False)
        figure.suptitle(result.title(f"stress along x, displacements × {output['displacement_scale']:g}"), fontsize=11)
        result.stamp(figure)
        result.save(figure, "stresses.png")


def draw_plane(ax, file, step, scale, light_mesh):
    points = file["mesh/points"][:, :2]
    moved = points + scale * step["displacement"][:, :2]
    for outlines, colour in cell_outlines(file):
        ax.add_collection(PolyCollection(moved[outlines], facecolors=colour, edgecolors="none", antialiased=False))
    outline, edges = boundary_edges(cell_blocks(file))
    if light_mesh:
        ax.add_collection(LineCollection(moved[edges], colors="#d3d7dd", linewidths=0.25))
    ax.add_collection(LineCollection(moved[outline], colors="#50555c", linewidths=0.7, snap=False))
    drawn = None
    for name in sorted(k for k in step if k.startswith("interface_")):
        if "zeta" not in step[name]:
            continue
        zeta = step[name]["zeta"][()]
        faces = file["interfaces"][name]["faces"][()]
        for side in ("nodes_a", "nodes_b"):
            at = moved[file["interfaces"][name][side][()]]
            lines = faces if faces.shape[1] == 2 else np.concatenate([faces[:, [0, 2]], faces[:, [2, 1]]])
            drawn = LineCollection(at[lines], cmap=ZETA, linewidths=2.0, norm=plt.Normalize(0, 1), snap=False)
            drawn.set_array(zeta[lines].mean(axis=1))
            ax.add_collection(drawn)
    return drawn


def plot_plane(result, file, shots, scale):
    columns = 2 if len(shots) > 1 else 1
    rows = -(-len(shots) // columns)
    points = file["mesh/points"][:, :2]
    light_mesh = len(file["mesh/cells"]) <= 20000
    boxes = [(points + scale * s["displacement"][:, :2]) for _, s in shots]
    left = min(b[:, 0].min() for b in boxes)
    right = max(b[:, 0].max() for b in boxes)
    pad = 0.02 * (right - left)
    # One scale for all; every row only as high as what it shows.
    spans = [(min(b[:, 1].min() for b in boxes[r:r + columns]), max(b[:, 1].max() for b in boxes[r:r + columns]))
             for r in range(0, len(boxes), columns)]
    width = 5.6
    heights = [max(width * (high - low + 2 * pad) / (right - left + 2 * pad), 0.4) + 0.3 for low, high in spans]
    figure, axes = plt.subplots(rows, columns, squeeze=False, layout="constrained", height_ratios=heights,
                                figsize=(columns * width, sum(heights) + 1.3))
    drawn = None
    for i, (ax, (time, step)) in enumerate(zip(axes.flat, shots)):
        drawn = draw_plane(ax, file, step, scale, light_mesh) or drawn
        ax.set_xlim(left - pad, right + pad)
        ax.set_ylim(spans[i // columns][0] - pad, spans[i // columns][1] + pad)
        ax.set_aspect("equal")
        ax.axis("off")
        unit = f" {result.time}" if result.time else ""
        ax.set_title(f"t = {time:.6g}{unit}   {load_text(result, time)}", fontsize=9, loc="left")
    for ax in axes.flat[len(shots):]:
        ax.axis("off")
    return figure, axes, drawn


def lit(faces, colours):
    """Colours [n][4] of faces [n][4][3] in light from above, in front and the right, by their normals."""
    normal = np.cross(faces[:, 2] - faces[:, 0], faces[:, 3] - faces[:, 1])
    normal /= np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]
    light = np.array([0.35, -0.5, 0.8])
    shade = 0.72 + 0.28 * np.clip(normal @ light / np.linalg.norm(light), -0.6, 1.0)
    return np.column_stack([shade[:, None] * colours[:, :3], colours[:, 3]])


def body_of_nodes(file):
    """The body of each node; -1 where no cell is."""
    cells, body = file["mesh/cells"][()], file["mesh/body"][()]
    of = np.full(len(file["mesh/points"]), -1)
    for column in cells.T:
        of[column[column >= 0]] = body[column >= 0]
    return of


def hidden_bodies(file, of):
    """Bodies inside another one that reaches as far as all of them together: yarns, not layers."""
    points = file["mesh/points"][()]
    bodies = np.unique(of[of >= 0])
    size = np.ptp(points[of >= 0], axis=0)
    outer = [b for b in bodies if np.all(np.ptp(points[of == b], axis=0) > (1 - 1e-9) * size)]
    return np.setdiff1d(bodies, outer) if len(outer) == 1 and len(bodies) > 1 else np.array([], int)


def draw_solid(ax, file, step, scale, hidden):
    """The skins of the bodies in their tones; with hidden bodies these alone, the adhesion in colour on them."""
    moved = file["mesh/points"][()] + scale * step["displacement"][()]
    of = body_of_nodes(file)
    skin = boundary_faces(cell_blocks(file))
    if len(hidden):
        skin = skin[np.isin(of[skin[:, 0]], hidden)]
    colours = matplotlib.colors.to_rgba_array(BODIES)[np.array(body_tones(file))[of[skin[:, 0]]]]
    for name in file["interfaces"] if len(hidden) else ():
        group = file["interfaces"][name]
        on_b = group.attrs["body_b"] in hidden
        side = group["nodes_b" if on_b else "nodes_a"][()]
        others = ~np.isin(skin, side).all(1)
        faces = triangles_of(group["faces"][()])
        zeta = step[name]["zeta"][()] if "zeta" in step[name] else np.ones(len(side))
        # The faces' normals point from a to b; here they are to point out of the body that is seen.
        skin = np.concatenate([skin[others], side[faces[:, [0, 2, 1, 1] if on_b else [0, 1, 2, 2]]]])
        colours = np.concatenate([colours[others], ZETA(zeta[faces].mean(1))])
    colours = lit(moved[skin], colours)
    edges = colours if len(hidden) else "#50555c"
    ax.add_collection3d(Poly3DCollection(moved[skin], facecolors=colours, edgecolors=edges,
                                            linewidths=min(0.3, 400 / len(skin)), clip_on=False))
    low, high = moved[of >= 0].min(0), moved[of >= 0].max(0)
    for setter, a in ((ax.set_xlim, 0), (ax.set_ylim, 1), (ax.set_zlim, 2)):
        setter(low[a], high[a])
    ax.set_box_aspect(np.maximum(high - low, 0.05 * (high - low).max()), zoom=1.15)
    ax.view_init(elev=35 if len(hidden) else 18, azim=-62)
    ax.set_axis_off()


def plot_solid(result, file, shots, scale):
    """Bodies above, below the adhesion of the interfaces as maps seen from above. Hidden bodies have it on themselves."""
    hidden = hidden_bodies(file, body_of_nodes(file))
    names = [] if len(hidden) else chosen_interfaces(file)
    columns = min(len(shots), 2 if len(hidden) else 5)
    rows = -(-len(shots) // columns)
    width, height = (5.0, 3.6) if len(hidden) else (4.0, 2.9)
    figure = plt.figure(figsize=(width * columns, rows * (height + 1.3 * len(names)) + 1.0), layout="constrained")
    grid = figure.add_gridspec(rows * (1 + len(names)), columns, height_ratios=([2.4] + [1.0] * len(names)) * rows)
    drawn = matplotlib.cm.ScalarMappable(plt.Normalize(0, 1), ZETA) if len(hidden) else None
    axes = []
    for i, (time, step) in enumerate(shots):
        row, column = divmod(i, columns)
        ax = figure.add_subplot(grid[row * (1 + len(names)), column], projection="3d")
        draw_solid(ax, file, step, scale, hidden)
        ax.set_title(f"t = {time:.6g}\n{load_text(result, time)}", fontsize=8)
        if len(hidden):
            axes.append(ax)
        for n, name in enumerate(names):
            flat = figure.add_subplot(grid[row * (1 + len(names)) + 1 + n, column])
            axes.append(flat)
            at = file["interfaces"][name]["points"][()]
            at = plan_of(at)(at)
            zeta = step[name]["zeta"][()]
            triangles = triangles_of(file["interfaces"][name]["faces"][()])
            drawn = flat.tripcolor(at[:, 0], at[:, 1], triangles, zeta, cmap=ZETA, vmin=0, vmax=1, shading="gouraud")
            if zeta.min() < 0.5 < zeta.max():
                flat.tricontour(at[:, 0], at[:, 1], triangles, zeta, levels=[0.5], colors="black", linewidths=0.9)
            flat.set_aspect("equal")
            flat.axis("off")
            if len(names) > 1:
                flat.set_title(text_of(file["interfaces"][name].attrs["name"]), fontsize=7)
    return figure, axes, drawn


def plot_snapshots(result):
    output = result.about["output"]
    scale = output["displacement_scale"]
    with h5py.File(os.path.join(result.folder, "fields.h5"), "r") as file:
        shots = snapshot_steps(file, output["snapshots"])
        if "displacement" not in shots[0][1]:
            print("plot.py: no displacement in fields.h5, so no snapshots.png", file=sys.stderr)
            return
        draw = plot_plane if result.about["scene"]["dimension"] == 2 else plot_solid
        figure, axes, drawn = draw(result, file, shots, scale)
        if drawn is not None:
            bar = figure.colorbar(drawn, ax=axes, orientation="horizontal", shrink=0.4, aspect=45, pad=0.02)
            bar.set_label("adhesion ζ (1 intact, 0 debonded)")
            bar.outline.set_visible(False)
        figure.suptitle(result.title(f"displacements × {scale:g}"), fontsize=11)
        if scale > 1:
            # Rotations are linear and magnified too.
            result.stamp(figure, "magnified linear kinematics: free ends may seem to overlap although the gap is ≥ 0")
        else:
            result.stamp(figure)
        result.save(figure, "snapshots.png")


def plot_plan(result):
    """Fronts in space, where there are some."""
    if result.about["scene"]["dimension"] == 2:
        return
    with h5py.File(os.path.join(result.folder, "fields.h5"), "r") as file:
        figure = plot_fronts(result, file, lambda interface: text_of(interface.attrs["name"]), ZETA)
    if figure is not None:
        result.stamp(figure)
        result.save(figure, "fronts.png")


def main():
    if len(sys.argv) != 2 or sys.argv[1] in ("-h", "--help"):
        print("usage: plot.py DIR", file=sys.stderr)
        return 2
    folder = sys.argv[1]
    try:
        result = Result(folder)
    except FileNotFoundError as error:
        print(f"plot.py: {folder} holds no result: {error.filename} is missing", file=sys.stderr)
        return 2
    plot_load(result)
    plot_averages(result)
    plot_energies(result)
    plot_snapshots(result)
    plot_stresses(result)
    plot_plan(result)
    return 0


if __name__ == "__main__":
    sys.exit(main())
