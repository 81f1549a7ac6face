#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""host_petsc.py RANKS HOST [ARGUMENT ...]

A host of examples/host-petsc on some ranks prints the numbers of the library alone, for the same scene with cells of
the library's own: up to 1e-7 of the largest of each column. On two ranks it is also given wrong arguments, which end it
with exit code 2, or with files that rank 1 cannot use, which end all ranks with exit code 1. Exits with 77
where mpirun, or what a host in Python needs, is missing.

HOST may be host_petsc_gmsh.py, for which Gmsh's library makes the files of the ranks from beam.geo.
"""
import ctypes
import ctypes.util
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

sys.path.append(str(pathlib.Path(__file__).parent.parent / "petsc"))
from environment import ENVIRONMENT

TOLERANCE = 1e-7
SKIPPED = 77
LIMIT = 30.0  # s, in which all ranks have started and ended, beside other programs
CELLS = 18
LENGTH, WIDTH, HEIGHT, NOTCH, ACROSS, UPWARDS, STEPS = 45e-3, 9e-3, 1.5e-3, 15e-3, 3, 2, 10
KEYS = "load:opening", "reaction:opening", "dissipated", "debonded_length"


def alone(formulation):
    """Rows of the library with its own cells, in one process, and in the end the largest displacement of the nodes that
    a host's libdelam does not know."""
    import delam
    import numpy as np
    mesh = delam.Mesh.layers([LENGTH, WIDTH], [CELLS, ACROSS], [HEIGHT, HEIGHT], [UPWARDS, UPWARDS], "hex8")
    glue = mesh.add_interface(0, 1)
    problem = delam.Problem(mesh)
    problem.set_elastic(60e9, 0.3)
    problem.set_formulation(formulation)
    problem.set_law(glue, delam.Law(
        "piecewise-linear", normal_stiffness=3e12, tangential_stiffness=3e12, normal_onset=5.0, tangential_onset=5.0,
        normal_toughness=250.0, tangential_toughness=250.0))
    problem.options["damage_tolerance"] = 1e-10
    problem.set_adhesion(glue, glue.places[:, 0] < NOTCH - 1e-9, 0.0)
    opening = problem.add_pattern("opening", [0.0, 1.0], [0.0, 1.6e-3])
    for axis in "xyz":
        problem.prescribe(mesh.find_nodes((LENGTH, 0.0, 0.0), (LENGTH, WIDTH, 2.0 * HEIGHT)), axis)
    for z, outwards in ((0.0, "-z"), (2.0 * HEIGHT, "z")):
        problem.prescribe(mesh.find_nodes((0.0, 0.0, z), (0.0, WIDTH, z)), outwards, {opening: 0.5})
    rows = []
    with delam.Solver(problem, not_converged="raise") as solver:
        for step in range(1, STEPS + 1):
            solver.advance(step / STEPS)
            solver.commit()
            values = [solver.values[key] for key in KEYS]
            rows.append([step, *values[:3], values[3] / WIDTH])
        lengths = np.linalg.norm(solver.field("displacement"), axis=1)
    x, _, z = mesh.nodes.T
    outside = np.minimum(z, 2.0 * HEIGHT - z) < 1e-9
    ours = (abs(z - HEIGHT) > 1e-9) & (x < LENGTH - 1e-9) & ~(outside & (x < 1e-9))
    return rows, lengths[ours].max()


def cut_mesh(ranks, geometry, folder):
    """As gmsh -3 -part RANKS -part_split -format msh22; the path without _RANK.msh, None where there is no Gmsh."""
    name = ctypes.util.find_library("gmsh")
    if name is None:
        return None
    library, error = ctypes.CDLL(name), ctypes.c_int()

    def call(function, *arguments):
        getattr(library, function)(*arguments, ctypes.byref(error))
        if error.value != 0:
            raise RuntimeError(f"{function} of {name} returned {error.value}")

    text = geometry.read_text(encoding="utf-8").replace("cells = 30 ", f"cells = {CELLS} ")
    copy, path = os.path.join(folder, "beam.geo"), os.path.join(folder, "beam")
    pathlib.Path(copy).write_text(text, encoding="utf-8")
    call("gmshInitialize", 0, None, 0)
    call("gmshOptionSetNumber", b"General.Terminal", ctypes.c_double(0))
    call("gmshOpen", copy.encode())
    call("gmshModelMeshGenerate", 3)
    call("gmshOptionSetNumber", b"Mesh.MshFileVersion", ctypes.c_double(2.2))
    if ranks > 1:
        call("gmshModelMeshPartition", ranks)
        call("gmshOptionSetNumber", b"Mesh.PartitionSplitMeshFiles", ctypes.c_double(1))
    call("gmshWrite", (path + (".msh" if ranks > 1 else "_1.msh")).encode())
    call("gmshFinalize")
    return path


