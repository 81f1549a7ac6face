# SPDX-License-Identifier: BSD-3-Clause
"""Arrays and defaults of problems: materials, host stiffness, supports, loads."""
import forms
import scenes
from host import Out
from scenes import TYPES, field
from table import row

NINE = [150.0, 12.0, 9.0, 0.31, 0.27, 0.41, 5.0, 4.2, 3.1]  # E1 E2 E3 nu12 nu13 nu23 G12 G13 G23
IN_SPACE = [[1.1e-3, 2.3e-3, -1.7e-3], [0.4e-3, -0.9e-3, 2.9e-3], [-0.6e-3, 1.3e-3, 3.1e-3]]
TURN = [[1.0, 2.0, -0.5], [-1.5, 1.0, 0.7]]  # of axes 1 and 2
SWELLING = [1e-3, 2e-3, -3e-3, 0.7e-3, 1.9e-3, -0.4e-3]
OTHER = [[0.3, -1.0, 0.8], [1.0, 0.2, 0.6]]


def stiffness_of(nine):
    e1, e2, e3, nu12, nu13, nu23, g12, g13, g23 = nine
    return forms.orthotropic(e1, e2, e3, nu12, nu13, nu23, g12, g13, g23)


def cells(host, count, dimension=3):
    """A row of cells, 1 wide and high, 0.5 long."""
    across = [1.0] * (dimension - 2)
    return host("mesh_create_layers", host.context, dimension, [0.5 * count] + across, [count] + [1] * len(across), 1,
                [1.0], [1], TYPES["hex8" if dimension == 3 else "quad4"], Out())


def moved(host, problem, mesh, gradient):
    """Prescribes u = gradient x, and returns the solver at factor 1."""
    d = len(gradient)
    count = host("mesh_size", mesh, None, Out(), None, None, None)[1]
    points = host("mesh_nodes", mesh, d * count, Out(d * count))
    scenes.fill(host, problem, list(range(count)), lambda n: forms.times(gradient, points[d * n:d * n + d]),
                scenes.ramp(host, problem))
    return host("solver_create", problem, 1.0, Out())


def plane(gradient):
    return [[gradient[i][j] if i < 2 and j < 2 else 0.0 for j in range(3)] for i in range(3)]


@row("nine constants", tells=["problem_set_orthotropic constants", "solver_field values stress",
                              "solver_average strain", "solver_average stress"])
def nine(host, see):
    mesh = cells(host, 1)
    problem = host("problem_create", host.context, mesh, Out())
    host("problem_set_orthotropic", problem, 0, NINE)
    solver = moved(host, problem, mesh, IN_SPACE)
    strain = forms.strain_of(IN_SPACE)
    stress = forms.stress(stiffness_of(NINE), strain)
    see.near("stress", field(host, solver, "stress"), stress, "F/L2")
    volume, average, tension = host("solver_average", solver, -1, Out(), Out(6), Out(6))
    see.near("volume", volume, 0.5, "L3")
    see.near("average strain", average, strain)
    see.near("average stress", tension, stress, "F/L2")
    see.near("stored_bulk", scenes.value(host, solver, "stored_bulk"), 0.25 * forms.dot(strain, stress), "F L")


@row("one constant at a time")
def each(host, see):
    """Each modulus as the answer to its own load: pure shear in each plane, and each pair of axes pulled."""
    for what, gradient, expected in (
            ("G12: xy", [[0, 2e-3, 0], [0, 0, 0], [0, 0, 0]], {3: NINE[6]}),
            ("G23: yz", [[0, 0, 0], [0, 0, 2e-3], [0, 0, 0]], {4: NINE[8]}),
            ("G13: zx", [[0, 0, 2e-3], [0, 0, 0], [0, 0, 0]], {5: NINE[7]})):
        mesh = cells(host, 1)
        problem = host("problem_create", host.context, mesh, Out())
        host("problem_set_orthotropic", problem, 0, NINE)
        solver = moved(host, problem, mesh, gradient)
        see.near(what, field(host, solver, "stress"), [2e-3 * expected.get(k, 0.0) for k in range(6)], "F/L2")


