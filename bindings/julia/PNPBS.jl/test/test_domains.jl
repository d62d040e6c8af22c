# SPDX-License-Identifier: BSD-3-Clause

@testset "domains" begin
    Context() do context
        # The domain is a plate with a round hole, an elliptic hole by a callback, and an inner
        # line.
        plate = Domain(context)
        add_polyline!(plate, [0 4 4 0; 0 0 2 2]; tags = [1, 2, 3, 4])
        add_arc!(plate, (1, 1), 0.5; tag = 5)
        add_curve!(plate, 0, 2pi; tag = 6) do t
            [3 .+ 0.5 .* cos.(t) 1 .+ 0.25 .* sin.(t)]'
        end
        add_polyline!(plate, [2 2; 0.5 1.5]; role = :inner, closed = false, tags = 7)
        add_fixed_nodes!(plate, reshape([0.2, 1.5], 2, 1); tags = 8)
        @test check_domain(plate) === nothing
        @test bounds(plate) == ([0, 0], [4, 2])
        @test measure(plate) ≈ 8 - pi / 4 - pi / 8 rtol = 1e-3

        placement = Placement(plate; steps = 20)
        set_spacing!(placement, 0.1)
        run!(placement)
        placed = nodes(placement)
        @test Set(placed.tags) == Set(0:8)
        @test placed.points[:, findfirst(==(8), placed.tags)] == [0.2, 1.5]
        on_ellipse = placed.points[:, placed.tags .== 6]
        u, v = (on_ellipse[1, :] .- 3) ./ 0.5, (on_ellipse[2, :] .- 1) ./ 0.25
        @test all(hypot.(u, v) .≈ 1)

        shown = outline(plate)
        @test size(shown.segments)[1:2] == (2, 2) && size(shown.segments, 3) == length(shown.tags)
        @test Set(shown.tags) == Set(1:7)
    end
end

