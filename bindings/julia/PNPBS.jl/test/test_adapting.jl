# SPDX-License-Identifier: BSD-3-Clause
# Tests of changes of the spacing on a live placement.

mean(values) = sum(values) / length(values)

# Returns the number of triangles per area that d implies: a triangle with edges d has the area
# sqrt(3)/4 d^2.
wanted_triangles(d) = 1 / (sqrt(3) / 4 * d^2)

@testset "adapting" begin
    Context() do context
        placement = Placement(square_domain(context); steps = 60)
        set_spacing!(placement, 0.08)
        run!(placement)
        @test size(triangles(placement), 2) ≈ wanted_triangles(0.08) rtol = 0.1

        # Values at the current nodes.
        x = nodes(placement).points
        set_spacing!(placement, [0.03 + 0.05 * t for t in x[1, :]])
        run!(placement)
        placed = nodes(placement)
        @test placed.spacing ≈ 0.03 .+ 0.05 .* placed.points[1, :] rtol = 1e-6
        @test count(placed.points[1, :] .< 0.5) > 1.5 * count(placed.points[1, :] .> 0.5)
        @test fails(() -> set_spacing!(placement, [0.1, 0.2]), :error_argument, "2")
        @test fails(() -> set_spacing!(placement, -placed.spacing), :error_spacing, "-0.0")

        # The first index of a grid goes along x.
        values = [0.03 + 0.05 * i for i in 0:1, j in 0:2]
        set_spacing!(placement, values; origin = (0, 0), step = (1, 0.5))
        run!(placement)
        again = nodes(placement)
        @test again.spacing ≈ 0.03 .+ 0.05 .* again.points[1, :]
        @test fails(() -> set_spacing!(placement, values; origin = (0, 0), step = (0, 1)),
                    :error_argument, "step")
        @test_throws DimensionMismatch set_spacing!(placement, values; origin = (0, 0), step = 1)

        # Functions replace each other; earlier ones may be collected.
        for k in 1:3
            set_spacing!(x -> fill(0.05 + 0.02k, size(x, 2)), placement)
            GC.gc()
            run!(placement)
            @test isempty(placement.spacings_before)
            @test mean(nodes(placement).spacing) ≈ 0.05 + 0.02k
        end
    end
end

@testset "nodes from outside" begin
    Context() do context
        placement = placed_square(context)
        placed = nodes(placement)
        inner = placed.tags .== 0
        other = Placement(placement.domain; steps = 40)
        set_spacing!(graded, other)
        set_nodes!(other, placed.points[:, inner]; ids = placed.ids[inner])
        initialise!(other)
        given = nodes(other)
        kept = intersect(given.ids[given.tags .== 0], placed.ids[inner])
        @test length(kept) > 0.9 * count(inner)
        at(set, id) = set.points[:, findfirst(==(id), set.ids)]
        @test all(at(given, id) == at(placed, id) for id in kept)
        @test run!(other) in (:ok, :not_converged)
        @test fails(() -> set_nodes!(other, [0.5 0.5; 0.5 0.6]; ids = [3, 3]), :error_argument, "3")
        @test fails(() -> set_nodes!(other, [0.5 NaN; 0.5 0.6]), :error_argument, "finite")
        @test_throws DimensionMismatch set_nodes!(other, [0.5 0.5; 0.5 0.6]; ids = [1, 2, 3])
        @test_throws DimensionMismatch set_nodes!(other, zeros(3, 1))
    end
end
