# SPDX-License-Identifier: BSD-3-Clause

"The functions of a host law; kept by all objects that use the law."
struct HostFunctions
    adhesion::Any
    dissipation::Any
end

"""
    Law(kind; parameters...)

How an interface holds together, its parameters by name:

    Law("piecewise-linear"; normal_stiffness=125e9, tangential_stiffness=125e9, normal_onset=100, ...)

`parameters(kind)` lists them. A tabulated law takes `softening=(xi, s)`.
"""
mutable struct Law <: Object
    handle::Ptr{Raw.delam_law}
    context::Context
    host::Union{Nothing,Base.RefValue{HostFunctions}}

    Law(handle::Ptr{Raw.delam_law}, context::Context, host) = finalizer(release, new(handle, context, host))
end

function Law(kind::AbstractString; context=Context(), values...)
    handle, _ = made((owner, out) -> Raw.delam_law_create(owner, kind, out), Raw.delam_law, context)
    return set!(Law(handle, context, nothing); values...)
end

"""
    host_law(name, adhesion, dissipation; parameters...)

A law computed by Julia functions, which must always give the same answers:

    adhesion(mixity, driving) -> (adhesion, slope)
    dissipation(mixity, adhesion) -> (dissipated, slope, mixity_slope)

`adhesion`: the minimiser of adhesion * driving + dissipated over [0, 1] and its derivative by the driving energy;
`dissipation`: the energy g(B, zeta) and its derivatives by adhesion and mixity. They must not call the library. What
one throws ends the call of the library and is thrown by it. `name` stands for them in `problem_hash`.
"""
function host_law(name, adhesion, dissipation; context=Context(), values...)
    host = Ref(HostFunctions(adhesion, dissipation))
    context.hosted = true
    handle, _ = made(Raw.delam_law, context) do owner, out
        GC.@preserve host Raw.delam_law_create_host(owner, name, adhesion_callback(), dissipation_callback(),
            pointer_from_objref(host), out)
    end
    return set!(Law(handle, context, host); values...)
end

adhesion_callback() =
    @cfunction(on_adhesion, Int32,
        (Cdouble, Cdouble, Ptr{Cdouble}, Ptr{Cdouble}, Ptr{Cvoid}))::Raw.delam_adhesion_callback

dissipation_callback() =
    @cfunction(on_dissipation, Int32,
        (Cdouble, Cdouble, Ptr{Cdouble}, Ptr{Cdouble}, Ptr{Cdouble}, Ptr{Cvoid}))::Raw.delam_dissipation_callback

host_of(user) = (unsafe_pointer_to_objref(user)::Base.RefValue{HostFunctions})[]

function on_adhesion(mixity::Cdouble, driving::Cdouble, adhesion::Ptr{Cdouble}, slope::Ptr{Cdouble},
                     user::Ptr{Cvoid})::Int32
    try
        value, derivative = host_of(user).adhesion(mixity, driving)
        unsafe_store!(adhesion, value)
        unsafe_store!(slope, derivative)
        return Int32(0)
    catch exception
        return keep_exception(exception)
    end
end

function on_dissipation(mixity::Cdouble, adhesion::Cdouble, dissipated::Ptr{Cdouble}, slope::Ptr{Cdouble},
                        mixity_slope::Ptr{Cdouble}, user::Ptr{Cvoid})::Int32
    try
        value, by_adhesion, by_mixity = host_of(user).dissipation(mixity, adhesion)
        unsafe_store!(dissipated, value)
        unsafe_store!(slope, by_adhesion)
        unsafe_store!(mixity_slope, by_mixity)
        return Int32(0)
    catch exception
        return keep_exception(exception)
    end
end

"Sets numbers, texts and the table `softening=(xi, s)`. Set texts first: a criterion resets its exponents."
function set!(law::Law; values...)
    for (key, value) in sort(collect(pairs(values)); by=entry -> !(last(entry) isa AbstractString))
        if value isa AbstractString
            ask(handle -> Raw.delam_law_set_text(handle, key, value), law)
        elseif key === :softening
            xi, s = floats(value[1]), floats(value[2])
            expect("softening[2]", s, length(xi))
            ask(handle -> Raw.delam_law_set_table(handle, length(xi), xi, s), law)
        else
            ask(handle -> Raw.delam_law_set(handle, key, value), law)
        end
    end
    return law
end

"`ProblemError` names the first parameter that is missing or not admissible."
function check(law::Law)
    ask(handle -> Raw.delam_law_check(handle), law)
    return
end

"Onset and total toughness at mixities B = Y_t/Y in [0, 1]."
function toughness(law::Law, mixity)
    at = floats(mixity)
    onset, total = similar(at), similar(at)
    ask(handle -> Raw.delam_law_toughness(handle, length(at), at, onset, total), law)
    return onset, total
end

"""
    respond(law, jump, mixity, adhesion=1.0)

One damage step at given jumps (dimension, n), local, normal first, at frozen mixities, from old adhesions: the new
adhesions and the tractions (dimension, n).
"""
function respond(law::Law, jump::AbstractMatrix, mixity, adhesion=1.0)
    jumps = floats(jump)
    d, count = size(jumps)
    mixities, old = spread("mixity", mixity, count), spread("adhesion", adhesion, count)
    new, traction = similar(old), similar(jumps)
    ask(handle -> Raw.delam_law_respond(handle, d, count, jumps, mixities, old, new, traction), law)
    return new, traction
end
