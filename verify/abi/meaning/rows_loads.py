# SPDX-License-Identifier: BSD-3-Clause
"""What histories, constraints, periodic cells and proposals of a problem mean."""
import re

import forms
import scenes
from host import Out
from rows_problem import cells
from scenes import TYPES, field
from table import row


@row("histories", tells=["problem_add_pattern times", "problem_add_pattern values", "problem_factors factors",
                         "solver_set_history times", "solver_set_history values", "problem_add_pattern out_pattern",
                         "problem_pattern_count count"])
def histories(host, see):
    mesh = cells(host, 1, 2)
    problem = host("problem_create", host.context, mesh, Out())
    host("problem_set_elastic", problem, 0, 1.0, 0.0)
    see.equal("indices", [scenes.ramp(host, problem, "first", [1.0, 2.0, 4.0], [3.0, -1.0, 5.0]),
                          scenes.ramp(host, problem, "second", [0.0, 1.0], [0.0, 7.0])], [0, 1])
    see.equal("count", host("problem_pattern_count", problem, Out()), 2)
    see.that("pattern 1 is the second", host("problem_pattern_name", problem, 1) == "second")
    for time, expected in ((0.5, [3.0, 3.5]), (1.5, [1.0, 7.0]), (3.5, [3.5, 7.0]), (9.0, [5.0, 7.0])):
        see.near(f"factors at {time}", host("problem_factors", problem, time, 2, Out(2)), expected)
    # The upper nodes follow the patterns; a history replaces the second one from time 1 on.
    scenes.hold(host, problem, [0, 1], [[1.0, 0.0], [0.0, 1.0]])
    for node, pattern in ((2, 0), (3, 1)):
        scenes.drive(host, problem, [node], [0.0, 1.0], pattern, [1e-3])
    solver = host("solver_create", problem, 0.0, Out())
    host("solver_advance", solver, 1.0)
    host("solver_commit", solver)
    host("solver_set_history", solver, 1, 3, [2.0, 4.0, 5.0], [9.0, 4.0, -6.0])
    for time, expected in ((1.5, 8.0), (3.0, 6.5), (4.5, -1.0), (9.0, -6.0)):
        host("solver_advance", solver, time)
        see.near(f"load:second at {time}", scenes.value(host, solver, "load:second"), expected)
        see.near(f"displacement at {time}", field(host, solver, "displacement")[3][1], 1e-3 * expected, "L")
        host("solver_rollback", solver)


def see_constraints(host, see, problem, expected, coefficients):
    """expected: DOF -> factor for each constraint; coefficients: [rows][patterns]."""
    rows, entries, patterns = host("problem_constraints", problem, Out(), Out(), Out(), None, None, None, None)[:3]
    starts, columns, values, right = host("problem_constraints", problem, None, None, None, Out(rows + 1), Out(entries),
                                          Out(entries), Out(rows * patterns))[3:]
    see.equal("sizes", [rows, patterns, starts[-1]], [len(expected), len(coefficients[0]), entries])
    for i, wanted in enumerate(expected):
        own = {}
        for e in range(starts[i], starts[i + 1]):
            own[columns[e]] = own.get(columns[e], 0.0) + values[e]
        see.equal(f"columns of constraint {i}", sorted(own), sorted(wanted))
        see.near(f"values of constraint {i}", [own[c] for c in sorted(own)],
                 [wanted[c] for c in sorted(own) if c in wanted])
    see.near("right sides", right, coefficients, "L")


@row("prescribed displacements", tells=["problem_prescribe_nodes nodes", "problem_prescribe_nodes direction",
                                        "problem_prescribe_nodes patterns", "problem_prescribe_nodes coefficients",
                                        "problem_prescribe_mean nodes", "problem_prescribe_mean weights",
                                        "problem_prescribe_mean direction", "problem_prescribe_mean patterns",
                                        "problem_prescribe_mean coefficients", "problem_add_equation nodes",
                                        "problem_add_equation coefficients", "problem_add_equation patterns",
                                        "problem_add_equation prescribed", "problem_constraints row_starts",
                                        "problem_constraints columns", "problem_constraints values",
                                        "problem_constraints coefficients", "problem_constraints rows",
                                        "problem_constraints entries", "problem_constraints pattern_count",
                                        "solver_field values reaction"],
     says=["problem_prescribe_nodes: pattern_count 0", "problem_add_equation: pattern_count 0"])
