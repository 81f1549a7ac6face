# SPDX-License-Identifier: BSD-3-Clause
"""Files that meshio reads, and the groups of cells that MED keeps in them."""
from __future__ import annotations

import contextlib
import io
import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from .._base.arrays import IntArray
from .._base.errors import FileError
from .grids import meshio_module

if TYPE_CHECKING:
    import meshio


def read_file(path: str | os.PathLike[str]) -> meshio.Mesh:
    """Returns the mesh that meshio reads. A failure, for which meshio may print, end the program or raise anything,
    becomes a FileError with the file and the reason."""
    module = meshio_module()
    if not os.path.isfile(path):
        raise FileError(f"{os.fspath(path)}: there is no such file")
    said = io.StringIO()
    try:
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
            return module.read(path)
    except MemoryError:
        raise
    except (Exception, SystemExit) as error:
        reason = " ".join(said.getvalue().split()).removeprefix("Error: ") or f"{type(error).__name__}: {error}"
        raise FileError(f"{os.fspath(path)}: meshio {module.__version__} cannot read it: {reason}") from error


def groups_of(source: Any) -> dict[str, list[IntArray]]:
    """The groups of a file of MED as cell sets, rows of each block by name: its cells have the (negative) number of a
    family, and a family has names of groups."""
    families: Mapping[int, Sequence[str]] = getattr(source, "cell_tags", None) or {}
    if "cell_tags" not in source.cell_data:
        return {}
    of: dict[str, list[int]] = {}
    for family, names in families.items():
        for name in names:
            of.setdefault(name, []).append(int(family))
    return {name: [np.flatnonzero(np.isin(part, wanted)) for part in source.cell_data["cell_tags"]]
            for name, wanted in of.items()}


def family_labels(source: Any, chosen: Sequence[int]) -> tuple[list[IntArray], dict[int, str]]:
    """Labels 0, 1 .. for the families of MED in the chosen blocks, 0 for the cells without a group if there are any,
    and the names of their groups."""
    parts = [np.asarray(source.cell_data["cell_tags"][i], np.int64) for i in chosen]
    families = sorted(set(np.concatenate(parts).tolist()), key=lambda family: (abs(family), family))
    known = getattr(source, "cell_tags", None) or {}
    names = {k: ", ".join(known[family]) for k, family in enumerate(families) if known.get(family)}
    number = {family: k for k, family in enumerate(families)}
    return [np.array([number[family] for family in part.tolist()], np.int64) for part in parts], names
