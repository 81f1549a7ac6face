# SPDX-License-Identifier: BSD-3-Clause
"""Bodies in space cut open by a plane, deformed, with the adhesion of their interfaces in colour along the cut."""
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection

from .cells import BODIES, ZETA, body_of_nodes, body_tones
from .result import Nothing, fields_of, plt
from .section import Section, cut_triangles, on_plane, triangles_of
from .snapshots import adhesion_bar, plane_axes, snapshot_steps, stamp_scale

AXES = "xyz"
PLACES = (0.5, 0.25, 0.75)  # of the box of the bodies
PARTS = 4  # of a line, each in its colour
MESHED = 4000  # polygons up to which the cells are outlined


class Plane:
    """x, y or z at a place. Seen along it: two axes, the first to the right, the second up."""

    def __init__(self, normal, place):
        self.normal, self.place = normal, place
        self.seen = [a for a in range(3) if a != normal]

    def distance(self, points):
        return points[:, self.normal] - self.place

    def text(self, unit):
        return f"cut at {AXES[self.normal]} = {self.place:.4g}{' ' + unit if unit else ''}"

    def view(self):
        return "{} to the right, {} up".format(*(AXES[a] for a in self.seen))


def plane_of(text):
    """y=0.01 as a plane. ValueError where it is none."""
    name, _, place = text.partition("=")
    if name not in ("x", "y", "z") or not np.isfinite(float(place)):
        raise ValueError(text)
    return Plane(AXES.index(name), float(place))


def interface_lines(group, distance, side):
    """Returns the lines in which one side of an interface crosses the plane: pairs of its nodes [lines][2][2], in the
    interface's own numbers."""
    nodes = group[side][()]
    triangles = triangles_of(group["faces"][()], nodes)
    return cut_triangles(triangles, distance[nodes])[0]


def variation(file, plane, points, step):
    """Returns the variance, along the cut, of those components of the jumps that lie in the plane."""
    length, first, second = 0.0, np.zeros(2), 0.0
    distance, moved = plane.distance(points), step["displacement"][()][:, plane.seen]
    for group in file["interfaces"].values():
        a, b = group["nodes_a"][()], group["nodes_b"][()]
        lines = interface_lines(group, distance, "nodes_a")
        size = np.linalg.norm(np.diff(on_plane(lines, distance[a], points[a]), axis=1)[:, 0], axis=-1)
        jump = on_plane(lines, distance[a], moved[b] - moved[a]).mean(1)
        length, first, second = length + size.sum(), first + size @ jump, second + size @ (jump ** 2).sum(1)
    return max(second / length - (first ** 2).sum() / length ** 2, 0.0) if length > 0 else 0.0


def flat_axis(file):
    """The axis along which the normals of the interfaces point for the most part: layers, flat yarns. Else None."""
    squares = np.zeros(3)
    for group in file["interfaces"].values():
        squares += group["weights"][()] @ group["frames"][()].reshape(-1, 3, 3)[:, 0] ** 2
    return int(squares.argmax()) if squares.max() > 0.55 * squares.sum() else None


def chosen_plane(file, step):
    """Returns the plane along which the jumps vary most: it runs across the fronts, from open pairs to closed ones, and
    never along a layer. Of its places it takes the one that meets most bodies, such as lengthwise through a yarn, or
    else the middle."""
    points, of = file["mesh/points"][()], body_of_nodes(file)
    used = points[of >= 0]
    low, size = used.min(0), np.ptp(used, axis=0)
    normals = [a for a in (1, 0, 2) if a != flat_axis(file)]
    worth = np.array([[variation(file, Plane(a, low[a] + share * size[a]), points, step) for share in PLACES]
                      for a in normals])
    row = int(worth.max(1).argmax())
    normal, worth = normals[row], worth[row]
    reach = [(points[of == body, normal].min(), points[of == body, normal].max()) for body in np.unique(of[of >= 0])]
    places = [low[normal] + share * size[normal] for share, value in zip(PLACES, worth) if value >= worth.max() / 4]
    met = [sum(first < place < last for first, last in reach) for place in places]
    return Plane(normal, places[int(np.argmax(met))])


