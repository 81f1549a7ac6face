# SPDX-License-Identifier: BSD-3-Clause
"""Arrays of meshes, cells and interfaces."""
import math

import forms
import scenes
from host import Out
from scenes import TYPES, field
from table import row

# x = A xi + b, with columns of different lengths and angles.
AFFINE = {2: ([[2.0, 0.5], [0.3, 1.5]], [0.25, -0.5]),
          3: ([[2.0, 0.5, 0.2], [0.3, 1.5, -0.4], [0.1, 0.6, 1.2]], [0.25, -0.5, 1.0])}


def determinant(a):
    if len(a) == 2:
        return a[0][0] * a[1][1] - a[0][1] * a[1][0]
    return forms.dot(a[0], forms.cross(a[1], a[2]))


# The middle of the unit square or its like, and its size.
MIDDLE = {"tri": [1 / 3] * 2, "quad": [0.5] * 2, "tet": [0.25] * 3, "hex": [0.5] * 3, "wedge": [1 / 3, 1 / 3, 0.5],
          "pyramid": [0.5, 0.5, 0.25]}
SIZE = {"tri": 1 / 2, "quad": 1.0, "tet": 1 / 6, "hex": 1.0, "wedge": 1 / 2, "pyramid": 1 / 3}


def centre(name):
    return MIDDLE[scenes.shape_of(name)]


class Polynomial:
    """A field in the coordinates of the reference cell that the cell holds exactly."""

    def __init__(self, name):
        d = self.dimension = len(scenes.places_of(name)[0])
        self.linear = [forms.numbers(d, 11 + c, 1e-3, 9e-3) for c in range(d)]
        pairs = [(i, j) for i in range(d) for j in range(i, d)]
        if name in ("quad4", "hex8"):
            pairs = [(i, j) for i, j in pairs if i != j]
        elif name in ("tri3", "tet4", "pyramid5"):
            pairs = []
        elif name == "wedge6":
            pairs = [(0, 2), (1, 2)]
        self.square = [dict(zip(pairs, forms.numbers(len(pairs), 23 + c, 1e-3, 9e-3))) for c in range(d)]

    def at(self, xi):
        return [forms.dot(self.linear[c], xi) + sum(q * xi[i] * xi[j] for (i, j), q in self.square[c].items())
                for c in range(self.dimension)]

    def slope(self, xi):
        rows = []
        for c in range(self.dimension):
            slope = list(self.linear[c])
            for (i, j), q in self.square[c].items():
                slope[i] += q * xi[j]
                slope[j] += q * xi[i]
            rows.append(slope)
        return rows


def padded(gradient):
    d = len(gradient)
    return [[gradient[i][j] if i < d and j < d else 0.0 for j in range(3)] for i in range(3)]


