# SPDX-License-Identifier: BSD-3-Clause
"""Names of Julia's own (Base, Test) that the package uses: what is neither here nor defined in the package is
taken for misspelt. FIELDS: what is behind a point and no field of the package's types."""

BASE = set("""
    ARGS AbstractArray AbstractMatrix AbstractString AbstractVector Any Array Base Bool C_NULL Cdouble Cstring Cvoid
    Dict DimensionMismatch ENV Exception Float64 GC IO Int Int32 Int64 Integer InterruptException KeyError Matrix
    Pair Ptr Raw Real ReentrantLock Ref Set String Symbol Tuple UInt8 Union Vector abs all close collect convert
    copy cumsum delete! devnull diff disable_sigint div dlopen dlsym eachcol empty! end enumerate error extrema fill
    finalize finalizer findall findfirst first get haskey hypot identity include isdir isempty islocked isopen
    issorted join joinpath keys last length lock lstrip maximum minimum minmax mktempdir nameof ndims nothing
    objectid open pairs parse permutedims pipeline pointer_from_objref print println push! readchomp reenable_sigint
    repeat reshape rethrow setindex! similar size sort split sprint sqrt startswith stdout sum task_local_storage throw
    time_ns trylock typeof undef unlock unsafe_pointer_to_objref unsafe_store! unsafe_string vcat vec zeros
""".split())

FIELDS = set("""
    RefValue close gc getindex setindex! show showerror
""".split())
