# SPDX-License-Identifier: BSD-3-Clause
"""
The unmodified C interface of `libpnpbs_geo`. It has one Julia function for each function of
`pnpbs_geo.h`, as `LibPNPBS` has for `pnpbs.h`. The library exists only if PNPBS was built with
GDAL, and is opened by the first call.
"""
module LibPNPBSGeo

using Libdl
using ..LibPNPBS: LibPNPBS, pnpbs_status, pnpbs_context, pnpbs_domain

const pnpbs_geo_shapes = Ptr{Cvoid}
const pnpbs_geo_grid = Ptr{Cvoid}

const opened = Ref{Ptr{Cvoid}}(C_NULL)

function open_library()
    LibPNPBS.symbol(:pnpbs_version)  # libpnpbs_geo calls libpnpbs, which must be opened first
    name = Sys.islinux() ? "libpnpbs_geo.so.0" : "libpnpbs_geo.$(Libdl.dlext)"
    beside = joinpath(LibPNPBS.common_folder(LibPNPBS.library_path()), name)
    opened[] = try
        dlopen(isfile(beside) ? beside : name, RTLD_LAZY | RTLD_LOCAL)
    catch e
        error("cannot open the library that reads shapes: $(sprint(showerror, e))\n",
              "It exists only if PNPBS was built with GDAL.")
    end
    return opened[]
end

symbol(name::Symbol) = dlsym(opened[] == C_NULL ? open_library() : opened[], name)

const PNPBS_GEO_NOTE_NO_GEOMETRY = 1
const PNPBS_GEO_NOTE_HEIGHTS_LEFT_OUT = 2
const PNPBS_GEO_NOTE_NEARLY_TOUCHING = 3
const PNPBS_GEO_NOTE_NO_REFERENCE_SYSTEM = 4
const PNPBS_GEO_NOTE_DEGREES_IN_PLANE = 5
const PNPBS_GEO_NOTE_SCALE = 6
const PNPBS_GEO_NOTE_SEGMENTS_RETAGGED = 7
const PNPBS_GEO_NOTE_LINES_ALONG_BOUNDARY = 8
const PNPBS_GEO_NOTE_SHARED_SEGMENTS_LEFT_OUT = 9
const PNPBS_GEO_NOTE_WHOLE_SPHERE = 10
const PNPBS_GEO_NOTE_LINES_LEFT_OUT = 11
const PNPBS_GEO_NOTE_SEGMENTS_LEFT_OUT = 12

pnpbs_geo_last_error() =
    @ccall $(symbol(:pnpbs_geo_last_error))()::Cstring

pnpbs_geo_build_info() =
    @ccall $(symbol(:pnpbs_geo_build_info))()::Cstring

pnpbs_geo_read(path, layer, projection, unit, tag_field, shapes) =
    @ccall $(symbol(:pnpbs_geo_read))(
        path::Cstring, layer::Cstring, projection::Cstring, unit::Cstring, tag_field::Cstring,
        shapes::Ptr{pnpbs_geo_shapes})::pnpbs_status

pnpbs_geo_read_regions(path, layer, projection, unit, tag_field, region_field, shapes) =
    @ccall $(symbol(:pnpbs_geo_read_regions))(
        path::Cstring, layer::Cstring, projection::Cstring, unit::Cstring, tag_field::Cstring,
        region_field::Cstring, shapes::Ptr{pnpbs_geo_shapes})::pnpbs_status

pnpbs_geo_destroy(shapes) =
    @ccall $(symbol(:pnpbs_geo_destroy))(shapes::Ptr{pnpbs_geo_shapes})::pnpbs_status

pnpbs_geo_add_to_domain(shapes, context, domain, corner_angle) =
    @ccall $(symbol(:pnpbs_geo_add_to_domain))(
        shapes::pnpbs_geo_shapes, context::pnpbs_context, domain::pnpbs_domain,
        corner_angle::Cdouble)::pnpbs_status

pnpbs_geo_counts(shapes, vertices, boundary, inner, points) =
    @ccall $(symbol(:pnpbs_geo_counts))(
        shapes::pnpbs_geo_shapes, vertices::Ptr{Int64}, boundary::Ptr{Int64}, inner::Ptr{Int64},
        points::Ptr{Int64})::pnpbs_status

