# SPDX-License-Identifier: BSD-3-Clause
"""The defaults of contact, of the reduction to the interfaces, of FETI and of threads."""
import ctypes
import os

import scenes
from host import Out, Refused
from rows_options import observe
from scenes import TYPES, value
from table import row

FETI = ("reduction", "feti")


@row("contact", options=["contact"])
def contact(host, see):
    """A pair that prescribed displacements press together, beside a part that a force lifts off its support. With
    contact = always the first displacement step already refuses the pressed pair; by default it is not tested before
    the lifted part has no equilibrium."""
    def run(options):
        lower, upper = [(0, 0), (1, 0), (1, 1), (0, 1)], [(0, 1), (1, 1), (1, 2), (0, 2)]
        points = lower + upper + [(x + 5, y) for x, y in lower + upper]
        mesh = host("mesh_create", host.context, 2, 16, [float(c) for p in points for c in p], Out())
        host("mesh_add_cells", mesh, TYPES["quad4"], 4, list(range(16)), [0, 1, 2, 3], 0)
        host("mesh_add_interface", mesh, 0, 1, 0.0, Out())
        host("mesh_add_interface", mesh, 2, 3, 0.0, Out())
        problem = host("problem_create", host.context, mesh, Out())
        host("problem_set_elastic", problem, -1, 10.0, 0.0)
        for interface in (0, 1):
            host("problem_set_contact", problem, interface)
        press, lift = (scenes.ramp(host, problem, name) for name in ("press", "lift"))
        scenes.hold(host, problem, list(range(4)) + list(range(8, 12)), [[1.0, 0.0], [0.0, 1.0]])
        scenes.hold(host, problem, list(range(4, 8)) + [12, 13, 14, 15], [[1.0, 0.0]])
        scenes.drive(host, problem, list(range(4, 8)), [0.0, 1.0], press, [-0.1] * 4)
        host("problem_add_forces", problem, lift, 2, [14, 15], [0.0, 1.0, 0.0, 1.0], 0)
        for key, setting in options:
            scenes.give(host, problem, key, setting)
        solver = host("solver_create", problem, 0.0, Out())
        return [host.status("solver_advance", solver, 1.0)]

    observe(see, "contact", run, ["always"], [3])


# A string on a rigid obstacle, pressed down everywhere and lifted at one end. A node comes off once its neighbour has:
# K u - f >= 0, u >= 0 with K = tridiag(-1, 2, -1), 1 at the lifted end.
STRING, LIFT = 300, 1.0
PRESS = -LIFT / 240


def active_sets(limit):
    """Number of sets that are solved, all closed at first, while all violators move at once; no set comes back."""
    force, free, count = [LIFT] + [PRESS] * (STRING - 1), 0, 0
    while True:
        # The first `free` nodes are free, and the next one is held: u rises towards the end by Thomas' algorithm.
        slope, right = [], []
        for i in range(free):
            pivot = (1.0 if i == 0 else 2.0) + (slope[-1] if i > 0 else 0.0)
            right.append((force[i] + (right[-1] if i > 0 else 0.0)) / pivot)
            slope.append(-1.0 / pivot)
        u = [0.0] * free
        for i in reversed(range(free)):
            u[i] = right[i] - slope[i] * (u[i + 1] if i + 1 < free else 0.0)
        count += 1
        assert min(u, default=1.0) > 0.0
        pulled = force[free] + (u[-1] if free > 0 else 0.0)
        if pulled <= 1e-10 or count == limit:
            return count
        free += 1


