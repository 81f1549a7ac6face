# SPDX-License-Identifier: BSD-3-Clause
"""Frictionless contact of random scenes against an independent quadratic program.

Blocks on a sheared and turned grid, in the plane or in space, meet at corners and edges. Some interfaces adhere
(springs), some are bonded, the others only touch: blocks slide on inclines, are wedged, pushed, or free. Each scene goes
through several loads. After each one

- the energy is that of a quadratic program over all displacements (CVXOPT), to 1e-8 (iterated 1e-6);
- the state meets its own conditions of contact and equilibrium, to 1e-10 (feti 1e-8, iterated 1e-6);
- free blocks lie where the least change of their places puts them, which a second program finds;
- a load that no state balances is told, and the program has no minimum.

A step that the library itself reports as not converged is no answer: the scene ends there and is counted apart.

    random_scenes.py [--scenes N] [--first SEED] [--reduction condensed,iterated,feti] [--hard] [--outcomes]

--hard runs scenes that rounding once decided, and allows no failure. --outcomes prints what the library finds, and
checks nothing: a line for each load, for verify/bench/constants.py.
"""
import argparse
import itertools
import logging
import sys

import numpy as np

try:
    import cvxopt
    import cvxopt.solvers
except ImportError:
    print("skipped: python3-cvxopt is not installed")
    sys.exit(77)

import delam

logging.disable(logging.WARNING)
cvxopt.solvers.options.update(show_progress=False, abstol=1e-14, reltol=1e-13, feastol=1e-13, maxiters=60)


def blocks_of(random, dimension):
    """Places of the blocks, in units of their edge; at least two."""
    shape = [int(random.integers(2, 4)) if k < 2 else 2 for k in range(dimension)]
    if dimension == 3:
        shape = [2, 2, 2]
    places = list(itertools.product(*(range(n) for n in shape)))
    keep = [place for place in places if random.random() < 0.8]
    return keep if len(keep) > 1 else places


def mesh_of(random, dimension, places):
    cells = int(random.integers(1, 4)) if dimension == 2 else 1
    axes = np.linspace(0.0, 1.0, cells + 1)
    shear = np.eye(dimension) + np.triu(random.uniform(-0.4, 0.4, (dimension, dimension)), 1)
    turn = np.linalg.qr(random.normal(size=(dimension, dimension)))[0]
    turn[:, 0] *= np.linalg.det(turn)
    if random.random() < 0.3:  # faces along the axes: many ties
        shear = turn = np.eye(dimension)
    nodes, connectivity, bodies = [], [], []
    for body, place in enumerate(places):
        first = len(nodes)
        grid = list(itertools.product(range(cells + 1), repeat=dimension))
        number = {at: first + i for i, at in enumerate(grid)}
        for at in grid:
            nodes.append(turn @ shear @ (np.array(place) + axes[list(at)]))
        for at in itertools.product(range(cells), repeat=dimension):
            corner = [(0, 0), (1, 0), (1, 1), (0, 1)]
            ring = corner if dimension == 2 else [c + (0,) for c in corner] + [c + (1,) for c in corner]
            connectivity.append([number[tuple(np.add(at, c))] for c in ring])
            bodies.append(body)
    mesh = delam.Mesh(np.array(nodes))
    mesh.add_cells("quad4" if dimension == 2 else "hex8", np.array(connectivity), np.array(bodies, np.int32))
    mesh.add_all_interfaces()
    return mesh, cells


