# SPDX-License-Identifier: BSD-3-Clause
"""Bodies on many processes: libdelam-petsc (include/delam/petsc.h), with mpi4py.

    from mpi4py import MPI
    import delam.petsc

    with delam.petsc.Ranks(MPI.COMM_WORLD) as ranks:
        ranks.set_part(nodes, stiffness, coordinates)    each rank: what it adds to the stiffness of the bodies
        problem = ranks.run(make_problem)                rank 0 describes the scene; None on the others
        ranks.attach(problem)
        history = ranks.run(lambda: delam.Solver(problem).history(times))

All ranks make the same calls in the same order. An error of a call is raised on all ranks, and so is what the function
of `run` raises on rank 0. Run a host by `mpirun -n 4 python3 -m mpi4py host.py`: where a rank fails by itself, outside
these calls, mpi4py then ends the others.

The library libdelam-petsc.so.N is loaded when the first Ranks is made. It is searched for in the environment variable
DELAM_PETSC_LIBRARY, a file or a folder; if that is not set, next to libdelam and then on the loader's paths.
"""
from __future__ import annotations

import ctypes
import os
import pathlib
import pickle
from collections.abc import Callable
from ctypes import POINTER, c_char_p, c_double, c_int32, c_int64, c_uint8, c_void_p
from typing import TYPE_CHECKING, Any, NoReturn, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._base import library as _library
from ._base import raw
from ._base.arrays import floats, gate, indices, pointer
from ._base.call import integer, text
from ._base.errors import ArgumentError, DelamError, HandleError, StateError, error_of
from .mesh import Mesh
from .problem import Problem, _rows_of
from .solver import Solver

if TYPE_CHECKING:
    from mpi4py import MPI

SONAME = f"libdelam-petsc.so.{raw.DELAM_ABI}"
VARIABLE = "DELAM_PETSC_LIBRARY"
_Result = TypeVar("_Result")
_WORK = ctypes.CFUNCTYPE(c_int32, c_void_p)
_TASK = ctypes.CFUNCTYPE(c_int32, c_int64, POINTER(c_uint8), c_void_p)
# Without the two functions that make a handle: the type of a communicator is known only with mpi4py.
_FUNCTIONS: dict[str, tuple[Any, tuple[Any, ...]]] = {
    "delam_petsc_destroy": (None, (POINTER(c_void_p),)),
    "delam_petsc_message": (c_char_p, (c_void_p,)),
    "delam_petsc_set_part": (c_int32, (c_void_p, c_int32, c_int64, POINTER(c_int64), POINTER(c_double),
                                       POINTER(c_int64), POINTER(c_int64), POINTER(c_double))),
    "delam_petsc_take_scene": (c_int32, (c_void_p, c_void_p, c_void_p)),
    "delam_petsc_take_cells": (c_int32, (c_void_p, c_void_p, c_void_p, c_int64, POINTER(c_int32))),
    "delam_petsc_set_rows": (c_int32, (c_void_p, c_int32, c_int64, POINTER(c_int64), POINTER(c_double),
                                       POINTER(c_int64), POINTER(c_int64), POINTER(c_double))),
    "delam_petsc_set_cells": (c_int32, (c_void_p, c_void_p, c_void_p, c_int64, POINTER(c_int64))),
    "delam_petsc_attach": (c_int32, (c_void_p, c_void_p)),
    "delam_petsc_run": (c_int32, (c_void_p, _WORK, c_void_p)),
    "delam_petsc_set_task": (c_int32, (c_void_p, _TASK, c_void_p)),
    "delam_petsc_everywhere": (c_int32, (c_void_p, c_int64, POINTER(c_uint8))),
    "delam_petsc_explain": (c_int32, (c_void_p, c_char_p)),
    "delam_petsc_recover": (c_int32, (c_void_p, c_void_p)),
    "delam_petsc_part_nodes": (c_int32, (c_void_p, c_int64, POINTER(c_int64), POINTER(c_int32), POINTER(c_int64))),
    "delam_petsc_part_cells": (c_int32, (c_void_p, c_int64, POINTER(c_int64), POINTER(c_int64))),
    "delam_petsc_part_field": (c_int32, (c_void_p, c_char_p, c_int64, POINTER(c_double), POINTER(c_int64),
                                         POINTER(c_int64))),
    "delam_petsc_value": (c_int32, (c_void_p, c_char_p, POINTER(c_double))),
}
_loaded: list[ctypes.CDLL] = []


