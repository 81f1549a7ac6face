#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""handing.py RANKS [DIMENSION ...]

What the ranks of a host may hand over to libdelam-petsc: rows of the assembled stiffness (set_rows), cells of a mesh of
their own (set_cells), cells of rank 0's mesh by the host's own partition (take_cells). Each way gives the curve of the
library alone, in the plane and in space, and each rank its displacements (recover); with -delam_pc_type bddc in
PETSC_OPTIONS rows are refused. Wrong input, also on one rank alone, ends on all ranks with one status and message. What
the ranks have recovered stays until they recover something else or get other parts.

Without DIMENSION: 2 and 3. The ranks run this file, too, with the word `work`. Exits with 77 where mpirun or mpi4py is
missing.
"""
import importlib.util
import os
import shutil
import subprocess
import sys

from environment import ENVIRONMENT

SKIPPED = 77
NO_PARTITION = os.environ.get("DELAM_NO_PARTITION_LIBRARY", "")  # no_partition.c; nothing else here divides by Scotch
LIMIT = 900.0  # s, beside other programs
BDDC = "bddc" in os.environ.get("PETSC_OPTIONS", "")
TIMES = [0.4, 0.7, 1.0]
ALLOWED = 1e-7  # of a curve, relative; damage_tolerance is 1e-10


def start(count, dimensions):
    if shutil.which("mpirun") is None or importlib.util.find_spec("mpi4py") is None:
        print("mpirun or mpi4py is not there")
        return SKIPPED
    environment = dict(ENVIRONMENT, **({"LD_PRELOAD": NO_PARTITION} if NO_PARTITION else {}))
    try:
        return subprocess.run(["mpirun", "-n", count, sys.executable, "-m", "mpi4py", __file__, "work", *dimensions],
                              env=environment, timeout=LIMIT, check=False).returncode
    except subprocess.TimeoutExpired:
        print(f"still at work after {LIMIT:g} s")
        return 1


if __name__ == "__main__" and sys.argv[1] != "work":
    sys.exit(start(sys.argv[1], sys.argv[2:]))

import numpy as np
from mpi4py import MPI
from scipy import sparse

import delam
import delam.petsc

COMM = MPI.COMM_WORLD
failures = []


def expect(condition, what):
    """On all ranks, each with a condition of its own."""
    good = COMM.allreduce(bool(condition), MPI.LAND)
    if COMM.rank == 0:
        print(("ok    " if good else "FAIL  ") + what, flush=True)
        if not good:
            failures.append(what)


# ---- scenes: two arms that are pulled apart --------------------------------------------------------------------------

def bodies_of(dimension):
    """A mesh of two arms, what sets their materials, and the name of their cells."""
    if dimension == 2:
        mesh = delam.Mesh.layers(0.06, 20, [3e-3, 2e-3], [2, 2])
        return mesh, lambda problem: (problem.set_plane("plane-stress"), problem.set_elastic(75e9, 0.3, 0),
                                      problem.set_elastic(135e9, 0.25, 1)), "quad4"
    mesh = delam.Mesh.layers([0.03, 0.01], [10, 2], [1e-3, 1e-3], [1, 1], "hex8")

    def materials(problem):
        problem.set_orthotropic([135e9, 10e9, 10e9, 0.3, 0.3, 0.4, 5e9, 5e9, 3.5e9])
        problem.set_orientation(turned(30.0), body=0)
        problem.set_orientation(turned(-30.0), body=1)
    return mesh, materials, "hex8"


def turned(degrees):
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return [[c, s, 0.0], [-s, c, 0.0]]


def scene(dimension):
    mesh, materials, _ = bodies_of(dimension)
    glue = mesh.add_interface(0, 1)
    problem = delam.Problem(mesh)
    materials(problem)
    problem.set_law(glue, delam.Law("piecewise-linear", normal_stiffness=1e13, tangential_stiffness=1e13,
                                    normal_onset=20.0, tangential_onset=20.0, normal_toughness=250.0,
                                    tangential_toughness=500.0))
    problem.options["damage_tolerance"] = 1e-10
    problem.options.update(step_control="fixed", kinematics="linear")  # as they are with an engine
    length = mesh.nodes[:, 0].max()
    problem.set_adhesion(glue, glue.places[:, 0] < length / 3.0, 0.0)
    opening = problem.add_pattern("opening", [0.0, 1.0], [0.0, 1e-3 if dimension == 2 else 3e-3])
    ends = mesh.nodes[:, 0]
    for axis in "xyz"[:dimension]:
        problem.prescribe(np.flatnonzero(ends > length * (1.0 - 1e-9)), axis)
    top = mesh.nodes[:, -1].max()
    for at, way in ((0.0, "-"), (top, "")):
        edge = np.flatnonzero((ends == 0.0) & (np.abs(mesh.nodes[:, -1] - at) < 1e-9))
        problem.prescribe(edge, way + "xyz"[dimension - 1], {opening: 0.5})
    return problem


def at_end(problem, ranks=None):
    """The curve; with ranks they recover the last state, without them its displacements follow."""
    solver = delam.Solver(problem, not_converged="raise")
    history = solver.history(TIMES)
    curve = np.array([history[key] for key in ("reaction:opening", "dissipated", "debonded_length")])
    if ranks is None:
        return curve, solver.field("displacement")
    ranks.recover(solver)
    return curve


def stiffness(problem):
    """All of it, over the DOFs of the mesh."""
    mesh, d = problem.mesh, problem.mesh.dimension
    total = sparse.csr_matrix((d * mesh.node_count,) * 2)
    for body in range(2):
        dofs = (d * np.flatnonzero(mesh.node_bodies == body)[:, None] + np.arange(d)).ravel()
        one = problem.body_matrix(body)
        entries = sparse.csr_matrix((one.values, one.columns, one.row_starts)).tocoo()
        total = total + sparse.csr_matrix((entries.data, (dofs[entries.row], dofs[entries.col])), total.shape)
    return total.tocsr()


def own_rows(problem):
    """Nodes that lie all over the mesh, not in the order of their numbers."""
    d = problem.mesh.dimension
    owner = np.random.default_rng(7).integers(0, COMM.size, problem.mesh.node_count)
    nodes = np.flatnonzero(owner == COMM.rank)[::-1]
    dofs = (d * nodes[:, None] + np.arange(d)).ravel()
    return nodes, stiffness(problem)[dofs], problem.mesh.nodes[nodes]


def sections(mesh, count):
    """The rank of each cell: by its place along the beam."""
    cells = mesh.cells
    corners = cells.connectivity.reshape(len(cells.types), -1)
    middles = mesh.nodes[corners][:, :, 0].mean(axis=1)
    return np.minimum((middles / mesh.nodes[:, 0].max() * count).astype(np.int32), count - 1)


def own_cells(dimension, change=None):
    """A problem of this rank's cells alone, and the numbers of its nodes. Rank 0 has none if there are others."""
    mesh, materials, kind = bodies_of(dimension)
    others = COMM.size - 1
    mine = sections(mesh, max(others, 1)) == (COMM.rank - 1 if others else 0)
    if not mine.any():
        return None, None
    corners = mesh.cells.connectivity.reshape(len(mine), -1)[mine]
    nodes, local = np.unique(corners, return_inverse=True)
    own = delam.Mesh(np.vstack([mesh.nodes[nodes], np.full(dimension, 9.0)]))  # the last node has no cell
    own.add_cells(kind, local.reshape(corners.shape), mesh.cells.bodies[mine])
    if change == "interface":
        own.add_interface(0, 1)
    problem = delam.Problem(own)
    if change != "material":
        materials(problem)
    if change == "pattern":
        problem.add_pattern("heat", [0.0, 1.0], [0.0, 1.0])
    if change == "support":
        problem.prescribe([0], "x")
    return problem, np.append(nodes, 10**6 + COMM.rank)


