# SPDX-License-Identifier: BSD-3-Clause

"""
    Problem(mesh; plane=nothing, progress=nothing, context)

The scene: a copy of a mesh with materials, laws, supports, loads and options.

Bodies are chosen by label, `nothing` means all. Directions are vectors or axes ("x", "-y"). What drives a prescription
comes last: load patterns, each `pattern` or `pattern => coefficient`, none for a support. `problem[key] = value` sets
an option; `options()` lists them. `progress`: as for `Context`.
"""
mutable struct Problem <: Object
    handle::Ptr{Raw.delam_problem}
    context::Context
    mesh::Mesh
    kept::Vector{Any}

    Problem(handle::Ptr{Raw.delam_problem}, context::Context, mesh::Mesh) =
        finalizer(release, new(handle, context, mesh, []))
end

function Problem(mesh::Mesh; plane=nothing, progress=nothing, context=Context(progress=progress))
    handle, _ = made(Raw.delam_problem, context, mesh) do owner, out
        Raw.delam_problem_create(owner, mesh.handle, out)
    end
    problem = Problem(handle, context, mesh)
    plane === nothing || set_plane!(problem, plane)
    return problem
end

"A load pattern of a problem; may be used wherever a number is expected."
struct Pattern
    name::String
    number::Int64
end

from_zero(pattern::Pattern) = pattern.number - 1

function Base.setindex!(problem::Problem, value::Real, key::AbstractString)
    ask(handle -> Raw.delam_problem_set_number(handle, key, value), problem)
    return problem
end

function Base.setindex!(problem::Problem, value::AbstractString, key::AbstractString)
    ask(handle -> Raw.delam_problem_set_text(handle, key, value), problem)
    return problem
end

# ---- materials

"\"plane-strain\" (initially) or \"plane-stress\"."
function set_plane!(problem::Problem, assumption)
    ask(handle -> Raw.delam_problem_set_plane(handle, assumption), problem)
    return problem
end

function set_elastic!(problem::Problem, young, poisson; body=nothing)
    ask(handle -> Raw.delam_problem_set_elastic(handle, body_label(body), young, poisson), problem)
    return problem
end

"E1 E2 E3 nu12 nu13 nu23 G12 G13 G23 in the material axes; nu_ij: contraction along j under tension along i."
function set_orthotropic!(problem::Problem, constants; body=nothing)
    elasticity = expect("constants", floats(constants), 9)
    ask(handle -> Raw.delam_problem_set_orthotropic(handle, body_label(body), elasticity), problem)
    return problem
end

"""
    set_orientation!(problem, axes; cells=nothing, body=nothing)

Directions of the material axes 1 and 2 in space, the columns of a 3 x 2 matrix for all cells of the body, or (3, 2,
cells).
"""
function set_orientation!(problem::Problem, axes; cells=nothing, body=nothing)
    if cells === nothing
        one = expect("axes", floats(axes), 3, 2)
        ask(handle -> Raw.delam_problem_set_orientation(handle, body_label(body), 1, C_NULL, one, 0), problem)
        return problem
    end
    chosen = indices(cells)
    directions = ndims(axes) == 2 ? repeat(floats(axes), 1, 1, length(chosen)) : floats(axes)
    expect("axes", directions, 3, 2, length(chosen))
    ask(problem) do handle
        Raw.delam_problem_set_orientation(handle, body_label(body), length(chosen), chosen, directions, 1)
    end
    return problem
end

"\"incompatible\" (initially, of bodies with quad4 or hex8), \"standard\" (initially, of others), \"mean-dilatation\"."
function set_formulation!(problem::Problem, formulation; body=nothing)
    ask(handle -> Raw.delam_problem_set_formulation(handle, body_label(body), formulation), problem)
    return problem
end

# ---- interfaces

"Copies the law's present parameters. The adhesion does not change: 1, or the value of set_adhesion!."
function set_law!(problem::Problem, interface, law::Law)
    if law.host !== nothing
        push!(problem.kept, law.host)
        problem.context.hosted = true
    end
    ask(handle -> Raw.delam_problem_set_law(handle, from_zero(interface), law.handle), problem, law)
    return problem
end

"Perfectly and permanently bonded."
function set_bonded!(problem::Problem, interface)
    ask(handle -> Raw.delam_problem_set_bonded(handle, from_zero(interface)), problem)
    return problem
end

"Faces without adhesion that may separate but not overlap."
function set_contact!(problem::Problem, interface)
    ask(handle -> Raw.delam_problem_set_contact(handle, from_zero(interface)), problem)
    return problem
end

