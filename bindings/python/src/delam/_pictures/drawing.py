# SPDX-License-Identifier: BSD-3-Clause
"""A scene before it runs, as `delam check --draw` finds it: bodies, interfaces, notches, supports and loads with their
names; in space seen from the front, above and the right, without the faces behind."""
import re

import matplotlib
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection

from . import labels
from .cells import BODIES, tones_of
from .result import BLUE, GREEN, GREY, ORANGE, RED, axis, plt, suiting
from .snapshots import Eye, lit

WIDTH, MARGIN, TALLEST = 10.0, 0.75, 5.5  # inches: of the page, beside the drawing, of the drawing
ROW, FONT = 0.19, 10.5  # inches of a line of a label; points of its letters, 14 pixels in a page of 1000
# The least extent over the largest: thinner bodies are drawn as if thicker, by a round factor. With half of it
# each of four layers is 3 mm high on paper, with twice as much a drawing of a beam is half as high as a page.
THINNEST = 0.12
ARROW = 0.38  # inches of an arrow
LIFT = 0.3  # inches between the bodies and the bar of a lever: with half of it marks on the bodies touch it
MOST_NAMED = 24  # labels: with half of it eight layers are not all named, with twice it names fill a page
# Parts of the width by which the places are moved to which labels of bodies and interfaces point, until no line passes
# a text. With the first alone, one does in three of ten drawings of examples and specimens (`delam check --draw`); with
# the first four, as with all, in none.
SHIFTS = (0.0, -0.04, 0.04, -0.08, 0.08, -0.12, 0.12)
MOST_MARKS = 12  # symbols of a support or a load along what it holds
MARK, BETWEEN = 0.13, 0.16  # inches: a symbol, and the least from one to the next, so that none covers another
MESH_SHOWN = 4000  # faces: of more the lines would cover the tones
AZIMUTH, ELEVATION = -62, 24  # degrees
WHITE = {"facecolor": "white", "edgecolor": "none", "pad": 0.6}
COLOURS = {"support": GREEN, "load": RED, "force": RED, "pressure": RED, "tie": GREY}


def thickening(size):
    """The factor of each direction of an extent [n]: above 1 where bodies would be drawn too thin."""
    factors = np.ones(len(size))
    thin = int(np.argmin(size))
    least = THINNEST * size.max() / max(size[thin], 1e-300)
    if least > 1 and size[thin] > 0:
        factors[thin] = next(f for f in np.outer(10.0 ** np.arange(9), [1, 2, 3, 5]).ravel() if f >= least)
    return factors


class Paper:
    """Takes points of the scene [..][3] to the paper [..][2] and tells their depth towards the eye."""

    def __init__(self, points, dimension):
        self.low = points.min(0)
        self.size = np.ptp(points, axis=0)[:dimension]
        self.factors = np.ones(3)
        self.factors[:dimension] = thickening(self.size)
        self.flat = dimension == 2
        self.eye = Eye(AZIMUTH, ELEVATION)
        self.turn = np.eye(3)[:2] if self.flat else self.eye.turn

    def __call__(self, points):
        return (np.asarray(points, float) * self.factors) @ self.turn.T

    def depth(self, points):
        return self.eye.depth(np.asarray(points, float) * self.factors)

    def remark(self):
        thick = int(np.argmax(self.factors))
        if self.factors[thick] == 1:
            return ""
        return f"{'xyz'[thick]} drawn {self.factors[thick]:g} times as large"


def polygons_of(offsets, nodes):
    """Polygons as arrays of one number of corners each: yields (which, nodes [n][corners])."""
    offsets, nodes = np.asarray(offsets), np.asarray(nodes)
    corners = np.diff(offsets)
    for n in np.unique(corners):
        which = np.flatnonzero(corners == n)
        yield which, nodes[offsets[which][:, None] + np.arange(n)]


def rim_of(offsets, nodes, chosen):
    """Lines [n][2] of nodes around the chosen faces: those that belong to one of them alone."""
    edges = [np.stack([faces, np.roll(faces, -1, 1)], -1).reshape(-1, 2)
             for which, of in polygons_of(offsets, nodes) for faces in [of[chosen[which]]] if len(faces)]
    if not edges:
        return np.zeros((0, 2), int)
    edges = np.concatenate(edges)
    _, index, count = np.unique(np.sort(edges, 1), axis=0, return_index=True, return_counts=True)
    return edges[index[count == 1]]


