# SPDX-License-Identifier: BSD-3-Clause
"""Plane sections through solid cells: marching tetrahedra, with curved cells in as many flat pieces as they have nodes
for."""
import numpy as np

PIECES = {3: [[0, 1, 2]], 4: [[0, 1, 2], [0, 2, 3]], 6: [[0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]],
          8: [[0, 4, 7], [4, 1, 5], [5, 2, 6], [6, 3, 7], [4, 5, 6], [4, 6, 7]],
          9: [[0, 4, 8], [4, 1, 8], [1, 5, 8], [5, 2, 8], [2, 6, 8], [6, 3, 8], [3, 7, 8], [7, 0, 8]]}

# The nodes of the faces, corners first, as delam.h orders those of the cells.
FACES = {4: [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
         10: [[0, 2, 1, 6, 5, 4], [0, 1, 3, 4, 8, 7], [1, 2, 3, 5, 9, 8], [2, 0, 3, 6, 7, 9]],
         8: [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]],
         20: [[0, 3, 2, 1, 11, 10, 9, 8], [4, 5, 6, 7, 12, 13, 14, 15], [0, 1, 5, 4, 8, 17, 12, 16],
              [1, 2, 6, 5, 9, 18, 13, 17], [2, 3, 7, 6, 10, 19, 14, 18], [3, 0, 4, 7, 11, 16, 15, 19]],
         6: [[3, 5, 4], [0, 1, 2], [3, 4, 1, 0], [4, 5, 2, 1], [5, 3, 0, 2]],
         15: [[3, 5, 4, 11, 10, 9], [0, 1, 2, 6, 7, 8], [3, 4, 1, 0, 9, 13, 6, 12], [4, 5, 2, 1, 10, 14, 7, 13],
              [5, 3, 0, 2, 11, 12, 8, 14]],
         5: [[0, 3, 2, 1], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]}
FACES[27] = [face + [centre] for face, centre in zip(FACES[20], (24, 25, 22, 21, 23, 20))]

# Shape functions in the middle of a cell, equal ones together: how many nodes have them, and which.
MIDDLE = {4: [(4, 1 / 4)], 8: [(8, 1 / 8)], 10: [(4, -1 / 8), (6, 1 / 4)], 20: [(8, -1 / 4), (12, 1 / 4)],
          6: [(6, 1 / 6)], 15: [(6, -2 / 9), (6, 2 / 9), (3, 1 / 3)], 5: [(4, 3 / 16), (1, 1 / 4)]}
CORNERS = {4: 4, 8: 8, 10: 4, 20: 8, 27: 8, 6: 6, 15: 6, 5: 5}


def ordered(faces, key):
    """Faces of four sides from their smallest node on, towards the smaller neighbour: both cells split them alike."""
    if faces.shape[1] not in (4, 8):
        return faces
    corner = key[faces[:, :4]]
    first = corner.argmin(1)[:, None]
    row = np.arange(len(faces))[:, None]
    back = corner[row, (first + 3) % 4] < corner[row, (first + 1) % 4]
    turn = (first + np.where(back, -1, 1) * np.arange(4)) % 4
    side = np.where(back, first - 1 - np.arange(4), first + np.arange(4)) % 4
    return np.take_along_axis(faces, np.concatenate([turn, 4 + side], 1)[:, :faces.shape[1]], 1)


def triangles_of(faces, key=None):
    """Faces as triangles [faces * pieces][3], those of one face together."""
    faces = ordered(faces, np.arange(faces.max() + 1) if key is None else key)
    return faces[:, PIECES[faces.shape[1]]].reshape(-1, 3)


def cut_triangles(triangles, distance):
    """The lines in which triangles cross the plane: pairs of nodes [lines][2 ends][2], and the triangles that cross
    it."""
    above = distance[triangles] >= 0
    number = above.sum(1)
    crossing = np.flatnonzero((number > 0) & (number < 3))
    # The node that is alone on its side comes first.
    order = np.argsort(above[crossing] == (number[crossing] == 2)[:, None], axis=1, kind="stable")
    nodes = np.take_along_axis(triangles[crossing], order, 1)
    return nodes[:, [[0, 1], [0, 2]]], crossing