def see_cell(host, see, name, adding):
    places = scenes.places_of(name)
    d, n = len(places[0]), len(places)
    a, b = AFFINE[d]
    polynomial = Polynomial(name)
    factor = next(f for f in (5, 3, 4) if math.gcd(f, n) == 1)
    order = [(factor * k + (3 if n % 5 else 2)) % n for k in range(n)]  # node of the mesh -> of the cell
    where = {node: k for k, node in enumerate(order)}
    points = [[forms.dot(row_, places[k]) + shift for row_, shift in zip(a, b)] for k in order]
    mesh = host("mesh_create", host.context, d, n, forms_flat(points), Out())
    host(adding, mesh, TYPES[name], 1, [where[k] + 1 for k in range(n)], [3], 1)
    see.equal("nodes of the cell", host("mesh_cells", mesh, Out(1), Out(1), Out(2), n, Out(n), Out())[3],
              [where[k] for k in range(n)])
    problem = host("problem_create", host.context, mesh, Out())
    host("problem_set_elastic", problem, 3, 70.0, 0.3)
    motion = [polynomial.at(places[order[node]]) for node in range(n)]
    scenes.fill(host, problem, list(range(n)), lambda node: motion[node], scenes.ramp(host, problem))
    solver = host("solver_create", problem, 1.0, Out())
    back = forms.inverse(a)
    slope = polynomial.slope(centre(name))
    gradient = padded([[sum(slope[i][k] * back[k][j] for k in range(d)) for j in range(d)] for i in range(d)])
    strain = forms.strain_of(gradient)
    stress = forms.stress(forms.isotropic(70.0, 0.3), strain)
    volume, average, tension = host("solver_average", solver, 3, Out(), Out(6), Out(6))
    see.near("volume", volume, SIZE[scenes.shape_of(name)] * determinant(a), f"L{d}")
    see.near("average strain", average, strain)
    see.near("average stress", tension, stress, "F/L2")
    see.near("stress at the centre", field(host, solver, "stress"), stress if d == 3 else stress[:4], "F/L2")
    spin = [0.5 * (gradient[2][1] - gradient[1][2]), 0.5 * (gradient[0][2] - gradient[2][0]),
            0.5 * (gradient[1][0] - gradient[0][1])]
    see.near("rotation at the centre", field(host, solver, "rotation"), spin if d == 3 else spin[2:], "rad")
    see.near("rotation_max", scenes.value(host, solver, "rotation_max"), math.sqrt(forms.dot(spin, spin)), "rad")
    see.near("displacement", field(host, solver, "displacement"), motion, "L")


def forms_flat(points):
    return [c for point in points for c in point]


for _name in TYPES:
    row(f"connectivity of {_name}",
        tells=["mesh_create nodes", "mesh_add_cells connectivity", "mesh_cells connectivity",
               "solver_average strain", "solver_average stress", "solver_average volume", "solver_field values stress",
               "solver_field values displacement"] + (["solver_field values rotation"] if _name == "hex8" else []))(
        lambda host, see, name=_name: see_cell(host, see, name, "mesh_add_cells"))


@row("connectivity of conforming cells", tells=["mesh_add_conforming_cells connectivity"])
def conforming_cell(host, see):
    see_cell(host, see, "quad8", "mesh_add_conforming_cells")


@row("topology of the cell types", tells=["cell_type_topology face", "cell_type_topology middle"] + [
    f"cell_type_info {p}"
    for p in ("cell_type", "dimension", "nodes", "corners", "faces", "face_nodes", "face_corners")])