class Scene:
    """A random scene, and its matrices over all displacements."""

    def __init__(self, seed, reduction):
        random = np.random.default_rng(seed)
        self.dimension = d = 2 if random.random() < 0.7 else 3
        places = blocks_of(random, d)
        count = len(places)
        mesh, cells = mesh_of(random, d, places)
        problem = delam.Problem(mesh, plane="plane-strain" if d == 2 else None)
        problem.options["kinematics"] = "linear"
        for body in range(count):
            problem.set_elastic(10.0 ** random.uniform(0, 2), random.uniform(0.1, 0.4), body)
        stiffness = [50.0] + [20.0] * (d - 1)
        law = delam.Law("piecewise-linear", normal_stiffness=50.0, tangential_stiffness=20.0, normal_onset=1e9,
                        tangential_onset=1e9, normal_toughness=2e9, tangential_toughness=2e9)
        size = mesh.node_count * d
        springs, self.gaps, equal = np.zeros((size, size)), np.zeros((0, size)), []
        for interface in mesh.interfaces:
            kind = random.choice(["contact", "law", "partly", "bonded"], p=[0.65, 0.1, 0.15, 0.1])
            pairs = interface.pair_count
            broken = np.full(pairs, kind == "contact") | ((kind == "partly") & (random.random(pairs) < 0.5))
            if kind == "bonded":
                problem.set_bonded(interface)
            elif kind == "contact":
                problem.set_contact(interface)
            else:
                problem.set_law(interface, law)
                if broken.any():
                    problem.set_adhesion(interface, np.flatnonzero(broken), 0.0)
            for p in range(pairs):
                rows = np.zeros((d, size))
                rows[:, interface.nodes_b[p] * d + np.arange(d)] += interface.frames[p]
                rows[:, interface.nodes_a[p] * d + np.arange(d)] -= interface.frames[p]
                if kind == "bonded":
                    equal.append(rows)
                    continue
                self.gaps = np.vstack([self.gaps, rows[:1]])
                for r in range(0 if broken[p] else d):
                    springs += interface.weights[p] * stiffness[r] * np.outer(rows[r], rows[r])
        self.times = np.arange(4.0)
        move = problem.add_pattern("move", self.times, 1e-2 * np.concatenate([[0.0], random.uniform(-1, 1, 3)]))
        bodies = mesh.node_bodies
        held, driven = random.choice(count, 2, replace=False)
        for axis in "xyz"[:d]:
            problem.prescribe(np.flatnonzero(bodies == held), axis)
        nodes = np.flatnonzero(bodies == driven)
        if random.random() < 0.5:
            nodes = np.sort(random.choice(nodes, max(1, nodes.size // 2), replace=False))
        way = random.normal(size=d)
        for axis in range(d) if random.random() < 0.7 else [0]:
            problem.prescribe(nodes, "xyz"[axis], {move: way[axis]})
        if random.random() < 0.4:
            push = problem.add_pattern("push", self.times, 1e-2 * np.concatenate([[0.0], random.uniform(-1, 1, 3)]))
            loaded = np.flatnonzero(bodies == random.integers(count))
            problem.add_forces(push, loaded, np.tile(random.normal(size=d), (loaded.size, 1)))
        problem.options["reduction"] = reduction
        problem.options["linear_tolerance"] = 1e-13

        stiff = np.zeros((size, size))
        for body in range(count):
            own = np.repeat(np.flatnonzero(bodies == body) * d, d) + np.tile(np.arange(d), (bodies == body).sum())
            stiff[np.ix_(own, own)] += problem.body_matrix(body).toarray()
        rows, self.right = problem.constraints()
        self.equal = np.vstack([rows.toarray(), *equal])
        self.whole = stiff + springs
        self.forces = np.array([problem.forces(p).ravel() for p in problem.patterns])
        # The parallelepipeds are all alike: the share of a node is that of the cells that have it.
        self.volume = np.repeat(np.array([self.share(bodies, node, cells, d) for node in range(mesh.node_count)]), d)
        self.problem = problem

    @staticmethod
    def share(bodies, node, cells, dimension):
        at = node - np.flatnonzero(bodies == bodies[node])[0]
        share = 1
        for _ in range(dimension):
            at, place = divmod(at, cells + 1)
            share *= 1 if place in (0, cells) else 2
        return share

    def force(self, theta):
        return theta @ self.forces


def null_space(a, part=1e-9):
    try:
        _, s, vt = np.linalg.svd(a)
    except np.linalg.LinAlgError:  # LAPACK's gesdd gives up on a few matrices, and not on their transposes
        v, s, _ = np.linalg.svd(a.T)
        vt = v.T
    rank = int((s > part * max(1e-300, s[0] if s.size else 0.0)).sum())
    return vt[rank:].T


class Program:
    """min 1/2 u^T K u - f^T u over A u = c, N u >= 0."""

    def __init__(self, scene):
        self.scene = scene
        self.z = null_space(scene.equal)
        self.p = self.z.T @ scene.whole @ self.z
        self.n = scene.gaps @ self.z
        moves = np.vstack([self.p / max(1.0, np.abs(self.p).max(initial=0.0)), self.n])
        self.still = null_space(moves)  # motions that neither strain nor touch anything
        self.moving = null_space(self.still.T) if self.still.shape[1] else np.eye(self.p.shape[0])

    def solve(self, theta):
        s = self.scene
        if self.p.shape[0] == 0:
            return None
        particular = np.linalg.lstsq(s.equal, np.concatenate(
            [s.right @ theta, np.zeros(s.equal.shape[0] - s.right.shape[0])]), rcond=1e-12)[0]
        force = s.force(theta)
        q = self.z.T @ (s.whole @ particular - force)
        if self.still.shape[1] and np.abs(self.still.T @ q).max() > 1e-9 * np.abs(q).max():
            return None
        p, n = self.moving.T @ self.p @ self.moving, self.n @ self.moving
        y = quadratic(p, self.moving.T @ q, -n, s.gaps @ particular, max(np.abs(particular).max(), 1e-6))
        if y is None:
            return None
        u = particular + self.z @ self.moving @ y
        return u if self.apart(u) else None

    def apart(self, u):
        """Whether faces do not penetrate each other; else CVXOPT's answer has not got all digits."""
        return (self.scene.gaps @ u).min(initial=0.0) >= -1e-11 * np.abs(u).max()

    def possible(self, theta):
        """Whether any displacements meet supports and bonds, and keep faces apart: min s, N u >= -s, s >= 0."""
        s = self.scene
        right = np.concatenate([s.right @ theta, np.zeros(s.equal.shape[0] - s.right.shape[0])])
        particular = np.linalg.lstsq(s.equal, right, rcond=1e-12)[0]
        size = max(np.abs(right).max(), 1e-300)
        if np.abs(s.equal @ particular - right).max() > 1e-9 * size:
            return False
        n = np.where(np.abs(self.n) > 1e-12, self.n, 0.0)
        below = np.hstack([-n, -np.ones((n.shape[0], 1))])
        deepest = np.append(np.zeros(n.shape[1]), 1.0)
        answer = linear(deepest, np.vstack([below, -deepest]), np.append(s.gaps @ particular / size, 0.0))
        return answer is not None and answer < 1e-6

    def runs_away(self, theta):
        """Whether a dead force moves a part that nothing ever stops: max f.d over K d = 0, N d >= 0, |d| <= 1."""
        rigid = self.z @ null_space(self.p)
        if rigid.shape[1] == 0:
            return False
        force = rigid.T @ self.scene.force(theta)
        size = np.abs(force).max()
        if not size > 1e-9 * np.abs(self.scene.force(theta)).max():
            return False
        n, unit = self.scene.gaps @ rigid, np.eye(rigid.shape[1])
        n = np.where(np.abs(n) > 1e-12, n, 0.0)  # CVXOPT takes rounding alone for a row
        g = np.vstack([-n, unit, -unit])
        h = np.concatenate([np.zeros(n.shape[0]), np.ones(2 * rigid.shape[1])])
        most = linear(-force / size, g, h)
        return most is not None and -most > 1e-6

    def energy(self, u, theta):
        return 0.5 * u @ self.scene.whole @ u - self.scene.force(theta) @ u

    def nearest(self, u, before, theta):
        """Of all states with the energy of u, the one nearest to the state before."""
        s = self.scene
        force = s.force(theta)
        rigid = self.z @ null_space(np.vstack([self.p, (force @ self.z)[None, :]]))
        if rigid.shape[1] == 0:
            return u
        weight = s.volume[:, None] * rigid
        length = max(np.abs(u).max(), np.abs(before).max())
        a = quadratic(rigid.T @ weight, weight.T @ (u - before), -s.gaps @ rigid, s.gaps @ u, length)
        return u if a is None or not self.apart(u + rigid @ a) else u + rigid @ a


def linear(c, g, h):
    """min c.x over G x <= h; None: there is no minimum. By GLPK: the cones here have no interior, which CVXOPT needs."""
    answer = cvxopt.solvers.lp(*(cvxopt.matrix(np.ascontiguousarray(a)) for a in (c, g, h)), solver="glpk",
                               options={"glpk": {"msg_lev": "GLP_MSG_OFF"}})
    return None if answer["x"] is None else answer["primal objective"]


room = 1e-7  # so that CVXOPT finds an interior where prescribed bodies leave a gap no choice


def quadratic(p, q, g, h, length):
    """min 1/2 y^T P y + q^T y over G y <= h, where y is of about this length; None: there is no minimum. CVXOPT finds the
    active rows, and the equations of these give all digits."""
    if p.shape[0] == 0:
        return np.zeros(0)
    matrix = lambda a: cvxopt.matrix(np.ascontiguousarray(a, dtype=float))
    size = max(np.abs(p).max(), 1e-300)
    q = np.where(np.abs(q) < 1e-14 * size * length, 0.0, q)
    try:
        answer = cvxopt.solvers.qp(matrix(p / size), matrix(q / size / length), matrix(g),
                                   matrix(h / length + room))
    except (ValueError, ArithmeticError):
        return None
    if answer["x"] is None or not np.isfinite(np.array(answer["x"])).all() or np.abs(answer["x"]).max() > 1e6:
        return None
    found = np.array(answer["x"]).ravel() * length
    active = np.array(answer["z"]).ravel() > np.array(answer["s"]).ravel()
    for _ in range(10):
        rows = g[active]
        zero = np.zeros((rows.shape[0],) * 2)
        system = np.block([[p / size, rows.T], [rows, zero]])
        right = np.concatenate([-q / size, h[active]])
        exact = np.linalg.lstsq(system, right, rcond=1e-13)[0]
        if np.abs(system @ exact - right).max() > 1e-9 * length:
            return None
        # Among the solutions, the one next to CVXOPT's.
        null = null_space(np.vstack([p / size, rows]))
        y = exact[:p.shape[0]]
        y = y + null @ (null.T @ (found - y))
        deep, pull = g @ y - h > 1e-12 * length, np.zeros_like(active)
        pull[active] = exact[p.shape[0]:] < -1e-9 * length
        if not deep.any() and not pull.any():
            return y
        active = (active | deep) & ~pull
    return None


def impossible(error):
    """Whether a refusal says that supports contradict contact or bonds."""
    return any(words in str(error) for words in ("press two faces", "press faces", "bonded permanently"))


not_converged = "not converged"  # an outcome: the library says that it has no answer


def check(seed, reduction):
    """What is wrong with a scene, a list of words, and its outcome. Where CVXOPT gives no answer, the scene's own
    conditions tell: those of a convex program are sufficient."""
    scene = Scene(seed, reduction)
    program = Program(scene)
    allowed, energies = {"condensed": (1e-10, 1e-8), "feti": (1e-8, 1e-8), "iterated": (1e-6, 1e-6)}[reduction]
    wrong, before = [], np.zeros(scene.whole.shape[0])
    try:
        solver = delam.Solver(scene.problem, not_converged="raise")
    except delam.NotConverged:
        return wrong, not_converged
    except delam.ProblemError as error:
        if "missing support" not in str(error) and not impossible(error):
            raise
        if impossible(error) and any(program.possible(scene.problem.factors(time)) for time in scene.times[1:]):
            wrong.append(f"refused at the start, but possible: {error}")
        return wrong, "refused"
    for time in scene.times[1:]:
        theta = scene.problem.factors(time)
        best = program.solve(theta)
        try:
            solver.advance(time)
        except delam.NotConverged:
            return wrong, not_converged
        except delam.LimitReached:
            if not program.runs_away(theta):
                wrong.append(f"time {time}: no equilibrium was found, but there is one")
            return wrong, "limit"
        except delam.ProblemError as error:
            if not impossible(error):
                raise
            if program.possible(theta):
                wrong.append(f"time {time}: refused, but possible: {error}")
            return wrong, "refused"

        def expect(holds, words):
            if not holds:
                wrong.append(f"time {time}: {words}")

        values = solver.values
        expect(values["contact_iterations_max"] < 200, f"{values['contact_iterations_max']:.0f} active-set steps")
        u = solver.field("displacement").ravel()
        length = max(np.abs(u).max(), np.abs(before).max())
        deep = (scene.gaps @ u).min(initial=0.0) / length
        expect(deep >= -min(allowed, 1e-8), f"penetration of {-deep:.1e} of the displacements")
        energy = values["stored_bulk"] + values["stored_interface"] + values["load_potential"]
        own = program.energy(u, theta)
        restrained = np.abs(scene.whole).max() * length ** 2
        strained = 0.5 * u @ scene.whole @ u + np.abs(scene.force(theta)) @ np.abs(u)
        tolerance = energies * strained + 1e-12 * restrained
        expect(abs(energy - own) <= tolerance, f"energy {energy:.10g}, that of its displacements {own:.10g}")
        if best is not None:
            least = program.energy(best, theta)
            expect(energy <= least + tolerance + 1e-12 * np.abs(scene.whole).max() * np.abs(best).max() ** 2, f"energy {energy:.10g}, but {least:.10g} is possible")
        # These values say nothing of jumps that are rounding.
        tell = ("kkt_gap", "kkt_complementarity") if np.abs(scene.gaps @ u).max(initial=0.0) > 1e-6 * length else ()
        for name in tell + ("kkt_pressure", "kkt_equilibrium"):
            expect(values[name] <= allowed, f"{name} {values[name]:.2e}")
        place = program.nearest(u, before, theta)
        far, near = (np.sqrt(scene.volume @ (at - before) ** 2) for at in (u, place))
        expect(far <= near + 1e-6 * length, f"free parts moved by {far:.6g}, but {near:.6g} would do")
        before = u
        solver.commit()
    return wrong, "free" if values["free_bodies"] else "held"


def outcomes(seed, reduction):
    """Yields what the library says of each load of a scene, as words and numbers."""
    scene = Scene(seed, reduction)
    solver = delam.Solver(scene.problem, not_converged="ignore")
    for time in scene.times[1:]:
        solver.advance(time)
        u = solver.field("displacement").ravel()
        size, values = np.abs(u).max(), solver.values
        yield f"energy {values['stored_bulk'] + values['stored_interface'] + values['load_potential']:.9g}"
        yield f"places {size:.9g} {u @ scene.volume / scene.volume.sum() / max(size, 1e-300):.9f}"
        solver.commit()


# Scenes that were wrong, by what rounding decided.
HARD = {
    # 7219, 9209, 9626: forces of bodies that resist a jump by next to nothing are rounding, and held parts that are free.
    # 7985: a contact that closes a ring of bodies did not give way to supports.
    "condensed": (7219, 7985, 9209, 9626),
    # 9438, 9813: dead forces that supports carry leave rounding in contact. 308, 9949: closed contacts first move a part
    # a thousand times as far as it then lies. 1960, 6463: the forces of stiff springs in place of contacts are a million
    # times too large to start from.
    "feti": (308, 1960, 6463, 9438, 9813, 9949),
}


def print_outcomes(seed, reduction):
    print(f"scene {seed}, {reduction}")
    try:
        for line in outcomes(seed, reduction):
            print(line)
    except delam.DelamError as error:
        print(type(error).__name__)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--scenes", type=int, default=100)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--reduction", default="condensed,iterated,feti")
    parser.add_argument("--outcomes", action="store_true")
    parser.add_argument("--hard", action="store_true")
    arguments = parser.parse_args()
    failures, kinds = 0, {}
    reductions = arguments.reduction.split(",")
    seeds = range(arguments.first, arguments.first + arguments.scenes)
    chosen = HARD if arguments.hard else dict.fromkeys(reductions, seeds)
    for seed, reduction in sorted((seed, reduction) for reduction in reductions for seed in chosen.get(reduction, ())):
        if arguments.outcomes:
            print_outcomes(seed, reduction)
            continue
        try:
            wrong, kind = check(seed, reduction)
        except delam.DelamError as error:
            wrong, kind = [f"{type(error).__name__}: {error}"], "error"
        kinds[kind] = kinds.get(kind, 0) + 1
        failures += bool(wrong)
        for words in wrong[:2] if wrong or kind != not_converged else [kind]:
            print(f"scene {seed}, {reduction}: {words}", flush=True)
    if arguments.outcomes:
        return 0
    if arguments.hard:
        print(f"hard scenes: {failures} failures;", ", ".join(f"{n} {k}" for k, n in sorted(kinds.items())))
        return 1 if failures or not_converged in kinds else 0
    print(f"{arguments.scenes} scenes, {failures} failures;", ", ".join(f"{n} {k}" for k, n in sorted(kinds.items())))
    seen = 4 * kinds.get("free", 0) >= arguments.scenes and kinds.get("limit", 0) > 0 and kinds.get("held", 0) > 0
    # Measured on seeds 5000 to 9999: 3 answers are wrong, by rounding. At a corner of 5505 (condensed, iterated) rows
    # nearly depend on each other, and their forces have two hundred times the rounding of others. In 6460 the forces
    # that FETI's tolerance leaves are 1.4 times what counts as rounding. Other processors round other scenes wrongly.
    right = failures <= arguments.scenes // 1000
    # There, 5 do not converge, all by FETI: seeds 5792, 6836, 7944, 8793, 9168.
    right = right and kinds.get(not_converged, 0) <= arguments.scenes // 400
    return 0 if right and (seen or arguments.scenes < 100) else 1


if __name__ == "__main__":
    sys.exit(main())
