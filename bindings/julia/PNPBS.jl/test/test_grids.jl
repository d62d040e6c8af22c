# SPDX-License-Identifier: BSD-3-Clause
# Tests of conversions to grids of Ferrite and models of Gridap, if these are installed. Without
# Ferrite the tests use the stand-in next to this file.
include("poisson.jl")

if !("Ferrite" in GRID_PACKAGES)
    println("Ferrite is not installed: its grids are tested with a stand-in, and not solved on")
    push!(LOAD_PATH, joinpath(@__DIR__, "stand_in"))
    import Ferrite
    load_extension("Ferrite")
    pop!(LOAD_PATH)
end
"Gridap" in GRID_PACKAGES || println("Gridap is not installed: its models are not tested")

function mesh_of(domain, d)
    placement = set_spacing!(Placement(domain; steps = 20), d)
    run!(placement)
    return DistributedMesh(placement)
end

function square_with_a_line(context)
    return add_polyline!(add_polyline!(Domain(context), [0 1 1 0; 0 0 1 1]; tags = [3, 4, 4, 4]),
                         [0.3 0.7; 0.4 0.6]; role = :inner, closed = false, tags = 7)
end

# Returns a square of three strips, of which the middle one has no tag.
function square_with_regions(context)
    square = add_polyline!(Domain(context), [0 1 1 0; 0 0 1 1]; tags = [3, 4, 4, 4])
    for (x, tag) in ((0.3, 7), (0.6, 8))
        add_polyline!(square, [x x; 0 1]; role = :inner, closed = false, tags = tag)
    end
    return add_region!(add_region!(square, (0.1, 0.5), 7), (0.9, 0.5), 20)
end

function box_with_a_wall(context)
    box = add_box!(Domain(context; dim = 3), (0, 0, 0), (2, 1, 1); tag = 5)
    return add_surface!(box, [1 1 1 1; 0.2 0.8 0.8 0.2; 0.2 0.2 0.8 0.8], [1 1; 2 3; 3 4];
                        role = :inner, tags = 6)
end

surface_of_a_box(context) =
    set_filled!(add_box!(Domain(context; dim = 3), (0, 0, 0), (1, 1, 1); tag = 5), false)

# Returns a mesh as one rank of several has it, without all nodes.
lacking_a_node(mesh) =
    DistributedMesh(; (name => getfield(mesh, name) for name in fieldnames(typeof(mesh)))...,
                    all_nodes = mesh.all_nodes + 1)

# Returns the node sets of the facets with this tag.
facets_with(mesh, tag) = Set(Set.(eachcol(mesh.facets[:, mesh.facet_tags .== tag])))

function check_grid_of_ferrite(mesh)
    grid = Ferrite.Grid(mesh)
    @test [collect(cell.nodes) for cell in grid.cells] == collect(eachcol(mesh.elements))
    @test [collect(node.x) for node in grid.nodes] == collect(eachcol(mesh.coordinates))
    @test Set(keys(grid.facetsets)) == Set("tag_$tag" for tag in mesh.facet_tags)
    for tag in unique(mesh.facet_tags)
        there = [Set(Ferrite.facets(grid.cells[cell])[facet])
                 for (cell, facet) in grid.facetsets["tag_$tag"]]
        @test allunique(there) && Set(there) == facets_with(mesh, tag)
    end
    return grid
end

@testset "grids of Ferrite" begin
    Context() do context
        mesh = mesh_of(square_with_a_line(context), 0.1)
        @test isempty(check_grid_of_ferrite(mesh).cellsets)
        check_grid_of_ferrite(mesh_of(box_with_a_wall(context), 0.25))
        grid = check_grid_of_ferrite(mesh_of(surface_of_a_box(context), 0.3))
        @test sort(collect(grid.cellsets["tag_5"])) == eachindex(grid.cells)
        @test length(grid.cellsets) == 1
        # Regions and curves may have the same tag.
        mesh_of_regions = mesh_of(square_with_regions(context), 0.1)
        grid = check_grid_of_ferrite(mesh_of_regions)
        @test Set(keys(grid.cellsets)) == Set(["tag_7", "tag_20"])
        x = mesh_of_regions.coordinates[1, :]
        within(low, high) = [k for (k, cell) in enumerate(grid.cells)
                             if 3low < sum(x[collect(cell.nodes)]) < 3high]
        @test sort(collect(grid.cellsets["tag_7"])) == within(0, 0.3)
        @test sort(collect(grid.cellsets["tag_20"])) == within(0.6, 1)
        e = thrown(() -> Ferrite.Grid(lacking_a_node(mesh)))
        @test e isa ArgumentError && occursin("Ferrite takes meshes that are on one rank", e.msg)
    end
