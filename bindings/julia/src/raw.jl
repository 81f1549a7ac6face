# SPDX-License-Identifier: BSD-3-Clause
"""
The C interface, one to one. Generated from delam.h by tools/generate_raw.py: change that, not this.

Arguments are as in C: indices from 0 unless an `index_base` says so, `C_NULL` where nothing is meant. An
array is passed as it is, a number to be written as a `Ref`; nothing is checked.
"""
module Raw

# The SONAME: what library.jl has loaded under its full path is found again by it.
const libdelam = "libdelam.so.1"

const DELAM_ABI = Int32(1)
const DELAM_OK = Int32(0)
const DELAM_NOT_CONVERGED = Int32(1)
const DELAM_CANCELLED = Int32(2)
const DELAM_LIMIT = Int32(3)
const DELAM_ERROR_ARGUMENT = Int32(-1)
const DELAM_ERROR_HANDLE = Int32(-2)
const DELAM_ERROR_MESH = Int32(-3)
const DELAM_ERROR_PROBLEM = Int32(-4)
const DELAM_ERROR_STATE = Int32(-5)
const DELAM_ERROR_MEMORY = Int32(-6)
const DELAM_ERROR_NUMERICAL = Int32(-7)
const DELAM_ERROR_SNAPSHOT = Int32(-8)
const DELAM_ERROR_INTERNAL = Int32(-9)
const DELAM_ERROR_FILE = Int32(-10)
const DELAM_TRI3 = Int32(1)
const DELAM_QUAD4 = Int32(2)
const DELAM_TET4 = Int32(3)
const DELAM_HEX8 = Int32(4)
const DELAM_TRI6 = Int32(5)
const DELAM_QUAD8 = Int32(6)
const DELAM_QUAD9 = Int32(7)
const DELAM_TET10 = Int32(8)
const DELAM_HEX20 = Int32(9)
const DELAM_HEX27 = Int32(10)
const DELAM_WEDGE6 = Int32(11)
const DELAM_PYRAMID5 = Int32(12)
const DELAM_WEDGE15 = Int32(13)

# Opaque.
mutable struct delam_context end
mutable struct delam_mesh end
mutable struct delam_law end
mutable struct delam_problem end
mutable struct delam_solver end

# @cfunction(f, Cvoid, (Int32, Cstring, Ptr{Cvoid}))
const delam_log_callback = Ptr{Cvoid}

# @cfunction(f, Int32, (Cstring, Int64, Int64, Ptr{Cvoid}))
const delam_progress_callback = Ptr{Cvoid}

# @cfunction(f, Int32, (Cdouble, Cdouble, Ptr{Cdouble}, Ptr{Cdouble}, Ptr{Cvoid}))
const delam_adhesion_callback = Ptr{Cvoid}

# @cfunction(f, Int32, (Cdouble, Cdouble, Ptr{Cdouble}, Ptr{Cdouble}, Ptr{Cdouble}, Ptr{Cvoid}))
const delam_dissipation_callback = Ptr{Cvoid}

function delam_version()
    @ccall libdelam.delam_version()::Cstring
end

function delam_commit()
    @ccall libdelam.delam_commit()::Cstring
end

function delam_abi()
    @ccall libdelam.delam_abi()::Int32
end

function delam_status_name(status)
    @ccall libdelam.delam_status_name(status::Int32)::Cstring
end

function delam_blas_threads()
    @ccall libdelam.delam_blas_threads()::Int32
end

function delam_context_create(out)
    @ccall libdelam.delam_context_create(out::Ptr{Ptr{delam_context}})::Int32
end

function delam_context_destroy(context)
    @ccall libdelam.delam_context_destroy(context::Ptr{Ptr{delam_context}})::Cvoid
end

function delam_context_message(context)
    @ccall libdelam.delam_context_message(context::Ptr{delam_context})::Cstring
end

function delam_context_set_log(context, callback, user)
    @ccall libdelam.delam_context_set_log(context::Ptr{delam_context}, callback::delam_log_callback,
        user::Ptr{Cvoid})::Int32
end

function delam_context_set_progress(context, callback, user)
    @ccall libdelam.delam_context_set_progress(context::Ptr{delam_context}, callback::delam_progress_callback,
        user::Ptr{Cvoid})::Int32
end

function delam_context_cancel(context)
    @ccall libdelam.delam_context_cancel(context::Ptr{delam_context})::Int32
end

function delam_cell_type_count()
    @ccall libdelam.delam_cell_type_count()::Int64
end

function delam_cell_type_info(index, name, cell_type, dimension, nodes, corners, faces, face_nodes, face_corners)
    @ccall libdelam.delam_cell_type_info(index::Int64, name::Ptr{Cstring}, cell_type::Ptr{Int32},
        dimension::Ptr{Int32}, nodes::Ptr{Int32}, corners::Ptr{Int32}, faces::Ptr{Int32},
        face_nodes::Ptr{Int32}, face_corners::Ptr{Int32})::Int32
end

function delam_cell_type_topology(index, face, middle)
    @ccall libdelam.delam_cell_type_topology(index::Int64, face::Ptr{Int32}, middle::Ptr{Int32})::Int32
end

function delam_mesh_create(context, dimension, node_count, nodes, out)
    @ccall libdelam.delam_mesh_create(context::Ptr{delam_context}, dimension::Int32, node_count::Int64,
        nodes::Ptr{Cdouble}, out::Ptr{Ptr{delam_mesh}})::Int32