def on_ranks(ranks, host, *arguments, limit=None):
    return subprocess.run(["mpirun", "-n", str(ranks), *host, *arguments], env=ENVIRONMENT,
                          capture_output=True, text=True, check=False, timeout=limit)


def broken_parts(host, path):
    """Tests that all ranks end in time, with a message, where the file of rank 1 is missing or of no use."""
    part = pathlib.Path(path + "_2.msh")
    lines = part.read_text(encoding="utf-8").splitlines()
    cells = [n for n, line in enumerate(lines) if len(line.split()) > 12 and line.split()[1] == "5"]
    inverted, empty = list(lines), [line for n, line in enumerate(lines) if n not in cells]
    for n in cells[:1]:
        words = lines[n].split()
        inverted[n] = " ".join(words[:-8] + words[-4:] + words[-8:-4])
    good = len(cells) > 0
    for what, content, word in (("an inverted cell", inverted, "MeshError"), ("no cells", empty, "no hexahedra"),
                                ("a file that ends early", lines[:len(lines) // 2], "rank 1"),
                                ("no file", None, "FileNotFoundError")):
        if content is None:
            part.unlink()
        else:
            part.write_text("\n".join(content) + "\n", encoding="utf-8")
        begun = time.monotonic()
        try:
            done = on_ranks(2, host, path, limit=LIMIT)
        except subprocess.TimeoutExpired:
            print(f"{what} on rank 1: still at work after {LIMIT:g} s")
            good = False
            continue
        said = [line for line in done.stderr.splitlines() if line.startswith("host_petsc_gmsh: rank 1: ")]
        print(f"{what} on rank 1: exit code {done.returncode} after {time.monotonic() - begun:.1f} s: {said}")
        if done.returncode != 1 or len(said) != 1 or word not in said[0]:
            print(f"expected exit code 1 and {word}:\n{done.stdout}{done.stderr}")
            good = False
    return good


def differences(expected, found):
    """Largest of each column, relative to the column's largest number."""
    return [max(abs(a - b) for a, b in zip(one, other)) / max(map(abs, one))
            for one, other in zip(zip(*expected), zip(*found))]


def main(folder):
    ranks, host = int(sys.argv[1]), sys.argv[2:]
    if shutil.which("mpirun") is None:
        print("skipped: mpirun is not there")
        return SKIPPED
    needs = subprocess.run([host[0], "-c", "import mpi4py"], stderr=subprocess.DEVNULL) if "python" in host[0] else None
    if needs is not None and needs.returncode != 0:
        print("skipped: mpi4py is not there")
        return SKIPPED
    right, wrong = [str(CELLS)], ["2"]
    geometry = pathlib.Path(host[-1]).with_name("beam.geo")
    if host[-1].endswith("_gmsh.py"):
        right, wrong = [cut_mesh(ranks, geometry, folder)], []
        if right == [None]:
            print("skipped: Gmsh's library is not there")
            return SKIPPED
    done = on_ranks(ranks, host, *right)
    lines = done.stdout.splitlines()
    if done.returncode != 0 or len(lines) != STEPS + 2:
        print(f"exit code {done.returncode} and {len(lines)} lines, expected 0 and {STEPS + 2}:\n"
              f"{done.stdout}{done.stderr}")
        return 1
    # The others assemble standard cells themselves.
    expected, largest = alone("incompatible" if host[-1].endswith("_gmsh.py") else "standard")
    found = [[float(word) for word in line.split()] for line in lines[1:-1]]
    worst = differences(expected, found)
    print(f"{ranks} ranks against the library alone, largest relative difference of each column: "
          + ", ".join(f"{title} {difference:.1e}" for title, difference in zip(lines[0].split(), worst)))
    if expected[-1][4] <= 0.0:
        print("nothing debonds in this scene")
        return 1
    told = float(lines[-1].split()[-2])
    print(f"{lines[-1]}, alone: {largest:.9e} m")
    if not abs(told - largest) <= TOLERANCE * largest:
        return 1
    if not all(difference <= TOLERANCE for difference in worst):
        print(f"expected at most {TOLERANCE:g}:\n{done.stdout}", *expected, sep="\n")
        return 1
    done = on_ranks(ranks, host, *wrong) if ranks == 2 else None
    if done is not None and (done.returncode != 2 or "usage" not in done.stderr):
        print(f"exit code {done.returncode}, expected 2, with wrong arguments:\n{done.stdout}{done.stderr}")
        return 1
    if ranks == 2 and wrong == [] and not broken_parts(host, right[0]):
        return 1
    return 0


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as place:
        sys.exit(main(place))
