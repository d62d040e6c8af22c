# SPDX-License-Identifier: BSD-3-Clause

"""
    Context(; options...)
    Context(comm::MPI.Comm; options...)
    Context(handle::Integer; library = nothing, options...)
    Context(f, arguments...; options...)

Creates a context, on which domains and placements are created.

- Without arguments the context is for a single process, and no MPI function is called.
- `comm` is a communicator of MPI.jl, `handle` the Fortran handle of any communicator
  (`MPI_Comm_c2f`). The context uses a duplicate of the communicator, and its creation is
  collective.
- `library` is the result of `MPI_Get_library_version`. If it is given, the library compares it with
  its own MPI.
- `options` are the defaults of placements on this context, as in [`set!`](@ref).

Throws `:error_mpi` if MPI is not running or is another MPI library, and `:error_unsupported` for a
communicator in a build without MPI.

Call `close` when the context is no longer needed. Closing is collective, and the garbage collectors
of different ranks run at different times, so there is no finalizer. Contexts on communicators of
MPI.jl are closed by `MPI.Finalize` at the latest. Contexts with a Fortran handle must be closed
before MPI is finalised.

The last form calls `f(context)` and closes the context, as `open` does with files. If `f` throws, a
context on several ranks is not closed, because the other ranks may not close theirs.

    Context() do context
        domain = Domain(context)
        ...
    end
"""
mutable struct Context
    handle::LibPNPBS.pnpbs_context
    on_ranks::Bool
    # Open domains, placements, transfers and particles. The library holds pointers to their
    # callbacks until they are closed, so they must live.
    children::Vector{Any}
    # The exception that a callback has thrown in the call in progress, with its backtrace.
    thrown::Union{CapturedException,Nothing}
    sigint_disabled::Bool  # true during a call that may take long

    Context(handle::LibPNPBS.pnpbs_context, on_ranks::Bool) =
        new(handle, on_ranks, [], nothing, false)
end

function Context(; options...)
    handle = Ref{LibPNPBS.pnpbs_context}(C_NULL)
    check_without_context(LibPNPBS.pnpbs_context_create_serial(handle))
    return set!(Context(handle[], false); options...)
end

function Context(comm::Integer; library::Union{AbstractString,Nothing} = nothing, options...)
    handle = Ref{LibPNPBS.pnpbs_context}(C_NULL)
    # The text of Open MPI includes the terminating null character, which MPI.jl keeps.
    check_without_context(
        library === nothing ? LibPNPBS.pnpbs_context_create_f(comm, handle) :
        LibPNPBS.pnpbs_context_create_checked_f(comm, rstrip(library, '\0'), handle))
    return set!(Context(handle[], true); options...)
end

function Context(f::Function, arguments...; options...)
    context = Context(arguments...; options...)
    result = try
        f(context)
    catch
        context.on_ranks || close(context)
        rethrow()
    end
    close(context)
    return result
end

"""
    close(context::Context)
    close(domain::Domain)
    close(placement::Placement)
    close(transfer::Transfer)
    close(particles::Particles)

Releases the resources of the library. Repeated calls have no effect. Using a closed object throws a
[`PNPBSError`](@ref) with the status `:error_handle`. Closing a context is collective and closes the
domains, placements, transfers and particles on it. Closing the other objects is local. A placement
keeps what it needs of its domain, so the domain may be closed first. The arrays of particles
remain.
"""
function Base.close(context::Context)
    isopen(context) || return nothing
    foreach(close, copy(context.children))
    handle = Ref(context.handle)
    check(context, LibPNPBS.pnpbs_context_destroy(handle))
    context.handle = C_NULL
    return nothing
end

"""
    isopen(context), isopen(domain), isopen(placement), isopen(transfer), isopen(particles)

Returns whether the object has not been closed. Local.
"""
Base.isopen(context::Context) = context.handle != C_NULL

Base.show(io::IO, context::Context) =
    print(io, "PNPBS.Context(", isopen(context) ? context.on_ranks ? "over ranks" : "one process" :
                                "closed", ")")

# Returns the handle of an object for the library. Throws if the object is closed.
function live(object)
    isopen(object) ||
        throw(PNPBSError(:error_handle, "this $(nameof(typeof(object))) has been closed"))
    return object.handle
end

# Returns the name of the status of a call, or throws its error. An exception that a callback has
# thrown has priority, because the error of the library only says that a callback failed.
function check(context::Context, code)
    thrown, context.thrown = context.thrown, nothing
    thrown === nothing || throw_again(thrown)
    code < 0 && throw(PNPBSError(status_name(code), last_error(context.handle)))
    return status_name(code)
end

# Throws the exception of a callback unchanged. `throw` accepts no backtrace, so the captured
# exception is thrown first: Julia then shows it, with the backtrace of the callback, as the cause.
function throw_again(thrown::CapturedException)
    try
        throw(thrown)
    catch
        throw(thrown.ex)
    end
end

# Removes a closed object from the children of its context.
function forget!(context::Context, child)
    filter!(other -> other !== child, context.children)
    return nothing
end

# ---------------------------------------------------------------- options -----------------------
"""
    set!(context::Context; options...) -> context
    set!(placement::Placement; options...) -> placement

Sets options by name, as in `set!(placement; steps = 60, method = "paper")`. Values are numbers,
strings or symbols. [`option_table`](@ref) lists the options. On a context they apply to placements
that are created later; `threads` can be set only there, before the first placement of the process
is created. Local.

Throws `:error_key` for an unknown name, with the nearest known one, and `:error_argument` for a
value out of range, with the range.
"""
function set!(context::Context; options...)
    for (key, value) in options
        check(context, set_option(live(context), string(key), value))
    end
    return context
end

# Sets an option of a context with the function for the type of the value.
set_option(handle, key, value::Integer) = LibPNPBS.pnpbs_context_set_int64(handle, key, value)
set_option(handle, key, value::Real) = LibPNPBS.pnpbs_context_set_double(handle, key, value)
set_option(handle, key, value) = LibPNPBS.pnpbs_context_set(handle, key, string(value))
