# SPDX-License-Identifier: BSD-3-Clause
"""Nodes, cells, bodies and the interfaces between them."""
from __future__ import annotations

import ctypes
import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._base import raw
from ._base.arrays import direction as axis
from ._base.arrays import FloatArray, IntArray, floats, gate, indices, listed, ndim, pointer, spread
from ._base.call import Context, Object, integer, logger, number
from ._base.cells import CELL_TYPES, CELLS, Cells, CellType, cell_type, cell_types
from ._base.errors import ArgumentError
from ._base.library import library
from ._base.records import Ties
from ._base.words import listing, meant
from ._exchange.grids import grid_of, write
from ._exchange.sources import Source, of_meshio, of_vtk

if TYPE_CHECKING:
    import meshio

__all__ = ["Body", "CELLS", "CELL_TYPES", "CellType", "Cells", "Interface", "Mesh", "Ties", "cell_type", "cell_types",
           "interface_index", "place_text"]

# A body, by its label or by the name that its file gave it (Mesh.body_names).
Body = int | str


def place_text(place: FloatArray) -> str:
    """A position in a message."""
    return f"({', '.join(format(float(x), 'g') for x in place)})"


def interface_index(value: int | Interface, mesh: Mesh) -> int:
    """Returns the index of an interface of this mesh, which is given by itself or by its index."""
    if isinstance(value, Interface) and value.mesh is not mesh:
        raise ArgumentError(f"interface {value.index} given is one of another mesh")
    return integer("interface", value)


class Interface:
    """An interface of a mesh; may be used wherever an index is expected. Its jump is u_b - u_a, its normals point from
    a to b."""

    def __init__(self, mesh: Mesh, index: int) -> None:
        self.mesh = mesh
        self.index = index

    def __index__(self) -> int:
        return self.index

    def __repr__(self) -> str:
        return f"<Interface {self.index}: bodies {self.body_a} and {self.body_b}, {self.pair_count} pairs>"

    def _size(self) -> tuple[int, int, int, int, int]:
        body_a, body_b, per_face = ctypes.c_int32(), ctypes.c_int32(), ctypes.c_int32()
        pairs, faces = ctypes.c_int64(), ctypes.c_int64()
        self.mesh._call(library.delam_mesh_interface_size, self.index, body_a, body_b, pairs, faces, per_face)
        return body_a.value, body_b.value, pairs.value, faces.value, per_face.value

    @property
    def body_a(self) -> int:
        """Label of the body on side a; -1 for an obstacle."""
        return self._size()[0]

    @property
    def body_b(self) -> int:
        """Label of the body on side b, to which the normals point."""
        return self._size()[1]

    @property
    def pair_count(self) -> int:
        """Number of pairs of nodes."""
        return self._size()[2]

    def _pairs(self, which: int) -> Any:
        pairs, dimension = self.pair_count, self.mesh.dimension
        out: list[NDArray[Any] | None] = [None, None, None, None]
        out[which] = np.empty(pairs, np.int64) if which < 2 else np.empty(pairs) if which == 2 else np.empty(
            (pairs, dimension, dimension))
        self.mesh._call(library.delam_mesh_interface_pairs, self.index, *(pointer(array) for array in out))
        return out[which]

    @property
    def nodes_a(self) -> IntArray:
        """[pairs]: the node of each pair on side a."""
        nodes: IntArray = self._pairs(0)
        return nodes

    @property
    def nodes_b(self) -> IntArray:
        """[pairs]: the node of each pair on side b."""
        nodes: IntArray = self._pairs(1)
        return nodes

    @property
    def weights(self) -> FloatArray:
        """[pairs]: length (2D) or area (3D) of each pair."""
        weights: FloatArray = self._pairs(2)
        return weights

    @property
    def frames(self) -> FloatArray:
        """[pairs][dimension][dimension], unit vectors: rows normal, tangent(s)."""
        frames: FloatArray = self._pairs(3)
        return frames

    @property
    def places(self) -> FloatArray:
        """[pairs][dimension]: positions of the nodes of body b, in the unit of length of the mesh."""
        places: FloatArray = self.mesh.nodes[self.nodes_b]
        return places

    @property
    def faces(self) -> IntArray:
        """[faces][nodes of a face], as indices of pairs."""
        _, _, _, faces, per_face = self._size()
        out = np.empty((faces, per_face), np.int64)
        self.mesh._call(library.delam_mesh_interface_faces, self.index, pointer(out))
        return out


