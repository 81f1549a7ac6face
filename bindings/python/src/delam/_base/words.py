# SPDX-License-Identifier: BSD-3-Clause
"""Words of messages: what was meant by a name, what there is instead, Python's names for those of C."""
from __future__ import annotations

import difflib
import re
from collections.abc import Iterable

_MOST = 10  # names that a message lists


def listing(names: Iterable[object]) -> str:
    """Names one after another, of many the first ones and their number."""
    texts = [str(name) for name in names]
    more = "" if len(texts) <= _MOST else f" .. ({len(texts)} in all)"
    return ", ".join(texts[:_MOST]) + more


def meant(name: object, known: Iterable[object]) -> str:
    """A question for the nearest names, or "". Those of parts, "load:pull", are near to that of the whole, "load"."""
    texts, word = [str(one) for one in known], str(name)
    near = [one for one in texts if word and one.startswith(word + ":")][:3]
    near = near or difflib.get_close_matches(word, texts, 1)
    return f" (did you mean {' or '.join(map(repr, near))}?)" if near else ""


# Functions of C by the classes whose methods have their names ..
_CLASSES = {"mesh": "Mesh", "law": "Law", "problem": "Problem", "solver": "Solver", "petsc": "Ranks"}
# .. and those that are called something else here.
_OTHERS = {
    "version": "library_version", "commit": "library_commit", "blas_threads": "blas_threads",
    "status_name": "DelamError.name", "context_cancel": "Solver.cancel", "context_set_progress": "Problem.progress",
    "cell_type_count": "CELLS", "cell_type_info": "CELLS", "mesh_create": "Mesh", "mesh_create_layers": "Mesh.layers",
    "mesh_destroy": "Mesh.close", "mesh_size": "Mesh.node_count", "mesh_node_ties": "Mesh.ties",
    "mesh_interface_size": "Interface.pair_count", "mesh_interface_pairs": "Interface.nodes_a",
    "mesh_interface_faces": "Interface.faces", "law_create": "Law", "law_create_host": "Law.host",
    "law_set_text": "Law.set", "law_set_table": "Law.set", "law_parameter_count": "Law.parameters",
    "law_parameter_info": "Law.parameters", "law_parameter_bounds": "Law.bounds", "law_kind_count": "Law.kinds",
    "law_kind_info": "Law.kinds", "law_destroy": "Law.close", "problem_create": "Problem",
    "problem_destroy": "Problem.close", "problem_prescribe_nodes": "Problem.prescribe",
    "problem_set_number": "Problem.options", "problem_set_text": "Problem.options", "option_count": "options",
    "option_info": "options", "option_alias": "options", "option_bounds": "Options.bounds",
    "problem_pattern_count": "Problem.patterns", "problem_pattern_name": "Problem.patterns",
    "problem_value_count": "Problem.value_keys", "problem_value_info": "Problem.value_keys", "solver_create": "Solver",
    "solver_create_like": "Solver",
    "solver_destroy": "Solver.close", "solver_value": "Solver.values", "solver_value_count": "Solver.values",
    "solver_value_name": "Solver.values", "solver_value_info": "Values.describe",
    "solver_recorded_size": "Solver.recorded_steps", "solver_field_shape": "Solver.field",
    "solver_front": "Solver.fronts", "solver_front_count": "Solver.fronts", "solver_condensed_size": "Solver.condensed",
    "solver_plan_count": "Solver.plan_items", "solver_plan_item": "Solver.plan_items", "solver_jump": "Solver.jumps",
    "solver_jump_count": "Solver.jumps", "solver_jump_reactions": "Solver.jumps", "solver_save_file": "Solver.save",
    "solver_load_file": "Solver.load", "petsc_create": "Ranks", "petsc_destroy": "Ranks.close"}


def _python_name(found: re.Match[str]) -> str:
    name = found[1]
    owner, _, member = name.partition("_")
    if name in _OTHERS:
        return _OTHERS[name]
    return f"{_CLASSES[owner]}.{member}" if owner in _CLASSES and member else found[0]


def in_python(text: str) -> str:
    """A text of the library with Python's names for its functions."""
    return re.sub(r"\bdelam_([a-z0-9_]*[a-z0-9])", _python_name, text) if "delam_" in text else text
