# SPDX-License-Identifier: BSD-3-Clause
"""Load steps, and the results of their states."""
from __future__ import annotations

import contextlib
import ctypes
import os
import warnings
from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any, NoReturn, overload

import numpy as np
from numpy.typing import ArrayLike

from ._base import raw
from ._base.arrays import FloatArray, floats, listed, pointer
from ._base.call import Object, integer, logger, number, text
from ._base.errors import ArgumentError, DelamError, NotConverged, NotConvergedWarning
from ._base.library import library
from ._base.records import Average, Condensed, Fronts, Jump, PlanItem, Sparse, ValueInfo
from ._base.words import in_python, meant
from ._exchange.grids import solver_grid
from .history import History, steps_of
from .mesh import Body, Interface, interface_index
from .options import unknown
from .problem import Pattern, Problem, pattern_index

if TYPE_CHECKING:
    import meshio

__all__ = ["Average", "Condensed", "FIELDS", "Fronts", "Jump", "PlanItem", "Solver", "ValueInfo", "Values"]

# Fields of a state and what they are over.
FIELDS = {"displacement": "nodes", "stress": "cells", "rotation": "cells", "jump": "pairs", "traction": "pairs",
          "adhesion": "pairs", "mixity": "pairs", "contact": "pairs", "reaction": "constraints",
          "free_since": "bodies", "free_motion": "bodies", "mesh_error": "cells"}
# Other programs use these names for fields.
_SYNONYMS = {"damage": "'adhesion', which is 1 - damage", "zeta": "'adhesion'", "opening": "'jump'"}


def _encoded(path: str | os.PathLike[str]) -> bytes:
    """A path in the encoding of the file system."""
    try:
        encoded = os.fsencode(path)
    except TypeError:
        raise ArgumentError(f"path = {path!r} is a {type(path).__name__}, expected a str or os.PathLike") from None
    if b"\0" in encoded:
        raise ArgumentError(f"path = {path!r} contains a zero character")
    return encoded


class Values(Mapping[str, float]):
    """Scalars of the state described, by name; computed on access. KeyError: there is none of this name. The state
    described is the step that look() has selected, otherwise the pending state, or the committed one if no step is
    pending."""

    def __init__(self, solver: Solver, keys: dict[str, bytes]) -> None:
        self._solver = solver
        self._keys = keys

    def __getitem__(self, name: str) -> float:
        key = self._keys.get(name) or self._keys.get(self._solver._aliased().get(name, ""))
        if key is None:
            raise unknown(name, (*self._keys, *self._solver._aliased()), "value")
        out = ctypes.c_double()
        self._solver._call(library.delam_solver_value, key, out)
        return out.value

    def __iter__(self) -> Iterator[str]:
        return iter(self._keys)

    def __len__(self) -> int:
        return len(self._keys)

    def __contains__(self, name: object) -> bool:
        return name in self._keys or name in self._solver._aliased()

    def __reduce__(self) -> NoReturn:
        raise TypeError("Values read the solver in this process and cannot be pickled or copied: use "
                        "dict(solver.values) of this state, or a History, whose rows can be")

    def describe(self) -> dict[str, ValueInfo]:
        """Describes each value: {name: ValueInfo}."""
        return self._solver._described()

    def __repr__(self) -> str:
        return f"<Values: {', '.join(self._keys)}>"