def topology(host, see):
    """Faces by their geometry, middle nodes by the list of the header; also the numbers of delam_cell_type_info."""
    for index in range(host("cell_type_count")):
        name, number, d, nodes, corners, faces, face_nodes, face_corners = host("cell_type_info", index,
                                                                                *[Out() for _ in range(8)])
        places = [list(p) + [0.0] * (3 - d) for p in scenes.places_of(name)]
        shape = scenes.shape_of(name)
        count, most = {"tri": (3, 2), "quad": (4, 2), "tet": (4, 3), "hex": (6, 4), "wedge": (5, 4),
                       "pyramid": (5, 4)}[shape]
        quadratic = bool(scenes.middles_of(name))
        see.equal(f"{name}: numbers", [number, d, nodes, corners, faces, face_nodes, face_corners],
                  [TYPES[name], d, len(places), len(scenes.CORNERS[shape]), count,
                   most * (1 if not quadratic else 2) + (name == "hex27") if d == 3 else 2 + quadratic, most])
        face, middle = host("cell_type_topology", index, Out(54), Out(38))
        wanted = [c for pair in scenes.middles_of(name) + scenes.CENTRES.get(name, []) for c in pair]
        see.equal(f"{name}: middle", middle[:2 * (nodes - corners)], wanted)
        seen = set()
        for f in range(faces):
            row_of = face[f * face_nodes:(f + 1) * face_nodes]
            own = [k for k in row_of if k >= 0]
            see.that(f"{name}: face {f}: -1 stands at the end alone", row_of[len(own):] == [-1] * (face_nodes - len(own)))
            per_face = sum(k < corners for k in own)
            see.that(f"{name}: face {f}: corners stand first", all(k < corners for k in own[:per_face]))
            seen.add(tuple(sorted(own[:per_face])))
            x = [places[k] for k in own]
            edges = [[q - p for p, q in zip(x[k], x[(k + 1) % per_face])] for k in range(per_face)]
            normal = forms.cross(edges[0], edges[1]) if d == 3 else [edges[0][1], -edges[0][0], 0.0]
            inside = centre(name) + [0.0] * (3 - d)
            see.that(f"{name}: face {f} has an outward normal",
                     all(forms.dot(normal, [p - c for p, c in zip(point, inside)]) > 0 for point in x))
            for k in range(len(own) - per_face):
                # Behind the middle nodes comes the centre, on a diagonal.
                ends = (x[k], x[(k + 1) % per_face]) if k < per_face else (x[0], x[2])
                see.that(f"{name}: face {f}: middle node {k} lies between its corners",
                         all(abs(m - (p + q) / 2) < 1e-15 for m, p, q in zip(x[per_face + k], *ends)))
            # Corners go round: the diagonal is no edge.
            see.that(f"{name}: face {f}: corners go round", per_face < 4 or
                     all(abs(p + r - q - s) < 1e-15 for p, q, r, s in zip(*x[:4])))
        see.equal(f"{name}: faces that differ", len(seen), faces)
        see.recorded(f"{name}: face", face[:faces * face_nodes])


@row("layers", tells=["mesh_create_layers lengths", "mesh_create_layers divisions", "mesh_create_layers thickness",
                      "mesh_create_layers layer_divisions", "mesh_nodes nodes", "mesh_cells types", "mesh_cells bodies",
                      "mesh_cells offsets", "mesh_cells needed", "mesh_node_bodies bodies", "mesh_size dimension",
                      "mesh_size node_count", "mesh_size cell_count", "mesh_size body_count",
                      "mesh_size interface_count"])
def layers(host, see):
    lengths, divisions, thickness, cuts = [2.0, 3.0], [3, 2], [0.5, 0.75, 0.3], [1, 2, 3]
    mesh = host("mesh_create_layers", host.context, 3, lengths, divisions, 3, thickness, cuts, TYPES["hex8"], Out())
    nodes, bodies, cells, bottom = [], [], [], 0.0
    for layer, (height, cut) in enumerate(zip(thickness, cuts)):
        first = len(nodes)
        for k in range(cut + 1):
            for j in range(divisions[1] + 1):
                for i in range(divisions[0] + 1):
                    nodes.append([i * lengths[0] / divisions[0], j * lengths[1] / divisions[1],
                                  bottom + k * height / cut])
                    bodies.append(layer)
        row_, plate = divisions[0] + 1, (divisions[0] + 1) * (divisions[1] + 1)
        for k in range(cut):
            for j in range(divisions[1]):
                for i in range(divisions[0]):
                    low = [first + k * plate + (j + b) * row_ + i + a for a, b in scenes.SQUARE]
                    cells.append(low + [node + plate for node in low])
        bottom += height
    see.equal("sizes", host("mesh_size", mesh, Out(), Out(), Out(), Out(), Out()), [3, len(nodes), len(cells), 3, 0])
    see.near("nodes", host("mesh_nodes", mesh, 3 * len(nodes), Out(3 * len(nodes))), nodes, "L")
    see.equal("node bodies", host("mesh_node_bodies", mesh, len(nodes), Out(len(nodes))), bodies)
    types, labels, offsets, connectivity, needed = host("mesh_cells", mesh, Out(len(cells)), Out(len(cells)),
                                                        Out(len(cells) + 1), 8 * len(cells), Out(8 * len(cells)), Out())
    see.equal("types", types, [TYPES["hex8"]] * len(cells))
    see.equal("labels", labels, [bodies[cell[0]] for cell in cells])
    see.equal("offsets", offsets, [8 * c for c in range(len(cells) + 1)])
    see.equal("connectivity", connectivity, cells)
    see.equal("needed", needed, 8 * len(cells))


