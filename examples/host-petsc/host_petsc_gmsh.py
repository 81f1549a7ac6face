# SPDX-License-Identifier: BSD-3-Clause
"""A host on many processes whose mesh Gmsh has cut into files, of which each rank reads its own.

    gmsh -3 -part 4 -part_split -format msh22 beam.geo
    mpirun -n 4 python3 -m mpi4py host_petsc_gmsh.py beam      reads beam_1.msh .. beam_4.msh

The scene of host_petsc.py. Here libdelam makes the stiffness: each rank describes its cells with delam and hands them
over. No rank ever has the whole mesh; rank 0 learns of the nodes at the interface, the support and the loads."""
import sys

import numpy as np
from mpi4py import MPI

import delam
import delam.petsc
from host_petsc import HEIGHT, LENGTH, NOTCH, POISSON, YOUNG, march, tell_displacement

HEXAHEDRON = 5  # of Gmsh
FACES = np.array([[0, 1, 2, 3], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]])
ARMS = {"lower": 0, "upper": 1}


# ---- a rank's file ---------------------------------------------------------------------------------------------------

def sections(path):
    """The lines of each section of a file of Gmsh, without their count."""
    with open(path, encoding="utf-8") as file:
        for line in file:
            name = line.strip()
            if name.startswith("$"):
                lines = [text.split() for text in iter(lambda: next(file).strip(), "$End" + name[1:])]
                yield name[1:], lines[1:]


def read_part(path):
    """Tags and places of the nodes, and for each hexahedron the tags of its nodes and its arm (MSH 2.2, text)."""
    found = dict(sections(path))
    arms = {int(group): ARMS[name.strip('"')] for _, group, name in found["PhysicalNames"]}
    tags = np.array([int(node[0]) for node in found["Nodes"]])
    places = np.array([node[1:] for node in found["Nodes"]], float)
    # number, type, count of tags, physical group, ...; the nodes come last
    cells = [(arms[int(words[3])], words[-8:]) for words in found["Elements"] if int(words[1]) == HEXAHEDRON]
    return tags, places, np.array([arm for arm, _ in cells], np.int32), np.array([nodes for _, nodes in cells], int)


class Part:
    """A rank's nodes and cells; nodes by their place in `tags`, Gmsh's numbers, which are the same in all files."""

    def __init__(self, path):
        tags, places, self.arms, cells = read_part(path)
        if len(cells) == 0:
            raise ValueError(f"{path} has no hexahedra")
        self.tags, local = np.unique(cells, return_inverse=True)
        self.cells = local.reshape(-1, 8)
        order = np.argsort(tags)
        self.places = places[order][np.searchsorted(tags[order], self.tags)]
        self.node_arms = np.empty(len(self.tags), int)
        self.node_arms[self.cells] = self.arms[:, None]

    def known(self):
        """What rank 0 needs of this part: tag, arm and place of nodes, and the lower arm's faces at the interface."""
        at = np.isclose(self.places, [LENGTH, 0.0, HEIGHT], rtol=0.0, atol=1e-9)
        loaded = np.isclose(self.places, [0.0, 0.0, 0.0], rtol=0.0, atol=1e-9)
        top = np.isclose(self.places[:, 2], 2.0 * HEIGHT, rtol=0.0, atol=1e-9)
        wanted = at[:, 2] | at[:, 0] | (loaded[:, 0] & (loaded[:, 2] | top))
        faces = self.cells[self.arms == 0][:, FACES].reshape(-1, 4)
        faces = faces[at[:, 2][faces].all(axis=1)]
        return self.tags[wanted], self.node_arms[wanted], self.places[wanted], self.tags[faces]

    def problem(self):
        mesh = delam.Mesh(self.places)
        mesh.add_cells("hex8", self.cells, self.arms)
        problem = delam.Problem(mesh)
        problem.set_elastic(YOUNG, POISSON)
        return problem


# ---- what libdelam knows of the whole, on rank 0 ---------------------------------------------------------------------

class Known:
    """The nodes that rank 0 knows, whose numbers are their places in `tags`."""

    def __init__(self, parts):
        tags, arms, places, faces = (np.concatenate(lists) for lists in zip(*parts))
        self.tags, first = np.unique(tags, return_index=True)
        self.arms, self.places = arms[first], places[first]
        self.faces = np.searchsorted(self.tags, faces)

    def where(self, axis, value):
        return np.abs(self.places[:, axis] - value) < 1e-9