def prescribed(host, see):
    """The matrix of the constraints, and the displacements that meet them. Their reactions hold the body: each of its
    nodal forces is the sum of reaction times factor."""
    mesh = cells(host, 2, 2)
    problem = host("problem_create", host.context, mesh, Out())
    host("problem_set_elastic", problem, 0, 50.0, 0.25)
    host("problem_set_formulation", problem, 0, "standard")
    for name, end in (("a", 1.0), ("b", 2.0), ("c", 3.0)):
        scenes.ramp(host, problem, name, values=(0.0, end))
    host("problem_prescribe_nodes", problem, 2, [2, 5], [3.0, 4.0], 2, [2, 0], [1e-3, 5e-3, -2e-3, 4e-3], 0)
    host("problem_prescribe_mean", problem, 3, [1, 2, 5], [1.0, 2.0, 5.0], [-4.0, 3.0], 2, [1, 3], [3e-3, 1e-3], 1)
    host("problem_add_equation", problem, 2, [3, 5], [2.0, -1.0, 0.5, 3.0], 3, [1, 0, 2], [6e-3, 2e-3, 1e-3], 0)
    host("problem_prescribe_nodes", problem, 1, [4], [0.0, 2.0], 0, None, None, 1)
    host("problem_add_equation", problem, 1, [1], [2.0, 0.0], 0, None, None, 0)
    rows = [{4: 0.6, 5: 0.8}, {10: 0.6, 11: 0.8},
            {0: -0.8 / 8, 1: 0.6 / 8, 2: -1.6 / 8, 3: 1.2 / 8, 8: -4 / 8, 9: 3 / 8},
            {6: 2.0, 7: -1.0, 10: 0.5, 11: 3.0}, {7: 1.0}, {2: 2.0}]
    right = [[5e-3, 0.0, 1e-3], [4e-3, 0.0, -2e-3], [3e-3, 0.0, 1e-3], [2e-3, 6e-3, 1e-3], [0.0] * 3, [0.0] * 3]
    see_constraints(host, see, problem, rows, right)
    solver = host("solver_create", problem, 1.0, Out())
    u = [c for node in field(host, solver, "displacement") for c in node]
    see.near("left sides of the solution", [sum(v * u[c] for c, v in r.items()) for r in rows],
             [forms.dot(r, [1.0, 2.0, 3.0]) for r in right], "L")
    reaction = [r[0] for r in field(host, solver, "reaction")]
    one = forms.quad4_stiffness(0.5, 1.0, scenes.plane_stiffness(50.0, 0.25))
    force = [0.0] * 12
    for nodes in ([0, 1, 4, 3], [1, 2, 5, 4]):
        dofs = [2 * n + c for n in nodes for c in (0, 1)]
        for i, a in enumerate(dofs):
            force[a] += sum(one[i][j] * u[b] for j, b in enumerate(dofs))
    see.near("nodal forces", [sum(r * rows[i].get(dof, 0.0) for i, r in enumerate(reaction)) for dof in range(12)],
             force, "F", rel=1e-8)
    see.near("reaction:b", scenes.value(host, solver, "reaction:b"), forms.dot(reaction, [r[1] for r in right]), "F L",
             rel=1e-8)


@row("constraints that begin and end")
def begin_and_end(host, see):
    """The top of a bar of stiffness 1/2, moved by a force of 0.2, is taken where it is, on its way to zero, and let
    go."""
    problem = host("problem_create", host.context, cells(host, 1, 2), Out())
    host("problem_set_elastic", problem, 0, 1.0, 0.0)
    scenes.hold(host, problem, [0, 1, 2, 3], [[1.0, 0.0]])
    scenes.hold(host, problem, [0, 1], [[0.0, 1.0]])
    host("problem_add_forces", problem, scenes.ramp(host, problem), 2, [2, 3], [0.0, 0.1, 0.0, 0.1], 0)
    scenes.hold(host, problem, [2, 3], [[0.0, 1.0]])
    found = scenes.ramp(host, problem, "found", [1.0, 3.0], [2.0, 0.0])
    left = scenes.ramp(host, problem, "left", [2.0, 4.0], [4.0, 0.0])
    host("problem_begin_constraints", problem, 6, 2, 1.0, found)
    host("problem_end_constraints", problem, 6, 2, 2.0, left)
    solver = host("solver_create", problem, 0.0, Out())
    for time, place, force in ((1.0, 0.4, 0.0), (1.5, 0.3, -0.05), (2.0, 0.2, -0.1), (3.0, 0.3, 0.0), (4.0, 0.4, 0.0)):
        host("solver_advance", solver, time)
        host("solver_commit", solver)
        see.near(f"place at {time}", field(host, solver, "displacement")[3][1], place, "L")
        see.near(f"reactions at {time}", sum(r[0] for r in field(host, solver, "reaction")[6:8]), force, "F")


