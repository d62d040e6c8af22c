# SPDX-License-Identifier: BSD-3-Clause
# Geographic shapes and grids: GeoJSON, shapefiles and other formats that GDAL reads, projected.

"""
    Shapes(path; layer = nothing, projection = nothing, unit = nothing, tag_field = nothing,
           region_field = nothing)
    Shapes(f, path; ...)

Reads one layer of a file that GDAL reads, such as GeoJSON, a shapefile or GeoPackage, and projects
it by PROJ. All functions of shapes are local. They exist only if PNPBS was built with GDAL.
Polygons bound a domain, lines and edges that neighbours share become inner curves, and points
become fixed nodes. `pnpbs_geo.h` has the details.

- `layer`: the name of the layer; `nothing` if the file has only one.
- `projection`: a code (`"EPSG:2180"`), a PROJ string, WKT, or the path of a `.prj` file. `"auto"`
  is a projection chosen for the data, and `"none"` keeps the coordinates of the file.
  `"sphere(LON,LAT)"` is for domains on a sphere ([`sphere_domain`](@ref)), with longitude and
  latitude of the point outside. By default longitude and latitude are projected as by `"auto"`, and
  other coordinates are kept.
- `unit`: `"m"` or `"km"`; `nothing` for the unit of the projection.
- `tag_field`: the attribute that becomes the tag; `nothing` for the tag 1.
- `region_field`: the attribute of polygons that becomes the tag of the elements in them: an integer
  as it is, 0 for none; if other values occur, all are numbered from 1 in sorted order and named.
  `nothing` for no regions.

Throws `:error_file` if the file, layer or field cannot be read or a polygon has no region,
`:error_argument` for an invalid projection or unit, and `:error_domain` if polygons overlap, or
regions have a tiny gap between them.

Call `close` when the shapes are no longer needed. The second form calls `f(shapes)` and closes
them, as `open` does with files.

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
                tag_field = nothing, region_field = nothing)
    handle = Ref{LibPNPBSGeo.pnpbs_geo_shapes}(C_NULL)
    # An empty text stands for an omitted argument in C.
    check_geo(LibPNPBSGeo.pnpbs_geo_read_regions(
        path, something(layer, ""), something(projection, ""), something(unit, ""),
        something(tag_field, ""), something(region_field, ""), handle))
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

# Throws if a call of libpnpbs_geo has failed, which has its own last error.
function check_geo(code)
    code < 0 && throw(PNPBSError(status_name(code),
                                 string_or_empty(LibPNPBSGeo.pnpbs_geo_last_error())))
    return nothing
end

Base.isopen(shapes::Shapes) = shapes.handle != C_NULL

# Shapes that were added to domains remain there.
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
does, points as [`add_fixed_nodes!`](@ref) does, and the names of tags. With `corner_angle = 0`
every vertex becomes a node. Otherwise only vertices where the direction turns by more than this
angle in degrees become nodes. [`check_domain`](@ref) finds curves that cross or do not close; see
[`explain`](@ref).
"""
function add_shapes!(domain::Domain, shapes::Shapes; corner_angle::Real = 0)
    check_geo(LibPNPBSGeo.pnpbs_geo_add_to_domain(live(shapes), live(domain.context), live(domain),
                                                  corner_angle))
    return domain
end

"""
    shape_counts(shapes) -> (vertices = ..., boundary = ..., inner = ..., points = ...)

Returns the numbers of entities that were read: distinct positions, including those of points;
boundary and inner curves, which are closed or lie between the vertices where curves meet; and fixed
nodes.
"""
function shape_counts(shapes::Shapes)
    counts = Tuple(Ref{Int64}(0) for _ in 1:4)
    check_geo(LibPNPBSGeo.pnpbs_geo_counts(live(shapes), counts...))
    return NamedTuple{(:vertices, :boundary, :inner, :points)}(getindex.(counts))
end

"""
    projection(shapes) -> (name = ..., unit = ..., proj = ..., wkt = ..., prj = ..., scale = ...)

Returns the projection of x and y as texts, which are empty if the file does not define its
coordinate system: a name, the unit, the PROJ string, WKT 2, and the content of a `.prj` file.
`scale` is the range of projected length over length on the Earth.
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

Returns notes on the interpretation of the file.
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

Writes the projection next to a file of results, as for shapefiles: `"nodes.prj"` for `"nodes.vtu"`.
On several ranks, call it on one of them. Throws `:error_state` if the projection is not known.
"""
function write_prj(shapes::Shapes, results::AbstractString)
    check_geo(LibPNPBSGeo.pnpbs_geo_write_prj(live(shapes), results))
    return nothing
end

"""
    to_degrees(shapes, points) -> degrees
    from_degrees(shapes, degrees) -> points

Convert points to longitude and latitude in degrees, on the ellipsoid of the file, and back. Both
are `(2, n)`. Values that do not exist become infinite. Both return a new matrix.
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
after each point "(x, y)", then the features with a segment there. Where curves cross, advice
follows in a line of its own. Any other text is returned without changes.
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

Opens values on a grid in a file: GeoTIFF, NetCDF and other formats that GDAL reads. All functions
of grids are local. The file stays open, and blocks of it are read where values are requested. Call
`close` when the grid is no longer needed.

- `low`, `high`: opposite corners of the requested part, in the projection of the points at which
  the grid is evaluated.
- `variable`: the name of a variable, or the number of a band; `nothing` if the file has only one.
- `projection`: the projection of the points, as in [`Shapes`](@ref) or the `wkt` of its
  [`projection`](@ref). By default the points are in the coordinate system of the grid.

Throws `:error_file` if the file or variable cannot be read, and `:error_spacing` if the grid has no
values in the requested part.

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

Evaluates the grid at points, `(2, n)`. Values are linear in each direction between the centres of
the cells, and constant beyond the edge. Cells without data have the value of the nearest cell with
data.
"""
grid_values(grid::GeoGrid, points::AbstractMatrix) = asked_grid(grid, points)[1]

"""
    inside_grid(grid, points) -> BitVector

Returns whether points, `(2, n)`, lie in the grid or less than half a cell beyond its edge, also
where no cell around them has data.
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

Returns the slope of the grid at points, `(2, n)`: the change of its values per unit of length. If
the points are longitude and latitude in degrees, `radius` is that of the sphere along which lengths
are measured. With 0, lengths are those in the plane of the points.
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

Returns the spacing of models of tides and surges by the depth h of the water: the lesser of the
spacings by the length of waves and by the slope of the bottom. Water shallower than `least`, and
land, count as flat at that depth. Local.

- `depths`: depths in metres, positive down: elevations must be negated.
- `slopes`: slopes of the depths, in metres per unit of length, as returned by
  [`grid_slopes`](@ref).
- `wave`: number of nodes per length of a long wave; 0 for no such bound.
- `period`: period of the wave in seconds.
- `slope`: number of nodes per 2 pi h / |grad h|; 0 for no such bound.
- `least`: least depth in metres.
- `metres`: metres per unit of length, for example 1000 for kilometres.

Throws `:error_spacing` for a depth or slope that is not a number.

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

Returns the corners of the bounding box of the whole grid in the file, in the projection of the
points.
"""
function grid_extent(grid::GeoGrid)
    low, high = zeros(2), zeros(2)
    check_geo(LibPNPBSGeo.pnpbs_geo_grid_extent(live(grid), low, high))
    return low, high
end
