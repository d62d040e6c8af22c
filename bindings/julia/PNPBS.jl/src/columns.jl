# SPDX-License-Identifier: BSD-3-Clause

"""
    reinterpret_columns(T, matrix) -> AbstractVector{T}

Returns the columns of a matrix as a vector of `T`. The vector shares the memory of the matrix. `T`
is `NTuple{2,Float64}`, `SVector{2,Float64}` of StaticArrays, or any other plain bits type
(`isbitstype`) that consists of as many numbers of the matrix's type as a column has. Other types
throw an `ArgumentError`. Use it for points and normals, or with `NTuple{3,Int64}` for triangles.

    x = reinterpret_columns(SVector{2,Float64}, nodes(placement).points)
    norm(x[1] - x[2])
"""
function reinterpret_columns(::Type{T}, matrix::Matrix{S}) where {T,S}
    rows = size(matrix, 1)
    consists_of(T, S) && sizeof(T) == rows * sizeof(S) || throw(ArgumentError(
        "columns of $rows numbers of type $S cannot be reinterpreted as $T"))
    return reinterpret(T, vec(matrix))
end

# Returns whether T consists of numbers of type S only, at any depth. An SVector, for example, is a
# structure that holds a tuple.
consists_of(::Type{S}, ::Type{S}) where {S} = true
consists_of(T::Type, S::Type) =
    isbitstype(T) && fieldcount(T) > 0 && all(F -> consists_of(F, S), fieldtypes(T))