def draw_bodies(ax, scene, points, paper):
    body = np.asarray(scene["body"])
    shown, colours, depths = [], [], []
    names = [of["name"] for of in scene["bodies"]]
    # Plies differ from their neighbours; of many fibres each has the tone of the others.
    tone = tones_of(names) if len(names) > MOST_NAMED else np.arange(len(names)) % len(BODIES)
    tones = matplotlib.colors.to_rgba_array(BODIES)[tone]
    for which, faces in polygons_of(scene["offsets"], scene["faces"]):
        at = points[faces]
        colour = tones[body[which]]
        keep = np.ones(len(at), bool)
        if not paper.flat:
            thick = at * paper.factors
            half = at.shape[1] // 2
            around = np.stack([thick[:, 0], thick[:, half // 2], thick[:, half], thick[:, half + half // 2]], 1)
            normal = np.cross(around[:, 2] - around[:, 0], around[:, 3] - around[:, 1])
            keep = paper.eye.depth(normal) > 0
            colour = lit(around, colour)
        shown += list(paper(at[keep]))
        colours.append(colour[keep])
        depths.append(paper.depth(at[keep]).mean(1))
    order = np.argsort(np.concatenate(depths), kind="stable")
    many = len(order) > MESH_SHOWN
    colours = np.concatenate(colours)[order]
    ax.add_collection(PolyCollection([shown[i] for i in order], facecolors=colours,
                                     edgecolors=colours if many else "#b9bec6", linewidths=0.3, rasterized=many))
    if paper.flat:
        for b in np.unique(body):
            rim = rim_of(scene["offsets"], scene["faces"], body == b)
            ax.add_collection(LineCollection(paper(points[rim]), colors="#50555c", linewidths=0.9))


def draw_interfaces(ax, scene, points, paper):
    """Draws what adheres and what does not in two colours; yields the labels."""
    for one in scene["interfaces"]:
        adhesion = np.asarray(one["adhesion"], float)
        nodes = np.asarray(one["faces"], int)
        for chosen, colour, what in ((adhesion > 0, BLUE, ""), (adhesion <= 0, ORANGE, "notch of ")):
            if not chosen.any():
                continue
            parts = [paper(points[faces[chosen[which]]]) for which, faces in polygons_of(one["offsets"], nodes)]
            if paper.flat:
                for lines in parts:
                    ax.add_collection(LineCollection(lines, colors=colour, linewidths=2.6, capstyle="butt"))
            else:
                for faces in parts if what else ():  # what adheres everywhere would hide the bodies
                    ax.add_collection(PolyCollection(faces, facecolors=colour, edgecolors="none", alpha=0.18,
                                                     rasterized=len(faces) > MESH_SHOWN))
                rim = rim_of(one["offsets"], nodes, chosen)
                ax.add_collection(LineCollection(paper(points[rim]), colors=colour, linewidths=1.4,
                                                 linestyles=(0, (4, 2))))
            centres = np.concatenate([part.mean(1) for part in parts if len(part)])
            name = one["name"] if what and one["law"] else f"{one['name']}: {one['kind']}"
            yield (what if one["law"] else "") + name, centres, colour


def arrows_of(points, towards, reach):
    """The points at which arrows of this length and direction start without lying over one another: of those behind one
    another the foremost."""
    across = points @ np.array([-towards[1], towards[0]])
    order = np.argsort(points @ towards)[::-1]
    kept = []
    for k in order:
        if all(abs(across[k] - across[other]) > 0.45 * reach for other in kept):
            kept.append(k)
    return points[kept]


# Symbols with their tip, or the middle of a side, at what they hold; the body is above them.
TRIANGLE = np.array([[0, 0], [-0.5, -0.9], [0.5, -0.9], [0, 0]])
SQUARE = np.array([[-0.5, 0], [-0.5, -1], [0.5, -1], [0.5, 0], [-0.5, 0]])


def apart(at, least):
    """Returns those of the places that keep this distance from each other, or the middle one if all are closer."""
    kept = [0]
    for k in range(1, len(at)):
        if np.linalg.norm(at[kept] - at[k], axis=1).min() >= least:
            kept.append(k)
    middle = len(kept) == 1
    return at[len(at) // 2:len(at) // 2 + 1] if middle else at[kept]


def outwards(at, low, high):
    """Returns the turn of a symbol, in degrees, so that it lies outside: 0 below the bodies."""
    distances = [np.abs(at[:, 1] - low[1]).max(), np.abs(at[:, 0] - high[0]).max(), np.abs(at[:, 1] - high[1]).max(),
                 np.abs(at[:, 0] - low[0]).max()]
    side = int(np.argmin(distances))
    return 90 * side if distances[side] < 1e-3 * (high - low).max() else 0


def draw_marks(ax, scene, paper, reach, ends):
    """Draws symbols of supports and arrows of loads; yields the labels. reach: the length of an arrow on the paper;
    ends: the lower and the upper corner of the bodies there."""
    for mark in scene["marks"]:
        points = np.asarray(mark["points"], float).reshape(-1, 3)
        if not len(points):
            continue
        at = paper(points)
        order = np.lexsort((at[:, 1], at[:, 0]))
        at = at[order[np.unique(np.linspace(0, len(at) - 1, min(len(at), MOST_MARKS)).round().astype(int))]]
        colour = COLOURS[mark["kind"]]
        if mark["kind"] in ("load", "force"):
            for direction in mark["directions"]:
                towards = paper(np.pad(np.asarray(direction, float), (0, 3 - len(direction)))
                                / paper.factors)  # thickening turns no arrow
                length = np.linalg.norm(towards)
                towards = towards / length if length > 0 else towards
                for tip in arrows_of(at, towards, reach) if length > 0 else ():
                    ax.annotate("", tip + reach * towards, tip, annotation_clip=False, zorder=5,
                                arrowprops={"arrowstyle": "-|>", "color": colour, "linewidth": 1.6,
                                            "shrinkA": 0, "shrinkB": 0})
        else:
            shown, shape = apart(at, BETWEEN / ARROW * reach), "o"
            if mark["kind"] == "support":
                shape = TRIANGLE if len(mark["directions"]) < scene["dimension"] else SQUARE
                shape = matplotlib.path.Path(shape).transformed(
                    matplotlib.transforms.Affine2D().rotate_deg(outwards(at, *ends) if paper.flat else 0))
            ax.plot(shown[:, 0], shown[:, 1], marker=shape, linestyle="", color=colour,
                    markersize=7 if mark["kind"] != "support" else 144 * MARK, markeredgewidth=0.0, zorder=5,
                    clip_on=False)
        yield mark["text"], at[len(at) // 2:len(at) // 2 + 1], colour


class Lever:
    """An equation that is that of a rigid bar on two places, which a load moves: drawn beside the bodies, on the side
    from which the load presses. drawn: points of the bodies on the paper [n][2]; reach: the length of an arrow there;
    lift: the distance of the bar."""

    def __init__(self, lever, drawn, paper, reach, lift):
        direction = np.asarray(lever["direction"], float)
        towards = paper(np.pad(direction, (0, 3 - len(direction))) / paper.factors)
        length = np.linalg.norm(towards)
        self.text, self.seen = lever["text"], length > 1e-9
        if not self.seen:  # it points at the eye
            return
        self.away = -towards / length
        self.level = (drawn @ self.away).max() + lift
        self.ends = paper(np.asarray(lever["ends"], float))
        self.load = self.on_bar(paper(np.asarray(lever["load"], float)))
        self.tail = self.load + reach * self.away

    def on_bar(self, points):
        return points + (self.level - points @ self.away)[..., None] * self.away

    def draw(self, ax):
        bar = np.vstack([self.on_bar(self.ends), self.load])
        order = np.argsort(bar @ np.array([self.away[1], -self.away[0]]))
        bar = bar[order[[0, -1]]]
        ax.add_line(plt.Line2D(*bar.T, color=GREY, linewidth=5, solid_capstyle="round", clip_on=False, zorder=4))
        for end, top in zip(self.ends, self.on_bar(self.ends)):
            ax.add_line(plt.Line2D(*np.array([end, top]).T, color=GREY, linewidth=2, clip_on=False, zorder=4))
        ax.annotate("", self.load, self.tail, annotation_clip=False, zorder=5,
                    arrowprops={"arrowstyle": "-|>", "color": RED, "linewidth": 1.6, "shrinkA": 0, "shrinkB": 0})


def named(of):
    return f"{of['name']} ({of['material']})"


def body_labels(scene, points, paper, inside):
    """Labels of bodies but for those that have their name inside."""
    body = np.asarray(scene["body"])
    centres = np.zeros((len(body), 2))
    for which, faces in polygons_of(scene["offsets"], scene["faces"]):
        centres[which] = paper(points[faces]).mean(1)
    for b in np.unique(body):
        if b not in inside:
            yield named(scene["bodies"][b]), centres[body == b], "#33373d"


def gathered(found):
    """Merges texts that differ in numbers alone, where there are too many: "fibre-1 (glass) and 29 like it"."""
    if len(found) <= MOST_NAMED:
        return found
    alike = {}
    for text, at, colour in found:
        alike.setdefault((re.sub(r"\d+", "", text), colour), []).append((text, at))
    return [(group[0][0] + (f" and {len(group) - 1} like it" if len(group) > 1 else ""), group[0][1], colour)
            for (_, colour), group in alike.items()]


def spread(found, low, size, shift):
    """Labels of texts with places from which to choose. Bodies and interfaces of a stack have their middles above one
    another: they are named side by side, near equal parts of the width."""
    free = sorted((k for k, (_, at, _) in enumerate(found) if len(at) > 1), key=lambda k: found[k][1][:, 0].mean())
    out = []
    for k, (text, at, colour) in enumerate(found):
        share = (free.index(k) + 0.5) / len(free) + shift if k in free else 0.5
        away = (at - at.mean(0)) / size
        away[:, 0] = (at[:, 0] - low[0]) / size[0] - share
        chosen = at[np.argmin((away ** 2).sum(1))]
        out.append(labels.Label(text, float(chosen[0]), float(chosen[1]), colour))
    return out


def widths_of(figure, texts):
    """Inches of labels of these texts."""
    renderer, out = figure.canvas.get_renderer(), {}
    for text in texts:
        drawn = figure.text(0, 0, "\n".join(labels.Label(text, 0, 0, "k").lines), fontsize=FONT)
        out[text] = drawn.get_window_extent(renderer).width / figure.dpi
        drawn.remove()
    return out


def draw_label(figure, label, box, height, above):
    """box: left, bottom, right, top of the drawing in inches. The line ends at what it names."""
    base = box[3] + 0.42 + 2 * ROW * label.row if above else box[1] - 0.62 - 2 * ROW * (label.row + 1)
    x = MARGIN / 2 + label.x
    top = base + 2 * ROW - 0.03
    ends = (label.y, top) if above else (label.y, base)
    figure.add_artist(plt.Line2D([x / WIDTH] * 2, [y / height for y in ends], color=label.colour, linewidth=0.7,
                                 transform=figure.transFigure))
    figure.add_artist(plt.Line2D([x / WIDTH], [label.y / height], marker="o", markersize=3, color=label.colour,
                                 transform=figure.transFigure))
    figure.text((MARGIN / 2 + label.left) / WIDTH, (base + ROW) / height, "\n".join(label.lines), fontsize=FONT,
                color=label.colour, va="center", linespacing=1.05, zorder=4, bbox=WHITE)


def name_axes(ax, scene, paper, box, figure):
    """Numbers along the edges in the plane, in the unit that suits them; in space the directions. The numbers are white
    behind, since lines of labels pass them."""
    height = figure.get_size_inches()[1]
    factor, unit = suiting([tuple(scale) for scale in scene["scales"]], paper.size.max())
    if paper.flat:
        ax.grid(False)
        for of, by, many in ((ax.xaxis, paper.factors[0], 10), (ax.yaxis, paper.factors[1], 4)):
            ends = np.array(of.get_view_interval()) * factor / by
            ticks = matplotlib.ticker.MaxNLocator(many, steps=[1, 2, 5, 10]).tick_values(*ends)
            ticks = ticks[(ticks >= ends[0] - 1e-9 * abs(ends[0])) & (ticks <= ends[1] + 1e-9 * abs(ends[1]))]
            of.set_ticks(ticks / factor * by, [""] * len(ticks))
            for at, tick in zip((ticks - ends[0]) / (ends[1] - ends[0]), ticks):
                x, y, side = ((box[0] + at * (box[2] - box[0]), box[1] - 0.17, "center") if of is ax.xaxis
                              else (box[0] - 0.08, box[1] + at * (box[3] - box[1]), "right"))
                figure.text(x / WIDTH, y / height, f"{tick:.6g}", fontsize=9, ha=side, va="center", zorder=3,
                            bbox=WHITE)
        figure.text((box[2] + 0.22) / WIDTH, (box[1] - 0.17) / height, axis("x", unit), fontsize=9, va="center")
        figure.text((box[0] - 0.08) / WIDTH, (box[3] + 0.14) / height, axis("y", unit), fontsize=9, ha="right",
                    zorder=3)
        return
    ax.axis("off")
    for k, name in enumerate("xyz"):
        way = 0.32 * paper.turn[:, k]
        start = np.array([0.5, box[1] - 0.28])
        end = start + way
        figure.add_artist(plt.Line2D([start[0] / WIDTH, end[0] / WIDTH], [start[1] / height, end[1] / height],
                                     color=GREY, transform=figure.transFigure))
        figure.text((start[0] + 1.4 * way[0]) / WIDTH, (start[1] + 1.4 * way[1]) / height, name, fontsize=9,
                    color=GREY, ha="center", va="center")


def scene_figure(scene):
    """The figure of what `delam check` finds: points, faces of bodies and interfaces, marks."""
    points = np.asarray(scene["points"], float)
    paper = Paper(points, scene["dimension"])
    drawn = paper(points)
    low, high = drawn.min(0), drawn.max(0)
    size = np.maximum(high - low, 1e-9 * (high - low).max())
    scale = min((WIDTH - 2 * MARGIN) / size[0], TALLEST / size[1])  # inches per length
    figure = plt.figure(figsize=(WIDTH, 8.0))
    ax = figure.add_axes((0, 0, 1, 1))
    layers = labels.layers_of(scene, points)
    inside = {b for b, (begin, end) in layers.items() if scale * paper.factors[1] * (end - begin) > ROW}
    found = [*body_labels(scene, points, paper, inside)]
    draw_bodies(ax, scene, points, paper)
    found += draw_interfaces(ax, scene, points, paper)
    found += draw_marks(ax, scene, paper, ARROW / scale, (low, high))
    levers = [Lever(one, drawn, paper, ARROW / scale, LIFT / scale) for one in scene.get("levers", [])]
    levers = [one for one in levers if one.seen]
    for one in levers:
        one.draw(ax)
        found.append((one.text, one.tail[None], RED))
    tails = np.array([one.tail for one in levers]).reshape(-1, 2)
    over, under = (scale * max(0.0, *ends) if levers else 0.0  # inches of levers above and below the bodies
                   for ends in ((tails[:, 1] - high[1]), (low[1] - tails[:, 1])))
    # From here on lengths are inches of the paper, measured from the left end of the room for labels.
    width = WIDTH - MARGIN
    left = (WIDTH - scale * size[0]) / 2
    gathered_labels = gathered(found)
    widths = widths_of(figure, [text for text, _, _ in gathered_labels])
    tried = []
    for shift in SHIFTS:
        all_labels = spread(gathered_labels, low, size, shift)
        for label in all_labels:
            label.width = widths[label.text]
            label.x = left + scale * (label.x - low[0]) - MARGIN / 2
            label.y = scale * (label.y - low[1])
        upper = [label for label in all_labels if label.y >= scale * size[1] / 2]
        lower = [label for label in all_labels if label.y < scale * size[1] / 2]
        (rows_above, crossing), (rows_below, more) = labels.place(upper, width), labels.place(lower, width)
        tried.append((crossing + more, len(tried), all_labels, upper, rows_above, rows_below))
        if tried[-1][0] == 0:
            break
    _, _, all_labels, upper, rows_above, rows_below = min(tried, key=lambda one: one[:2])
    remarks = [text for text in [paper.remark(), *scene["remarks"]] if text]
    factor, unit = suiting([tuple(scale) for scale in scene["scales"]], paper.size.max())
    extent = " × ".join(f"{value:.4g}" for value in factor * paper.size)
    remarks.insert(0, f"extent {extent} {unit}".rstrip())
    foot = 0.2 + ROW * len(remarks)
    measured = labels.DOWN if layers else 0.0  # inches for the dimension lines beneath
    bottom = foot + 0.72 + 2 * ROW * rows_below + under + measured
    top = bottom + scale * size[1]
    height = top + over + 0.5 + 2 * ROW * rows_above + 0.35
    figure.set_size_inches(WIDTH, height)
    ax.set_position((left / WIDTH, bottom / height, scale * size[0] / WIDTH, scale * size[1] / height))
    ax.set_xlim(low[0], low[0] + size[0])
    ax.set_ylim(low[1], low[1] + size[1])
    for artist in ax.collections:
        artist.set_clip_on(False)
    box = (left, bottom, left + scale * size[0], top)
    if layers:
        ax.set_xticks([])
        ax.set_yticks([])
        labels.draw_dimensions(figure, scene, points, layers, box, scale * paper.factors[:2], (factor, unit))
        for b in inside:
            y = box[1] + scale * (paper.factors[1] * np.mean(layers[b]) - low[1])
            figure.text((box[2] - 0.15) / WIDTH, y / height, named(scene["bodies"][b]), fontsize=FONT, ha="right",
                        va="center", color="#33373d")
    else:
        name_axes(ax, scene, paper, box, figure)
    around = (box[0], box[1] - under - measured, box[2], box[3] + over)
    for label in all_labels:
        label.y += bottom
        draw_label(figure, label, around, height, label in upper)
    figure.text(MARGIN / 2 / WIDTH, 1 - 0.1 / height, scene["title"], fontsize=12, va="top")
    figure.text(MARGIN / 2 / WIDTH, 0.1 / height, "\n".join(remarks), fontsize=9, color=GREY, va="bottom")
    return figure