@row("nine constants in the plane", says=["problem_set_plane: \"plane-strain\" (default)"])
def in_plane(host, see):
    strain = forms.strain_of(plane(IN_SPACE))
    full = stiffness_of(NINE)
    for assumption in (None, "plane-strain", "plane-stress"):
        mesh = cells(host, 1, 2)
        problem = host("problem_create", host.context, mesh, Out())
        if assumption:
            host("problem_set_plane", problem, assumption)
        host("problem_set_orthotropic", problem, -1, NINE)
        solver = moved(host, problem, mesh, [r[:2] for r in IN_SPACE[:2]])
        whole = list(strain)
        if assumption == "plane-stress":  # zz, yz, zx without stress
            whole[2] = -(full[2][0] * strain[0] + full[2][1] * strain[1]) / full[2][2]
        stress = forms.times(full, whole)
        see.near(f"stress, {assumption or 'default'}", field(host, solver, "stress"), stress[:4], "F/L2")
        average = host("solver_average", solver, 0, Out(), Out(6), Out(6))
        see.near(f"average strain, {assumption or 'default'}", average[1], whole)
        see.near(f"average stress, {assumption or 'default'}", average[2], stress, "F/L2")


@row("material axes", tells=["problem_set_orientation axes", "problem_set_orientation cells"],
     says=["problem_set_orientation: NULL with count 1", "problem_set_orientation: -1: in any body"])
def axes(host, see):
    """Three cells in a row: two get axes of their own, by an index from 1; the third keeps those of all."""
    mesh = cells(host, 3)
    problem = host("problem_create", host.context, mesh, Out())
    host("problem_set_orthotropic", problem, 0, NINE)
    third = [[0.0, 1.0, 0.2], [0.0, 0.3, -1.0]]
    host("problem_set_orientation", problem, -1, 1, None, [c for a in third for c in a], 0)
    host("problem_set_orientation", problem, 0, 2, [3, 1], [c for two in (TURN, OTHER) for a in two for c in a], 1)
    solver = moved(host, problem, mesh, IN_SPACE)
    strain = forms.strain_of(IN_SPACE)
    see.near("stress", field(host, solver, "stress"),
             [forms.stress(stiffness_of(NINE), strain, forms.axes_of(*two)) for two in (OTHER, third, TURN)], "F/L2")


@row("materials of all bodies", says=["problem_set_elastic: -1: for all", "problem_set_orthotropic: -1: for all",
                                       "problem_add_eigenstrain: -1: to all", "solver_average: -1: of all"])
def all_bodies(host, see):
    for given in ("elastic", "orthotropic"):
        mesh = host("mesh_create_layers", host.context, 3, [1.0, 1.0], [1, 1], 2, [1.0, 1.0], [1, 1], TYPES["hex8"],
                    Out())
        host("mesh_add_interface", mesh, 0, 1, 0.0, Out())
        problem = host("problem_create", host.context, mesh, Out())
        host("problem_set_law", problem, 0, scenes.strong(host, 10.0, 10.0))
        if given == "elastic":
            host("problem_set_elastic", problem, -1, 70.0, 0.25)
        else:
            host("problem_set_orthotropic", problem, -1, NINE)
        heat = scenes.ramp(host, problem, "heat")
        host("problem_add_eigenstrain", problem, heat, -1, SWELLING)
        solver = moved(host, problem, mesh, IN_SPACE)
        stiffness = forms.isotropic(70.0, 0.25) if given == "elastic" else stiffness_of(NINE)
        strain = [e - s for e, s in zip(forms.strain_of(IN_SPACE), SWELLING)]
        see.near(given, field(host, solver, "stress"), [forms.stress(stiffness, strain)] * 2, "F/L2")
        see.near("volumes of body 1 and of all", [host("solver_average", solver, body, Out(), None, None)[0]
                                                  for body in (1, -1)], [1.0, 2.0], "L3")


