# SPDX-License-Identifier: BSD-3-Clause
# Information about the library. All functions are local and need no context.

"""
    library_version() -> VersionNumber

Returns the version of the loaded library. Local.
"""
function library_version()
    major, minor, patch = Ref{Int32}(), Ref{Int32}(), Ref{Int32}()
    check_without_context(LibPNPBS.pnpbs_version(major, minor, patch))
    return VersionNumber(major[], minor[], patch[])
end

"""
    build_info() -> String

Returns the build configuration, one "name: value" per line. Local.
"""
build_info() = string_or_empty(LibPNPBS.pnpbs_build_info())

"""
    mpi_library() -> String

Returns the MPI library that PNPBS was built with, such as "Open MPI 4.1.4". The text is empty in a
build without MPI. MPI.jl must use the same MPI library. Local.
"""
mpi_library() = string_or_empty(LibPNPBS.pnpbs_mpi_library())

"""
    shutdown()

Finalises Kokkos if PNPBS has initialised it. The call is optional. Kokkos cannot be initialised
again, so placements cannot compute afterwards. Throws `:error_state` in a callback. Local.
"""
shutdown() = check_without_context(LibPNPBS.pnpbs_finalize())

"""
    discard_unfinished_files()

Removes the temporary files of unfinished writes of this process. Call it before the program ends
early. Local.
"""
discard_unfinished_files() = check_without_context(LibPNPBS.pnpbs_discard_unfinished_files())

row_count(count) = (n = Ref{Int32}(0); check_without_context(count(n)); 0:(n[] - 1))

# Returns a row of a table as a named tuple of strings, which fill! stores.
function text_row(columns::NTuple{N,Symbol}, fill!) where {N}
    texts = [Ref{Cstring}() for _ in columns]
    check_without_context(fill!(texts...))
    return NamedTuple{columns}(Tuple(string_or_empty(text[]) for text in texts))
end

"""
    option_table()

Returns the options of contexts and placements ([`set!`](@ref)) as a vector of named tuples `(name,
type, default, range, help)` of strings. Local.
"""
option_table() =
    [text_row((:name, :type, :default, :range, :help),
              (texts...) -> LibPNPBS.pnpbs_option_info(i, texts...))
     for i in row_count(LibPNPBS.pnpbs_option_count)]

"""
    statistic_table()

Returns the statistics of placements ([`statistic`](@ref)) as a vector of named tuples `(name, type,
help)` of strings. Local.
"""
statistic_table() =
    [text_row((:name, :type, :help), (texts...) -> LibPNPBS.pnpbs_statistic_info(i, texts...))
     for i in row_count(LibPNPBS.pnpbs_statistic_count)]

"""
    format_table()

Returns the file formats ([`write_file`](@ref)) as a vector of named tuples `(name, help, binary,
elements)`. `elements` is whether one file can hold nodes and elements. Local.
"""
format_table() = format_row.(row_count(LibPNPBS.pnpbs_format_count))

function format_row(i)
    binary, elements = Ref{Int32}(), Ref{Int32}()
    row = text_row((:name, :help),
                   (texts...) -> LibPNPBS.pnpbs_format_info(i, texts..., binary, elements))
    return (; row..., binary = binary[] != 0, elements = elements[] != 0)
end
