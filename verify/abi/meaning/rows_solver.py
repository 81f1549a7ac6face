# SPDX-License-Identifier: BSD-3-Clause
"""Arrays of solvers: states, tangents, operators, fronts, records."""
import math

import forms
import scenes
from host import Out
from scenes import TYPES, field, value
from table import row


def stack(host, layers, columns=1, laws=(), width=1.0, adhesion=()):
    """Layers of height 1 in the plane, with an interface between every two; the mesh and the problem.
    laws: one for each interface; adhesion: (interface, pairs, values)."""
    mesh = host("mesh_create_layers", host.context, 2, [width * columns], [columns], layers, [1.0] * layers,
                [1] * layers, TYPES["quad4"], Out())
    for k in range(layers - 1):
        host("mesh_add_interface", mesh, k, k + 1, 0.0, Out())
    problem = host("problem_create", host.context, mesh, Out())
    host("problem_set_elastic", problem, -1, 1e3, 0.25)
    for k, law in enumerate(laws):
        host("problem_set_law", problem, k, law)
    for interface, pairs, values in adhesion:
        host("problem_set_adhesion", problem, interface, len(pairs), pairs, values, 0)
    return mesh, problem


def nodes_of(layer, columns=1):
    first = 2 * (columns + 1) * layer
    return list(range(first, first + 2 * (columns + 1)))


def rigid(host, problem, layer, patterns, columns=1):
    """Moves a layer as a whole: patterns: (direction, [(pattern, coefficient)])."""
    nodes = nodes_of(layer, columns)
    for direction, driving in patterns:
        host("problem_prescribe_nodes", problem, len(nodes), nodes, direction, len(driving), [p for p, _ in driving],
             [c for _ in nodes for _, c in driving], 0)


@row("adhesion of a displacement step", tells=["solver_equilibrate adhesion", "solver_field values adhesion",
                                               "solver_field values jump", "solver_pending pending"],
     says=["solver_equilibrate: NULL takes"])
def equilibrate(host, see):
    """Two interfaces of three pairs: each with its stiffness, opening and adhesion."""
    _, problem = stack(host, 3, 2, [scenes.strong(host, 10.0, 1.0), scenes.strong(host, 30.0, 1.0)])
    load = scenes.ramp(host, problem)
    for layer, height in ((0, 0.0), (1, 0.1), (2, 0.3)):
        rigid(host, problem, layer, [([1.0, 0.0], []), ([0.0, 1.0], [(load, height)] if height else [])], 2)
    solver = host("solver_create", problem, 0.0, Out())
    held = [1.0, 0.5, 0.25, 0.125, 0.75, 0.0]
    weights, driven = [0.5, 1.0, 0.5], ((10.0, 0.1, 0.1), (30.0, 0.2, 0.2))

    def energy(adhesion):
        parts = [w * z for w, z in zip(weights * 2, adhesion)]
        return sum(0.5 * k * u * u * sum(parts[3 * i:3 * i + 3]) for i, (k, u, _) in enumerate(driven))

    host("solver_equilibrate", solver, 1.0, held)
    see.equal("pending", host("solver_pending", solver, Out()), 1)
    see.near("adhesion", field(host, solver, "adhesion"), held)
    see.near("adhesion of interface 1", field(host, solver, "adhesion", 1), held[3:])
    see.near("normal jump", [j[0] for j in field(host, solver, "jump")], [0.1] * 3 + [0.2] * 3, "L")
    see.near("stored_interface", value(host, solver, "stored_interface"), energy(held), "F L")
    see.near("reaction:load", value(host, solver, "reaction:load"), 2 * energy(held), "F L")
    host("solver_commit", solver)
    see.equal("pending after commit", host("solver_pending", solver, Out()), 0)
    host("solver_equilibrate", solver, 0.5, None)
    see.near("adhesion, NULL", field(host, solver, "adhesion"), held)
    see.near("stored_interface, NULL", value(host, solver, "stored_interface"), 0.25 * energy(held), "F L")