@row("labels and types of cells", tells=["mesh_add_cells bodies", "mesh_add_conforming_cells bodies",
                                         "mesh_node_origins origins", "mesh_cells types"],
     says=["mesh_add_cells: NULL if all cells"])
def labels(host, see):
    nodes = [(0, 0), (1, 0), (2, 0), (0, 1), (1, 1), (2, 1), (3, 0), (3, 1)]
    mesh = host("mesh_create", host.context, 2, 8, [float(c) for n in nodes for c in n], Out())
    # A square and two triangles of a conforming mesh; the bodies share nodes.
    host("mesh_add_conforming_cells", mesh, TYPES["quad4"], 2, [0, 1, 4, 3, 1, 2, 5, 4], [7, 2], 0)
    host("mesh_add_conforming_cells", mesh, TYPES["tri3"], 2, [2, 6, 7, 2, 7, 5], [2, 9], 0)
    see.equal("cells", host("mesh_cells", mesh, Out(4), Out(4), Out(5), 14, Out(14), Out()),
              [2, 2, 1, 1, 7, 2, 2, 9, 0, 4, 8, 11, 14, 0, 1, 4, 3, 8, 2, 5, 9, 2, 6, 7, 10, 11, 12, 14])
    count = host("mesh_size", mesh, None, Out(), None, None, None)[1]
    see.equal("origins", host("mesh_node_origins", mesh, count, Out(count)), [0, 1, 2, 3, 4, 5, 6, 7, 1, 4, 2, 7, 5])
    see.equal("node bodies", host("mesh_node_bodies", mesh, count, Out(count)), [7, 7, 2, 7, 7, 2, 2, 2, 2, 2, 9, 9, 9])
    see.equal("interfaces", host("mesh_add_all_interfaces", mesh, 0.0, Out()), 2)
    sizes = [host("mesh_interface_size", mesh, k, Out(), Out(), Out(), Out(), Out()) for k in (0, 1)]
    see.equal("interfaces by label", sizes, [2, 7, 2, 1, 2, 2, 9, 3, 2, 2])
    other = host("mesh_create", host.context, 2, 8, [float(c) for n in nodes for c in n], Out())
    host("mesh_add_cells", other, TYPES["quad4"], 2, [0, 1, 4, 3, 2, 6, 7, 5], [5, 3], 0)
    see.equal("labels", host("mesh_cells", other, Out(2), Out(2), Out(3), 8, Out(8), Out())[1], [5, 3])
    bare = host("mesh_create", host.context, 2, 8, [float(c) for n in nodes for c in n], Out())
    host("mesh_add_cells", bare, TYPES["quad4"], 2, [0, 1, 4, 3, 2, 6, 7, 5], None, 0)
    see.equal("without labels", host("mesh_cells", bare, Out(2), Out(2), Out(3), 8, Out(8), Out())[1], [0, 0])


def squares(host, offset, gap):
    """Two unit squares on top of each other, the upper one moved."""
    upper = [(x + offset, 1 + y + gap) for x, y in scenes.SQUARE]
    mesh = host("mesh_create", host.context, 2, 8, forms_flat(scenes.SQUARE + upper), Out())
    host("mesh_add_cells", mesh, TYPES["quad4"], 2, list(range(8)), [0, 1], 0)
    return mesh


@row("an interface that is found", tells=["mesh_interface_pairs nodes_a", "mesh_interface_pairs nodes_b",
                                          "mesh_interface_pairs weights", "mesh_interface_pairs frames",
                                          "mesh_interface_faces faces", "mesh_interface_size body_a",
                                          "mesh_interface_size body_b", "mesh_interface_size pair_count",
                                          "mesh_interface_size face_count", "mesh_interface_size nodes_per_face",
                                          "mesh_add_interface out_interface"])