@row("constraints of tied nodes")
def tied(host, see):
    """A tied node at a quarter of the lower body's face: its displacements are those of the ends of the face."""
    low, high = [0.0, 0.0, 4.0, 0.0, 4.0, 1.0, 0.0, 1.0], [0.0, 1.0, 1.0, 1.0, 4.0, 1.0, 0.0, 2.0, 1.0, 2.0, 4.0, 2.0]
    mesh = host("mesh_create", host.context, 2, 11, low + high + [9.0, 9.0], Out())
    host("mesh_add_cells", mesh, TYPES["quad4"], 3, [0, 1, 2, 3, 4, 5, 8, 7, 5, 6, 9, 8], [0, 1, 1], 0)
    host("mesh_add_projected_interface", mesh, 0, 1, 0.0, Out())
    middle = host("mesh_interface_pairs", mesh, 0, Out(3), None, None, None)[0][1]
    see.equal("the tied node is behind the others", middle, 12)
    problem = host("problem_create", host.context, mesh, Out())
    load = scenes.ramp(host, problem)
    host("problem_prescribe_nodes", problem, 1, [middle], [3.0, 4.0], 1, [load], [1e-3], 0)
    host("problem_add_equation", problem, 3, [middle, 5, 10], [2.0, 0.0, -2.0, 0.0, 0.0, 1.0], 0, None, None, 0)
    see_constraints(host, see, problem, [{4: 0.6 / 4, 5: 0.8 / 4, 6: 1.8 / 4, 7: 2.4 / 4},
                                         {4: 0.5, 6: 1.5, 10: -2.0, 21: 1.0}], [[1e-3], [0.0]])


@row("places of a host's nodes")
def places_of_nodes(host, see):
    """A body without cells on springs of its own has the displacements of a dense solve, wherever its nodes are."""
    matrix = [[4.0, 1.0, -0.5, 0.2], [1.0, 5.0, 0.3, -0.7], [-0.5, 0.3, 6.0, 1.1], [0.2, -0.7, 1.1, 3.0]]
    force = [0.3, -0.2, 0.7, 0.9]
    for places in ([0.0, 0.0, 1.0, 0.0], [5.0, -3.0, -200.0, 7.0], [1.0, 1.0, 1.0, 1.0]):
        mesh = host("mesh_create", host.context, 2, 2, places, Out())
        host("mesh_add_host_body", mesh, 0, 2, [0, 1], 0)
        problem = host("problem_create", host.context, mesh, Out())
        host("problem_set_stiffness", problem, 2, [0, 1], None, [0, 4, 8, 12, 16], list(range(4)) * 4,
             [k for line in matrix for k in line], -1, None, 0)
        host("problem_add_forces", problem, scenes.ramp(host, problem), 2, [0, 1], force, 0)
        see.near(f"displacement with nodes at {places}",
                 field(host, host("solver_create", problem, 1.0, Out()), "displacement"),
                 forms.solve([list(line) for line in matrix], list(force)), "L")


