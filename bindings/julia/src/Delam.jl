# SPDX-License-Identifier: BSD-3-Clause
"""
Delamination of layered and fibrous composites by energy minimisation: libdelam from Julia.

    mesh = Mesh(lengths=0.12, divisions=240, thickness=[3e-3, 3e-3], layer_divisions=[6, 6])
    law = Law("piecewise-linear"; normal_stiffness=125e9, ...)
    problem = Problem(mesh)               # then materials, laws, supports, loads, options
    solver = Solver(problem)              # load steps and their results

Arrays have one column for each node, pair or cell, as the library has its rows: nothing is transposed. Nodes, cells,
pairs, interfaces and patterns count from 1, bodies are labels. In the library's own messages single indices count from
0. Units are whatever is consistent. Errors are exceptions, `DelamError`.
"""
module Delam

import Base.Libc.Libdl: dlopen, dlsym

include("raw.jl")
include("library.jl")
include("errors.jl")
include("context.jl")
include("arrays.jl")
include("mesh.jl")
include("interface.jl")
include("parameter.jl")
include("law.jl")
include("problem.jl")
include("solver.jl")
include("matrices.jl")
include("fields.jl")
include("reports.jl")
include("history.jl")
include("profile.jl")

export Context, Mesh, Interface, Law, Problem, Pattern, Solver, History, Profile
export DelamError, InvalidArgument, InvalidHandle, MeshError, ProblemError, StateError, OutOfMemory, NumericalError,
    SnapshotError, FileError, InternalError, NotConverged, Cancelled, LimitReached
export add_cells!, add_interface!, add_all_interfaces!, add_projected_interface!, add_mortar_interface!,
    add_obstacle!, add_seams!, add_self_contact!,
    add_host_body!, add_pairs!, find_nodes, find_node,
    find_patch, interfaces, nodes, node_bodies, node_origins, node_ties, cells, dimension, node_count, cell_count,
    body_count, interface_count, pair_count, nodes_a, nodes_b, weights, frames, places, faces
export host_law, law_kinds, parameters, bounds, Bounds, allows, set!, check, toughness, respond, options
export set_plane!, set_elastic!, set_orthotropic!, set_orientation!, set_formulation!, set_law!, set_bonded!,
    set_contact!, set_adhesion!, set_adhesion_box!, add_pattern!, prescribe!, prescribe_mean!, add_equation!,
    begin_constraints!, end_constraints!, add_periodic!, add_forces!, add_eigenstrain!, set_gaps!, set_stiffness!,
    patterns, problem_hash, dofs, process_zone, propose, factors
export advance!, commit!, rollback!, pending, equilibrate!, set_history!, march!, history, record!, recorded,
    recorded_steps, write_csv, look!, value_infos, ValueInfo,
    save, load!, field, average, fronts, tangent, step_tangent, condensed, plan,
    plan_items, option, searched, jumps, profile, cancel

__init__() = load_library()

end
