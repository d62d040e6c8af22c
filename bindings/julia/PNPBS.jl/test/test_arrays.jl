# SPDX-License-Identifier: BSD-3-Clause
# Tests of results as views without copies, and of results in arrays of earlier results.

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

# SVector of StaticArrays if that is installed, otherwise a stand-in with the same layout, which
# stores its numbers in a tuple.
if Base.find_package("StaticArrays") === nothing
    struct StandInArray{N,T} <: AbstractVector{T}
        data::NTuple{N,T}
    end
    Base.size(::StandInArray{N}) where {N} = (N,)
    Base.getindex(v::StandInArray, i::Int) = v.data[i]
    const SVector = StandInArray
else
    @eval using StaticArrays: SVector
end

@testset "points as static vectors" begin
    Context() do context
        box = add_box!(Domain(context; dim = 3), (0, 0, 0), (1, 1, 1))
        for (domain, N, d) in ((square_domain(context), 2, 0.2), (box, 3, 0.5))
            placement = initialise!(set_spacing!(Placement(domain), d))
            points = nodes(placement).points
            vectors = reinterpret_columns(SVector{N,Float64}, points)
            @test eltype(vectors) === SVector{N,Float64} && length(vectors) == size(points, 2)
            @test pointer(vectors) == Ptr{SVector{N,Float64}}(pointer(points))
            @test all(vectors[i] == points[:, i] for i in eachindex(vectors))
            vectors[1] = vectors[2]
            points[1, 3] = 7
            @test points[:, 1] == points[:, 2] && vectors[3][1] == 7
            # Allocations do not grow with the number of points.
            @test (@allocated reinterpret_columns(SVector{N,Float64}, points)) < 500
            @test_throws ArgumentError reinterpret_columns(SVector{5 - N,Float64}, points)
            @test_throws ArgumentError reinterpret_columns(SVector{N,Float32}, points)
        end
        # Input arrays may be reinterpreted vectors, too.
        corners = [SVector{2,Float64}((x, y)) for (x, y) in ((0, 0), (2, 0), (2, 1), (0, 1))]
        rectangle = add_polyline!(Domain(context), reshape(reinterpret(Float64, corners), 2, :))
        @test measure(rectangle) ≈ 2
    end
end

vectors(result::Vector) = Any[result]
vectors(result::Matrix) = []
vectors(rows::CompressedRows) = Any[rows.offsets, rows.entries]
vectors(result::NamedTuple) = reduce(vcat, vectors.(values(result)))

matrices(result) = []
matrices(result::Matrix) = Any[result]
matrices(result::NamedTuple) = reduce(vcat, matrices.(values(result)))

same(arrays, others) = length(arrays) == length(others) && all(arrays .=== others)

allocated_by(get!, placement, result) = @allocated get!(placement, result)

# Getters, each with the function that fills an earlier result.
const IN_PLANE = [(nodes, nodes!), (ghosts, ghosts!), (adjacency, adjacency!), (stars, stars!),
                  (triangles, triangles!)]
const IN_SPACE = [(nodes, nodes!), (adjacency, adjacency!), (tetrahedra, tetrahedra!)]

started(domain, d) = initialise!(set_spacing!(Placement(domain), d))

@testset "results in arrays of earlier ones" begin
    Context() do context
        placement = started(square_domain(context), 0.05)
        earlier = [get(placement) for (get, _) in IN_PLANE]
        n = node_count(placement)
        step!(placement)
        @test node_count(placement) == n && nodes(placement).points != earlier[1].points
        for ((get, get!), result) in zip(IN_PLANE, earlier)
            again = get!(placement, result)
            @test again == get(placement)
            @test same(vectors(again), vectors(result)) && same(matrices(again), matrices(result))
            @test allocated_by(get!, placement, result) < 2000
        end
    end
end

@testset "results in arrays for more and for fewer" begin
    Context() do context
        box = add_box!(Domain(context; dim = 3), (0, 0, 0), (1, 1, 1))
        for (domain, getters) in ((square_domain(context), IN_PLANE), (box, IN_SPACE))
            few, many = started(domain, 0.3), started(domain, 0.2)
            for (get, get!) in getters, (one, other) in ((few, many), (many, few))
                result = get(one)
                again = get!(other, result)
                @test again == get(other)
                @test same(vectors(again), vectors(result))
            end
        end
    end
end
