# SPDX-License-Identifier: BSD-3-Clause

"""
    CompressedRows{T} <: AbstractVector

Rows of different lengths, stored one after another. Row `i` is
`entries[offsets[i]:(offsets[i + 1] - 1)]`. An object is a vector of its rows, each of which is a
view without a copy. `rows[i]` is one row, and `length(rows)` is their number. [`sparse`](@ref)
makes a matrix of them. A loop over the neighbours of every node is

    for (i, neighbours) in enumerate(adjacency(placement))
        for j in neighbours ... end
    end
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

# Converts offsets and indices of the library, which count from 0, in place.
function rows_of_indices(offsets::Vector{Int64}, indices::Vector{Int64})
    return CompressedRows(offsets .+= 1, indices .+= 1)
end
