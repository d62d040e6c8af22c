# SPDX-License-Identifier: BSD-3-Clause
# Tests of the recipes for Plots.jl, with RecipesBase if it is installed, otherwise with the
# stand-in next to this file. Plots.jl itself is not used.
push!(LOAD_PATH, joinpath(@__DIR__, "stand_in"))
import RecipesBase

# Julia 1.9 and later load the extension automatically if the packages come from a project.
hasmethod(RecipesBase.apply_recipe, Tuple{Dict{Symbol,Any},Domain}) ||
    include("../ext/PNPBSRecipesBaseExt.jl")
pop!(LOAD_PATH)
# Plots.jl defines that options of recipes are not attributes; this definition replaces it.
isempty(methods(RecipesBase.is_key_supported)) &&
    @eval RecipesBase.is_key_supported(key::Symbol) = key !== :edges

series_of(object; attributes...) =
    RecipesBase.apply_recipe(Dict{Symbol,Any}(attributes), object)

# Returns the segments of an interrupted path as pairs of points.
function segments_of(x, y)
    @test length(x) == length(y) && length(x) % 3 == 0
    @test all(isnan, x[3:3:end]) && all(isnan, y[3:3:end])
    ends = collect(zip(x, y))
    return [ends[k:(k + 1)] for k in 1:3:length(ends)]
end

@testset "pictures of placements" begin
    Context() do context
        placement = placed_square(context)
        points = nodes(placement).points
        edges, dots = series_of(placement)
        @test dots.args == (points[1, :], points[2, :])
        @test dots.plotattributes[:seriestype] === :scatter
        @test edges.plotattributes[:seriestype] === :path
        @test edges.plotattributes[:aspect_ratio] === :equal
        drawn(pairs) = Set(Set((points[1, i], points[2, i]) for i in pair) for pair in pairs)
        corners = triangles(placement)
        sides = [corners[[k, mod1(k + 1, 3)], t] for k in 1:3 for t in axes(corners, 2)]
        segments = segments_of(edges.args...)
        @test Set(Set.(segments)) == drawn(sides) && length(segments) == length(drawn(sides))

        edges, = series_of(placement; edges = :adjacency, linecolor = :red)
        lists = adjacency(placement)
        @test Set(Set.(segments_of(edges.args...))) ==
              drawn((i, j) for i in eachindex(lists) for j in lists[i])
        @test edges.plotattributes[:linecolor] === :red
        @test !haskey(edges.plotattributes, :edges)
        edges, = series_of(placement; edges = :none)
        @test isempty(first(edges.args))
        @test_throws ArgumentError series_of(placement; edges = :all)
        @test_throws ArgumentError series_of(Placement(Domain(context; dim = 3)))
    end
end

@testset "pictures of domains" begin
    Context() do context
        outlined, = series_of(square_domain(context))
        @test Set(Set.(segments_of(outlined.args...))) ==
              Set(Set.([[(0, 0), (1, 0)], [(1, 0), (1, 1)], [(1, 1), (0, 1)], [(0, 1), (0, 0)]]))
    end
end
