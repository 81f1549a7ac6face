# SPDX-License-Identifier: BSD-3-Clause
"""Faces that are paired: tolerances, and meshes that do not match."""
import forms
import scenes
from host import Out
from rows_mesh import obstacle_motion, squares
from scenes import TYPES, field
from table import row


def see_tolerance(see, adding):
    """adding(shift): the status with tolerance 0 when partners are `shift` of an edge apart."""
    see.equal("status 0.98e-6 of an edge apart", adding(0.98e-6), 0)
    see.equal("status 1.02e-6 of an edge apart", adding(1.02e-6), -3)


@row("tolerance 0 of an interface", says=["mesh_add_interface: 0 selects 1e-6"])
def tolerance(host, see):
    def adding(shift, given=0.0):
        return host.status("mesh_add_interface", squares(host, shift, 0.0), 0, 1, given, Out())

    see_tolerance(see, adding)
    see.equal("status at tolerance 1e-3", adding(0.9e-3, 1e-3), 0)


@row("tolerance 0 of all interfaces", tells=["mesh_add_all_interfaces out_count"])
def tolerance_of_all(host, see):
    found = [host("mesh_add_all_interfaces", squares(host, 0.0, shift), 0.0, Out()) for shift in (0.98e-6, 1.02e-6)]
    see.equal("interfaces 0.98e-6 and 1.02e-6 of an edge apart", found, [1, 0])