@row("formulation by default", says=["problem_set_formulation: the default", "problem_set_formulation: -1: of all"])
def formulation(host, see):
    """The energy of a square quad4 that is bent, u = x y: standard cells add the shear y. Bodies without quad4 and hex8
    are standard."""
    for given in (None, "standard", "incompatible"):
        mesh = host("mesh_create", host.context, 2, 4, [-0.5, -0.5, 0.5, -0.5, 0.5, 0.5, -0.5, 0.5], Out())
        host("mesh_add_cells", mesh, TYPES["quad4"], 1, [0, 1, 2, 3], None, 0)
        problem = host("problem_create", host.context, mesh, Out())
        host("problem_set_elastic", problem, 0, 24.0, 0.0)
        if given:
            host("problem_set_formulation", problem, -1, given)
        bent = [[0.25, 0.0], [-0.25, 0.0], [0.25, 0.0], [-0.25, 0.0]]
        scenes.fill(host, problem, [0, 1, 2, 3], lambda n: bent[n], scenes.ramp(host, problem))
        solver = host("solver_create", problem, 1.0, Out())
        # 1/2 E I for the bending alone; and 1/2 G int x^2 for the shear.
        see.near(f"energy, {given or 'default'}", scenes.value(host, solver, "stored_bulk"),
                 1.0 + (0.5 if given == "standard" else 0.0), "F L")
    for cell in TYPES:
        places, hashes = scenes.places_of(cell), {}
        mesh = host("mesh_create", host.context, len(places[0]), len(places), [c for p in places for c in p], Out())
        host("mesh_add_cells", mesh, TYPES[cell], 1, list(range(len(places))), None, 0)
        for given in (None, "standard", "incompatible"):
            problem = host("problem_create", host.context, mesh, Out())
            if given is None or host.status("problem_set_formulation", problem, -1, given) == 0:
                hashes[given] = host("problem_hash", problem, Out(17))
        initial = "incompatible" if cell in ("quad4", "hex8") else "standard"
        see.that(f"{cell} is {initial} by default: {hashes}", hashes[None] == hashes[initial])
        see.equal(f"formulations of {cell}", len(hashes), 3 if initial == "incompatible" else 2)


@row("eigenstrain", tells=["problem_add_eigenstrain strain", "problem_forces forces",
                           "problem_eigenstrain_energy matrix", "solver_field values stress"])
def eigenstrain(host, see):
    """In a body that is held everywhere: stress, nodal forces and energies, in the axes of the cell and of space."""
    strains = [SWELLING, [-2e-3, 0.5e-3, 1e-3, 3e-3, -1.2e-3, 0.6e-3]]
    mesh = cells(host, 1)
    problem = host("problem_create", host.context, mesh, Out())
    host("problem_set_orthotropic", problem, 0, NINE)
    host("problem_set_orientation", problem, 0, 1, None, [c for a in TURN for c in a], 0)
    hot, wet = (scenes.ramp(host, problem, name) for name in ("hot", "wet"))
    for pattern, strain in zip((hot, wet), strains):
        host("problem_add_eigenstrain", problem, pattern, 0, strain)
    scenes.hold(host, problem, list(range(8)), [scenes.axis(3, k) for k in range(3)])
    stresses = [forms.times(stiffness_of(NINE), strain) for strain in strains]
    see.near("energies", host("problem_eigenstrain_energy", problem, 4, Out(4)),
             [[0.5 * forms.dot(e, s) for s in stresses] for e in strains], "F L")
    basis = forms.transposed(forms.axes_of(*TURN))
    in_space = [forms.turned(forms.tensor(stress, False), basis) for stress in stresses]
    # int dN/dx over a box of 0.5 x 1 x 1, the nodes with x running fastest.
    slopes = [[(2 * (n >> k & 1) - 1) * a for k, a in enumerate((0.25, 0.125, 0.125))] for n in range(8)]
    for name, pattern, stress in (("hot", hot, in_space[0]), ("wet", wet, in_space[1])):
        see.near(f"forces of {name}", host("problem_forces", problem, pattern, 24, Out(24)),
                 [forms.times(stress, slope) for slope in slopes], "F")
    solver = host("solver_create", problem, 1.0, Out())
    see.near("stress", field(host, solver, "stress"),
             [-a - b for a, b in zip(*[forms.six_of(stress, False) for stress in in_space])], "F/L2")


