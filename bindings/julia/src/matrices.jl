# SPDX-License-Identifier: BSD-3-Clause
# The matrices and vectors that the library assembled, for hosts that check or reuse them.

"""
A matrix by rows: the entries of row i are `row_starts[i]:row_starts[i+1]-1` of `columns` and `values`. `Matrix(m)` is
the same in full; `transpose(SparseMatrixCSC(m.columns_of, m.rows, m.row_starts, m.columns, m.values))` in SparseArrays.
"""
struct ByRows
    rows::Int64
    columns_of::Int64
    row_starts::Vector{Int64}
    columns::Vector{Int64}
    values::Vector{Float64}
end

ByRows(rows, width, entries) =
    ByRows(rows, width, Vector{Int64}(undef, rows + 1), Vector{Int64}(undef, entries), Vector{Float64}(undef, entries))

function counted_from_one!(matrix::ByRows)
    from_one!(matrix.row_starts)
    from_one!(matrix.columns)
    return matrix
end

function Base.Matrix(matrix::ByRows)
    full = zeros(matrix.rows, matrix.columns_of)
    for row in 1:matrix.rows, entry in matrix.row_starts[row]:matrix.row_starts[row+1]-1
        full[row, matrix.columns[entry]] += matrix.values[entry]
    end
    return full
end

"""
    set_stiffness!(problem, nodes, row_starts, columns, values; dofs=nothing, kernel=nothing)

The stiffness of whole bodies as the host has assembled it, in the place of cells and material: all nodes of the bodies
and a matrix by rows, both triangles. Of a symmetric `SparseMatrixCSC` these are `colptr`, `rowval`, `nzval`.
`dofs` (dimension, nodes): its row for each displacement, else they follow the nodes; `kernel` (displacements, motions):
what costs no energy, else the library finds it.
"""
function set_stiffness!(problem::Problem, nodes, row_starts, columns, values; dofs=nothing, kernel=nothing)
    own, starts, places_, entries = indices(nodes), indices(row_starts), indices(columns), floats(values)
    count, d = length(own), dimension(problem.mesh)
    expect("row_starts", starts, d * count + 1)
    expect("columns", places_, length(entries))
    starts[end] == length(entries) + 1 ||
        throw(InvalidArgument("row_starts ends with $(starts[end]), values has $(length(entries)) entries"))
    order = dofs === nothing ? C_NULL : expect("dofs", indices(dofs), d, count)
    motions = kernel === nothing ? C_NULL : floats(kernel)
    motion_count = kernel === nothing ? -1 : size(motions, 2)
    kernel === nothing || expect("kernel", motions, d * count, motion_count)
    ask(problem) do handle
        Raw.delam_problem_set_stiffness(handle, count, own, order, starts, places_, entries, motion_count, motions, 1)
    end
    return problem
end

"Stiffness of a body over its nodes in ascending order, both triangles."
function body_matrix(problem::Problem, body)
    rows, entries = Ref(Int64(0)), Ref(Int64(0))
    ask(problem) do handle
        Raw.delam_problem_body_matrix(handle, body, rows, entries, C_NULL, C_NULL, C_NULL)
    end
    out = ByRows(rows[], rows[], entries[])
    ask(problem) do handle
        Raw.delam_problem_body_matrix(handle, body, rows, entries, out.row_starts, out.columns, out.values)
    end
    return counted_from_one!(out)
end

"Constraints over the mesh's displacements, and their right-hand sides (patterns, rows)."
function constraints(problem::Problem)
    rows, entries, driven_by = Ref(Int64(0)), Ref(Int64(0)), Ref(Int64(0))
    ask(problem) do handle
        Raw.delam_problem_constraints(handle, rows, entries, driven_by, C_NULL, C_NULL, C_NULL, C_NULL)
    end
    out = ByRows(rows[], first(dofs(problem)), entries[])
    coefficients = Matrix{Float64}(undef, driven_by[], rows[])
    ask(problem) do handle
        Raw.delam_problem_constraints(handle, rows, entries, driven_by, out.row_starts, out.columns, out.values,
            coefficients)
    end
    return counted_from_one!(out), coefficients
end

"Nodal forces (dimension, nodes) of a pattern at factor 1."
function forces(problem::Problem, pattern)
    d = dimension(problem.mesh)
    out = Matrix{Float64}(undef, d, div(first(dofs(problem)), d))
    ask(handle -> Raw.delam_problem_forces(handle, from_zero(pattern), length(out), out), problem)
    return out
end

"""
    condensed(solver)

All bodies condensed onto the interfaces: with x `(unknowns)`, factors θ and the local jumps j of all interfaces, the
energy is 1/2 x'S x - x'L θ + 1/2 θ'A θ and j = N x + O'θ, where S is `stiffness`, L `load` (unknowns, patterns), A
`constant`, N `jumps` by rows and O `offset` (patterns, jumps).
"""
function condensed(solver::Solver)
    unknowns, entries = Ref(Int64(0)), Ref(Int64(0))
    ask(handle -> Raw.delam_solver_condensed_size(handle, unknowns, entries), solver)
    n, p, rows = unknowns[], length(patterns(solver.problem)), last(dofs(solver.problem))
    stiffness, load, constant = zeros(n, n), zeros(n, p), zeros(p, p)
    by_rows, offset = ByRows(rows, n, entries[]), zeros(p, rows)
    ask(solver) do handle
        Raw.delam_solver_condensed(handle, length(stiffness), stiffness, load, constant, by_rows.row_starts,
            by_rows.columns, by_rows.values, offset)
    end
    return (stiffness=stiffness, load=load, constant=constant, jumps=counted_from_one!(by_rows), offset=offset)
end

"(patterns, patterns): of the eigenstrains, 0 for other patterns."
function eigenstrain_energy(problem::Problem)
    count = length(patterns(problem))
    out = zeros(count, count)
    ask(handle -> Raw.delam_problem_eigenstrain_energy(handle, length(out), out), problem)
    return out
end