def cut_tetrahedra(tetrahedra, distance):
    """Polygons as pairs of nodes [polygons][4 corners][2], and the tetrahedra; a triangle has its last corner twice."""
    above = distance[tetrahedra] >= 0
    number = above.sum(1)
    nodes = np.take_along_axis(tetrahedra, np.argsort(above, axis=1, kind="stable"), 1)
    polygons, of = [], []
    for many, corners in ((1, [[3, 0], [3, 1], [3, 2], [3, 2]]), (3, [[0, 1], [0, 2], [0, 3], [0, 3]]),
                          (2, [[0, 2], [0, 3], [1, 3], [1, 2]])):
        of.append(np.flatnonzero(number == many))
        polygons.append(nodes[of[-1]][:, corners])
    return np.concatenate(polygons), np.concatenate(of)


def on_plane(pairs, distance, values):
    """The values of the nodes, between the two of each pair, where the plane is."""
    at = distance[pairs]
    share = (at[..., 0] / (at[..., 0] - at[..., 1])).reshape(pairs.shape[:-1] + (1,) * (values.ndim - 1))
    return (1 - share) * values[pairs[..., 0]] + share * values[pairs[..., 1]]


class Section:
    """Where a plane, given by the distance of each node from it, cuts cells: polygons with their bodies, lines of the
    faces between cells, lines of the skins."""

    def __init__(self, cells, body, distance):
        size = np.abs(distance).max()
        # Nodes in the plane are in it to the last digit, whatever rounding says.
        self.distance = np.where(np.abs(distance) < 1e-9 * size, 0.0, distance)
        self.middles, polygons, of, faces = [], [], [], []
        extended = [self.distance]
        count = len(distance)
        for number in np.unique((cells >= 0).sum(1)):
            block = np.flatnonzero((cells >= 0).sum(1) == number)
            above = self.distance[cells[block, :number]] >= 0
            block = block[above.any(1) & ~above.all(1)]
            nodes = cells[block, :number]
            if len(block) == 0:
                continue
            self.middles.append(nodes)
            extended.append(self.middle_of(nodes, self.distance))
            for size in {len(face) for face in FACES[number]}:
                alike = [face for face in FACES[number] if len(face) == size]
                sides = nodes[:, alike].reshape(-1, size)
                faces.append(sides)
                triangles = triangles_of(sides)
                cell = np.repeat(np.arange(len(block)), len(triangles) // len(block))
                found, which = cut_tetrahedra(np.column_stack([triangles, count + cell]), np.concatenate(extended))
                polygons.append(found)
                of.append(body[block[cell[which]]])
            count += len(block)
        self.extended = np.concatenate(extended)
        self.polygons = np.concatenate(polygons) if polygons else np.empty((0, 4, 2), int)
        self.body = np.concatenate(of) if of else np.empty(0, int)
        # Cells of different kinds may have faces in common.
        sizes = dict.fromkeys(side.shape[1] for side in faces)
        self.edges, self.skin = self.lines([np.concatenate([s for s in faces if s.shape[1] == n]) for n in sizes])

    @staticmethod
    def middle_of(nodes, values):
        number = nodes.shape[1]
        if number not in MIDDLE:  # the last node is there
            return values[nodes[:, -1]]
        first, value = 0, 0.0
        for many, share in MIDDLE[number]:
            value = value + share * values[nodes[:, first:first + many]].sum(1)
            first += many
        return value

    def lines(self, blocks):
        """Lines between cells, and those of faces of one cell alone. A face that crosses the plane belongs to cells
        that do."""
        edges, skin = [np.empty((0, 2, 2), int)], [np.empty((0, 2, 2), int)]
        for faces in blocks:
            _, index, count = np.unique(np.sort(faces, 1), axis=0, return_index=True, return_counts=True)
            for into, kept in ((edges, index[count > 1]), (skin, index[count == 1])):
                into.append(cut_triangles(triangles_of(faces[kept]), self.distance)[0] if len(kept) else edges[0])
        return np.concatenate(edges), np.concatenate(skin)

    def at(self, pairs, values):
        """Values of nodes at corners of polygons or ends of lines."""
        if values.shape[0] < len(self.extended):
            values = np.concatenate([values, *(self.middle_of(nodes, values) for nodes in self.middles)])
        return on_plane(pairs, self.extended, values)
