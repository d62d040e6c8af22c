# SPDX-License-Identifier: BSD-3-Clause

"""
    CompressedRows{T} <: AbstractVector

Lists of different lengths in compressed rows: row `i` holds `entries[offsets[i]:offsets[i + 1] -
1]`, 1-based. It is a vector of its rows, each of them a view without a copy, so that

    for (i, neighbours) in enumerate(adjacency(placement))
        for j in neighbours ... end
    end

visits the neighbours of every node; `rows[i]` is one row, `length(rows)` their number.
[`sparse`](@ref) makes a matrix of them.
"""
struct CompressedRows{T} <: AbstractVector{SubArray{T,1,Vector{T},Tuple{UnitRange{Int64}},true}}
    offsets::Vector{Int64}
    entries::Vector{T}
end

Base.size(rows::CompressedRows) = (length(rows.offsets) - 1,)
Base.IndexStyle(::Type{<:CompressedRows}) = IndexLinear()

function Base.getindex(rows::CompressedRows, i::Int)
    @boundscheck checkbounds(rows, i)
    return view(rows.entries, rows.offsets[i]:(rows.offsets[i + 1] - 1))
end

# Converts the library's 0-based offsets and indices in place.
function rows_of_indices(offsets::Vector{Int64}, indices::Vector{Int64})
    return CompressedRows(offsets .+= 1, indices .+= 1)
end