def found_interface(host, see):
    """Between rows of quad8 of unequal lengths: Simpson's weights, pairs by coordinates, normals from a to b."""
    xs = [0.0, 0.5, 1.0, 2.0, 3.0]
    low = [(0, 0), (1, 0), (3, 0), (0, 1), (1, 1), (3, 1), (0.5, 0), (2, 0), (0.5, 1), (2, 1), (0, 0.5), (1, 0.5),
           (3, 0.5)]
    high = [(x, y + 1) for x, y in low]
    mesh = host("mesh_create", host.context, 2, 26, [float(c) for n in low + high for c in n], Out())
    cells = [[0, 1, 4, 3, 6, 11, 8, 10], [1, 2, 5, 4, 7, 12, 9, 11]]
    host("mesh_add_cells", mesh, TYPES["quad8"], 4, [n + s for s in (0, 13) for cell in cells for n in cell],
         [4, 4, 6, 6], 0)
    see.equal("index", host("mesh_add_interface", mesh, 6, 4, 0.0, Out()), 0)  # a above, b below
    see.equal("sizes", host("mesh_interface_size", mesh, 0, Out(), Out(), Out(), Out(), Out()), [6, 4, 5, 2, 3])
    nodes_a, nodes_b, weights, frames = host("mesh_interface_pairs", mesh, 0, Out(5), Out(5), Out(5), Out(20))
    see.equal("nodes of a", nodes_a, [13 + n for n in (0, 6, 1, 7, 2)])
    see.equal("nodes of b", nodes_b, [3, 8, 4, 9, 5])
    see.near("weights", weights, [1 / 6, 4 / 6, 1 / 6 + 2 / 6, 8 / 6, 2 / 6], "L")
    see.near("normals", [frames[4 * p:4 * p + 2] for p in range(5)], [[0.0, -1.0]] * 5)
    see.near("tangents", [[abs(c) for c in frames[4 * p + 2:4 * p + 4]] for p in range(5)], [[1.0, 0.0]] * 5)
    see.recorded("frames", frames, "1")
    faces = host("mesh_interface_faces", mesh, 0, Out(6))
    see.equal("faces: pairs of each", [sorted(faces[:3]), sorted(faces[3:])], [0, 1, 2, 2, 3, 4])
    see.equal("faces: middle nodes last", [faces[2], faces[5]], [1, 3])
    see.recorded("faces", faces)
    see.that("the pairs are sorted by x", [low[n - 13][0] for n in nodes_a] == xs)


@row("rows of frames", tells=["mesh_add_pairs normals", "mesh_add_pairs weights", "mesh_add_pairs nodes_a",
                              "mesh_add_pairs nodes_b", "mesh_interface_pairs frames", "solver_field values jump",
                              "solver_field values traction", "mesh_add_host_body nodes", "mesh_add_pairs faces",
                              "mesh_add_pairs out_interface"])