"Initial adhesion of some pairs, numbers or a mask; 0 makes a notch."
function set_adhesion!(problem::Problem, interface, pairs, adhesion=0.0)
    chosen = indices(pairs)
    values = spread("adhesion", adhesion, length(chosen))
    ask(problem) do handle
        Raw.delam_problem_set_adhesion(handle, from_zero(interface), length(chosen), chosen, values, 1)
    end
    return problem
end

"Initial adhesion of the pairs in the box from lower to upper; 0 makes a notch. Returns their number, which may be 0."
function set_adhesion_box!(problem::Problem, interface, lower, upper, adhesion=0.0)
    d = dimension(problem.mesh)
    low, high = expect("lower", floats(lower), d), expect("upper", floats(upper), d)
    count = Ref{Int64}(0)
    ask(problem) do handle
        Raw.delam_problem_set_adhesion_box(handle, from_zero(interface), low, high, Float64(adhesion), count)
    end
    return count[]
end

# ---- supports and loads

"A named factor that follows a piecewise-linear history, constant beyond its ends; its `Pattern`."
function add_pattern!(problem::Problem, name, times, values)
    at, factor, out = floats(times), floats(values), Ref(Int64(0))
    expect("values", factor, length(at))
    ask(handle -> Raw.delam_problem_add_pattern(handle, name, length(at), at, factor, out), problem)
    return Pattern(name, out[] + 1)
end

"Names of the patterns, in their order."
function patterns(problem::Problem)
    count = Ref(Int64(0))
    ask(handle -> Raw.delam_problem_pattern_count(handle, count), problem)
    return [ask_text(handle -> Raw.delam_problem_pattern_name(handle, i), problem) for i in 0:count[]-1]
end

driving(drive::Pair) = (from_zero(first(drive)) + 1, last(drive))
driving(pattern) = (from_zero(pattern) + 1, 1.0)

"Numbers of patterns and their coefficients, (patterns) or (patterns, count)."
function driven(drive, count)
    found = [driving(item) for item in drive]
    numbers = Int64[first(item) for item in found]
    count === nothing && return numbers, Float64[last(item) for item in found]
    coefficients = Matrix{Float64}(undef, length(found), count)
    for (row, item) in enumerate(found)
        coefficients[row, :] = spread("drive", last(item), count)
    end
    return numbers, coefficients
end

"Prescribes direction . u of each node; fixed at zero without a drive. A coefficient is for all nodes, or one per node."
function prescribe!(problem::Problem, nodes, direction, drive...)
    held = indices(nodes)
    axis = along("direction", direction, dimension(problem.mesh))
    numbers, coefficients = driven(drive, length(held))
    ask(problem) do handle
        Raw.delam_problem_prescribe_nodes(handle, length(held), held, axis, length(numbers), numbers, coefficients,
            1)
    end
    return problem
end

"Prescribes the weighted mean of direction . u over nodes; with the weights of `find_patch`, a support over a patch."
function prescribe_mean!(problem::Problem, nodes, weights, direction, drive...)
    held = indices(nodes)
    shares = expect("weights", floats(weights), length(held))
    axis = along("direction", direction, dimension(problem.mesh))
    numbers, coefficients = driven(drive, nothing)
    ask(problem) do handle
        Raw.delam_problem_prescribe_mean(handle, length(held), held, shares, axis, length(numbers), numbers,
            coefficients, 1)
    end
    return problem
end

"The sum of coefficients[:, i] . u of nodes[i] is the drive, or 0."
function add_equation!(problem::Problem, nodes, coefficients, drive...)
    joined = indices(nodes)
    factors = columns("coefficients", coefficients, dimension(problem.mesh), length(joined))
    numbers, prescribed = driven(drive, nothing)
    ask(problem) do handle
        Raw.delam_problem_add_equation(handle, length(joined), joined, factors, length(numbers), numbers,
            prescribed, 1)
    end
    return problem
end

"Constraints `range`, in the order in which they were added from 1 on, begin at `time`, from where the nodes are then.
The factor of `pattern`, over that at `time`, is what is left of the way to where they are prescribed."
function begin_constraints!(problem::Problem, range, time, pattern)
    ask(problem) do handle
        Raw.delam_problem_begin_constraints(handle, first(range) - 1, length(range), time, from_zero(pattern))
    end
    return problem
end

"Constraints `range` end at `time`. Their forces, times the factor of `pattern` over that at `time`, take their place."
function end_constraints!(problem::Problem, range, time, pattern)
    ask(problem) do handle
        Raw.delam_problem_end_constraints(handle, first(range) - 1, length(range), time, from_zero(pattern))
    end
    return problem
end

"u(x + period_k) - u(x) = u of control node k, on opposite faces of the mesh. `periods`: a column each."
function add_periodic!(problem::Problem, periods, control_nodes; tolerance=0.0)
    controls = indices(control_nodes)
    vectors = columns("periods", periods, dimension(problem.mesh), length(controls))
    ask(problem) do handle
        Raw.delam_problem_add_periodic(handle, length(controls), vectors, controls, tolerance, 1)
    end
    return problem
