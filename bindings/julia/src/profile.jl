# SPDX-License-Identifier: BSD-3-Clause

"""
    profile(solver, key, interface=1; component=1)

A field along an interface of a plane scene, to be plotted: `places` along it, x where that is straight along x, and
`values`. In space the values stand at their `places` (3, pairs) instead.
"""
function profile(solver::Solver, key, interface=1; component=1)
    view = interfaces(solver.problem.mesh)[from_zero(interface)+1]
    values = field(solver, key, interface)
    of_pair = values isa AbstractMatrix ? values[component, :] : values
    at = places(view)
    if size(at, 1) == 3
        return Profile(key, at, of_pair, Vector{Int64}[])
    end
    return Profile(key, at, of_pair, chains(faces(view)[1:2, :], length(of_pair)))
end

"A field on the pairs of an interface. `lines`: the pairs in the order of the lines that they lie on, in the plane."
struct Profile
    key::String
    places::Matrix{Float64}
    values::Vector{Float64}
    lines::Vector{Vector{Int64}}
end

"Positions along a line: x if it is straight along x, else the length from its first pair."
function along_line(profile::Profile, line)
    x, y = profile.places[1, line], profile.places[2, line]
    maximum(y) - minimum(y) <= 1e-9 * (maximum(x) - minimum(x)) && return x
    return vcat(0.0, cumsum(hypot.(diff(x), diff(y))))
end

"Pairs in the order of the lines that two-node faces make; loops end where they begin."
function chains(edges, count)
    neighbours = [Int64[] for _ in 1:count]
    left = Set{Tuple{Int64,Int64}}()
    for (a, b) in eachcol(edges)
        push!(neighbours[a], b)
        push!(neighbours[b], a)
        push!(left, minmax(a, b))
    end
    found = Vector{Int64}[]
    for start in sort(collect(1:count); by=i -> length(neighbours[i]) != 1)
        chain = [start]
        while true
            ahead = findfirst(n -> minmax(chain[end], n) in left, neighbours[chain[end]])
            ahead === nothing && break
            next = neighbours[chain[end]][ahead]
            delete!(left, minmax(chain[end], next))
            push!(chain, next)
        end
        length(chain) > 1 && push!(found, chain)
    end
    return found
end
