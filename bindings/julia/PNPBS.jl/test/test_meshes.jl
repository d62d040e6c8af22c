# SPDX-License-Identifier: BSD-3-Clause
# Tests of distributed meshes on one rank.
include("mesh_checks.jl")

placed_with(domain, d) = (p = set_spacing!(Placement(domain; steps = 20), d); run!(p); p)

@testset "a distributed mesh in the plane" begin
    Context() do context
        domain = add_polyline!(square_domain(context), [0.3 0.7; 0.4 0.6]; role = :inner,
                               closed = false, tags = 7)
        placement = placed_with(domain, 0.1)
        mesh = DistributedMesh(placement)
        check_mesh(mesh, 0)
        @test size(mesh.elements, 1) == 3 && sum(measures(mesh)) ≈ 1
        @test mesh.owned_nodes == mesh.all_nodes == node_count(placement)
        @test mesh.owned_elements == mesh.all_elements == size(triangles(placement), 2)
        @test mesh.first_node == mesh.first_element == 0
        placed = nodes(placement)
        at = [findfirst(==(id), placed.ids) for id in mesh.ids]
        @test mesh.coordinates == placed.points[:, at] && mesh.tags == placed.tags[at]

        edges, tags = boundary_edges(placement)
        pairs(ids, edges, tags) = Set(zip(eachcol(ids[edges]), tags))
        @test pairs(mesh.ids, mesh.facets, mesh.facet_tags) == pairs(placed.ids, edges, tags)
        @test mesh.facet_inner == (mesh.facet_tags .== 7) && any(mesh.facet_inner)
        @test (mesh.facet_elements[2, :] .> 0) == mesh.facet_inner
        @test isempty(mesh.shared_nodes) && isempty(mesh.sharing_ranks)
        @test all(mesh.element_tags .== 0) && all(mesh.facet_owners .== 0)

        # The mesh needs no closing, and one rank has no ghosts.
        @test length(context.children) == 2
        more = DistributedMesh(placement; ghost_layers = 16)
        @test more.elements == mesh.elements && more.ids == mesh.ids
        @test occursin("$(mesh.all_nodes) nodes", string(mesh))

        mktempdir() do folder
            @test write_mesh(placement, joinpath(folder, "mesh")) === placement
            @test readdir(folder) == ["mesh_1.msh"]
            lines = readlines(joinpath(folder, "mesh_1.msh"))
            sizes = parse.(Int, split(lines[findfirst(==("\$Elements"), lines) + 1]))
            @test sizes[2:4] == [size(mesh.elements, 2) + size(mesh.facets, 2), 1, sizes[2]]
            @test fails(() -> write_mesh(placement, ""), :error_argument, "prefix is empty")
            @test fails(() -> write_mesh(placement, joinpath(folder, "none", "mesh")), :error_file,
                        "mesh_1.msh")
        end
    end
end

@testset "regions with tags" begin
    Context() do context
        domain = add_polyline!(square_domain(context), [0.5 0.5; 0 1]; role = :inner,
                               closed = false)
        @test add_region!(add_region!(domain, (0.2, 0.5), 3), [0.8, 0.5], 7) === domain
        placement = placed_with(domain, 0.1)
        x, corners, tags = nodes(placement).points, triangles(placement), element_tags(placement)
        mesh = DistributedMesh(placement)
        of_placement = [measure_of((x[:, k] - x[:, c[1]] for k in c[2:3])...)
                        for c in eachcol(corners)]
        for (areas, tags, left) in
            ((of_placement, tags, [sum(x[1, c]) < 1.5 for c in eachcol(corners)]),
             (measures(mesh), mesh.element_tags,
              [sum(mesh.coordinates[1, c]) < 1.5 for c in eachcol(mesh.elements)]))
            @test tags isa Vector{Int32} && tags == ifelse.(left, 3, 7)
            @test all(isapprox(sum(areas[tags .== tag]), 0.5; atol = 1e-12) for tag in (3, 7))
        end

        @test fails(() -> add_region!(domain, (0.2, 0.5), 0), :error_argument, "tag")
        @test_throws DimensionMismatch add_region!(domain, (0.2, 0.5, 0), 3)
        add_region!(domain, (0.2, 0.9), 4)
        @test fails(() -> check_domain(domain), :error_domain, "region 2 at (0.2, 0.9)")
    end