@row("contact_limit", options=["contact_limit"])
def contact_limit(host, see):
    """A string that comes off its obstacles node by node, one in each active set: it ends after 200. (The first set of
    an interface of 32 pairs or more would begin with some of them.)"""
    n, own = STRING, 30

    def run(options):
        points = [float(c) for k in range(n + n // own) for c in (k, k * k % 7)]
        mesh = host("mesh_create", host.context, 2, n + n // own, points, Out())
        host("mesh_add_host_body", mesh, 0, n, list(range(n)), 0)
        for k in range(n // own):
            host("mesh_add_obstacle", mesh, own, list(range(own * k, own * (k + 1))), [0.0, 1.0] * own, [1.0] * own,
                 n + k, 0, Out())
        problem = host("problem_create", host.context, mesh, Out())
        for k in range(n // own):
            host("problem_set_contact", problem, k)
        starts, columns, values = [0], [], []
        for i in range(n):
            for component in range(2):
                for j in (i - 1, i, i + 1):
                    if not 0 <= j < n or (component == 0 and j != i):
                        continue
                    columns.append(2 * j + component)
                    values.append(1.0 if component == 0 or i == j == 0 else 2.0 if i == j else -1.0)
                starts.append(len(columns))
        host("problem_set_stiffness", problem, n, list(range(n)), None, starts, columns, values, 0, None, 0)
        push = scenes.ramp(host, problem)
        scenes.hold(host, problem, list(range(n, n + n // own)), [[1.0, 0.0], [0.0, 1.0]])
        host("problem_add_forces", problem, push, n, list(range(n)), [0.0, LIFT] + [0.0, PRESS] * (n - 1), 0)
        for key, setting in options:
            scenes.give(host, problem, key, setting)
        solver = host("solver_create", problem, 0.0, Out())
        return [host.status("solver_advance", solver, 1.0), int(value(host, solver, "contact_iterations_first"))]

    observe(see, "contact_limit", run, [199, 201], [1, 200])
    see.equal("contact_limit = 1000", run([("contact_limit", 1000)]), [0, active_sets(1000)])


class Block:
    """Two layers of cells with an elastic interface, held below and bent above."""

    def __init__(self, host, options, columns=6, rows=2, contrast=1.0, springs=1e3, bend=0.01, progress=None):
        self.host = host
        mesh = host("mesh_create_layers", host.context, 2, [float(columns)], [columns], 2, [float(rows)] * 2,
                    [rows] * 2, TYPES["quad4"], Out())
        host("mesh_add_interface", mesh, 0, 1, 0.0, Out())
        problem = host("problem_create", host.context, mesh, Out())
        host("problem_set_elastic", problem, 0, 1e3, 0.25)
        host("problem_set_elastic", problem, 1, 1e3 * contrast, 0.25)
        host("problem_set_formulation", problem, -1, "standard")  # the counts of iterations are theirs
        host("problem_set_law", problem, 0, scenes.strong(host, springs, springs))
        scenes.give(host, problem, "kinematics", "linear")  # it stretches by a tenth
        load = scenes.ramp(host, problem)
        last = 2 * (columns + 1) * (rows + 1)
        scenes.hold(host, problem, list(range(columns + 1)), [[1.0, 0.0], [0.0, 1.0]])
        scenes.drive(host, problem, list(range(last - columns - 1, last)), [0.0, 1.0], load,
                     [0.1 + bend * i * i for i in range(columns + 1)])
        for key, setting in options:
            scenes.give(host, problem, key, setting)
        self.solver = host("solver_create", problem, 0.0, Out())
        if progress is not None:
            host("context_set_progress", host.context, progress, None)
        self.status = host.status("solver_advance", self.solver, 1.0)

    def values(self, *keys):
        return [value(self.host, self.solver, key) for key in keys]


@row("reduction", options=["reduction"])
def reduction(host, see):
    """Whether there is a condensed operator: by default yes in a small scene, unless subdomains are asked for."""
    def run(options):
        return [host.status("solver_condensed_size", Block(host, [*more, *options], 3, 1).solver, Out(), Out())
                for more in ([], [("subdomains", 3)])]

    observe(see, "reduction", run, ["condensed", "feti"], [0, -5])


@row("subdomains", options=["subdomains"])
def subdomains(host, see):
    """One for each body of a small scene, counted by their factorisations."""
    def run(options):
        return [int(n) for n in Block(host, [FETI, *options]).values("bulk_factorisations")]

    observe(see, "subdomains", run, [3, 4], [2])


def see_iterations(see, key, run, others, most):
    """Counts of a Krylov method move by one or two with the rounding of another machine."""
    observe(see, key, run, others)
    see.that(f"at most {most} iterations, not {run([])[0]}", run([])[0] <= most)


@row("preconditioner", options=["preconditioner"])
def preconditioner(host, see):
    def run(options):
        return [int(n) for n in Block(host, [FETI, ("subdomains", 4), *options], 8).values("linear_iterations")]

    see_iterations(see, "preconditioner", run, ["none", "lumped", "dirichlet"], 27)


@row("scaling", options=["scaling"])
def scaling(host, see):
    """Subdomains of stiffness 1 and 100 that share nodes."""
    def run(options):
        return [int(n) for n in Block(host, [FETI, ("subdomains", 4), *options], 8,
                                      contrast=100.0).values("linear_iterations")]

    see_iterations(see, "scaling", run, ["multiplicity"], 28)


@row("gluing", options=["gluing"])
def gluing(host, see):
    """Nine subdomains, of which several meet in a node, without a preconditioner that would hide the multipliers."""
    def run(options):
        return [int(n) for n in Block(host, [FETI, ("subdomains", 9), ("preconditioner", "none"), *options], 6,
                                      3).values("linear_iterations")]

    see_iterations(see, "gluing", run, ["redundant"], 52)


@row("linear_tolerance", options=["linear_tolerance"])
def linear_tolerance(host, see):
    """The residuals at which FETI ends with eight interfaces: below the tolerance, and the iterations move with it."""
    def run(options):
        found = []
        for k in range(8):
            block = Block(host, [FETI, ("subdomains", 4), ("preconditioner", "lumped"), *options], 6, 1,
                          springs=300.0 * 2.0 ** k)
            found.append(block.values("linear_iterations", "linear_residual"))
        return found

    found = run([])
    see.that("no residual is above 1e-13", max(r for _, r in found) <= 1e-13)
    see.that("linear_tolerance left alone is linear_tolerance = 1e-13", found == run([("linear_tolerance", 1e-13)]))
    for other in (0.5e-13, 2e-13):
        see.differ(f"linear_tolerance left alone and linear_tolerance = {other}", [n for n, _ in found],
                   [n for n, _ in run([("linear_tolerance", other)])])


@row("threads", options=["threads"])
def threads(host, see):
    """The threads of the process while FETI works, less those before."""
    def run(options):
        most = [0]

        def count(stage, done, _total, _user):
            if stage == b"linear solve" and done == 1:
                most[0] = max(most[0], len(os.listdir("/proc/self/task")))
            return 0

        progress = ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_char_p, ctypes.c_int64, ctypes.c_int64,
                                    ctypes.c_void_p)(count)
        host.kept.append(progress)
        before = len(os.listdir("/proc/self/task"))
        Block(host, [FETI, ("subdomains", 4), *options], progress=progress)
        host("context_set_progress", host.context, None, None)
        return [most[0] - before]

    observe(see, "threads", run, [2] if len(os.sched_getaffinity(0)) > 1 else [], [0])


@row("memory_limit", options=["memory_limit"])
def memory_limit(host, see):
    """The status of a solver for which there are 107 bytes, and of one for which there is what the machine has."""
    def run(options):
        try:
            scenes.Bar(host, scenes.strong(host, 10.0, 1.0), bulk=10.0, options=options)
        except Refused as refused:
            return [refused.status]
        return [0]

    observe(see, "memory_limit", run, [1e-7], [0])


@row("linear_limit", options=["linear_limit"])
def linear_limit(host, see):
    """A solve that takes more iterations than it may does not converge; by default there is room. How much is told by
    hash_of_defaults alone: a solve of 2,000 iterations takes seconds."""
    def run(options):
        block = Block(host, [FETI, ("subdomains", 4), ("preconditioner", "none"), *options])
        return [block.status, *[int(n) for n in block.values("linear_iterations")]]

    found = run([])
    see.equal("status by default", found[:1], [0])
    see.that("linear_limit left alone is linear_limit = 2000", found == run([("linear_limit", 2000)]))
    see.equal("status with linear_limit = 10", run([("linear_limit", 10)])[:1], [1])
