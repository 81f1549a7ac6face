# SPDX-License-Identifier: BSD-3-Clause
"""Figures of matplotlib, by their kind: of a result of the command line and of a History."""
from __future__ import annotations

import importlib
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from .._base.arrays import FloatArray
from .._base.errors import ArgumentError
from .._base.protocols import Solver
from .._base.records import Jump
from .live import shown, units_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

# The function that draws each kind of figure: {kind: (module, function)}.
_CURVES = ".._pictures.curves"
_OF_RESULT = {"load": (_CURVES, "load_figure"), "energies": (_CURVES, "energies_figure"),
              "averages": (_CURVES, "averages_figure"), "snapshots": (".._pictures.snapshots", "snapshots_figure"),
              "stresses": (".._pictures.stresses", "stresses_figure"),
              "fronts": (".._pictures.fronts", "fronts_figure"), "cut": (".._pictures.cut", "cut_figure")}
_OF_HISTORY = {"load": (".live", "load_figure"), "energies": (_CURVES, "energies_figure"),
               "bodies": (".live", "bodies_figure")}


def result_figure(folder: str, kind: str, cut: str | None) -> Figure:
    """Draws the result in a folder. cut: the plane of kind "cut", which no other kind takes."""
    arguments: list[Any] = []
    if cut is not None:
        if kind != "cut":
            raise ArgumentError(f"cut = {cut!r} belongs to kind 'cut', not to {kind!r}")
        try:
            arguments = [importlib.import_module(".._pictures.cut", __package__).plane_of(cut)]
        except ValueError:
            raise ArgumentError(f"cut = {cut!r}: it takes x, y or z, =, and a number, like y=0.01") from None
    return _figure(lambda: importlib.import_module(".._pictures.result", __package__).Result(folder), kind, _OF_RESULT,
                   *arguments)


def history_figure(columns: Mapping[str, FloatArray], jumps: Sequence[Jump], about: Mapping[str, Any],
                   solver: Solver | None, kind: str, units: Mapping[str, str] | None, title: str) -> Figure:
    """Draws a History from its columns, its jumps, its description of the scene, and its solver if it has one."""
    named = units_of(units)
    return _figure(lambda: shown(columns, jumps, {**about, "units": named}, solver, title), kind, _OF_HISTORY)


def _figure(made: Callable[[], Any], kind: str, kinds: Mapping[str, tuple[str, str]], *arguments: Any) -> Figure:
    """A figure of one kind; ArgumentError says which kinds there are, ValueError why there is no picture."""
    if kind not in kinds:
        raise ArgumentError(f"kind = {kind!r} is no picture; known are {', '.join(kinds)}")
    module, function = kinds[kind]
    try:
        style = importlib.import_module(".._pictures.result", __package__)
        drawing = importlib.import_module(module, __package__)
    except ModuleNotFoundError as error:
        if error.name not in ("matplotlib", "h5py"):
            raise
        raise ImportError(f"this picture needs {error.name} (Debian: python3-{error.name})") from None
    with style.styled():
        try:
            figure: Figure = getattr(drawing, function)(made(), *arguments)
        except style.Nothing as reason:
            raise ValueError(f"no picture of {kind}: {reason}") from None
    if "inline" in style.matplotlib.get_backend():
        style.plt.close(figure)  # a notebook would show it twice: as the cell's value, and again because it is open
    return figure