end

"Dead forces times the factor of a pattern: (dimension, nodes), or one vector for all."
function add_forces!(problem::Problem, pattern, nodes, forces)
    loaded = indices(nodes)
    vectors = columns("forces", forces, dimension(problem.mesh), length(loaded))
    ask(problem) do handle
        Raw.delam_problem_add_forces(handle, from_zero(pattern), length(loaded), loaded, vectors, 1)
    end
    return problem
end

"xx, yy, zz, 2xy, 2yz, 2zx in the material axes, times the factor of a pattern."
function add_eigenstrain!(problem::Problem, pattern, strain; body=nothing)
    components = expect("strain", floats(strain), 6)
    ask(problem) do handle
        Raw.delam_problem_add_eigenstrain(handle, from_zero(pattern), body_label(body), components)
    end
    return problem
end

"""
    set_gaps!(problem, interface, pattern, gaps=nothing; adjust=0.0)

Distances that the faces of an interface have before they move, along the normals, times the factor of a pattern: one
for all, one per pair, or `nothing`, those in the mesh. Gaps of magnitude `adjust` or less count as 0. A negative gap is
an interference, which presses the bodies apart.
"""
function set_gaps!(problem::Problem, interface, pattern, gaps=nothing; adjust=0.0)
    count = pair_count(Interface(problem.mesh, from_zero(interface) + 1))
    distances = gaps === nothing ? C_NULL : spread("gaps", gaps, count)
    ask(problem) do handle
        Raw.delam_problem_set_gaps(handle, from_zero(interface), from_zero(pattern), distances, adjust)
    end
    return problem
end

# ---- queries

"`ProblemError` names what is missing or contradictory."
function check(problem::Problem)
    ask(handle -> Raw.delam_problem_check(handle), problem)
    return
end

"Of everything that determines the result: 16 hexadecimal digits."
function problem_hash(problem::Problem)
    out = zeros(UInt8, 17)
    ask(handle -> Raw.delam_problem_hash(handle, out), problem)
    return String(out[1:16])
end

"Numbers of displacements and of jumps."
function dofs(problem::Problem)
    primal, dual = Ref(Int64(0)), Ref(Int64(0))
    ask(handle -> Raw.delam_problem_dofs(handle, primal, dual), problem)
    return primal[], dual[]
end

"Expected length of the process zone, 0 if there is none, and the mean distance of pairs."
function process_zone(problem::Problem, interface)
    length_, spacing = Ref(0.0), Ref(0.0)
    ask(handle -> Raw.delam_problem_process_zone(handle, from_zero(interface), length_, spacing), problem)
    return length_[], spacing[]
end

"""
Numbers for the law of an interface, 0 if unknown: `stiffness`, the least, 50 E3/t of the adjacent layer; `share` of
that layer's stiffness that the present normal stiffness leaves; `normal_strength` and `tangential_strength`, the
largest with which the process zone has `pairs` pairs.
"""
function propose(problem::Problem, interface; pairs=3.0)
    stiffness, share, normal, tangential = Ref(0.0), Ref(0.0), Ref(0.0), Ref(0.0)
    ask(problem) do handle
        Raw.delam_problem_propose(handle, from_zero(interface), Float64(pairs), stiffness, share, normal, tangential)
    end
    return (stiffness=stiffness[], share=share[], normal_strength=normal[], tangential_strength=tangential[])
end

"""
What an analysis would do, before it begins; nothing is factored: `plan`, the text; `setup`, seconds of the
factorisations before the first step; `memory`, bytes at the peak.
"""
function plan(problem::Problem)
    text, setup, memory = Ref{Cstring}(C_NULL), Ref(0.0), Ref(0.0)
    own = Ref("")
    ask(problem) do handle
        status = Raw.delam_problem_plan(handle, text, setup, memory)
        status == Raw.DELAM_OK && (own[] = unsafe_string(text[]))
        return status
    end
    return (plan=own[], setup=setup[], memory=memory[])
end

"Factors of all patterns at a time."
function factors(problem::Problem, time)
    out = Vector{Float64}(undef, length(patterns(problem)))
    ask(handle -> Raw.delam_problem_factors(handle, time, length(out), out), problem)
    return out
end

function Base.show(io::IO, problem::Problem)
    isopen(problem) || return print(io, "Problem, closed")
    primal, dual = dofs(problem)
    print(io, "Problem in $(dimension(problem.mesh))D: $primal displacements, $dual of jumps, ",
        "patterns: $(join(patterns(problem), ", "))")
end
