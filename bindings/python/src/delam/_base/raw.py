# SPDX-License-Identifier: BSD-3-Clause
"""The C interface, one to one. Generated from delam.h by tools/generate_raw.py: change that, not this."""
from ctypes import (CDLL, CFUNCTYPE, POINTER, Structure, c_char, c_char_p, c_double, c_int32, c_int64,
                    c_uint8, c_void_p)
from typing import Any

DELAM_ABI = 1
DELAM_OK = 0
DELAM_NOT_CONVERGED = 1
DELAM_CANCELLED = 2
DELAM_LIMIT = 3
DELAM_ERROR_ARGUMENT = -1
DELAM_ERROR_HANDLE = -2
DELAM_ERROR_MESH = -3
DELAM_ERROR_PROBLEM = -4
DELAM_ERROR_STATE = -5
DELAM_ERROR_MEMORY = -6
DELAM_ERROR_NUMERICAL = -7
DELAM_ERROR_SNAPSHOT = -8
DELAM_ERROR_INTERNAL = -9
DELAM_ERROR_FILE = -10
DELAM_TRI3 = 1
DELAM_QUAD4 = 2
DELAM_TET4 = 3
DELAM_HEX8 = 4
DELAM_TRI6 = 5
DELAM_QUAD8 = 6
DELAM_QUAD9 = 7
DELAM_TET10 = 8
DELAM_HEX20 = 9
DELAM_HEX27 = 10
DELAM_WEDGE6 = 11
DELAM_PYRAMID5 = 12
DELAM_WEDGE15 = 13


class delam_context(Structure):
    """Opaque."""


class delam_mesh(Structure):
    """Opaque."""


class delam_law(Structure):
    """Opaque."""


class delam_problem(Structure):
    """Opaque."""


class delam_solver(Structure):
    """Opaque."""


delam_log_callback = CFUNCTYPE(None, c_int32, c_char_p, c_void_p)
delam_progress_callback = CFUNCTYPE(c_int32, c_char_p, c_int64, c_int64, c_void_p)
delam_adhesion_callback = CFUNCTYPE(c_int32, c_double, c_double, POINTER(c_double), POINTER(c_double), c_void_p)
delam_dissipation_callback = CFUNCTYPE(
    c_int32, c_double, c_double, POINTER(c_double), POINTER(c_double), POINTER(c_double), c_void_p)

