# SPDX-License-Identifier: BSD-3-Clause
# Tests of Voronoi cells on one rank.

function check_cells(placement)
    placed, cells = nodes(placement), VoronoiCells(placement)
    n, dim = length(placed.ids), size(placed.points, 1)
    @test size(cells.boundary) == (dim, n) && length(cells.neighbours) == n
    @test sum(cells.volumes) ≈ 1
    faces = cells.neighbours.offsets
    areas = Dict{Tuple{Int64,Int64},Float64}()
    for i in 1:n
        row = faces[i]:(faces[i + 1] - 1)
        @test all(abs.(cells.normals[:, row] * cells.areas[row] .+ cells.boundary[:, i]) .< 1e-13)
        for (f, id) in zip(row, cells.neighbours[i])
            j = findfirst(==(id), placed.ids)
            @test cells.numbers[f] == j - 1
            way = placed.points[:, j] - placed.points[:, i]
            @test cells.distances[f] * cells.normals[:, f] ≈ way
            areas[i, j] = cells.areas[f]
        end
    end
    @test all(areas[j, i] == area for ((i, j), area) in areas)
    @test occursin("$n cells, $(length(areas)) faces", string(cells))
end

@testset "Voronoi cells" begin
    Context() do context
        plate = Placement(square_domain(context); steps = 20)
        @test fails(() -> VoronoiCells(plate), :error_state, "no nodes")
        run!(set_spacing!(plate, 0.15))
        check_cells(plate)
        box = add_box!(Domain(context; dim = 3), (0, 0, 0), (1, 1, 1))
        block = set_spacing!(Placement(box; steps = 20), 0.3)
        run!(block)
        check_cells(block)
        cells = VoronoiCells(block)
        close(block)
        @test sum(cells.volumes) ≈ 1
        @test fails(() -> VoronoiCells(block), :error_handle, "Placement")
    end
end