class Solver(Object):
    """The state of a problem from time `time` on. Takes a copy of the problem.

        solver.advance(0.05)        # pending: results can be read
        solver.commit()             # kept, or solver.rollback()

    not_converged: the effect of a step that reaches an iteration limit: "warn" (NotConvergedWarning, the step is
    pending), "raise" (NotConverged, pending too) or "ignore". An interrupted call (Ctrl-C, or an exception from a
    callback) restores the state before it. `problem` is the problem given.

    like: an earlier solver of this problem, whose condensed bodies this one shares if only laws, initial adhesion and
    options have changed since. Results are the same digit by digit, and a trial of a fit costs less."""

    problem: Problem
    not_converged: str
    _instead = ("Use save(), whose bytes can be pickled or written to a file, and load() them into a Solver of an "
                "equal problem: it continues bit for bit.")

    def __init__(self, problem: Problem, time: float = 0.0, not_converged: str = "warn",
                 like: Solver | None = None) -> None:
        if not_converged not in ("warn", "raise", "ignore"):
            raise ArgumentError(f"not_converged = {not_converged!r}, expected 'warn', 'raise' or 'ignore'")
        if not isinstance(problem, Problem):
            raise ArgumentError(f"problem = {problem!r}, expected a Problem")
        if like is not None and not isinstance(like, Solver):
            raise ArgumentError(f"like = {like!r}, expected a Solver or None")
        self.not_converged = not_converged
        create = library.delam_solver_create if like is None else library.delam_solver_create_like
        others = () if like is None else (like._handle,)
        outcome = self._make(problem.context, raw.delam_solver, library.delam_solver_destroy, create, problem._handle,
                             *others, number("time", time), keep=problem._keep, long=True,
                             outcomes=(raw.DELAM_NOT_CONVERGED,))
        self.problem = problem
        self._patterns = problem.patterns  # at creation: the solver stays usable when the problem is closed
        count = ctypes.c_int64()
        self._call(library.delam_solver_value_count, count)
        names = (self.context.text(library.delam_solver_value_name, self._pointer, i) or "" for i in range(count.value))
        self._keys = {name: name.encode() for name in names}
        self._infos: dict[str, ValueInfo] | None = None
        self._aliases: dict[str, str] | None = None
        self._warn_of_bare_interfaces()
        self._outcome(outcome, 3)

    def shares_bodies(self, problem: Problem) -> bool:
        """Tells whether Solver(problem, like=self) would share the condensed bodies of this solver."""
        shares = ctypes.c_int32()
        self._call(library.delam_solver_shares_bodies, problem._handle, shares)
        return bool(shares.value)

    def _warn_of_bare_interfaces(self) -> None:
        """Warns of interfaces that have a law, but no pair that holds from the start."""
        counts = self.problem._pair_counts
        adhesion = np.empty(sum(counts))
        self._call(library.delam_solver_field, b"adhesion", -1, adhesion.size, pointer(adhesion))
        for i, part in enumerate(np.split(adhesion, np.cumsum(counts)[:-1])):
            if i in self.problem._adhesive and not part.any():
                logger.warning("interface %d has a law, but none of its %d pairs has any adhesion: a notch takes some "
                               "of them (Problem.set_adhesion); faces that only touch need Problem.set_contact",
                               i, part.size)

    def _call(self, function: Any, *arguments: Any, long: bool = False) -> None:
        self.context.call(function, self._handle, *arguments, long=long)

    def _described(self) -> dict[str, ValueInfo]:
        """Returns the descriptions of all values, which it asks for once."""
        if self._infos is None:
            texts, recorded = [ctypes.c_char_p() for _ in range(5)], ctypes.c_int32()
            infos = {}
            for i, name in enumerate(self._keys):
                self._call(library.delam_solver_value_info, i, *texts, recorded)
                alias, unit, cost, scope, meaning = (in_python((item.value or b"").decode()) for item in texts)
                infos[name] = ValueInfo(alias, unit, cost, scope, meaning, bool(recorded))
            self._infos = infos
        return self._infos

    def _aliased(self) -> dict[str, str]:
        """{alias: name} of values: those of the library and, of a single pattern, the command line's names."""
        if self._aliases is None:
            found = {info.alias: name for name, info in self._described().items() if info.alias}
            if len(self._patterns) == 1:
                found.update((kind, f"{kind}:{self._patterns[0]}") for kind in ("load", "reaction"))
            self._aliases = {alias: name for alias, name in found.items() if alias not in self._keys}
        return self._aliases

    @property
    def _pattern_count(self) -> int:
        """Number at the solver's creation; its problem may have more by now."""
        return sum(name.startswith("load:") for name in self._keys)

    def _outcome(self, outcome: tuple[int, str], level: int) -> None:
        status, message = outcome
        if status == raw.DELAM_NOT_CONVERGED:
            if self.not_converged == "raise":
                raise NotConverged(message)
            if self.not_converged == "warn":
                warnings.warn(message, NotConvergedWarning, stacklevel=level)

    def __repr__(self) -> str:
        if self.closed:
            return "<Solver, closed>"
        return f"<Solver at time {self.time:g}{', a step is pending' if self.pending else ''}>"

    @property
    def values(self) -> Values:
        """Scalars by name, a mapping; values.describe() says what each is, with its unit."""
        return Values(self, self._keys)

    # ---- steps

    @property
    def pending(self) -> bool:
        """True if a step is pending, to be committed or rolled back."""
        out = ctypes.c_int32()
        self._call(library.delam_solver_pending, out)
        return bool(out.value)

    def _whole(self, function: Any, *arguments: Any, long: bool = True) -> tuple[int, str]:
        """Calls a function that changes the state; Ctrl-C is raised after it."""
        return self.context.call(function, self._handle, *arguments, whole=True, long=long,
                                 outcomes=(raw.DELAM_NOT_CONVERGED,))

    def _step(self, function: Any, *arguments: Any) -> None:
        already = self.pending
        try:
            outcome = self._whole(function, *arguments)
        except BaseException:
            # The step had finished when the interruption was noticed.
            if self.pending and not already:
                self.rollback()
            raise
        self._outcome(outcome, 4)

    def advance(self, time: float) -> None:
        """One load step to `time`, pending. StateError: a step is pending already; ArgumentError: the time does not lie
        after the committed one; NumericalError: a factorisation broke down; LimitReached: there is no equilibrium."""
        self._step(library.delam_solver_advance, number("time", time))

    def equilibrate(self, time: float, adhesion: ArrayLike | None = None) -> None:
        """Displacements of least energy at `time` with fixed adhesion of all pairs, [pairs] interface after interface;
        None: the committed one. Pending like a step."""
        fixed = None if adhesion is None else floats("adhesion", adhesion, (self._shape("adhesion", -1)[0],))
        self._step(library.delam_solver_equilibrate, number("time", time), pointer(fixed))

    def commit(self) -> None:
        """Keeps the pending step. StateError: there is none."""
        self._whole(library.delam_solver_commit, long=False)

    def rollback(self) -> None:
        """Restores the state before the pending step, bit for bit. StateError: there is none."""
        self._whole(library.delam_solver_rollback, long=False)

    def set_history(self, pattern: int | str | Pattern, times: ArrayLike, values: ArrayLike) -> None:
        """Changes the history of a load pattern from the committed time on: linear from the factor there to values[0]
        at times[0] and through the further points, constant after the last; [n] both. It is saved with the state."""
        times = floats("times", listed(times), (None,))
        values = floats("values", listed(values), (times.size,))
        self._call(library.delam_solver_set_history, pattern_index(pattern, self.problem, self._patterns), times.size,
                   pointer(times), pointer(values))

    def march(self, times: Iterable[float], values: Iterable[str] | None = None,
              progress: bool = False) -> Iterator[dict[str, float]]:
        """Advances and commits, time after time; yields a dict of values after each step.

        times: each after the one before; if the first is the committed time, the present state is yielded without a
        step, so that linspace(0, 1, 11) makes 10 steps. values: names, None for all but the costly ones. progress: a
        bar (tqdm's if it is installed, also in notebooks) on standard error. A step that raises is rolled back. With
        option backtracking a step may replace earlier ones: value revised_from is the first of those, look() reads
        them; history() does so by itself."""
        names = self._names(values)
        for i, time in enumerate(steps_of(times, progress)):
            if i == 0 and not self.pending and number("time", time) == self.time:
                yield {name: self.values[name] for name in names}
                continue
            try:
                self.advance(time)
                self.commit()
            except BaseException:
                if self.pending and not self.closed:
                    self.rollback()
                raise
            yield {name: self.values[name] for name in names}

    def history(self, times: Iterable[float], values: Iterable[str] | None = None,
                progress: bool = False) -> History:
        """Runs the analysis and returns the History of all steps, with the present state as its first row.

        times, values, progress: as of march; with one pattern, values may be "load" and "reaction".

        Whatever ends it early (Ctrl-C, Cancelled, LimitReached, an error) carries the rows so far:

            try:
                history = solver.history(times)
            except KeyboardInterrupt as stop:
                history = stop.history

        In a notebook or at a prompt, sys.last_value.history has them. The solver stands at the last of these rows."""
        history = History(self, values)
        try:
            for _ in self.march(times, (), progress):
                history.record()
        except BaseException as error:
            # The stop may have come between a commit and its row.
            with contextlib.suppress(DelamError):
                history.record()
            setattr(error, "history", history)
            error.add_note(f"The {len(history)} rows up to time {history._column('time')[-1]:g} are kept: attribute "
                           f"history of this exception.")
            raise
        return history

    def record(self, *names: str) -> None:
        """Records these values for the committed state and, with each later commit, for every further step, including
        steps that returns replace; save() saves them. Any values but the costly ones and the counts over the solver's
        life."""
        for name in map(self._checked, names):
            self._call(library.delam_solver_record, text("name", self._aliased().get(name, name)))

    @property
    def recorded_steps(self) -> range:
        """Range of the recorded steps, up to the committed one."""
        first, count = ctypes.c_int64(), ctypes.c_int64()
        self._call(library.delam_solver_recorded_size, first, count)
        return range(first.value, first.value + count.value)

    def recorded(self, name: str) -> FloatArray:
        """[recorded_steps]: a recorded value for each step; NaN for steps before record(). ArgumentError: it is not
        recorded."""
        out = np.empty(len(self.recorded_steps))
        key = self._aliased().get(name, name) if isinstance(name, str) else name
        self._call(library.delam_solver_recorded, text("name", key), out.size, pointer(out))
        return out

    def _names(self, values: Iterable[str] | None) -> tuple[str, ...]:
        if values is None:
            # A history has what recovers the displacements only when it is asked for.
            return tuple(name for name, info in self._described().items() if info.cost != "recovers")
        if isinstance(values, str):
            raise ArgumentError(f"values = {values!r} is a str, expected names in a list: [{values!r}]")
        return tuple(self._checked(name) for name in values)

    def _checked(self, name: str) -> str:
        """The name of a value, or an alias."""
        if name not in self.values:
            raise unknown(name, (*self._keys, *self._aliased()), "value")
        return name

    @property
    def time(self) -> float:
        """Time of the state described (Values)."""
        return self.values["time"]

    def look(self, step: int) -> None:
        """Selects the state described: an earlier step (option backtracking); -1: the pending or committed one
        again."""
        self._call(library.delam_solver_look, integer("step", step))

    @contextlib.contextmanager
    def looking(self, step: int) -> Iterator[Solver]:
        """with solver.looking(3): values and fields of step 3."""
        self.look(step)
        try:
            yield self
        finally:
            self.look(-1)

    # ---- the committed state, as bytes or as a file

    @overload
    def save(self, path: None = None) -> bytes: ...

    @overload
    def save(self, path: str | os.PathLike[str]) -> None: ...

    def save(self, path: str | os.PathLike[str] | None = None) -> bytes | None:
        """Returns the committed state as bytes, or writes them to a file, which replaces `path` when it is complete and
        on disk. FileError says why it could not be written."""
        if path is not None:
            self._call(library.delam_solver_save_file, _encoded(path))
            return None
        needed = ctypes.c_int64()
        self._call(library.delam_solver_save, 0, None, needed)
        out = np.empty(needed.value, np.uint8)
        self._call(library.delam_solver_save, out.size, pointer(out), needed)
        return out.tobytes()

    def load(self, state: bytes | bytearray | memoryview | str | os.PathLike[str]) -> None:
        """Continues from a state of the same scene and options: saved bytes, or the path (str, os.PathLike) of a file
        with them. Discards a pending step. SnapshotError: damaged, or of another scene or version; FileError: not
        readable."""
        if isinstance(state, (str, os.PathLike)):
            self._whole(library.delam_solver_load_file, _encoded(state))
            return
        try:
            data = np.frombuffer(state, np.uint8)
        except (TypeError, ValueError, BufferError) as error:
            raise ArgumentError(f"state: {error}") from None
        self._whole(library.delam_solver_load, data.size, pointer(data))

    # ---- fields

    def _shape(self, name: str, part: int) -> tuple[int, int]:
        rows, columns = ctypes.c_int64(), ctypes.c_int64()
        self._call(library.delam_solver_field_shape, text("name", name), part, rows, columns)
        return rows.value, columns.value

    def field(self, name: str, interface: int | Interface | None = None) -> FloatArray:
        """A field of the state described (Values): [rows][columns], or [rows] if there is one column.

        Over nodes: displacement [nodes][dimension], lengths. Over cells: stress [cells][6] (xx, yy, zz, xy, yz, zx; in
        2D [cells][4], the first four), rotation. Over pairs of an interface, None for all one after another: jump and
        traction [pairs][dimension] (normal, tangents; lengths and stresses), adhesion, mixity and contact [pairs]. Over
        constraints: reaction. ArgumentError: there is no such field, or it is none of an interface."""
        over = FIELDS.get(name) if isinstance(name, str) else None
        if over is None:
            near = f" (did you mean {_SYNONYMS[name]}?)" if name in _SYNONYMS else meant(name, FIELDS)
            raise ArgumentError(f"field {name!r} is not known{near}; known are {', '.join(FIELDS)}")
        if interface is not None and over != "pairs":
            of_pairs = ", ".join(field for field, where in FIELDS.items() if where == "pairs")
            raise ArgumentError(f"field {name!r} is one over all {over} and takes no interface, but {interface!r} was "
                                f"given; those of an interface are {of_pairs}")
        part = -1 if interface is None else interface_index(interface, self.problem.mesh)
        rows, columns = self._shape(name, part)
        out = np.empty((rows, columns) if columns > 1 else rows)
        self._call(library.delam_solver_field, text("name", name), part, out.size, pointer(out), long=True)
        return out

    def displacement(self, node: int) -> FloatArray:
        """Displacement of one node in the state described (Values), [dimension], lengths: a gauge. Where the bodies are
        condensed, those of the others are not recovered. ArgumentError: there is no such node."""
        nodes = self.problem.mesh.node_count
        if isinstance(node, bool) or not isinstance(node, (int, np.integer)) or not 0 <= node < nodes:
            raise ArgumentError(f"node is {node!r}, allowed: 0 to {nodes - 1}")
        out = np.empty(self.problem.dimension)
        self._call(library.delam_solver_field, b"displacement", int(node), out.size, pointer(out), long=True)
        return out

    def average(self, body: Body | None = None) -> Average:
        """Volume, average strain and average stress of a body; None: of all."""
        volume, strain, stress = ctypes.c_double(), np.empty(6), np.empty(6)
        self._call(library.delam_solver_average, self.problem.mesh._chosen(body), volume, pointer(strain),
                   pointer(stress), long=True)
        return Average(volume.value, strain, stress)

    def fronts(self, interface: int | Interface = 0) -> Fronts:
        """The fronts of the cracks of an interface in the state described (Values)."""
        interface = interface_index(interface, self.problem.mesh)
        fronts, points = ctypes.c_int64(), ctypes.c_int64()
        self._call(library.delam_solver_front_count, interface, fronts, points)
        m, n, dimension = fronts.value, points.value, self.problem.dimension
        out = Fronts(np.zeros(m + 1, np.int64), np.empty(m, np.int32), np.empty((n, dimension)),
                     np.empty((n, dimension)), np.empty(n), np.empty((n, 3)), np.empty(n), np.empty(n))
        self._call(library.delam_solver_front, interface, m, n, *(pointer(array) for array in out))
        return out._replace(closed=out.closed.astype(bool))

    def tangent(self) -> FloatArray:
        """[patterns][patterns]: change of reactions with factors at fixed adhesion and contact; symmetric."""
        out = np.empty((self._pattern_count,) * 2)
        self._call(library.delam_solver_tangent, out.size, pointer(out), long=True)
        return out

    def step_tangent(self) -> FloatArray:
        """[patterns][patterns]: change of reactions with factors at the end of the pending step, damage included.
        StateError: no step is pending."""
        out = np.empty((self._pattern_count,) * 2)
        self._call(library.delam_solver_step_tangent, out.size, pointer(out), long=True)
        return out

    def condensed(self) -> Condensed:
        """The operator of the steps, for hosts that condense: a Condensed. StateError: the solver uses FETI, which has
        none."""
        unknowns, entries = ctypes.c_int64(), ctypes.c_int64()
        self._call(library.delam_solver_condensed_size, unknowns, entries)
        pairs, dimension = self._shape("jump", -1)
        n, rows, patterns = unknowns.value, pairs * dimension, self._pattern_count
        jump = Sparse((rows, n), np.empty(rows + 1, np.int64), np.empty(entries.value, np.int64),
                      np.empty(entries.value))
        out = Condensed(np.empty((n, n)), np.empty((patterns, n)), np.empty((patterns, patterns)), jump,
                        np.empty((rows, patterns)))
        self._call(library.delam_solver_condensed, n * n, *(pointer(array) for array in out[:3]),
                   *(pointer(array) for array in jump[1:]), pointer(out.offset), long=True)
        return out

    def to_meshio(self) -> meshio.Mesh:
        """The bodies of the state described (Values) as a meshio.Mesh: displacement [nodes][3] as point data, stress
        [cells][6] and bodies as cell data; to_meshio().write("now.vtu") is for ParaView."""
        return solver_grid(self).to_meshio()

    def to_vtk(self) -> Any:
        """The same as a vtkUnstructuredGrid. ImportError: VTK is not installed."""
        return solver_grid(self).to_vtk()

    def to_pyvista(self) -> Any:
        """The same as a pyvista.UnstructuredGrid. ImportError: PyVista is not installed."""
        return solver_grid(self).to_pyvista()

    # ---- reports

    @property
    def plan(self) -> str:
        """The parts of the method that the scene needs and those left out, as text."""
        return self.context.text(library.delam_solver_plan, self._handle) or ""

    @property
    def plan_items(self) -> list[PlanItem]:
        """The parts of the plan, one by one."""
        count = ctypes.c_int64()
        self._call(library.delam_solver_plan_count, count)
        items = []
        for i in range(count.value):
            texts = [ctypes.c_char_p() for _ in range(4)]
            cost, saving = ctypes.c_double(), ctypes.c_double()
            self._call(library.delam_solver_plan_item, i, *texts[:3], cost, saving, texts[3])
            subject, decision, reason, unit = ((text.value or b"").decode() for text in texts)
            items.append(PlanItem(subject, decision, reason, cost.value, saving.value, unit))
        return items

    def option(self, key: str) -> str:
        """Value of an option as text, as copied by the solver. KeyError: there is none of this key."""
        value = self.context.text(library.delam_solver_option, self._handle, text("key", key))
        if value is None:
            raise unknown(key, tuple(self.problem.options), "option")
        return value

    @property
    def searched(self) -> str:
        """Returns, as text, the states that the energetic search of the last step compared."""
        return self.context.text(library.delam_solver_searched, self._handle) or ""

    @property
    def jumps(self) -> list[Jump]:
        """Jumps of the state, in the order of time."""
        return self._jumps(0)

    def _jumps(self, first: int) -> list[Jump]:
        """Returns the jumps from the given one on."""
        count = ctypes.c_int64()
        self._call(library.delam_solver_jump_count, count)
        jumps = []
        for i in range(first, count.value):
            out: list[Any] = [ctypes.c_int64(), *(ctypes.c_double() for _ in range(6)),
                              *(ctypes.c_int64() for _ in range(3))]
            self._call(library.delam_solver_jump, i, *out)
            reactions = [np.empty(self._pattern_count) for _ in range(2)]
            self._call(library.delam_solver_jump_reactions, i, self._pattern_count, *map(pointer, reactions))
            jumps.append(Jump(*(item.value for item in out), *reactions))
        return jumps