end

function delam_mesh_create_layers(context, dimension, lengths, divisions, layer_count, thickness, layer_divisions,
                                  cell_type, out)
    @ccall libdelam.delam_mesh_create_layers(context::Ptr{delam_context}, dimension::Int32,
        lengths::Ptr{Cdouble}, divisions::Ptr{Int64}, layer_count::Int64, thickness::Ptr{Cdouble},
        layer_divisions::Ptr{Int64}, cell_type::Int32, out::Ptr{Ptr{delam_mesh}})::Int32
end

function delam_mesh_add_cells(mesh, cell_type, cell_count, connectivity, bodies, index_base)
    @ccall libdelam.delam_mesh_add_cells(mesh::Ptr{delam_mesh}, cell_type::Int32, cell_count::Int64,
        connectivity::Ptr{Int64}, bodies::Ptr{Int32}, index_base::Int32)::Int32
end

function delam_mesh_add_conforming_cells(mesh, cell_type, cell_count, connectivity, bodies, index_base)
    @ccall libdelam.delam_mesh_add_conforming_cells(mesh::Ptr{delam_mesh}, cell_type::Int32, cell_count::Int64,
        connectivity::Ptr{Int64}, bodies::Ptr{Int32}, index_base::Int32)::Int32
end

function delam_mesh_add_interface(mesh, body_a, body_b, tolerance, out_interface)
    @ccall libdelam.delam_mesh_add_interface(mesh::Ptr{delam_mesh}, body_a::Int32, body_b::Int32,
        tolerance::Cdouble, out_interface::Ptr{Int64})::Int32
end

function delam_mesh_add_all_interfaces(mesh, tolerance, out_count)
    @ccall libdelam.delam_mesh_add_all_interfaces(mesh::Ptr{delam_mesh}, tolerance::Cdouble,
        out_count::Ptr{Int64})::Int32
end

function delam_mesh_add_seams(mesh, tolerance, out_count)
    @ccall libdelam.delam_mesh_add_seams(mesh::Ptr{delam_mesh}, tolerance::Cdouble, out_count::Ptr{Int64})::Int32
end

function delam_mesh_add_self_contact(mesh, gap, out_count)
    @ccall libdelam.delam_mesh_add_self_contact(mesh::Ptr{delam_mesh}, gap::Cdouble, out_count::Ptr{Int64})::Int32
end

function delam_mesh_add_projected_interface(mesh, body_a, body_b, gap, out_interface)
    @ccall libdelam.delam_mesh_add_projected_interface(mesh::Ptr{delam_mesh}, body_a::Int32, body_b::Int32,
        gap::Cdouble, out_interface::Ptr{Int64})::Int32
end

function delam_mesh_add_mortar_interface(mesh, body_a, body_b, gap, out_interface)
    @ccall libdelam.delam_mesh_add_mortar_interface(mesh::Ptr{delam_mesh}, body_a::Int32, body_b::Int32,
        gap::Cdouble, out_interface::Ptr{Int64})::Int32
end

function delam_mesh_add_obstacle(mesh, count, nodes, normals, weights, control_node, index_base, out_interface)
    @ccall libdelam.delam_mesh_add_obstacle(mesh::Ptr{delam_mesh}, count::Int64, nodes::Ptr{Int64},
        normals::Ptr{Cdouble}, weights::Ptr{Cdouble}, control_node::Int64, index_base::Int32,
        out_interface::Ptr{Int64})::Int32
end

function delam_mesh_add_host_body(mesh, body, count, nodes, index_base)
    @ccall libdelam.delam_mesh_add_host_body(mesh::Ptr{delam_mesh}, body::Int32, count::Int64,
        nodes::Ptr{Int64}, index_base::Int32)::Int32
end

function delam_mesh_add_pairs(mesh, body_a, body_b, count, nodes_a, nodes_b, normals, weights, face_count,
                              nodes_per_face, faces, index_base, out_interface)
    @ccall libdelam.delam_mesh_add_pairs(mesh::Ptr{delam_mesh}, body_a::Int32, body_b::Int32, count::Int64,
        nodes_a::Ptr{Int64}, nodes_b::Ptr{Int64}, normals::Ptr{Cdouble}, weights::Ptr{Cdouble},
        face_count::Int64, nodes_per_face::Int32, faces::Ptr{Int64}, index_base::Int32,
        out_interface::Ptr{Int64})::Int32
end

function delam_mesh_destroy(mesh)
    @ccall libdelam.delam_mesh_destroy(mesh::Ptr{Ptr{delam_mesh}})::Cvoid
end

function delam_mesh_size(mesh, dimension, node_count, cell_count, body_count, interface_count)
    @ccall libdelam.delam_mesh_size(mesh::Ptr{delam_mesh}, dimension::Ptr{Int32}, node_count::Ptr{Int64},
        cell_count::Ptr{Int64}, body_count::Ptr{Int64}, interface_count::Ptr{Int64})::Int32
end

function delam_mesh_nodes(mesh, capacity, nodes)
    @ccall libdelam.delam_mesh_nodes(mesh::Ptr{delam_mesh}, capacity::Int64, nodes::Ptr{Cdouble})::Int32
end

function delam_mesh_node_bodies(mesh, capacity, bodies)
    @ccall libdelam.delam_mesh_node_bodies(mesh::Ptr{delam_mesh}, capacity::Int64, bodies::Ptr{Int32})::Int32
