# SPDX-License-Identifier: BSD-3-Clause
# Tests of domains in space and placements in them.

cross3(u, v) = [u[2] * v[3] - u[3] * v[2], u[3] * v[1] - u[1] * v[3], u[1] * v[2] - u[2] * v[1]]
determinant(u, v, w) = sum(cross3(u, v) .* w)

function tetrahedron_volume(points, corners)
    (a, b, c, d) = (points[:, k] for k in corners)
    return determinant(b - a, c - a, d - a) / 6
end

# Returns the volume inside triangles that are counter-clockwise as seen from outside.
enclosed(points, triangles) =
    sum(determinant((points[:, k] for k in triangles[:, t])...) for t in 1:size(triangles, 2)) / 6

# Returns the directed sides of triangles.
sides(triangles) = [(corners[k], corners[mod1(k + 1, 3)])
                    for corners in eachcol(triangles) for k in 1:3]

# Returns whether every side occurs once in each direction.
function fit_together(triangles)
    all_sides = sides(triangles)
    return allunique(all_sides) && Set(all_sides) == Set(reverse.(all_sides))
end

# A tetrahedron with a volume of 1/6.
const VERTICES = [0 1 0 0
                  0 0 1 0
                  0 0 0 1]
const FACES = [1 1 1 2
               3 2 4 3
               2 4 3 4]

placed_in(domain, spacing) =
    (placement = set_spacing!(Placement(domain; steps = 40), spacing); run!(placement); placement)