class WorkError(DelamError, RuntimeError):
    """The function of Ranks.run, or the task of a rank, raised something that is not a DelamError. What leaves `run` is
    raised on all ranks, with the original as its cause on each rank that has one."""


def _candidates() -> list[str]:
    value = os.environ.get(VARIABLE)
    if value:
        path = pathlib.Path(value)
        return [str(path / SONAME if path.is_dir() else path)]
    beside = pathlib.Path(_library.location).parent / SONAME
    return ([str(beside)] if beside.exists() else []) + [SONAME]


def _library_of_ranks() -> ctypes.CDLL:
    """libdelam-petsc with typed functions, loaded once."""
    if not _loaded:
        tried = []
        for path in _candidates():
            try:
                library = ctypes.CDLL(path)
                for name, (result, arguments) in _FUNCTIONS.items():
                    function = getattr(library, name)
                    function.restype, function.argtypes = result, arguments
            except (OSError, AttributeError) as error:
                tried.append(str(error))
                continue
            _loaded.append(library)
            break
        else:
            raise ImportError(f"libdelam-petsc was not found. Set {VARIABLE} to {SONAME} or to its folder, or install "
                              f"it next to libdelam. Tried:\n  " + "\n  ".join(tried))
    return _loaded[0]


class Ranks:
    """Ranks of a communicator of mpi4py, which is duplicated, that solve the bodies of a problem together. Close it, or
    use it in `with`, on all ranks before MPI is finalised."""

    def __init__(self, comm: MPI.Intracomm) -> None:
        from mpi4py import MPI
        if not isinstance(comm, MPI.Intracomm) or comm == MPI.COMM_NULL:
            raise ArgumentError(f"comm = {comm!r}, expected an intracommunicator of mpi4py")
        self._library = _library_of_ranks()
        # The handle of a communicator is an int or a pointer, according to the implementation of MPI.
        kind = ctypes.c_int if MPI._sizeof(MPI.Comm) == ctypes.sizeof(ctypes.c_int) else c_void_p
        create = self._library.delam_petsc_create
        create.restype, create.argtypes = c_int32, (kind, POINTER(c_void_p))
        handle = c_void_p()
        status = create(kind.from_address(MPI._addressof(comm)), ctypes.byref(handle))
        if status != raw.DELAM_OK:
            raise error_of(status, "PETSc could not be initialised on these ranks")
        self._pointer = handle
        self._comm = comm.Dup()
        self.rank: int = comm.rank
        self.size: int = comm.size
        self._agreed: BaseException | None = None  # an error that all ranks have
        self._running = False
        self._task: Any = None  # the C function that holds the task
        self._tasks = 0  # that have run, the same number on all ranks
        self._raised: BaseException | None = None  # by the last task of this rank

    # ---- handle

    def _check_open(self) -> None:
        if not self._pointer:
            raise HandleError("these Ranks are closed")

    def _check(self) -> None:
        self._check_open()
        # The other ranks would not answer.
        if self._running:
            raise StateError("these Ranks are running a function")

    @property
    def _handle(self) -> Any:
        self._check()
        return self._pointer

    @property
    def closed(self) -> bool:
        """True if close() has freed what the ranks hold."""
        return not self._pointer

    def close(self) -> None:
        """Frees what the ranks hold; all of them call it. Solvers made with it raise StateError from then on."""
        if self._pointer:
            self._library.delam_petsc_destroy(ctypes.byref(self._handle))
            self._comm.Free()

    def __reduce_ex__(self, protocol: Any) -> NoReturn:
        raise TypeError("Ranks cannot be pickled or copied: they belong to the communicator of this process. Make them "
                        "in each process")

    def __enter__(self) -> Ranks:
        return self

    def __exit__(self, kind: object, error: BaseException | None, trace: object) -> None:
        # Where one rank alone has failed, the others do not come here.
        if error is None or error is self._agreed or self.size == 1:
            self.close()

    def _raise(self, error: BaseException, cause: BaseException | None = None) -> NoReturn:
        self._agreed = error
        raise error from cause

    def _call(self, function: Any, *arguments: Any, problem: Problem | None = None) -> None:
        """problem: this rank's, which the function uses, and of which libdelam tells what is wrong."""
        if problem is None:
            status, told = function(self._handle, *arguments), ""
        else:
            status, told = problem.context.beside(function, self._handle, *arguments, other=problem.mesh.context)
        if status != raw.DELAM_OK:
            message = self._message()
            told = next(filter(None, self._comm.allgather(told)), "")
            self._raise(error_of(status, f"{message}: {told}" if told else message))

    def _here(self, function: Any, *arguments: Any) -> None:
        """A call of this rank alone, which may be inside `run`."""
        self._check_open()
        status = function(self._pointer, *arguments)
        if status != raw.DELAM_OK:
            raise error_of(status, self._message())

    def _message(self) -> str:
        return str(self._library.delam_petsc_message(self._pointer).decode(errors="replace"))

    def _together(self, function: Callable[[], _Result]) -> _Result:
        """Calls the function and returns its result; raises an error of one rank on all of them."""
        self._check()
        result: Any = None
        error: DelamError | None = None
        try:
            result = function()
        except DelamError as exception:
            error = exception
        failures = [failure for failure in self._comm.allgather(error and (self.rank, error.status, str(error)))
                    if failure is not None]
        if failures:
            rank, status, message = failures[0]
            self._raise(error_of(status, f"rank {rank}: {message}"), error)
        agreed: _Result = result
        return agreed

    def _first(self, name: str, value: Any, kind: type[Mesh] | type[Problem]) -> c_void_p | None:
        """Handle of an object that rank 0 has, None on the others."""
        if self.rank != 0:
            return None
        if not isinstance(value, kind):
            raise ArgumentError(f"{name} = {value!r}, expected a {kind.__name__} on rank 0")
        return ctypes.cast(value._handle, c_void_p)

    def _only_first(self, value: Problem | None) -> Problem | None:
        return value if self.rank == 0 else None

    # ---- parts

    def set_part(self, nodes: ArrayLike, matrix: object, coordinates: ArrayLike | None = None,
                 dimension: int = 3) -> None:
        """Sets what this rank adds to the stiffness of the bodies, which is the sum over all ranks.

        nodes        each once, in the numbers of the mesh of rank 0's problem; numbers beyond the mesh are nodes that
                     only the ranks know
        matrix       a delam.Sparse or a matrix of scipy.sparse, both triangles; row dimension * i + component of
                     nodes[i]
        coordinates  [nodes][dimension], which some preconditioners use: on all ranks or on none

        A rank may have no nodes. Nodes of the mesh that are in no part have no stiffness. A pair of nodes that an
        interface joins is best in one part."""
        self._set("delam_petsc_set_part", nodes, matrix, coordinates, dimension)

    def set_rows(self, nodes: ArrayLike, matrix: object, coordinates: ArrayLike | None = None,
                 dimension: int = 3) -> None:
        """Rows of the assembled stiffness of the bodies, without supports, in place of set_part.

        nodes        those whose rows this rank has, in the numbers of set_part; each on one rank only
        matrix       a delam.Sparse or a matrix of scipy.sparse in rows (CSR), both triangles; row dimension * i +
                     component of nodes[i], column dimension * node + component for nodes of any rank
        coordinates  [nodes][dimension]: on all ranks or on none

        A rank may have no nodes. All rows together have to be symmetric, which is checked, with a positive diagonal.
        PETSc's option -delam_pc_type bddc is refused."""
        # Columns in the place of rows are for symmetric matrices alone.
        if getattr(matrix, "format", "csr") == "csc":
            matrix = matrix.tocsr()  # type: ignore[attr-defined]
        self._set("delam_petsc_set_rows", nodes, matrix, coordinates, dimension)

    def _set(self, function: str, nodes: ArrayLike, matrix: object, coordinates: ArrayLike | None,
             dimension: int) -> None:
        def arrays() -> tuple[Any, ...]:
            count = indices("nodes", nodes)
            size = count.size * integer("dimension", dimension, 32)
            row_starts, columns, values = _rows_of(matrix)
            row_starts = indices("row_starts", row_starts, (size + 1,))
            values = floats("values", values, (None,))
            columns = indices("columns", columns, (values.size,))
            if row_starts[-1] != values.size:
                raise ArgumentError(f"row_starts[{size}] = {row_starts[-1]}, expected {values.size}, the number of "
                                    f"values")
            places = None if coordinates is None else floats("coordinates", coordinates, (count.size, dimension))
            return count, places, row_starts, columns, values

        count, places, *rows = self._together(arrays)
        self._call(getattr(self._library, function), dimension, count.size, pointer(count), pointer(places),
                   *map(pointer, rows))

    def set_cells(self, problem: Problem | None, nodes: ArrayLike | None = None) -> None:
        """The stiffness of cells that this rank has described with delam, in place of set_part.

        problem  of a mesh of this rank's own, with materials but no interfaces, supports or loads, which are those of
                 rank 0's problem, over bodies without cells. None: this rank has no cells
        nodes    for each node of this mesh its number for set_part; each once

        Eigenstrains are refused as loads are."""
        def handles() -> tuple[Any, Any, Any]:
            if problem is None and nodes is None:
                return None, None, None
            if not isinstance(problem, Problem):
                raise ArgumentError(f"problem = {problem!r}, expected a Problem, or None without nodes")
            mesh, own = (ctypes.cast(one._handle, c_void_p) for one in (problem.mesh, problem))
            return mesh, own, indices("nodes", nodes)

        mesh, own, numbers = self._together(handles)
        self._call(self._library.delam_petsc_set_cells, mesh, own, 0 if numbers is None else numbers.size,
                   pointer(numbers), problem=problem)

    def take_scene(self, mesh: Mesh | None, problem: Problem | None) -> None:
        """Divides the cells of rank 0's mesh among the ranks, in place of set_part. None on the other ranks; the
        problem has to be complete but for its loads."""
        handles = self._together(lambda: (self._first("mesh", mesh, Mesh), self._first("problem", problem, Problem)))
        self._call(self._library.delam_petsc_take_scene, *handles, problem=self._only_first(problem))

    def take_cells(self, mesh: Mesh | None, problem: Problem | None, ranks: ArrayLike | None = None) -> None:
        """Takes the scene as take_scene does, with a partition of the host's own. ranks: on rank 0, the rank of each
        cell of the mesh. Cells on the two sides of an interface are best on one rank."""
        def arguments() -> tuple[Any, ...]:
            handles = self._first("mesh", mesh, Mesh), self._first("problem", problem, Problem)
            given = gate("ranks", ranks, "int32", (None,)) if self.rank == 0 else None
            return *handles, 0 if given is None else given.size, given

        *handles, given = self._together(arguments)
        self._call(self._library.delam_petsc_take_cells, *handles, pointer(given), problem=self._only_first(problem))

    # ---- work

    def attach(self, problem: Problem | None) -> None:
        """The ranks solve the bodies of rank 0's problem from now on, in solvers that are made, and work, in `run`.
        None on the other ranks."""
        handle = self._together(lambda: self._first("problem", problem, Problem))
        self._call(self._library.delam_petsc_attach, handle, problem=self._only_first(problem))

    def run(self, function: Callable[[], Any] | None = None) -> Any:
        """Calls function() on rank 0, which may use everything of the package, and of these Ranks `everywhere`,
        `recover` and the fields of its part, while the other ranks work for it. Returns its result on rank 0, None on
        the others. What it raises is raised on all ranks: a DelamError as such, another exception as WorkError (on rank
        0 with the exception as its cause). What is no Exception, such as KeyboardInterrupt, is raised again on rank 0
        and is a WorkError on the others."""
        handle = self._handle
        results: list[Any] = []
        failures: list[BaseException] = []

        @_WORK  # type: ignore[misc]
        def work(_: object) -> int:
            try:
                results.append(function())  # type: ignore[misc]  # None is for the other ranks
            except BaseException as exception:
                failures.append(exception)
                status = exception.status if isinstance(exception, DelamError) else 0
                return status or raw.DELAM_ERROR_INTERNAL
            return raw.DELAM_OK

        self._running = True
        try:
            status = self._library.delam_petsc_run(handle, work, None)
        finally:
            self._running = False
        if status == raw.DELAM_OK:
            return results[0] if self.rank == 0 else None
        failure = failures[0] if failures else None
        told = None
        if failure is not None:
            ours = isinstance(failure, DelamError)
            told = (getattr(failure, "status") if ours and not isinstance(failure, WorkError) else None,
                    str(failure) if ours else f"{type(failure).__name__}: {failure}", getattr(failure, "_task", None))
        told = self._comm.bcast(told)
        if told is None:
            self._raise(error_of(status, self._message()))
        known, message, task = told
        if failure is not None and (isinstance(failure, DelamError) or not isinstance(failure, Exception)):
            self._agreed = failure
            raise failure
        if self.rank != 0 and task is not None and task == self._tasks:
            failure = self._raised  # of this rank's share of the task that failed
        self._raise(WorkError(message) if known is None else error_of(known, message), failure)

    # ---- what all ranks do in the work of rank 0

    def set_task(self, function: Callable[[Any], object]) -> None:
        """Sets the function that this rank calls in `everywhere`, as function(data). It may communicate with the other
        ranks and read the fields of its part, but not solve. All ranks call this."""
        def checked() -> None:
            if not callable(function):
                raise ArgumentError(f"function = {function!r}, expected one that can be called")

        self._together(checked)

        @_TASK  # type: ignore[misc]
        def task(size: int, data: Any, _: object) -> int:
            self._tasks += 1
            self._raised = None
            try:
                function(pickle.loads(ctypes.string_at(data, size)))
            except BaseException as exception:
                self._raised = exception
                ours = isinstance(exception, DelamError)
                told = str(exception) if ours else f"{type(exception).__name__}: {exception}"
                self._library.delam_petsc_explain(self._pointer, told.encode())
                return int(getattr(exception, "status") if ours else 0) or raw.DELAM_ERROR_INTERNAL
            return raw.DELAM_OK

        self._call(self._library.delam_petsc_set_task, task, None)
        self._task = task

    def everywhere(self, data: object = None) -> None:
        """On rank 0, in the function of `run`: all ranks call their task with these data, which pickle can copy, rank 0
        as well. Raises what the lowest rank has raised: a DelamError, or WorkError where it was none or an internal
        error; on rank 0 with the original as its cause, if rank 0 is that rank. The function of `run` may catch it and
        go on; if it does not, `run` raises the same on all ranks. What is no Exception is raised as such on rank 0. In
        a task that communicates, all ranks have to agree first that none has failed: they would wait for it for
        ever."""
        self._check_open()
        copied = np.frombuffer(pickle.dumps(data), dtype=np.uint8)
        self._raised = None
        status = self._library.delam_petsc_everywhere(self._pointer, copied.size, pointer(copied))
        own = self._raised
        if own is not None and (isinstance(own, DelamError) or not isinstance(own, Exception)):
            raise own
        if status != raw.DELAM_OK:
            message = self._message()
            error = WorkError(message) if status == raw.DELAM_ERROR_INTERNAL else error_of(status, message)
            error._task = self._tasks  # type: ignore[attr-defined]
            raise error from own

    def recover(self, solver: Solver) -> None:
        """On rank 0, in the function of `run`: each rank recovers the displacements of the solver's present state at
        the nodes of its part, for `part_field`, and keeps them until the next call. No rank gets all of them. Ctrl-C
        is raised when it has ended."""
        if not isinstance(solver, Solver):
            raise ArgumentError(f"solver = {solver!r}, expected a Solver")
        self._check_open()
        status, told = solver.context.beside(self._library.delam_petsc_recover, self._pointer,
                                             ctypes.cast(solver._handle, c_void_p))
        if status != raw.DELAM_OK:
            message = self._message()
            raise error_of(status, f"{message}: {told}" if told else message)

    def part_nodes(self) -> tuple[NDArray[np.int64], NDArray[np.bool_]]:
        """Nodes of the fields of this rank, after `recover`: those of its part in their order (delam/petsc.h), on
        rank 0 also those of the mesh that no part has; and which of them this rank owns, exactly one of those that have
        it."""
        count = c_int64()
        self._here(self._library.delam_petsc_part_nodes, 0, None, None, ctypes.byref(count))
        nodes, owned = np.empty(count.value, dtype=np.int64), np.empty(count.value, dtype=np.int32)
        self._here(self._library.delam_petsc_part_nodes, count.value, pointer(nodes), pointer(owned), None)
        return nodes, owned != 0

    def part_cells(self) -> NDArray[np.int64]:
        """Cells of this rank in rank 0's mesh; none but after `take_scene`."""
        count = c_int64()
        self._here(self._library.delam_petsc_part_cells, 0, None, ctypes.byref(count))
        cells = np.empty(count.value, dtype=np.int64)
        self._here(self._library.delam_petsc_part_cells, count.value, pointer(cells), None)
        return cells

    def part_field(self, name: str) -> NDArray[np.float64]:
        """Returns a field of the state recovered last (`recover`), on this rank alone: "displacement" and "force" (K u)
        at the nodes of `part_nodes`, "stress" and "rotation" of the cells of `part_cells`, as the fields of a solver
        have them."""
        key, rows, columns = text("name", name), c_int64(), c_int64()
        field = self._library.delam_petsc_part_field
        self._here(field, key, 0, None, ctypes.byref(rows), ctypes.byref(columns))
        values = np.empty((rows.value, columns.value))
        self._here(field, key, values.size, pointer(values), None, None)
        return values

    # ---- numbers

    def value(self, name: str) -> float:
        """A number by its name, of all ranks; include/delam/petsc.h lists them."""
        number = c_double()
        self._call(self._library.delam_petsc_value, text("name", name), ctypes.byref(number))
        return number.value
