# SPDX-License-Identifier: BSD-3-Clause

"""
    History(solver; values=nothing)

Values of a solver over its steps, a vector by name: `history["reaction:load"]`. The first row is the state at which it
was made; `record!(history)` appends the present one. Where a step has replaced earlier ones (option backtracking) their
rows are read again. `values`: names, `nothing` for all but those that recover the
displacements.
"""
struct History
    solver::Solver
    names::Vector{String}
    steps::Vector{Int64}
    rows::Vector{Vector{Float64}}
end

function History(solver::Solver; values=nothing)
    names = values === nothing ? [name for (name, info) in value_infos(solver) if info.cost != "recovers"] :
            collect(String, values)
    return record!(History(solver, names, Int64[], Vector{Float64}[]))
end

row(history::History) = [history.solver[name] for name in history.names]

function record!(history::History)
    solver, steps, rows = history.solver, history.steps, history.rows
    step, first_revised = Int64(solver["step"]), Int64(solver["revised_from"])
    for (i, other) in enumerate(steps)
        if first_revised <= other < step
            rows[i] = look!(_ -> row(history), solver, other)
        end
    end
    if !isempty(steps) && last(steps) == step
        rows[end] = row(history)
    else
        push!(steps, step)
        push!(rows, row(history))
    end
    return history
end

function Base.getindex(history::History, name::AbstractString)
    column = findfirst(==(name), history.names)
    column === nothing && throw(KeyError(name))
    return [values[column] for values in history.rows]
end

Base.length(history::History) = length(history.rows)
Base.keys(history::History) = history.names
Base.haskey(history::History, name) = name in history.names
Base.show(io::IO, history::History) =
    print(io, "History of $(length(history)) rows: $(join(history.names, ", "))")

"""
    history(solver, times; values=nothing)

Runs the analysis and returns the `History` of all steps, with the present state as its first row.
"""
function history(solver::Solver, times; values=nothing)
    rows = History(solver; values=values)
    march!(_ -> record!(rows), solver, times)
    return rows
end

"Writes all digits to a stream or a file. `titles`: used instead of the names."
function write_csv(io::IO, history::History; titles=history.names)
    println(io, join(titles, ","))
    for values in history.rows
        println(io, join((value + 0.0 for value in values), ","))
    end
    return
end
write_csv(path::AbstractString, history::History; titles=history.names) =
    open(io -> write_csv(io, history; titles=titles), path, "w")
