# SPDX-License-Identifier: BSD-3-Clause
"""Faces that are paired: tolerances, and meshes that do not match."""
from host import Out
from rows_mesh import squares
from scenes import TYPES
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
