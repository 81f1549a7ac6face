# SPDX-License-Identifier: BSD-3-Clause
"""The bodies of a plane scene, drawn with matplotlib, and what other drawings share with them."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .._base.cells import CELL_TYPES
from .._base.protocols import Solver

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.colors import Colormap

_BODIES = ("#f4f1e8", "#dde5ee", "#e6ebdf")
_DAMAGE = ("#b3122a", "#f2a541", "#f5e9b8", "#2b6cb0", "#0b2e59")  # adhesion 0 ... 1


def _pyplot() -> Any:
    try:
        import matplotlib.pyplot
    except ImportError:
        raise ImportError("drawing needs matplotlib (Debian: python3-matplotlib)") from None
    return matplotlib.pyplot


def axes_of(ax: Axes | None, **options: object) -> Axes:
    if ax is not None:
        return ax
    return _pyplot().subplots(layout="constrained", subplot_kw=options)[1]


def adhesion_colours() -> Colormap:
    from matplotlib.colors import LinearSegmentedColormap
    return LinearSegmentedColormap.from_list("adhesion", _DAMAGE)


def bodies(solver: Solver, scale: float = 1.0, ax: Axes | None = None) -> Axes:
    """Deformed plane bodies, displacements times `scale`, with the adhesion of interfaces in colour. ValueError: the
    scene is one in space."""
    from matplotlib.collections import LineCollection, PolyCollection
    mesh = solver.problem.mesh
    if solver.problem.dimension != 2:
        raise ValueError("bodies are drawn in 2D alone; write those in space with Mesh.to_meshio for ParaView")
    ax = axes_of(ax)
    places = mesh.nodes[:len(solver.field("displacement"))] + scale * solver.field("displacement")
    cells = mesh.cells
    labels = sorted(set(cells.bodies.tolist()))
    for name in cells.names():
        corners = cells.of(name)[:, :CELL_TYPES[name].corners]
        body = cells.bodies[cells.types == CELL_TYPES[name].number]
        colours = [_BODIES[labels.index(label) % len(_BODIES)] for label in body.tolist()]
        ax.add_collection(PolyCollection(places[corners], facecolors=colours, edgecolors="#00000022", linewidths=0.3))
    lines = None
    for view in mesh.interfaces:
        adhesion = solver.field("adhesion", view.index)
        faces = view.faces[:, :2]
        lines = LineCollection(places[view.nodes_b][faces], array=adhesion[faces].mean(axis=1),
                               cmap=adhesion_colours(), linewidths=2)
        lines.set_clim(0.0, 1.0)
        ax.add_collection(lines)
    if lines is not None:
        ax.figure.colorbar(lines, ax=ax, label="adhesion")
    ax.set_aspect("equal")
    ax.autoscale_view()
    return ax