class Mesh(Object):
    """Nodes [n][2 or 3]; cells are added by type:

        mesh = Mesh(nodes)
        mesh.add_cells("quad4", connectivity, bodies)
        interface = mesh.add_interface(0, 1)

    Indices are 0-based throughout. Nodes without cells are control nodes or tied nodes, which belong to no body, or
    nodes of bodies whose stiffness the host provides (add_host_body). Positions are in the unit of length of the scene,
    whichever it is. MeshError says where cells are inverted, nodes are shared or faces do not match. `body_names` is
    {label: name} where a file named its groups, else empty; wherever a body is taken, its label or its name is."""

    body_names: dict[int, str]
    _instead = ("Keep its arrays (nodes, cells) and add the interfaces again, or write it to a file with to_meshio, "
                "and make the Mesh from them where it is needed.")

    def __init__(self, nodes: ArrayLike) -> None:
        nodes = floats("nodes", nodes, (None, (2, 3)))
        self._create(library.delam_mesh_create, nodes.shape[1], nodes.shape[0], pointer(nodes))

    @classmethod
    def layers(cls, lengths: ArrayLike, divisions: ArrayLike, thickness: ArrayLike, layer_divisions: ArrayLike,
               cells: str = "quad4") -> Mesh:
        """Block of layers stacked along the last axis (y in 2D, z in 3D), each a separate body, body 0 at the bottom;
        without interfaces. lengths, divisions: along the other axes, a number in 2D or two in 3D; thickness,
        layer_divisions: of each layer, [layers] each. ArgumentError names a value that is not positive or
        an array of another size."""
        lengths = floats("lengths", listed(lengths), ((1, 2),))
        divisions = indices("divisions", divisions, (lengths.size,))
        thickness = floats("thickness", listed(thickness), (None,))
        layer_divisions = indices("layer_divisions", layer_divisions, (thickness.size,))
        mesh = cls.__new__(cls)
        mesh._create(library.delam_mesh_create_layers, lengths.size + 1, pointer(lengths), pointer(divisions),
                     thickness.size, pointer(thickness), pointer(layer_divisions), cell_type(cells)[0])
        return mesh

    @classmethod
    def from_meshio(cls, source: meshio.Mesh | str | os.PathLike[str],
                    bodies: str | Sequence[str] | None = None, interfaces: bool = True) -> Mesh:
        """A meshio.Mesh, or a file that meshio reads. bodies: name of the cell data with a label for each cell, or
        names of cell sets; see delam.meshes.read."""
        return _made(of_meshio(source, bodies), interfaces)

    @classmethod
    def from_vtk(cls, grid: Any, bodies: str | None = None, interfaces: bool = True) -> Mesh:
        """A vtkUnstructuredGrid, or a grid of PyVista. bodies: name of the cell array with a label for each cell; see
        delam.meshes.from_vtk."""
        return _made(of_vtk(grid, bodies), interfaces)

    def to_vtk(self, point_data: Mapping[str, ArrayLike] | None = None,
               cell_data: Mapping[str, ArrayLike] | None = None) -> Any:
        """A vtkUnstructuredGrid with the same nodes and cells, and data as for to_meshio. ImportError: VTK is not
        installed."""
        return grid_of(self, point_data, cell_data).to_vtk()

    def to_pyvista(self, point_data: Mapping[str, ArrayLike] | None = None,
                   cell_data: Mapping[str, ArrayLike] | None = None) -> Any:
        """The same as a pyvista.UnstructuredGrid. ImportError: PyVista is not installed."""
        return grid_of(self, point_data, cell_data).to_pyvista()

    def to_meshio(self, point_data: Mapping[str, ArrayLike] | None = None,
                  cell_data: Mapping[str, ArrayLike] | None = None) -> meshio.Mesh:
        """A meshio.Mesh with the same nodes and cells, to be written in any of meshio's formats; see
        delam.meshes.write. ArgumentError: data with another number of rows than there are nodes or cells."""
        return write(self, point_data, cell_data)

    def _create(self, function: Any, *arguments: Any) -> None:
        context = Context()
        self._make(context, raw.delam_mesh, library.delam_mesh_destroy, function, context.handle, *arguments,
                   long=True)
        self.body_names = {}
        self._bodies: list[int] = []  # their labels, as far as they have been asked for
        self._sought = ""  # where find_nodes has found nothing last

    def _call(self, function: Any, *arguments: Any, long: bool = False) -> None:
        self.context.call(function, self._handle, *arguments, long=long)

    def _labels(self) -> list[int]:
        """Labels of the bodies, ascending."""
        if not self.closed and self.body_count != len(self._bodies):
            self._bodies = sorted(set(self.node_bodies.tolist()) - {-1})
        return self._bodies

    def _label(self, body: Body, argument: str = "body") -> int:
        """Label of a body, itself or its name."""
        if isinstance(body, str):
            found = [label for label, name in self.body_names.items() if name == body]
            if len(found) == 1:
                return found[0]
            names = self.body_names.values()
            raise ArgumentError(f"{argument} = {body!r} is not the name of one body{meant(body, names)}; in "
                                f"Mesh.body_names there are {listing(names) or 'none'}")
        label = integer(argument, body, 32)
        there = self._labels()
        if there and label not in there:
            named = [f"{of} ({self.body_names[of]})" if of in self.body_names else str(of) for of in there]
            raise ArgumentError(f"{argument} = {label}: no body has this label; there are {listing(named)}")
        return label

    def _chosen(self, body: Body | None) -> int:
        """Label of a body as the library takes it: None are all."""
        return -1 if body is None else self._label(body)

    def _extent(self) -> str:
        """Where the nodes lie, for a message."""
        if self.closed or self.node_count == 0:
            return ""
        nodes = self.nodes
        return f"; the nodes lie from {place_text(nodes.min(0))} to {place_text(nodes.max(0))}"

    def _nothing(self, argument: str) -> ArgumentError:
        """The error of an argument without nodes."""
        sought = f"; find_nodes last found none {self._sought}" if self._sought else ""
        return ArgumentError(f"{argument} is empty, expected at least one node{sought}{self._extent()}")

    def __repr__(self) -> str:
        if self.closed:
            return "<Mesh, closed>"
        return (f"<Mesh in {self.dimension}D: {self.node_count} nodes, {self.cell_count} cells, "
                f"{self.body_count} bodies, {self.interface_count} interfaces>")

    # ---- cells and interfaces

    def _add_cells(self, function: Any, cells: str, connectivity: ArrayLike, bodies: ArrayLike) -> None:
        number, size = cell_type(cells)
        connectivity = indices("connectivity", connectivity, (None, size))
        count = connectivity.shape[0]
        if ndim(bodies) == 0:
            bodies = np.full(count, integer("bodies", bodies, 32), np.int32)
        labels = gate("bodies", bodies, np.int32, (count,))
        self._call(function, number, count, pointer(connectivity), pointer(labels), 0, long=True)

    def add_cells(self, cells: str, connectivity: ArrayLike, bodies: ArrayLike = 0) -> None:
        """Cells of one type, e.g. "quad4"; connectivity: [cells][nodes of a cell]. bodies: a label for all, or one each
        [cells]. A node belongs to one body only (MeshError otherwise, and where a cell is inverted)."""
        self._add_cells(library.delam_mesh_add_cells, cells, connectivity, bodies)

    def add_conforming_cells(self, cells: str, connectivity: ArrayLike, bodies: ArrayLike = 0) -> None:
        """Adds cells as add_cells does, of a mesh whose bodies share nodes, and doubles these (node_origins has the
        originals)."""
        self._add_cells(library.delam_mesh_add_conforming_cells, cells, connectivity, bodies)

    def _add_interface(self, function: Any, body_a: Body, body_b: Body, distance: float) -> Interface:
        index = ctypes.c_int64()
        self._call(function, self._label(body_a, "body_a"), self._label(body_b, "body_b"), distance, index, long=True)
        return Interface(self, index.value)

    def add_interface(self, body_a: Body, body_b: Body, tolerance: float = 0.0) -> Interface:
        """Pairs the coinciding faces of two bodies. tolerance: a fraction of the shortest edge, 0: 1e-6. MeshError:
        no faces coincide, or not all of their nodes."""
        return self._add_interface(library.delam_mesh_add_interface, body_a, body_b, number("tolerance", tolerance))

    def add_all_interfaces(self, tolerance: float = 0.0) -> list[Interface]:
        """Adds an interface between every two bodies that share faces and have none yet; returns the new ones."""
        before, count = self.interface_count, ctypes.c_int64()
        self._call(library.delam_mesh_add_all_interfaces, number("tolerance", tolerance), count, long=True)
        return [Interface(self, before + i) for i in range(count.value)]

    def add_seams(self, tolerance: float = 0.0) -> list[Interface]:
        """Adds an interface for each seam within a body, where outer faces lie on others of the same body with nodes of
        their own (a crack, a slit); returns the new ones. tolerance: a fraction of the shortest edge, 0: 1e-6. Nodes
        that both sides share, as at the tip, have no pair. MeshError: more than two faces lie on each other, or the
        nodes of two sides do not match."""
        before, count = self.interface_count, ctypes.c_int64()
        self._call(library.delam_mesh_add_seams, number("tolerance", tolerance), count, long=True)
        return [Interface(self, before + i) for i in range(count.value)]

    def add_self_contact(self, gap: float) -> list[Interface]:
        """Adds interfaces between outer faces of one body that face each other at a distance of at most gap, a length
        (the walls of a slot or notch), whether their meshes match or not; returns the new ones. The nodes of one side
        are tied to means over faces of the other (ties). Faces whose nodes all have pairs already, and faces that share
        a node with the other side, are left out. MeshError: a face faces the other side in part, or a wall faces
        itself."""
        before, count = self.interface_count, ctypes.c_int64()
        self._call(library.delam_mesh_add_self_contact, number("gap", gap), count, long=True)
        return [Interface(self, before + i) for i in range(count.value)]

    def add_projected_interface(self, body_a: Body, body_b: Body, gap: float = 0.0) -> Interface:
        """An interface of two bodies whose meshes do not match; b should be the finer one. gap: distance of the faces,
        a length, 0: 1e-6 of the shortest edge. The nodes of b are tied to a (ties)."""
        return self._add_interface(library.delam_mesh_add_projected_interface, body_a, body_b, number("gap", gap))

    def add_mortar_interface(self, body_a: Body, body_b: Body, gap: float = 0.0) -> Interface:
        """An interface of two bodies whose meshes do not match, either of which may be the finer one. gap: distance of
        the faces, a length, 0: 1e-6 of the shortest edge. The nodes of b are tied to means over faces of a (ties)."""
        return self._add_interface(library.delam_mesh_add_mortar_interface, body_a, body_b, number("gap", gap))

    def add_obstacle(self, nodes: ArrayLike, normals: ArrayLike, control_node: int,
                     weights: ArrayLike | None = None) -> Interface:
        """A rigid obstacle that moves with its control node, a node of no body. nodes: those that may touch it, indices
        or a mask; normals: from the obstacle into the body, one per pair [nodes][dimension] or one for all; weights:
        length or area of each node [nodes], None: computed."""
        nodes = indices("nodes", nodes, size=self.node_count)
        normals = self._normals(normals, nodes.size)
        given = None if weights is None else floats("weights", weights, (nodes.size,))
        index = ctypes.c_int64()
        self._call(library.delam_mesh_add_obstacle, nodes.size, pointer(nodes), pointer(normals), pointer(given),
                   integer("control_node", control_node), 0, index, long=True)
        return Interface(self, index.value)

    def add_host_body(self, body: int, nodes: ArrayLike) -> None:
        """A body without cells, whose stiffness is given by Problem.set_stiffness. nodes: indices or a mask, of nodes
        that belong to no body yet."""
        nodes = indices("nodes", nodes, size=self.node_count)
        self._call(library.delam_mesh_add_host_body, integer("body", body, 32), nodes.size, pointer(nodes), 0,
                   long=True)

    def add_pairs(self, body_a: Body, body_b: Body, nodes_a: ArrayLike, nodes_b: ArrayLike, normals: ArrayLike,
                  weights: ArrayLike, faces: ArrayLike | None = None) -> Interface:
        """An interface of pairs given by the host, in the given order; the nodes of a pair may lie apart.

        nodes_a, nodes_b: [pairs], nodes of each pair;
        normals: from a to b, one per pair or one for all; weights: length (2D) or area (3D) of a pair, likewise; faces:
        [faces][nodes of a face] as indices of pairs. Fronts, the gradient term and the neighbours to which an energetic
        search advances require faces."""
        nodes_a = indices("nodes_a", nodes_a)
        nodes_b = indices("nodes_b", nodes_b, (nodes_a.size,))
        normals = self._normals(normals, nodes_a.size)
        weights = spread("weights", weights, nodes_a.size)
        faces = np.empty((0, 0), np.int64) if faces is None else indices("faces", faces, (None, None))
        index = ctypes.c_int64()
        self._call(library.delam_mesh_add_pairs, self._label(body_a, "body_a"), self._label(body_b, "body_b"),
                   nodes_a.size, pointer(nodes_a), pointer(nodes_b), pointer(normals), pointer(weights), faces.shape[0],
                   faces.shape[1], pointer(faces), 0, index, long=True)
        return Interface(self, index.value)

    def _normals(self, normals: str | ArrayLike, count: int) -> FloatArray:
        """One per pair, or one for all."""
        if ndim(normals) == 1 or isinstance(normals, str):
            normals = np.tile(axis("normals", normals, self.dimension), (count, 1))
        return floats("normals", normals, (count, self.dimension))

    @property
    def interfaces(self) -> list[Interface]:
        """All interfaces, in the order they were added."""
        return [Interface(self, i) for i in range(self.interface_count)]

    # ---- queries

    def _size(self) -> tuple[int, int, int, int, int]:
        dimension = ctypes.c_int32()
        nodes, cells, bodies, interfaces = (ctypes.c_int64() for _ in range(4))
        self._call(library.delam_mesh_size, dimension, nodes, cells, bodies, interfaces)
        return dimension.value, nodes.value, cells.value, bodies.value, interfaces.value

    @property
    def dimension(self) -> int:
        """2 or 3."""
        return self._size()[0]

    @property
    def node_count(self) -> int:
        """Number of nodes, those of no body included."""
        return self._size()[1]

    @property
    def cell_count(self) -> int:
        """Number of cells."""
        return self._size()[2]

    @property
    def body_count(self) -> int:
        """Number of bodies, those of the host included."""
        return self._size()[3]

    @property
    def interface_count(self) -> int:
        """Number of interfaces, obstacles included."""
        return self._size()[4]

    @property
    def nodes(self) -> FloatArray:
        """Positions [nodes][dimension], a copy."""
        dimension, count = self._size()[:2]
        out = np.empty((count, dimension))
        self._call(library.delam_mesh_nodes, out.size, pointer(out))
        return out

    @property
    def node_bodies(self) -> NDArray[np.int32]:
        """[nodes]: body of each node, -1 for nodes of no body."""
        out = np.empty(self.node_count, np.int32)
        self._call(library.delam_mesh_node_bodies, out.size, pointer(out))
        return out

    @property
    def node_origins(self) -> IntArray:
        """[nodes]: the original of each doubled node (add_conforming_cells); otherwise the node itself."""
        out = np.empty(self.node_count, np.int64)
        self._call(library.delam_mesh_node_origins, out.size, pointer(out))
        return out

    @property
    def ties(self) -> Ties:
        """Tied nodes of projected interfaces."""
        count, entries = ctypes.c_int64(), ctypes.c_int64()
        self._call(library.delam_mesh_node_ties, count, entries, None, None, None, None)
        ties = Ties(np.empty(count.value, np.int64), np.empty(count.value + 1, np.int64),
                    np.empty(entries.value, np.int64), np.empty(entries.value))
        self._call(library.delam_mesh_node_ties, None, None, *(pointer(array) for array in ties))
        return ties

    @property
    def cells(self) -> Cells:
        """All cells, a copy."""
        count, needed = self.cell_count, ctypes.c_int64()
        self._call(library.delam_mesh_cells, None, None, None, 0, None, needed)
        cells = Cells(np.empty(count, np.int32), np.empty(count, np.int32), np.empty(count + 1, np.int64),
                      np.empty(needed.value, np.int64))
        self._call(library.delam_mesh_cells, pointer(cells.types), pointer(cells.bodies), pointer(cells.offsets),
                   needed.value, pointer(cells.connectivity), None)
        return cells

    def find_nodes(self, lower: ArrayLike, upper: ArrayLike | None = None, body: Body | None = None) -> IntArray:
        """Nodes of a body (None: of all) inside the closed box lower..upper, ascending; without upper, at a point.
        Where there are none, the array is empty; what takes nodes refuses it."""
        dimension = self.dimension
        lower = floats("lower", lower, (dimension,))
        upper = lower if upper is None else floats("upper", upper, (dimension,))
        count = ctypes.c_int64()
        box = self._chosen(body), pointer(lower), pointer(upper)
        self._call(library.delam_mesh_find_nodes, *box, 0, None, count)
        if count.value == 0:
            where = f"at {place_text(lower)}" if upper is lower else f"from {place_text(lower)} to {place_text(upper)}"
            self._sought = where if body is None else f"of body {body} {where}"
        nodes = np.empty(count.value, np.int64)
        self._call(library.delam_mesh_find_nodes, *box, nodes.size, pointer(nodes), count)
        return nodes

    def find_node(self, place: ArrayLike, body: Body | None = None) -> int:
        """The one node of a body (None: of all) at a point. ArgumentError: there is none, and the nearest is named; or
        there are several, as at an interface, where `body` says which."""
        place = floats("place", place, (self.dimension,))
        nodes = self.find_nodes(place, body=body)
        if nodes.size != 1:
            of = "" if body is None else f" of body {body}"
            raise ArgumentError(f"place = {place_text(place)}: {nodes.size} nodes{of} are there, expected 1"
                                + (self._which(nodes) if nodes.size else self._nearest(place, self._chosen(body))))
        return int(nodes[0])

    def _which(self, nodes: IntArray) -> str:
        """Lists several nodes at a place, with their bodies, for a message."""
        bodies = self.node_bodies[nodes].tolist()
        own = [f"{node} of body {body}" if body >= 0 else f"{node} of no body" for node, body in zip(nodes, bodies)]
        return f" ({listing(own)})" + (": give body=" if len(set(bodies)) > 1 else "")

    def _nearest(self, place: FloatArray, label: int) -> str:
        """The node nearest to a place, for a message."""
        rows = np.flatnonzero(self.node_bodies == label) if label >= 0 else np.arange(self.node_count)
        if rows.size == 0:
            return ""
        nodes = self.nodes[rows]
        distances = np.linalg.norm(nodes - place, axis=1)
        near = int(distances.argmin())
        return f"; the nearest is node {rows[near]} at {place_text(nodes[near])}, {distances[near]:g} away"

    def find_patch(self, body: Body | None, lower: ArrayLike, upper: ArrayLike,
                   direction: str | ArrayLike) -> tuple[IntArray, FloatArray]:
        """Nodes [n] and weights [n] (lengths in 2D, areas in 3D) of a uniform traction on the part of a body's boundary
        (None: of each body's) inside the box whose outward normal is within 45 degrees of the direction. ArgumentError:
        there is none."""
        dimension = self.dimension
        lower, upper = floats("lower", lower, (dimension,)), floats("upper", upper, (dimension,))
        along = axis("direction", direction, dimension)
        count = ctypes.c_int64()
        box = self._chosen(body), pointer(lower), pointer(upper), pointer(along)
        self._call(library.delam_mesh_find_patch, *box, 0, None, None, count, long=True)
        if count.value == 0:
            of = "any body" if body is None else f"body {body}"
            raise ArgumentError(f"no face of {of} from {place_text(lower)} to {place_text(upper)} has its outward "
                                f"normal within 45 degrees of direction {place_text(along)}{self._extent()}")
        nodes, weights = np.empty(count.value, np.int64), np.empty(count.value)
        self._call(library.delam_mesh_find_patch, *box, nodes.size, pointer(nodes), pointer(weights), count, long=True)
        return nodes, weights