end

function delam_mesh_node_origins(mesh, capacity, origins)
    @ccall libdelam.delam_mesh_node_origins(mesh::Ptr{delam_mesh}, capacity::Int64, origins::Ptr{Int64})::Int32
end

function delam_mesh_node_ties(mesh, count, entries, nodes, starts, of, weights)
    @ccall libdelam.delam_mesh_node_ties(mesh::Ptr{delam_mesh}, count::Ptr{Int64}, entries::Ptr{Int64},
        nodes::Ptr{Int64}, starts::Ptr{Int64}, of::Ptr{Int64}, weights::Ptr{Cdouble})::Int32
end

function delam_mesh_cells(mesh, types, bodies, offsets, capacity, connectivity, needed)
    @ccall libdelam.delam_mesh_cells(mesh::Ptr{delam_mesh}, types::Ptr{Int32}, bodies::Ptr{Int32},
        offsets::Ptr{Int64}, capacity::Int64, connectivity::Ptr{Int64}, needed::Ptr{Int64})::Int32
end

function delam_mesh_interface_size(mesh, interface_index, body_a, body_b, pair_count, face_count, nodes_per_face)
    @ccall libdelam.delam_mesh_interface_size(mesh::Ptr{delam_mesh}, interface_index::Int64, body_a::Ptr{Int32},
        body_b::Ptr{Int32}, pair_count::Ptr{Int64}, face_count::Ptr{Int64}, nodes_per_face::Ptr{Int32})::Int32
end

function delam_mesh_interface_pairs(mesh, interface_index, nodes_a, nodes_b, weights, frames)
    @ccall libdelam.delam_mesh_interface_pairs(mesh::Ptr{delam_mesh}, interface_index::Int64,
        nodes_a::Ptr{Int64}, nodes_b::Ptr{Int64}, weights::Ptr{Cdouble}, frames::Ptr{Cdouble})::Int32
end

function delam_mesh_interface_faces(mesh, interface_index, faces)
    @ccall libdelam.delam_mesh_interface_faces(mesh::Ptr{delam_mesh}, interface_index::Int64, faces::Ptr{Int64})::Int32
end

function delam_mesh_find_nodes(mesh, body, lower, upper, capacity, nodes, count)
    @ccall libdelam.delam_mesh_find_nodes(mesh::Ptr{delam_mesh}, body::Int32, lower::Ptr{Cdouble},
        upper::Ptr{Cdouble}, capacity::Int64, nodes::Ptr{Int64}, count::Ptr{Int64})::Int32
end

function delam_mesh_find_patch(mesh, body, lower, upper, direction, capacity, nodes, weights, count)
    @ccall libdelam.delam_mesh_find_patch(mesh::Ptr{delam_mesh}, body::Int32, lower::Ptr{Cdouble},
        upper::Ptr{Cdouble}, direction::Ptr{Cdouble}, capacity::Int64, nodes::Ptr{Int64}, weights::Ptr{Cdouble},
        count::Ptr{Int64})::Int32
end

function delam_law_create(context, kind, out)
    @ccall libdelam.delam_law_create(context::Ptr{delam_context}, kind::Cstring, out::Ptr{Ptr{delam_law}})::Int32
end

function delam_law_set(law, key, value)
    @ccall libdelam.delam_law_set(law::Ptr{delam_law}, key::Cstring, value::Cdouble)::Int32
end

function delam_law_set_text(law, key, value)
    @ccall libdelam.delam_law_set_text(law::Ptr{delam_law}, key::Cstring, value::Cstring)::Int32
end

function delam_law_set_table(law, count, xi, s)
    @ccall libdelam.delam_law_set_table(law::Ptr{delam_law}, count::Int64, xi::Ptr{Cdouble}, s::Ptr{Cdouble})::Int32
end

function delam_law_parameter_count(kind)
    @ccall libdelam.delam_law_parameter_count(kind::Cstring)::Int64
end

function delam_law_parameter_info(kind, index, key, type, unit, initial, range, meaning)
    @ccall libdelam.delam_law_parameter_info(kind::Cstring, index::Int64, key::Ptr{Cstring}, type::Ptr{Cstring},
        unit::Ptr{Cstring}, initial::Ptr{Cstring}, range::Ptr{Cstring}, meaning::Ptr{Cstring})::Int32
end

function delam_law_parameter_bounds(kind, index, lower, upper, lower_open, upper_open)
    @ccall libdelam.delam_law_parameter_bounds(kind::Cstring, index::Int64, lower::Ptr{Cdouble},
        upper::Ptr{Cdouble}, lower_open::Ptr{Int32}, upper_open::Ptr{Int32})::Int32
end

function delam_law_kind_count()
    @ccall libdelam.delam_law_kind_count()::Int64
end

function delam_law_kind_info(index, kind, meaning, hosted)
    @ccall libdelam.delam_law_kind_info(index::Int64, kind::Ptr{Cstring}, meaning::Ptr{Cstring},
        hosted::Ptr{Int32})::Int32
end

function delam_law_create_host(context, name, adhesion, dissipation, user, out)
    @ccall libdelam.delam_law_create_host(context::Ptr{delam_context}, name::Cstring,
        adhesion::delam_adhesion_callback, dissipation::delam_dissipation_callback, user::Ptr{Cvoid},
        out::Ptr{Ptr{delam_law}})::Int32