@row("tangents", tells=["solver_tangent matrix", "solver_step_tangent matrix"])
def tangents(host, see):
    """Two interfaces between rigid layers that damage: at fixed adhesion zeta k, in the step the slope of softening."""
    k, onset, toughness = (200.0, 100.0), (0.3, 0.5), (1.2, 3.0)
    laws = [scenes.bilinear(host, (k[i], 1.0), (onset[i],) * 2, (toughness[i],) * 2) for i in (0, 1)]
    _, problem = stack(host, 3, 1, laws)
    lower, upper, forces = (scenes.ramp(host, problem, name) for name in ("lower", "upper", "push"))
    rigid(host, problem, 0, [([1.0, 0.0], []), ([0.0, 1.0], [])])
    rigid(host, problem, 1, [([1.0, 0.0], []), ([0.0, 1.0], [(lower, 0.1)])])
    rigid(host, problem, 2, [([1.0, 0.0], []), ([0.0, 1.0], [(upper, 0.25)])])
    host("problem_add_forces", problem, forces, 1, [0], [1.0, 1.0], 0)
    solver = host("solver_create", problem, 0.0, Out())
    host("solver_advance", solver, 1.0)
    zeta, slope = [], []
    for i, jump in enumerate((0.1, 0.15)):
        zeta.append(forms.bilinear(onset[i], toughness[i], 0.5 * k[i] * jump * jump))
        slope.append(-k[i] / (toughness[i] / onset[i] - 1))
    see.that("both interfaces damage", all(0 < z < 1 for z in zeta))
    see.near("adhesion", [field(host, solver, "adhesion", i)[0] for i in (0, 1)], zeta)

    def matrix(s):
        return [[0.01 * (s[0] + s[1]), -0.025 * s[1], 0.0], [-0.025 * s[1], 0.0625 * s[1], 0.0], [0.0] * 3]

    see.near("tangent", host("solver_tangent", solver, 9, Out(9)), matrix([z * own for z, own in zip(zeta, k)]), "F L")
    see.near("step tangent", host("solver_step_tangent", solver, 9, Out(9)), matrix(slope), "F L", rel=1e-8)


@row("condensed operator", tells=["solver_condensed stiffness", "solver_condensed load", "solver_condensed constant",
                                  "solver_condensed row_starts", "solver_condensed columns", "solver_condensed values",
                                  "solver_condensed offset", "solver_condensed_size unknowns",
                                  "solver_condensed_size entries"])
