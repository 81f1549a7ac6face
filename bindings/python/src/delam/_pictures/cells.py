# SPDX-License-Identifier: BSD-3-Clause
"""Draws the cells of fields.h5: outlines, skins, tones of the bodies."""
import matplotlib.colors
import numpy as np

from .section import CORNERS, FACES

# Pale tones of the bodies, by turns; fibre-1 and fibre-2 have the same.
BODIES = ["#f4f1e8", "#dde5ee", "#e6ebdf"]
ZETA = matplotlib.colors.LinearSegmentedColormap.from_list(
    "zeta", ["#b3122a", "#f2a541", "#f5e9b8", "#2b6cb0", "#0b2e59"])


def text_of(attribute):
    return attribute.decode() if isinstance(attribute, bytes) else str(attribute)


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


def tones_of(names):
    """The tone of each body, by its name without numbers; names that are numbers differ."""
    stems = [name.rstrip("-0123456789") or name for name in names]
    return [list(dict.fromkeys(stems)).index(stem) % len(BODIES) for stem in stems]


def body_tones(file):
    """The tone of each body of fields.h5."""
    number = file["mesh/body"][()].max() + 1
    return tones_of([text_of(file["mesh"].attrs[f"body_{b}"]) for b in range(number)])


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
    faces = FACES[CORNERS[cells.shape[1]]]
    return np.concatenate([cells[:, face if len(face) == 4 else [*face, face[2]]] for face in faces])


def face_keys(faces):
    """The same numbers for the same corners [n][4], however they are turned, and whichever of a triangle's is there
    twice."""
    key = np.sort(faces, 1)
    triangle = faces[:, 2] == faces[:, 3]
    if triangle.any():
        key[triangle] = np.concatenate([np.full((triangle.sum(), 1), -1), np.sort(faces[triangle][:, :3], 1)], 1)
    return key


def boundary_faces(blocks):
    """Faces of solid cells that belong to one cell only, by their corners."""
    faces = np.concatenate([cell_faces(cells) for cells in blocks])
    _, index, count = np.unique(face_keys(faces), axis=0, return_index=True, return_counts=True)
    return faces[index[count == 1]]


def without(faces, others):
    """Faces that are none of the others, by their corners."""
    _, inverse = np.unique(face_keys(np.concatenate([others, faces])), axis=0, return_inverse=True)
    inverse = inverse.ravel()
    return ~np.isin(inverse[len(others):], inverse[:len(others)])


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