# ---- the ways -------------------------------------------------------------------------------------------------------

def solved(ranks, problem, what, expected, may_fail=False):
    """expected: at_end of the library alone. may_fail: it may also say that it has not converged."""
    ranks.attach(problem)
    before = ranks.value("solves")
    try:
        found = ranks.run(lambda: at_end(problem, ranks))
    except delam.NotConverged as error:
        expect(may_fail, f"{what}: {error}")
        return
    right = ranks.value("solves") > before and (BDDC or ranks.value("factor_entries") > 0)
    curve, displacement = expected
    worst = 0.0
    if COMM.rank == 0:
        worst = (np.abs(found - curve).max(axis=1) / np.abs(curve).max(axis=1)).max()
        right = right and curve[2, -1] > curve[2, 0]
    expect(right and worst < ALLOWED, f"{what}: differs by {worst:.1e}")
    recovered(ranks, what, displacement)


def recovered(ranks, what, displacement):
    """Each node of the mesh belongs to one rank, and all that have it know its displacement."""
    nodes, owned = ranks.part_nodes()
    together = np.sort(np.concatenate(COMM.allgather(nodes[owned])))
    expect(np.array_equal(together, np.arange(len(displacement))), f"{what}: each node is owned once")
    values = ranks.part_field("displacement")
    inside = values.shape == (len(nodes), displacement.shape[1]) and np.isin(nodes, np.arange(len(displacement))).all()
    worst = np.abs(values - displacement[nodes]).max(initial=0.0) / np.abs(displacement).max() if inside else np.inf
    worst = COMM.allreduce(worst, MPI.MAX)
    expect(worst < ALLOWED, f"{what}: the displacements of the ranks differ by {worst:.1e}")