end

# Returns measures of the facets with each tag, and of all cells.
function measures_in_gridap(model, tags)
    measure(cells) = sum(Gridap.:∫(1.0) * Gridap.Measure(cells, 0))
    on(tag) = measure(Gridap.BoundaryTriangulation(model, tags = tag))
    return [on(tag) for tag in tags], measure(Gridap.Triangulation(model))
end

function check_model_of_gridap(mesh)
    Geometry = Gridap.Geometry
    model = Geometry.UnstructuredDiscreteModel(mesh)
    topology, labels = Geometry.get_grid_topology(model), Geometry.get_face_labeling(model)
    @test [Set(cell) for cell in Geometry.get_cell_node_ids(model)] == Set.(eachcol(mesh.elements))
    @test [collect(Tuple(x)) for x in Geometry.get_node_coordinates(model)] ==
          collect(eachcol(mesh.coordinates))
    with(name, d) = findall(Geometry.get_face_mask(labels, name, d))
    dim = Geometry.num_cell_dims(model)
    vertices = Geometry.get_faces(topology, dim - 1, 0)
    # For surfaces without a volume the tags of elements are those of the surfaces.
    regions = dim == mesh.dim ? setdiff(mesh.element_tags, 0) : Int32[]
    tags = dim == mesh.dim ? unique(mesh.facet_tags) : union(mesh.facet_tags, mesh.element_tags)
    @test labels.tag_to_name == ["interior"; "boundary"; ["tag_$tag" for tag in sort(tags)];
                                 ["region_$tag" for tag in sort(regions)]]
    for tag in regions
        @test with("region_$tag", dim) == findall(==(tag), mesh.element_tags)
        @test Set(with("region_$tag", 0)) == Set(mesh.elements[:, mesh.element_tags .== tag])
    end
    for tag in unique(mesh.facet_tags)
        facets = facets_with(mesh, tag)
        @test Set(Set(vertices[f]) for f in with("tag_$tag", dim - 1)) == facets
        @test Set(with("tag_$tag", 0)) == reduce(union, facets)
    end
    @test Set(with("boundary", 0)) == Set(mesh.facets[:, .!mesh.facet_inner])
    @test sort([with("boundary", 0); with("interior", 0)]) == eachindex(mesh.ids)
    return model
end

"Gridap" in GRID_PACKAGES && @testset "models of Gridap" begin
    Context() do context
        mesh = mesh_of(square_with_a_line(context), 0.1)
        model = check_model_of_gridap(mesh)
        on, all = measures_in_gridap(model, ["tag_3", "tag_4", "tag_7", "boundary"])
        @test on ≈ [1, 3, hypot(0.4, 0.2), 4] && all ≈ 1
        model = check_model_of_gridap(mesh_of(box_with_a_wall(context), 0.25))
        on, all = measures_in_gridap(model, ["tag_5", "tag_6"])
        @test on ≈ [10, 0.36] && all ≈ 2
        # Regions and curves may have the same tag.
        check_model_of_gridap(mesh_of(square_with_regions(context), 0.1))
        model = check_model_of_gridap(mesh_of(surface_of_a_box(context), 0.3))
        @test last(measures_in_gridap(model, [])) ≈ 6
        e = thrown(() -> Gridap.Geometry.UnstructuredDiscreteModel(lacking_a_node(mesh)))
        @test e isa ArgumentError && occursin("Gridap takes meshes that are on one rank", e.msg)
    end
end

# The errors equal those on the plain arrays and those in examples/c/petsc_poisson.
for name in GRID_PACKAGES
    @testset "Poisson's equation in $name" begin
        Context() do context
            both(mesh, p) = ERRORS[name](mesh, p), error_in_arrays(mesh, p)
            plane = before_and_after_adapting(both, square_with_hole(context), 0.03, SQUARE_PEAK)
            space = before_and_after_adapting(both, box_with_hollow(context), 0.1, BOX_PEAK)
            there, here = (map(found -> found[2][k], (plane..., space...)) for k in 1:2)
            @test all(there .≈ here)
            known = (0.00148331, 0.00104073, 0.00459653, 0.00400664)
            @test all(isapprox.(there, known; rtol = 1e-4))
        end
    end
end
