# SPDX-License-Identifier: BSD-3-Clause

"""
    Context(; options...)
    Context(comm::MPI.Comm; options...)
    Context(handle::Integer; library = nothing, options...)
    Context(f, arguments...; options...)

Creates the context on which domains and placements are made. Without arguments it is for one
process and calls no MPI function. With a communicator of MPI.jl, or with the Fortran handle of any
communicator (`MPI_Comm_c2f`), it uses a duplicate of that communicator, and is created
collectively; `library` is the result of `MPI_Get_library_version`, if the library should compare it
with its own MPI. Options are defaults for the placements made on it, as in [`set!`](@ref).

`close` it when it is no longer needed. No finalizer does, because destroying a context is
collective and the garbage collectors of different ranks run at different times. Contexts made with
MPI.jl are closed by `MPI.Finalize` at the latest; those with a raw handle must be closed before MPI
is finalised.

The last form calls `f(context)` and closes the context, as `open` does with files. If `f` throws, a
context on several ranks is not closed, because the others might never close theirs.

    Context() do context
        domain = Domain(context)
        ...
    end
"""
mutable struct Context
    handle::LibPNPBS.pnpbs_context
    on_ranks::Bool
    # The open domains, placements, transfers and particles. They are kept here because the library
    # holds pointers to their callbacks until they are closed.
    children::Vector{Any}
    # The exception that a callback has thrown during the current call, and its backtrace.
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
    # Open MPI counts the terminating zero as a part of the text, and MPI.jl does not remove it.
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

Releases the resources of the library. Closing twice is allowed; using a closed object is a
[`PNPBSError`](@ref) with status `:error_handle`. Closing a context is collective and closes the
domains, placements, transfers and particles made on it; closing those is local. A placement keeps
what it needs of its domain, so the domain may be closed first. The arrays of particles remain.
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

Returns whether the object has not been closed.
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

# Checks the status of every call on a context. An exception of a callback takes precedence, as the
# library's own message could only say that a callback failed.
function check(context::Context, code)
    thrown, context.thrown = context.thrown, nothing
    thrown === nothing || throw_again(thrown)
    code < 0 && throw(PNPBSError(status_name(code), last_error(context.handle)))
    return status_name(code)
end

# Throws the original exception. A backtrace cannot be passed to `throw`, so the point where the
# callback threw is shown as its cause.
function throw_again(thrown::CapturedException)
    try
        throw(thrown)
    catch
        throw(thrown.ex)
    end
end

function forget!(context::Context, child)
    filter!(other -> other !== child, context.children)
    return nothing
end

# ---------------------------------------------------------------- options -----------------------
"""
    set!(context::Context; options...) -> context
    set!(placement::Placement; options...) -> placement

Sets options by name, as in `set!(placement; steps = 60, method = "paper")`; values are numbers,
strings or symbols. [`option_table`](@ref) lists them. On a context they apply to placements made
later; `threads` can only be set there. Local. Unknown names and values out of range are a
[`PNPBSError`](@ref) that names the nearest option or the range.
"""
function set!(context::Context; options...)
    for (key, value) in options
        check(context, set_option(live(context), string(key), value))
    end
    return context
end

# The three functions of the library that set an option, for both kinds of handles.
set_option(handle, key, value::Integer) = LibPNPBS.pnpbs_context_set_int64(handle, key, value)
set_option(handle, key, value::Real) = LibPNPBS.pnpbs_context_set_double(handle, key, value)
set_option(handle, key, value) = LibPNPBS.pnpbs_context_set(handle, key, string(value))
