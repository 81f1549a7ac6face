# SPDX-License-Identifier: BSD-3-Clause
"""Plane sections through solid cells of every kind, against areas, lengths and fields in closed form."""
import os
import sys

import numpy as np

from support import expect, finish

sys.path.insert(0, os.path.join(os.path.dirname(os.environ["DELAM_PLOT"]), "..", "..", "python", "src", "delam"))
from _pictures.cells import boundary_faces, without  # noqa: E402
from _pictures.section import Section  # noqa: E402

KUHN = [[0, 1, 3, 7], [0, 5, 1, 7], [0, 3, 2, 7], [0, 2, 6, 7], [0, 4, 5, 7], [0, 6, 4, 7]]  # corners by bits x, y, z
EDGES = {"tet10": [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)],
         "hex20": [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]}
EDGES["wedge15"] = [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)]
WEDGES = [[0, 1, 3, 4, 5, 7], [0, 3, 2, 4, 7, 6]]
PYRAMIDS = [[0, 1, 3, 2, 7], [0, 4, 5, 1, 7], [0, 2, 6, 4, 7]]
SPLITS = {"hex": [[0, 1, 3, 2, 4, 5, 7, 6]], "tet": KUHN, "wed": WEDGES, "pyr": PYRAMIDS}
EDGES["hex27"] = EDGES["hex20"] + [(0, 7), (1, 6), (0, 5), (3, 6), (0, 2), (4, 6), (0, 6)]


def cube(kind, n):
    """Points, cells and bodies of the unit cube, n cells along each side; the halves of z are bodies without common nodes."""
    points, cells, body, found = [], [], [], {}

    def node(place, half):
        key = (half, *(round(x * 4 * n) for x in place))
        if key not in found:
            found[key] = len(points)
            points.append(place)
        return found[key]

    for i, j, k in np.ndindex(n, n, n):
        corner = [np.array([i + (b & 1), j + (b >> 1 & 1), k + (b >> 2)]) / n for b in range(8)]
        mirror = (i % 2 + 2 * (j % 2) + 4 * (k % 2)) if kind == "pyramid5" else 0  # so that the triangles match
        for one in SPLITS[kind[:3]]:
            one = [b ^ mirror for b in one]
            places = [corner[b] for b in one]
            places += [(places[a] + places[b]) / 2 for a, b in EDGES.get(kind, [])]
            cells.append([node(tuple(place), 2 * k >= n) for place in places])
            body.append(int(2 * k >= n))
    return np.array(points), np.array(cells), np.array(body)


def areas(polygons):
    """Of flat polygons of four corners in space."""
    a, b = polygons[:, 2] - polygons[:, 0], polygons[:, 3] - polygons[:, 1]
    return np.linalg.norm(np.cross(a, b), axis=1) / 2


def lengths(lines):
    return np.linalg.norm(lines[:, 1] - lines[:, 0], axis=1)


errors = {}
for kind in ("tet4", "tet10", "hex8", "hex20", "hex27", "wedge6", "wedge15", "pyramid5"):
    points, cells, body = cube(kind, 4)
    # x + y + z = 1.5 meets the cube in a regular hexagon, and its equator in a line of the length sqrt(2).
    section = Section(cells, body, points.sum(1) - 1.5)
    cut = section.at(section.polygons, points)
    both = [areas(cut[section.body == b]).sum() for b in (0, 1)]
    expect(np.allclose(both, 3 * np.sqrt(3) / 8, rtol=1e-12), f"{kind}: each body has half of the hexagon, {both}")
    expect(np.abs(cut.sum(-1) - 1.5).max() < 1e-12, f"{kind}: corners lie in the plane")
    skin = lengths(section.at(section.skin, points)).sum()
    expect(abs(skin - 5 * np.sqrt(2)) < 1e-12, f"{kind}: the skins are its outline and twice the interface, {skin}")
    inner = lengths(section.at(section.edges, points)).sum()
    grid = 6.5 * np.sqrt(2)
    expect(abs(inner - grid) < 1e-12 if kind.startswith("hex") else inner > 1.5 * grid,
           f"{kind}: the cells have lines between them, {inner:.6g}; those of the grid are {grid:.6g} long")

    # The skins without the interface, whatever corner its faces begin with; a face that only shares its corners with others stays.
    skin = boundary_faces([cells])
    inside = np.all(np.isclose(points[skin, 2], 0.5), axis=1)
    turned = skin[inside][:, [1, 2, 0, 0] if skin[0, 2] == skin[0, 3] else [2, 1, 0, 3]]
    left = without(skin, turned)
    expect(np.array_equal(left, ~inside) and abs(areas(points[skin[left]]).sum() - 6) < 1e-12, f"{kind}: skins without the interface")
    expect(np.flatnonzero(without(skin, np.delete(skin, 5, axis=0))).tolist() == [5], f"{kind}: a face between others")

    # A plane of nodes whose places are rounded.
    noise = 1e-16 * np.sin(1e3 * np.arange(len(points)))
    section = Section(cells, body, points[:, 0] - 0.25 + noise)
    expect(abs(areas(section.at(section.polygons, points)).sum() - 1) < 1e-12, f"{kind}: a plane of nodes has the whole area once")
    section = Section(cells, body, points[:, 0] - 1.25)
    expect(len(section.polygons) == 0 and len(section.skin) == 0, f"{kind}: a plane beside the cells meets none")

    # Bent cells: the distance from a cylinder, as if it was unrolled into a plane. A quarter of it has pi r/2.
    section = Section(cells, body, np.hypot(points[:, 0], points[:, 1]) - 0.8)
    errors[kind] = abs(areas(section.at(section.polygons, points)).sum() / (0.4 * np.pi) - 1)
    # What a straight cell has in its middle: its shape functions hold quadratic fields, those of linear cells linear ones.
    field = points @ [1.0, -2.0, 3.0] + (points[:, 0] * points[:, 2] + points[:, 1] ** 2 if cells.shape[1] > 8 else 0)
    corners = points[cells[:, :{"hex": 8, "tet": 4, "wed": 6}.get(kind[:3], 5)]].mean(1)
    if kind == "pyramid5":  # at a quarter of the height
        corners = 0.75 * points[cells[:, :4]].mean(1) + 0.25 * points[cells[:, 4]]
    exact = corners @ [1.0, -2.0, 3.0] + (corners[:, 0] * corners[:, 2] + corners[:, 1] ** 2 if cells.shape[1] > 8 else 0)
    expect(np.allclose(Section.middle_of(cells, field), exact, atol=1e-12), f"{kind}: fields in the middle of cells")
for linear, quadratic in (("tet4", "tet10"), ("hex8", "hex20"), ("hex8", "hex27"), ("wedge6", "wedge15")):
    expect(errors[quadratic] < 0.4 * errors[linear], f"{quadratic} {errors[quadratic]:.1e} is bent, {linear} {errors[linear]:.1e} is not")

points = np.concatenate([cube("hex8", 2)[0], cube("tet4", 2)[0] + [1, 0, 0]])
first, second = cube("hex8", 2), cube("tet4", 2)
cells = np.full((len(first[1]) + len(second[1]), 8), -1)
cells[:len(first[1])], cells[len(first[1]):, :4] = first[1], second[1] + len(first[0])
body = np.concatenate([first[2], 2 + second[2]])
section = Section(cells, body, points[:, 2] + 0.1 * points[:, 0] - 0.3)
polygons = areas(section.at(section.polygons, points))
expect(np.allclose([polygons[section.body == b].sum() for b in range(4)], [np.sqrt(1.01), 0, np.sqrt(1.01), 0]),
       "a mesh of two kinds of cells")
finish()
