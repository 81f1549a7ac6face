# SPDX-License-Identifier: BSD-3-Clause
# Conversion of arguments. Arrays of the right type are passed without a copy.

floats(values::AbstractArray) = convert(Array{Float64}, values)
floats(value::Real) = [Float64(value)]
floats(values::Tuple) = Float64[values...]

"Indices from 1: of one, of several, or those that a mask names."
indices(values::AbstractArray{<:Integer}) = convert(Array{Int64}, values)
indices(mask::AbstractVector{Bool}) = convert(Vector{Int64}, findall(mask))
indices(value::Integer) = [Int64(value)]

function expect(name, values, expected...)
    size(values) == expected ||
        throw(DimensionMismatch("$name has size $(size(values)), expected $expected"))
    return values
end

"`count` numbers, from that many or from one for all."
spread(name, value::Real, count) = fill(Float64(value), count)
spread(name, values, count) = expect(name, floats(values), count)

"One column for each of `count`, from that many or from one for all."
columns(name, values::AbstractVector, rows, count) = repeat(expect(name, floats(values), rows), 1, count)
columns(name, values, rows, count) = expect(name, floats(values), rows, count)

"A vector, or an axis by name: \"x\", \"-y\"."
function along(name, direction::AbstractString, dimension)
    axis = findfirst(lstrip(direction, ['+', '-']), "xyz"[1:dimension])
    (axis === nothing || length(axis) != 1 || length(direction) > 2) &&
        throw(InvalidArgument("$name = \"$direction\" is no axis of $(dimension)D, with or without a sign"))
    vector = zeros(dimension)
    vector[first(axis)] = startswith(direction, "-") ? -1.0 : 1.0
    return vector
end
along(name, direction, dimension) = expect(name, floats(direction), dimension)

"The library counts from 0, and takes -1 for all."
from_zero(::Nothing) = Int64(-1)
from_zero(index::Integer) = Int64(index) - 1

body_label(::Nothing) = Int32(-1)
body_label(body::Integer) = Int32(body)

"Indices returned by the library, from 1."
from_one!(indices) = (indices .+= 1; indices)
