# SPDX-License-Identifier: BSD-3-Clause
# Tests of results against values that are recomputed from the points alone.

function pairs_within(points, spacing, radius)
    n = size(points, 2)
    return [[j for j in 1:n if j != i && hypot(points[1, i] - points[1, j],
                                               points[2, i] - points[2, j]) <
                               radius * (spacing[i] + spacing[j]) / 2] for i in 1:n]
end

function doubled_area(points, corners)
    (a, b, c) = (points[:, k] for k in corners)
    return (b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1])
end

@testset "results" begin
    Context() do context
        placement = placed_square(context)
        n = node_count(placement)
        placed = nodes(placement)
        @test size(placed.points) == (2, n)
        @test eltype(placed.points) == Float64 && all(0 .<= placed.points .<= 1)
        @test length(unique(placed.ids)) == n
        @test placed.spacing ≈ graded(placed.points)

        # By Euler's formula, n nodes, b of them on the boundary of a domain without holes, form 2n
        # - b - 2 triangles.
        corners = triangles(placement)
        b = count(!=(0), placed.tags)
        @test size(corners) == (3, 2n - b - 2)
        areas = [doubled_area(placed.points, corners[:, k]) for k in 1:size(corners, 2)]
        @test all(areas .> 0) && sum(areas) / 2 ≈ 1

        edges, tags = boundary_edges(placement)
        @test size(edges) == (2, b) && tags == ones(Int32, b)
        @test sort(edges[1, :]) == sort(edges[2, :]) == findall(!=(0), placed.tags)

        lists = adjacency(placement)
        radius = parse(Float64, only(row.default for row in option_table()
                                     if row.name == "adjacency_radius"))
        @test [sort(list) for list in lists] ==
              pairs_within(placed.points, placed.spacing, radius)
        @test all(issorted(placed.ids[list]) for list in lists)

        around, triangle = stars(placement)
        @test around.offsets === triangle.offsets && length(around) == n
        @test sum(sum, triangle) == 3 * size(corners, 2)
        star_triangles = Set(Set([i, around[i][k], around[i][mod1(k + 1, end)]])
                             for i in 1:n for k in eachindex(around[i]) if triangle[i][k])
        @test star_triangles == Set(Set(corners[:, k]) for k in 1:size(corners, 2))

        # One process has no ghosts.
        @test ghost_count(placement) == 0 && isempty(ghosts(placement).owners)
        @test isempty(exchange_pattern(placement).ranks)
        @test numbering(placement) == (first = 0, count = n, ghosts = Int64[])
    end
end

@testset "statistics" begin
    Context() do context
        placement = placed_square(context)
        @test statistic(placement, "nodes") === Int64(node_count(placement))
        @test statistic(placement, :imbalance) isa Float64
        @test statistic(placement, "hash") isa String
        @test fails(() -> statistic(placement, "nodez"), :error_key, "nodes")
        all_of_them = statistics(placement)
        @test length(all_of_them) == length(statistic_table())
        @test all_of_them["hash"] == statistic(placement, "hash")
        # The same input gives the same nodes.
        @test statistic(placed_square(context), "hash") == all_of_them["hash"]
        @test statistic(placed_square(context; spacing = x -> 0.9 .* graded(x)), "hash") !=
              all_of_them["hash"]

        bands = edge_bands(placement)
        @test length(bands.mean) == length(bands.deviation) == length(bands.edges) > 1
        @test all(bands.d_from .< bands.d_to) && all(bands.edges .> 0)
        @test all(0.7 .< bands.mean .< 1.4)
        cells = cell_bands(placement, :edge_ratio)
        @test cells.d_from[1] == bands.d_from[1] && all(cells.number .> 0)
        @test all(0 .< cells.worst .<= cells.mean .< 1)
        @test minimum(cells.worst) == all_of_them["cell.min_edge_ratio"]
        offsets = cell_bands(placement, "dual_offset")
        @test offsets.d_to == cells.d_to && all(0 .< offsets.mean .< offsets.worst .< 1)
        @test fails(() -> cell_bands(placement, :edge_rato), :error_key, "edge_ratio")
        @test 0.9 < all_of_them["quality.mean"] < 1
        expected = estimate(placement)
        @test abs(expected.nodes / node_count(placement) - 1) < 0.1
        @test expected.bytes > 260 * expected.nodes && expected.seconds > 0

        @test isempty(warnings(placement))
        text = "5 2 0 0\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n5 .5 .5\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n"
        unused = Placement(parse_poly!(Domain(context), text))
        set_spacing!(unused, 0.2)
        initialise!(unused)
        @test length(warnings(unused)) == 1 && occursin("vertex", warnings(unused)[1])
        data = warning_data(unused)[1]
        @test data.code == :unused_vertices && data.count == 1 && data.text == warnings(unused)[1]
        @test isnan(data.value) && isempty(data.point)
    end
end

