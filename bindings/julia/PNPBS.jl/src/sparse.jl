# SPDX-License-Identifier: BSD-3-Clause

"""
    sparse(rows::CompressedRows; columns = length(rows)) -> SparseMatrixCSC{Bool,Int64}
    sparse(rows::CompressedRows, values; columns = length(rows)) -> SparseMatrixCSC

Returns the sparse matrix whose row i has its entries in the columns `rows[i]`. `values` has a value
for each of `rows.entries`, in that order, or is a `CompressedRows` with the same offsets, like the
flags of [`stars`](@ref). Without `values` the entries are `true`. If a row contains a column twice,
the values are added (`Bool`s by `|`). The time is linear in the number of entries. Local.

Lists contain ghosts, whose columns follow those of the nodes. On several ranks `columns` is
therefore `node_count(placement) + ghost_count(placement)`. The matrix has the rows of this rank and
multiplies vectors whose ghosts [`update_ghosts!`](@ref) has updated. An entry beyond the last
column throws an `ArgumentError`. `sparse` is the function of Julia's SparseArrays.

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
