# SPDX-License-Identifier: BSD-3-Clause

"""
    Solver(problem; time=0.0, not_converged=:warn, like=nothing)

The state of a problem, which is taken as it is now, from `time` on. `like`: another solver, whose condensed bodies are
shared if they are equal (laws, adhesion, histories and options may differ).

    advance!(solver, 0.05)      # pending: can be read, then
    commit!(solver)             # kept, or rollback!(solver)
    solver["reaction:load"]     # a value of the present state; keys(solver) lists them

`not_converged`: what a step that met an iteration limit does: `:warn` (the step is pending), `:throw` (`NotConverged`,
pending too) or `:ignore`. A call that Ctrl-C or an exception of a callback ends leaves the state that was there before.
"""
mutable struct Solver <: Object
    handle::Ptr{Raw.delam_solver}
    context::Context
    problem::Problem
    not_converged::Symbol
    kept::Vector{Any}

    Solver(handle::Ptr{Raw.delam_solver}, problem::Problem, not_converged::Symbol) =
        finalizer(release, new(handle, problem.context, problem, not_converged, copy(problem.kept)))
end

function Solver(problem::Problem; time=0.0, not_converged=:warn, like=nothing)
    not_converged in (:warn, :throw, :ignore) ||
        throw(InvalidArgument("not_converged = $not_converged, expected :warn, :throw or :ignore"))
    handle, status = made(Raw.delam_solver, problem; accepted=Raw.DELAM_NOT_CONVERGED) do scene, out
        GC.@preserve like Raw.delam_solver_create_like(scene, like === nothing ? C_NULL : like.handle, time, out)
    end
    solver = Solver(handle, problem, not_converged)
    tell_outcome(solver, status)
    return solver
end

function tell_outcome(solver, status)
    status == Raw.DELAM_NOT_CONVERGED || return
    message = lock(() -> last_message(solver.context), solver.context.lock)
    solver.not_converged === :throw && throw(NotConverged(message))
    solver.not_converged === :warn && @warn message
    return
end

# ---- steps

"Is there a step to be committed or rolled back?"
function pending(solver::Solver)
    out = Ref(Int32(0))
    ask(handle -> Raw.delam_solver_pending(handle, out), solver)
    return out[] != 0
end

function stepped!(body, solver)
    already = pending(solver)
    status = try
        ask(body, solver; accepted=Raw.DELAM_NOT_CONVERGED)
    catch
        # The step was done when the interruption was seen.
        pending(solver) && !already && rollback!(solver)
        rethrow()
    end
    tell_outcome(solver, status)
    return solver
end

"One load step to `time`, pending."
advance!(solver::Solver, time) = stepped!(handle -> Raw.delam_solver_advance(handle, time), solver)

"Displacements of least energy at `time` with the given adhesion held, of all pairs, interface after interface; without
it the committed one. Pending like a step."
function equilibrate!(solver::Solver, time, adhesion=nothing)
    held = adhesion === nothing ? C_NULL :
           expect("adhesion", floats(adhesion), last(field_shape(solver, "adhesion", Int64(-1))))
    return stepped!(handle -> Raw.delam_solver_equilibrate(handle, time, held), solver)
end

"Keeps the pending step."
function commit!(solver::Solver)
    ask(handle -> Raw.delam_solver_commit(handle), solver)
    return solver
end

"Restores the state before the pending step, bit for bit."
function rollback!(solver::Solver)
    ask(handle -> Raw.delam_solver_rollback(handle), solver)
    return solver
end

"""
    march!(solver, times)
    march!(f, solver, times)

Advances and commits, time after time; `f(solver)` after each step. A step that throws is rolled back.
"""
function march!(f, solver::Solver, times)
    for time in times
        try
            advance!(solver, time)
            commit!(solver)
        catch
            isopen(solver) && pending(solver) && rollback!(solver)
            rethrow()
        end
        f(solver)
    end
    return solver
end
march!(solver::Solver, times) = march!(identity, solver, times)

"""
    set_history!(solver, pattern, times, values)

Another history of a load pattern from the committed time on: straight from the factor there to the first point.
"""
function set_history!(solver::Solver, pattern, times, values)
    at, factor = floats(times), floats(values)
    expect("values", factor, length(at))
    ask(handle -> Raw.delam_solver_set_history(handle, from_zero(pattern), length(at), at, factor), solver)
    return solver
