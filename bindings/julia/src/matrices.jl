# SPDX-License-Identifier: BSD-3-Clause
# What the library assembled, for hosts that check or reuse it.

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

"(patterns, patterns): of the eigenstrains, 0 for other patterns."
function eigenstrain_energy(problem::Problem)
    count = length(patterns(problem))
    out = zeros(count, count)
    ask(handle -> Raw.delam_problem_eigenstrain_energy(handle, length(out), out), problem)
    return out
end