@row("periodic cell", tells=["problem_add_periodic periods", "problem_add_periodic control_nodes"])
def periodic(host, see):
    """A sheared cell: the displacements of the control nodes are the mean gradient along each period."""
    def build(mesh_nodes, gradient):
        mesh = host("mesh_create", host.context, 2, 6, mesh_nodes + [9.0, 9.0, 8.0, 8.0], Out())
        host("mesh_add_cells", mesh, TYPES["quad4"], 1, [0, 1, 2, 3], None, 0)
        problem = host("problem_create", host.context, mesh, Out())
        host("problem_set_elastic", problem, 0, 5.0, 0.2)
        host("problem_add_periodic", problem, 2, [2.0, 0.3, 0.7, 1.5], [6, 5], 0.0, 1)
        load = scenes.ramp(host, problem)
        scenes.hold(host, problem, [0], [[1.0, 0.0], [0.0, 1.0]])
        for node, period in ((5, [2.0, 0.3]), (4, [0.7, 1.5])):
            for c in (0, 1):
                scenes.drive(host, problem, [node], scenes.axis(2, c), load, [forms.dot(gradient[c], period)])
        return host("solver_create", problem, 1.0, Out())

    gradient = [[1e-3, 4e-3], [-2e-3, 3e-3]]
    solver = build([0.0, 0.0, 2.0, 0.3, 2.7, 1.8, 0.7, 1.5], gradient)
    see.near("average strain", host("solver_average", solver, 0, Out(), Out(6), Out(6))[1],
             [1e-3, 3e-3, 0.0, 2e-3, 0.0, 0.0])
    see.near("displacement", field(host, solver, "displacement")[:4],
             [forms.times(gradient, p) for p in ([0.0, 0.0], [2.0, 0.3], [2.7, 1.8], [0.7, 1.5])], "L")


@row("tolerance 0 of a periodic cell", says=["problem_add_periodic: 0 selects 1e-6"])
def periodic_tolerance(host, see):
    def status(shift, tolerance=0.0):
        points = [0.0, 0.0, 4.0, 0.0, 4.0 + 4 * shift, 1.0, 0.0, 1.0, 9.0, 9.0, 8.0, 8.0]
        mesh = host("mesh_create", host.context, 2, 6, points, Out())
        host("mesh_add_cells", mesh, TYPES["quad4"], 1, [0, 1, 2, 3], None, 0)
        problem = host("problem_create", host.context, mesh, Out())
        return host.status("problem_add_periodic", problem, 2, [4.0, 0.0, 0.0, 1.0], [4, 5], tolerance, 0)

    see.equal("status 0.98e-6 of the extent off", status(0.98e-6), 0)
    see.equal("status 1.02e-6 of the extent off", status(1.02e-6), -3)
    see.equal("status at tolerance 1e-3", status(0.9e-3, 1e-3), 0)


@row("proposal for a law", tells=["problem_propose stiffness", "problem_propose share",
                                  "problem_propose normal_strength", "problem_propose tangential_strength"],
     says=["problem_propose: 0 if the interface is curved"])
def proposal(host, see):
    """Two layers of unlike thickness and modulus: the thick one decides the stiffness. The strengths, set in the law,
    lead to as many pairs as were asked for: the mode whose strength is as proposed decides, the other is weaker."""
    mesh = host("mesh_create_layers", host.context, 2, [8.0], [4], 2, [0.5, 0.25], [1, 1], TYPES["quad4"], Out())
    host("mesh_add_interface", mesh, 0, 1, 0.0, Out())
    problem = host("problem_create", host.context, mesh, Out())
    host("problem_set_elastic", problem, 0, 70.0, 0.3)
    host("problem_set_elastic", problem, 1, 30.0, 0.2)
    host("problem_set_law", problem, 0, scenes.bilinear(host, (200.0, 50.0), (0.3, 0.5), (1.2, 3.0)))
    stiffness, share, normal, tangential = host("problem_propose", problem, 0, 1.5, Out(), Out(), Out(), Out())
    see.near("stiffness", stiffness, 50 * 70.0 / 0.5, "F/L3")
    see.near("share", share, 1 / (1 + 70.0 / 0.5 / 200.0))
    for name, strengths in (("normal", (normal, 0.5 * tangential)), ("tangential", (0.5 * normal, tangential))):
        onsets = tuple(s * s / (2 * k) for s, k in zip(strengths, (200.0, 50.0)))
        host("problem_set_law", problem, 0, scenes.bilinear(host, (200.0, 50.0), onsets, (1.2, 3.0)))
        length, spacing = host("problem_process_zone", problem, 0, Out(), Out())
        see.near(f"pairs with the {name} strength", length / spacing, 1.5)
    # Two sides of a ridge: no normal is that of the interface.
    mesh = host("mesh_create", host.context, 2, 12, [0, 0, 1, 1, 2, 0, 0, 2, 1, 3, 2, 2, 0, 0, 1, 1, 2, 0, 0, -2, 1, -1, 2, -2],
                Out())
    host("mesh_add_cells", mesh, TYPES["quad4"], 4, [9, 10, 7, 6, 10, 11, 8, 7, 0, 1, 4, 3, 1, 2, 5, 4], [0, 0, 1, 1], 0)
    host("mesh_add_interface", mesh, 0, 1, 0.0, Out())
    problem = host("problem_create", host.context, mesh, Out())
    host("problem_set_elastic", problem, -1, 70.0, 0.3)
    host("problem_set_law", problem, 0, scenes.bilinear(host, (200.0, 50.0), (0.3, 0.5), (1.2, 3.0)))
    ridge = host("problem_propose", problem, 0, 1.5, Out(), Out(), Out(), Out())
    see.equal("stiffness and share of a ridge", ridge[:2], [0.0, 0.0])
    see.that("strengths of a ridge", ridge[2] > 0.0 and ridge[3] > 0.0)


