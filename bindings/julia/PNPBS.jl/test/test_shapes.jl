# SPDX-License-Identifier: BSD-3-Clause
# Tests of geographic shapes. The build defines whether their library exists.
const COAST = """{"type": "Feature", "properties": {"name": "shore"}, "geometry":
    {"type": "Polygon", "coordinates": [[[18, 54], [20, 54], [20, 55], [18, 55], [18, 54]]]}}"""
const COAST_CORNERS = [18.0 20 20 18; 54 54 55 55]

function has_shapes()
    folder = PNPBS.LibPNPBS.common_folder(PNPBS.LibPNPBS.library_path())
    return any(startswith("libpnpbs_geo."), readdir(isempty(folder) ? "." : folder))
end

function test_shapes_of(folder)
    path = joinpath(folder, "land.geojson")
    write(path, COAST)
    Context() do context
        shapes = Shapes(path; projection = "EPSG:2180", unit = "km", tag_field = "name")
        @test notes(shapes) == String[]
        @test shape_counts(shapes) == (vertices = 4, boundary = 1, inner = 0, points = 0)
        told = projection(shapes)
        @test told.name == "ETRF2000-PL / CS92 in kilometre" && told.unit == "kilometre"
        @test occursin("+proj=tmerc", told.proj) && occursin("PROJCRS", told.wkt)
        @test 0.999 < told.scale[1] < told.scale[2] < 1
        @test repr(shapes) == "PNPBS.Shapes(ETRF2000-PL / CS92 in kilometre)"

        domain = add_shapes!(Domain(context), shapes; corner_angle = 45)
        @test tag_names(domain) == [(dim = 1, tag = 1, name = "shore")]
        placement = set_spacing!(Placement(domain; steps = 20), 10.0)
        run!(placement)
        placed = nodes(placement).points
        # Sides are straight in the projection, so the northern one reaches 55.004 degrees.
        degrees = to_degrees(shapes, placed)
        @test all(17.999 .< degrees[1, :] .< 20.001) && all(53.98 .< degrees[2, :] .< 55.01)
        corners = from_degrees(shapes, COAST_CORNERS)
        @test all(minimum(sum(abs2, placed .- corners[:, k], dims = 1)) < 1e-18 for k in 1:4)
        @test COAST_CORNERS[1] == 18  # the argument does not change
        write_prj(shapes, joinpath(folder, "nodes.vtu"))
        @test read(joinpath(folder, "nodes.prj"), String) == told.prj
        @test explain(shapes, "at (500, 700)") == "at (500, 700)"  # this text is no error message
        @test fails(() -> add_shapes!(domain, shapes; corner_angle = 200), :error_argument,
                    "corner_angle")
        @test_throws DimensionMismatch to_degrees(shapes, zeros(3, 2))
        close(shapes)
        close(shapes)
        @test repr(shapes) == "PNPBS.Shapes(closed)"
        @test fails(() -> projection(shapes), :error_handle, "closed")
        Shapes(path; region_field = "name") do regions
            @test tag_names(add_shapes!(Domain(context), regions)) ==
                  [(dim = 2, tag = 1, name = "shore")]
        end
    end
    @test Shapes(shapes -> shape_counts(shapes).vertices, path) == 4
    @test fails(() -> Shapes(path; layer = "sea"), :error_file, "no layer 'sea'")
    @test fails(() -> Shapes(path; projection = "EPSG:1"), :error_argument, "EPSG:1")
    @test fails(() -> Shapes(path; unit = "mile"), :error_argument, "m or km")
    @test occursin("GDAL: ", geo_build_info())
end

# A grid with the values 3 longitude + latitude. The file next to it defines degrees.
function test_grids_of(folder)
    path = joinpath(folder, "depth.asc")
    rows = [join((3 * (17 + 0.5i) + 56 - 0.5j for i in 0:8), " ") for j in 0:6]
    write(path, "ncols 9\nnrows 7\nxllcenter 17\nyllcenter 53\ncellsize 0.5\n", join(rows, "\n"), "\n")
    write(joinpath(folder, "depth.prj"),
          """GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],
             PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]]""")
    write(joinpath(folder, "land.geojson"), COAST)
    Shapes(joinpath(folder, "land.geojson")) do shapes
        corners = from_degrees(shapes, COAST_CORNERS)
        low, high = vec(minimum(corners, dims = 2)), vec(maximum(corners, dims = 2))
        depth = GeoGrid(path, low, high; projection = projection(shapes).wkt)
        @test isapprox(grid_values(depth, corners), [108, 114, 115, 109]; rtol = 1e-6)
        @test inside_grid(depth, [corners[:, 1] corners[:, 1] .+ 1e6]) == [true, false]
        @test all(grid_extent(depth)[1] .< low) && all(high .< grid_extent(depth)[2])
        @test_throws DimensionMismatch grid_values(depth, zeros(3, 2))
        @test all(1e-5 .< grid_slopes(depth, corners) .< 1e-4)  # the slopes are 3 and 1 per degree
        @test_throws DimensionMismatch grid_slopes(depth, zeros(3, 2))
        close(depth)
        @test repr(depth) == "PNPBS.GeoGrid(closed)"
        @test fails(() -> grid_extent(depth), :error_handle, "closed")
    end
    @test fails(() -> GeoGrid(path, (50, 10), (51, 11)), :error_spacing, "outside of the domain")
    wave = sqrt.(9.81 .* [4000, 10]) .* 44.712 ./ 30
    @test depth_spacing([4000, 1]; metres = 1000) ≈ wave
    @test depth_spacing([200]; slopes = [50], slope = 20, metres = 1000) ≈ [0.4pi]
    @test_throws ArgumentError depth_spacing([200]; slope = 20)
    @test fails(() -> depth_spacing([NaN]), :error_spacing, "depths[0]")
end

@testset "shapes" begin
    if has_shapes()
        mktempdir(test_shapes_of)
        mktempdir(test_grids_of)
    else
        @test occursin("GDAL", sprint(showerror, thrown(() -> Shapes("land.geojson"))))
    end
end
