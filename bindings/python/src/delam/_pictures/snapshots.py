# SPDX-License-Identifier: BSD-3-Clause
"""Bodies at some instants: deformed, with the adhesion of their interfaces in colour."""
import matplotlib
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection

from .cells import (BODIES, ZETA, body_of_nodes, body_tones, boundary_edges, boundary_faces, cell_blocks, cell_outlines,
                   hidden_bodies, text_of, without)
from .fronts import chosen_interfaces, plan_of, seen_from_above, triangles_of
from .result import Nothing, fields_of, four_digits, plt


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


def load_text(result, time):
    """Load and reaction at the row of this time; of a cell the average strain and stress that it prints."""
    row = int(np.argmin(np.abs(result.history["time"] - time)))
    averages = result.averages()
    if result.cell and averages:
        component, strain, stress = averages[0]
        return f"strain {component} {100 * strain[row]:.3g} %, stress {result.text(stress[row], 'stress')}"
    _, drives, load, reaction = result.patterns()[0]
    if drives == "force":
        return f"load {four_digits(result.history[load][row])}"
    loads = result.history[load]
    return (f"load {result.text(loads[row], 'length', largest=np.abs(loads).max())}, "
            f"reaction {result.text(result.history[reaction][row], 'force')}")


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


def plane_axes(result, shots, boxes, columns=2, width=5.6):
    """A figure with axes for each shot, on one scale, of what lies in its box (lower corner, upper corner)."""
    columns = min(columns, len(shots))
    rows = -(-len(shots) // columns)
    left = min(low[0] for low, _ in boxes)
    right = max(high[0] for _, high in boxes)
    pad = 0.02 * (right - left)
    # Every row only as high as what it shows.
    spans = [(min(low[1] for low, _ in boxes[r:r + columns]), max(high[1] for _, high in boxes[r:r + columns]))
             for r in range(0, len(boxes), columns)]
    heights = [max(width * (high - low + 2 * pad) / (right - left + 2 * pad), 0.4) + 0.3 for low, high in spans]
    figure, axes = plt.subplots(rows, columns, squeeze=False, layout="constrained", height_ratios=heights,
                                figsize=(columns * width, sum(heights) + 1.3))
    for i, (ax, (time, _)) in enumerate(zip(axes.flat, shots)):
        ax.set_xlim(left - pad, right + pad)
        ax.set_ylim(spans[i // columns][0] - pad, spans[i // columns][1] + pad)
        ax.set_aspect("equal")
        unit = f" {result.time}" if result.time else ""
        ax.set_title(f"t = {time:.6g}{unit}   {load_text(result, time)}", fontsize=9, loc="left")
    for ax in axes.flat:
        ax.axis("off")
    return figure, axes


def adhesion_bar(figure, drawn, axes):
    bar = figure.colorbar(drawn, ax=axes, orientation="horizontal", shrink=0.4, aspect=45, pad=0.02)
    bar.set_label("adhesion ζ (1 intact, 0 debonded)")
    bar.outline.set_visible(False)


def stamp_scale(result, figure, scale):
    """Rotations are linear and magnified too."""
    result.stamp(figure, "magnified linear kinematics: free ends may seem to overlap although the gap is ≥ 0"
                 if scale > 1 else "")


def plot_plane(result, file, shots, scale):
    points = file["mesh/points"][:, :2]
    light_mesh = len(file["mesh/cells"]) <= 20000
    moved = [points + scale * step["displacement"][:, :2] for _, step in shots]
    figure, axes = plane_axes(result, shots, [(at.min(0), at.max(0)) for at in moved])
    drawn = None
    for ax, (_, step) in zip(axes.flat, shots):
        drawn = draw_plane(ax, file, step, scale, light_mesh) or drawn
    return figure, axes, drawn


def lit(faces, colours):
    """Colours [n][4] of faces [n][4][3] in light from above, in front and the right, by their normals."""
    normal = np.cross(faces[:, 2] - faces[:, 0], faces[:, 3] - faces[:, 1])
    normal /= np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]
    light = np.array([0.35, -0.5, 0.8])
    shade = 0.72 + 0.28 * np.clip(normal @ light / np.linalg.norm(light), -0.6, 1.0)
    return np.column_stack([shade[:, None] * colours[:, :3], colours[:, 3]])


class Eye:
    """Looks at bodies in space from far away, by the angles around and above their plane, in degrees."""

    def __init__(self, azimuth, elevation):
        a, e = np.radians([azimuth, elevation])
        self.towards = np.array([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])
        right = np.array([-np.sin(a), np.cos(a), 0.0])
        self.turn = np.array([right, np.cross(self.towards, right)])

    def __call__(self, points):
        """Points [..][3] on the paper [..][2]."""
        return points @ self.turn.T

    def depth(self, points):
        return points @ self.towards


def eye_on(hidden):
    return Eye(-62, 35 if len(hidden) else 18)


def solid_shape(file, step, scale, hidden):
    """Width and height of the bodies on the paper."""
    of = body_of_nodes(file)
    return np.ptp(eye_on(hidden)((file["mesh/points"][()] + scale * step["displacement"][()])[of >= 0]), axis=0)


def draw_solid(ax, file, step, scale, hidden):
    """The skins of the bodies in their tones; with hidden bodies these alone, the adhesion in colour on them."""
    eye = eye_on(hidden)
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
        corners = group["faces"][()][:, [0, 1, 2, 2] if group["faces"].shape[1] in (3, 6) else [0, 1, 2, 3]]
        others = without(skin, side[corners])
        faces = triangles_of(group["faces"][()])
        zeta = step[name]["zeta"][()] if "zeta" in step[name] else np.ones(len(side))
        # The faces' normals point from a to b; here they are to point out of the body that is seen.
        skin = np.concatenate([skin[others], side[faces[:, [0, 2, 1, 1] if on_b else [0, 1, 2, 2]]]])
        colours = np.concatenate([colours[others], ZETA(zeta[faces].mean(1))])
    at = moved[skin]
    front = eye.depth(np.cross(at[:, 2] - at[:, 0], at[:, 3] - at[:, 1])) > 0  # bodies are closed
    skin, colours = skin[front], lit(at, colours)[front]
    order = np.argsort(eye.depth(moved[skin]).mean(1), kind="stable")  # what is near covers what is behind
    edges = colours[order] if len(hidden) else "#50555c"
    ax.add_collection(PolyCollection(eye(moved[skin])[order], facecolors=colours[order], edgecolors=edges,
                                     linewidths=min(0.3, 400 / len(skin)), clip_on=False))
    low, high = eye(moved[of >= 0]).min(0), eye(moved[of >= 0]).max(0)
    ax.set_xlim(low[0], high[0])
    ax.set_ylim(low[1], high[1])
    ax.set_aspect("equal")
    ax.axis("off")


def plot_solid(result, file, shots, scale):
    """Bodies above, below the adhesion of the interfaces as maps seen from above; hidden bodies have it on themselves.
    """
    hidden = hidden_bodies(file, body_of_nodes(file))
    names = [] if len(hidden) else chosen_interfaces(file)
    columns = min(len(shots), 2 if len(hidden) else 5)
    rows = -(-len(shots) // columns)
    width = 5.0 if len(hidden) else 4.0
    shapes = [solid_shape(file, step, scale, hidden) for _, step in shots]
    height = max(width * shape[1] / shape[0] for shape in shapes) + 0.5
    size = max(width * columns, 8.0), rows * (height + 0.1 + 1.4 * len(names)) + 1.1  # the title takes 8 inches
    figure = plt.figure(figsize=size)
    # The pad keeps two lines of the title apart from those of the bodies below them.
    figure.set_layout_engine("constrained", h_pad=0.1)
    grid = figure.add_gridspec(rows * (1 + len(names)), columns, height_ratios=([height] + [1.3] * len(names)) * rows)
    drawn = matplotlib.cm.ScalarMappable(plt.Normalize(0, 1), ZETA) if len(hidden) else None
    axes = []
    for i, (time, step) in enumerate(shots):
        row, column = divmod(i, columns)
        ax = figure.add_subplot(grid[row * (1 + len(names)), column])
        draw_solid(ax, file, step, scale, hidden)
        ax.set_title(f"t = {time:.6g}\n{load_text(result, time)}", fontsize=8)
        if len(hidden):
            axes.append(ax)
        for n, name in enumerate(names):
            flat = figure.add_subplot(grid[row * (1 + len(names)) + 1 + n, column])
            axes.append(flat)
            at = file["interfaces"][name]["points"][()]
            seen = "from above" if seen_from_above(at) else "in its plane"
            at = plan_of(at)(at)
            zeta = step[name]["zeta"][()]
            triangles = triangles_of(file["interfaces"][name]["faces"][()])
            drawn = flat.tripcolor(at[:, 0], at[:, 1], triangles, zeta, cmap=ZETA, vmin=0, vmax=1, shading="gouraud")
            if zeta.min() < 0.5 < zeta.max():
                flat.tricontour(at[:, 0], at[:, 1], triangles, zeta, levels=[0.5], colors="black", linewidths=0.9)
            flat.set_xlim(at[:, 0].min(), at[:, 0].max())  # of one scale with and without a front
            flat.set_ylim(at[:, 1].min(), at[:, 1].max())
            flat.set_aspect("equal")
            flat.axis("off")
            flat.set_title(f"interface {text_of(file['interfaces'][name].attrs['name'])}, {seen}", fontsize=8)
    return figure, axes, drawn


def snapshots_figure(result):
    output = result.about["output"]
    scale = output["displacement_scale"]
    with fields_of(result) as file:
        shots = snapshot_steps(file, output["snapshots"])
        if "displacement" not in shots[0][1]:
            raise Nothing("no displacement in fields.h5", expected=False)
        draw = plot_plane if result.about["scene"]["dimension"] == 2 else plot_solid
        figure, axes, drawn = draw(result, file, shots, scale)
        if drawn is not None:
            adhesion_bar(figure, drawn, axes)
        figure.suptitle(result.title(f"displacements × {scale:g}"), fontsize=11)
        stamp_scale(result, figure, scale)
    return figure