@row("stiffness of a body", tells=["problem_body_matrix row_starts", "problem_body_matrix columns",
                                   "problem_body_matrix values", "problem_body_matrix rows",
                                   "problem_body_matrix entries"])
def body_matrix(host, see):
    mesh = host("mesh_create", host.context, 2, 6, [9.0, 9.0, 0.0, 1.0, 2.0, 1.0, 9.0, 8.0, 0.0, 0.0, 2.0, 0.0], Out())
    host("mesh_add_cells", mesh, TYPES["quad4"], 1, [4, 5, 2, 1], None, 0)
    problem = host("problem_create", host.context, mesh, Out())
    host("problem_set_orthotropic", problem, 0, NINE)
    host("problem_set_formulation", problem, 0, "standard")
    host("problem_set_orientation", problem, 0, 1, None, [3.0, 1.0, 0.0, -1.0, 3.0, 0.0], 0)
    rows, entries = host("problem_body_matrix", problem, 0, Out(), Out(), None, None, None)[:2]
    starts, columns, values = host("problem_body_matrix", problem, 0, None, None, Out(rows + 1), Out(entries),
                                   Out(entries))[2:]
    see.equal("rows", rows, 8)
    see.equal("ends of the rows", [starts[0], starts[-1]], [0, entries])
    matrix = [[0.0] * 8 for _ in range(8)]
    for i in range(8):
        for e in range(starts[i], starts[i + 1]):
            matrix[i][columns[e]] += values[e]
    turned = [forms.stress(stiffness_of(NINE), scenes.axis(6, k), forms.axes_of([3.0, 1.0, 0.0], [-1.0, 3.0, 0.0]))
              for k in (0, 1, 3)]
    own = forms.quad4_stiffness(2.0, 1.0, [[column[i] for column in turned] for i in (0, 1, 3)])
    corner = [3, 2, 0, 1]  # of the nodes 1, 2, 4, 5
    see.near("matrix", matrix, [[own[2 * corner[i] + a][2 * corner[j] + b] for j in range(4) for b in (0, 1)]
                                for i in range(4) for a in (0, 1)], "F/L")


def host_matrix(component):
    """[6][6], symmetric, without energy in translations alone; component: of each row."""
    matrix = [[0.0] * 6 for _ in range(6)]
    for k in range(6):
        v = forms.numbers(6, 90 + k)
        for c in (0, 1):
            own = [i for i in range(6) if component[i] == c]
            mean = sum(v[i] for i in own) / 3
            for i in own:
                v[i] -= mean
        for i in range(6):
            for j in range(6):
                matrix[i][j] += 3.0 * v[i] * v[j]
    return matrix


@row("host stiffness", tells=["problem_set_stiffness nodes", "problem_set_stiffness dofs",
                              "problem_set_stiffness row_starts", "problem_set_stiffness columns",
                              "problem_set_stiffness values", "problem_set_stiffness kernel",
                              "problem_add_forces nodes", "problem_add_forces forces", "mesh_add_host_body nodes",
                              "mesh_add_pairs weights", "solver_field values displacement",
                              "solver_field values jump", "problem_forces forces"],
     says=["problem_set_stiffness: (kernel NULL): ",
           "problem_set_stiffness: NULL: dimension*i + component",
           "mesh_add_pairs: face_count 0: "])
