# SPDX-License-Identifier: BSD-3-Clause
"""The scene: a mesh with materials, laws, supports, loads and options."""
from __future__ import annotations

import collections.abc
import ctypes
import weakref
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ._base import raw
from ._base.arrays import direction as axis
from ._base.arrays import FloatArray, IntArray, floats, indices, listed, ndim, pointer, spread
from ._base.call import Context, Object, integer, number, text
from ._base.errors import ArgumentError, DelamError
from ._base.library import library
from ._base.records import Forecast, Proposal, Sparse
from ._base.words import meant
from .law import Law
from .mesh import Body, Interface, Mesh, interface_index, place_text
from .options import Options, initial_values

__all__ = ["Drive", "Forecast", "Pattern", "Problem", "Proposal", "Sparse", "pattern_index"]


def _rows_of(matrix: Any) -> tuple[Any, Any, Any]:
    """row_starts, columns and values of a Sparse or of a class with SciPy's attribute names. Compressed columns work
    too, because the stiffness is symmetric."""
    if isinstance(matrix, Sparse):
        return matrix.row_starts, matrix.columns, matrix.values
    if getattr(matrix, "format", "csr") not in ("csr", "csc") and hasattr(matrix, "tocsr"):
        matrix = matrix.tocsr()
    try:
        return matrix.indptr, matrix.indices, matrix.data
    except AttributeError:
        raise ArgumentError(f"matrix is a {type(matrix).__name__}, expected a delam.Sparse, a matrix of scipy.sparse, "
                            f"or another with indptr, indices and data") from None


class Pattern:
    """A load pattern of a problem, with its name and index; may be used wherever an index is expected."""

    def __init__(self, name: str, index: int, problem: Problem | None) -> None:
        self.name = name
        self.index = index
        self.problem = None if problem is None else weakref.ref(problem)

    def __reduce__(self) -> tuple[type[Pattern], tuple[str, int, None]]:  # pickled as its index
        return Pattern, (self.name, self.index, None)

    def __index__(self) -> int:
        return self.index

    def __repr__(self) -> str:
        return f"<Pattern {self.index}: {self.name}>"


# A drive prescribes a value: it is a pattern or its name, or {pattern: coefficient}.
Drive = str | Pattern | Mapping[Any, ArrayLike] | None
_DRIVES = ("the pattern that add_pattern returned, its name, {pattern: coefficient}, or None: held at zero; a value "
           "other than zero needs a pattern that reaches it, add_pattern(name, [0, 1], [0, value])")


def pattern_index(which: int | str | Pattern, problem: Problem, names: Sequence[str]) -> int:
    """Returns the index of a pattern of this problem, which is given by itself, one of the names, or its index."""
    if isinstance(which, str):
        if which not in names:
            raise ArgumentError(f"pattern {which!r} is not known{meant(which, names)}; known are "
                                f"{', '.join(names) or 'none'}")
        return names.index(which)
    if isinstance(which, Pattern) and which.problem is not None and which.problem() is not problem:
        raise ArgumentError(f"pattern {which.name!r} given is one of another problem")
    return integer("pattern", which)