def frames(host, see):
    """Two bodies of three nodes each that are moved as a whole, in space, with normals in three directions: jumps and
    tractions are the motion in each row of the frames, and the stiffness of each row is that of the law."""
    points = [(0, 0, 0), (2, 0, 0), (0, 3, 0)]
    mesh = host("mesh_create", host.context, 3, 7, [float(c) for p in points + points for c in p] + [9.0] * 3, Out())
    host("mesh_add_host_body", mesh, 1, 3, [2, 0, 1], 0)
    host("mesh_add_host_body", mesh, 2, 3, [4, 5, 3], 0)
    normals = [[1.0, 2.0, 2.0], [-2.0, 3.0, 6.0], [4.0, -4.0, 7.0]]
    a, b, weights = [1, 2, 0], [5, 3, 4], [0.25, 0.5, 1.25]
    see.equal("index", host("mesh_add_pairs", mesh, 1, 2, 3, [n + 1 for n in a], [n + 1 for n in b],
                            forms_flat(normals), weights, 1, 3, [3, 1, 2], 1, Out()), 0)
    nodes_a, nodes_b, found, rows = host("mesh_interface_pairs", mesh, 0, Out(3), Out(3), Out(3), Out(27))
    see.equal("pairs", [nodes_a, nodes_b], [a, b])
    see.near("weights", found, weights, "L2")
    see.equal("face", host("mesh_interface_faces", mesh, 0, Out(3)), [2, 0, 1])
    bases = [[rows[9 * p + 3 * k:9 * p + 3 * k + 3] for k in range(3)] for p in range(3)]
    see.near("rows are orthonormal", [[forms.dot(r, s) for r in base for s in base] for base in bases],
             [[1.0, 0, 0, 0, 1.0, 0, 0, 0, 1.0]] * 3)
    see.near("first row: the normal", [base[0] for base in bases], [forms.unit(n) for n in normals])
    see.recorded("frames", bases, "1")
    problem = host("problem_create", host.context, mesh, Out())
    host("problem_set_law", problem, 0, scenes.strong(host, 100.0, 7.0))
    identity = [[float(i == j) for j in range(9)] for i in range(9)]
    spring = [[(5.0 if i % 3 == j % 3 else 0.0) * (2.0 if i == j else -1.0) for j in range(9)] for i in range(9)]
    for body in ((0, 1, 2), (3, 4, 5)):
        host("problem_set_stiffness", problem, 3, body, None, [9 * k for k in range(10)],
             [j for _ in identity for j in range(9)], forms_flat(spring), -1, None, 0)
    # u_b - u_a of each pair, in an open state: the motion plus something along the normal.
    motion = {n: [3e-3 + 1e-3 * m for m in forms.numbers(3, 40 + n)] for n in (3, 4, 5)}
    for p, base in enumerate(bases):
        for k in range(3):
            motion[b[p]][k] += 2e-2 * base[0][k]
    rest = {n: [1e-3 * m for m in forms.numbers(3, 60 + n)] for n in (0, 1, 2)}
    scenes.fill(host, problem, list(range(6)), lambda n: {**motion, **rest}[n], scenes.ramp(host, problem))
    solver = host("solver_create", problem, 1.0, Out())
    jumps = [[forms.dot(r, [m - n for m, n in zip(motion[b[p]], rest[a[p]])]) for r in base]
             for p, base in enumerate(bases)]
    see.near("jump", field(host, solver, "jump"), jumps, "L")
    see.near("traction", field(host, solver, "traction"),
             [[k * j for k, j in zip((100.0, 7.0, 7.0), jump)] for jump in jumps], "F/L2")


@row("both tangents", tells=["mesh_interface_pairs frames"])
def tangents(host, see):
    """Of an interface normal to z: which row is along x and which along y; a motion along x shows in that component."""
    mesh = host("mesh_create_layers", host.context, 3, [1.0, 1.0], [1, 1], 2, [1.0, 1.0], [1, 1], TYPES["hex8"], Out())
    host("mesh_add_interface", mesh, 0, 1, 0.0, Out())
    rows = host("mesh_interface_pairs", mesh, 0, None, None, None, Out(36))[3]
    bases = [[rows[9 * p + 3 * k:9 * p + 3 * k + 3] for k in range(3)] for p in range(4)]
    see.recorded("frames", bases, "1")
    see.near("normals", [base[0] for base in bases], [[0.0, 0.0, 1.0]] * 4)
    problem = host("problem_create", host.context, mesh, Out())
    host("problem_set_elastic", problem, -1, 1.0, 0.0)
    host("problem_set_law", problem, 0, scenes.strong(host, 10.0, 3.0))
    moved = [0.02, 0.05, 0.11]
    scenes.fill(host, problem, list(range(16)), lambda n: moved if n > 7 else [0.0] * 3, scenes.ramp(host, problem))
    solver = host("solver_create", problem, 1.0, Out())
    see.near("jump", field(host, solver, "jump"), [[forms.dot(r, moved) for r in base] for base in bases], "L")


