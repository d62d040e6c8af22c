# SPDX-License-Identifier: BSD-3-Clause
# Information about the library. All functions are local and need no context.

"""
    library_version() -> VersionNumber

Returns the version of the library that is loaded.
"""
function library_version()
    major, minor, patch = Ref{Int32}(), Ref{Int32}(), Ref{Int32}()
    check_without_context(LibPNPBS.pnpbs_version(major, minor, patch))
    return VersionNumber(major[], minor[], patch[])
end

"""
    build_info() -> String

Returns the build configuration, one "name: value" per line.
"""
build_info() = string_or_empty(LibPNPBS.pnpbs_build_info())

"""
    mpi_library() -> String

Returns the MPI that the library was built with, such as "Open MPI 4.1.4"; empty in a build without
MPI. Julia's MPI.jl must use the same one.
"""
mpi_library() = string_or_empty(LibPNPBS.pnpbs_mpi_library())

"""
    shutdown()

Finalises Kokkos if PNPBS initialised it. Optional. Kokkos cannot be initialised twice, so nothing
can be placed afterwards. Local.
"""
shutdown() = check_without_context(LibPNPBS.pnpbs_finalize())

"""
    discard_unfinished_files()

Removes the temporary files of unfinished writes of this process; for programs about to end.
"""
discard_unfinished_files() = check_without_context(LibPNPBS.pnpbs_discard_unfinished_files())

row_count(count) = (n = Ref{Int32}(0); check_without_context(count(n)); 0:(n[] - 1))

# Returns a row of a table, given the names of the columns that are strings and the function that
# fills them.
function text_row(columns::NTuple{N,Symbol}, fill!) where {N}
    texts = [Ref{Cstring}() for _ in columns]
    check_without_context(fill!(texts...))
    return NamedTuple{columns}(Tuple(string_or_empty(text[]) for text in texts))
end

"""
    option_table()

Returns the options of contexts and placements ([`set!`](@ref)): a vector of named tuples `(name,
type, default, range, help)`.
"""
option_table() =
    [text_row((:name, :type, :default, :range, :help),
              (texts...) -> LibPNPBS.pnpbs_option_info(i, texts...))
     for i in row_count(LibPNPBS.pnpbs_option_count)]

"""
    statistic_table()

Returns the statistics of placements ([`statistic`](@ref)): a vector of named tuples `(name, type,
help)`.
"""
statistic_table() =
    [text_row((:name, :type, :help), (texts...) -> LibPNPBS.pnpbs_statistic_info(i, texts...))
     for i in row_count(LibPNPBS.pnpbs_statistic_count)]

"""
    format_table()

Returns the formats of files ([`write_file`](@ref)): a vector of named tuples `(name, help, binary,
elements)`.
"""
format_table() = format_row.(row_count(LibPNPBS.pnpbs_format_count))

function format_row(i)
    binary, elements = Ref{Int32}(), Ref{Int32}()
    row = text_row((:name, :help),
                   (texts...) -> LibPNPBS.pnpbs_format_info(i, texts..., binary, elements))
    return (; row..., binary = binary[] != 0, elements = elements[] != 0)
end
