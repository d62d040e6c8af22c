# SPDX-License-Identifier: BSD-3-Clause
# Conversion of the library's status to symbols and exceptions, and of arguments to arrays.

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
`:error_argument`, `:error_spacing` or `:error_state`. `message` states what is wrong, with the
value, and what to change. "Collective" functions throw on all ranks or on none.

An exception that a callback throws ends the call in progress, which throws it unchanged on the rank
of the callback. The other ranks throw a `PNPBSError` with the status `:error_callback`.
"""
struct PNPBSError <: Exception
    status::Symbol
    message::String
end

function Base.showerror(io::IO, e::PNPBSError)
    print(io, "PNPBSError (", e.status, "): ", e.message)
end

string_or_empty(text::Cstring) = convert(Ptr{UInt8}, text) == C_NULL ? "" : unsafe_string(text)

# Returns the message of the last error on a context, or of this thread for a null handle.
last_error(context::Ptr{Cvoid}) = string_or_empty(LibPNPBS.pnpbs_last_error(context))

# Throws an error if a function without a context has failed. The thread holds its message.
function check_without_context(code)
    code < 0 && throw(PNPBSError(status_name(code), last_error(C_NULL)))
    return nothing
end

# Throws unless `values` has n entries. The message names the argument of the Julia function.
function require_length(values, n, what)
    length(values) == n ||
        throw(DimensionMismatch("$what has length $(length(values)); $n was expected"))
    return nothing
end

# Throws unless `columns` has so many rows.
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

# Converts tags to n Int32. `nothing` stands for the default of the library, and a single number for
# the tag of all.
as_tags(::Nothing, n, what) = C_NULL
as_tags(tag::Integer, n, what) = fill(Int32(tag), n)
function as_tags(tags::AbstractVector, n, what)
    require_length(tags, n, what)
    return convert(Vector{Int32}, tags)
end