def _made(source: Source, interfaces: bool) -> Mesh:
    mesh = Mesh(source.points)
    for kind, cells, labels in source.blocks:
        mesh.add_conforming_cells(kind, cells, labels)
    mesh.body_names = source.names
    if interfaces and mesh.body_count > 1:
        mesh.add_all_interfaces()
        _warn_of_lone_bodies(mesh)
    return mesh


def _distance(one: FloatArray, other: FloatArray) -> float:
    """Returns the distance of the nearest nodes, or for large bodies an upper bound, from some nodes and their nearest
    ones in turn."""
    few, many = (one, other) if len(one) < len(other) else (other, one)
    step = 1 + int(len(few) * len(many) / 2e7)
    best, at = min((float(np.linalg.norm(many - place, axis=1).min()), i) for i, place in enumerate(few[::step]))
    place = few[at * step]
    for nodes in (many, few) * 3:
        distances = np.linalg.norm(nodes - place, axis=1)
        best, place = min(best, float(distances.min())), nodes[distances.argmin()]
    return best


def _warn_of_lone_bodies(mesh: Mesh) -> None:
    """Warns of bodies that share no face with another."""
    joined = {body for interface in mesh.interfaces for body in (interface.body_a, interface.body_b)}
    lone = [body for body in mesh._labels() if body not in joined]
    if not lone:
        return
    nodes, bodies = mesh.nodes, mesh.node_bodies
    first = lone[0]
    distance = _distance(nodes[bodies == first], nodes[(bodies != first) & (bodies >= 0)])
    logger.warning("no interface was made for %s %s, whose faces coincide with none of another body; the nearest nodes "
                   "of body %s and of others are %.3g apart. Mesh.add_interface(tolerance=..) or, where meshes do not "
                   "match, Mesh.add_mortar_interface(gap=..) joins faces at a distance",
                   "bodies" if len(lone) > 1 else "body", listing(lone), first, distance)
