#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""faults.py [NAME ...]

What goes wrong on one rank, or from outside, ends all ranks in time and with a message, and nothing finished is lost:
kills, signals, an exception on one rank, too little memory, a full disk, wrong input. NAME: kill, signal, step, memory,
disk, input; without: all.
"""
import contextlib
import json
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor

from comparison import FIELDS, Result
from launch import EXAMPLES, Ranks, alone, expect, finish, folder, last_lines, on_ranks

PROMPT = 10.0  # s, in which all has ended
START = 60.0  # s, where the ranks start first, perhaps beside other programs
LONGEST_WAIT = 8.0  # s, in which a rank that has failed waits for the others (src/petsc/base/communicator.cpp)
ENGINE = os.environ.get("DELAM_TEST_ENGINE", "")  # test_engine.cpp
SCARCE = os.environ.get("DELAM_SCARCE_LIBRARY", "")  # scarce.c
SCENE = os.path.join(EXAMPLES, "enf-ductile", "enf-ductile.toml")
STEPS = 40
# Fields of every third step, so that something happens while they are written, too.
WORDS = [word for setting in ("geometry.h=0.003", f"time.steps={STEPS}", "output.every=3",
                              "solver.damage_tolerance=1e-10", FIELDS) for word in ("--set", setting)]
ALLOWED = 1e-7
reference = None


def command(out, *more):
    return ["run", SCENE, "--out", out, *WORDS, *more]


def uninterrupted():
    global reference
    if reference is None:
        out = os.path.join(folder(), "out")
        code, said = alone(*command(out))
        expect(code == 0, f"uninterrupted: {code} {last_lines(said) if code else ''}")
        reference = Result(out)
    return reference


def steps_in(path):
    """Rows of steps in a history; -1: there is none yet."""
    with contextlib.suppress(OSError):
        with open(path, encoding="utf-8") as file:
            return file.read().count("\n") - 2
    return -1


def at_step(ranks, out, step, limit=100.0):
    """Waits until a step is finished and a state is saved; the number of finished steps, None if the run is over."""
    until = time.monotonic() + limit
    running = os.path.join(out, "running")
    while time.monotonic() < until and ranks.process.poll() is None:
        done = steps_in(os.path.join(running, "history.csv"))
        if done >= step and os.path.exists(os.path.join(running, "state.bin")):
            return done
        time.sleep(0.005)
    return None


def ended(ranks, what, *patterns, codes=None, limit=PROMPT):
    """All ranks end in time, with a message; the exit code."""
    begun = time.monotonic()
    code = ranks.wait(limit)
    took = time.monotonic() - begun
    said = ranks.said
    expect(code is not None, f"{what}: all ranks have ended after {took:.1f} s"
           + ("" if code is not None else f"; still there: {ranks.running()}, {last_lines(said)}"))
    if code is not None:
        expect(code in codes if codes else code != 0, f"{what}: exit {code}")
    expect(all(re.search(pattern, said) for pattern in patterns), f"{what}: says {patterns}: {last_lines(said)}")
    return code


def goes_on(out, what, *counts):
    """Copies of what is left are resumed on other numbers of ranks to the same result."""
    for count in counts:
        copy = os.path.join(folder(), "out")
        shutil.copytree(out, copy)
        words = command(copy, "--resume")
        code, said = on_ranks(count, *words)
        name = f"{what}, resumed on {count} ranks"
        expect(code == 0 and re.search(r"resumed after step [1-9]|complete already", said) is not None,
               f"{name}: exit {code}" + ("" if code == 0 else f": {last_lines(said)}"))
        if code == 0:
            found, _ = Result(copy).differences(uninterrupted())
            worst = max(found, key=found.get)
            expect(found[worst] <= ALLOWED, f"{name}: the same result: {worst} differs by {found[worst]:.1e}")


def kill():
    for count, rank, resumed in ((2, 1, (4,)), (4, 0, (1, 2))):
        out = os.path.join(folder(), "out")
        what = f"SIGKILL to rank {rank} of {count}"
        with Ranks(count, *command(out)) as ranks:
            done = at_step(ranks, out, 5)
            expect(done is not None, f"{what}: in step {done}")
            if done is None:
                print(last_lines(ranks.said))
                continue
            os.kill(ranks.pid(rank), signal.SIGKILL)
            ended(ranks, what, r"\S")
        expect(not os.path.exists(os.path.join(out, "result.json")), f"{what}: no result is claimed")
        if rank == 0:
            # The serial program solves with variables of other numbers, and says that the state is not its own.
            copy = os.path.join(folder(), "out")
            shutil.copytree(out, copy)
            code, said = alone(*command(copy, "--resume"))
            expect(code in (2, 4) and "state.bin: snapshot has arrays of other sizes" in said,
                   f"{what}, resumed by the serial program: exit {code}: {last_lines(said)}")
        goes_on(out, what, *resumed)


def interrupted(out, what, done):
    with open(os.path.join(out, "result.json"), encoding="utf-8") as file:
        about = json.load(file)
    expect(about["status"] == "incomplete" and about["reason"] == "interrupted" and about["steps_done"] >= done,
           f"{what}: {about['status']} after step {about['steps_done']}, {done} were seen")


def signals():
    for number in (signal.SIGTERM, signal.SIGINT):
        out = os.path.join(folder(), "out")
        what = f"{number.name} to rank 0"
        with Ranks(2, *command(out)) as ranks:
            done = at_step(ranks, out, 3)
            if done is not None:
                os.kill(ranks.pid(0), number)
            ended(ranks, what, "interrupted after step", "--resume", codes=(130,))
        interrupted(out, what, done)
        if number == signal.SIGTERM:
            goes_on(out, what, 1)
        out = os.path.join(folder(), "out")
        what = f"{number.name} to mpirun"
        with Ranks(2, *command(out)) as ranks:
            done = at_step(ranks, out, 3)
            if done is not None:
                ranks.process.send_signal(number)
            ended(ranks, what, r"\S")
        kept = max(steps_in(os.path.join(out, name)) for name in ("history.csv", "running/history.csv"))
        expect(done is not None and kept >= done, f"{what}: {kept} finished steps are kept, {done} were seen")
        goes_on(out, what, *((4,) if number == signal.SIGINT else ()))
    out = os.path.join(folder(), "out")
    what = "SIGTERM and SIGINT to rank 1 alone"
    with Ranks(2, *command(out)) as ranks:
        if at_step(ranks, out, 1) is not None:
            os.kill(ranks.pid(1), signal.SIGTERM)
            os.kill(ranks.pid(1), signal.SIGINT)
        code = ranks.wait(100)
    expect(code == 0, f"{what}: the run comes to its end: {code}")


def step():
    """Rank 0 throws in the middle of a step of PETSc, where rank 1 waits for it."""
    if not ENGINE:
        print("the test of the engine is not built: left out")
        return
    what = "an exception in the middle of a step of PETSc"
    with Ranks(2, "lose", program=ENGINE) as ranks:
        until = time.monotonic() + START
        while "a rank is lost now" not in ranks.said and time.monotonic() < until:
            time.sleep(0.02)
        begun = time.monotonic()
        ended(ranks, what, "a rank is lost now",
              "libdelam-petsc: one rank has failed and the others wait for it: .*thrown in a step",
              limit=LONGEST_WAIT + PROMPT)
        took = time.monotonic() - begun
        expect(took > LONGEST_WAIT - 1.0, f"{what}: ended after {took:.1f} s, {LONGEST_WAIT:g} of them waited")
    what = "a task that fails on one rank while the other works longer than that"
    with Ranks(2, "late", program=ENGINE) as ranks:
        code = ranks.wait(START)
        expect(code == 0 and "0 failures" in ranks.said, f"{what}: {code}, {last_lines(ranks.said)}")
        expect("the task of rank 1 has failed, which waits for the others: the last rank's disk" in ranks.said,
               f"{what}: says so")
    what = "an exception in the middle of a step of PETSc"
    with Ranks(1, "lose", program=ENGINE) as ranks:
        code = ranks.wait(START)
        expect(code == 0 and "0 failures" in ranks.said,
               f"{what}, alone, is a status: {code}, {last_lines(ranks.said)}")


def memory():
    if not SCARCE:
        return
    # In the middle of the steps, no large blocks any more. (Open MPI itself ends without the small ones, or waits.)
    for rank, size in ((1, 8000), (1, 30000), (0, 8000)):
        out = os.path.join(folder(), "out")
        what = f"no blocks of {size} bytes on rank {rank} of 2"
        wrap = f'[ "$DELAM_RANK" = {rank} ] && export DELAM_SCARCE={size} || unset DELAM_SCARCE'
        with Ranks(2, *command(out), wrap=wrap, preload=SCARCE) as ranks:
            done = at_step(ranks, out, 2)
            if done is not None:
                os.kill(ranks.pid(rank), signal.SIGUSR1)
            ended(ranks, what, "delam: .*(memory|MUMPS)", codes=(4,))
        kept = max(steps_in(os.path.join(out, name)) for name in ("history.csv", "running/history.csv"))
        expect(done is not None and kept >= done, f"{what}: {kept} finished steps are kept, {done} were seen")
        if rank == 1 and size == 8000:
            goes_on(out, what, 2)
    # Little memory from the beginning: PETSc, the scene or the first solve fails.
    for rank in (0, 1):
        for megabytes in (2, 20, 60, 110):
            what = f"{megabytes} MB besides MPI's for rank {rank} of 2"
            out = os.path.join(folder(), "out")
            wrap = (f'[ "$DELAM_RANK" = {rank} ] && export DELAM_SCARCE_GROWTH={megabytes}000000 || '
                    'unset DELAM_SCARCE_GROWTH')
            with Ranks(2, *command(out), wrap=wrap, preload=SCARCE) as ranks:
                ended(ranks, what, "delam: .*(memory|MUMPS)", codes=(4,), limit=START)


def disk():
    out = os.path.join(folder(), "out")
    with Ranks(2, *command(out)) as ranks:
        if at_step(ranks, out, 3) is not None:
            resource.prlimit(ranks.pid(0), resource.RLIMIT_FSIZE, (1000, 1000))
        ended(ranks, "files of 1000 bytes at most", "cannot|too large|full", "--resume|start again", codes=(3,))
    goes_on(out, "files of 1000 bytes at most", 2)
    # On another rank, which writes its rows of the fields, and its share of the result.
    what = "files of 1000 bytes at most on rank 1"
    out = os.path.join(folder(), "out")
    with Ranks(2, *command(out)) as ranks:
        done = at_step(ranks, out, 3)
        if done is not None:
            resource.prlimit(ranks.pid(1), resource.RLIMIT_FSIZE, (1000, 1000))
        ended(ranks, what, r"cannot write .*step_\d+[.]bin", "--resume|start again", codes=(3,), limit=START)
    goes_on(out, what, 2)
    small = folder()
    mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", small], capture_output=True,
                             check=False)
    if mounted.returncode != 0:
        print("no folder of its own size: left out")
        return
    try:
        with Ranks(2, *command(os.path.join(small, "out"))) as ranks:
            code = ranks.wait(60)
            said = ranks.said
        expect(code == 3 and re.search("No space|full", said), f"a full disk: exit {code}: {last_lines(said)}")
    finally:
        subprocess.run(["umount", small], check=False)


def wrong_input():
    missing = os.path.join(folder(), "missing.toml")
    unheld = [word for setting in ('supports=[{ point = [0.0, 0.0], fix = ["y"] }]',) for word in ("--set", setting)]
    cases = (
        ([], 2, "delam-mpi:"),
        (["--help"], 0, "--petsc OPTIONS"),
        (["run", "--help"], 0, "--resume"),
        (["--version"], 0, "ABI"),
        (["fly"], 2, "subcommand|fly"),
        (["run", missing, "--out", folder()], 2, "missing.toml"),
        (command(folder(), "--set", "solver.nonsense=1"), 2, "nonsense"),
        (command(folder(), "--set", "solver.reduction=condensed"), 2, "engine.*reduction"),
        (command("/proc/nowhere"), 3, "/proc/nowhere"),
        (command(folder(), *unheld), (2, 4), r"delam: \S"),
        (["check", SCENE, *WORDS], 0, "unknowns"),
        (["--petsc", "-delam_pc_type nonsense", *command(folder())], (2, 4), "nonsense"),
        (["--petsc", "-delam_ksp_type nonsense", *command(folder())], (2, 4), "nonsense"),
        (["--petsc", "-delam_mat_partitioning_type nonsense", *command(folder())], (2, 4), "nonsense"),
        (["--petsc", "-delam_mat_partitioning_ptscotch_imbalance nonsense", *command(folder())], 2, "nonsense"),
        (["--petsc", "-delam_pc_factor_mat_solver_type nonsense", *command(folder())], (2, 4), "nonsense"),
        (["--petsc"], 2, "delam-mpi:"))

    def one(case):
        words, code, pattern = case
        what = " ".join(words).replace(" ".join(WORDS), "..")[-100:]
        with Ranks(2, *words) as ranks:
            ended(ranks, what, pattern, codes=code if isinstance(code, tuple) else (code,), limit=START)

    # mpirun takes a second to notice that its ranks have ended: some at a time.
    with ThreadPoolExecutor(3) as pool:
        list(pool.map(one, cases))


ALL = {"kill": kill, "signal": signals, "step": step, "memory": memory, "disk": disk, "input": wrong_input}


def main():
    for name in sys.argv[1:] or ALL:
        ALL[name]()
    finish()


if __name__ == "__main__":
    main()