end

# ---- values

function Base.getindex(solver::Solver, key::AbstractString)
    value = Ref(0.0)
    ask(handle -> Raw.delam_solver_value(handle, key, value), solver)
    return value[]
end

"This value of the committed state and, with each commit from now on, of every further step."
function record!(solver::Solver, key::AbstractString)
    ask(handle -> Raw.delam_solver_record(handle, key), solver)
    return solver
end

"Steps that are recorded, up to the committed one."
function recorded_steps(solver::Solver)
    first, count = Ref(Int64(0)), Ref(Int64(0))
    ask(handle -> Raw.delam_solver_recorded_size(handle, first, count), solver)
    return first[]:first[]+count[]-1
end

"A recorded value step by step; NaN before it was asked for."
function recorded(solver::Solver, key::AbstractString)
    values = Vector{Float64}(undef, length(recorded_steps(solver)))
    ask(handle -> Raw.delam_solver_recorded(handle, key, length(values), values), solver)
    return values
end

function Base.keys(solver::Solver)
    count = Ref(Int64(0))
    ask(handle -> Raw.delam_solver_value_count(handle, count), solver)
    return [ask_text(handle -> Raw.delam_solver_value_name(handle, i), solver) for i in 0:count[]-1]
end

"""
What the library says of a value. `cost`: "free", "reads" (goes over pairs or fronts) or "recovers" (recovers the
displacements, a sparse solve); `scope`: "whole", "interface" or "pattern"; `alias`: another name for it, or "";
`recorded`: `record!` takes it.
"""
struct ValueInfo
    alias::String
    unit::String
    cost::String
    scope::String
    meaning::String
    recorded::Bool
end

"What each value of a solver is, in the order of `keys(solver)`: pairs of key and `ValueInfo`."
function value_infos(solver::Solver)
    found = Pair{String,ValueInfo}[]
    for (i, key) in enumerate(keys(solver))
        t = [Ref{Cstring}(C_NULL) for _ in 1:5]
        recorded = Ref(Int32(0))
        ask(handle -> Raw.delam_solver_value_info(handle, i - 1, t[1], t[2], t[3], t[4], t[5], recorded), solver)
        push!(found, key => ValueInfo((unsafe_string(text[]) for text in t)..., recorded[] != 0))
    end
    return found
end

Base.haskey(solver::Solver, key) =
    key in keys(solver) || key in [info.alias for (_, info) in value_infos(solver) if info.alias != ""]

Base.show(io::IO, solver::Solver) =
    isopen(solver) ? print(io, "Solver at time $(solver["time"])", pending(solver) ? ", a step is pending" : "") :
    print(io, "Solver, closed")

"""
    look!(solver, step)
    look!(f, solver, step)

Values and fields then speak of an earlier step (option backtracking); -1: of the present one again. With a function
they do so while that runs, and what it gives is given.
"""
function look!(solver::Solver, step)
    ask(handle -> Raw.delam_solver_look(handle, step), solver)
    return solver
end
function look!(f, solver::Solver, step)
    look!(solver, step)
    try
        return f(solver)
    finally
        look!(solver, -1)
    end
end

# ---- state as bytes and files

"The committed state as bytes."
function save(solver::Solver)
    needed = Ref(Int64(0))
    ask(handle -> Raw.delam_solver_save(handle, 0, C_NULL, needed), solver)
    out = Vector{UInt8}(undef, needed[])
    ask(handle -> Raw.delam_solver_save(handle, length(out), out, needed), solver)
    return out
end

"Goes on from saved bytes of the same scene and options."
function load!(solver::Solver, state::AbstractVector{UInt8})
    bytes = convert(Vector{UInt8}, state)
    ask(handle -> Raw.delam_solver_load(handle, length(bytes), bytes), solver)
    return solver
end

"The same as a file, which is there as a whole or not at all."
function save(solver::Solver, path::AbstractString)
    ask(handle -> Raw.delam_solver_save_file(handle, path), solver)
    return
end

"Goes on from a file."
function load!(solver::Solver, path::AbstractString)
    ask(handle -> Raw.delam_solver_load_file(handle, path), solver)
    return solver
end