class Problem(Object):
    """Takes a copy of the mesh.

    Bodies are chosen by label or by name (Mesh.body_names), None means all. Directions are vectors or axes ("x", "-y").

    `drive` says what prescribes a value: a pattern, the object that add_pattern returned or its name, whose factor is
    the value; a mapping {pattern: coefficient, or one per node}, whose sum it is; or None, held at zero. A number is
    refused: a value is a factor of a pattern, so that reactions belong to patterns.

    progress: a function (stage, done, total) called inside long work, on the calling thread; a true result cancels,
    except in calls that only read, such as fields. `mesh` is the mesh given, `dimension` 2 or 3.

    Units are whichever are consistent: with lengths in m and forces in N, stresses and stiffnesses are in Pa. In 2D all
    is per unit of width. ArgumentError names a value out of range or an array of the wrong shape, ProblemError (of
    check and Solver) what the scene lacks."""

    mesh: Mesh
    dimension: int
    _instead = ("Make it in each process from the arrays of its mesh and from its laws and loads; Solver.save() gives "
                "the state of a solver as bytes, for a solver of an equal problem to load().")

    def __init__(self, mesh: Mesh, plane: str | None = None,
                 progress: Callable[[str, int, int], object] | None = None) -> None:
        if not isinstance(mesh, Mesh):
            raise ArgumentError(f"mesh = {mesh!r}, expected a Mesh")
        context = Context()
        self._keep: list[Any] = []
        self._make(context, raw.delam_problem, library.delam_problem_destroy, library.delam_problem_create,
                   context.handle, mesh._handle, keep=self._keep, other=mesh.context)
        self.mesh = mesh
        self.dimension, self._node_count, self._cell_count = mesh._size()[:3]
        self._pair_counts = [interface.pair_count for interface in mesh.interfaces]
        self.progress = progress
        self._values = initial_values()
        self._adhesive: set[int] = set()  # the interfaces with laws
        self._drives: dict[int, str] = {}  # what each pattern drives, for pictures
        if plane is not None:
            self.set_plane(plane)

    def _call(self, function: Any, *arguments: Any, long: bool = False) -> None:
        self.context.call(function, self._handle, *arguments, long=long)

    @property
    def options(self) -> Options:
        """Options by key, a mapping; a solver copies them when it is made."""
        return Options(self, self._values)

    @property
    def progress(self) -> Callable[[str, int, int], object] | None:
        """The function (stage, done, total) that long work calls, or None; may be set at any time."""
        return self.context.progress

    @progress.setter
    def progress(self, function: Callable[[str, int, int], object] | None) -> None:
        if function is not None and not callable(function):
            raise ArgumentError(f"progress = {function!r} cannot be called")
        self.context.progress = function

    def __repr__(self) -> str:
        if self.closed:
            return "<Problem, closed>"
        primal, dual = self.dofs
        return f"<Problem in {self.dimension}D: {primal} displacements, {dual} of jumps, patterns {self.patterns}>"

    # ---- materials

    def set_plane(self, assumption: str) -> None:
        """"plane-strain" (initially) or "plane-stress"."""
        self._call(library.delam_problem_set_plane, text("assumption", assumption))

    def set_elastic(self, young: float, poisson: float, body: Body | None = None) -> None:
        """Isotropic elasticity: Young's modulus, a stress > 0, and Poisson's ratio in (-1, 0.5)."""
        self._call(library.delam_problem_set_elastic, self.mesh._chosen(body), number("young", young),
                   number("poisson", poisson))

    def set_orthotropic(self, constants: ArrayLike, body: Body | None = None) -> None:
        """E1 E2 E3 nu12 nu13 nu23 G12 G13 G23 in the material axes, moduli as stresses; nu_ij: contraction along j
        under tension along i."""
        constants = floats("constants", constants, (9,))
        self._call(library.delam_problem_set_orthotropic, self.mesh._chosen(body), pointer(constants))

    def set_orientation(self, axes: ArrayLike, cells: ArrayLike | None = None, body: Body | None = None) -> None:
        """Directions of the material axes 1 and 2 in space, [2][3] for all cells of the body or [cells][2][3]."""
        if cells is None:
            axes = floats("axes", axes, (2, 3))
            self._call(library.delam_problem_set_orientation, self.mesh._chosen(body), 1, None, pointer(axes), 0,
                       long=True)
            return
        of = indices("cells", cells, size=self._cell_count)
        if ndim(axes) == 2:
            axes = np.tile(floats("axes", axes, (2, 3)), (of.size, 1, 1))
        axes = floats("axes", axes, (of.size, 2, 3))
        self._call(library.delam_problem_set_orientation, self.mesh._chosen(body), of.size, pointer(of), pointer(axes),
                   0, long=True)

    def set_formulation(self, formulation: str, body: Body | None = None) -> None:
        """"incompatible" (initially, for bodies with quad4 or hex8), "standard" (initially, for others) or
        "mean-dilatation"."""
        self._call(library.delam_problem_set_formulation, self.mesh._chosen(body), text("formulation", formulation))

    def set_stiffness(self, nodes: ArrayLike, matrix: object, dofs: ArrayLike | None = None,
                      kernel: ArrayLike | None = None) -> None:
        """The stiffness of whole bodies as assembled by the host, in place of cells and material.

        nodes   all nodes of one or several bodies, indices or a mask
        matrix  a Sparse (body_matrix gives one) or a matrix of scipy.sparse, both triangles; duplicate entries
                are summed
        dofs    [nodes][dimension] row of each displacement; None: dimension * i + component of nodes[i]
        kernel  [motions][rows] without energy; None: the library finds them, []: there are none"""
        nodes = indices("nodes", nodes, size=self._node_count)
        size = nodes.size * self.dimension
        row_starts, columns, values = _rows_of(matrix)
        row_starts = indices("row_starts", row_starts, (size + 1,))
        values = floats("values", values, (None,))
        columns = indices("columns", columns, (values.size,))
        # The library reads as many entries as the last row ends with.
        if row_starts[-1] != values.size:
            raise ArgumentError(f"row_starts[{size}] = {row_starts[-1]}, expected {values.size}, the number of values")
        places = None if dofs is None else indices("dofs", dofs, (nodes.size, self.dimension))
        motions, rigid = -1, None
        if kernel is not None:
            rigid = floats("kernel", kernel, (None, size)) if np.size(kernel) else np.empty((0, size))
            motions = rigid.shape[0]
        self._call(library.delam_problem_set_stiffness, nodes.size, pointer(nodes), pointer(places),
                   pointer(row_starts), pointer(columns), pointer(values), motions, pointer(rigid), 0, long=True)

    # ---- interfaces

    def set_law(self, interface: int | Interface, law: Law) -> None:
        """Copies the law's present parameters. The adhesion does not change: 1, or the value of set_adhesion.
        ProblemError names the parameters that are missing."""
        if not isinstance(law, Law):
            raise ArgumentError(f"law = {law!r}, expected a Law")
        law._complete()
        hosted = self.context.hosted
        # Before the call, which may be interrupted after it has finished.
        if law._callbacks:
            self._keep.append(law._callbacks)
            self.context.hosted = True
        try:
            self.context.call(library.delam_problem_set_law, self._handle, interface_index(interface, self.mesh),
                              law._handle, other=law.context)
        except DelamError:
            self.context.hosted = hosted
            raise
        self._adhesive.add(interface_index(interface, self.mesh))

    def set_bonded(self, interface: int | Interface) -> None:
        """Perfectly and permanently bonded."""
        self._call(library.delam_problem_set_bonded, interface_index(interface, self.mesh))
        self._adhesive.discard(interface_index(interface, self.mesh))

    def set_contact(self, interface: int | Interface) -> None:
        """Faces without adhesion that may separate but not overlap."""
        self._call(library.delam_problem_set_contact, interface_index(interface, self.mesh))
        self._adhesive.discard(interface_index(interface, self.mesh))

    def set_adhesion(self, interface: int | Interface, pairs: ArrayLike, adhesion: ArrayLike = 0.0) -> None:
        """Initial adhesion in [0, 1] of some pairs, one for all or [pairs]; 0 makes a notch. pairs: indices or a mask;
        ArgumentError: there are none. A Solver warns of an interface that no pair holds."""
        interface = interface_index(interface, self.mesh)
        size = self._pair_counts[interface] if 0 <= interface < len(self._pair_counts) else None
        pairs = indices("pairs", pairs, size=size)
        if pairs.size == 0:
            where = ""
            if size and not self.mesh.closed:
                places = self.mesh.interfaces[interface].places
                where = f"; they lie from {place_text(places.min(0))} to {place_text(places.max(0))}"
            raise ArgumentError(f"pairs is empty, expected at least one of the {size} pairs of interface "
                                f"{interface}{where}")
        adhesion = spread("adhesion", adhesion, pairs.size)
        self._call(library.delam_problem_set_adhesion, interface, pairs.size, pointer(pairs), pointer(adhesion), 0)

    def set_adhesion_box(self, interface: int | Interface, lower: ArrayLike, upper: ArrayLike,
                         adhesion: float = 0.0) -> int:
        """Initial adhesion of the pairs in the box from lower to upper, [dimension] each; 0 makes a notch. Pairs
        exactly on a side beyond which the interface goes on are the tip of a crack and stay as they are. Returns the
        number of pairs in the box, which may be 0."""
        lower, upper = (floats(name, corner, (self.mesh.dimension,))
                        for name, corner in (("lower", lower), ("upper", upper)))
        count = ctypes.c_int64()
        self._call(library.delam_problem_set_adhesion_box, interface_index(interface, self.mesh), pointer(lower),
                   pointer(upper), number("adhesion", adhesion), count)
        return count.value

    # ---- supports and loads

    def add_pattern(self, name: str, times: ArrayLike, values: ArrayLike) -> Pattern:
        """A named factor that follows a piecewise-linear history, constant beyond its ends. times and
        values: [n], times ascending. ArgumentError: the name is taken."""
        times = floats("times", listed(times), (None,))
        values = floats("values", listed(values), (times.size,))
        index = ctypes.c_int64()
        self._call(library.delam_problem_add_pattern, text("name", name), times.size, pointer(times), pointer(values),
                   index)
        return Pattern(name, index.value, self)

    @property
    def patterns(self) -> list[str]:
        """Names of the patterns, in the order of their indices."""
        count = ctypes.c_int64()
        self._call(library.delam_problem_pattern_count, count)
        name = library.delam_problem_pattern_name
        return [self.context.text(name, self._handle, i) or "" for i in range(count.value)]

    def pattern(self, which: int | str | Pattern) -> int:
        """Index of a pattern: itself, its name or its index. ArgumentError: there is none of this name, or it is one of
        another problem."""
        return pattern_index(which, self, self.patterns if isinstance(which, str) else ())

    def _driven(self, drive: Drive, count: int | None = None) -> tuple[IntArray, FloatArray]:
        """Patterns and their coefficients, [count][patterns] or [patterns]."""
        if drive is None:
            drive = {}
        elif isinstance(drive, (str, Pattern)):
            drive = {drive: 1.0}
        elif not isinstance(drive, collections.abc.Mapping):
            raise ArgumentError(f"drive = {drive!r}, expected {_DRIVES}")
        for which in drive:
            # The number of a pattern would pass for a value or a time.
            if not isinstance(which, (str, Pattern)):
                raise ArgumentError(f"drive = {drive!r} has the key {which!r}, expected {_DRIVES}")
        patterns = np.array([self.pattern(which) for which in drive], np.int64)
        if count is None:
            coefficients = np.array([number(f"drive[{which!r}]", value) for which, value in drive.items()], np.float64)
        else:
            columns = [spread(f"drive[{which!r}]", value, count) for which, value in drive.items()]
            coefficients = np.ascontiguousarray(np.array(columns, np.float64).reshape(len(columns), count).T)
        if not np.isfinite(coefficients).all():
            raise ArgumentError(f"drive = {drive} must be finite")
        return patterns, coefficients

    def _nodes(self, nodes: ArrayLike) -> IntArray:
        """Nodes by index or mask, at least one."""
        found = indices("nodes", nodes, size=self._node_count)
        if found.size == 0:
            raise self.mesh._nothing("nodes")
        return found

    def prescribe(self, nodes: ArrayLike, direction: str | ArrayLike, drive: Drive = None) -> None:
        """Prescribes direction . u of each node, a length where the direction is a unit vector.

        nodes  indices or a mask; ArgumentError: there are none
        drive  what prescribes the value: a pattern, {pattern: coefficient, or one per node}, or None: held at zero;
               never a number (Problem says why)"""
        nodes = self._nodes(nodes)
        along = axis("direction", direction, self.dimension)
        patterns, coefficients = self._driven(drive, nodes.size)
        self._call(library.delam_problem_prescribe_nodes, nodes.size, pointer(nodes), pointer(along), patterns.size,
                   pointer(patterns), pointer(coefficients), 0, long=True)

    def prescribe_mean(self, nodes: ArrayLike, weights: ArrayLike, direction: str | ArrayLike,
                       drive: Drive = None) -> None:
        """Prescribes the weighted mean of direction . u over nodes; with the weights of Mesh.find_patch, a support
        spread over a patch. nodes: indices or a mask; drive: as of prescribe, with one coefficient for each pattern."""
        nodes = self._nodes(nodes)
        weights = floats("weights", weights, (nodes.size,))
        along = axis("direction", direction, self.dimension)
        patterns, coefficients = self._driven(drive)
        self._call(library.delam_problem_prescribe_mean, nodes.size, pointer(nodes), pointer(weights), pointer(along),
                   patterns.size, pointer(patterns), pointer(coefficients), 0, long=True)

    def add_equation(self, nodes: ArrayLike, coefficients: ArrayLike, drive: Drive = None) -> None:
        """sum_i coefficients[i] . u_nodes[i] = sum over patterns of drive * factor; coefficients: [nodes][dimension];
        drive: as of prescribe, with one coefficient for each pattern; None: the sum is zero."""
        nodes = indices("nodes", nodes)
        coefficients = floats("coefficients", coefficients, (nodes.size, self.dimension))
        patterns, prescribed = self._driven(drive)
        self._call(library.delam_problem_add_equation, nodes.size, pointer(nodes), pointer(coefficients), patterns.size,
                   pointer(patterns), pointer(prescribed), 0, long=True)

    def begin_constraints(self, first: int, count: int, time: float, pattern: int | str | Pattern) -> None:
        """Lets constraints first .. first + count - 1, as they were added, begin within the analysis.

        time     up to which the analysis goes on without them; a load step must end there
        pattern  its factor, over that at `time`, is what is left of the way from where the nodes are at `time` to where
                 they are prescribed: constant for displacements that count from there, 1 to 0 for a way to them"""
        self._change(library.delam_problem_begin_constraints, first, count, time, pattern, "displacement")

    def end_constraints(self, first: int, count: int, time: float, pattern: int | str | Pattern) -> None:
        """Lets constraints end within the analysis: from `time` on, the forces that they had, times the factor of a
        pattern over that at `time`, take their place. Other arguments are those of begin_constraints."""
        self._change(library.delam_problem_end_constraints, first, count, time, pattern, "force")

    def _change(self, function: Any, first: int, count: int, time: float, pattern: int | str | Pattern,
                drives: str) -> None:
        index = self.pattern(pattern)
        self._call(function, integer("first", first), integer("count", count), number("time", time), index)
        self._drives.setdefault(index, drives)

    def add_periodic(self, periods: ArrayLike, control_nodes: ArrayLike, tolerance: float = 0.0) -> None:
        """u(x + period_k) - u(x) = u of control node k, on opposite faces of the mesh. periods: [periods][dimension],
        lengths; control_nodes: [periods]; tolerance: a fraction of the shortest edge, 0: 1e-6. MeshError: faces do not
        match."""
        periods = floats("periods", [periods] if ndim(periods) == 1 else periods, (None, self.dimension))
        control_nodes = indices("control_nodes", control_nodes, (periods.shape[0],))
        self._call(library.delam_problem_add_periodic, periods.shape[0], pointer(periods), pointer(control_nodes),
                   number("tolerance", tolerance), 0, long=True)

    def add_forces(self, pattern: int | str | Pattern, nodes: ArrayLike, forces: ArrayLike) -> None:
        """Dead forces (in 2D per unit of width) times the factor of a pattern: [nodes][dimension], or one vector for
        all. nodes: indices or a mask; ArgumentError: there are none."""
        nodes = self._nodes(nodes)
        if ndim(forces) == 1:
            forces = np.tile(floats("forces", forces, (self.dimension,)), (nodes.size, 1))
        forces = floats("forces", forces, (nodes.size, self.dimension))
        index = self.pattern(pattern)
        self._call(library.delam_problem_add_forces, index, nodes.size, pointer(nodes), pointer(forces), 0, long=True)
        self._drives.setdefault(index, "force")

    def add_eigenstrain(self, pattern: int | str | Pattern, strain: ArrayLike, body: Body | None = None) -> None:
        """xx, yy, zz, 2xy, 2yz, 2zx in the material axes, times the factor of a pattern."""
        strain = floats("strain", strain, (6,))
        index = self.pattern(pattern)
        self._call(library.delam_problem_add_eigenstrain, index, self.mesh._chosen(body), pointer(strain))
        self._drives.setdefault(index, "strain")

    def set_gaps(self, interface: int | Interface, pattern: int | str | Pattern, gaps: ArrayLike | None = None,
                 adjust: float = 0.0) -> None:
        """Distances that the faces of an interface have before they move, times the factor of a pattern, which must
        drive nothing else. The adhesion of pairs with a gap becomes 0. A later call replaces the gaps of the interface.

        gaps    lengths along the normals, [pairs] or one for all; negative ones are an interference, which presses the
                bodies apart. None: the distances in the mesh, of which none may be negative (MeshError) and an
                obstacle has none (ArgumentError)
        adjust  a length >= 0; gaps of this magnitude or less count as 0: these faces touch"""
        at = interface_index(interface, self.mesh)
        index = self.pattern(pattern)
        distances = None
        if gaps is not None:
            size = self._pair_counts[at] if 0 <= at < len(self._pair_counts) else np.size(gaps)
            distances = spread("gaps", gaps, size)
        self._call(library.delam_problem_set_gaps, at, index, pointer(distances), number("adjust", adjust),
                   long=True)
        self._drives.setdefault(index, "gap")

    # ---- queries

    def check(self) -> None:
        """ProblemError names what is missing or contradictory."""
        self._call(library.delam_problem_check, long=True)

    @property
    def hash(self) -> str:
        """Returns a hash of everything that determines the result, as 16 hexadecimal digits."""
        out = ctypes.create_string_buffer(17)
        self._call(library.delam_problem_hash, out, long=True)
        return out.value.decode()

    @property
    def dofs(self) -> tuple[int, int]:
        """Numbers of displacements and of jumps."""
        primal, dual = ctypes.c_int64(), ctypes.c_int64()
        self._call(library.delam_problem_dofs, primal, dual)
        return primal.value, dual.value

    def process_zone(self, interface: int | Interface) -> tuple[float, float]:
        """Expected length of the process zone, 0 if there is none, and the mean distance of pairs, both lengths."""
        length, spacing = ctypes.c_double(), ctypes.c_double()
        self._call(library.delam_problem_process_zone, interface_index(interface, self.mesh), length, spacing,
                   long=True)
        return length.value, spacing.value

    def propose(self, interface: int | Interface, pairs: float = 3.0) -> Proposal:
        """Stiffness and strengths for the law of an interface, with at least `pairs` pairs in the process zone."""
        values = [ctypes.c_double() for _ in Proposal._fields]
        self._call(library.delam_problem_propose, interface_index(interface, self.mesh), number("pairs", pairs),
                   *values, long=True)
        return Proposal(*(value.value for value in values))

    def plan(self) -> Forecast:
        """Plans an analysis without beginning it: nothing is factored."""
        plan, setup, memory = ctypes.c_char_p(), ctypes.c_double(), ctypes.c_double()
        self._call(library.delam_problem_plan, plan, setup, memory, long=True)
        return Forecast((plan.value or b"").decode(), setup.value, memory.value)

    def option(self, key: str) -> str:
        """Value of an option as text. ArgumentError: there is none of this key."""
        value = self.context.text(library.delam_problem_option, self._handle, text("key", key))
        if value is None:
            raise ArgumentError(f"option '{key}' is not known")
        return value

    @property
    def value_keys(self) -> list[str]:
        """Keys of the values that a solver of this problem has."""
        count, key = ctypes.c_int64(), ctypes.c_char_p()
        self._call(library.delam_problem_value_count, count)
        keys = []
        for i in range(count.value):
            self._call(library.delam_problem_value_info, i, key, None)
            keys.append((key.value or b"").decode())
        return keys

    def body_matrix(self, body: Body) -> Sparse:
        """Stiffness of a body, forces per length, over its nodes in ascending order, both triangles: row
        dimension * i + component of node i."""
        body = self.mesh._label(body)
        rows, entries = ctypes.c_int64(), ctypes.c_int64()
        self._call(library.delam_problem_body_matrix, body, rows, entries, None, None, None, long=True)
        out = Sparse((rows.value, rows.value), np.empty(rows.value + 1, np.int64), np.empty(entries.value, np.int64),
                     np.empty(entries.value))
        self._call(library.delam_problem_body_matrix, body, rows, entries, *(pointer(array) for array in out[1:]),
                   long=True)
        return out

    def constraints(self) -> tuple[Sparse, FloatArray]:
        """Constraints [rows][displacements of the mesh], and their right-hand sides [rows][patterns] at factor 1."""
        rows, entries, patterns = ctypes.c_int64(), ctypes.c_int64(), ctypes.c_int64()
        sizes = rows, entries, patterns
        self._call(library.delam_problem_constraints, *sizes, None, None, None, None, long=True)
        out = Sparse((rows.value, self.dofs[0]), np.empty(rows.value + 1, np.int64), np.empty(entries.value, np.int64),
                     np.empty(entries.value))
        coefficients = np.empty((rows.value, patterns.value))
        self._call(library.delam_problem_constraints, *sizes, *(pointer(array) for array in out[1:]),
                   pointer(coefficients), long=True)
        return out, coefficients

    def forces(self, pattern: int | str | Pattern) -> FloatArray:
        """Nodal forces [nodes][dimension] of a pattern at factor 1."""
        out = np.empty((self.dofs[0] // self.dimension, self.dimension))
        self._call(library.delam_problem_forces, self.pattern(pattern), out.size, pointer(out), long=True)
        return out

    def eigenstrain_energy(self) -> FloatArray:
        """[patterns][patterns]: W_pq, the integral of e_p : C : e_q over the bodies, e_p the eigenstrain of pattern p
        and C the elasticity; 0 for other patterns."""
        out = np.zeros((len(self.patterns),) * 2)
        self._call(library.delam_problem_eigenstrain_energy, out.size, pointer(out), long=True)
        return out

    def factors(self, time: float) -> FloatArray:
        """[patterns]: factors of all patterns at a time."""
        out = np.empty(len(self.patterns))
        self._call(library.delam_problem_factors, number("time", time), out.size, pointer(out))
        return out