end

function delam_law_check(law)
    @ccall libdelam.delam_law_check(law::Ptr{delam_law})::Int32
end

function delam_law_toughness(law, count, mixity, onset, toughness)
    @ccall libdelam.delam_law_toughness(law::Ptr{delam_law}, count::Int64, mixity::Ptr{Cdouble},
        onset::Ptr{Cdouble}, toughness::Ptr{Cdouble})::Int32
end

function delam_law_respond(law, dimension, count, jump, mixity, adhesion_old, adhesion, traction)
    @ccall libdelam.delam_law_respond(law::Ptr{delam_law}, dimension::Int32, count::Int64, jump::Ptr{Cdouble},
        mixity::Ptr{Cdouble}, adhesion_old::Ptr{Cdouble}, adhesion::Ptr{Cdouble}, traction::Ptr{Cdouble})::Int32
end

function delam_law_destroy(law)
    @ccall libdelam.delam_law_destroy(law::Ptr{Ptr{delam_law}})::Cvoid
end

function delam_problem_create(context, mesh, out)
    @ccall libdelam.delam_problem_create(context::Ptr{delam_context}, mesh::Ptr{delam_mesh},
        out::Ptr{Ptr{delam_problem}})::Int32
end

function delam_problem_destroy(problem)
    @ccall libdelam.delam_problem_destroy(problem::Ptr{Ptr{delam_problem}})::Cvoid
end

function delam_problem_set_plane(problem, assumption)
    @ccall libdelam.delam_problem_set_plane(problem::Ptr{delam_problem}, assumption::Cstring)::Int32
end

function delam_problem_set_elastic(problem, body, young, poisson)
    @ccall libdelam.delam_problem_set_elastic(problem::Ptr{delam_problem}, body::Int32, young::Cdouble,
        poisson::Cdouble)::Int32
end

function delam_problem_set_orthotropic(problem, body, constants)
    @ccall libdelam.delam_problem_set_orthotropic(problem::Ptr{delam_problem}, body::Int32,
        constants::Ptr{Cdouble})::Int32
end

function delam_problem_set_orientation(problem, body, count, cells, axes, index_base)
    @ccall libdelam.delam_problem_set_orientation(problem::Ptr{delam_problem}, body::Int32, count::Int64,
        cells::Ptr{Int64}, axes::Ptr{Cdouble}, index_base::Int32)::Int32
end

function delam_problem_set_formulation(problem, body, formulation)
    @ccall libdelam.delam_problem_set_formulation(problem::Ptr{delam_problem}, body::Int32, formulation::Cstring)::Int32
end

function delam_problem_set_stiffness(problem, count, nodes, dofs, row_starts, columns, values, kernel_count, kernel,
                                     index_base)
    @ccall libdelam.delam_problem_set_stiffness(problem::Ptr{delam_problem}, count::Int64, nodes::Ptr{Int64},
        dofs::Ptr{Int64}, row_starts::Ptr{Int64}, columns::Ptr{Int64}, values::Ptr{Cdouble},
        kernel_count::Int64, kernel::Ptr{Cdouble}, index_base::Int32)::Int32
end

function delam_problem_set_law(problem, interface_index, law)
    @ccall libdelam.delam_problem_set_law(problem::Ptr{delam_problem}, interface_index::Int64,
        law::Ptr{delam_law})::Int32
end

function delam_problem_set_bonded(problem, interface_index)
    @ccall libdelam.delam_problem_set_bonded(problem::Ptr{delam_problem}, interface_index::Int64)::Int32
end

function delam_problem_set_contact(problem, interface_index)
    @ccall libdelam.delam_problem_set_contact(problem::Ptr{delam_problem}, interface_index::Int64)::Int32
end

function delam_problem_set_adhesion(problem, interface_index, count, pairs, adhesion, index_base)
    @ccall libdelam.delam_problem_set_adhesion(problem::Ptr{delam_problem}, interface_index::Int64,
        count::Int64, pairs::Ptr{Int64}, adhesion::Ptr{Cdouble}, index_base::Int32)::Int32
end

function delam_problem_set_adhesion_box(problem, interface_index, lower, upper, adhesion, count)
    @ccall libdelam.delam_problem_set_adhesion_box(problem::Ptr{delam_problem}, interface_index::Int64,
        lower::Ptr{Cdouble}, upper::Ptr{Cdouble}, adhesion::Cdouble, count::Ptr{Int64})::Int32
end

function delam_problem_add_pattern(problem, name, count, times, values, out_pattern)
    @ccall libdelam.delam_problem_add_pattern(problem::Ptr{delam_problem}, name::Cstring, count::Int64,
        times::Ptr{Cdouble}, values::Ptr{Cdouble}, out_pattern::Ptr{Int64})::Int32
end

function delam_problem_prescribe_nodes(problem, count, nodes, direction, pattern_count, patterns, coefficients,
                                       index_base)
    @ccall libdelam.delam_problem_prescribe_nodes(problem::Ptr{delam_problem}, count::Int64, nodes::Ptr{Int64},
        direction::Ptr{Cdouble}, pattern_count::Int64, patterns::Ptr{Int64}, coefficients::Ptr{Cdouble},
        index_base::Int32)::Int32
end

