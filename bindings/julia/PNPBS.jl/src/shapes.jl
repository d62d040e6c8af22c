# SPDX-License-Identifier: BSD-3-Clause
# Shapes as geographers have them: GeoJSON, shapefiles and what else GDAL reads, projected.

"""
    Shapes(path; layer = nothing, projection = nothing, unit = nothing, tag_field = nothing)
    Shapes(f, path; ...)

One layer of a file that GDAL reads, such as GeoJSON, a shapefile or GeoPackage, projected by PROJ;
all its functions are local. Available where PNPBS was built with GDAL. Polygons bound a domain,
edges shared by neighbours and lines are inner curves, points are fixed nodes; `pnpbs_geo.h` has the
details. `projection` is a code (`"EPSG:2180"`), a PROJ string, WKT, the path of a `.prj` file,
`"auto"`, a projection chosen for the data, `"none"`, the coordinates of the file, or, for domains on
a sphere ([`sphere_domain`](@ref)), `"sphere(LON,LAT)"` with the longitude and latitude of the point
outside; by default longitude and latitude are projected as by `"auto"`, and other coordinates are
kept. `unit` is `"m"` or `"km"`, `tag_field` the attribute that becomes the tag. A file that cannot
be used is a [`PNPBSError`](@ref).

`close` them when they are no longer needed; the second form calls `f(shapes)` and closes them, as
`open` does with files.

    Shapes("coast.geojson"; unit = "km") do shapes
        add_shapes!(domain, shapes; corner_angle = 45)
        ...
        write_prj(shapes, "nodes.vtu")
    end
"""
mutable struct Shapes
    handle::LibPNPBSGeo.pnpbs_geo_shapes
end

function Shapes(path::AbstractString; layer = nothing, projection = nothing, unit = nothing,
                tag_field = nothing)
    handle = Ref{LibPNPBSGeo.pnpbs_geo_shapes}(C_NULL)
    # What is left out is "" in C.
    check_geo(LibPNPBSGeo.pnpbs_geo_read(path, something(layer, ""), something(projection, ""),
                                         something(unit, ""), something(tag_field, ""), handle))
    return Shapes(handle[])
end

function Shapes(f::Function, path::AbstractString; options...)
    shapes = Shapes(path; options...)
    try
        return f(shapes)
    finally
        close(shapes)
    end
end

# That library has its own last message.
function check_geo(code)
    code < 0 && throw(PNPBSError(status_name(code),
                                 string_or_empty(LibPNPBSGeo.pnpbs_geo_last_error())))
    return nothing
end

Base.isopen(shapes::Shapes) = shapes.handle != C_NULL

# What was added to domains stays there.
function Base.close(shapes::Shapes)
    handle = Ref(shapes.handle)
    isopen(shapes) && check_geo(LibPNPBSGeo.pnpbs_geo_destroy(handle))
    shapes.handle = C_NULL
    return nothing
end

Base.show(io::IO, shapes::Shapes) =
    print(io, "PNPBS.Shapes(", isopen(shapes) ? projection(shapes).name : "closed", ")")

"""
    add_shapes!(domain, shapes; corner_angle = 0) -> domain

Adds [`Shapes`](@ref) to a domain in the plane or on a sphere: curves as [`add_polyline!`](@ref)
does, points as [`add_fixed_nodes!`](@ref) does, and the names of tags. With `corner_angle = 0` every
vertex becomes a node; otherwise only those where the direction turns by more than this many degrees.
Curves that cross or do not close are found by [`check_domain`](@ref); see [`explain`](@ref).
"""
function add_shapes!(domain::Domain, shapes::Shapes; corner_angle::Real = 0)
    check_geo(LibPNPBSGeo.pnpbs_geo_add_to_domain(live(shapes), live(domain.context), live(domain),
                                                  corner_angle))
    return domain
end

"""
    shape_counts(shapes) -> (vertices = ..., boundary = ..., inner = ..., points = ...)

Returns the numbers of what was read: distinct positions, including those of points; boundary curves
and inner ones, closed or between the vertices where curves meet; and fixed nodes.
"""
function shape_counts(shapes::Shapes)
    counts = Tuple(Ref{Int64}(0) for _ in 1:4)
    check_geo(LibPNPBSGeo.pnpbs_geo_counts(live(shapes), counts...))
    return NamedTuple{(:vertices, :boundary, :inner, :points)}(getindex.(counts))