# The start of a curve does not follow from its shape, so an open curve tests it. All arguments have
# different values.
@testset "open curves" begin
    Context() do context
        domain = add_polyline!(Domain(context), [0 2 2 0; 0 0 1 1])
        add_arc!(domain, (1, 0.25), 0.5; from = pi / 4, to = 3pi / 4, role = :inner, tag = 2)
        add_curve!(t -> [1.5cos.(t) 0.75sin.(t)]', domain, 0.1, 0.7; role = :inner, tag = 3)
        # The corner angle decides which vertices are corners and thus nodes.
        add_polyline!(domain, [0.1 0.15 0.2; 0.5 0.51 0.5]; role = :inner, closed = false,
                      tags = [4, 5], corner_angle = 20.0)
        segments, tags = outline(domain)
        first_of(tag) = segments[:, 1, findfirst(==(tag), tags)]
        @test first_of(2) ≈ [1 + sqrt(0.125), 0.25 + sqrt(0.125)]
        @test first_of(3) ≈ [1.5cos(0.1), 0.75sin(0.1)]
        @test Set(tags) == Set(1:5)
    end
end

# The graph has more vertices than segments, and vertices and segments have different tags.
@testset "tags of graphs" begin
    Context() do context
        graph = add_pslg!(Domain(context), [0 2 2 0 1; 0 0 1 1 0.5], [1 2 3 4; 2 3 4 1];
                          vertex_tags = 11:15, segment_tags = 21:24)
        @test Set(outline(graph).tags) == Set(21:24)
        placement = initialise!(set_spacing!(Placement(graph), 0.1))
        @test issubset(11:24, [nodes(placement).tags; 16:20])
    end
end

@testset "graphs finer than d" begin
    Context() do context
        # The domain is a circle of 400 segments with one of four segments inside.
        turn = 2pi .* (0:399) ./ 400
        xy = hcat([cos.(turn) sin.(turn)]', [0.1 0 -0.1 0; 0 0.1 0 -0.1])
        ends = [1:404 [2:400; 1; 402:404; 401]]'
        graph(angle) = set_corner_angle!(add_pslg!(Domain(context), xy, ends;
                                                   holes = zeros(2, 1)), angle)
        boundary_nodes(domain) = begin
            placement = Placement(domain; steps = 40)
            set_spacing!(placement, 0.2)
            run!(placement)
            count(!=(0), nodes(placement).tags)
        end
        @test boundary_nodes(graph(0)) == 404
        @test 33 <= boundary_nodes(graph(30)) <= 40
        domain = graph(30)
        left_out = simplify!(x -> fill(0.2, size(x, 2)), domain; tolerance = 0.05, smallest = 2)
        @test left_out.curves == 1 && 300 < left_out.vertices < 400
        @test measure(domain) ≈ pi atol = 0.1
        @test simplify!(0.2, graph(0); tolerance = 0) == (vertices = 0, curves = 0)
        @test simplify!((x, y) -> 0.2, graph(0); tolerance = 0.05, smallest = 2,
                        per_point = true) == left_out
        mktempdir() do folder
            path = joinpath(folder, "d.csv")
            write(path, "x,y,d\n0,0,0.2\n1,1,0.2\n")
            @test simplify_by_file!(graph(0), path; tolerance = 0.05, smallest = 2) == left_out
            @test fails(() -> simplify_by_file!(graph(0), path; field = "e"), :error_file, "e")
        end
        @test tag_outline!(x -> x[2, :] .> 0, graph(0), 5) > 10
        @test tag_outline!((x, y) -> y > 9, graph(0), 5; per_point = true) == 0
        @test fails(() -> tag_outline!(x -> x[2, :] .> 0, graph(0), 0), :error_argument, "tag")
        @test_throws DomainError simplify!(x -> throw(DomainError(1)), domain)
        @test fails(() -> simplify!(0.2, domain; tolerance = -1), :error_argument, "tolerance")
        @test fails(() -> set_corner_angle!(domain, 200), :error_argument, "corner_angle")
        @test fails(() -> set_snap!(domain, -1), :error_argument, "length")
        # A fixed node beside the circle becomes one of its boundary nodes.
        near = set_snap!(add_fixed_nodes!(graph(0), reshape([0.99, 0.0], 2, 1)), 0.02)
        @test boundary_nodes(near) == 404
    end
end

@testset "offsets of bodies" begin
    Context() do context
        body = square_domain(context)
        offset(low, high) = add_offset!(Domain(context), body, low, high)
        offset(d, low, high; options...) =
            add_offset!(d, Domain(context), body, low, high; options...)
        inset = offset(0.1, -Inf, -0.42; tag = 7)
        @test measure(inset) ≈ (1 - 2 * 0.042)^2 rtol = 0 atol = 1e-9
        @test Set(outline(inset).tags) == Set(7)
        @test measure(offset(-Inf, -0.042)) ≈ measure(inset) rtol = 0 atol = 1e-9
        # A smaller resolution results in more points around the outer corners.
        finer(resolution) = length(outline(offset(0.1, 0, 0.42; resolution = resolution)).tags)
        @test finer(0.01) > 2 * finer(0.05)
        # The inset lies between four straight lines.
        left, right = 0.042 / 0.979, 0.958 / 1.021
        area = 0.916(right - left) - 0.021(right^2 - left^2)
        graded_inset = offset(x -> 0.1 .+ 0.05 .* x[1, :], -Inf, -0.42)
        @test measure(graded_inset) ≈ area rtol = 0 atol = 1e-9
        @test measure(offset((x, y) -> 0.1 + 0.05x, -Inf, -0.42; per_point = true)) ==
              measure(graded_inset)

        @test fails(() -> offset(0.1, -Inf, -0.42; tag = 0), :error_argument, "tag")
        @test fails(() -> offset(-Inf, -0.6), :error_domain)
        @test fails(() -> offset(0.0, -Inf, -0.42), :error_spacing)
        @test fails(() -> add_offset!(Domain(context; dim = 3), body, -Inf, -0.1), :error_argument,
                    "body")
        @test_throws DomainError offset(x -> throw(DomainError(1)), -Inf, -0.42)
    end
end

@testset "graphs and .poly" begin
    Context() do context
        # The domain is a square with a square hole. The graph's indices count from 1.
        xy = [0 3 3 0 1 2 2 1; 0 0 3 3 1 1 2 2]
        ends = [1 2 3 4 5 6 7 8; 2 3 4 1 6 7 8 5]
        graph = add_pslg!(Domain(context), xy, ends; holes = reshape([1.5, 1.5], 2, 1),
                          segment_tags = [1, 1, 1, 1, 2, 2, 2, 2])
        @test measure(graph) ≈ 8
        @test fails(() -> add_pslg!(Domain(context), xy, ends .+ 1), :error_argument, "8")

        text = "4 2 0 0\n1 0 0\n2 2 0\n3 2 1\n4 0 1\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n"
        @test measure(parse_poly!(Domain(context), text)) ≈ 2
        path, io = mktemp()
        write(io, text)
        close(io)
        @test measure(read_poly!(Domain(context), path)) ≈ 2
        @test fails(() -> read_poly!(Domain(context), "/none.poly"), :error_file, "/none.poly")
        @test fails(() -> parse_poly!(Domain(context), "4 2 x"; name = "mine"), :error_file, "mine")

        # A hole point removes the region inside the inner curve.
        ring = add_polyline!(Domain(context), [0 3 3 0; 0 0 3 3])
        add_polyline!(ring, [1 2 2 1; 1 1 2 2]; role = :inner)
        add_hole!(ring, [1.5, 1.5])
        @test measure(ring) ≈ 8
    end
end

@testset "wrong domains" begin
    Context() do context
        domain = Domain(context)
        @test fails(() -> Domain(context; dim = 4), :error_argument, "dim")
        @test fails(() -> add_arc!(domain, (0, 0), -1), :error_argument, "radius", "-1")
        @test_throws DimensionMismatch add_polyline!(domain, [0 0; 1 0; 1 1])
        @test_throws DimensionMismatch add_polyline!(domain, [0 1 1; 0 0 1]; tags = [1, 2])
        @test_throws DimensionMismatch add_arc!(domain, (0, 0, 0), 1)
        @test_throws ArgumentError add_arc!(domain, (0, 0), 1; role = :outer)
        add_polyline!(domain, [0 1 0 1; 0 1 1 0])
        @test fails(() -> check_domain(domain), :error_domain)
    end
end