function delam_problem_prescribe_mean(problem, count, nodes, weights, direction, pattern_count, patterns, coefficients,
                                      index_base)
    @ccall libdelam.delam_problem_prescribe_mean(problem::Ptr{delam_problem}, count::Int64, nodes::Ptr{Int64},
        weights::Ptr{Cdouble}, direction::Ptr{Cdouble}, pattern_count::Int64, patterns::Ptr{Int64},
        coefficients::Ptr{Cdouble}, index_base::Int32)::Int32
end

function delam_problem_add_equation(problem, count, nodes, coefficients, pattern_count, patterns, prescribed,
                                    index_base)
    @ccall libdelam.delam_problem_add_equation(problem::Ptr{delam_problem}, count::Int64, nodes::Ptr{Int64},
        coefficients::Ptr{Cdouble}, pattern_count::Int64, patterns::Ptr{Int64}, prescribed::Ptr{Cdouble},
        index_base::Int32)::Int32
end

function delam_problem_begin_constraints(problem, first, count, time, pattern)
    @ccall libdelam.delam_problem_begin_constraints(problem::Ptr{delam_problem}, first::Int64, count::Int64,
        time::Cdouble, pattern::Int64)::Int32
end

function delam_problem_end_constraints(problem, first, count, time, pattern)
    @ccall libdelam.delam_problem_end_constraints(problem::Ptr{delam_problem}, first::Int64, count::Int64,
        time::Cdouble, pattern::Int64)::Int32
end

function delam_problem_add_periodic(problem, period_count, periods, control_nodes, tolerance, index_base)
    @ccall libdelam.delam_problem_add_periodic(problem::Ptr{delam_problem}, period_count::Int64,
        periods::Ptr{Cdouble}, control_nodes::Ptr{Int64}, tolerance::Cdouble, index_base::Int32)::Int32
end

function delam_problem_add_forces(problem, pattern, count, nodes, forces, index_base)
    @ccall libdelam.delam_problem_add_forces(problem::Ptr{delam_problem}, pattern::Int64, count::Int64,
        nodes::Ptr{Int64}, forces::Ptr{Cdouble}, index_base::Int32)::Int32
end

function delam_problem_add_eigenstrain(problem, pattern, body, strain)
    @ccall libdelam.delam_problem_add_eigenstrain(problem::Ptr{delam_problem}, pattern::Int64, body::Int32,
        strain::Ptr{Cdouble})::Int32
end

function delam_problem_set_gaps(problem, interface_index, pattern, gaps, adjust)
    @ccall libdelam.delam_problem_set_gaps(problem::Ptr{delam_problem}, interface_index::Int64, pattern::Int64,
        gaps::Ptr{Cdouble}, adjust::Cdouble)::Int32
end

function delam_problem_set_number(problem, key, value)
    @ccall libdelam.delam_problem_set_number(problem::Ptr{delam_problem}, key::Cstring, value::Cdouble)::Int32
end

function delam_problem_set_text(problem, key, value)
    @ccall libdelam.delam_problem_set_text(problem::Ptr{delam_problem}, key::Cstring, value::Cstring)::Int32
end

function delam_option_count()
    @ccall libdelam.delam_option_count()::Int64
end

function delam_option_info(index, key, type, unit, initial, range, meaning)
    @ccall libdelam.delam_option_info(index::Int64, key::Ptr{Cstring}, type::Ptr{Cstring}, unit::Ptr{Cstring},
        initial::Ptr{Cstring}, range::Ptr{Cstring}, meaning::Ptr{Cstring})::Int32
end

function delam_option_alias(index, alias)
    @ccall libdelam.delam_option_alias(index::Int64, alias::Ptr{Cstring})::Int32
end

function delam_option_bounds(index, lower, upper, lower_open, upper_open)
    @ccall libdelam.delam_option_bounds(index::Int64, lower::Ptr{Cdouble}, upper::Ptr{Cdouble},
        lower_open::Ptr{Int32}, upper_open::Ptr{Int32})::Int32
end

function delam_problem_check(problem)
    @ccall libdelam.delam_problem_check(problem::Ptr{delam_problem})::Int32
end

function delam_problem_hash(problem, out)
    @ccall libdelam.delam_problem_hash(problem::Ptr{delam_problem}, out::Ptr{UInt8})::Int32
end

function delam_problem_dofs(problem, primal, dual)
    @ccall libdelam.delam_problem_dofs(problem::Ptr{delam_problem}, primal::Ptr{Int64}, dual::Ptr{Int64})::Int32
end

function delam_problem_process_zone(problem, interface_index, length, spacing)
    @ccall libdelam.delam_problem_process_zone(problem::Ptr{delam_problem}, interface_index::Int64,
        length::Ptr{Cdouble}, spacing::Ptr{Cdouble})::Int32
end

function delam_problem_propose(problem, interface_index, pairs, stiffness, share, normal_strength, tangential_strength)
    @ccall libdelam.delam_problem_propose(problem::Ptr{delam_problem}, interface_index::Int64, pairs::Cdouble,
        stiffness::Ptr{Cdouble}, share::Ptr{Cdouble}, normal_strength::Ptr{Cdouble},
        tangential_strength::Ptr{Cdouble})::Int32
end

function delam_problem_body_matrix(problem, body, rows, entries, row_starts, columns, values)
    @ccall libdelam.delam_problem_body_matrix(problem::Ptr{delam_problem}, body::Int32, rows::Ptr{Int64},
        entries::Ptr{Int64}, row_starts::Ptr{Int64}, columns::Ptr{Int64}, values::Ptr{Cdouble})::Int32