@row("nodes in a box", tells=["mesh_find_nodes lower", "mesh_find_nodes upper", "mesh_find_nodes nodes",
                              "mesh_find_nodes count"],
     says=["mesh_find_nodes: body -1 selects"])
def box(host, see):
    mesh = host("mesh_create_layers", host.context, 3, [3.0, 3.0], [3, 3], 2, [2.0, 1.0], [2, 1], TYPES["hex8"], Out())
    points = host("mesh_nodes", mesh, 80 * 3, Out(80 * 3))
    lower, upper = [-0.5, 0.5, 1.5], [1.5, 2.5, 2.5]
    inside = [n for n in range(80) if all(lo <= c <= up for lo, c, up in zip(lower, points[3 * n:3 * n + 3], upper))]
    nodes, count = host("mesh_find_nodes", mesh, -1, lower, upper, 80, Out(80), Out())
    see.equal("nodes of all bodies", nodes[:count], inside)
    nodes, count = host("mesh_find_nodes", mesh, 1, lower, upper, 80, Out(80), Out())
    see.equal("nodes of body 1", nodes[:count], [n for n in inside if n >= 48])


@row("patch", tells=["mesh_find_patch lower", "mesh_find_patch upper", "mesh_find_patch direction",
                     "mesh_find_patch nodes", "mesh_find_patch weights", "mesh_find_patch count"],
     says=["mesh_find_patch: -1: of every body"])
def patch(host, see):
    """A box that cuts two edges of unequal length: integrals of the two hats by hand. Where all faces count, the
    direction alone chooses one of the sides of a corner."""
    nodes = [(0, 0), (1, 0), (3, 0), (0, 1), (1, 1), (3, 1)]
    mesh = host("mesh_create", host.context, 2, 6, [float(c) for n in nodes for c in n], Out())
    host("mesh_add_cells", mesh, TYPES["quad4"], 2, [0, 1, 4, 3, 1, 2, 5, 4], [0, 0], 0)

    def find(lower, upper, direction, body=0):
        found, weights, count = host("mesh_find_patch", mesh, body, lower, upper, direction, 6, Out(6), Out(6), Out())
        return found[:count], weights[:count]

    found, weights = find([0.25, 0.5], [2.0, 1.5], [0.1, 2.0])
    # Edge 0 .. 1: from 0.25 on; edge 1 .. 3: its first half.
    left = (1 - 0.25) ** 2 / 2, (1 - 0.25 ** 2) / 2
    right = (1 - 0.25) * 1.0, 0.25 * 1.0
    see.equal("nodes", found, [3, 4, 5])
    see.near("weights", weights, [left[0], left[1] + right[0], right[1]], "L")
    found, weights = find([-9.0, -9.0], [9.0, 9.0], [2.0, 0.5])
    see.equal("nodes of the right side", found, [2, 5])
    see.near("weights of the right side", weights, [0.5, 0.5], "L")
    found, weights = find([-9.0, -9.0], [9.0, 9.0], [0.5, -2.0])
    see.equal("nodes of the lower side", found, [0, 1, 2])
    see.near("weights of the lower side", weights, [0.5, 1.5, 1.0], "L")
    mesh = squares(host, 0.0, 0.0)
    found, weights = find([-9.0, -9.0], [9.0, 9.0], [0.0, 1.0], -1)
    see.equal("upper sides of two bodies", found, [2, 3, 6, 7])
    see.near("their weights", weights, [0.5] * 4, "L")
    see.equal("upper side of body 1", find([-9.0, -9.0], [9.0, 9.0], [0.0, 1.0], 1)[0], [6, 7])


