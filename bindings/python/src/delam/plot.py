# SPDX-License-Identifier: BSD-3-Clause
"""Plots with matplotlib: histories, fields on an interface, and deformed bodies. Each function draws into `ax`, or into
new axes, and returns them."""
from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from ._base.arrays import FloatArray, IntArray
from ._exchange.bodies import adhesion_colours, axes_of, bodies
from .history import History
from .mesh import Interface
from .solver import Solver

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["bodies", "history", "interface"]


def history(history: History | Mapping[str, FloatArray], y: str | Iterable[str], x: str = "time",
            ax: Axes | None = None, **style: Any) -> Axes:
    """Plots values against each other: y is one name or several. `history`: a History, or any mapping of arrays; style:
    for matplotlib's plot. KeyError: there is no such value."""
    ax = axes_of(ax)
    names = [y] if isinstance(y, str) else list(y)
    for name in names:
        ax.plot(history[x], history[name], label=name, **style)
    ax.set_xlabel(x)
    if len(names) == 1:
        ax.set_ylabel(names[0])
    else:
        ax.legend()
    return ax


def interface(solver: Solver, field: str = "adhesion", interface: int | Interface = 0, component: int = 0,
              ax: Axes | None = None, **style: Any) -> Axes:
    """A field of pairs: in 2D along the interface, in 3D in colour on its faces. component: column of jumps and
    tractions, 0 the normal one. ArgumentError: there is no such field."""
    view = solver.problem.mesh.interfaces[interface]
    values = solver.field(field, interface)
    if values.ndim == 2:
        values = values[:, component]
    if solver.problem.dimension == 3:
        return _faces(view, values, field, ax, style)
    places, faces = view.places, view.faces
    ax = axes_of(ax)
    for line in _chains(faces[:, :2], len(values)):
        along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(places[line], axis=0), axis=1))])
        # Straight along x: use the coordinate itself.
        if np.ptp(places[line, 1]) <= 1e-9 * np.ptp(places[line, 0]):
            along = places[line, 0]
        ax.plot(along, values[line], **style)
    ax.set_xlabel("place along the interface")
    ax.set_ylabel(field)
    return ax


def _chains(edges: IntArray, count: int) -> list[IntArray]:
    """Pairs in the order of the lines that two-node faces make; loops end where they begin."""
    neighbours: list[list[int]] = [[] for _ in range(count)]
    for a, b in edges.tolist():
        neighbours[a].append(b)
        neighbours[b].append(a)
    left = {tuple(sorted(edge)) for edge in edges.tolist()}
    chains = []
    for start in sorted(range(count), key=lambda i: len(neighbours[i]) != 1):
        chain = [start]
        while True:
            ahead = next((n for n in neighbours[chain[-1]] if tuple(sorted((chain[-1], n))) in left), None)
            if ahead is None:
                break
            left.discard(tuple(sorted((chain[-1], ahead))))
            chain.append(ahead)
        if len(chain) > 1:
            chains.append(np.array(chain))
    return chains


def _faces(view: Interface, values: FloatArray, field: str, ax: Axes | None, style: dict[str, Any]) -> Axes:
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection
    ax = axes_of(ax, projection="3d")
    places, faces = view.places, view.faces
    corners = faces[:, :{3: 3, 6: 3}.get(faces.shape[1], 4)]
    if field == "adhesion":
        style = {"cmap": adhesion_colours(), "clim": (0.0, 1.0), **style}
    collection = Poly3DCollection(places[corners], array=values[corners].mean(axis=1), **style)
    ax.add_collection3d(collection)
    for axis, low, high in zip("xyz", places.min(axis=0), places.max(axis=0)):
        room = 1e-3 * np.ptp(places) if high == low else 0.0
        getattr(ax, f"set_{axis}lim")(low - room, high + room)
        getattr(ax, f"set_{axis}label")(axis)
    ax.figure.colorbar(collection, ax=ax, label=field)
    return ax