end

function delam_problem_constraints(problem, rows, entries, pattern_count, row_starts, columns, values, coefficients)
    @ccall libdelam.delam_problem_constraints(problem::Ptr{delam_problem}, rows::Ptr{Int64},
        entries::Ptr{Int64}, pattern_count::Ptr{Int64}, row_starts::Ptr{Int64}, columns::Ptr{Int64},
        values::Ptr{Cdouble}, coefficients::Ptr{Cdouble})::Int32
end

function delam_problem_forces(problem, pattern, capacity, forces)
    @ccall libdelam.delam_problem_forces(problem::Ptr{delam_problem}, pattern::Int64, capacity::Int64,
        forces::Ptr{Cdouble})::Int32
end

function delam_problem_eigenstrain_energy(problem, capacity, matrix)
    @ccall libdelam.delam_problem_eigenstrain_energy(problem::Ptr{delam_problem}, capacity::Int64,
        matrix::Ptr{Cdouble})::Int32
end

function delam_problem_factors(problem, time, capacity, factors)
    @ccall libdelam.delam_problem_factors(problem::Ptr{delam_problem}, time::Cdouble, capacity::Int64,
        factors::Ptr{Cdouble})::Int32
end

function delam_problem_pattern_count(problem, count)
    @ccall libdelam.delam_problem_pattern_count(problem::Ptr{delam_problem}, count::Ptr{Int64})::Int32
end

function delam_problem_pattern_name(problem, pattern)
    @ccall libdelam.delam_problem_pattern_name(problem::Ptr{delam_problem}, pattern::Int64)::Cstring
end

function delam_problem_option(problem, key)
    @ccall libdelam.delam_problem_option(problem::Ptr{delam_problem}, key::Cstring)::Cstring
end

function delam_problem_value_count(problem, count)
    @ccall libdelam.delam_problem_value_count(problem::Ptr{delam_problem}, count::Ptr{Int64})::Int32
end

function delam_problem_value_info(problem, index, key, alias)
    @ccall libdelam.delam_problem_value_info(problem::Ptr{delam_problem}, index::Int64, key::Ptr{Cstring},
        alias::Ptr{Cstring})::Int32
end

function delam_problem_plan(problem, plan, setup, memory)
    @ccall libdelam.delam_problem_plan(problem::Ptr{delam_problem}, plan::Ptr{Cstring}, setup::Ptr{Cdouble},
        memory::Ptr{Cdouble})::Int32
end

function delam_solver_create(problem, time, out)
    @ccall libdelam.delam_solver_create(problem::Ptr{delam_problem}, time::Cdouble, out::Ptr{Ptr{delam_solver}})::Int32
end

function delam_solver_create_like(problem, other, time, out)
    @ccall libdelam.delam_solver_create_like(problem::Ptr{delam_problem}, other::Ptr{delam_solver},
        time::Cdouble, out::Ptr{Ptr{delam_solver}})::Int32
end

function delam_solver_shares_bodies(solver, problem, shares)
    @ccall libdelam.delam_solver_shares_bodies(solver::Ptr{delam_solver}, problem::Ptr{delam_problem},
        shares::Ptr{Int32})::Int32
end

function delam_solver_destroy(solver)
    @ccall libdelam.delam_solver_destroy(solver::Ptr{Ptr{delam_solver}})::Cvoid
end

function delam_solver_advance(solver, time)
    @ccall libdelam.delam_solver_advance(solver::Ptr{delam_solver}, time::Cdouble)::Int32
end

function delam_solver_commit(solver)
    @ccall libdelam.delam_solver_commit(solver::Ptr{delam_solver})::Int32
end

function delam_solver_rollback(solver)
    @ccall libdelam.delam_solver_rollback(solver::Ptr{delam_solver})::Int32
end

function delam_solver_pending(solver, pending)
    @ccall libdelam.delam_solver_pending(solver::Ptr{delam_solver}, pending::Ptr{Int32})::Int32
end

function delam_solver_set_history(solver, pattern, count, times, values)
    @ccall libdelam.delam_solver_set_history(solver::Ptr{delam_solver}, pattern::Int64, count::Int64,
        times::Ptr{Cdouble}, values::Ptr{Cdouble})::Int32
end

function delam_solver_equilibrate(solver, time, adhesion)
    @ccall libdelam.delam_solver_equilibrate(solver::Ptr{delam_solver}, time::Cdouble, adhesion::Ptr{Cdouble})::Int32
end

function delam_solver_value(solver, key, value)
    @ccall libdelam.delam_solver_value(solver::Ptr{delam_solver}, key::Cstring, value::Ptr{Cdouble})::Int32
end

function delam_solver_value_count(solver, count)
    @ccall libdelam.delam_solver_value_count(solver::Ptr{delam_solver}, count::Ptr{Int64})::Int32
end

function delam_solver_value_name(solver, index)
    @ccall libdelam.delam_solver_value_name(solver::Ptr{delam_solver}, index::Int64)::Cstring
end

function delam_solver_value_info(solver, index, alias, unit, cost, scope, meaning, recorded)
    @ccall libdelam.delam_solver_value_info(solver::Ptr{delam_solver}, index::Int64, alias::Ptr{Cstring},
        unit::Ptr{Cstring}, cost::Ptr{Cstring}, scope::Ptr{Cstring}, meaning::Ptr{Cstring}, recorded::Ptr{Int32})::Int32
