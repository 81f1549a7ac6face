#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""provoked_petsc.py LIBRARY HEADER PETSC_LIBRARY PETSC_HEADER: every status that a line in brackets of petsc.h lists is
provoked once, by name, as provoked.py does for delam.h.

ROWS bring a function to a status in this process, MPI's singleton. Rows in APART take a process of their own, because
they leave PETSc or the memory in disorder. PLACES names the tests that provoke what takes several ranks, or a C++
exception. The test exits with 77 where mpi4py is missing.
"""
import ctypes
import os
import signal
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE]
SKIPPED = 77
try:
    from mpi4py import MPI
except ImportError:
    print("skipped: mpi4py is not there")
    sys.exit(SKIPPED)

import contract_lint as lint  # noqa: E402
import header as headers  # noqa: E402
import provoked  # noqa: E402
import sentences  # noqa: E402
import test_contract as contract  # noqa: E402
from ctypes import c_double, c_int32, c_int64, c_uint8, c_void_p  # noqa: E402
from provoked import CODES, QUAD4, full, stopping, without_material  # noqa: E402
from test_contract import call, fine, made, raw, real, room, short, whole, words  # noqa: E402

PETSC_LIBRARY, PETSC_HEADER = sys.argv[3:5]
SCARCE = os.environ.get("DELAM_SCARCE_LIBRARY", "")  # verify/petsc/scarce.c
header = headers.read(PETSC_HEADER, contract.header, promised=True)
library = ctypes.CDLL(PETSC_LIBRARY)
# The handle of a communicator is an int or a pointer, according to the implementation of MPI.
COMM = ctypes.c_int if MPI._sizeof(MPI.Comm) == ctypes.sizeof(ctypes.c_int) else c_void_p
KINDS = {**contract.SCALARS, "MPI_Comm": COMM, "MPI_Fint": ctypes.c_int}
for function in header.functions.values():
    symbol = getattr(library, function.name)
    symbol.argtypes = [KINDS.get(p.type, c_void_p) for p in function.parameters]
    symbol.restype = c_void_p if "*" in function.result else KINDS.get(function.result)

WORK = ctypes.CFUNCTYPE(c_int32, c_void_p)
TASK = ctypes.CFUNCTYPE(c_int32, c_int64, ctypes.POINTER(c_uint8), c_void_p)
CELLS = 1200  # of many_solved
PASSED = 17  # a number of the host's


def ask(name, *arguments):
    return getattr(library, "delam_petsc_" + name)(*[raw(a) for a in arguments])


def of_c(comm):
    return COMM.from_address(MPI._addressof(comm)).value


class Ranks:
    """One rank, with a scene of delam.h."""

    def __init__(self, make=full):
        self.scene = make()
        self.handle = None
        handle = c_void_p()
        self.right("create", ask("create", of_c(MPI.COMM_SELF), handle))
        self.handle = handle.value

    def right(self, name, status):
        if status != 0:
            raise SystemExit(f"delam_petsc_{name}: {status}: {self.message()}")

    def message(self):
        return ctypes.string_at(ask("message", self.handle)).decode()

    def ready(self):
        """The rank has the cells and is the engine of the problem."""
        s = self.scene
        self.right("take_scene", ask("take_scene", self.handle, s.mesh, s.problem))
        self.right("attach", ask("attach", self.handle, s.problem))
        return self

    def inside(self, work):
        """Returns the status of work() on rank 0."""
        seen = []
        self.work = WORK(lambda _: seen.append(work()) or 0)
        self.right("run", ask("run", self.handle, self.work, None))
        return seen[0]

    def solver(self):
        call("solver_destroy", c_void_p(self.scene.solver))
        self.scene.solver = made("solver_create", self.scene.problem, 0.0)

    def recovered(self):
        self.ready()

        def work():
            self.solver()
            return ask("recover", self.handle, self.scene.solver)
        self.right("recover", self.inside(work))
        return self

    def end(self):
        ask("destroy", c_void_p(self.handle))
        self.scene.end()


# ---- scenes and arguments ----
def layers():
    """Cells alone, many of them, and their problem."""
    s = contract.loose()
    s.mesh = made("mesh_create_layers", s.context, 2, real(1), whole(600), 2, real(1e-2, 1e-2), whole(1, 1), QUAD4)
    s.problem = made("problem_create", s.context, s.mesh)
    fine("problem_set_elastic", s.problem, -1, 1.0, 0.0)
    return s


def scene_of(r):
    return [r.scene.mesh, r.scene.problem]


def cells_of(r):
    count = whole(0)
    fine("mesh_size", r.scene.mesh, None, None, count, None, None)
    return [r.scene.mesh, r.scene.problem, count[0], room(c_int32, count[0])]


def own_cells_of(r):
    count = whole(0)
    fine("mesh_size", r.scene.mesh, None, count, None, None, None)
    return [r.scene.mesh, r.scene.problem, count[0], whole(*range(count[0]))]


def springs(_):
    """Two nodes of a plane, each held by itself."""
    return [2, 2, whole(0, 1), None, whole(*range(5)), whole(*range(4)), real(*[1.0] * 4)]


def task_that(returns):
    task = TASK(lambda *_: returns)

    def row(r):
        r.right("set_task", ask("set_task", r.handle, task, None))
        return r
    return row


nothing = TASK(lambda *_: 0)
RIGHT = {
    "set_part": springs, "set_rows": springs, "take_scene": scene_of, "take_cells": cells_of, "set_cells": own_cells_of,
    "attach": lambda r: [r.scene.problem], "run": lambda _: [WORK(lambda _: 0), None],
    "set_task": lambda _: [nothing, None], "value": lambda _: [words("solves"), real(0)],
}


def row(name, make=full, arguments=None, before=lambda r: r):
    """A call from outside of the work."""
    def provoke():
        r = before(Ranks(make))
        return ask(name, r.handle, *(arguments or RIGHT[name])(r)), r
    return provoke


def inside(name, arguments=None, before=lambda r: r, make=full):
    """A call in the work of rank 0."""
    def provoke():
        r = before(Ranks(make))
        given = (arguments or RIGHT[name])(r)
        return r.inside(lambda: ask(name, r.handle, *given)), r
    return provoke


def created(name, argument):
    def provoke():
        out = c_void_p(1)
        status = ask(name, argument, out)
        return (status if out.value is None else "*out is not NULL"), None
    return provoke


def in_work(before):
    """A solver made by the rank, of which it recovers something after before(r)."""
    def provoke():
        r = Ranks().ready()
        r.inside(r.solver)
        return before(r), r
    return provoke


def stopped(r):
    """The progress callback asks the recovery to stop."""
    r.stop = contract.on_progress.__class__(lambda *_: int(call("context_cancel", r.scene.context) == 0))
    fine("context_set_progress", r.scene.context, r.stop, None)
    return r.inside(lambda: ask("recover", r.handle, r.scene.solver))


def other_parts(r):
    """The same cells, handed over once more: the solver is of no use now, which each of its solves says, too."""
    r.ready()
    status = r.inside(lambda: call("solver_advance", r.scene.solver, 0.5))
    if status != CODES["DELAM_ERROR_STATE"]:
        return f"a step of the solver: {status}"
    return r.inside(lambda: ask("recover", r.handle, r.scene.solver))


ROWS = {
    ("create", "argument"): created("create", of_c(MPI.COMM_NULL)),
    ("create_fortran", "argument"): created("create_fortran", MPI.COMM_NULL.py2f()),
    ("set_part", "argument"): row("set_part", arguments=lambda r: [4, *springs(r)[1:]]),
    ("set_rows", "argument"): row("set_rows", arguments=lambda r: [4, *springs(r)[1:]]),
    ("take_scene", "cancelled"): row("take_scene", stopping(layers)),
    ("take_scene", "argument"): row("take_scene", arguments=lambda r: [None, r.scene.problem]),
    ("take_scene", "problem"): row("take_scene", without_material),
    ("take_cells", "cancelled"): row("take_cells", stopping(layers)),
    ("take_cells", "argument"): row("take_cells", arguments=lambda r: [*scene_of(r), 2, short(0, 1)]),
    ("take_cells", "problem"): row("take_cells", without_material),
    ("set_cells", "cancelled"): row("set_cells", stopping(layers)),
    ("set_cells", "argument"): row("set_cells", layers, lambda r: [*scene_of(r), 3, whole(0, 1, 2)]),
    ("set_cells", "problem"): row("set_cells"),  # the mesh has an interface
    ("attach", "argument"): row("attach", arguments=lambda _: [None]),
    ("run", "argument"): row("run", arguments=lambda _: [None, None]),
    ("run", "returned"): row("run", arguments=lambda _: [WORK(lambda _: PASSED), None]),
    ("set_task", "argument"): row("set_task", arguments=lambda _: [TASK(), None]),
    ("value", "argument"): row("value", arguments=lambda _: [words("spoon"), real(0)]),
    **{(name, "state"): inside(name) for name in RIGHT},  # collective: not in the work of rank 0
    ("everywhere", "argument"): inside("everywhere", lambda _: [-1, None], task_that(0)),
    ("everywhere", "memory"): inside("everywhere", lambda _: [1 << 62, room(c_uint8, 8)], task_that(0)),
    ("everywhere", "state"): row("everywhere", arguments=lambda _: [0, None], before=task_that(0)),
    ("everywhere", "returned"): inside("everywhere", lambda _: [0, None], task_that(PASSED)),
    ("explain", "argument"): row("explain", arguments=lambda _: [None]),
    ("recover", "cancelled"): in_work(stopped),
    ("recover", "state"): in_work(other_parts),
    ("part_nodes", "argument"): row("part_nodes", arguments=lambda _: [-1, None, None, None], before=Ranks.recovered),
    ("part_nodes", "state"): row("part_nodes", arguments=lambda _: [0, None, None, None], before=Ranks.ready),
    ("part_cells", "argument"): row("part_cells", arguments=lambda _: [1, whole(0), None], before=Ranks.ready),
    ("part_field", "argument"): row("part_field", arguments=lambda _: [words("spoon"), 0, None, None, None],
                                    before=Ranks.recovered),
    ("part_field", "state"): row("part_field", arguments=lambda _: [words("force"), 0, None, None, None],
                                 before=Ranks.ready),
}


# ---- rows in processes of their own ----
def scarce(work):
    """From now on this process gets no more large blocks (DELAM_SCARCE)."""
    os.kill(os.getpid(), signal.SIGUSR1)
    return work()


def create_without_memory(name, comm):
    def provoke():
        Ranks().end()  # PETSc has begun
        out = c_void_p()
        return scarce(lambda: ask(name, comm, out)), None
    return provoke


def recover_without_memory():
    r = Ranks(provoked.many_solved).ready()
    r.inside(r.solver)
    return r.inside(lambda: scarce(lambda: ask("recover", r.handle, r.scene.solver))), r


def field_without_memory():
    r = Ranks(provoked.many_solved).recovered()
    values = room(c_double, 4 * CELLS)
    return scarce(lambda: ask("part_field", r.handle, words("stress"), 4 * CELLS, values, None, None)), r


# No file of options: PETSc cannot be initialised.
NO_OPTIONS = {"PETSC_OPTIONS": "-options_file /nowhere/at/all"}
APART = {
    ("create", "internal"): (NO_OPTIONS, created("create", of_c(MPI.COMM_SELF))),
    ("create_fortran", "internal"): (NO_OPTIONS, created("create_fortran", MPI.COMM_SELF.py2f())),
    ("create", "memory"): ({"DELAM_SCARCE": "300"}, create_without_memory("create", of_c(MPI.COMM_SELF))),
    ("create_fortran", "memory"): ({"DELAM_SCARCE": "300"},
                                   create_without_memory("create_fortran", MPI.COMM_SELF.py2f())),
    ("recover", "memory"): ({"DELAM_SCARCE": "20000"}, recover_without_memory),
    ("part_field", "memory"): ({"DELAM_SCARCE": "20000"}, field_without_memory),
}
ENGINE = "petsc/test_engine.cpp: "
# (function, status) -> file of verify and words that stand in it, as in sentences.py
PLACES = {
    ("everywhere", "internal"): ENGINE + "a task that throws",
    ("recover", "numerical"): ENGINE + "a state that is not finite",
    ("take_scene", "numerical"): "petsc/handing.py: a partitioner that fails",
}
UNSEEN = {}


def code_of(status):
    return PASSED if status == "returned" else CODES.get("DELAM_ERROR_" + status.upper(),
                                                         CODES.get("DELAM_" + status.upper()))


def wrong_with(status, provoke):
    """Describes the fault of a row, or returns None."""
    got, ranks = provoke()
    if got != code_of(status):
        return f"the row gives {got}, expected {code_of(status)}; {ranks.message() if ranks else ''}"
    if ranks and not ranks.message():
        return "there is no message"
    if ranks and status != "memory":
        ranks.end()
    return None


def wrong_apart(name, status):
    settings = APART[(name, status)][0]
    environment = dict(os.environ, **settings)
    if "DELAM_SCARCE" in settings:
        if not SCARCE:
            return "DELAM_SCARCE_LIBRARY (verify/petsc/scarce.c) is not set"
        environment["LD_PRELOAD"] = SCARCE
    done = subprocess.run([sys.executable, os.path.abspath(__file__), *sys.argv[1:5], name, status], env=environment,
                          capture_output=True, text=True, check=False, timeout=300)
    return None if done.returncode == 0 else f"exit code {done.returncode}: {done.stdout}{done.stderr[-500:]}"


def gap(name, status):
    if (name, status) in ROWS:
        return wrong_with(status, ROWS[(name, status)])
    if (name, status) in APART:
        return wrong_apart(name, status)
    if (name, status) in PLACES:
        return sentences.wrong_place(PLACES[(name, status)], set())
    if (name, status) in UNSEEN:
        print(f"delam_petsc_{name}: {status}: not provoked; {UNSEEN[(name, status)]}")
        return None
    return "no row of provoked_petsc.py gives this status"


def main():
    if len(sys.argv) > 5:  # a row of APART
        wrong = wrong_with(sys.argv[6], APART[tuple(sys.argv[5:7])][1])
        print(wrong or "as listed", flush=True)
        os._exit(1 if wrong else 0)  # MPI may not end without memory
    listed = set()
    failures = []
    for function in header.functions.values():
        if function.result != "int32_t":
            continue
        for status in lint.split(lint.fields_of(function.comment)[0]["status"]):
            listed.add((function.name[len("delam_petsc_"):], status))
    for name, status in sorted(listed):
        wrong = gap(name, status)
        if wrong:
            failures.append(f"delam_petsc_{name}: {status}: {wrong}")
    for name, status in sorted({*ROWS, *APART, *PLACES, *UNSEEN} - listed):
        failures.append(f"delam_petsc_{name}: {status}: in the table, not listed in the header")
    for failure in failures:
        print(failure)
    print(f"{len(listed)} listed statuses, {len(ROWS) + len(APART)} rows, {len(PLACES)} in other tests, "
          f"{len(UNSEEN)} not provoked, {len(failures)} failures")
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