def host_stiffness(host, see):
    """Three nodes of a host's on springs of unequal weight to three that are held, under forces: against a dense
    solve. Rows and nodes are out of order; entries are given twice; the motions without energy are given or found."""
    order = [6, 4, 5]  # nodes[i]
    rows = [3, 0, 5, 1, 4, 2]  # dofs: of node order[i], component c at 2 i + c
    place = {(node, c): rows[2 * i + c] for i, node in enumerate(order) for c in (0, 1)}
    component = [next(c for (_, c), own in place.items() if own == r) for r in range(6)]
    matrix = host_matrix(component)
    weights, springs = [0.5, 1.25, 0.75], (40.0, 9.0)
    forces = {4: [0.3, 0.9], 5: [-0.2, 0.7], 6: [0.5, 1.1]}
    full = [list(r) for r in matrix]
    # Pair p: normals along (3, 4)/5, so that x and y mix.
    normal, tangent = [0.6, 0.8], [-0.8, 0.6]
    for node, weight in zip((4, 5, 6), weights):
        for c in (0, 1):
            for d in (0, 1):
                full[place[node, c]][place[node, d]] += weight * (springs[0] * normal[c] * normal[d] +
                                                                  springs[1] * tangent[c] * tangent[d])
    right = [0.0] * 6
    for node, force in forces.items():
        for c in (0, 1):
            right[place[node, c]] = force[c]
    found = forms.solve(full, right)
    motion = {node: [found[place[node, c]] for c in (0, 1)] for node in forces}
    for kernel in (True, False):
        mesh = host("mesh_create", host.context, 2, 7, [0.0, 0.0, 1.0, 0.2, 2.0, -0.1, 9.0, 9.0, 0.0, 0.5, 1.0, 0.7,
                                                        2.0, 0.4], Out())
        host("mesh_add_host_body", mesh, 0, 3, [0, 1, 2], 0)
        host("mesh_add_host_body", mesh, 1, 3, [5, 6, 7], 1)
        host("mesh_add_pairs", mesh, 0, 1, 3, [1, 2, 3], [5, 6, 7], [3.0, 4.0] * 3, weights, 0, 2, None, 1, Out())
        problem = host("problem_create", host.context, mesh, Out())
        host("problem_set_law", problem, 0, scenes.strong(host, *springs))
        spring = [[(2.0 if i == j else -1.0) * (i % 2 == j % 2) for j in range(6)] for i in range(6)]
        host("problem_set_stiffness", problem, 3, [0, 1, 2], None, list(range(0, 42, 6)), list(range(6)) * 6,
             [c for r in spring for c in r], -1, None, 0)
        # Full rows but for the first, whose third entry comes in two parts; columns from 1, out of order.
        starts, columns, values = [1], [], []
        for i in range(6):
            for j in sorted(range(6), key=lambda j: (7 * j + i) % 6):
                parts = [0.25, 0.75] if (i, j) == (0, 2) else [1.0]
                columns += [j + 1] * len(parts)
                values += [part * matrix[i][j] for part in parts]
            starts.append(len(values) + 1)
        motions = [[2.0 if component[r] == c else 0.0 for r in range(6)] for c in (0, 1)]
        host("problem_set_stiffness", problem, 3, [n + 1 for n in order], [r + 1 for r in rows], starts, columns,
             values, 2 if kernel else -1, [m for motion_ in motions for m in motion_] if kernel else None, 1)
        scenes.hold(host, problem, [0, 1, 2], [[1.0, 0.0], [0.0, 1.0]])
        load = scenes.ramp(host, problem)
        host("problem_add_forces", problem, load, 3, [7, 5, 6], [c for n in (6, 4, 5) for c in forces[n]], 1)
        if kernel:
            see.near("forces", host("problem_forces", problem, load, 14, Out(14)),
                     [forces.get(n, [0.0, 0.0]) for n in range(7)], "F")
        solver = host("solver_create", problem, 0.0, Out())
        host("solver_advance", solver, 1.0)
        what = "motions given" if kernel else "motions found"
        see.near(f"displacement, {what}", field(host, solver, "displacement"),
                 [motion.get(n, [0.0, 0.0]) for n in range(7)], "L", rel=1e-8)
        see.near(f"normal jump, {what}", [j[0] for j in field(host, solver, "jump")],
                 [forms.dot(normal, motion[n]) for n in (4, 5, 6)], "L", rel=1e-8)