def condensed(host, see):
    """The energy that it describes, minimised with the springs of the interface by a dense solve: its jumps and
    reactions are those of the solver, which computes them its own way."""
    columns, springs = 2, (40.0, 15.0)
    mesh, problem = stack(host, 2, columns, [scenes.strong(host, *springs)])
    theta = [1.0, 0.7, 1.3]
    up, across, push = (scenes.ramp(host, problem, name, values=(0.0, end))
                       for name, end in zip(("up", "across", "push"), theta))
    scenes.hold(host, problem, [0, 1, 2], [[1.0, 0.0], [0.0, 1.0]])
    scenes.drive(host, problem, [9, 10, 11], [0.0, 1.0], up, [0.3, 0.35, 0.2])
    scenes.drive(host, problem, [9], [1.0, 0.0], across, [0.05])
    # One pair is prescribed on both sides: its jump is the loads' alone.
    host("problem_prescribe_nodes", problem, 1, [3], [1.0, 0.0], 1, [across], [0.012], 0)
    host("problem_prescribe_nodes", problem, 1, [6], [1.0, 0.0], 2, [up, across], [0.02, 0.03], 0)
    host("problem_add_forces", problem, push, 2, [8, 5], [0.4, 1.3, -0.2, -0.7], 0)
    solver = host("solver_create", problem, 1.0, Out())
    n, entries = host("solver_condensed_size", solver, Out(), Out())
    rows, patterns = 6, 3
    s, load, constant, starts, cols, values, offset = host(
        "solver_condensed", solver, n * n, Out(n * n), Out(patterns * n), Out(9), Out(rows + 1), Out(entries),
        Out(entries), Out(rows * patterns))
    jumps = [[0.0] * n for _ in range(rows)]
    for r in range(rows):
        for e in range(starts[r], starts[r + 1]):
            jumps[r][cols[e]] += values[e]
    weights = host("mesh_interface_pairs", mesh, 0, None, None, Out(3), None)[2]
    spring = [w * k for w in weights for k in springs]
    see.equal("entries", entries, starts[-1])
    moved = [forms.dot(offset[3 * r:3 * r + 3], theta) for r in range(rows)]
    full = [[s[n * i + j] + sum(spring[r] * jumps[r][i] * jumps[r][j] for r in range(rows)) for j in range(n)]
            for i in range(n)]
    right = [sum(theta[p] * load[n * p + i] for p in range(patterns)) -
             sum(spring[r] * jumps[r][i] * moved[r] for r in range(rows)) for i in range(n)]
    x = forms.solve(full, right)
    found = [forms.dot(jumps[r], x) + moved[r] for r in range(rows)]
    see.near("jump", field(host, solver, "jump"), found, "L", rel=1e-8)
    see.that("the interface is open", all(u > 0 for u in found[::2]))
    conjugate = [-forms.dot(load[n * p:n * p + n], x) + forms.dot(constant[3 * p:3 * p + 3], theta) +
                 sum(offset[3 * r + p] * spring[r] * found[r] for r in range(rows)) for p in range(patterns)]
    see.near("reactions", [value(host, solver, f"reaction:{name}") for name in ("up", "across", "push")], conjugate,
             "F L", rel=1e-8)
    energy = sum(value(host, solver, key) for key in ("stored_bulk", "load_potential"))
    own = 0.5 * sum(x[i] * s[n * i + j] * x[j] for i in range(n) for j in range(n)) + \
        0.5 * sum(theta[p] * constant[3 * p + q] * theta[q] for p in range(3) for q in range(3)) - \
        sum(theta[p] * forms.dot(load[n * p:n * p + n], x) for p in range(patterns))
    see.near("energy of the bodies and forces", energy, own, "F L", rel=1e-8)
    see.near("constant is symmetric", constant, [constant[3 * (k % 3) + k // 3] for k in range(9)], "F L", rel=1e-8)


@row("crack fronts in the plane", tells=["solver_front starts", "solver_front closed", "solver_front places",
                                         "solver_front directions", "solver_front lengths", "solver_front rates",
                                         "solver_front zone_lengths", "solver_front zone_pairs",
                                         "solver_front_count fronts", "solver_front_count points"])
def fronts(host, see):
    """Two notches of different length on a rigid interface that opens wider to the right."""
    columns, springs = 8, (200.0, 50.0)
    adhesion = [0.0, 0.0, 0.3, 0.8, 1.0, 1.0, 1.0, 0.6, 0.0]
    law = scenes.bilinear(host, springs, (0.3, 0.5), (1.2, 3.0))
    _, problem = stack(host, 2, columns, [law], adhesion=[(0, [0, 1, 8], [0.0] * 3)])
    load = scenes.ramp(host, problem)
    rigid(host, problem, 0, [([1.0, 0.0], []), ([0.0, 1.0], [])], columns)
    upper = nodes_of(1, columns)
    scenes.drive(host, problem, upper, [1.0, 0.0], load, [0.03] * len(upper))
    opening = [0.05 + 0.002 * i for i in range(columns + 1)]
    scenes.drive(host, problem, upper, [0.0, 1.0], load, opening * 2)
    solver = host("solver_create", problem, 0.0, Out())
    host("solver_equilibrate", solver, 1.0, adhesion)
    count, points = host("solver_front_count", solver, 0, Out(), Out())
    see.equal("fronts and points", [count, points], [2, 2])
    starts, closed, places, directions, lengths, rates, zones, pairs = host(
        "solver_front", solver, 0, 2, 2, Out(3), Out(2), Out(4), Out(4), Out(2), Out(6), Out(2), Out(2))
    see.equal("starts", starts, [0, 1, 2])
    see.equal("closed", closed, [0, 0])
    see.near("places", places, [2 + 0.7 + 0.2, 1.0, 7 - 0.4, 1.0], "L")
    see.near("directions", directions, [1.0, 0.0, -1.0, 0.0])
    see.near("lengths", lengths, [2.9, 1.4], "L")
    wanted = []
    for side in (range(1, 4), range(7, 4, -1)):
        step = 1 if side[0] == 1 else -1
        links = [(i, i + step) if step > 0 else (i + 1, i) for i in side]
        wanted.append([sum(0.5 * springs[0] * (adhesion[b] - adhesion[a]) * opening[a] * opening[b] for a, b in links),
                       0.5 * springs[1] * 0.03 ** 2, 0.0])
    see.near("rates", rates, wanted, "F/L")
    see.near("zone lengths", zones, [2.0, 1.0], "L")
    see.near("pairs of the zones", pairs, [2.0, 1.0])
    see.near("crack_length", value(host, solver, "crack_length"), 2.0 + 0.7 + 0.2 + 1.0 + 0.4, "L")

    def spent(pair):
        if adhesion[pair] in (0.0, 1.0):
            return 1.0 - adhesion[pair]
        energies = [0.5 * k * u * u for k, u in zip(springs, (opening[pair], 0.03))]
        mixity = energies[1] / sum(energies)
        onset, total = (forms.toughness(*pure, mixity) for pure in ((0.3, 0.5), (1.2, 3.0)))
        return forms.bilinear_dissipated(onset, total, adhesion[pair]) / total

    def behind(shares):
        return sum(1.0 if min(s, t) > 4 / 9 else max(max(s, t) - 4 / 9, 0.0) / abs(s - t) if s != t else 0.0
                   for s, t in zip(shares, shares[1:]))

    grown = behind([spent(p) for p in range(columns + 1)]) - behind([float(a == 0.0) for a in
                                                                    (0.0, 0.0, 1, 1, 1, 1, 1, 1, 0.0)])
    see.near("crack_area", value(host, solver, "crack_area"), 3.0 + grown, "L")
    see.near("process_zone_length_mean", value(host, solver, "process_zone_length_mean"), 1.5, "L")
    see.near("process_zone_pairs_mean", value(host, solver, "process_zone_pairs_mean"), 1.5)


@row("crack fronts in space", tells=["solver_front starts", "solver_front closed", "solver_front places",
                                     "solver_front directions", "solver_front lengths", "solver_front rates"])
def fronts_in_space(host, see):
    """A straight front that crosses the interface, and a loop about one open pair; a rigid body that moves in x, y and
    z gives the three modes."""
    n, springs, jump = 6, (200.0, 50.0), [0.03, 0.05, 0.07]
    mesh = host("mesh_create_layers", host.context, 3, [6.0, 6.0], [n, n], 2, [1.0, 1.0], [1, 1], TYPES["hex8"], Out())
    host("mesh_add_interface", mesh, 0, 1, 0.0, Out())
    count = (n + 1) ** 2
    points = host("mesh_nodes", mesh, 12 * count, Out(12 * count))
    nodes_b = host("mesh_interface_pairs", mesh, 0, None, Out(count), None, None)[1]
    place = {(round(points[3 * b]), round(points[3 * b + 1])): p for p, b in enumerate(nodes_b)}
    problem = host("problem_create", host.context, mesh, Out())
    host("problem_set_elastic", problem, -1, 1e3, 0.25)
    host("problem_set_law", problem, 0, scenes.bilinear(host, springs, (0.3, 0.5), (1.2, 3.0)))
    load = scenes.ramp(host, problem)
    scenes.fill(host, problem, list(range(4 * count)), lambda node: jump if node >= 2 * count else [0.0] * 3, load)
    adhesion = [1.0] * count
    for (x, y), p in place.items():
        if x == 0 or (x, y) == (4, 3):
            adhesion[p] = 0.0
    open_pairs = [p for p in range(count) if adhesion[p] == 0.0]
    host("problem_set_adhesion", problem, 0, len(open_pairs), open_pairs, [0.0] * len(open_pairs), 0)
    solver = host("solver_create", problem, 1.0, Out())
    found, number = host("solver_front_count", solver, 0, Out(), Out())
    starts, closed, places, directions, lengths, rates, zones, pairs = host(
        "solver_front", solver, 0, found, number, Out(found + 1), Out(found), Out(3 * number), Out(3 * number),
        Out(number), Out(3 * number), Out(number), Out(number))
    see.equal("starts", starts, [0, n + 1, n + 5])
    see.equal("closed", closed, [0, 1])
    ys = [places[3 * k + 1] for k in range(n + 1)]
    see.near("places of the straight front", places[:3 * n + 3], [[0.5, y, 1.0] for y in sorted(ys, reverse=ys[0] > 1)],
             "L")
    see.near("directions of the straight front", directions[:3 * n + 3], [[1.0, 0.0, 0.0]] * (n + 1))
    see.near("lengths of the straight front", lengths[:n + 1], [0.5] + [1.0] * (n - 1) + [0.5], "L")
    see.near("rates of the straight front", rates[:3 * n + 3],
             [[0.5 * springs[0] * jump[2] ** 2, 0.5 * springs[1] * jump[0] ** 2, 0.5 * springs[1] * jump[1] ** 2]] *
             (n + 1), "F/L")
    around = sorted(tuple(round(c, 9) for c in places[3 * k:3 * k + 3]) for k in range(n + 1, n + 5))
    see.near("places of the loop", around, [[3.5, 3.0, 1.0], [4.0, 2.5, 1.0], [4.0, 3.5, 1.0], [4.5, 3.0, 1.0]], "L")
    see.near("directions of the loop", directions[3 * n + 3:],
             [[2 * (a - b) for a, b in zip(places[3 * k:3 * k + 3], (4.0, 3.0, 1.0))] for k in range(n + 1, n + 5)])
    see.near("lengths of the loop", lengths[n + 1:], [math.sqrt(0.5)] * 4, "L")
    # A rigid body releases as much all around.
    see.near("opening rates of the loop", rates[3 * n + 3::3], [0.5 * springs[0] * jump[2] ** 2] * 4, "F/L")
    see.recorded("fronts", places + directions + lengths + rates + zones + pairs, "mixed")


@row("record", tells=["solver_recorded values", "solver_recorded_size first", "solver_recorded_size steps"])
def record(host, see):
    bar = scenes.Bar(host, scenes.strong(host, 10.0, 1.0), bulk=10.0)
    bar.step(0.1)
    host("solver_record", bar.solver, "reaction:pull")
    bar.step(0.3)
    host("solver_record", bar.solver, "time")
    bar.step(0.7)
    see.equal("first and steps", host("solver_recorded_size", bar.solver, Out(), Out()), [1, 3])
    see.near("reaction:pull", host("solver_recorded", bar.solver, "reaction:pull", 3, Out(3)), [0.5, 1.5, 3.5], "F L")
    times = host("solver_recorded", bar.solver, "time", 3, Out(3))
    see.that("time: not a number before it was asked for", times[0] != times[0])
    see.near("time", times[1:], [0.3, 0.7], "t")


@row("saved state", tells=["solver_save bytes", "solver_load bytes", "solver_save needed"])
def saved(host, see):
    """A state as bytes: loaded into another solver of the same scene it goes on as the first one does."""
    law = scenes.bilinear(host, (10.0, 10.0), (0.05, 0.05), (0.6, 0.6))
    one, other = scenes.Bar(host, law, bulk=10.0), scenes.Bar(host, law, bulk=10.0)
    one.step(0.5)
    size = host("solver_save", one.solver, 0, None, Out())[1]
    data, needed = host("solver_save", one.solver, size, Out(size), Out())
    see.equal("needed", needed - size, 0)
    see.equal("bytes that are written with capacity 0", host("solver_save", one.solver, 0, Out(8), Out())[0], [0] * 8)
    host("solver_load", other.solver, size, data)
    for bar in (one, other):
        bar.step(0.6)
    see.near("reaction:pull", other.value("reaction:pull"), one.value("reaction:pull"), "F L")
    see.near("dissipated", other.value("dissipated"), one.value("dissipated"), "F L")
    see.that("something is dissipated", one.value("dissipated") > 0)


@row("single numbers of a solver", tells=["solver_value value", "solver_value_count count", "solver_field_shape rows",
                                          "solver_field_shape columns", "solver_plan_count count",
                                          "solver_plan_item cost", "solver_plan_item saving",
                                          "solver_value_info recorded"])
def numbers(host, see):
    bar = scenes.Bar(host, scenes.strong(host, 10.0, 1.0), bulk=10.0)
    bar.step(0.3)
    see.near("load:pull", bar.value("load:pull"), 0.3)
    see.equal("shapes", [host("solver_field_shape", bar.solver, key, -1, Out(), Out())
                         for key in ("displacement", "stress", "jump", "reaction")], [8, 2, 2, 4, 2, 2, 14, 1])
    count = host("solver_value_count", bar.solver, Out())
    names = [host("solver_value_name", bar.solver, k) for k in range(count)]
    see.that("delam_solver_value_count counts the names", None not in names and "reaction:pull" in names)
    flags = {name: host("solver_value_info", bar.solver, k, *[None] * 5, Out())[5] for k, name in enumerate(names)}
    see.equal("recorded: time, kkt_gap, bulk_factorisations",
              [flags[key] for key in ("time", "kkt_gap", "bulk_factorisations")], [1, 0, 0])
    items = [host("solver_plan_item", bar.solver, k, Out(), Out(), None, Out(), Out(), Out())
             for k in range(host("solver_plan_count", bar.solver, Out()))]
    see.that("what is left out costs nothing", all(cost == 0 for _, decision, _, cost, _, _ in items
                                                   if decision == "left out"))
    see.that("without a unit there is neither cost nor saving",
             all(cost == saving == 0 for *_, cost, saving, unit in items if unit == "-"))
    see.that("what is left out saves something", any(saving > 0 for _, decision, _, _, saving, _ in items
                                                     if decision == "left out"))


@row("free bodies", says=["solver_field_shape: -1: they are held"])
def free_bodies(host, see):
    """A block that another one carries, and that a support at a corner lets slide and turn: nothing holds these."""
    mesh = host("mesh_create", host.context, 2, 8, [0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 1.0,
                                                    0.0, 1.0, 1.0, 1.0, 1.0, 2.0, 0.0, 2.0], Out())
    host("mesh_add_cells", mesh, TYPES["quad4"], 2, list(range(8)), [0, 1], 0)
    host("mesh_add_interface", mesh, 0, 1, 0.0, Out())
    problem = host("problem_create", host.context, mesh, Out())
    host("problem_set_elastic", problem, -1, 10.0, 0.0)
    host("problem_set_contact", problem, 0)
    slide = scenes.ramp(host, problem)
    scenes.hold(host, problem, [0, 1, 2, 3], [[0.0, 1.0]])
    scenes.drive(host, problem, [0, 1, 2, 3], [1.0, 0.0], slide, [0.1] * 4)
    scenes.hold(host, problem, [7], [[0.0, 1.0]])
    solver = host("solver_create", problem, 0.0, Out())
    host("solver_advance", solver, 1.0)
    host("solver_commit", solver)
    see.equal("free_bodies", value(host, solver, "free_bodies"), 1)
    see.equal("free_since", field(host, solver, "free_since"), [[-1], [0]])
    see.equal("free_motion", field(host, solver, "free_motion"), [[0, 0, 0], [1, 0, 1]])
    moved = [abs(c) for u in field(host, solver, "displacement")[4:] for c in u]
    see.that(f"the carried block stays: {max(moved)}", max(moved) < 1e-14)


@row("a plan beforehand", tells=["problem_plan setup", "problem_plan memory", "problem_value_count count"])
def plan_beforehand(host, see):
    """What the solver says once it exists."""
    bar = scenes.Bar(host, scenes.strong(host, 10.0, 1.0), bulk=10.0)
    _, setup, memory = host("problem_plan", bar.problem, Out(), Out(), Out())
    items = {item[0]: item for item in (host("solver_plan_item", bar.solver, k, Out(), Out(), None, Out(), Out(), Out())
                                        for k in range(host("solver_plan_count", bar.solver, Out())))}
    see.that("memory is the item of the plan, in bytes", 100.0 < memory == items["memory"][3] < 1e6)
    see.that("the longest factorisation is part of the set-up, and the set-up of the analysis",
             0 < items["longest uninterruptible factorisation"][3] <= setup < items["condensed operator"][3] / 20e9)
    # Their number grows with every new key.
    see.that("as many values as the solver has",
             host("problem_value_count", bar.problem, Out()) == host("solver_value_count", bar.solver, Out()) > 0)


@row("selecting earlier steps", says=["solver_look: step -1 selects"])
def select(host, see):
    bar = scenes.Bar(host, scenes.strong(host, 10.0, 1.0), bulk=10.0, options=[("backtracking", "on")])
    bar.step(0.1)
    bar.step(0.4)
    bar.step(0.9, commit=False)
    shown = []
    for step in (1, 2, -1, 0):
        host("solver_look", bar.solver, step)
        shown.append(bar.value("time"))
    see.near("times of steps 1, 2, -1 and 0", shown, [0.1, 0.4, 0.9, 0.0], "t")
