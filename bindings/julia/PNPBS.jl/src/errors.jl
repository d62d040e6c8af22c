# SPDX-License-Identifier: BSD-3-Clause
# From the library's status to Julia's symbols and exceptions.

const STATUS_NAMES = Dict{Int,Symbol}(
    getfield(LibPNPBS, name) => Symbol(lowercase(string(name)[7:end]))
    for name in names(LibPNPBS, all = true)
    if startswith(string(name), r"PNPBS_(OK|NOT|STOP|SPACING|ERR)"))

const WARNING_NAMES = Dict{Int,Symbol}(
    getfield(LibPNPBS, name) => Symbol(lowercase(string(name)[15:end]))
    for name in names(LibPNPBS, all = true) if startswith(string(name), "PNPBS_WARNING_"))

status_name(code) = get(STATUS_NAMES, Int(code), Symbol("status_", Int(code)))

"""
    PNPBSError <: Exception

An error of the library. `status` is the name of the status in the header in lower case, such as
`:error_argument`, `:error_spacing` or `:error_state`; `message` says what was wrong, with the
value, and what to change. Functions marked "collective" throw on all ranks or on none.

An exception that a callback throws is rethrown unchanged by the call in progress, on the rank that
threw it; the other ranks get a `PNPBSError` with status `:error_callback`.
"""
struct PNPBSError <: Exception
    status::Symbol
    message::String
end

function Base.showerror(io::IO, e::PNPBSError)
    print(io, "PNPBSError (", e.status, "): ", e.message)
end

string_or_empty(text::Cstring) = convert(Ptr{UInt8}, text) == C_NULL ? "" : unsafe_string(text)

# The message of the last error on a context; of this thread with a null handle.
last_error(context::Ptr{Cvoid}) = string_or_empty(LibPNPBS.pnpbs_last_error(context))

# What could not be made has no context to hold the message.
function check_without_context(code)
    code < 0 && throw(PNPBSError(status_name(code), last_error(C_NULL)))
    return nothing
end

# Checked by the length here, so that the message tells what the caller knows.
function require_length(values, n, what)
    length(values) == n ||
        throw(DimensionMismatch("$what has length $(length(values)); $n was expected"))
    return nothing
end

function require_columns(columns, rows, what)
    size(columns, 1) == rows || throw(DimensionMismatch(
        "$what has size $(size(columns)); ($rows, n) was expected, a column for each"))
    return nothing
end

function as_points(points::AbstractMatrix{<:Real}, dim, what)
    require_columns(points, dim, what)
    return convert(Matrix{Float64}, points)
end

as_point(point, dim, what) = (require_length(point, dim, what); Float64[point...])

# Tags as the library takes them: nothing for its default, one for all, or one for each.
as_tags(::Nothing, n, what) = C_NULL
as_tags(tag::Integer, n, what) = fill(Int32(tag), n)
function as_tags(tags::AbstractVector, n, what)
    require_length(tags, n, what)
    return convert(Vector{Int32}, tags)
end