def parted(values):
    """Values [lines][2][..] at the ends of lines, at those of PARTS equal parts of each."""
    share = np.linspace(0, 1, PARTS + 1).reshape((1, PARTS + 1) + (1,) * (values.ndim - 2))
    at = (1 - share) * values[:, :1] + share * values[:, 1:]
    return np.stack([at[:, :-1], at[:, 1:]], 2).reshape((-1, 2) + values.shape[2:])


def draw_cut(ax, file, step, scale, plane, section):
    points = file["mesh/points"][()]
    moved = (points + scale * step["displacement"][()])[:, plane.seen]
    polygons = section.at(section.polygons, moved)
    ax.add_collection(PolyCollection(polygons, facecolors=np.array(BODIES)[np.array(body_tones(file))[section.body]],
                                     edgecolors="none", antialiased=False))
    if len(polygons) < MESHED:
        ax.add_collection(LineCollection(section.at(section.edges, moved), colors="#c3c8cf", linewidths=0.25))
    ax.add_collection(LineCollection(section.at(section.skin, moved), colors="#50555c", linewidths=0.7, snap=False))
    drawn = None
    for name in file["interfaces"]:
        if name not in step or "zeta" not in step[name]:
            continue
        for side in ("nodes_a", "nodes_b"):
            nodes = file["interfaces"][name][side][()]
            lines = interface_lines(file["interfaces"][name], section.distance, side)
            at = section.distance[nodes]
            ends, zeta = on_plane(lines, at, moved[nodes]), on_plane(lines, at, step[name]["zeta"][()])
            drawn = ax.add_collection(LineCollection(parted(ends), cmap=ZETA, linewidths=1.6, norm=plt.Normalize(0, 1),
                                                     snap=False, capstyle="round"))
            drawn.set_array(parted(zeta).mean(1))
    return drawn


def box_of(file, step, scale, plane, section):
    """Lower and upper corner of what is drawn."""
    moved = (file["mesh/points"][()] + scale * step["displacement"][()])[:, plane.seen]
    at = section.at(section.polygons, moved).reshape(-1, 2)
    return at.min(0), at.max(0)


def cut_figure(result, plane=None):
    """Bodies in space at the instants of the snapshots, cut open by this plane, or by one that shows much."""
    output = result.about["output"]
    scale = output["displacement_scale"]
    if result.about["scene"]["dimension"] == 2:
        raise Nothing("plane bodies are not cut")
    with fields_of(result) as file:
        shots = snapshot_steps(file, output["snapshots"])
        if "displacement" not in shots[0][1]:
            raise Nothing("no displacement in fields.h5")
        plane = plane or chosen_plane(file, shots[-1][1])
        section = Section(file["mesh/cells"][()], file["mesh/body"][()], plane.distance(file["mesh/points"][()]))
        if len(section.polygons) == 0:
            raise Nothing(f"the {plane.text(result.length)} meets no cell", expected=False)
        boxes = [box_of(file, step, scale, plane, section) for _, step in shots]
        wide = max((high - low)[0] for low, high in boxes) > 5 * max((high - low)[1] for low, high in boxes)
        figure, axes = plane_axes(result, shots, boxes, *((1, 10.0) if wide else (2, 5.6)))
        for ax, (_, step) in zip(axes.flat, shots):
            drawn = draw_cut(ax, file, step, scale, plane, section)
        if drawn is not None:
            adhesion_bar(figure, drawn, axes)
        said = f"{plane.text(result.length)}, {plane.view()}, displacements × {scale:g}"
        figure.suptitle(result.title(said), fontsize=11)
        stamp_scale(result, figure, scale)
    return figure