@row("initial adhesion", tells=["problem_set_adhesion pairs", "problem_set_adhesion adhesion",
                                "solver_field values adhesion", "solver_field values contact"])
def adhesion(host, see):
    mesh = host("mesh_create_layers", host.context, 2, [4.0], [4], 2, [1.0, 1.0], [1, 1], TYPES["quad4"], Out())
    host("mesh_add_interface", mesh, 0, 1, 0.0, Out())
    problem = host("problem_create", host.context, mesh, Out())
    host("problem_set_elastic", problem, -1, 1.0, 0.0)
    host("problem_set_law", problem, 0, scenes.strong(host, 10.0, 10.0))
    host("problem_set_adhesion", problem, 0, 3, [4, 1, 3], [0.25, 0.5, 0.0], 1)
    scenes.hold(host, problem, list(range(20)), [[1.0, 0.0]])
    scenes.hold(host, problem, list(range(5)), [[0.0, 1.0]])
    scenes.hold(host, problem, list(range(15, 20)), [[0.0, 1.0]])
    solver = host("solver_create", problem, 0.0, Out())
    see.near("adhesion", field(host, solver, "adhesion"), [0.5, 1.0, 0.0, 0.25, 1.0])
    see.near("contact: of the pair that is open", field(host, solver, "contact"), [0.0, 0.0, 1.0, 0.0, 0.0])


@row("adhesion in a box", tells=["problem_set_adhesion_box lower", "problem_set_adhesion_box upper",
                                 "problem_set_adhesion_box count"])
def adhesion_box(host, see):
    """Boxes whose sides lie on pairs: at a tip they keep their adhesion, at the end of the interface they do not. The
    heights of the boxes tell the axes apart: across them, the second box would miss the interface."""
    mesh = host("mesh_create_layers", host.context, 2, [4.0], [4], 2, [1.0, 1.0], [1, 1], TYPES["quad4"], Out())
    host("mesh_add_interface", mesh, 0, 1, 0.0, Out())
    problem = host("problem_create", host.context, mesh, Out())
    host("problem_set_elastic", problem, -1, 1.0, 0.0)
    host("problem_set_law", problem, 0, scenes.strong(host, 10.0, 10.0))
    counts = [host("problem_set_adhesion_box", problem, 0, [2.5, 1.0], [4.0, 1.0], 0.5, Out()),
              host("problem_set_adhesion_box", problem, 0, [-1.0, 0.5], [1.0, 1.5], 0.25, Out()),
              host("problem_set_adhesion_box", problem, 0, [0.0, 1.5], [4.0, 2.0], 0.0, Out())]
    see.equal("pairs in the boxes", counts, [2, 1, 0])
    see.that("with NULL, no pair is an error",
             host.status("problem_set_adhesion_box", problem, 0, [0.0, 1.5], [4.0, 2.0], 0.0, None) < 0)
    scenes.hold(host, problem, list(range(20)), [[1.0, 0.0]])
    scenes.hold(host, problem, list(range(5)), [[0.0, 1.0]])
    scenes.hold(host, problem, list(range(15, 20)), [[0.0, 1.0]])
    solver = host("solver_create", problem, 0.0, Out())
    see.near("adhesion", field(host, solver, "adhesion"), [0.25, 1.0, 1.0, 0.5, 0.5])
