# SPDX-License-Identifier: BSD-3-Clause
# Tests of lists as matrices of SparseArrays.
using SparseArrays

@testset "sparse matrices of rows" begin
    rows = CompressedRows([1, 3, 3, 6], [3, 1, 2, 1, 3])
    pattern = sparse(rows)
    @test pattern isa SparseMatrixCSC{Bool,Int64}
    @test Matrix(pattern) == [1 0 1; 0 0 0; 1 1 1]
    A = sparse(rows, [1.5, 2.5, 3.5, 4.5, 5.5])
    @test A isa SparseMatrixCSC{Float64,Int64} && A == [2.5 0 1.5; 0 0 0; 4.5 3.5 5.5]
    @test all(issorted(rowvals(A)[nzrange(A, j)]) for j in 1:3)
    # The rows do not change, and zeros remain stored entries.
    @test rows.entries == [3, 1, 2, 1, 3]
    @test nnz(sparse(rows, zeros(5))) == 5

    # Columns of ghosts may have no entry. Fewer columns than the entries require are an error.
    @test sparse(rows, 1:5; columns = 5) == [2 0 1 0 0; 0 0 0 0 0; 4 3 5 0 0]
    few = thrown(() -> sparse(CompressedRows([1, 2], [4])))
    @test few isa ArgumentError && occursin("column 4 of 1", few.msg)
    @test occursin("ghost_count", few.msg)

    @test sparse(CompressedRows([1, 3], [1, 1]), [2, 3]) == fill(5, 1, 1)
    @test size(sparse(CompressedRows([1], Int64[]); columns = 2)) == (0, 2)
    @test_throws DimensionMismatch sparse(rows, ones(4))
    flags = CompressedRows([1, 3, 3, 6], [true, false, true, true, false])
    @test Matrix(sparse(rows, flags)) == [0 0 1; 0 0 0; 1 1 0]
    @test_throws DimensionMismatch sparse(rows, CompressedRows([1, 2, 3, 6], flags.entries))
end

@testset "sparse matrices of lists and stars" begin
    Context() do context
        placement = placed_square(context)
        lists, around = adjacency(placement), stars(placement)
        pattern = sparse(lists)
        @test size(pattern) == (length(lists), length(lists))
        @test nnz(pattern) == length(lists.entries) && pattern == pattern'
        @test all(findall(pattern[i, :]) == sort(lists[i]) for i in eachindex(lists))
        # The flags count every triangle once at each of its corners.
        @test sum(sparse(around...)) == 3 * size(triangles(placement), 2)
    end
end