def one_body(host, places, cells):
    mesh = host("mesh_create", host.context, 2, len(places), [float(c) for p in places for c in p], Out())
    host("mesh_add_cells", mesh, TYPES["quad4"], len(cells) // 4, cells, None, 0)
    return mesh


@row("tolerance 0 of seams", tells=["mesh_add_seams out_count"])
def tolerance_of_seams(host, see):
    found = [host("mesh_add_seams", one_body(host, scenes.SQUARE + [(x, 1 + y + shift) for x, y in scenes.SQUARE],
                                             list(range(8))), 0.0, Out()) for shift in (0.98e-6, 1.02e-6)]
    see.equal("interfaces 0.98e-6 and 1.02e-6 of an edge apart", found, [1, 0])


@row("seam with a tip")
def seam_with_tip(host, see):
    """The slit y = 1 of a body of 3 x 2 squares, from x = 0 to x = 2. Both sides share node 6, its tip."""
    places = [(x, y) for y in range(3) for x in range(4)] + [(0, 1), (1, 1)]
    mesh = one_body(host, places, [0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 12, 13, 9, 8, 13, 6, 10, 9, 6, 7, 11, 10])
    see.equal("interfaces of two calls", [host("mesh_add_seams", mesh, 0.0, Out()) for _ in range(2)], [1, 0])
    see.equal("bodies, pairs, faces", host("mesh_interface_size", mesh, 0, *[Out()] * 4, None)[:4], [0, 0, 2, 1])
    nodes_a, nodes_b, weights, frames = host("mesh_interface_pairs", mesh, 0, Out(2), Out(2), Out(2), Out(8))
    see.equal("pairs", [nodes_a, nodes_b], [4, 5, 12, 13])
    see.near("weights", weights, [0.5, 1.0], "L")
    see.near("normals from a to b", [frames[4 * p:4 * p + 2] for p in range(2)], [[0.0, 1.0]] * 2)


@row("seams that cross")
def seams_that_cross(host, see):
    """Two slits through a body of 2 x 2 squares, each of which has nodes of its own: an arm on either side of the
    middle for each slit."""
    mesh = one_body(host, [(x + i, y + j) for j in (0, 1) for i in (0, 1) for x, y in scenes.SQUARE], list(range(16)))
    see.equal("interfaces of two calls", [host("mesh_add_seams", mesh, 0.0, Out()) for _ in range(2)], [4, 0])
    arms = [host("mesh_interface_pairs", mesh, k, Out(2), Out(2), Out(2), None)[:2] for k in range(4)]
    see.equal("pairs of each arm", sorted(sorted([list(p) for p in zip(*arm)]) for arm in arms),
              [[[1, 4], [2, 7]], [[2, 9], [3, 8]], [[6, 13], [7, 12]], [[9, 12], [10, 15]]])


@row("self contact of a slot", tells=["mesh_add_self_contact out_count"])
def self_contact(host, see):
    """The slot 1 <= y <= 2, x >= 2 of a body of 4 x 3 squares, whose walls are 1 apart."""
    corners = [0, 1, 2, 3, 5, 6, 10, 11, 12, 13]
    mesh = one_body(host, [(x, y) for y in range(4) for x in range(5)],
                    [n + shift for n in corners for shift in (0, 1, 6, 5)])
    see.equal("interfaces at gap 0.98, 1.02", [host("mesh_add_self_contact", mesh, gap, Out()) for gap in (0.98, 1.02)],
              [0, 1])
    body_a, body_b, pairs = host("mesh_interface_size", mesh, 0, Out(), Out(), Out(), None, None)[:3]
    see.equal("bodies", [body_a, body_b], [0, 0])
    nodes_a, nodes_b, _, frames = host("mesh_interface_pairs", mesh, 0, Out(pairs), Out(pairs), Out(pairs),
                                       Out(4 * pairs))
    count = host("mesh_size", mesh, None, Out(), None, None, None)[1]
    places = host("mesh_nodes", mesh, 2 * count, Out(2 * count))
    gaps = [forms.dot(frames[4 * p:4 * p + 2], [places[2 * b + k] - places[2 * a + k] for k in range(2)])
            for p, (a, b) in enumerate(zip(nodes_a, nodes_b))]
    see.near("smallest and largest distance from a to b along the normals", [min(gaps), max(gaps)], [1.0, 1.0], "L")


@row("gap 0 of a projected interface",
     says=["mesh_add_projected_interface: e.g. 0, counts as 1e-6"])
def gap(host, see):
    see_tolerance(see, lambda shift: host.status("mesh_add_projected_interface", squares(host, 0.0, shift), 0, 1, 0.0,
                                                 Out()))


@row("gap 0 of a mortar interface")
def gap_of_means(host, see):
    see_tolerance(see, lambda shift: host.status("mesh_add_mortar_interface", squares(host, 0.0, shift), 0, 1, 0.0,
                                                 Out()))


@row("mortar interface", tells=["mesh_add_mortar_interface out_interface"])
def mortar(host, see):
    # One edge below, two of unequal length above: 0 .. 4 and 0 .. 1 .. 4; b below.
    low, high = [(0, 0), (4, 0), (0, 1), (4, 1)], [(x, y) for y in (1, 2) for x in (0, 1, 4)]
    mesh = host("mesh_create", host.context, 2, 10, [float(c) for n in low + high for c in n], Out())
    host("mesh_add_cells", mesh, TYPES["quad4"], 3, [0, 1, 3, 2, 4, 5, 8, 7, 5, 6, 9, 8], [0, 1, 1], 0)
    see.equal("index", host("mesh_add_mortar_interface", mesh, 1, 0, 0.0, Out()), 0)
    nodes_a, nodes_b, weights, frames = host("mesh_interface_pairs", mesh, 0, Out(2), Out(2), Out(2), Out(8))
    see.equal("pairs", [nodes_a, nodes_b], [10, 11, 2, 3])
    see.near("weights", weights, [2.0, 2.0], "L")
    see.near("normals from a to b", [frames[4 * p:4 * p + 2] for p in range(2)], [[0.0, -1.0]] * 2)
    nodes, starts, of, shares = host("mesh_node_ties", mesh, None, None, Out(2), Out(3), Out(6), Out(6))[2:]
    see.equal("tied nodes", [nodes, starts, of], [10, 11, 0, 3, 6, 4, 5, 6, 4, 5, 6])
    # With N_1 = 1 - x/4, N_2 = x/4 and int N_p N_q = 4/3, 2/3, the projection of v has the values
    # v_1 = int (1 - 3 x/8) v and v_2 = int (3 x/8 - 1/2) v.
    see.near("means", shares, [[7 / 16, 3 / 4, -3 / 16], [-3 / 16, 1 / 4, 15 / 16]])


@row("projected interface", tells=["mesh_node_ties nodes", "mesh_node_ties starts", "mesh_node_ties of",
                                   "mesh_node_ties weights", "mesh_node_ties count", "mesh_node_ties entries",
                                   "mesh_add_projected_interface out_interface"])
def projected(host, see):
    # Two edges of unequal length below, three above: 0 .. 1.6 .. 3 and 0 .. 1 .. 2 .. 3.
    low = [(0, 0), (1.6, 0), (3, 0), (0, 1), (1.6, 1), (3, 1)]
    high = [(k, 1 + h) for h in (0, 1) for k in range(4)]
    mesh = host("mesh_create", host.context, 2, 14, [float(c) for n in low + high for c in n], Out())
    host("mesh_add_cells", mesh, TYPES["quad4"], 5,
         [0, 1, 4, 3, 1, 2, 5, 4, 6, 7, 11, 10, 7, 8, 12, 11, 8, 9, 13, 12], [0, 0, 1, 1, 1], 0)
    see.equal("index", host("mesh_add_projected_interface", mesh, 0, 1, 0.0, Out()), 0)
    nodes_a, nodes_b, weights, frames = host("mesh_interface_pairs", mesh, 0, Out(4), Out(4), Out(4), Out(16))
    see.equal("pairs", [nodes_a, nodes_b], [14, 15, 16, 17, 6, 7, 8, 9])
    see.near("weights", weights, [0.5, 1.0, 1.0, 0.5], "L")
    see.near("normals", [frames[4 * p:4 * p + 2] for p in range(4)], [[0.0, 1.0]] * 4)
    count, entries = host("mesh_node_ties", mesh, Out(), Out(), None, None, None, None)[:2]
    nodes, starts, of, shares = host("mesh_node_ties", mesh, None, None, Out(count), Out(count + 1), Out(entries),
                                     Out(entries))[2:]
    see.equal("tied nodes", nodes, [14, 15, 16, 17])
    see.equal("entries", entries, starts[-1])
    wanted = {14: {3: 1.0}, 15: {3: 0.375, 4: 0.625}, 16: {4: 1 / 1.4, 5: 0.4 / 1.4}, 17: {5: 1.0}}
    for k, node in enumerate(nodes):
        found = {}
        for e in range(starts[k], starts[k + 1]):
            found[of[e]] = found.get(of[e], 0.0) + shares[e]
        found = {n: w for n, w in found.items() if abs(w) > 1e-12}
        see.equal(f"ends of tie {k}", sorted(found), sorted(wanted[node]))
        see.near(f"shares of tie {k}", [found.get(n, 0.0) for n in sorted(wanted[node])],
                 [wanted[node][n] for n in sorted(wanted[node])])


NORMALS = [forms.unit([-3.0, 4.0]), forms.unit([0.6, 1.9])]


def on_slopes(host, times, values):
    """The square of the row "obstacle" on its two slopes, and the pattern of its gaps."""
    mesh = host("mesh_create", host.context, 2, 5, [float(c) for p in scenes.SQUARE for c in p] + [5.0, 5.0], Out())
    host("mesh_add_cells", mesh, TYPES["quad4"], 1, [0, 1, 2, 3], None, 0)
    host("mesh_add_obstacle", mesh, 2, [1, 0], [c for n in NORMALS for c in n], [0.125, 0.5], 4, 0, Out())
    problem = host("problem_create", host.context, mesh, Out())
    host("problem_set_elastic", problem, 0, 100.0, 0.3)
    host("problem_set_formulation", problem, 0, "standard")
    host("problem_set_contact", problem, 0)
    rise, apart = scenes.ramp(host, problem, "rise"), scenes.ramp(host, problem, "apart", times, values)
    scenes.hold(host, problem, [2, 3], [[1.0, 0.0], [0.0, 1.0]])
    scenes.hold(host, problem, [4], [[1.0, 0.0]])
    scenes.drive(host, problem, [4], [0.0, 1.0], rise, [0.01])
    return problem, apart


@row("gaps", tells=["problem_set_gaps gaps", "solver_field values jump"])
def gaps_of_slopes(host, see):
    """A slope that is lower by its gap is met later, one that is higher presses from the start of its pattern on. The
    gaps are along the normals of the pairs and times the factor; the last call counts."""
    problem, apart = on_slopes(host, [0.0, 1.0], [0.5, 2.0])
    host("problem_set_gaps", problem, 0, apart, [-0.004, 0.003], 0.0)
    host("problem_set_gaps", problem, 0, apart, [0.002, 0.004], 0.0)
    solver = host("solver_create", problem, 0.0, Out())
    see.near("jump before anything moves", field(host, solver, "jump"), [[0.001, 0.0], [0.002, 0.0]], "L")
    see.equal("contact before anything moves", field(host, solver, "contact"), [0, 0])
    see.near("energy before anything moves", scenes.value(host, solver, "stored_bulk"), 0.0, "F L", scale=1e-6)
    for name, gaps in ("gaps", [0.001, 0.002]), ("gap and interference", [0.0015, -0.002]):
        problem, apart = on_slopes(host, [0.0, 1.0], [0.0, 2.0])
        host("problem_set_gaps", problem, 0, apart, gaps, 0.0)
        solver = host("solver_create", problem, 0.0, Out())
        host("solver_advance", solver, 1.0)
        see.equal(f"contact, {name}", field(host, solver, "contact"), [1, 1])
        see.near(f"displacement, {name}", field(host, solver, "displacement"),
                 obstacle_motion(NORMALS, [2.0 * g for g in gaps]), "L", rel=1e-8)
        see.near(f"normal jump, {name}", [j[0] for j in field(host, solver, "jump")], [0.0, 0.0], "L", scale=0.01)
        forces = [w * t[0] for w, t in zip((0.125, 0.5), field(host, solver, "traction"))]
        see.that(f"both slopes press, {name}", max(forces) < 0.0)
        see.near(f"reaction: sum of gap times normal force, {name}", scenes.value(host, solver, "reaction:apart"),
                 forms.dot(gaps, forces), "F L", rel=1e-8)


def distances(host, gaps, adjust, law=False):
    """The jumps of two pairs, with oblique normals, between two squares that are 0.125 and 0.25 apart; and their
    adhesion. Everything is held, the factor is 2."""
    nodes = [0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 1.0, 0.0, 1.125, 1.0, 1.25, 1.0, 2.0, 0.0, 2.0]
    mesh = host("mesh_create", host.context, 2, 8, nodes, Out())
    host("mesh_add_cells", mesh, TYPES["quad4"], 2, list(range(8)), [0, 1], 0)
    host("mesh_add_pairs", mesh, 0, 1, 2, [3, 2], [4, 5], [c for n in NORMALS for c in n], [0.5, 0.5], 0, 0, None, 0,
         Out())
    problem = host("problem_create", host.context, mesh, Out())
    host("problem_set_elastic", problem, -1, 1.0, 0.0)
    if law:
        host("problem_set_law", problem, 0, scenes.strong(host, 10.0, 10.0))
    else:
        host("problem_set_contact", problem, 0)
    host("problem_set_gaps", problem, 0, scenes.ramp(host, problem, values=(2.0, 2.0)), gaps, adjust)
    scenes.hold(host, problem, list(range(8)), [[1.0, 0.0], [0.0, 1.0]])
    solver = host("solver_create", problem, 0.0, Out())
    return [j[0] for j in field(host, solver, "jump")], [a[0] for a in field(host, solver, "adhesion")]


@row("gaps of the mesh", says=["problem_set_gaps: count as 0: these"])
def gaps_of_mesh(host, see):
    known = [0.125 * NORMALS[0][1], 0.25 * NORMALS[1][1]]
    see.near("jump", distances(host, None, 0.0)[0], [2.0 * g for g in known], "L")
    see.near("jump, a gap of adjust or less", distances(host, None, known[0])[0], [0.0, 2.0 * known[1]], "L")
    see.near("jump, a gap above adjust", distances(host, None, 0.999 * known[0])[0], [2.0 * g for g in known], "L")
    see.near("jump, given gaps of adjust or less", distances(host, [0.1, 0.3], 0.1)[0], [0.0, 0.6], "L")
    see.near("adhesion", distances(host, [0.0, 0.3], 0.0, True)[1], [1.0, 0.0])
    see.near("adhesion, gaps of adjust or less", distances(host, [0.1, 0.3], 0.3, True)[1], [1.0, 1.0])


@row("distances that count as 0")
def touching(host, see):
    """Two squares of 2 in all: 1e-6 of that is rounding of coordinates."""
    for share, gap in (0.98, 0.0), (1.02, 2.04e-6):
        mesh = squares(host, 0.0, 2e-6 * share)
        host("mesh_add_mortar_interface", mesh, 0, 1, 1e-3, Out())
        problem = host("problem_create", host.context, mesh, Out())
        host("problem_set_elastic", problem, -1, 1.0, 0.0)
        host("problem_set_contact", problem, 0)
        host("problem_set_gaps", problem, 0, scenes.ramp(host, problem, values=(1.0, 1.0)), None, 0.0)
        scenes.hold(host, problem, list(range(8)), [[1.0, 0.0], [0.0, 1.0]])
        solver = host("solver_create", problem, 0.0, Out())
        see.near(f"jump, {share}e-6 of the size apart", [j[0] for j in field(host, solver, "jump")], [gap, gap], "L",
                 scale=1.0)
