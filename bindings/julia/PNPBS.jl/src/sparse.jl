# SPDX-License-Identifier: BSD-3-Clause

"""
    sparse(rows::CompressedRows; columns = length(rows)) -> SparseMatrixCSC{Bool,Int64}
    sparse(rows::CompressedRows, values; columns = length(rows)) -> SparseMatrixCSC

Returns the sparse matrix whose row i has its entries in the columns `rows[i]`, in time linear in
their number. `values` has one for each of `rows.entries`, in that order, or is a `CompressedRows`
with the same offsets, like the flags of [`stars`](@ref); without it the entries are `true`. If a
row contains a column twice, the values are added (of `Bool`s, `|`).

Lists contain ghosts as well, whose columns follow those of the nodes: on several ranks `columns` is
`node_count(placement) + ghost_count(placement)`, and the matrix is this rank's rows, for vectors
that [`update_ghosts!`](@ref) has completed. An entry beyond the last column is an `ArgumentError`.
Local. `sparse` is that of Julia's SparseArrays.

    lists = adjacency(placement)
    weights = [w(i, j) for (i, neighbours) in enumerate(lists) for j in neighbours]
    A = sparse(lists, weights)
"""
function SparseArrays.sparse(rows::CompressedRows{<:Integer}, values::AbstractVector;
                             columns::Integer = length(rows))
    require_length(values, length(rows.entries), "values")
    last_column = reduce(max, rows.entries; init = 0)
    last_column <= columns || throw(ArgumentError(
        "the rows have an entry in column $last_column of $columns; with ghosts, columns = " *
        "node_count(placement) + ghost_count(placement)"))
    return sparse(row_of_each_entry(rows), rows.entries, values, length(rows), columns)
end

function SparseArrays.sparse(rows::CompressedRows{<:Integer}, values::CompressedRows; options...)
    values.offsets == rows.offsets ||
        throw(DimensionMismatch("the rows of values are not as long as those of the matrix"))
    return sparse(rows, values.entries; options...)
end

SparseArrays.sparse(rows::CompressedRows{<:Integer}; options...) =
    sparse(rows, fill(true, length(rows.entries)); options...)

function row_of_each_entry(rows)
    numbers = similar(rows.offsets, length(rows.entries))
    for i in eachindex(rows)
        numbers[rows.offsets[i]:(rows.offsets[i + 1] - 1)] .= i
    end
    return numbers
end
