# SPDX-License-Identifier: BSD-3-Clause
"""A host on many processes that assembles its own stiffness and lets libdelam delaminate it, from Python.

    mpirun -n 4 python3 -m mpi4py host_petsc.py [CELLS]     CELLS: number of cells along the beam, 30 if absent

The scene of host_petsc.c: each rank integrates the stiffness of a slab of the beam with numpy, libdelam on rank 0 knows
only the nodes at the interface, the support and the loads."""
import sys

import numpy as np
from mpi4py import MPI

import delam
import delam.petsc

LENGTH, WIDTH, HEIGHT, NOTCH = 45e-3, 9e-3, 1.5e-3, 15e-3  # m; height of an arm
YOUNG, POISSON = 60e9, 0.3  # Pa
ACROSS, UPWARDS, STEPS = 3, 2, 10  # cells across the width and over the height of an arm; load steps
CORNERS = np.array([(c & 1, c >> 1 & 1, c >> 2) for c in range(8)])  # of a cell, x first


class Grid:
    """Nodes (arm, i, j, k): arm 0 below, 1 above; i along the beam, j across it, k away from the interface."""

    def __init__(self, along):
        self.along = along
        # Where the numbers of the groups begin: nodes of the interface, held ones, loaded ones, all others.
        self.held = 2 * (along + 1) * (ACROSS + 1)
        self.loaded = self.held + 2 * UPWARDS * (ACROSS + 1)
        self.others = self.loaded + 2 * (ACROSS + 1)

    def place(self, arm, i, j, k):
        side = np.where(arm == 0, -1.0, 1.0)
        return np.stack(np.broadcast_arrays(LENGTH * i / self.along, WIDTH * j / ACROSS,
                                            HEIGHT + side * HEIGHT * k / UPWARDS), axis=-1)

    def number(self, arm, i, j, k):
        """The same on all ranks. libdelam's mesh has the first groups; numbers behind may have gaps."""
        layer = arm * UPWARDS + k - 1
        return np.select([k == 0, i == self.along, (i == 0) & (k == UPWARDS)],
                         [(arm * (ACROSS + 1) + j) * (self.along + 1) + i,
                          self.held + layer * (ACROSS + 1) + j,
                          self.loaded + arm * (ACROSS + 1) + j],
                         self.others + (layer * (ACROSS + 1) + j) * (self.along + 1) + i)

    def nodes(self, arms, sections, across, layers):
        """Indices (arm, i, j, k) of the nodes of a box, each an array."""
        return (part.ravel() for part in np.meshgrid(arms, sections, across, layers, indexing="ij"))


# ---- the host's elements --------------------------------------------------------------------------------------------

def cell_stiffness(places):
    """Of cells by the places of their nodes, [cells][8][3]: [cells][24][24], with 2 x 2 x 2 Gauss points."""
    lame, shear = YOUNG * POISSON / ((1.0 + POISSON) * (1.0 - 2.0 * POISSON)), 0.5 * YOUNG / (1.0 + POISSON)
    signs = 2.0 * CORNERS - 1.0
    stiffness = np.zeros((len(places), 8, 3, 8, 3))
    for point in signs / np.sqrt(3.0):
        factors = 1.0 + signs * point
        slopes = 0.125 * signs * np.stack([factors[:, 1] * factors[:, 2], factors[:, 2] * factors[:, 0],
                                           factors[:, 0] * factors[:, 1]], axis=1)
        jacobian = np.einsum("cr,ecs->ers", slopes, places)
        gradients = np.einsum("esr,cr->ecs", np.linalg.inv(jacobian), slopes)
        volumes = np.abs(np.linalg.det(jacobian))  # arm 0 is the mirror image of arm 1
        stiffness += lame * np.einsum("e,eap,ebq->eapbq", volumes, gradients, gradients)
        stiffness += shear * np.einsum("e,eaq,ebp->eapbq", volumes, gradients, gradients)
        stiffness += shear * np.einsum("e,ear,ebr,pq->eapbq", volumes, gradients, gradients, np.eye(3))
    return stiffness.reshape(-1, 24, 24)


def compressed(rows, columns, values, size):
    """The sum of entries by rows."""
    places, entries = np.unique(rows * size + columns, return_inverse=True)
    sums = np.bincount(entries, values, len(places))
    row_starts = np.searchsorted(places, np.arange(size + 1) * size)
    return delam.Sparse((size, size), row_starts, places % max(size, 1), sums)


def make_part(grid, first, last):
    """Nodes, their places, and the stiffness of the cells between two sections."""
    arm, i, j, k = grid.nodes(range(2), range(first, last), range(ACROSS), range(UPWARDS))
    indices = arm[:, None], *(index[:, None] + CORNERS[:, axis] for axis, index in enumerate((i, j, k)))
    numbers, places = grid.number(*indices), grid.place(*indices)
    nodes, at, local = np.unique(numbers, return_index=True, return_inverse=True)
    dofs = (3 * local.reshape(-1, 8, 1) + np.arange(3)).reshape(-1, 24)
    rows = np.broadcast_to(dofs[:, :, None], (len(dofs), 24, 24))
    stiffness = compressed(rows.ravel(), rows.transpose(0, 2, 1).ravel(), cell_stiffness(places).ravel(),
                           3 * len(nodes))
    return nodes, stiffness, places.reshape(-1, 3)[at]


