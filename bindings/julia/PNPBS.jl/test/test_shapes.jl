# SPDX-License-Identifier: BSD-3-Clause
# Shapes that GDAL reads. The build says whether there is a library for them.
const COAST = """{"type": "Feature", "properties": {"name": "shore"}, "geometry":
    {"type": "Polygon", "coordinates": [[[18, 54], [20, 54], [20, 55], [18, 55], [18, 54]]]}}"""
const COAST_CORNERS = [18.0 20 20 18; 54 54 55 55]

function has_shapes()
    folder = dirname(PNPBS.LibPNPBS.library_path())
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
        # Sides are straight in the projection: the northern one bows to 55.004 degrees.
        degrees = to_degrees(shapes, placed)
        @test all(17.999 .< degrees[1, :] .< 20.001) && all(53.98 .< degrees[2, :] .< 55.01)
        corners = from_degrees(shapes, COAST_CORNERS)
        @test all(minimum(sum(abs2, placed .- corners[:, k], dims = 1)) < 1e-18 for k in 1:4)
        @test COAST_CORNERS[1] == 18  # what was given stays
        write_prj(shapes, joinpath(folder, "nodes.vtu"))
        @test read(joinpath(folder, "nodes.prj"), String) == told.prj
        @test occursin("[longitude", explain(shapes, "at (500, 700)"))
        @test fails(() -> add_shapes!(domain, shapes; corner_angle = 200), :error_argument,
                    "corner_angle")
        @test_throws DimensionMismatch to_degrees(shapes, zeros(3, 2))
        close(shapes)
        close(shapes)
        @test repr(shapes) == "PNPBS.Shapes(closed)"
        @test fails(() -> projection(shapes), :error_handle, "closed")
    end
    @test Shapes(shapes -> shape_counts(shapes).vertices, path) == 4
    @test fails(() -> Shapes(path; layer = "sea"), :error_file, "no layer 'sea'")
    @test fails(() -> Shapes(path; projection = "EPSG:1"), :error_argument, "EPSG:1")
    @test fails(() -> Shapes(path; unit = "mile"), :error_argument, "m or km")
    @test occursin("GDAL: ", geo_build_info())
end

@testset "shapes" begin
    if has_shapes()
        mktempdir(test_shapes_of)
    else
        @test occursin("GDAL", sprint(showerror, thrown(() -> Shapes("land.geojson"))))
    end
end