end

"""
    projection(shapes) -> (name = ..., unit = ..., proj = ..., wkt = ..., prj = ..., scale = ...)

Returns the projection of x and y as texts, `""` where the file does not define it: a name, their
unit, the PROJ string, WKT 2, and the content of `.prj` files; and the range of projected length
over length on the Earth.
"""
function projection(shapes::Shapes)
    texts = Tuple(Ref{Cstring}() for _ in 1:5)
    check_geo(LibPNPBSGeo.pnpbs_geo_projection(live(shapes), texts...))
    least, greatest = Ref(1.0), Ref(1.0)
    check_geo(LibPNPBSGeo.pnpbs_geo_scale(live(shapes), least, greatest))
    return (; zip((:name, :unit, :proj, :wkt, :prj),
                  map(text -> string_or_empty(text[]), texts))...,
            scale = (least[], greatest[]))
end

"""
    notes(shapes) -> Vector{String}

Returns notes on how the file was interpreted.
"""
function notes(shapes::Shapes)
    count = Ref{Int32}(0)
    check_geo(LibPNPBSGeo.pnpbs_geo_note_count(live(shapes), count))
    return [note_of(shapes, index) for index in 0:(count[] - 1)]
end

function note_of(shapes, index)
    note = Ref{Cstring}()
    check_geo(LibPNPBSGeo.pnpbs_geo_get_note(live(shapes), index, note))
    return string_or_empty(note[])
end

"""
    write_prj(shapes, results)

Writes the projection beside a file of results, as for shapefiles: `"nodes.prj"` for `"nodes.vtu"`.
On several ranks call it on one.
"""
function write_prj(shapes::Shapes, results::AbstractString)
    check_geo(LibPNPBSGeo.pnpbs_geo_write_prj(live(shapes), results))
    return nothing
end

"""
    to_degrees(shapes, points) -> degrees
    from_degrees(shapes, degrees) -> points

Convert points to longitude and latitude, on the ellipsoid of the file, and back; `(2, n)` both.
Values that do not exist are infinite.
"""
to_degrees, from_degrees

function to_degrees(shapes::Shapes, points::AbstractMatrix{<:Real})
    changed = copy(as_points(points, 2, "points"))
    check_geo(LibPNPBSGeo.pnpbs_geo_to_degrees(live(shapes), size(changed, 2), changed))
    return changed
end

function from_degrees(shapes::Shapes, degrees::AbstractMatrix{<:Real})
    changed = copy(as_points(degrees, 2, "degrees"))
    check_geo(LibPNPBSGeo.pnpbs_geo_from_degrees(live(shapes), size(changed, 2), changed))
    return changed
end

"""
    explain(shapes, message) -> String

Returns the message of the last error about a domain of these shapes, with longitude and latitude
inserted after each point "(x, y)". Any other text is returned as it is.
"""
explain(shapes::Shapes, message::AbstractString) =
    string_or_empty(LibPNPBSGeo.pnpbs_geo_explain(live(shapes), message))

"""
    geo_build_info() -> String

Returns the versions of GDAL and PROJ in use, one "name: version" per line.
"""
geo_build_info() = string_or_empty(LibPNPBSGeo.pnpbs_geo_build_info())

"""
    GeoGrid(path, low, high; variable = nothing, projection = nothing)

Values on a grid in a file: GeoTIFF, NetCDF and other formats that GDAL reads; all its functions are
local. `low` and `high` are the corners of the part that is read, in the projection of the points at
which it is evaluated; `projection` is that projection, as in [`Shapes`](@ref) or the `wkt` of its
[`projection`](@ref); by default the points are in the grid's own system. `variable` is the name of
one in a file of several, or the number of a band. `close` it when it is no longer needed.

    depth = GeoGrid("depth.tif", low, high; projection = projection(shapes).wkt)
    set_spacing!(placement, x -> clamp.(0.02 .* grid_values(depth, x), 0.5, 20))
"""
mutable struct GeoGrid
    handle::LibPNPBSGeo.pnpbs_geo_grid
end

function GeoGrid(path::AbstractString, low, high; variable = nothing, projection = nothing)
    handle = Ref{LibPNPBSGeo.pnpbs_geo_grid}(C_NULL)
    check_geo(LibPNPBSGeo.pnpbs_geo_grid_read(path, string(something(variable, "")),
                                              something(projection, ""), corner_of_part(low),
                                              corner_of_part(high), handle))
    return GeoGrid(handle[])
