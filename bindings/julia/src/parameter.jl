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
