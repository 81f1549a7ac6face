# SPDX-License-Identifier: BSD-3-Clause

function field_shape(solver, key, part)
    rows, columns = Ref(Int64(0)), Ref(Int64(0))
    ask(handle -> Raw.delam_solver_field_shape(handle, key, part, rows, columns), solver)
    return columns[], rows[]
end

"""
    field(solver, key[, interface])

A field of the step that `look!` has selected, otherwise of the pending state, or of the committed one if no step is
pending: one column per entry, or a vector of numbers.

Over nodes: displacement. Cells: stress, rotation, mesh_error. Pairs of an interface, or of all one after another: jump,
traction, adhesion, mixity, contact. Constraints: reaction. Bodies: free_since, free_motion.
"""
function field(solver::Solver, key, interface=nothing)
    part = from_zero(interface)
    components, count = field_shape(solver, key, part)
    out = Matrix{Float64}(undef, components, count)
    ask(handle -> Raw.delam_solver_field(handle, key, part, length(out), out), solver)
    return components == 1 ? vec(out) : out
end

"Volume, average strain and average stress of a body, `nothing`: of all; xx, yy, zz, xy, yz, zx, shear strains doubled."
function average(solver::Solver; body=nothing)
    volume, strain, stress = Ref(0.0), zeros(6), zeros(6)
    ask(handle -> Raw.delam_solver_average(handle, body_label(body), volume, strain, stress), solver)
    return (volume=volume[], strain=strain, stress=stress)
end

"""
    fronts(solver, interface)

The fronts of the cracks of an interface; front f has the points `starts[f]:starts[f+1]-1`. `closed`: a loop; `places`,
`directions` (dimension, points), the directions along the interface into what adheres; `lengths`: in 2D of the crack,
in 3D of front that a point stands for; `rates` (3, points): energy release rates in modes I, II, III; `zone_lengths`,
`zone_pairs` of the process zone.
"""
function fronts(solver::Solver, interface)
    m, n, d = Ref(Int64(0)), Ref(Int64(0)), dimension(solver.problem.mesh)
    ask(handle -> Raw.delam_solver_front_count(handle, from_zero(interface), m, n), solver)
    starts, closed = zeros(Int64, m[] + 1), zeros(Int32, m[])
    at, ahead, rates = zeros(d, n[]), zeros(d, n[]), zeros(3, n[])
    lengths, zone_lengths, zone_pairs = zeros(n[]), zeros(n[]), zeros(n[])
    ask(solver) do handle
        Raw.delam_solver_front(handle, from_zero(interface), m[], n[], starts, closed, at, ahead, lengths, rates,
            zone_lengths, zone_pairs)
    end
    return (starts=from_one!(starts), closed=closed .!= 0, places=at, directions=ahead, lengths=lengths, rates=rates,
        zone_lengths=zone_lengths, zone_pairs=zone_pairs)
end

"(patterns, patterns): change of reactions with factors at fixed adhesion and contact; symmetric."
function tangent(solver::Solver)
    count = length(patterns(solver.problem))
    out = zeros(count, count)
    ask(handle -> Raw.delam_solver_tangent(handle, length(out), out), solver)
    return out
end

"(patterns, patterns): change of reactions with factors at the end of the pending step, damage included."
function step_tangent(solver::Solver)
    count = length(patterns(solver.problem))
    out = zeros(count, count)
    ask(handle -> Raw.delam_solver_step_tangent(handle, length(out), out), solver)
    # Row p, column q in C: symmetric except with mixity_rule = converged.
    return permutedims(out)
end