@row("obstacle", tells=["mesh_add_obstacle nodes", "mesh_add_obstacle normals", "mesh_add_obstacle weights",
                        "mesh_add_obstacle out_interface"],
     says=["mesh_add_obstacle: NULL: "])
def obstacle(host, see):
    """A square on two slopes that rise by `rise`: each node moves along its slope, the pressures hold the load."""
    def build(weights):
        mesh = host("mesh_create", host.context, 2, 5, [float(c) for p in scenes.SQUARE for c in p] + [5.0, 5.0], Out())
        host("mesh_add_cells", mesh, TYPES["quad4"], 1, [0, 1, 2, 3], None, 0)
        index = host("mesh_add_obstacle", mesh, 2, [2, 1], [-3.0, 4.0, 0.6, 1.9], weights, 4, 1, Out())
        see.equal("index", index, 0)
        return mesh

    computed = host("mesh_interface_pairs", build(None), 0, Out(2), Out(2), Out(2), Out(8))
    see.equal("pairs", computed[:2], [4, 4, 1, 0])
    see.near("weights that are computed", computed[2], [0.5, 0.5], "L")
    mesh = build([0.125, 0.5])
    given = host("mesh_interface_pairs", mesh, 0, Out(2), Out(2), Out(2), Out(8))
    see.near("weights that are given", given[2], [0.125, 0.5], "L")
    normals = [forms.unit([-3.0, 4.0]), forms.unit([0.6, 1.9])]
    see.near("normals", [given[3][:2], given[3][4:6]], normals)
    problem = host("problem_create", host.context, mesh, Out())
    host("problem_set_elastic", problem, 0, 100.0, 0.3)
    host("problem_set_formulation", problem, 0, "standard")
    host("problem_set_contact", problem, 0)
    rise = scenes.ramp(host, problem)
    scenes.hold(host, problem, [2, 3], [[1.0, 0.0], [0.0, 1.0]])
    scenes.hold(host, problem, [4], [[1.0, 0.0]])
    scenes.drive(host, problem, [4], [0.0, 1.0], rise, [0.01])
    solver = host("solver_create", problem, 0.0, Out())
    host("solver_advance", solver, 1.0)
    see.equal("contact", field(host, solver, "contact"), [1.0, 1.0])
    moved = field(host, solver, "displacement")
    see.near("gap of each node along its normal",
             [forms.dot(n, [u - c for u, c in zip(moved[node], [0.0, 0.01])]) for n, node in zip(normals, (1, 0))],
             [0.0, 0.0], "L", scale=0.01)
    see.near("displacement", moved, obstacle_motion(normals), "L", rel=1e-8)
    tractions = field(host, solver, "traction")
    push = [[-w * t[0] * c for c in n] for w, t, n in zip((0.125, 0.5), tractions, normals)]
    see.near("reaction: work of the obstacle", scenes.value(host, solver, "reaction:load"),
             0.01 * (push[0][1] + push[1][1]), "F L", rel=1e-8)


def obstacle_motion(normals, gaps=(0.0, 0.0)):
    """The square: four unknowns of the lower nodes, two pressures. gaps: below nodes 1 and 0, before the rise."""
    stiffness = forms.quad4_stiffness(1.0, 1.0, scenes.plane_stiffness(100.0, 0.3))
    matrix = [[0.0] * 6 for _ in range(6)]
    for i in range(4):
        for j in range(4):
            matrix[i][j] = stiffness[i][j]
    right = [0.0] * 6
    for p, (normal, node) in enumerate(zip(normals, (1, 0))):
        for k in range(2):
            matrix[4 + p][2 * node + k] = matrix[2 * node + k][4 + p] = normal[k]
        right[4 + p] = 0.01 * normal[1] - gaps[p]
    u = forms.solve(matrix, right)
    return [[u[0], u[1]], [u[2], u[3]], [0.0, 0.0], [0.0, 0.0], [0.0, 0.01]]