@testset "spacing from values at given points" begin
    Context() do context
        points = [-1.0 2 2 -1; -1 -1 2 2]
        d = 0.05 .+ 0.02 .* (points[1, :] .+ 1)
        corners = [1 4; 2 3; 3 1]
        mktempdir() do folder
            path = joinpath(folder, "points.csv")
            write(path, "x,y,other,d\n",
                  join(("$(points[1, i]),$(points[2, i]),7,$(d[i])\n" for i in 1:4)))
            for set! in (p -> set_spacing_mesh!(p, points, d, corners),
                         p -> set_spacing_points!(p, points, d),
                         p -> set_spacing_file!(p, path; field = "d"))
                placement = Placement(square_domain(context); steps = 20)
                @test set!(placement) === placement
                run!(placement)
                found = nodes(placement)
                @test found.spacing ≈ 0.07 .+ 0.02 .* found.points[1, :]
            end
            placement = Placement(square_domain(context))
            @test fails(() -> set_spacing_mesh!(placement, points, d, reshape([1, 2, 5], 3, 1)),
                        :error_argument, "4 nodes")
            @test fails(() -> set_spacing_points!(placement, points, -d), :error_spacing, "-0.05")
            @test fails(() -> set_spacing_file!(placement, path), :error_file, "'other', 'd'")
            @test_throws DimensionMismatch set_spacing_points!(placement, points, d[1:3])
            @test_throws DimensionMismatch set_spacing_mesh!(placement, points, d, [1 2; 3 4])
        end
    end
end

@testset "steps and population" begin
    Context() do context
        placement = Placement(square_domain(context); steps = 20)
        @test fails(() -> run!(placement), :error_state, "set_spacing")
        @test fails(() -> check_results(placement), :error_state, "no nodes")
        @test fails(() -> set_spacing!(placement, -0.1), :error_spacing, "-0.1")
        set_spacing!(placement, 0.1)
        @test initialise!(placement) === placement && node_count(placement) > 80
        @test step!(placement, 3) in (:ok, :not_converged)
        @test step!(placement) in (:ok, :not_converged)
        @test fails(() -> step!(placement, -1), :error_argument, "-1")
        before = node_count(placement)
        change = adjust_population!(placement)
        @test node_count(placement) == before + change.inserted - change.deleted
        # One inner node is far too few.
        initialise!(set_nodes!(placement, reshape([0.5, 0.5], 2, 1)))
        before = node_count(placement)
        change = adjust_population!(placement)
        @test change.inserted > change.deleted
        @test node_count(placement) == before + change.inserted - change.deleted
        hash = statistic(placement, "hash")
        rebalance!(placement)
        @test statistic(placement, "hash") == hash
        @test check_results(placement) === :ok
    end
end

@testset "files" begin
    Context() do context
        placement = placed_square(context)
        n = node_count(placement)
        mktempdir() do folder
            path = joinpath(folder, "nodes.csv")
            @test write_file(placement, path) === :ok
            lines = readlines(path)
            @test length(lines) == n + 1 && startswith(lines[1], "id,x,y")
            placed = nodes(placement)
            order = sortperm(placed.ids)
            @test [parse.(Float64, split(line, ",")[2:3]) for line in lines[2:end]] ==
                  [placed.points[:, i] for i in order]
            a, b = joinpath(folder, "a.node"), joinpath(folder, "b.txt")
            @test write_files(placement, [a, b]; formats = [nothing, "csv"],
                              elements = [true, false]) === :ok
            @test read(b) == read(path)
            @test length(readlines(joinpath(folder, "a.ele"))) > size(triangles(placement), 2)
            mesh = joinpath(folder, "a.msh")
            add_output_field(add_output_field(placement, "u", 1:n), "flow", placed.points)
            @test write_file(placement, mesh) === :ok
            rows = readlines(mesh)
            at = findfirst(==("\"flow\""), rows)
            @test sort([parse.(Float64, split(row)) for row in rows[(at + 7):(at + 6 + n)]]) ==
                  [[k; placed.points[:, i]; 0] for (k, i) in enumerate(order)]
            @test fails(() -> add_output_field(placement, "u", 1:n), :error_argument, "\"u\"")
            clear_output_fields(placement)
            @test write_file(placement, mesh) === :ok && !("\"flow\"" in readlines(mesh))
            unknown = joinpath(folder, "x.xyz")
            @test fails(() -> write_file(placement, unknown), :error_argument, "xyz")
            @test fails(() -> write_file(placement, "/none/x.csv"), :error_file, "/none")
            @test_throws DimensionMismatch write_files(placement, [a, b]; formats = ["csv"])
            saved = joinpath(folder, "saved.vtkhdf")
            if occursin("HDF5: none", build_info())
                @test fails(() -> write_checkpoint(placement, saved), :error_unsupported, "HDF5")
            else
                write_checkpoint(placement, saved)
                again = placed_square(context)
                step!(again, 5)
                read_checkpoint!(again, saved)
                @test statistic(again, "hash") == statistic(placement, "hash")
                @test fails(() -> read_checkpoint!(again, path), :error_file, "nodes.csv")
            end
        end
    end
end