pnpbs_geo_projection(shapes, name, unit, proj, wkt, prj) =
    @ccall $(symbol(:pnpbs_geo_projection))(
        shapes::pnpbs_geo_shapes, name::Ptr{Cstring}, unit::Ptr{Cstring}, proj::Ptr{Cstring},
        wkt::Ptr{Cstring}, prj::Ptr{Cstring})::pnpbs_status

pnpbs_geo_scale(shapes, least, greatest) =
    @ccall $(symbol(:pnpbs_geo_scale))(
        shapes::pnpbs_geo_shapes, least::Ptr{Cdouble}, greatest::Ptr{Cdouble})::pnpbs_status

pnpbs_geo_write_prj(shapes, results) =
    @ccall $(symbol(:pnpbs_geo_write_prj))(
        shapes::pnpbs_geo_shapes, results::Cstring)::pnpbs_status

pnpbs_geo_to_degrees(shapes, n, coordinates) =
    @ccall $(symbol(:pnpbs_geo_to_degrees))(
        shapes::pnpbs_geo_shapes, n::Int64, coordinates::Ptr{Cdouble})::pnpbs_status

pnpbs_geo_from_degrees(shapes, n, coordinates) =
    @ccall $(symbol(:pnpbs_geo_from_degrees))(
        shapes::pnpbs_geo_shapes, n::Int64, coordinates::Ptr{Cdouble})::pnpbs_status

pnpbs_geo_explain(shapes, message) =
    @ccall $(symbol(:pnpbs_geo_explain))(
        shapes::pnpbs_geo_shapes, message::Cstring)::Cstring

pnpbs_geo_note_count(shapes, count) =
    @ccall $(symbol(:pnpbs_geo_note_count))(
        shapes::pnpbs_geo_shapes, count::Ptr{Int32})::pnpbs_status

pnpbs_geo_get_note(shapes, index, note) =
    @ccall $(symbol(:pnpbs_geo_get_note))(
        shapes::pnpbs_geo_shapes, index::Int32, note::Ptr{Cstring})::pnpbs_status

pnpbs_geo_get_note_data(shapes, index, code, count) =
    @ccall $(symbol(:pnpbs_geo_get_note_data))(
        shapes::pnpbs_geo_shapes, index::Int32, code::Ptr{Int32},
        count::Ptr{Int64})::pnpbs_status

pnpbs_geo_grid_read(path, variable, projection, low, high, grid) =
    @ccall $(symbol(:pnpbs_geo_grid_read))(
        path::Cstring, variable::Cstring, projection::Cstring, low::Ptr{Cdouble},
        high::Ptr{Cdouble}, grid::Ptr{pnpbs_geo_grid})::pnpbs_status

pnpbs_geo_grid_destroy(grid) =
    @ccall $(symbol(:pnpbs_geo_grid_destroy))(grid::Ptr{pnpbs_geo_grid})::pnpbs_status

pnpbs_geo_grid_values(grid, n, coordinates, values, inside) =
    @ccall $(symbol(:pnpbs_geo_grid_values))(
        grid::pnpbs_geo_grid, n::Int64, coordinates::Ptr{Cdouble}, values::Ptr{Cdouble},
        inside::Ptr{Int32})::pnpbs_status

pnpbs_geo_grid_slopes(grid, radius, n, coordinates, slopes) =
    @ccall $(symbol(:pnpbs_geo_grid_slopes))(
        grid::pnpbs_geo_grid, radius::Cdouble, n::Int64, coordinates::Ptr{Cdouble},
        slopes::Ptr{Cdouble})::pnpbs_status

pnpbs_geo_depth_spacing(n, depths, slopes, nodes_per_wave, period, nodes_per_slope, least_depth,
                        metres, d) =
    @ccall $(symbol(:pnpbs_geo_depth_spacing))(
        n::Int64, depths::Ptr{Cdouble}, slopes::Ptr{Cdouble}, nodes_per_wave::Cdouble,
        period::Cdouble, nodes_per_slope::Cdouble, least_depth::Cdouble, metres::Cdouble,
        d::Ptr{Cdouble})::pnpbs_status

pnpbs_geo_grid_extent(grid, low, high) =
    @ccall $(symbol(:pnpbs_geo_grid_extent))(
        grid::pnpbs_geo_grid, low::Ptr{Cdouble}, high::Ptr{Cdouble})::pnpbs_status

end