@row("process zone", tells=["problem_process_zone length", "problem_process_zone spacing", "problem_dofs primal",
                            "problem_dofs dual", "problem_hash out"])
def process_zone(host, see):
    mesh = host("mesh_create_layers", host.context, 2, [8.0], [4], 2, [0.5, 0.25], [1, 1], TYPES["quad4"], Out())
    host("mesh_add_interface", mesh, 0, 1, 0.0, Out())
    problem = host("problem_create", host.context, mesh, Out())
    host("problem_set_elastic", problem, 0, 70.0, 0.3)
    host("problem_set_elastic", problem, 1, 30.0, 0.2)
    host("problem_set_law", problem, 0, scenes.bilinear(host, (200.0, 50.0), (0.3, 0.5), (1.2, 3.0)))
    host("problem_set_adhesion", problem, 0, 1, [0], [0.0], 0)
    lengths = []
    for young, poisson, arm in ((70.0, 0.3, 0.5), (30.0, 0.2, 0.25)):
        modulus = young / (1 - poisson ** 2)
        for k, onset, total, slender in ((200.0, 0.3, 1.2, lambda x, h: x ** 0.25 * h ** 0.75),
                                         (50.0, 0.5, 3.0, lambda x, h: (x * h) ** 0.5)):
            thick = modulus * total / (2 * k * onset)
            lengths += [thick, slender(thick, arm)]
    length, spacing = host("problem_process_zone", problem, 0, Out(), Out())
    see.near("length", length, min(lengths), "L")
    see.near("spacing", spacing, 7.0 / 4, "L")
    see.equal("unknowns", host("problem_dofs", problem, Out(), Out()), [40, 10])
    hashes = [host("problem_hash", problem, Out(17))]
    host("problem_set_elastic", problem, 1, 31.0, 0.2)
    hashes.append(host("problem_hash", problem, Out(17)))
    see.that("hashes are 16 digits", all(re.fullmatch("[0-9a-f]{16}", text) for text in hashes))
    see.differ("hashes of two materials", *hashes)


@row("bounds of an option", tells=["option_bounds lower", "option_bounds upper", "option_bounds lower_open",
                                   "option_bounds upper_open"])
def bounds(host, see):
    """smallest_step lies in (0, 1], step_tolerance in (0, 1), threads in [1, 1024]."""
    problem = host("problem_create", host.context, cells(host, 1, 2), Out())
    found = {}
    for index in range(host("option_count")):
        key, kind = host("option_info", index, Out(), Out(), None, None, None, None)[:2]
        if kind != "text":
            found[key] = host("option_bounds", index, Out(), Out(), Out(), Out())
    for key, expected, numbers in (("smallest_step", [0.0, 1.0, 1, 0], (0.0, 1e-9, 1.0)),
                                   ("step_tolerance", [0.0, 1.0, 1, 1], (0.0, 0.999, 1.0)),
                                   ("threads", [1.0, 1024.0, 0, 0], (0.0, 1.0, 1024.0))):
        see.near(f"{key}: lower, upper, lower_open, upper_open", list(found[key]), expected)
        see.equal(f"{key}: statuses at {', '.join(f'{n:g}' for n in numbers)}",
                  [host.status("problem_set_number", problem, key, n) for n in numbers],
                  [0 if (n > expected[0] or not expected[2] and n == expected[0]) and
                   (n < expected[1] or not expected[3] and n == expected[1]) else -1 for n in numbers])
