# SPDX-License-Identifier: BSD-3-Clause

"Description of a parameter of a law or of an option. `initial` is \"\" if it must be given."
struct Parameter
    key::String
    type::String
    unit::String
    initial::String
    range::String
    meaning::String
end

text_or_throw(status, texts) =
    status == Raw.DELAM_OK ? Parameter((unsafe_string(text[]) for text in texts)...) :
    throw(DelamError(status, "no description"))

"""
    parameters(kind)

Parameters of a kind of law: `Dict` by key.
"""
function parameters(kind)
    count = Raw.delam_law_parameter_count(kind)
    count > 0 || throw(InvalidArgument("kind = \"$kind\" is not known"))
    found = Dict{String,Parameter}()
    for i in 0:count-1
        t = [Ref{Cstring}(C_NULL) for _ in 1:6]
        status = Raw.delam_law_parameter_info(kind, i, t[1], t[2], t[3], t[4], t[5], t[6])
        parameter = text_or_throw(status, t)
        found[parameter.key] = parameter
    end
    return found
end

"""
    law_kinds()

Kinds of laws with their meaning, as pairs in the library's order; "host" is made by `host_law`.
"""
function law_kinds()
    found = Pair{String,String}[]
    for i in 0:Raw.delam_law_kind_count()-1
        name, meaning = Ref{Cstring}(C_NULL), Ref{Cstring}(C_NULL)
        Raw.delam_law_kind_info(i, name, meaning, C_NULL)
        push!(found, unsafe_string(name[]) => unsafe_string(meaning[]))
    end
    return found
end

"Between what a number lies; where open, the bound itself is outside. Infinite: there is no bound, numbers are finite."
struct Bounds
    lower::Float64
    upper::Float64
    lower_open::Bool
    upper_open::Bool
end

"Does the number lie within the bounds?"
allows(bounds::Bounds, value::Real) =
    (bounds.lower_open ? value > bounds.lower : value >= bounds.lower) &&
    (bounds.upper_open ? value < bounds.upper : value <= bounds.upper)

"""
    bounds(kind)

Bounds of the parameters of a kind of law, those of a table for each of its numbers: `Dict` by key.
"""
function bounds(kind)
    found = Dict{String,Bounds}()
    for i in 0:Raw.delam_law_parameter_count(kind)-1
        key = Ref{Cstring}(C_NULL)
        Raw.delam_law_parameter_info(kind, i, key, C_NULL, C_NULL, C_NULL, C_NULL, C_NULL)
        lower, upper, lower_open, upper_open = Ref(0.0), Ref(0.0), Ref(Int32(0)), Ref(Int32(0))
        Raw.delam_law_parameter_bounds(kind, i, lower, upper, lower_open, upper_open)
        found[unsafe_string(key[])] = Bounds(lower[], upper[], lower_open[] != 0, upper_open[] != 0)
    end
    return found
end

"""
    options()

What `problem[key] = value` sets: `Dict` by key.
"""
function options()
    found = Dict{String,Parameter}()
    for i in 0:Raw.delam_option_count()-1
        t = [Ref{Cstring}(C_NULL) for _ in 1:6]
        status = Raw.delam_option_info(i, t[1], t[2], t[3], t[4], t[5], t[6])
        parameter = text_or_throw(status, t)
        found[parameter.key] = parameter
    end
    return found
end