# Name: (result, ((argument, type), ...))
FUNCTIONS: dict[str, tuple[Any, tuple[tuple[str, Any], ...]]] = {
    "delam_version": (c_char_p, ()),
    "delam_commit": (c_char_p, ()),
    "delam_abi": (c_int32, ()),
    "delam_status_name": (c_char_p, (("status", c_int32),)),
    "delam_blas_threads": (c_int32, ()),
    "delam_context_create": (c_int32, (("out", POINTER(POINTER(delam_context))),)),
    "delam_context_destroy": (None, (("context", POINTER(POINTER(delam_context))),)),
    "delam_context_message": (c_char_p, (("context", POINTER(delam_context)),)),
    "delam_context_set_log": (c_int32, (
        ("context", POINTER(delam_context)), ("callback", delam_log_callback), ("user", c_void_p))),
    "delam_context_set_progress": (c_int32, (
        ("context", POINTER(delam_context)), ("callback", delam_progress_callback), ("user", c_void_p))),
    "delam_context_cancel": (c_int32, (("context", POINTER(delam_context)),)),
    "delam_cell_type_count": (c_int64, ()),
    "delam_cell_type_info": (c_int32, (
        ("index", c_int64), ("name", POINTER(c_char_p)), ("cell_type", POINTER(c_int32)),
        ("dimension", POINTER(c_int32)), ("nodes", POINTER(c_int32)), ("corners", POINTER(c_int32)),
        ("faces", POINTER(c_int32)), ("face_nodes", POINTER(c_int32)), ("face_corners", POINTER(c_int32)))),
    "delam_cell_type_topology": (c_int32, (
        ("index", c_int64), ("face", POINTER(c_int32)), ("middle", POINTER(c_int32)))),
    "delam_mesh_create": (c_int32, (
        ("context", POINTER(delam_context)), ("dimension", c_int32), ("node_count", c_int64),
        ("nodes", POINTER(c_double)), ("out", POINTER(POINTER(delam_mesh))))),
    "delam_mesh_create_layers": (c_int32, (
        ("context", POINTER(delam_context)), ("dimension", c_int32), ("lengths", POINTER(c_double)),
        ("divisions", POINTER(c_int64)), ("layer_count", c_int64), ("thickness", POINTER(c_double)),
        ("layer_divisions", POINTER(c_int64)), ("cell_type", c_int32), ("out", POINTER(POINTER(delam_mesh))))),
    "delam_mesh_add_cells": (c_int32, (
        ("mesh", POINTER(delam_mesh)), ("cell_type", c_int32), ("cell_count", c_int64),
        ("connectivity", POINTER(c_int64)), ("bodies", POINTER(c_int32)), ("index_base", c_int32))),
    "delam_mesh_add_conforming_cells": (c_int32, (
        ("mesh", POINTER(delam_mesh)), ("cell_type", c_int32), ("cell_count", c_int64),
        ("connectivity", POINTER(c_int64)), ("bodies", POINTER(c_int32)), ("index_base", c_int32))),
    "delam_mesh_add_interface": (c_int32, (
        ("mesh", POINTER(delam_mesh)), ("body_a", c_int32), ("body_b", c_int32), ("tolerance", c_double),
        ("out_interface", POINTER(c_int64)))),
    "delam_mesh_add_all_interfaces": (c_int32, (
        ("mesh", POINTER(delam_mesh)), ("tolerance", c_double), ("out_count", POINTER(c_int64)))),
    "delam_mesh_add_seams": (c_int32, (
        ("mesh", POINTER(delam_mesh)), ("tolerance", c_double), ("out_count", POINTER(c_int64)))),
    "delam_mesh_add_self_contact": (c_int32, (
        ("mesh", POINTER(delam_mesh)), ("gap", c_double), ("out_count", POINTER(c_int64)))),
    "delam_mesh_add_projected_interface": (c_int32, (
        ("mesh", POINTER(delam_mesh)), ("body_a", c_int32), ("body_b", c_int32), ("gap", c_double),
        ("out_interface", POINTER(c_int64)))),
    "delam_mesh_add_mortar_interface": (c_int32, (
        ("mesh", POINTER(delam_mesh)), ("body_a", c_int32), ("body_b", c_int32), ("gap", c_double),
        ("out_interface", POINTER(c_int64)))),
    "delam_mesh_add_obstacle": (c_int32, (
        ("mesh", POINTER(delam_mesh)), ("count", c_int64), ("nodes", POINTER(c_int64)), ("normals", POINTER(c_double)),
        ("weights", POINTER(c_double)), ("control_node", c_int64), ("index_base", c_int32),
        ("out_interface", POINTER(c_int64)))),
    "delam_mesh_add_host_body": (c_int32, (
        ("mesh", POINTER(delam_mesh)), ("body", c_int32), ("count", c_int64), ("nodes", POINTER(c_int64)),
        ("index_base", c_int32))),
    "delam_mesh_add_pairs": (c_int32, (
        ("mesh", POINTER(delam_mesh)), ("body_a", c_int32), ("body_b", c_int32), ("count", c_int64),
        ("nodes_a", POINTER(c_int64)), ("nodes_b", POINTER(c_int64)), ("normals", POINTER(c_double)),
        ("weights", POINTER(c_double)), ("face_count", c_int64), ("nodes_per_face", c_int32),
        ("faces", POINTER(c_int64)), ("index_base", c_int32), ("out_interface", POINTER(c_int64)))),
    "delam_mesh_destroy": (None, (("mesh", POINTER(POINTER(delam_mesh))),)),
    "delam_mesh_size": (c_int32, (
        ("mesh", POINTER(delam_mesh)), ("dimension", POINTER(c_int32)), ("node_count", POINTER(c_int64)),
        ("cell_count", POINTER(c_int64)), ("body_count", POINTER(c_int64)), ("interface_count", POINTER(c_int64)))),
    "delam_mesh_nodes": (c_int32, (("mesh", POINTER(delam_mesh)), ("capacity", c_int64), ("nodes", POINTER(c_double)))),
    "delam_mesh_node_bodies": (c_int32, (
        ("mesh", POINTER(delam_mesh)), ("capacity", c_int64), ("bodies", POINTER(c_int32)))),
    "delam_mesh_node_origins": (c_int32, (
        ("mesh", POINTER(delam_mesh)), ("capacity", c_int64), ("origins", POINTER(c_int64)))),
    "delam_mesh_node_ties": (c_int32, (
        ("mesh", POINTER(delam_mesh)), ("count", POINTER(c_int64)), ("entries", POINTER(c_int64)),
        ("nodes", POINTER(c_int64)), ("starts", POINTER(c_int64)), ("of", POINTER(c_int64)),
        ("weights", POINTER(c_double)))),
    "delam_mesh_cells": (c_int32, (
        ("mesh", POINTER(delam_mesh)), ("types", POINTER(c_int32)), ("bodies", POINTER(c_int32)),
        ("offsets", POINTER(c_int64)), ("capacity", c_int64), ("connectivity", POINTER(c_int64)),
        ("needed", POINTER(c_int64)))),
    "delam_mesh_interface_size": (c_int32, (
        ("mesh", POINTER(delam_mesh)), ("interface_index", c_int64), ("body_a", POINTER(c_int32)),
        ("body_b", POINTER(c_int32)), ("pair_count", POINTER(c_int64)), ("face_count", POINTER(c_int64)),
        ("nodes_per_face", POINTER(c_int32)))),
    "delam_mesh_interface_pairs": (c_int32, (
        ("mesh", POINTER(delam_mesh)), ("interface_index", c_int64), ("nodes_a", POINTER(c_int64)),
        ("nodes_b", POINTER(c_int64)), ("weights", POINTER(c_double)), ("frames", POINTER(c_double)))),
    "delam_mesh_interface_faces": (c_int32, (
        ("mesh", POINTER(delam_mesh)), ("interface_index", c_int64), ("faces", POINTER(c_int64)))),
    "delam_mesh_find_nodes": (c_int32, (
        ("mesh", POINTER(delam_mesh)), ("body", c_int32), ("lower", POINTER(c_double)), ("upper", POINTER(c_double)),
        ("capacity", c_int64), ("nodes", POINTER(c_int64)), ("count", POINTER(c_int64)))),
    "delam_mesh_find_patch": (c_int32, (
        ("mesh", POINTER(delam_mesh)), ("body", c_int32), ("lower", POINTER(c_double)), ("upper", POINTER(c_double)),
        ("direction", POINTER(c_double)), ("capacity", c_int64), ("nodes", POINTER(c_int64)),
        ("weights", POINTER(c_double)), ("count", POINTER(c_int64)))),
    "delam_law_create": (c_int32, (
        ("context", POINTER(delam_context)), ("kind", c_char_p), ("out", POINTER(POINTER(delam_law))))),
    "delam_law_set": (c_int32, (("law", POINTER(delam_law)), ("key", c_char_p), ("value", c_double))),
    "delam_law_set_text": (c_int32, (("law", POINTER(delam_law)), ("key", c_char_p), ("value", c_char_p))),
    "delam_law_set_table": (c_int32, (
        ("law", POINTER(delam_law)), ("count", c_int64), ("xi", POINTER(c_double)), ("s", POINTER(c_double)))),
    "delam_law_parameter_count": (c_int64, (("kind", c_char_p),)),
    "delam_law_parameter_info": (c_int32, (
        ("kind", c_char_p), ("index", c_int64), ("key", POINTER(c_char_p)), ("type", POINTER(c_char_p)),
        ("unit", POINTER(c_char_p)), ("initial", POINTER(c_char_p)), ("range", POINTER(c_char_p)),
        ("meaning", POINTER(c_char_p)))),
    "delam_law_parameter_bounds": (c_int32, (
        ("kind", c_char_p), ("index", c_int64), ("lower", POINTER(c_double)), ("upper", POINTER(c_double)),
        ("lower_open", POINTER(c_int32)), ("upper_open", POINTER(c_int32)))),
    "delam_law_kind_count": (c_int64, ()),
    "delam_law_kind_info": (c_int32, (
        ("index", c_int64), ("kind", POINTER(c_char_p)), ("meaning", POINTER(c_char_p)), ("hosted", POINTER(c_int32)))),
    "delam_law_create_host": (c_int32, (
        ("context", POINTER(delam_context)), ("name", c_char_p), ("adhesion", delam_adhesion_callback),
        ("dissipation", delam_dissipation_callback), ("user", c_void_p), ("out", POINTER(POINTER(delam_law))))),
    "delam_law_check": (c_int32, (("law", POINTER(delam_law)),)),
    "delam_law_toughness": (c_int32, (
        ("law", POINTER(delam_law)), ("count", c_int64), ("mixity", POINTER(c_double)), ("onset", POINTER(c_double)),
        ("toughness", POINTER(c_double)))),
    "delam_law_respond": (c_int32, (
        ("law", POINTER(delam_law)), ("dimension", c_int32), ("count", c_int64), ("jump", POINTER(c_double)),
        ("mixity", POINTER(c_double)), ("adhesion_old", POINTER(c_double)), ("adhesion", POINTER(c_double)),
        ("traction", POINTER(c_double)))),
    "delam_law_destroy": (None, (("law", POINTER(POINTER(delam_law))),)),
    "delam_problem_create": (c_int32, (
        ("context", POINTER(delam_context)), ("mesh", POINTER(delam_mesh)), ("out", POINTER(POINTER(delam_problem))))),
    "delam_problem_destroy": (None, (("problem", POINTER(POINTER(delam_problem))),)),
    "delam_problem_set_plane": (c_int32, (("problem", POINTER(delam_problem)), ("assumption", c_char_p))),
    "delam_problem_set_elastic": (c_int32, (
        ("problem", POINTER(delam_problem)), ("body", c_int32), ("young", c_double), ("poisson", c_double))),
    "delam_problem_set_orthotropic": (c_int32, (
        ("problem", POINTER(delam_problem)), ("body", c_int32), ("constants", POINTER(c_double)))),
    "delam_problem_set_orientation": (c_int32, (
        ("problem", POINTER(delam_problem)), ("body", c_int32), ("count", c_int64), ("cells", POINTER(c_int64)),
        ("axes", POINTER(c_double)), ("index_base", c_int32))),
    "delam_problem_set_formulation": (c_int32, (
        ("problem", POINTER(delam_problem)), ("body", c_int32), ("formulation", c_char_p))),
    "delam_problem_set_stiffness": (c_int32, (
        ("problem", POINTER(delam_problem)), ("count", c_int64), ("nodes", POINTER(c_int64)),
        ("dofs", POINTER(c_int64)), ("row_starts", POINTER(c_int64)), ("columns", POINTER(c_int64)),
        ("values", POINTER(c_double)), ("kernel_count", c_int64), ("kernel", POINTER(c_double)), ("index_base", c_int32)
    )),
    "delam_problem_set_law": (c_int32, (
        ("problem", POINTER(delam_problem)), ("interface_index", c_int64), ("law", POINTER(delam_law)))),
    "delam_problem_set_bonded": (c_int32, (("problem", POINTER(delam_problem)), ("interface_index", c_int64))),
    "delam_problem_set_contact": (c_int32, (("problem", POINTER(delam_problem)), ("interface_index", c_int64))),
    "delam_problem_set_adhesion": (c_int32, (
        ("problem", POINTER(delam_problem)), ("interface_index", c_int64), ("count", c_int64),
        ("pairs", POINTER(c_int64)), ("adhesion", POINTER(c_double)), ("index_base", c_int32))),
    "delam_problem_set_adhesion_box": (c_int32, (
        ("problem", POINTER(delam_problem)), ("interface_index", c_int64), ("lower", POINTER(c_double)),
        ("upper", POINTER(c_double)), ("adhesion", c_double), ("count", POINTER(c_int64)))),
    "delam_problem_add_pattern": (c_int32, (
        ("problem", POINTER(delam_problem)), ("name", c_char_p), ("count", c_int64), ("times", POINTER(c_double)),
        ("values", POINTER(c_double)), ("out_pattern", POINTER(c_int64)))),
    "delam_problem_prescribe_nodes": (c_int32, (
        ("problem", POINTER(delam_problem)), ("count", c_int64), ("nodes", POINTER(c_int64)),
        ("direction", POINTER(c_double)), ("pattern_count", c_int64), ("patterns", POINTER(c_int64)),
        ("coefficients", POINTER(c_double)), ("index_base", c_int32))),
    "delam_problem_prescribe_mean": (c_int32, (
        ("problem", POINTER(delam_problem)), ("count", c_int64), ("nodes", POINTER(c_int64)),
        ("weights", POINTER(c_double)), ("direction", POINTER(c_double)), ("pattern_count", c_int64),
        ("patterns", POINTER(c_int64)), ("coefficients", POINTER(c_double)), ("index_base", c_int32))),
    "delam_problem_add_equation": (c_int32, (
        ("problem", POINTER(delam_problem)), ("count", c_int64), ("nodes", POINTER(c_int64)),
        ("coefficients", POINTER(c_double)), ("pattern_count", c_int64), ("patterns", POINTER(c_int64)),
        ("prescribed", POINTER(c_double)), ("index_base", c_int32))),
    "delam_problem_begin_constraints": (c_int32, (
        ("problem", POINTER(delam_problem)), ("first", c_int64), ("count", c_int64), ("time", c_double),
        ("pattern", c_int64))),
    "delam_problem_end_constraints": (c_int32, (
        ("problem", POINTER(delam_problem)), ("first", c_int64), ("count", c_int64), ("time", c_double),
        ("pattern", c_int64))),
    "delam_problem_add_periodic": (c_int32, (
        ("problem", POINTER(delam_problem)), ("period_count", c_int64), ("periods", POINTER(c_double)),
        ("control_nodes", POINTER(c_int64)), ("tolerance", c_double), ("index_base", c_int32))),
    "delam_problem_add_forces": (c_int32, (
        ("problem", POINTER(delam_problem)), ("pattern", c_int64), ("count", c_int64), ("nodes", POINTER(c_int64)),
        ("forces", POINTER(c_double)), ("index_base", c_int32))),
    "delam_problem_add_eigenstrain": (c_int32, (
        ("problem", POINTER(delam_problem)), ("pattern", c_int64), ("body", c_int32), ("strain", POINTER(c_double)))),
    "delam_problem_set_gaps": (c_int32, (
        ("problem", POINTER(delam_problem)), ("interface_index", c_int64), ("pattern", c_int64),
        ("gaps", POINTER(c_double)), ("adjust", c_double))),
    "delam_problem_set_number": (c_int32, (
        ("problem", POINTER(delam_problem)), ("key", c_char_p), ("value", c_double))),
    "delam_problem_set_text": (c_int32, (("problem", POINTER(delam_problem)), ("key", c_char_p), ("value", c_char_p))),
    "delam_option_count": (c_int64, ()),
    "delam_option_info": (c_int32, (
        ("index", c_int64), ("key", POINTER(c_char_p)), ("type", POINTER(c_char_p)), ("unit", POINTER(c_char_p)),
        ("initial", POINTER(c_char_p)), ("range", POINTER(c_char_p)), ("meaning", POINTER(c_char_p)))),
    "delam_option_alias": (c_int32, (("index", c_int64), ("alias", POINTER(c_char_p)))),
    "delam_option_bounds": (c_int32, (
        ("index", c_int64), ("lower", POINTER(c_double)), ("upper", POINTER(c_double)),
        ("lower_open", POINTER(c_int32)), ("upper_open", POINTER(c_int32)))),
    "delam_problem_check": (c_int32, (("problem", POINTER(delam_problem)),)),
    "delam_problem_hash": (c_int32, (("problem", POINTER(delam_problem)), ("out", POINTER(c_char)))),
    "delam_problem_dofs": (c_int32, (
        ("problem", POINTER(delam_problem)), ("primal", POINTER(c_int64)), ("dual", POINTER(c_int64)))),
    "delam_problem_process_zone": (c_int32, (
        ("problem", POINTER(delam_problem)), ("interface_index", c_int64), ("length", POINTER(c_double)),
        ("spacing", POINTER(c_double)))),
    "delam_problem_propose": (c_int32, (
        ("problem", POINTER(delam_problem)), ("interface_index", c_int64), ("pairs", c_double),
        ("stiffness", POINTER(c_double)), ("share", POINTER(c_double)), ("normal_strength", POINTER(c_double)),
        ("tangential_strength", POINTER(c_double)))),
    "delam_problem_body_matrix": (c_int32, (
        ("problem", POINTER(delam_problem)), ("body", c_int32), ("rows", POINTER(c_int64)),
        ("entries", POINTER(c_int64)), ("row_starts", POINTER(c_int64)), ("columns", POINTER(c_int64)),
        ("values", POINTER(c_double)))),
    "delam_problem_constraints": (c_int32, (
        ("problem", POINTER(delam_problem)), ("rows", POINTER(c_int64)), ("entries", POINTER(c_int64)),
        ("pattern_count", POINTER(c_int64)), ("row_starts", POINTER(c_int64)), ("columns", POINTER(c_int64)),
        ("values", POINTER(c_double)), ("coefficients", POINTER(c_double)))),
    "delam_problem_forces": (c_int32, (
        ("problem", POINTER(delam_problem)), ("pattern", c_int64), ("capacity", c_int64), ("forces", POINTER(c_double))
    )),
    "delam_problem_eigenstrain_energy": (c_int32, (
        ("problem", POINTER(delam_problem)), ("capacity", c_int64), ("matrix", POINTER(c_double)))),
    "delam_problem_factors": (c_int32, (
        ("problem", POINTER(delam_problem)), ("time", c_double), ("capacity", c_int64), ("factors", POINTER(c_double))
    )),
    "delam_problem_pattern_count": (c_int32, (("problem", POINTER(delam_problem)), ("count", POINTER(c_int64)))),
    "delam_problem_pattern_name": (c_char_p, (("problem", POINTER(delam_problem)), ("pattern", c_int64))),
    "delam_problem_option": (c_char_p, (("problem", POINTER(delam_problem)), ("key", c_char_p))),
    "delam_problem_value_count": (c_int32, (("problem", POINTER(delam_problem)), ("count", POINTER(c_int64)))),
    "delam_problem_value_info": (c_int32, (
        ("problem", POINTER(delam_problem)), ("index", c_int64), ("key", POINTER(c_char_p)),
        ("alias", POINTER(c_char_p)))),
    "delam_problem_plan": (c_int32, (
        ("problem", POINTER(delam_problem)), ("plan", POINTER(c_char_p)), ("setup", POINTER(c_double)),
        ("memory", POINTER(c_double)))),
    "delam_solver_create": (c_int32, (
        ("problem", POINTER(delam_problem)), ("time", c_double), ("out", POINTER(POINTER(delam_solver))))),
    "delam_solver_create_like": (c_int32, (
        ("problem", POINTER(delam_problem)), ("other", POINTER(delam_solver)), ("time", c_double),
        ("out", POINTER(POINTER(delam_solver))))),
    "delam_solver_shares_bodies": (c_int32, (
        ("solver", POINTER(delam_solver)), ("problem", POINTER(delam_problem)), ("shares", POINTER(c_int32)))),
    "delam_solver_destroy": (None, (("solver", POINTER(POINTER(delam_solver))),)),
    "delam_solver_advance": (c_int32, (("solver", POINTER(delam_solver)), ("time", c_double))),
    "delam_solver_commit": (c_int32, (("solver", POINTER(delam_solver)),)),
    "delam_solver_rollback": (c_int32, (("solver", POINTER(delam_solver)),)),
    "delam_solver_pending": (c_int32, (("solver", POINTER(delam_solver)), ("pending", POINTER(c_int32)))),
    "delam_solver_set_history": (c_int32, (
        ("solver", POINTER(delam_solver)), ("pattern", c_int64), ("count", c_int64), ("times", POINTER(c_double)),
        ("values", POINTER(c_double)))),
    "delam_solver_equilibrate": (c_int32, (
        ("solver", POINTER(delam_solver)), ("time", c_double), ("adhesion", POINTER(c_double)))),
    "delam_solver_value": (c_int32, (
        ("solver", POINTER(delam_solver)), ("key", c_char_p), ("value", POINTER(c_double)))),
    "delam_solver_value_count": (c_int32, (("solver", POINTER(delam_solver)), ("count", POINTER(c_int64)))),
    "delam_solver_value_name": (c_char_p, (("solver", POINTER(delam_solver)), ("index", c_int64))),
    "delam_solver_value_info": (c_int32, (
        ("solver", POINTER(delam_solver)), ("index", c_int64), ("alias", POINTER(c_char_p)),
        ("unit", POINTER(c_char_p)), ("cost", POINTER(c_char_p)), ("scope", POINTER(c_char_p)),
        ("meaning", POINTER(c_char_p)), ("recorded", POINTER(c_int32)))),
    "delam_solver_record": (c_int32, (("solver", POINTER(delam_solver)), ("key", c_char_p))),
    "delam_solver_recorded_size": (c_int32, (
        ("solver", POINTER(delam_solver)), ("first", POINTER(c_int64)), ("steps", POINTER(c_int64)))),
    "delam_solver_recorded": (c_int32, (
        ("solver", POINTER(delam_solver)), ("key", c_char_p), ("capacity", c_int64), ("values", POINTER(c_double)))),
    "delam_solver_field_shape": (c_int32, (
        ("solver", POINTER(delam_solver)), ("key", c_char_p), ("part", c_int64), ("rows", POINTER(c_int64)),
        ("columns", POINTER(c_int64)))),
    "delam_solver_field": (c_int32, (
        ("solver", POINTER(delam_solver)), ("key", c_char_p), ("part", c_int64), ("capacity", c_int64),
        ("values", POINTER(c_double)))),
    "delam_solver_average": (c_int32, (
        ("solver", POINTER(delam_solver)), ("body", c_int32), ("volume", POINTER(c_double)),
        ("strain", POINTER(c_double)), ("stress", POINTER(c_double)))),
    "delam_solver_front_count": (c_int32, (
        ("solver", POINTER(delam_solver)), ("interface_index", c_int64), ("fronts", POINTER(c_int64)),
        ("points", POINTER(c_int64)))),
    "delam_solver_front": (c_int32, (
        ("solver", POINTER(delam_solver)), ("interface_index", c_int64), ("front_capacity", c_int64),
        ("point_capacity", c_int64), ("starts", POINTER(c_int64)), ("closed", POINTER(c_int32)),
        ("places", POINTER(c_double)), ("directions", POINTER(c_double)), ("lengths", POINTER(c_double)),
        ("rates", POINTER(c_double)), ("zone_lengths", POINTER(c_double)), ("zone_pairs", POINTER(c_double)))),
    "delam_solver_tangent": (c_int32, (
        ("solver", POINTER(delam_solver)), ("capacity", c_int64), ("matrix", POINTER(c_double)))),
    "delam_solver_step_tangent": (c_int32, (
        ("solver", POINTER(delam_solver)), ("capacity", c_int64), ("matrix", POINTER(c_double)))),
    "delam_solver_condensed_size": (c_int32, (
        ("solver", POINTER(delam_solver)), ("unknowns", POINTER(c_int64)), ("entries", POINTER(c_int64)))),
    "delam_solver_condensed": (c_int32, (
        ("solver", POINTER(delam_solver)), ("capacity", c_int64), ("stiffness", POINTER(c_double)),
        ("load", POINTER(c_double)), ("constant", POINTER(c_double)), ("row_starts", POINTER(c_int64)),
        ("columns", POINTER(c_int64)), ("values", POINTER(c_double)), ("offset", POINTER(c_double)))),
    "delam_solver_plan": (c_char_p, (("solver", POINTER(delam_solver)),)),
    "delam_solver_plan_count": (c_int32, (("solver", POINTER(delam_solver)), ("count", POINTER(c_int64)))),
    "delam_solver_plan_item": (c_int32, (
        ("solver", POINTER(delam_solver)), ("index", c_int64), ("subject", POINTER(c_char_p)),
        ("decision", POINTER(c_char_p)), ("reason", POINTER(c_char_p)), ("cost", POINTER(c_double)),
        ("saving", POINTER(c_double)), ("unit", POINTER(c_char_p)))),
    "delam_solver_option": (c_char_p, (("solver", POINTER(delam_solver)), ("key", c_char_p))),
    "delam_solver_searched": (c_char_p, (("solver", POINTER(delam_solver)),)),
    "delam_solver_look": (c_int32, (("solver", POINTER(delam_solver)), ("step", c_int64))),
    "delam_solver_jump_count": (c_int32, (("solver", POINTER(delam_solver)), ("count", POINTER(c_int64)))),
    "delam_solver_jump": (c_int32, (
        ("solver", POINTER(delam_solver)), ("index", c_int64), ("step", POINTER(c_int64)),
        ("before", POINTER(c_double)), ("time", POINTER(c_double)), ("stored", POINTER(c_double)),
        ("dissipated", POINTER(c_double)), ("released", POINTER(c_double)), ("debonded", POINTER(c_double)),
        ("interface_index", POINTER(c_int64)), ("first_pair", POINTER(c_int64)), ("last_pair", POINTER(c_int64)))),
    "delam_solver_jump_reactions": (c_int32, (
        ("solver", POINTER(delam_solver)), ("index", c_int64), ("capacity", c_int64), ("before", POINTER(c_double)),
        ("after", POINTER(c_double)))),
    "delam_solver_save": (c_int32, (
        ("solver", POINTER(delam_solver)), ("capacity", c_int64), ("bytes", POINTER(c_uint8)),
        ("needed", POINTER(c_int64)))),
    "delam_solver_load": (c_int32, (("solver", POINTER(delam_solver)), ("size", c_int64), ("bytes", POINTER(c_uint8)))),
    "delam_solver_save_file": (c_int32, (("solver", POINTER(delam_solver)), ("path", c_char_p))),
    "delam_solver_load_file": (c_int32, (("solver", POINTER(delam_solver)), ("path", c_char_p))),
}


def bind(library: CDLL) -> list[str]:
    """Gives the functions of a loaded library their types; returns the names that it lacks."""
    missing = []
    for name, (result, arguments) in FUNCTIONS.items():
        try:
            function = getattr(library, name)
        except AttributeError:
            missing.append(name)
            continue
        function.restype = result
        function.argtypes = [kind for _, kind in arguments]
    return missing