end

function delam_solver_record(solver, key)
    @ccall libdelam.delam_solver_record(solver::Ptr{delam_solver}, key::Cstring)::Int32
end

function delam_solver_recorded_size(solver, first, steps)
    @ccall libdelam.delam_solver_recorded_size(solver::Ptr{delam_solver}, first::Ptr{Int64}, steps::Ptr{Int64})::Int32
end

function delam_solver_recorded(solver, key, capacity, values)
    @ccall libdelam.delam_solver_recorded(solver::Ptr{delam_solver}, key::Cstring, capacity::Int64,
        values::Ptr{Cdouble})::Int32
end

function delam_solver_field_shape(solver, key, part, rows, columns)
    @ccall libdelam.delam_solver_field_shape(solver::Ptr{delam_solver}, key::Cstring, part::Int64,
        rows::Ptr{Int64}, columns::Ptr{Int64})::Int32
end

function delam_solver_field(solver, key, part, capacity, values)
    @ccall libdelam.delam_solver_field(solver::Ptr{delam_solver}, key::Cstring, part::Int64, capacity::Int64,
        values::Ptr{Cdouble})::Int32
end

function delam_solver_average(solver, body, volume, strain, stress)
    @ccall libdelam.delam_solver_average(solver::Ptr{delam_solver}, body::Int32, volume::Ptr{Cdouble},
        strain::Ptr{Cdouble}, stress::Ptr{Cdouble})::Int32
end

function delam_solver_front_count(solver, interface_index, fronts, points)
    @ccall libdelam.delam_solver_front_count(solver::Ptr{delam_solver}, interface_index::Int64,
        fronts::Ptr{Int64}, points::Ptr{Int64})::Int32
end

function delam_solver_front(solver, interface_index, front_capacity, point_capacity, starts, closed, places,
                            directions, lengths, rates, zone_lengths, zone_pairs)
    @ccall libdelam.delam_solver_front(solver::Ptr{delam_solver}, interface_index::Int64, front_capacity::Int64,
        point_capacity::Int64, starts::Ptr{Int64}, closed::Ptr{Int32}, places::Ptr{Cdouble},
        directions::Ptr{Cdouble}, lengths::Ptr{Cdouble}, rates::Ptr{Cdouble}, zone_lengths::Ptr{Cdouble},
        zone_pairs::Ptr{Cdouble})::Int32
end

function delam_solver_tangent(solver, capacity, matrix)
    @ccall libdelam.delam_solver_tangent(solver::Ptr{delam_solver}, capacity::Int64, matrix::Ptr{Cdouble})::Int32
end

function delam_solver_step_tangent(solver, capacity, matrix)
    @ccall libdelam.delam_solver_step_tangent(solver::Ptr{delam_solver}, capacity::Int64, matrix::Ptr{Cdouble})::Int32
end

function delam_solver_condensed_size(solver, unknowns, entries)
    @ccall libdelam.delam_solver_condensed_size(solver::Ptr{delam_solver}, unknowns::Ptr{Int64},
        entries::Ptr{Int64})::Int32
end

function delam_solver_condensed(solver, capacity, stiffness, load, constant, row_starts, columns, values, offset)
    @ccall libdelam.delam_solver_condensed(solver::Ptr{delam_solver}, capacity::Int64, stiffness::Ptr{Cdouble},
        load::Ptr{Cdouble}, constant::Ptr{Cdouble}, row_starts::Ptr{Int64}, columns::Ptr{Int64},
        values::Ptr{Cdouble}, offset::Ptr{Cdouble})::Int32
end

function delam_solver_plan(solver)
    @ccall libdelam.delam_solver_plan(solver::Ptr{delam_solver})::Cstring
end

function delam_solver_plan_count(solver, count)
    @ccall libdelam.delam_solver_plan_count(solver::Ptr{delam_solver}, count::Ptr{Int64})::Int32
end

function delam_solver_plan_item(solver, index, subject, decision, reason, cost, saving, unit)
    @ccall libdelam.delam_solver_plan_item(solver::Ptr{delam_solver}, index::Int64, subject::Ptr{Cstring},
        decision::Ptr{Cstring}, reason::Ptr{Cstring}, cost::Ptr{Cdouble}, saving::Ptr{Cdouble},
        unit::Ptr{Cstring})::Int32
end

function delam_solver_option(solver, key)
    @ccall libdelam.delam_solver_option(solver::Ptr{delam_solver}, key::Cstring)::Cstring
end

function delam_solver_searched(solver)
    @ccall libdelam.delam_solver_searched(solver::Ptr{delam_solver})::Cstring
end

function delam_solver_look(solver, step)
    @ccall libdelam.delam_solver_look(solver::Ptr{delam_solver}, step::Int64)::Int32
end

function delam_solver_jump_count(solver, count)
    @ccall libdelam.delam_solver_jump_count(solver::Ptr{delam_solver}, count::Ptr{Int64})::Int32
end

function delam_solver_jump(solver, index, step, before, time, stored, dissipated, released, debonded, interface_index,
                           first_pair, last_pair)
    @ccall libdelam.delam_solver_jump(solver::Ptr{delam_solver}, index::Int64, step::Ptr{Int64},
        before::Ptr{Cdouble}, time::Ptr{Cdouble}, stored::Ptr{Cdouble}, dissipated::Ptr{Cdouble},
        released::Ptr{Cdouble}, debonded::Ptr{Cdouble}, interface_index::Ptr{Int64}, first_pair::Ptr{Int64},
        last_pair::Ptr{Int64})::Int32
