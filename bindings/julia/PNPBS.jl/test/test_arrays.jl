# SPDX-License-Identifier: BSD-3-Clause
# Results without copies.

struct Site
    x::Float64
    y::Float64
end

struct Shifted
    place::NTuple{2,Float64}
    by::Site
end

@testset "columns as values of a type" begin
    points = [1.0 3.0 5.0; 2.0 4.0 6.0]
    pairs = reinterpret_columns(NTuple{2,Float64}, points)
    @test pairs isa AbstractVector{NTuple{2,Float64}} && pairs == [(1, 2), (3, 4), (5, 6)]
    pairs[2] = (30, 40)
    points[1, 3] = 50
    @test points == [1 30 50; 2 40 6] && pairs[3] == (50, 6)
    @test reinterpret_columns(Site, points)[1] == Site(1, 2)
    @test reinterpret_columns(Shifted, zeros(4, 2)) == fill(Shifted((0, 0), Site(0, 0)), 2)
    @test reinterpret_columns(NTuple{3,Int64}, [1 4; 2 5; 3 6]) == [(1, 2, 3), (4, 5, 6)]
    @test isempty(reinterpret_columns(Site, zeros(2, 0)))
    wrong = thrown(() -> reinterpret_columns(NTuple{3,Float64}, points))
    @test wrong isa ArgumentError && occursin("columns of 2 numbers of type Float64", wrong.msg)
    for T in (NTuple{2,Int64}, NTuple{4,Float32}, Vector{Float64}, Tuple{Float64,Int64}, Float64)
        @test_throws ArgumentError reinterpret_columns(T, points)
    end
end