@testset "shapes in space" begin
    Context() do context
        domain = Domain(context; dim = 3)
        @test sprint(show, domain) == "PNPBS.Domain(3D)"
        @test ndims(domain) == 3 && ndims(Domain(context)) == 2
        @test add_box!(domain, (-1, 0, 2), (1, 3, 6); tag = 7) === domain
        @test measure(domain) == 24
        @test bounds(domain) == ([-1, 0, 2], [1, 3, 6])
        add_ball!(domain, [0, 1.5, 4], 0.5)
        @test measure(domain) ≈ 24 - pi / 6 rtol = 1e-4
        # Inner bodies divide the box, which has the tag of two of them.
        add_box!(domain, (-0.9, 0.1, 2.1), (-0.6, 0.9, 3); role = :inner, tag = 7)
        add_ball!(domain, (0, 0.5, 5.5), 0.3; role = :inner, tag = 7)
        add_cylinder!(domain, (0, 2.5, 2.5), (0, 2.5, 5), 0.3; role = :inner)
        @test measure(domain) ≈ 24 - pi / 6 rtol = 1e-4
        add_region!(domain, (-0.7, 0.2, 2.2), 3)
        add_region!(domain, (0, 0.5, 5.5), 4)
        add_region!(domain, (0, 2.5, 3), 5)
        @test regions_at(domain, [-0.7 0 0.2 -0.7; 0.8 0.5 2.5 0.8; 2.9 5.3 4.9 3.1]) == [3 4 5 0]
        @test_throws ArgumentError add_ball!(domain, (0, 0, 0), 1; role = :outer)
        rod = add_cylinder!(Domain(context; dim = 3), (0, 0, 1), (0, 0, 4), 0.5; tag = 2)
        @test measure(rod) ≈ 0.75pi rtol = 1e-3
        add_fixed_nodes!(rod, [0 0 2]'; tags = 9)
        add_polyline!(rod, [0.1 0.1; 0 0; 2 3]; role = :inner, closed = false, tags = 8)
        @test check_domain(rod) === nothing
        placed = nodes(placed_in(rod, 0.25))
        @test placed.points[:, findfirst(==(9), placed.tags)] == [0, 0, 2]
        on_line = placed.points[:, placed.tags .== 8]
        @test size(on_line, 2) > 3 && all(on_line[1, :] .≈ 0.1) && all(2 .<= on_line[3, :] .<= 3)
    end
end

@testset "surfaces" begin
    Context() do context
        body = add_surface!(Domain(context; dim = 3), VERTICES, FACES; tags = 1:4,
                            feature_angle = 30)
        @test measure(body) ≈ 1 / 6
        # Inside it is a smaller tetrahedron, whose inside a hole point removes.
        add_surface!(body, 0.25 .* VERTICES .+ 0.1, FACES; role = :inner)
        @test measure(body) ≈ 1 / 6
        @test measure(set_filled!(body, false)) ≈ (1 + 0.25^2) * (1.5 + sqrt(0.75))
        set_filled!(body, true)
        broken = add_surface!(Domain(context; dim = 3), VERTICES, FACES)
        @test measure(set_repair!(broken, 0.02)) ≈ 1 / 6
        @test measure(set_resurfaced!(broken, 0.02)) ≈ 1 / 6 atol = 1e-3
        # Two tetrahedra overlap in one with half of their edges.
        both = add_surface!(Domain(context; dim = 3), VERTICES, FACES)
        add_surface!(both, VERTICES .+ [0.5, 0, 0], FACES)
        @test fails(() -> measure(both), :error_domain, "set_fragment")
        @test measure(set_fragment!(both, :own)) ≈ (2 - 0.125) / 6
        @test_throws ArgumentError set_fragment!(both, :all)
        # A tetrahedron is a cavity of a layer; half of it lies beyond a periodic side.
        layer = add_surface!(Domain(context; dim = 3), VERTICES, FACES)
        set_periodic!(layer, (0.5, 0, -1), (2.5, 2, 2), (true, true, false); tags = 1:6)
        @test measure(layer) ≈ 12 - 1 / 6
        @test_throws DimensionMismatch set_periodic!(layer, (0, 0, 0), (1, 1, 1), (true, false))
        add_hole!(body, (0.15, 0.15, 0.15))
        @test measure(body) ≈ (1 - 0.25^3) / 6
        mktempdir() do folder
            path = joinpath(folder, "body.off")
            lines(columns) = join((join(column, " ") for column in eachcol(columns)), "\n")
            write(path, "OFF\n4 4 0\n", lines(VERTICES), "\n", lines([3 3 3 3; FACES .- 1]), "\n")
            @test measure(read_surface!(Domain(context; dim = 3), path)) ≈ 1 / 6
        end
        @test fails(() -> read_surface!(body, "/none.stl"; role = :inner), :error_file, "/none.stl")
        # A mesh of Gmsh with a named side. The tag identifies the sides of an inner surface.
        mktempdir() do folder
            path = joinpath(folder, "body.msh")
            row(columns) = join(columns, " ")
            write(path, "\$MeshFormat\n2.2 0 8\n\$EndMeshFormat\n\$PhysicalNames\n1\n2 3 \"inlet\"\n",
                  "\$EndPhysicalNames\n\$Nodes\n4\n",
                  [row((i, VERTICES[:, i]...)) * "\n" for i in 1:4]...,
                  "\$EndNodes\n\$Elements\n4\n",
                  [row((i, 2, 2, i, i, FACES[:, i]...)) * "\n" for i in 1:4]...,
                  "\$EndElements\n")
            @test file_dimension(path) == 3
            named = read_msh!(Domain(context; dim = 3), path)
            @test measure(named) ≈ 1 / 6
            set_tag_name!(named, 2, 4, "outlet")
            @test tag_names(named) == [(dim = 2, tag = 3, name = "inlet"),
                                       (dim = 2, tag = 4, name = "outlet")]
            add_surface!(named, 0.25 .* VERTICES .+ 0.1, FACES; tags = fill(9, 4))
            @test measure(named) ≈ (1 - 0.25^3) / 6
            @test measure(set_role!(named, 9, :inner)) ≈ 1 / 6
        end
        @test fails(() -> set_role!(body, 0, :inner), :error_argument, "tag")
        @test fails(() -> read_msh!(body, "/none.msh"), :error_file, "/none.msh")
        # Every face has a tag of its own.
        placement = placed_in(add_surface!(Domain(context; dim = 3), VERTICES, FACES; tags = 1:4),
                              0.3)
        points = nodes(placement).points
        corners, tags = boundary_triangles(placement)
        heights = [points[3, :], points[2, :], points[1, :], 1 .- vec(sum(points, dims = 1))]
        @test Set(tags) == Set(1:4)
        @test all(maximum(abs, heights[tags[t]][corners[:, t]]) < 1e-12 for t in eachindex(tags))
    end
end

@testset "results in space" begin
    Context() do context
        domain = Domain(context; dim = 3)
        add_box!(domain, (0, 0, 0), (1, 1, 1); tag = 5)
        placement = placed_in(domain, 0.25)
        @test ndims(placement) == 3 && check_results(placement) === :ok
        n, placed = node_count(placement), nodes(placement)
        @test size(placed.points) == (3, n) && all(0 .<= placed.points .<= 1)
        corners = tetrahedra(placement)
        volumes = [tetrahedron_volume(placed.points, corners[:, k]) for k in 1:size(corners, 2)]
        @test size(corners, 1) == 4 && all(volumes .> 0) && sum(volumes) ≈ measure(domain)

        lengths = vec(sum(abs2, normals(placement), dims = 1))
        @test all(lengths .≈ (placed.tags .!= 0))

        around, tags = boundary_triangles(placement)
        @test fit_together(around) && enclosed(placed.points, around) ≈ 1
        # By Euler's formula b nodes on a surface without handles have 2b - 4 triangles.
        b = count(==(5), placed.tags)
        @test size(around) == (3, 2b - 4) && tags == fill(5, 2b - 4)
        @test Set(vec(around)) == Set(findall(!=(0), placed.tags))

        neighbours, triangle = stars(placement)
        @test !any(any, triangle)
        joined = [Set{Int}() for _ in 1:n]
        for k in 1:size(corners, 2), i in corners[:, k]
            union!(joined[i], setdiff(corners[:, k], i))
        end
        @test Set.(neighbours) == joined && sum(length, neighbours) == sum(length, joined)
        radius = parse(Float64, only(row.default for row in option_table()
                                     if row.name == "adjacency_radius"))
        distance(i, j) = sqrt(sum(abs2, placed.points[:, i] - placed.points[:, j]))
        @test all(Set(list) == Set(j for j in 1:n if j != i && distance(i, j) < radius * 0.25)
                  for (i, list) in enumerate(adjacency(placement)))
        @test ghosts(placement).points == zeros(3, 0)
        @test statistic(placement, "nodes") == n && 0.8 < statistic(placement, "quality.mean") < 1
    end
end

@testset "around a ball" begin
    Context() do context
        domain = Domain(context; dim = 3)
        add_box!(domain, (-1, -1, -1), (1, 1, 1); tag = 3)
        add_ball!(domain, (0, 0, 0), 0.5; tag = 4)
        placement = placed_in(domain, 0.25)
        points, corners = nodes(placement).points, tetrahedra(placement)
        filled = sum(tetrahedron_volume(points, corners[:, k]) for k in 1:size(corners, 2))
        around, tags = boundary_triangles(placement)
        @test fit_together(around) && enclosed(points, around) ≈ filled
        # Chords make the cavity smaller, so the elements fill more than the domain.
        @test measure(domain) < filled < 1.02measure(domain)
        inward = around[:, tags .== 4]
        radii = sqrt.(sum(abs2, points[:, vec(inward)], dims = 1))
        @test all(abs.(radii .- 0.5) .< 1e-4) && -0.53 < enclosed(points, inward) < -0.4
        @test Set(tags) == Set([3, 4]) && fit_together(inward)
    end
end

@testset "level sets" begin
    Context() do context
        domain = Domain(context; dim = 3)
        add_level_set!(domain, (-1, -1, -1), (1, 1, 1), 0.1; tag = 6) do x
            vec(sum(abs2, x, dims = 1)) .- 0.25
        end
        @test measure(domain) ≈ pi / 6 rtol = 0.03
        placed = nodes(placed_in(domain, 0.15))
        on_surface = placed.points[:, placed.tags .== 6]
        @test size(on_surface, 2) > 50
        @test all(abs.(sum(abs2, on_surface, dims = 1) .- 0.25) .< 1e-12)
        @test_throws ErrorException("no body") add_level_set!(x -> error("no body"), domain,
                                                              (-1, -1, -1), (1, 1, 1), 0.1)
        @test_throws DimensionMismatch add_level_set!(x -> x, domain, (-1, -1, -1), (1, 1, 1), 0.1)
        @test fails(() -> add_level_set!(x -> x[1, :], domain, (-1, -1, -1), (1, 1, 1), -7),
                    :error_argument, "resolution", "-7")
    end
end

# The functions stay alive after the domains are closed and collected.
@testset "offsets in space" begin
    Context() do context
        box = add_box!(Domain(context; dim = 3), (0, 0, 0), (1, 1, 1))
        calls = Ref(0)
        inset = Domain(context; dim = 3)
        add_offset!(inset, box, -Inf, -0.46; tag = 6) do x
            calls[] += 1
            fill(0.25, size(x, 2))
        end
        @test measure(inset) ≈ 0.77^3 rtol = 1e-3
        placement = set_spacing!(Placement(inset; steps = 20), 0.25 * 1.147)
        close(inset)
        close(box)
        GC.gc()
        before = calls[]
        @test run!(placement) in (:ok, :not_converged, :spacing_missed)
        @test calls[] > before
        placed = nodes(placement)
        on_surface = placed.points[:, placed.tags .== 6]
        @test maximum(abs.(maximum(abs.(on_surface .- 0.5); dims = 1) .- 0.385)) < 1e-12
    end
end

@testset "spacings in space" begin
    Context() do context
        domain = add_box!(Domain(context; dim = 3), (0, 0, 0), (1, 1, 1))
        placement = Placement(domain; steps = 40)
        set_spacing!(x -> 0.15 .+ 0.2 .* x[3, :], placement)
        run!(placement)
        placed = nodes(placement)
        @test placed.spacing ≈ 0.15 .+ 0.2 .* placed.points[3, :]
        low_half = count(placed.points[3, :] .< 0.5)
        @test low_half > 2 * (node_count(placement) - low_half)

        # The spacing is linear in the tetrahedra, so a linear spacing is preserved.
        set_spacing!(placement, 0.2 .+ 0.1 .* placed.points[1, :])
        run!(placement)
        placed = nodes(placement)
        @test placed.spacing ≈ 0.2 .+ 0.1 .* placed.points[1, :]
        @test fails(() -> set_spacing!(placement, [0.1, 0.2]), :error_argument, "2")

        # The first index of a grid goes along x.
        values = [0.2 + 0.1 * i + 0.05 * k for i in 0:1, j in 0:0, k in 0:2]
        set_spacing!(placement, values; origin = (0, 0, 0), step = (1, 1, 0.5))
        run!(placement)
        placed = nodes(placement)
        @test placed.spacing ≈ 0.2 .+ 0.1 .* placed.points[1, :] .+ 0.1 .* placed.points[3, :]

        given = initialise!(set_nodes!(placement, [0.3 0.6; 0.4 0.5; 0.5 0.6]; ids = [70, 90]))
        there = nodes(given)
        @test there.points[:, findfirst(==(90), there.ids)] == [0.6, 0.5, 0.6]
    end
end

@testset "the plane and space" begin
    Context() do context
        body = add_box!(Domain(context; dim = 3), (0, 0, 0), (1, 1, 1))
        @test fails(() -> add_polyline!(body, [0 1 1; 0 0 1; 0 0 0]), :error_argument, "role")
        @test fails(() -> add_arc!(body, (0, 0), 1), :error_argument, "in the plane")
        @test fails(() -> add_curve!(t -> [t t]', body, 0, 1), :error_argument, "in the plane")
        @test fails(() -> add_pslg!(body, [0 1; 0 0], reshape([1, 2], 2, 1)), :error_argument,
                    "in the plane")
        @test fails(() -> parse_poly!(body, "0 2 0 0\n"), :error_argument, "in the plane")
        @test fails(() -> outline(body), :error_argument, "in the plane")
        @test_throws DimensionMismatch add_polyline!(body, [0 1; 0 0]; role = :inner)
        @test_throws DimensionMismatch add_hole!(body, (0, 0))
        @test_throws DimensionMismatch add_fixed_nodes!(body, [0 1; 0 0])
        @test_throws DimensionMismatch add_surface!(body, VERTICES[1:2, :], FACES)
        @test_throws DimensionMismatch add_surface!(body, VERTICES, FACES[1:2, :])
        @test_throws DimensionMismatch add_surface!(body, VERTICES, FACES; tags = [1, 2])
        @test_throws DimensionMismatch add_box!(body, (0, 0), (1, 1))
        @test_throws DimensionMismatch add_cylinder!(body, (0, 0, 0), (1, 1), 1)
        @test fails(() -> add_surface!(body, VERTICES, FACES .+ 1), :error_argument, "corners")
        @test fails(() -> add_ball!(body, (0, 0, 0), -1), :error_argument, "radius", "-1")
        placement = placed_in(body, 0.5)
        @test fails(() -> triangles(placement), :error_argument, "3 dimensions")
        @test fails(() -> boundary_edges(placement), :error_argument, "3 dimensions")
        @test_throws DimensionMismatch set_nodes!(placement, [0.5 0.5]')
        @test_throws DimensionMismatch set_spacing!(placement, ones(1, 1); origin = (0, 0),
                                                    step = (1, 1))
        @test_throws DimensionMismatch set_spacing!(placement, ones(1, 1, 1); origin = (0, 0),
                                                    step = (1, 1, 1))

        square = square_domain(context)
        @test fails(() -> add_box!(square, (0, 0, 0), (1, 1, 1)), :error_argument, "in space")
        @test fails(() -> add_ball!(square, (0, 0, 0), 1), :error_argument, "in space")
        @test fails(() -> add_cylinder!(square, (0, 0, 0), (1, 1, 1), 1), :error_argument,
                    "in space")
        @test fails(() -> add_surface!(square, VERTICES, FACES), :error_argument, "in space")
        @test fails(() -> read_surface!(square, "any.stl"), :error_argument, "in space")
        placement = placed_in(square, 0.2)
        @test ndims(placement) == 2
        @test fails(() -> tetrahedra(placement), :error_argument, "2 dimensions")
        @test fails(() -> boundary_triangles(placement), :error_argument, "2 dimensions")
        @test_throws DimensionMismatch set_spacing!(placement, ones(1, 1, 1); origin = (0, 0, 0),
                                                    step = (1, 1, 1))
    end
end

@testset "a sphere" begin
    places = [permutedims(-178:2:180); fill(-70, 1, 180)]
    ring = sphere_points(1, places)
    @test size(ring) == (3, 180)
    @test sphere_degrees(2 .* ring) ≈ places rtol = 1e-14
    @test size(sphere_points(1, zeros(2, 0))) == (3, 0)
    @test fails(() -> sphere_points(0, places), :error_argument, "radius is 0")
    @test fails(() -> sphere_points(1, [0 0; 0 91]), :error_argument, "degrees[1][1] = 91")
    @test fails(() -> sphere_degrees(zeros(3, 1)), :error_argument, "coordinates[0]")
    @test thrown(() -> sphere_points(1, ring)) isa DimensionMismatch
    @test thrown(() -> sphere_degrees(places)) isa DimensionMismatch
    Context() do context
        @test fails(() -> sphere_domain(context, 0, (0, 0, -1)), :error_argument, "radius is 0")
        @test fails(() -> sphere_domain(context, 1, (0, 0, 0)), :error_argument, "outside")
        @test thrown(() -> sphere_domain(context, 1, (0, -1))) isa DimensionMismatch
        domain = sphere_domain(context, 1, (0, 0, -1))
        @test ndims(domain) == 3
        @test fails(() -> add_arc!(domain, (0, 0), 0.1), :error_argument, "on a sphere")
        @test thrown(() -> add_polyline!(domain, places)) isa DimensionMismatch
        @test add_polyline!(domain, ring; corner_angle = 30) === domain
        @test measure(domain) ≈ 2pi * (1 + sind(70)) rtol = 1e-4
        @test all(x -> sum(abs2, x) ≈ 1, eachcol(reshape(outline(domain).segments, 3, :)))
        placement = set_spacing!(Placement(domain), 0.1)
        close(domain)
        @test sphere_radius(placement) == 1
        @test run!(placement) === :ok
        points, corners = nodes(placement).points, triangles(placement)
        @test size(points) == (3, node_count(placement))
        @test all(x -> abs(sqrt(sum(abs2, x)) - 1) < 1e-15, eachcol(points))
        # The triangles form positive tetrahedra with the centre.
        @test all(k -> determinant((points[:, c] for c in k)...) > 0, eachcol(corners))
        edges = Set(minmax(ends...) for ends in sides(corners))
        @test size(points, 2) - length(edges) + size(corners, 2) == 1
        on_boundary = boundary_edges(placement)
        @test 3 * size(corners, 2) == 2 * length(edges) - size(on_boundary.edges, 2)
        @test thrown(() -> PNPBS.picture(placement, :triangles)) isa ArgumentError
        @test sum(VoronoiCells(placement).volumes) ≈ 2pi * (1 + sind(70)) rtol = 1e-2
        # The grid has longitudes and latitudes.
        d = [0.12 + 0.02 * latitude for longitude in 1:4, latitude in -1:1]
        set_spacing!(placement, d; origin = (-135, -90), step = (90, 90))
        @test run!(placement) === :ok
        found = nodes(placement)
        @test found.spacing ≈ 0.12 .+ 0.02 .* asin.(found.points[3, :]) ./ (pi / 2) rtol = 1e-12
        set_spacing_mesh!(placement, found.points, found.spacing, triangles(placement))
        @test run!(placement) === :ok
        @test node_count(placement) ≈ size(found.points, 2) rtol = 0.02
        set_spacing_points!(placement, found.points, found.spacing)
        @test run!(placement) === :ok
        @test node_count(placement) ≈ size(found.points, 2) rtol = 0.02
        @test thrown(() -> set_spacing_mesh!(placement, found.points, found.spacing,
                                             ones(Int, 4, 1))) isa DimensionMismatch
        @test thrown(() -> set_spacing!(placement, zeros(1, 1, 1); origin = (0, 0, 0),
                                        step = (1, 1, 1))) isa DimensionMismatch
    end
end

@testset "elements of second order" begin
    Context() do context
        ball = add_ball!(Domain(context; dim = 3), (0, 0, 0), 1.0; tag = 3)
        placement = placed_in(ball, 0.4)
        (points, elements) = (nodes(placement).points, tetrahedra(placement))
        found = edges(placement)
        @test sort(found.numbers) == 0:length(found.numbers)-1
        @test found.straight >= 0
        of_elements = find_edges(placement, elements)
        pairs = ((1, 2), (2, 3), (1, 3), (1, 4), (2, 4), (3, 4))
        @test all(found.ends[:, of_elements[k, t]] == sort(elements[[pairs[k]...], t])
                  for t in 1:size(elements, 2) for k in 1:6)
        around = boundary_triangles(placement)
        outside = unique(find_edges(placement, around.triangles))
        radii = sqrt.(sum(abs2, found.midpoints[:, outside]; dims = 1))
        @test all(r -> isapprox(r, 1; rtol = 2e-4), radii)
        inner = setdiff(1:length(found.numbers), outside)
        middles = (points[:, found.ends[1, inner]] + points[:, found.ends[2, inner]]) / 2
        @test found.midpoints[:, inner] ≈ middles
        mktempdir() do folder
            path = joinpath(folder, "a.msh")
            @test write_file(placement, path; order = 2) === :ok
            @test occursin("\n3 1 11 $(size(elements, 2))\n", read(path, String))
            @test write_files(placement, [path, path * "2"]; elements = true, order = 2) === :ok
        end
    end
end