end

function delam_solver_jump_reactions(solver, index, capacity, before, after)
    @ccall libdelam.delam_solver_jump_reactions(solver::Ptr{delam_solver}, index::Int64, capacity::Int64,
        before::Ptr{Cdouble}, after::Ptr{Cdouble})::Int32
end

function delam_solver_save(solver, capacity, bytes, needed)
    @ccall libdelam.delam_solver_save(solver::Ptr{delam_solver}, capacity::Int64, bytes::Ptr{UInt8},
        needed::Ptr{Int64})::Int32
end

function delam_solver_load(solver, size, bytes)
    @ccall libdelam.delam_solver_load(solver::Ptr{delam_solver}, size::Int64, bytes::Ptr{UInt8})::Int32
end

function delam_solver_save_file(solver, path)
    @ccall libdelam.delam_solver_save_file(solver::Ptr{delam_solver}, path::Cstring)::Int32
end

function delam_solver_load_file(solver, path)
    @ccall libdelam.delam_solver_load_file(solver::Ptr{delam_solver}, path::Cstring)::Int32
end

const FUNCTIONS = (
    :delam_version, :delam_commit, :delam_abi, :delam_status_name, :delam_blas_threads, :delam_context_create,
    :delam_context_destroy, :delam_context_message, :delam_context_set_log, :delam_context_set_progress,
    :delam_context_cancel, :delam_cell_type_count, :delam_cell_type_info, :delam_cell_type_topology, :delam_mesh_create,
    :delam_mesh_create_layers, :delam_mesh_add_cells, :delam_mesh_add_conforming_cells, :delam_mesh_add_interface,
    :delam_mesh_add_all_interfaces, :delam_mesh_add_seams, :delam_mesh_add_self_contact,
    :delam_mesh_add_projected_interface, :delam_mesh_add_mortar_interface, :delam_mesh_add_obstacle,
    :delam_mesh_add_host_body, :delam_mesh_add_pairs, :delam_mesh_destroy, :delam_mesh_size, :delam_mesh_nodes,
    :delam_mesh_node_bodies, :delam_mesh_node_origins, :delam_mesh_node_ties, :delam_mesh_cells,
    :delam_mesh_interface_size, :delam_mesh_interface_pairs, :delam_mesh_interface_faces, :delam_mesh_find_nodes,
    :delam_mesh_find_patch, :delam_law_create, :delam_law_set, :delam_law_set_text, :delam_law_set_table,
    :delam_law_parameter_count, :delam_law_parameter_info, :delam_law_parameter_bounds, :delam_law_kind_count,
    :delam_law_kind_info, :delam_law_create_host, :delam_law_check, :delam_law_toughness, :delam_law_respond,
    :delam_law_destroy, :delam_problem_create, :delam_problem_destroy, :delam_problem_set_plane,
    :delam_problem_set_elastic, :delam_problem_set_orthotropic, :delam_problem_set_orientation,
    :delam_problem_set_formulation, :delam_problem_set_stiffness, :delam_problem_set_law, :delam_problem_set_bonded,
    :delam_problem_set_contact, :delam_problem_set_adhesion, :delam_problem_set_adhesion_box,
    :delam_problem_add_pattern, :delam_problem_prescribe_nodes, :delam_problem_prescribe_mean,
    :delam_problem_add_equation, :delam_problem_begin_constraints, :delam_problem_end_constraints,
    :delam_problem_add_periodic, :delam_problem_add_forces, :delam_problem_add_eigenstrain, :delam_problem_set_gaps,
    :delam_problem_set_number, :delam_problem_set_text, :delam_option_count, :delam_option_info, :delam_option_alias,
    :delam_option_bounds, :delam_problem_check, :delam_problem_hash, :delam_problem_dofs, :delam_problem_process_zone,
    :delam_problem_propose, :delam_problem_body_matrix, :delam_problem_constraints, :delam_problem_forces,
    :delam_problem_eigenstrain_energy, :delam_problem_factors, :delam_problem_pattern_count,
    :delam_problem_pattern_name, :delam_problem_option, :delam_problem_value_count, :delam_problem_value_info,
    :delam_problem_plan, :delam_solver_create, :delam_solver_create_like, :delam_solver_shares_bodies,
    :delam_solver_destroy, :delam_solver_advance, :delam_solver_commit, :delam_solver_rollback, :delam_solver_pending,
    :delam_solver_set_history, :delam_solver_equilibrate, :delam_solver_value, :delam_solver_value_count,
    :delam_solver_value_name, :delam_solver_value_info, :delam_solver_record, :delam_solver_recorded_size,
    :delam_solver_recorded, :delam_solver_field_shape, :delam_solver_field, :delam_solver_average,
    :delam_solver_front_count, :delam_solver_front, :delam_solver_tangent, :delam_solver_step_tangent,
    :delam_solver_condensed_size, :delam_solver_condensed, :delam_solver_plan, :delam_solver_plan_count,
    :delam_solver_plan_item, :delam_solver_option, :delam_solver_searched, :delam_solver_look, :delam_solver_jump_count,
    :delam_solver_jump, :delam_solver_jump_reactions, :delam_solver_save, :delam_solver_load, :delam_solver_save_file,
    :delam_solver_load_file,
)

end