def make_mesh(known):
    mesh = delam.Mesh(known.places)
    for arm in range(2):
        mesh.add_host_body(arm, np.flatnonzero(known.arms == arm))
    # The nodes of both arms at the interface in the same order: by y, then x, to a nanometre.
    sides = []
    for arm in range(2):
        nodes = np.flatnonzero(known.where(2, HEIGHT) & (known.arms == arm))
        x, y, _ = np.round(known.places[nodes] * 1e9).T
        sides.append(nodes[np.lexsort((x, y))])
    pair = np.full(len(known.tags), -1)
    pair[sides[0]] = np.arange(len(sides[0]))
    # A pair stands for a quarter of each face around it.
    corners = known.places[known.faces]
    areas = 0.5 * np.linalg.norm(np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]), axis=1)
    weights = np.bincount(pair[known.faces].ravel(), np.repeat(areas / 4.0, 4))
    mesh.add_pairs(0, 1, *sides, "z", weights, pair[known.faces])
    return mesh


def make_problem(known):
    mesh = make_mesh(known)
    problem = delam.Problem(mesh)
    problem.set_law(0, delam.Law("piecewise-linear", normal_stiffness=3e12, tangential_stiffness=3e12, normal_onset=5.0,
                                 tangential_onset=5.0, normal_toughness=250.0, tangential_toughness=250.0))
    problem.options["damage_tolerance"] = 1e-10  # to compare hosts closely
    problem.set_adhesion(0, mesh.interfaces[0].places[:, 0] < NOTCH - 1e-9, 0.0)
    opening = problem.add_pattern("opening", [0.0, 1.0], [0.0, 1.6e-3])
    for axis in "xyz":
        problem.prescribe(np.flatnonzero(known.where(0, LENGTH)), axis)
    for level, outwards in ((0.0, "-z"), (2.0 * HEIGHT, "z")):
        problem.prescribe(np.flatnonzero(known.where(0, 0.0) & known.where(2, level)), outwards, {opening: 0.5})
    return problem


# ---- all ranks -------------------------------------------------------------------------------------------------------

class PartError(Exception):
    """A rank cannot read or describe its part. All ranks raise it."""


def together(comm, function, *arguments):
    """What the function returns on this rank. If it fails on one rank, no rank goes on to wait for it."""
    result, failure = None, None
    try:
        result = function(*arguments)
    except Exception as error:
        failure = f"rank {comm.rank}: {type(error).__name__}: {error}"
    failures = [text for text in comm.allgather(failure) if text is not None]
    if failures:
        raise PartError(failures[0])
    return result


def delaminate(comm, part, own):
    """own: the problem of this rank's part."""
    parts = comm.gather(part.known())
    known = Known(parts) if comm.rank == 0 else None
    tags = comm.bcast(None if known is None else known.tags)
    # Nodes that rank 0 does not know have higher numbers, with gaps.
    place = np.searchsorted(tags, part.tags)
    is_known = tags[np.minimum(place, len(tags) - 1)] == part.tags
    numbers = np.where(is_known, place, len(tags) + part.tags)
    with delam.petsc.Ranks(comm) as ranks:
        ranks.set_cells(own, numbers)
        problem = ranks.run(lambda: make_problem(known))
        ranks.attach(problem)
        ranks.set_task(lambda _: tell_displacement(comm, ranks, len(tags)))
        ranks.run(lambda: march(problem, ranks))


def work(comm):
    if len(sys.argv) != 2:
        if comm.rank == 0:
            print("usage: host_petsc_gmsh.py MESH     each rank reads MESH_1.msh, MESH_2.msh, ..", file=sys.stderr)
        return 2
    try:
        part = together(comm, Part, f"{sys.argv[1]}_{comm.rank + 1}.msh")
        own = together(comm, part.problem)
        delaminate(comm, part, own)
    except (PartError, delam.DelamError) as error:
        # It is the same on all ranks: each call above and in delaminate that can fail is one of all ranks.
        if comm.rank == 0:
            name = f"{error.name}: " if isinstance(error, delam.DelamError) else ""
            print(f"host_petsc_gmsh: {name}{error}", file=sys.stderr)
        return 1
    return 0


def main():
    result = work(MPI.COMM_WORLD)
    if result != 0:
        MPI.COMM_WORLD.Barrier()  # mpi4py ends the others as soon as one has failed
    return result


if __name__ == "__main__":
    sys.exit(main())
