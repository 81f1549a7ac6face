# SPDX-License-Identifier: BSD-3-Clause
# Every call of the library: contexts, the call with its checks, callbacks, Ctrl-C, and the destruction of objects.
#
# A context and the objects made with it belong to one thread at a time: each has a lock that every call holds.
#
# No exception may pass through C. An exception of a callback is kept, the library is told to stop, and the exception is
# thrown again when the call has ended. Ctrl-C is held back during a call (`disable_sigint`) and let in where it can be
# caught: inside the progress callback, which then cancels by its result, and at the call's end. Calls that read ignore
# that result: they run to their end, and the exception is thrown then.

"""
    Context(; progress=nothing)

Objects are made with a context. Each makes its own unless `context` is given; a solver has that of its problem.
`progress(stage, done, total)` is called inside long work, on the calling thread; what it returns cancels if it is
`true`, what it throws is thrown by the call.
"""
mutable struct Context
    handle::Ptr{Raw.delam_context}
    lock::ReentrantLock
    working::Bool
    hosted::Bool
    progress::Any
    exception::Any
    lines::Vector{Tuple{Int32,String}}

    function Context(; progress=nothing)
        out = Ref{Ptr{Raw.delam_context}}(C_NULL)
        status = Raw.delam_context_create(out)
        status == Raw.DELAM_OK || throw(DelamError(status, "no context: out of memory"))
        context = new(out[], ReentrantLock(), false, false, progress, nothing, Tuple{Int32,String}[])
        finalizer(release, context)
        Raw.delam_context_set_log(context.handle, log_callback(), pointer_from_objref(context))
        Raw.delam_context_set_progress(context.handle, progress_callback(), pointer_from_objref(context))
        return context
    end
end

"A mesh, a law, a problem or a solver: `handle`, C_NULL once it is closed, and `context`."
abstract type Object end

context_of(context::Context) = context
context_of(object::Object) = object.context

function open_handle(object)
    object.handle == C_NULL && throw(InvalidHandle("this $(nameof(typeof(object))) is closed"))
    return object.handle
end

Base.isopen(object::Object) = object.handle != C_NULL

# ---- callbacks

log_callback() = @cfunction(on_log, Cvoid, (Int32, Cstring, Ptr{Cvoid}))::Raw.delam_log_callback

function on_log(level::Int32, text::Cstring, user::Ptr{Cvoid})::Cvoid
    try
        context = unsafe_pointer_to_objref(user)::Context
        push!(context.lines, (level, unsafe_string(text)))
    catch
        # A line that does not fit is lost.
    end
    return
end

progress_callback() =
    @cfunction(on_progress, Int32, (Cstring, Int64, Int64, Ptr{Cvoid}))::Raw.delam_progress_callback

function on_progress(stage::Cstring, done::Int64, total::Int64, user::Ptr{Cvoid})::Int32
    context = unsafe_pointer_to_objref(user)::Context
    context.exception === nothing || return Int32(1)
    try
        stop = reenable_sigint() do
            # A pending Ctrl-C is thrown here.
            context.progress === nothing ? false : context.progress(unsafe_string(stage), done, total)
        end
        return Int32(stop === true)
    catch exception
        context.exception = exception
        return Int32(1)
    end
end

"Called in a law's callback: the exception is thrown when the call of the library has ended."
function keep_exception(exception)
    context = task_local_storage(:delam_at_work)::Context
    if context.exception === nothing
        context.exception = exception
    end
    return Int32(1)
end

# ---- calls

"""
    ask(body, object, other=object; accepted=Raw.DELAM_OK)

Runs `body(handle)`, a call of the library that gives a status, while the contexts of both objects belong to this task,
and throws what went wrong. The status `accepted` is given back beside DELAM_OK.
"""
function ask(body, object, other=object; accepted=Raw.DELAM_OK)
    one, two = context_of(object), context_of(other)
    if objectid(two) < objectid(one)
        one, two = two, one
    end
    lock(one.lock)
    try
        lock(two.lock)
        try
            return GC.@preserve object other asked(body, object, other, accepted)
        finally
            unlock(two.lock)
        end
    finally
        unlock(one.lock)
    end
end

function asked(body, object, other, accepted)
    context, second = context_of(object), context_of(other)
    refuse_reentry(context)
    refuse_reentry(second)
    handle = open_handle(object)
    open_handle(other)
    context.exception = nothing
    empty!(context.lines)
    context.working = second.working = true
    status = try
        if context.hosted
            task_local_storage(:delam_at_work, context) do
                disable_sigint(() -> body(handle))
            end
        else
            disable_sigint(() -> body(handle))
        end
    finally
        context.working = second.working = false
    end
    report(context)
    exception, context.exception = context.exception, nothing
    exception === nothing || throw(exception)
    status == Raw.DELAM_OK || status == accepted || throw(DelamError(status, last_message(context)))
    return status
end

refuse_reentry(context) =
    context.working && throw(StateError("the library was called from inside a callback, with an object at work"))

last_message(context) = unsafe_string(Raw.delam_context_message(context.handle))

"Warnings and notes go to the logger; the text of an error goes with its exception."
function report(context)
    for (level, line) in context.lines
        if level == 1
            @warn line
        elseif level == 2
            @info line
        end
    end
    return
end

"Runs `body(handle)`, a call of the library that returns text; `nothing` if it returns none."
function ask_text(body, object)
    context = context_of(object)
    lock(context.lock)
    try
        refuse_reentry(context)
        text = GC.@preserve object body(open_handle(object))
        return text == C_NULL ? nothing : unsafe_string(text)
    finally
        unlock(context.lock)
    end
end

"""
    made(body, T, object, other=object; accepted=Raw.DELAM_OK)

The handle, of a `T`, that `body(handle, out)` has made, and its status. None is left behind when it throws.
"""
function made(body, T, object, other=object; accepted=Raw.DELAM_OK)
    out = Ref{Ptr{T}}(C_NULL)
    try
        status = ask(handle -> body(handle, out), object, other; accepted=accepted)
        return out[], status
    catch
        out[] == C_NULL || destroy(out)
        rethrow()
    end
end

"""
    cancel(object)

Asks a call that runs with this object or context in another thread to stop at its next check: it throws `Cancelled`.
If none is running, the request waits for the next step, or for the creation or loading of a solver.
"""
function cancel(object)
    context = context_of(object)
    GC.@preserve context Raw.delam_context_cancel(context.handle)
    return
end

# ---- destruction of objects

destroy(out::Ref{Ptr{Raw.delam_context}}) = Raw.delam_context_destroy(out)
destroy(out::Ref{Ptr{Raw.delam_mesh}}) = Raw.delam_mesh_destroy(out)
destroy(out::Ref{Ptr{Raw.delam_law}}) = Raw.delam_law_destroy(out)
destroy(out::Ref{Ptr{Raw.delam_problem}}) = Raw.delam_problem_destroy(out)
destroy(out::Ref{Ptr{Raw.delam_solver}}) = Raw.delam_solver_destroy(out)

"The finalizer. It runs anywhere and must not wait: while a call of the context runs, destruction is postponed."
function release(object)
    guard = context_of(object).lock
    if islocked(guard) || !trylock(guard)
        finalizer(release, object)
        return
    end
    try
        out = Ref(object.handle)
        destroy(out)
        object.handle = out[]
    finally
        unlock(guard)
    end
    return
end

"Frees the library's data of this object, which cannot be used any more. Garbage collection does the same."
Base.close(object::Object) = finalize(object)
