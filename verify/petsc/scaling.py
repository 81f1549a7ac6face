#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Iterations, work, bytes and messages of delam-mpi against the number of ranks, the preconditioner and the stiffness
of the interfaces.

    python3 verify/petsc/scaling.py DELAM_MPI [--ranks 1,2,4,8,16] [--only TABLE ...]

Counts, not times: the ranks may be more than the cores. Tables (--only): laminate (constant size per rank, for several
stiffnesses), strong (constant size), fibre, weave, factors (what a rank has of BDDC's local factors), time (the only
one that is timed, on as many ranks as there are idle cores). Each row is one analysis; the counts are those that
`delam-mpi --counts` prints.
"""
import argparse
import contextlib
import pathlib
import re
import subprocess
import sys
import tempfile
import time

from environment import ENVIRONMENT

ROOT = pathlib.Path(__file__).resolve().parents[2]
SOLVERS = {"mumps": "", "bddc": "-delam_pc_type bddc"}


def laminate(columns, steps, stiffness, cells=24):
    """An end-notched flexure in space, two thin plies, `columns` times as wide as one column of 6 mm with 6 cells."""
    width = 0.006 * columns
    text = (ROOT / "examples" / "enf-3d" / "enf-3d.toml").read_text(encoding="utf-8")
    text = text.replace("width = 0.0127\n", f"width = {width}\n").replace("0.0127", f"{width}")
    text = text.replace("divisions = [102, 12]", f"divisions = [{cells * 2}, {6 * columns}]")
    text = text.replace("normal_stiffness = 1e14", f"normal_stiffness = {stiffness}")
    text = text.replace("tangential_stiffness = 1e14", f"tangential_stiffness = {stiffness}")
    # Strengths of 20 and 40 MPa, onsets below the toughness.
    text = text.replace("normal_onset = 2.0", f"normal_onset = {min(900.0, 2e14 / stiffness)}")
    text = text.replace("tangential_onset = 8.0", f"tangential_onset = {min(1700.0, 8e14 / stiffness)}")
    # The first steps of the example: contact is found, and the notch begins to soften.
    text = text.replace("steps = 40", f"steps = {steps}").replace("end = 1.0", f"end = {0.025 * steps}")
    text = text.replace("every = 4", "every = 100")
    return re.sub(r"snapshots = .*\n", "", text)


def example(name, changes):
    text = (ROOT / "examples" / name / f"{name}.toml").read_text(encoding="utf-8")
    for old, new in changes.items():
        if old not in text:
            raise SystemExit(f"scaling.py: {name}.toml has no '{old}'")
        text = text.replace(old, new)
    return text


@contextlib.contextmanager
def started(program, text, ranks, options, of_mpirun=()):
    """A run, whose output can be read; ended in the end."""
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder) / "scene.toml"
        scene.write_text(text, encoding="utf-8")
        command = ["mpirun", *of_mpirun, "-n", str(ranks), program]
        if options:
            command += ["--petsc", options]
        command += ["--counts", "run", str(scene), "--out", str(pathlib.Path(folder) / "out")]
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              env=ENVIRONMENT) as process:
            yield process
            process.terminate()


def counts_of(program, text, ranks, options):
    """The counts of a run, and the seconds that it took."""
    begin = time.monotonic()
    with started(program, text, ranks, options) as process:
        said = process.communicate()[0]
    seconds = time.monotonic() - begin
    line = next((line for line in said.splitlines() if line.startswith("counts:")), None)
    if line is None or process.returncode not in (0, 1):
        raise SystemExit(f"scaling.py: {ranks} ranks, {options}\n{said[-3000:]}")
    words = line.split()[1:]
    return {**dict(zip(words[::2], map(float, words[1::2]))), "seconds": seconds, "bodies": bodies_part(said)}


def bodies_part(said):
    """Seconds in the work on the bodies, if the run was asked for -log_view: preconditioners made and applied, and
    products with the stiffness. The rest is rank 0's: the mesh, the laws, contact and output."""
    events = re.findall(r"^(?:MatMult|PCSetUp|PCApply) +\d+ +\S+ +(\S+)", said, re.M)
    return sum(map(float, events))


def local_factors(program, text, ranks):
    """Returns, for each rank, the entries of the two factors that BDDC has of its matrix at the first preconditioner,
    as MUMPS counts them in its analysis."""
    options = SOLVERS["bddc"]
    for solver in ("dirichlet", "neumann"):
        prefix = f" -delam_pc_bddc_{solver}_"
        options += f"{prefix}pc_factor_mat_solver_type mumps{prefix}mat_mumps_icntl_4 2"
    entries = [[] for _ in range(ranks)]
    line_of_mumps = re.compile(r"\[1,(\d+)\]<stdout>: -- \(20\) Number of entries in factors .estim.. *= *(\d+)")
    with started(program, text, ranks, options, of_mpirun=["--tag-output"]) as process:
        for line in process.stdout:
            if found := line_of_mumps.match(line):
                entries[int(found[1])].append(int(found[2]))
            if all(len(both) >= 2 for both in entries):
                return [sum(both[:2]) for both in entries]
    raise SystemExit(f"scaling.py: {ranks} ranks: MUMPS' analyses do not show")