end

@testset "cracks" begin
    Context() do context
        domain = add_polyline!(square_domain(context), [0.5 0.5; 0 1]; role = :inner,
                               closed = false, tags = 7)
        placement = placed_with(domain, 0.1)
        @test set_cracks!(placement, [7]) === placement
        x = nodes(placement).points
        n = size(x, 2)
        pairs, facets = crack_nodes(placement), crack_facets(placement)
        @test length(pairs.nodes) == pairs.all == count(==(0.5), x[1, :])
        originals = [1:n; pairs.nodes]
        @test originals[cracked_elements(placement)] == triangles(placement)
        @test originals[facets.front] == originals[facets.back]
        @test all(facets.front .<= n) && all(facets.back .> n) && all(facets.tags .== 7)
        @test fails(() -> crack_nodes(set_cracks!(placement, [99])), :error_argument, "tag 99")
        @test cracked_elements(set_cracks!(placement, [])) == triangles(placement)
    end
end

@testset "a distributed mesh in space" begin
    Context() do context
        box = add_box!(Domain(context; dim = 3), (0, 0, 0), (2, 1, 1); tag = 5)
        add_surface!(box, [1 1 1 1; 0.2 0.8 0.8 0.2; 0.2 0.2 0.8 0.8], [1 1; 2 3; 3 4];
                     role = :inner, tags = 6)
        placement = placed_with(add_region!(box, (0.1, 0.1, 0.1), 4), 0.25)
        mesh = DistributedMesh(placement)
        check_mesh(mesh, 0)
        @test all(mesh.element_tags .== 4)
        @test element_tags(placement) == fill(4, size(tetrahedra(placement), 2))
        found = regions(placement)
        @test found.tags == [4] && found.nodes == [mesh.all_nodes]
        @test found.elements == [size(mesh.elements, 2)] && found.measures ≈ [2]
        @test regions_at(box, [0.1 1.9; 0.1 0.9; 0.1 0.9]) == [4 4]
        @test size(mesh.elements, 1) == 4 && sum(measures(mesh)) ≈ 2
        @test mesh.facet_inner == (mesh.facet_tags .== 6) && any(mesh.facet_inner)
        # They are counter-clockwise as seen from outside, so together they enclose the box.
        x = mesh.coordinates
        enclosed(facets) = sum(measure_of((x[:, k] for k in facet)...) for facet in eachcol(facets))
        @test enclosed(mesh.facets[:, mesh.facet_tags .== 5]) ≈ 2
        inner = mesh.facet_elements[:, mesh.facet_inner]
        @test all(inner .> 0) && all(inner[1, :] .!= inner[2, :])
    end
end

@testset "a distributed mesh on surfaces alone" begin
    Context() do context
        box = add_box!(Domain(context; dim = 3), (0, 0, 0), (1, 1, 1); tag = 5)
        placement = placed_with(set_filled!(box, false), 0.3)
        mesh = DistributedMesh(placement)
        check_mesh(mesh, 0)
        @test mesh.dim == 3 && size(mesh.elements, 1) == 3
        @test all(mesh.element_tags .== 5) && size(mesh.facets) == (2, 0)
        @test fails(() -> element_tags(placement), :error_argument, "surfaces alone")
        close(placement)
        @test size(mesh.coordinates) == (3, mesh.all_nodes)
    end
end

@testset "what is no distributed mesh" begin
    Context() do context
        placement = Placement(square_domain(context))
        @test fails(() -> DistributedMesh(placement), :error_state, "no nodes")
        initialise!(set_spacing!(placement, 0.3))
        @test fails(() -> DistributedMesh(placement; ghost_layers = -1), :error_argument,
                    "ghost_layers = -1", "0 .. 16")
        @test fails(() -> DistributedMesh(placement; ghost_layers = 17), :error_argument, "17")
        close(placement)
        @test fails(() -> DistributedMesh(placement), :error_handle, "Placement")
    end
end