def ways(dimension):
    name = f"{dimension}D, {COMM.size} ranks" + (", BDDC" if BDDC else "")
    everything = scene(dimension)  # for the stiffness of rows
    problem = scene(dimension) if COMM.rank == 0 else None
    mesh = None if problem is None else problem.mesh
    expected = COMM.bcast(at_end(scene(dimension)) if COMM.rank == 0 else None)
    with delam.petsc.Ranks(COMM) as ranks:
        nodes, rows, places = own_rows(everything)
        ranks.set_rows(nodes, rows, places, dimension)
        if BDDC:
            ranks.attach(problem)
            refused(delam.ArgumentError, lambda: ranks.run(lambda: delam.Solver(problem)), f"{name}: rows",
                    "-delam_pc_type bddc", "set_rows")
        else:
            solved(ranks, problem, f"{name}: rows", expected)
        ranks.set_cells(*own_cells(dimension))
        solved(ranks, problem, f"{name}: own cells", expected)
        ranks.take_cells(mesh, problem, None if mesh is None else sections(mesh, ranks.size))
        solved(ranks, problem, f"{name}: cells by sections", expected)
        # Each body of its own ranks: the interface is a cut from end to end. With a tolerance of 1e-13 that is too much
        # for BDDC: in space, and in the plane on two ranks in the last step (src/petsc/NOTES.md).
        half = max(ranks.size // 2, 1)
        cut = None if mesh is None else sections(mesh, half) + half * (mesh.cells.bodies % max(ranks.size // half, 1))
        ranks.take_cells(mesh, problem, cut)
        solved(ranks, problem, f"{name}: cells cut along the interface", expected,
               may_fail=BDDC and COMM.size > 1)


def kept():
    """The fields that the ranks have recovered belong to that state, until the next recovery or other parts."""
    problem = scene(2) if COMM.rank == 0 else None
    mesh = None if problem is None else problem.mesh
    with delam.petsc.Ranks(COMM) as ranks:
        def hand_over():
            ranks.take_cells(mesh, problem, None if mesh is None else sections(mesh, ranks.size))

        def analyse(time):
            solver.advance(time)
            solver.commit()
        hand_over()
        ranks.attach(problem)
        solver = ranks.run(lambda: delam.Solver(problem))
        ranks.run(lambda: (analyse(TIMES[0]), ranks.recover(solver)))
        first = ranks.part_field("displacement")
        ranks.run(lambda: analyse(TIMES[1]))
        expect(np.array_equal(ranks.part_field("displacement"), first), "a step changes nothing that was recovered")
        ranks.run(lambda: ranks.recover(solver))
        expect(not np.array_equal(ranks.part_field("displacement"), first), "the next recovery is of the next state")
        hand_over()
        refused(delam.StateError, lambda: ranks.part_field("displacement"), "a field after other parts", "recovered")


# ---- wrong input ----------------------------------------------------------------------------------------------------

def refused(kind, call, what, *words):
    """The same error on all ranks, with these words."""
    try:
        call()
        said = "no error"
    except delam.DelamError as error:
        said = f"{type(error).__name__}: {error}"
    all_said = COMM.allgather(said)
    good = len(set(all_said)) == 1 and said.startswith(kind.__name__ + ":") and all(word in said for word in words)
    expect(good, f"{what} is refused: {said if good else all_said}")


def wrong_rows(ranks):
    problem = scene(2)
    nodes, rows, _ = own_rows(problem)
    last = COMM.rank == COMM.size - 1
    count, most = COMM.size, problem.mesh.node_count

    def change(what, words, replaced=None, row=None, column=None, value=0.0):
        """On the last rank alone: other nodes, or another entry."""
        own, matrix = nodes, rows
        if last and replaced is not None:
            own = replaced(nodes)
        if last and row is not None:
            matrix = rows.tolil()
            matrix.resize((matrix.shape[0], max(matrix.shape[1], column + 1)))
            matrix[row, column] = value
            matrix = matrix.tocsr()
        refused(delam.ArgumentError, lambda: ranks.set_rows(own, matrix, None, 2), what, *words)

    def name(dof):
        return f"component {dof % 2} of node {dof // 2}"

    # DOFs of the last rank's first row, and of a neighbour of its own and of another rank.
    whole = stiffness(problem)
    dof = COMM.bcast(2 * int(nodes[0]), count - 1)
    near = whole[dof].indices[(whole[dof].indices != dof) & (np.abs(whole[dof].data) > 1e9)]
    own = np.isin(near // 2, COMM.bcast(nodes, count - 1))
    other = {True: max(near[own], default=None), False: max(near[~own], default=None)}
    change("a node twice on one rank", ["twice"], lambda n: np.append(n[:-1], n[0]))
    change("a negative node", ["-3"], lambda n: np.append(n[:-1], -3))
    change("a column of nobody", [f"component 1 of node {most + 7}", name(dof), "no rank"], None, 0, 2 * most + 15, 1e6)
    change("a diagonal of 0", [name(dof), "diagonal"], None, 0, dof)
    for here, neighbour in other.items():
        if neighbour is not None:
            words = [f"row {dof}", f"column {neighbour}", "12345", f"{whole[dof, neighbour]:.6g}"]
            change(f"an entry that differs from its mirror image on {'this' if here else 'another'} rank", words, None,
                   0, int(neighbour), 12345.0)
            change("an entry that is missing", [f"{whole[dof, neighbour]:.6g}"], None, 0, int(neighbour), 0.0)
    if count > 1:
        taken = int(COMM.bcast(nodes[0], 0))
        change("a node on two ranks", [f"node {taken} ", "rank 0", f"rank {count - 1}"],
               lambda n: np.append(n[:-1], taken))
        refused(delam.ArgumentError, lambda: ranks.set_rows(*((nodes, rows, None, 2) if not last else
                                                             ([], sparse.csr_matrix((0, 3)), None, 3))),
                "another dimension on one rank", "dimension")
    negative = rows.copy()
    if last:
        negative.indices[0] = -1
        negative.has_sorted_indices = False
    refused(delam.ArgumentError, lambda: ranks.set_rows(nodes, negative, None, 2), "a negative column", "-1")
    infinite = rows.copy()
    if last:
        infinite.data[0] = np.inf
    refused(delam.ArgumentError, lambda: ranks.set_rows(nodes, infinite, None, 2), "an infinite value", "inf")


def wrong_cells(ranks):
    last = COMM.rank == COMM.size - 1
    right = own_cells(2)
    for change, kind, words in (("interface", delam.ProblemError, ("1 interfaces",)),
                                ("pattern", delam.ProblemError, ("1 load patterns",)),
                                ("support", delam.ProblemError, ("1 constraints",)),
                                ("material", delam.ProblemError, (f"rank {COMM.size - 1}", "material"))):
        given = own_cells(2, change) if last else right
        refused(kind, lambda given=given: ranks.set_cells(*given), f"set_cells: {change}", *words)

    def numbers(what, change, *words):
        problem, nodes = right
        given = (problem, change(nodes)) if last else right
        refused(delam.ArgumentError, lambda: ranks.set_cells(*given), f"set_cells: {what}", *words)

    numbers("too few numbers", lambda n: n[:-1], "node_count", f"rank {COMM.size - 1}")
    numbers("a number twice", lambda n: np.append(n[:-1], n[0]), "twice")
    numbers("a negative number", lambda n: np.append(n[:-1], -1), "-1")
    refused(delam.ArgumentError, lambda: ranks.set_cells(None), "set_cells: cells on no rank", "all ranks")
    host = delam.Mesh(np.eye(2))
    host.add_host_body(4, [0, 1])
    given = (delam.Problem(host), [0, 1]) if last else right
    refused(delam.ProblemError, lambda: ranks.set_cells(*given), "set_cells: a body without cells", "body 4")


def wrong_scene(ranks):
    problem = scene(2) if COMM.rank == 0 else None
    mesh = None if problem is None else problem.mesh
    cells = 80
    for what, given, words in (("a rank too many", np.arange(cells) % (COMM.size + 1), (f" {COMM.size} of cell",)),
                               ("a negative rank", -np.arange(cells), ("-1 of cell 1",)),
                               ("too few cells", np.zeros(cells - 1, int), (str(cells - 1), str(cells)))):
        refused(delam.ArgumentError, lambda given=given: ranks.take_cells(mesh, problem, given), f"take_cells: {what}",
                *words)
    if NO_PARTITION and COMM.size > 1:
        refused(delam.NumericalError, lambda: ranks.take_scene(mesh, problem), "take_scene: a partitioner that fails",
                "PETSc", "Scotch")
    # Rank 0's mesh has a body whose stiffness is the host's.
    host, mesh = None, None
    if COMM.rank == 0:
        mesh = delam.Mesh([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.0, 2.0], [1.0, 2.0]])
        mesh.add_cells("quad4", [[0, 1, 2, 3]], 3)
        mesh.add_host_body(8, [4, 5])
        host = delam.Problem(mesh)
        host.set_elastic(1e9, 0.3, 3)
    refused(delam.ProblemError, lambda: ranks.take_scene(mesh, host), "take_scene: a body without cells", "body 8",
            "Ranks.set_part")


def wrong():
    with delam.petsc.Ranks(COMM) as ranks:
        wrong_rows(ranks)
        wrong_cells(ranks)
        wrong_scene(ranks)
        refused(delam.NumericalError, lambda: after_errors(ranks), "an engine without parts", "no parts")


def after_errors(ranks):
    problem = scene(2) if COMM.rank == 0 else None
    ranks.attach(problem)
    ranks.run(lambda: delam.Solver(problem))


def main():
    for dimension in map(int, sys.argv[2:] or (2, 3)):
        ways(dimension)
    kept()
    if not BDDC:
        wrong()
    failed = COMM.bcast(len(failures))
    if failed and COMM.rank == 0:
        print(f"{failed} failed:", *failures, sep="\n  ")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