def row(cells):
    print("| " + " | ".join(str(cell) for cell in cells) + " |", flush=True)


def head(title, cells):
    print(f"\n{title}\n")
    row(cells)
    print("|" + "---|" * len(cells))


def iterations_table(program, title, scenes, ranks, solvers):
    """scenes: name -> text for a number of ranks."""
    head(title, ["scene", "solver", "ranks", "solves", "iterations per solve", "renewals"])
    for name, text_of in scenes.items():
        for solver in solvers:
            for n in ranks:
                if solver == "bddc" and n == 1:
                    continue
                c = counts_of(program, text_of(n), n, SOLVERS[solver])
                row([name, solver, n, f"{c['solves']:.0f}", f"{c['iterations'] / c['solves']:.1f}",
                     f"{c['renewals']:.0f}"])


def table_laminate(program, ranks):
    scenes = {f"laminate, k = {k:.0e} N/m3": lambda n, k=k: laminate(n, 6, k) for k in (1e10, 1e14, 1e17)}
    iterations_table(program, "Iterations, constant size per rank (5,300 displacements), 6 load steps", scenes, ranks,
                     ("mumps", "bddc"))


def table_fibre(program, ranks):
    scenes = {"fibre": lambda n: example("fibre", {"steps = 200": "steps = 10", "end = 1.0": "end = 0.5",
                                                   "snapshots = [0.3, 0.4, 0.6, 1.0]\n": ""})}
    iterations_table(program, "A fibre in a periodic cell, constant size, 10 load steps", scenes, ranks,
                     ("mumps", "bddc"))


def table_weave(program, ranks):
    scenes = {"weave": lambda n: example("weave", {"steps = 20": "steps = 2", "end = 1.0": "end = 0.2",
                                                   "snapshots = [0.25, 0.5, 0.75, 1.0]\n": ""})}
    iterations_table(program, "A weave in a periodic cell, constant size, 2 load steps", scenes, ranks,
                     ("mumps", "bddc"))


def table_strong(program, ranks):
    head("Work of a rank at constant size (laminate of 16 columns, 2 load steps): the busiest rank over the mean",
         ["solver", "ranks", "iterations", "operations", "bytes sent", "messages", "memory of a rank, MB",
          "bytes per iteration and rank", "messages per iteration and rank"])
    for solver, options in SOLVERS.items():
        for n in ranks:
            if n == 1:
                continue
            c = counts_of(program, laminate(16, 2, 1e14), n, options)
            share = {key: c[f"{key}_max"] * n / max(1.0, c[f"{key}_sum"])
                     for key in ("operations", "bytes_sent", "messages")}
            per = max(1.0, c["iterations"]) * n
            row([solver, n, f"{c['iterations']:.0f}", f"{share['operations']:.2f}", f"{share['bytes_sent']:.2f}",
                 f"{share['messages']:.2f}", f"{c['memory_mb_max']:.0f}", f"{c['bytes_sent_sum'] / per:.0f}",
                 f"{c['messages_sum'] / per:.0f}"])


def table_factors(program, ranks):
    head("Entries of BDDC's two local factors at constant size (laminate of 16 columns, 85,000 displacements)",
         ["ranks", "mean of a rank", "busiest over mean", "least over mean"])
    for n in ranks:
        if n == 1:
            continue
        entries = local_factors(program, laminate(16, 1, 1e14), n)
        mean = sum(entries) / n
        row([n, f"{mean:.2e}", f"{max(entries) / mean:.2f}", f"{min(entries) / mean:.2f}"])


def table_time(program, _ranks):
    head("Seconds, the same analysis on one and two ranks, in turn (idle cores; laminate of 43,000 displacements, "
         "3 load steps, MUMPS)",
         ["pair", "one rank", "two ranks", "times faster", "the bodies' part", "on two", "times faster"])
    text = laminate(8, 3, 1e14)
    for pair in range(1, 4):
        one, two = (counts_of(program, text, n, "-log_view") for n in (1, 2))
        row([pair, f"{one['seconds']:.1f}", f"{two['seconds']:.1f}", f"{one['seconds'] / two['seconds']:.2f}",
             f"{one['bodies']:.1f}", f"{two['bodies']:.1f}", f"{one['bodies'] / two['bodies']:.2f}"])


TABLES = {"laminate": table_laminate, "fibre": table_fibre, "weave": table_weave, "strong": table_strong,
          "factors": table_factors, "time": table_time}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--ranks", default="1,2,4,8,16")
    parser.add_argument("--only", nargs="+", choices=sorted(TABLES), default=list(TABLES))
    arguments = parser.parse_args()
    ranks = [int(word) for word in arguments.ranks.split(",")]
    for name in arguments.only:
        TABLES[name](arguments.program, ranks)
    return 0


if __name__ == "__main__":
    sys.exit(main())