# ---- what libdelam knows, on rank 0 ---------------------------------------------------------------------------------

def make_mesh(grid):
    everything = [*grid.nodes(range(2), range(grid.along + 1), range(ACROSS + 1), range(UPWARDS + 1))]
    numbers = grid.number(*everything)
    known = np.argsort(numbers)[:grid.others]
    mesh = delam.Mesh(grid.place(*everything)[known])
    arms = everything[0][known]
    for arm in range(2):
        mesh.add_host_body(arm, np.flatnonzero(arms == arm))
    # A pair stands for a quarter of each cell around it.
    pairs = np.arange((grid.along + 1) * (ACROSS + 1))
    i, j = pairs % (grid.along + 1), pairs // (grid.along + 1)
    areas = np.where(i % grid.along == 0, 0.5, 1.0) * np.where(j % ACROSS == 0, 0.5, 1.0)
    corners = pairs[(i < grid.along) & (j < ACROSS)][:, None]
    mesh.add_pairs(0, 1, pairs, len(pairs) + pairs, "z", areas * LENGTH / grid.along * WIDTH / ACROSS,
                   corners + [0, 1, grid.along + 2, grid.along + 1])
    return mesh


def make_problem(grid):
    mesh = make_mesh(grid)
    problem = delam.Problem(mesh)
    problem.set_law(0, delam.Law("piecewise-linear", normal_stiffness=3e12, tangential_stiffness=3e12, normal_onset=5.0,
                                 tangential_onset=5.0, normal_toughness=250.0, tangential_toughness=250.0))
    problem.options["damage_tolerance"] = 1e-10  # to compare hosts closely
    # Pairs left of the notch tip have no adhesion from the start.
    problem.set_adhesion(0, mesh.interfaces[0].places[:, 0] < NOTCH - 1e-9, 0.0)
    # The right end is held, the outer edges of the left one are driven apart.
    opening = problem.add_pattern("opening", [0.0, 1.0], [0.0, 1.6e-3])
    across = np.arange(ACROSS + 1)
    for arm, outwards in enumerate(("-z", "z")):
        held = grid.number(*grid.nodes(arm, grid.along, across, range(UPWARDS + 1)))
        for axis in "xyz":
            problem.prescribe(held, axis)
        problem.prescribe(grid.number(arm, 0, across, UPWARDS), outwards, {opening: 0.5})
    return problem


def march(problem, ranks):
    problem.check()
    print("step          load/m       reaction/N     dissipated/J       debonded/m")
    with delam.Solver(problem, not_converged="raise") as solver:
        for step in range(1, STEPS + 1):
            solver.advance(step / STEPS)
            solver.commit()
            load, reaction, dissipated, debonded = (solver.values[name] for name in (
                "load:opening", "reaction:opening", "dissipated", "debonded_length"))
            # In space libdelam counts the debonded area.
            print(f"{step:4d} {load:16.9e} {reaction:16.9e} {dissipated:16.9e} {debonded / WIDTH:16.9e}", flush=True)
        ranks.recover(solver)
        ranks.everywhere()


# ---- all ranks ------------------------------------------------------------------------------------------------------

def tell_displacement(comm, ranks, known):
    """The task of each rank: the largest displacement of the nodes that only the ranks know, which rank 0 prints.
    known: how many nodes rank 0's mesh has."""
    lengths = np.linalg.norm(ranks.part_field("displacement"), axis=1)
    largest = comm.reduce(lengths[ranks.part_nodes()[0] >= known].max(initial=0.0), op=MPI.MAX)
    if comm.rank == 0:
        print(f"largest displacement of nodes that only the ranks know: {largest:.9e} m", flush=True)


def work(comm):
    along = int(sys.argv[1]) if sys.argv[1:] and sys.argv[1].isdecimal() else 0 if sys.argv[1:] else 30
    if not 3 <= along <= 100000:
        if comm.rank == 0:
            print("usage: host_petsc.py [CELLS]     3 to 100000 cells along the beam", file=sys.stderr)
        return 2
    grid = Grid(along)
    try:
        with delam.petsc.Ranks(comm) as ranks:
            ranks.set_part(*make_part(grid, along * ranks.rank // ranks.size, along * (ranks.rank + 1) // ranks.size))
            problem = ranks.run(lambda: make_problem(grid))
            ranks.attach(problem)
            ranks.set_task(lambda _: tell_displacement(comm, ranks, grid.others))
            ranks.run(lambda: march(problem, ranks))
    except delam.DelamError as error:
        # Every rank is here.
        if comm.rank == 0:
            print(f"host_petsc: {error.name}: {error}", file=sys.stderr)
        return 1
    return 0


def main():
    result = work(MPI.COMM_WORLD)
    if result != 0:
        MPI.COMM_WORLD.Barrier()  # mpi4py ends the others as soon as one has failed
    return result


if __name__ == "__main__":
    sys.exit(main())