end

function corner_of_part(corner)
    length(corner) == 2 || throw(DimensionMismatch(
        "a corner of the part has $(length(corner)) coordinates; 2 were expected"))
    return collect(Float64, corner)
end

Base.isopen(grid::GeoGrid) = grid.handle != C_NULL

function Base.close(grid::GeoGrid)
    handle = Ref(grid.handle)
    isopen(grid) && check_geo(LibPNPBSGeo.pnpbs_geo_grid_destroy(handle))
    grid.handle = C_NULL
    return nothing
end

Base.show(io::IO, grid::GeoGrid) = print(io, "PNPBS.GeoGrid(", isopen(grid) ? "" : "closed", ")")

"""
    grid_values(grid, points) -> values

Evaluates the grid at points, `2 x n`: linear in each direction between the centres of the cells,
constant beyond the edge. Cells without data take the value of the nearest cell that has some.
"""
grid_values(grid::GeoGrid, points::AbstractMatrix) = asked_grid(grid, points)[1]

"""
    inside_grid(grid, points) -> BitVector

Returns whether points, `2 x n`, lie in the grid, or less than half a cell beyond its edge; also where
no cell around them has data.
"""
inside_grid(grid::GeoGrid, points::AbstractMatrix) = asked_grid(grid, points)[2] .!= 0

function asked_grid(grid, points)
    size(points, 1) == 2 || throw(DimensionMismatch(
        "points has $(size(points, 1)) rows; 2 were expected"))
    x = Matrix{Float64}(points)
    values, inside = zeros(size(x, 2)), zeros(Int32, size(x, 2))
    check_geo(LibPNPBSGeo.pnpbs_geo_grid_values(live(grid), size(x, 2), x, values, inside))
    return values, inside
end

"""
    grid_slopes(grid, points; radius = 0) -> slopes

Returns how steep the grid is at points, `2 x n`: the change of its values per unit of length.
`radius` is that of the sphere along which lengths are, if the points are longitude and latitude in
degrees; with 0, lengths are those of the plane of the points.
"""
function grid_slopes(grid::GeoGrid, points::AbstractMatrix; radius::Real = 0)
    size(points, 1) == 2 || throw(DimensionMismatch(
        "points has $(size(points, 1)) rows; 2 were expected"))
    x = Matrix{Float64}(points)
    slopes = zeros(size(x, 2))
    check_geo(LibPNPBSGeo.pnpbs_geo_grid_slopes(live(grid), radius, size(x, 2), x, slopes))
    return slopes
end

"""
    depth_spacing(depths; slopes = nothing, wave = 30, period = 44712, slope = 0, least = 10,
                  metres = 1) -> d

Returns the d of models of tides and surges by the depth of the water in metres, positive down
(elevations must be negated): `wave` nodes per length of a long wave of this `period` in seconds, and
`slope` nodes per 2 pi h / |grad h|, each with 0 not at all. Shallower water than `least`, and land,
count as flat at that depth. `slopes` are those of the depths, in metres per unit of length, as from
[`grid_slopes`](@ref); a unit of length is so many `metres`.

    set_spacing!(placement, x -> clamp.(depth_spacing(grid_values(depth, x); metres = 1000), 0.5, 20))
"""
function depth_spacing(depths::AbstractVector{<:Real}; slopes = nothing, wave::Real = 30,
                       period::Real = 44712, slope::Real = 0, least::Real = 10, metres::Real = 1)
    slope > 0 && slopes === nothing && throw(ArgumentError(
        "slope is $slope, which requires the argument slopes"))
    h, n = Vector{Float64}(depths), length(depths)
    steep = slopes === nothing ? zeros(n) : Vector{Float64}(slopes)
    length(steep) == n || throw(DimensionMismatch(
        "slopes has length $(length(steep)); $n was expected, as of depths"))
    d = zeros(n)
    check_geo(LibPNPBSGeo.pnpbs_geo_depth_spacing(n, h, steep, wave, period, slope, least, metres, d))
    return d
end

"""
    grid_extent(grid) -> (low, high)

Returns the bounding box of the whole grid in the file, in the projection of the points.
"""
function grid_extent(grid::GeoGrid)
    low, high = zeros(2), zeros(2)
    check_geo(LibPNPBSGeo.pnpbs_geo_grid_extent(live(grid), low, high))
    return low, high
end
