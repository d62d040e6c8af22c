# SPDX-License-Identifier: BSD-3-Clause
"""
The unmodified C interface. It has one Julia function for each function of `pnpbs.h`, with the same
name and arguments, as documented in that header. The only checks and conversions are those of
`ccall`. A test compares every signature below with the header.
"""
module LibPNPBS

include("library.jl")

# Types, with the names of the header. Handles are keys of the library and not addresses. Callbacks
# are pointers that `@cfunction` creates (see callbacks.jl).
const pnpbs_status = Int32
const pnpbs_context = Ptr{Cvoid}
const pnpbs_domain = Ptr{Cvoid}
const pnpbs_placement = Ptr{Cvoid}
const pnpbs_transfer = Ptr{Cvoid}
const pnpbs_mesh = Ptr{Cvoid}
const pnpbs_voronoi = Ptr{Cvoid}
const pnpbs_particles = Ptr{Cvoid}
const pnpbs_curve_fn = Ptr{Cvoid}
const pnpbs_level_set_fn = Ptr{Cvoid}
const pnpbs_spacing_fn = Ptr{Cvoid}
const pnpbs_monitor_fn = Ptr{Cvoid}

const PNPBS_OK = 0
const PNPBS_NOT_CONVERGED = 1
const PNPBS_STOPPED = 2
const PNPBS_SPACING_MISSED = 3
const PNPBS_NOT_CONFORMING = 4
const PNPBS_ERROR_ARGUMENT = -1
const PNPBS_ERROR_HANDLE = -2
const PNPBS_ERROR_STATE = -3
const PNPBS_ERROR_DOMAIN = -4
const PNPBS_ERROR_SPACING = -5
const PNPBS_ERROR_KEY = -6
const PNPBS_ERROR_CAPACITY = -7
const PNPBS_ERROR_FILE = -8
const PNPBS_ERROR_CALLBACK = -9
const PNPBS_ERROR_MEMORY = -10
const PNPBS_ERROR_MPI = -11
const PNPBS_ERROR_KOKKOS = -12
const PNPBS_ERROR_UNSUPPORTED = -13
const PNPBS_ERROR_INTERNAL = -14

const PNPBS_BOUNDARY = 0
const PNPBS_INNER = 1
const PNPBS_OVERLAP_LAST = 0
const PNPBS_OVERLAP_FIRST = 1
const PNPBS_OVERLAP_OWN = 2
const PNPBS_BOUNDED = 0
const PNPBS_PERIODIC = 1
const PNPBS_FLAT = 2

const PNPBS_REASON_OTHER = 0
const PNPBS_REASON_CROSSING = 1
const PNPBS_WARNING_UNKNOWN = 0
const PNPBS_WARNING_LEFT_OUT_OUTSIDE = 101
const PNPBS_WARNING_UNUSED_VERTICES = 102
const PNPBS_WARNING_REGION_POINTS = 103
const PNPBS_WARNING_SIMPLIFIED = 104
const PNPBS_WARNING_REPAIRED = 105
const PNPBS_WARNING_TRIANGLES_LEFT_OUT = 106
const PNPBS_WARNING_TRIANGLES_TURNED = 107
const PNPBS_WARNING_VERTICES_MERGED = 108
const PNPBS_WARNING_SURFACES_TOUCH = 109
const PNPBS_WARNING_PIECES_LEFT_OUT = 110
const PNPBS_WARNING_EDGES_ROUNDED = 111
const PNPBS_WARNING_CREASES_IGNORED = 112
const PNPBS_WARNING_FEATURE_ANGLE = 113
const PNPBS_WARNING_CURVED_ELEMENTS = 114
const PNPBS_WARNING_GROUPS = 115
const PNPBS_WARNING_FEATURE_UNRESOLVED = 201
const PNPBS_WARNING_FIXED_NODES_CLOSE = 202
const PNPBS_WARNING_GROWTH = 203
const PNPBS_WARNING_PARTIAL_EXTENT = 204
const PNPBS_WARNING_SPACING_COARSE = 205
const PNPBS_WARNING_SPACING_MISSED = 206
const PNPBS_WARNING_SPACING_HELD = 207
const PNPBS_WARNING_BOUNDARY_NOT_FOLLOWED = 301
const PNPBS_WARNING_NOT_CONFORMING = 302
const PNPBS_WARNING_SMALL_ANGLES = 303
const PNPBS_WARNING_FEATURES_LEFT_OUT = 304
const PNPBS_WARNING_OPTION_WITHOUT_EFFECT = 401
const PNPBS_WARNING_OPTIONS_CHANGED = 402
const PNPBS_WARNING_DEPENDS_ON_RANKS = 403

# ---------------------------------------------------------------- status and errors ----------
pnpbs_status_string(status) =
    @ccall $(symbol(:pnpbs_status_string))(status::pnpbs_status)::Cstring

pnpbs_last_error(context) =
    @ccall $(symbol(:pnpbs_last_error))(context::pnpbs_context)::Cstring

pnpbs_last_error_data(context, reason, points) =
    @ccall $(symbol(:pnpbs_last_error_data))(
        context::pnpbs_context, reason::Ptr{Int32}, points::Ptr{Int32})::pnpbs_status

pnpbs_last_error_point(context, index, point, begin_, end_) =
    @ccall $(symbol(:pnpbs_last_error_point))(
        context::pnpbs_context, index::Int32, point::Ptr{Cdouble}, begin_::Ptr{Int64},
        end_::Ptr{Int64})::pnpbs_status

pnpbs_version(major, minor, patch) =
    @ccall $(symbol(:pnpbs_version))(
        major::Ptr{Int32}, minor::Ptr{Int32}, patch::Ptr{Int32})::pnpbs_status

pnpbs_build_info() =
    @ccall $(symbol(:pnpbs_build_info))()::Cstring

pnpbs_mpi_library() =
    @ccall $(symbol(:pnpbs_mpi_library))()::Cstring

# ---------------------------------------------------------------- context --------------------
pnpbs_context_create_serial(context) =
    @ccall $(symbol(:pnpbs_context_create_serial))(
        context::Ptr{pnpbs_context})::pnpbs_status

pnpbs_context_create_f(comm, context) =
    @ccall $(symbol(:pnpbs_context_create_f))(
        comm::Int32, context::Ptr{pnpbs_context})::pnpbs_status

pnpbs_context_create_checked_f(comm, library, context) =
    @ccall $(symbol(:pnpbs_context_create_checked_f))(
        comm::Int32, library::Cstring, context::Ptr{pnpbs_context})::pnpbs_status

pnpbs_context_destroy(context) =
    @ccall $(symbol(:pnpbs_context_destroy))(context::Ptr{pnpbs_context})::pnpbs_status

pnpbs_finalize() =
    @ccall $(symbol(:pnpbs_finalize))()::pnpbs_status

pnpbs_context_set(context, key, value) =
    @ccall $(symbol(:pnpbs_context_set))(
        context::pnpbs_context, key::Cstring, value::Cstring)::pnpbs_status

pnpbs_context_set_int64(context, key, value) =
    @ccall $(symbol(:pnpbs_context_set_int64))(
        context::pnpbs_context, key::Cstring, value::Int64)::pnpbs_status

pnpbs_context_set_double(context, key, value) =
    @ccall $(symbol(:pnpbs_context_set_double))(
        context::pnpbs_context, key::Cstring, value::Cdouble)::pnpbs_status

# ---------------------------------------------------------------- tables ---------------------
pnpbs_option_count(count) =
    @ccall $(symbol(:pnpbs_option_count))(count::Ptr{Int32})::pnpbs_status

pnpbs_option_info(index, name, type, default_value, range, help) =
    @ccall $(symbol(:pnpbs_option_info))(
        index::Int32, name::Ptr{Cstring}, type::Ptr{Cstring}, default_value::Ptr{Cstring},
        range::Ptr{Cstring}, help::Ptr{Cstring})::pnpbs_status

pnpbs_statistic_count(count) =
    @ccall $(symbol(:pnpbs_statistic_count))(count::Ptr{Int32})::pnpbs_status

pnpbs_statistic_info(index, name, type, help) =
    @ccall $(symbol(:pnpbs_statistic_info))(
        index::Int32, name::Ptr{Cstring}, type::Ptr{Cstring},
        help::Ptr{Cstring})::pnpbs_status

pnpbs_format_count(count) =
    @ccall $(symbol(:pnpbs_format_count))(count::Ptr{Int32})::pnpbs_status

pnpbs_format_info(index, name, help, binary, elements) =
    @ccall $(symbol(:pnpbs_format_info))(
        index::Int32, name::Ptr{Cstring}, help::Ptr{Cstring}, binary::Ptr{Int32},
        elements::Ptr{Int32})::pnpbs_status

# ---------------------------------------------------------------- domain ---------------------
pnpbs_domain_create(context, dim, domain) =
    @ccall $(symbol(:pnpbs_domain_create))(
        context::pnpbs_context, dim::Int32, domain::Ptr{pnpbs_domain})::pnpbs_status

pnpbs_domain_create_sphere(context, radius, outside, domain) =
    @ccall $(symbol(:pnpbs_domain_create_sphere))(
        context::pnpbs_context, radius::Cdouble, outside::Ptr{Cdouble},
        domain::Ptr{pnpbs_domain})::pnpbs_status

pnpbs_sphere_points(radius, n, degrees, coordinates) =
    @ccall $(symbol(:pnpbs_sphere_points))(
        radius::Cdouble, n::Int64, degrees::Ptr{Cdouble},
        coordinates::Ptr{Cdouble})::pnpbs_status

pnpbs_sphere_degrees(n, coordinates, degrees) =
    @ccall $(symbol(:pnpbs_sphere_degrees))(
        n::Int64, coordinates::Ptr{Cdouble}, degrees::Ptr{Cdouble})::pnpbs_status

pnpbs_domain_destroy(domain) =
    @ccall $(symbol(:pnpbs_domain_destroy))(domain::Ptr{pnpbs_domain})::pnpbs_status

pnpbs_domain_dimension(domain, dim) =
    @ccall $(symbol(:pnpbs_domain_dimension))(
        domain::pnpbs_domain, dim::Ptr{Int32})::pnpbs_status

pnpbs_domain_add_polyline(domain, role, closed, n, coordinates, tags, corner_angle) =
    @ccall $(symbol(:pnpbs_domain_add_polyline))(
        domain::pnpbs_domain, role::Int32, closed::Int32, n::Int64, coordinates::Ptr{Cdouble},
        tags::Ptr{Int32}, corner_angle::Cdouble)::pnpbs_status

pnpbs_domain_add_surface(domain, role, vertices, coordinates, triangles, corners, tags,
                         feature_angle) =
    @ccall $(symbol(:pnpbs_domain_add_surface))(
        domain::pnpbs_domain, role::Int32, vertices::Int64, coordinates::Ptr{Cdouble},
        triangles::Int64, corners::Ptr{Int64}, tags::Ptr{Int32},
        feature_angle::Cdouble)::pnpbs_status

pnpbs_domain_read_surface(domain, role, path, feature_angle) =
    @ccall $(symbol(:pnpbs_domain_read_surface))(
        domain::pnpbs_domain, role::Int32, path::Cstring, feature_angle::Cdouble)::pnpbs_status

pnpbs_domain_set_role(domain, tag, role) =
    @ccall $(symbol(:pnpbs_domain_set_role))(
        domain::pnpbs_domain, tag::Int32, role::Int32)::pnpbs_status

pnpbs_domain_read_msh(domain, path, feature_angle) =
    @ccall $(symbol(:pnpbs_domain_read_msh))(
        domain::pnpbs_domain, path::Cstring, feature_angle::Cdouble)::pnpbs_status

pnpbs_file_dimension(path, dim) =
    @ccall $(symbol(:pnpbs_file_dimension))(path::Cstring, dim::Ptr{Int32})::pnpbs_status

pnpbs_domain_set_tag_name(domain, dim, tag, name) =
    @ccall $(symbol(:pnpbs_domain_set_tag_name))(
        domain::pnpbs_domain, dim::Int32, tag::Int32, name::Cstring)::pnpbs_status

pnpbs_domain_tag_name_count(domain, count) =
    @ccall $(symbol(:pnpbs_domain_tag_name_count))(
        domain::pnpbs_domain, count::Ptr{Int32})::pnpbs_status

pnpbs_domain_get_tag_name(domain, index, dim, tag, name) =
    @ccall $(symbol(:pnpbs_domain_get_tag_name))(
        domain::pnpbs_domain, index::Int32, dim::Ptr{Int32}, tag::Ptr{Int32},
        name::Ptr{Cstring})::pnpbs_status

pnpbs_domain_add_box(domain, low, high, tag) =
    @ccall $(symbol(:pnpbs_domain_add_box))(
        domain::pnpbs_domain, low::Ptr{Cdouble}, high::Ptr{Cdouble}, tag::Int32)::pnpbs_status

pnpbs_domain_add_ball(domain, centre, radius, tag) =
    @ccall $(symbol(:pnpbs_domain_add_ball))(
        domain::pnpbs_domain, centre::Ptr{Cdouble}, radius::Cdouble, tag::Int32)::pnpbs_status

pnpbs_domain_add_cylinder(domain, from, to, radius, tag) =
    @ccall $(symbol(:pnpbs_domain_add_cylinder))(
        domain::pnpbs_domain, from::Ptr{Cdouble}, to::Ptr{Cdouble}, radius::Cdouble,
        tag::Int32)::pnpbs_status

pnpbs_domain_add_box_surface(domain, role, low, high, tag) =
    @ccall $(symbol(:pnpbs_domain_add_box_surface))(
        domain::pnpbs_domain, role::Int32, low::Ptr{Cdouble}, high::Ptr{Cdouble},
        tag::Int32)::pnpbs_status

pnpbs_domain_add_ball_surface(domain, role, centre, radius, tag) =
    @ccall $(symbol(:pnpbs_domain_add_ball_surface))(
        domain::pnpbs_domain, role::Int32, centre::Ptr{Cdouble}, radius::Cdouble,
        tag::Int32)::pnpbs_status

pnpbs_domain_add_cylinder_surface(domain, role, from, to, radius, tag) =
    @ccall $(symbol(:pnpbs_domain_add_cylinder_surface))(
        domain::pnpbs_domain, role::Int32, from::Ptr{Cdouble}, to::Ptr{Cdouble}, radius::Cdouble,
        tag::Int32)::pnpbs_status

pnpbs_domain_add_level_set(domain, level_set, user, low, high, resolution, tag) =
    @ccall $(symbol(:pnpbs_domain_add_level_set))(
        domain::pnpbs_domain, level_set::pnpbs_level_set_fn, user::Ptr{Cvoid}, low::Ptr{Cdouble},
        high::Ptr{Cdouble}, resolution::Cdouble, tag::Int32)::pnpbs_status

pnpbs_domain_add_arc(domain, role, centre, radius, from, to, tag) =
    @ccall $(symbol(:pnpbs_domain_add_arc))(
        domain::pnpbs_domain, role::Int32, centre::Ptr{Cdouble}, radius::Cdouble,
        from::Cdouble, to::Cdouble, tag::Int32)::pnpbs_status

pnpbs_domain_add_curve(domain, role, curve, user, from, to, tag) =
    @ccall $(symbol(:pnpbs_domain_add_curve))(
        domain::pnpbs_domain, role::Int32, curve::pnpbs_curve_fn, user::Ptr{Cvoid},
        from::Cdouble, to::Cdouble, tag::Int32)::pnpbs_status

pnpbs_domain_add_pslg(domain, vertices, coordinates, vertex_tags, segments, segment_ends,
                      segment_tags, holes, hole_points) =
    @ccall $(symbol(:pnpbs_domain_add_pslg))(
        domain::pnpbs_domain, vertices::Int64, coordinates::Ptr{Cdouble}, vertex_tags::Ptr{Int32},
        segments::Int64, segment_ends::Ptr{Int64}, segment_tags::Ptr{Int32}, holes::Int64,
        hole_points::Ptr{Cdouble})::pnpbs_status

pnpbs_domain_set_filled(domain, filled) =
    @ccall $(symbol(:pnpbs_domain_set_filled))(
        domain::pnpbs_domain, filled::Int32)::pnpbs_status

pnpbs_domain_set_repair(domain, resolution) =
    @ccall $(symbol(:pnpbs_domain_set_repair))(
        domain::pnpbs_domain, resolution::Cdouble)::pnpbs_status

pnpbs_domain_set_periodic(domain, low, high, periodic, tags) =
    @ccall $(symbol(:pnpbs_domain_set_periodic))(
        domain::pnpbs_domain, low::Ptr{Cdouble}, high::Ptr{Cdouble}, periodic::Ptr{Int32},
        tags::Ptr{Int32})::pnpbs_status

pnpbs_domain_set_fragment(domain, overlap) =
    @ccall $(symbol(:pnpbs_domain_set_fragment))(
        domain::pnpbs_domain, overlap::Int32)::pnpbs_status

pnpbs_domain_set_resurfaced(domain, resolution) =
    @ccall $(symbol(:pnpbs_domain_set_resurfaced))(
        domain::pnpbs_domain, resolution::Cdouble)::pnpbs_status

pnpbs_domain_add_hole(domain, point) =
    @ccall $(symbol(:pnpbs_domain_add_hole))(
        domain::pnpbs_domain, point::Ptr{Cdouble})::pnpbs_status

pnpbs_domain_add_region(domain, point, tag) =
    @ccall $(symbol(:pnpbs_domain_add_region))(
        domain::pnpbs_domain, point::Ptr{Cdouble}, tag::Int32)::pnpbs_status

pnpbs_domain_add_fixed_nodes(domain, n, coordinates, tags) =
    @ccall $(symbol(:pnpbs_domain_add_fixed_nodes))(
        domain::pnpbs_domain, n::Int64, coordinates::Ptr{Cdouble}, tags::Ptr{Int32})::pnpbs_status

pnpbs_domain_read_poly(domain, path) =
    @ccall $(symbol(:pnpbs_domain_read_poly))(
        domain::pnpbs_domain, path::Cstring)::pnpbs_status

pnpbs_domain_parse_poly(domain, text, length, name) =
    @ccall $(symbol(:pnpbs_domain_parse_poly))(
        domain::pnpbs_domain, text::Ptr{UInt8}, length::Int64, name::Cstring)::pnpbs_status

pnpbs_domain_tag_outline(domain, level_set, user, tag, count) =
    @ccall $(symbol(:pnpbs_domain_tag_outline))(
        domain::pnpbs_domain, level_set::pnpbs_level_set_fn, user::Ptr{Cvoid}, tag::Int32,
        count::Ptr{Int64})::pnpbs_status

pnpbs_domain_set_corner_angle(domain, corner_angle) =
    @ccall $(symbol(:pnpbs_domain_set_corner_angle))(
        domain::pnpbs_domain, corner_angle::Cdouble)::pnpbs_status

pnpbs_domain_set_snap(domain, length) =
    @ccall $(symbol(:pnpbs_domain_set_snap))(
        domain::pnpbs_domain, length::Cdouble)::pnpbs_status

pnpbs_domain_simplify(domain, spacing, user, tolerance, smallest, vertices, curves) =
    @ccall $(symbol(:pnpbs_domain_simplify))(
        domain::pnpbs_domain, spacing::pnpbs_spacing_fn, user::Ptr{Cvoid}, tolerance::Cdouble,
        smallest::Cdouble, vertices::Ptr{Int64}, curves::Ptr{Int64})::pnpbs_status

pnpbs_domain_simplify_by_file(domain, path, field, tolerance, smallest, vertices, curves) =
    @ccall $(symbol(:pnpbs_domain_simplify_by_file))(
        domain::pnpbs_domain, path::Cstring, field::Cstring, tolerance::Cdouble, smallest::Cdouble,
        vertices::Ptr{Int64}, curves::Ptr{Int64})::pnpbs_status

pnpbs_domain_add_offset(domain, body, low, high, spacing, user, resolution, tag) =
    @ccall $(symbol(:pnpbs_domain_add_offset))(
        domain::pnpbs_domain, body::pnpbs_domain, low::Cdouble, high::Cdouble,
        spacing::pnpbs_spacing_fn, user::Ptr{Cvoid}, resolution::Cdouble,
        tag::Int32)::pnpbs_status

pnpbs_domain_check(domain) =
    @ccall $(symbol(:pnpbs_domain_check))(domain::pnpbs_domain)::pnpbs_status

pnpbs_domain_bounds(domain, low, high) =
    @ccall $(symbol(:pnpbs_domain_bounds))(
        domain::pnpbs_domain, low::Ptr{Cdouble}, high::Ptr{Cdouble})::pnpbs_status

pnpbs_domain_measure(domain, measure) =
    @ccall $(symbol(:pnpbs_domain_measure))(
        domain::pnpbs_domain, measure::Ptr{Cdouble})::pnpbs_status

pnpbs_domain_distance(domain, tag, n, coordinates, distances) =
    @ccall $(symbol(:pnpbs_domain_distance))(
        domain::pnpbs_domain, tag::Int32, n::Int64, coordinates::Ptr{Cdouble},
        distances::Ptr{Cdouble})::pnpbs_status

pnpbs_domain_regions_at(domain, n, coordinates, columns, tags) =
    @ccall $(symbol(:pnpbs_domain_regions_at))(
        domain::pnpbs_domain, n::Int64, coordinates::Ptr{Cdouble}, columns::Int32,
        tags::Ptr{Int32})::pnpbs_status

pnpbs_domain_shape_spacing(domain, nodes_per_turn, nodes_across, nodes_per_edge, growth, n,
                           coordinates, d) =
    @ccall $(symbol(:pnpbs_domain_shape_spacing))(
        domain::pnpbs_domain, nodes_per_turn::Cdouble, nodes_across::Cdouble,
        nodes_per_edge::Cdouble, growth::Cdouble, n::Int64, coordinates::Ptr{Cdouble},
        d::Ptr{Cdouble})::pnpbs_status

pnpbs_domain_get_segments(domain, capacity, count, segments, tags) =
    @ccall $(symbol(:pnpbs_domain_get_segments))(
        domain::pnpbs_domain, capacity::Int64, count::Ptr{Int64}, segments::Ptr{Cdouble},
        tags::Ptr{Int32})::pnpbs_status

# ---------------------------------------------------------------- placement ------------------
pnpbs_placement_create(context, domain, placement) =
    @ccall $(symbol(:pnpbs_placement_create))(
        context::pnpbs_context, domain::pnpbs_domain,
        placement::Ptr{pnpbs_placement})::pnpbs_status

pnpbs_placement_destroy(placement) =
    @ccall $(symbol(:pnpbs_placement_destroy))(
        placement::Ptr{pnpbs_placement})::pnpbs_status

pnpbs_placement_set(placement, key, value) =
    @ccall $(symbol(:pnpbs_placement_set))(
        placement::pnpbs_placement, key::Cstring, value::Cstring)::pnpbs_status

pnpbs_placement_set_int64(placement, key, value) =
    @ccall $(symbol(:pnpbs_placement_set_int64))(
        placement::pnpbs_placement, key::Cstring, value::Int64)::pnpbs_status

pnpbs_placement_set_double(placement, key, value) =
    @ccall $(symbol(:pnpbs_placement_set_double))(
        placement::pnpbs_placement, key::Cstring, value::Cdouble)::pnpbs_status

pnpbs_placement_set_spacing_constant(placement, d) =
    @ccall $(symbol(:pnpbs_placement_set_spacing_constant))(
        placement::pnpbs_placement, d::Cdouble)::pnpbs_status

pnpbs_placement_set_spacing_callback(placement, spacing, user) =
    @ccall $(symbol(:pnpbs_placement_set_spacing_callback))(
        placement::pnpbs_placement, spacing::pnpbs_spacing_fn,
        user::Ptr{Cvoid})::pnpbs_status

pnpbs_placement_set_spacing_grid(placement, size, origin, step, values) =
    @ccall $(symbol(:pnpbs_placement_set_spacing_grid))(
        placement::pnpbs_placement, size::Ptr{Int64}, origin::Ptr{Cdouble},
        step::Ptr{Cdouble}, values::Ptr{Cdouble})::pnpbs_status

pnpbs_placement_set_spacing_mesh(placement, n, coordinates, d, elements, corners) =
    @ccall $(symbol(:pnpbs_placement_set_spacing_mesh))(
        placement::pnpbs_placement, n::Int64, coordinates::Ptr{Cdouble}, d::Ptr{Cdouble},
        elements::Int64, corners::Ptr{Int64})::pnpbs_status

pnpbs_placement_set_spacing_points(placement, n, coordinates, d) =
    @ccall $(symbol(:pnpbs_placement_set_spacing_points))(
        placement::pnpbs_placement, n::Int64, coordinates::Ptr{Cdouble},
        d::Ptr{Cdouble})::pnpbs_status

pnpbs_placement_set_spacing_file(placement, path, field) =
    @ccall $(symbol(:pnpbs_placement_set_spacing_file))(
        placement::pnpbs_placement, path::Cstring, field::Cstring)::pnpbs_status

pnpbs_placement_set_spacing_from_shape(placement, nodes_per_turn, nodes_across, nodes_per_edge,
                                       growth, min_spacing, max_spacing) =
    @ccall $(symbol(:pnpbs_placement_set_spacing_from_shape))(
        placement::pnpbs_placement, nodes_per_turn::Cdouble, nodes_across::Cdouble,
        nodes_per_edge::Cdouble, growth::Cdouble, min_spacing::Cdouble,
        max_spacing::Cdouble)::pnpbs_status

pnpbs_placement_set_spacing_at_nodes(placement, n, d) =
    @ccall $(symbol(:pnpbs_placement_set_spacing_at_nodes))(
        placement::pnpbs_placement, n::Int64, d::Ptr{Cdouble})::pnpbs_status

pnpbs_placement_add_spacing_hints(placement, n, coordinates) =
    @ccall $(symbol(:pnpbs_placement_add_spacing_hints))(
        placement::pnpbs_placement, n::Int64, coordinates::Ptr{Cdouble})::pnpbs_status

pnpbs_placement_set_monitor(placement, monitor, user) =
    @ccall $(symbol(:pnpbs_placement_set_monitor))(
        placement::pnpbs_placement, monitor::pnpbs_monitor_fn,
        user::Ptr{Cvoid})::pnpbs_status

pnpbs_placement_set_nodes(placement, n, coordinates, ids) =
    @ccall $(symbol(:pnpbs_placement_set_nodes))(
        placement::pnpbs_placement, n::Int64, coordinates::Ptr{Cdouble},
        ids::Ptr{Int64})::pnpbs_status

pnpbs_placement_estimate(placement, nodes, bytes, seconds) =
    @ccall $(symbol(:pnpbs_placement_estimate))(
        placement::pnpbs_placement, nodes::Ptr{Int64}, bytes::Ptr{Int64},
        seconds::Ptr{Cdouble})::pnpbs_status

pnpbs_placement_initialise(placement) =
    @ccall $(symbol(:pnpbs_placement_initialise))(placement::pnpbs_placement)::pnpbs_status

pnpbs_placement_step(placement, n) =
    @ccall $(symbol(:pnpbs_placement_step))(
        placement::pnpbs_placement, n::Int64)::pnpbs_status

pnpbs_placement_adjust_population(placement, inserted, deleted) =
    @ccall $(symbol(:pnpbs_placement_adjust_population))(
        placement::pnpbs_placement, inserted::Ptr{Int64}, deleted::Ptr{Int64})::pnpbs_status

pnpbs_placement_rebalance(placement) =
    @ccall $(symbol(:pnpbs_placement_rebalance))(placement::pnpbs_placement)::pnpbs_status

pnpbs_placement_run(placement) =
    @ccall $(symbol(:pnpbs_placement_run))(placement::pnpbs_placement)::pnpbs_status

pnpbs_placement_dimension(placement, dim) =
    @ccall $(symbol(:pnpbs_placement_dimension))(
        placement::pnpbs_placement, dim::Ptr{Int32})::pnpbs_status

pnpbs_placement_sphere_radius(placement, radius) =
    @ccall $(symbol(:pnpbs_placement_sphere_radius))(
        placement::pnpbs_placement, radius::Ptr{Cdouble})::pnpbs_status

pnpbs_placement_count(placement, nodes) =
    @ccall $(symbol(:pnpbs_placement_count))(
        placement::pnpbs_placement, nodes::Ptr{Int64})::pnpbs_status

pnpbs_placement_get_nodes(placement, capacity, coordinates, ids, tags, spacing) =
    @ccall $(symbol(:pnpbs_placement_get_nodes))(
        placement::pnpbs_placement, capacity::Int64, coordinates::Ptr{Cdouble}, ids::Ptr{Int64},
        tags::Ptr{Int32}, spacing::Ptr{Cdouble})::pnpbs_status

pnpbs_placement_ghost_count(placement, ghosts) =
    @ccall $(symbol(:pnpbs_placement_ghost_count))(
        placement::pnpbs_placement, ghosts::Ptr{Int64})::pnpbs_status

pnpbs_placement_get_ghosts(placement, capacity, coordinates, ids, tags, spacing, owners) =
    @ccall $(symbol(:pnpbs_placement_get_ghosts))(
        placement::pnpbs_placement, capacity::Int64, coordinates::Ptr{Cdouble}, ids::Ptr{Int64},
        tags::Ptr{Int32}, spacing::Ptr{Cdouble}, owners::Ptr{Int32})::pnpbs_status

pnpbs_placement_exchange_sizes(placement, neighbours, sends, receives) =
    @ccall $(symbol(:pnpbs_placement_exchange_sizes))(
        placement::pnpbs_placement, neighbours::Ptr{Int32}, sends::Ptr{Int64},
        receives::Ptr{Int64})::pnpbs_status

pnpbs_placement_get_exchange(placement, neighbours, sends, receives, ranks, send_offsets,
                             send_nodes, receive_offsets, receive_nodes) =
    @ccall $(symbol(:pnpbs_placement_get_exchange))(
        placement::pnpbs_placement, neighbours::Int32, sends::Int64, receives::Int64,
        ranks::Ptr{Int32}, send_offsets::Ptr{Int64}, send_nodes::Ptr{Int64},
        receive_offsets::Ptr{Int64}, receive_nodes::Ptr{Int64})::pnpbs_status

pnpbs_placement_get_numbering(placement, capacity, first, count, ghost_numbers) =
    @ccall $(symbol(:pnpbs_placement_get_numbering))(
        placement::pnpbs_placement, capacity::Int64, first::Ptr{Int64}, count::Ptr{Int64},
        ghost_numbers::Ptr{Int64})::pnpbs_status

pnpbs_placement_update_ghosts(placement, n, components, values) =
    @ccall $(symbol(:pnpbs_placement_update_ghosts))(
        placement::pnpbs_placement, n::Int64, components::Int32,
        values::Ptr{Cdouble})::pnpbs_status

pnpbs_placement_begin_update_ghosts(placement, n, components, values) =
    @ccall $(symbol(:pnpbs_placement_begin_update_ghosts))(
        placement::pnpbs_placement, n::Int64, components::Int32,
        values::Ptr{Cdouble})::pnpbs_status

pnpbs_placement_end_update_ghosts(placement, n, components, values) =
    @ccall $(symbol(:pnpbs_placement_end_update_ghosts))(
        placement::pnpbs_placement, n::Int64, components::Int32,
        values::Ptr{Cdouble})::pnpbs_status

pnpbs_placement_add_from_ghosts(placement, n, components, values) =
    @ccall $(symbol(:pnpbs_placement_add_from_ghosts))(
        placement::pnpbs_placement, n::Int64, components::Int32,
        values::Ptr{Cdouble})::pnpbs_status

pnpbs_placement_sum(placement, n, components, values, sums) =
    @ccall $(symbol(:pnpbs_placement_sum))(
        placement::pnpbs_placement, n::Int64, components::Int32, values::Ptr{Cdouble},
        sums::Ptr{Cdouble})::pnpbs_status

pnpbs_placement_dot(placement, n, components, x, y, products) =
    @ccall $(symbol(:pnpbs_placement_dot))(
        placement::pnpbs_placement, n::Int64, components::Int32, x::Ptr{Cdouble},
        y::Ptr{Cdouble}, products::Ptr{Cdouble})::pnpbs_status

pnpbs_placement_adjacency_size(placement, entries) =
    @ccall $(symbol(:pnpbs_placement_adjacency_size))(
        placement::pnpbs_placement, entries::Ptr{Int64})::pnpbs_status

pnpbs_placement_get_adjacency(placement, capacity, offsets, neighbours) =
    @ccall $(symbol(:pnpbs_placement_get_adjacency))(
        placement::pnpbs_placement, capacity::Int64, offsets::Ptr{Int64},
        neighbours::Ptr{Int64})::pnpbs_status

pnpbs_placement_star_size(placement, entries) =
    @ccall $(symbol(:pnpbs_placement_star_size))(
        placement::pnpbs_placement, entries::Ptr{Int64})::pnpbs_status

pnpbs_placement_get_stars(placement, capacity, offsets, neighbours, triangle) =
    @ccall $(symbol(:pnpbs_placement_get_stars))(
        placement::pnpbs_placement, capacity::Int64, offsets::Ptr{Int64},
        neighbours::Ptr{Int64}, triangle::Ptr{Int8})::pnpbs_status

pnpbs_placement_get_triangles(placement, capacity, count, triangles) =
    @ccall $(symbol(:pnpbs_placement_get_triangles))(
        placement::pnpbs_placement, capacity::Int64, count::Ptr{Int64},
        triangles::Ptr{Int64})::pnpbs_status

pnpbs_placement_get_tetrahedra(placement, capacity, count, tetrahedra) =
    @ccall $(symbol(:pnpbs_placement_get_tetrahedra))(
        placement::pnpbs_placement, capacity::Int64, count::Ptr{Int64},
        tetrahedra::Ptr{Int64})::pnpbs_status

pnpbs_placement_get_edges(placement, capacity, count, straight, ends, numbers, midpoints) =
    @ccall $(symbol(:pnpbs_placement_get_edges))(
        placement::pnpbs_placement, capacity::Int64, count::Ptr{Int64}, straight::Ptr{Int64},
        ends::Ptr{Int64}, numbers::Ptr{Int64}, midpoints::Ptr{Float64})::pnpbs_status

pnpbs_placement_find_edges(placement, n, corners, cells, edges) =
    @ccall $(symbol(:pnpbs_placement_find_edges))(
        placement::pnpbs_placement, n::Int64, corners::Int32, cells::Ptr{Int64},
        edges::Ptr{Int64})::pnpbs_status

pnpbs_placement_get_element_tags(placement, capacity, count, tags) =
    @ccall $(symbol(:pnpbs_placement_get_element_tags))(
        placement::pnpbs_placement, capacity::Int64, count::Ptr{Int64},
        tags::Ptr{Int32})::pnpbs_status

pnpbs_placement_get_incident_elements(placement, capacity, count, corners, elements) =
    @ccall $(symbol(:pnpbs_placement_get_incident_elements))(
        placement::pnpbs_placement, capacity::Int64, count::Ptr{Int64}, corners::Ptr{Int32},
        elements::Ptr{Int64})::pnpbs_status

pnpbs_placement_get_normals(placement, capacity, normals) =
    @ccall $(symbol(:pnpbs_placement_get_normals))(
        placement::pnpbs_placement, capacity::Int64, normals::Ptr{Cdouble})::pnpbs_status

pnpbs_placement_set_cracks(placement, n, tags) =
    @ccall $(symbol(:pnpbs_placement_set_cracks))(
        placement::pnpbs_placement, n::Int32, tags::Ptr{Int32})::pnpbs_status

pnpbs_placement_get_crack_nodes(placement, capacity, count, all, nodes, numbers) =
    @ccall $(symbol(:pnpbs_placement_get_crack_nodes))(
        placement::pnpbs_placement, capacity::Int64, count::Ptr{Int64}, all::Ptr{Int64},
        nodes::Ptr{Int64}, numbers::Ptr{Int64})::pnpbs_status

pnpbs_placement_get_cracked_elements(placement, capacity, count, elements) =
    @ccall $(symbol(:pnpbs_placement_get_cracked_elements))(
        placement::pnpbs_placement, capacity::Int64, count::Ptr{Int64},
        elements::Ptr{Int64})::pnpbs_status

pnpbs_placement_get_crack_facets(placement, capacity, count, covered, front, back, tags) =
    @ccall $(symbol(:pnpbs_placement_get_crack_facets))(
        placement::pnpbs_placement, capacity::Int64, count::Ptr{Int64}, covered::Ptr{Cdouble},
        front::Ptr{Int64}, back::Ptr{Int64}, tags::Ptr{Int32})::pnpbs_status

pnpbs_placement_get_boundary_triangles(placement, capacity, count, triangles, tags) =
    @ccall $(symbol(:pnpbs_placement_get_boundary_triangles))(
        placement::pnpbs_placement, capacity::Int64, count::Ptr{Int64}, triangles::Ptr{Int64},
        tags::Ptr{Int32})::pnpbs_status

pnpbs_placement_get_boundary_edges(placement, capacity, count, edges, tags) =
    @ccall $(symbol(:pnpbs_placement_get_boundary_edges))(
        placement::pnpbs_placement, capacity::Int64, count::Ptr{Int64}, edges::Ptr{Int64},
        tags::Ptr{Int32})::pnpbs_status

pnpbs_placement_check(placement) =
    @ccall $(symbol(:pnpbs_placement_check))(placement::pnpbs_placement)::pnpbs_status

pnpbs_placement_get_int64(placement, key, value) =
    @ccall $(symbol(:pnpbs_placement_get_int64))(
        placement::pnpbs_placement, key::Cstring, value::Ptr{Int64})::pnpbs_status

pnpbs_placement_get_double(placement, key, value) =
    @ccall $(symbol(:pnpbs_placement_get_double))(
        placement::pnpbs_placement, key::Cstring, value::Ptr{Cdouble})::pnpbs_status

pnpbs_placement_get_string(placement, key, value) =
    @ccall $(symbol(:pnpbs_placement_get_string))(
        placement::pnpbs_placement, key::Cstring, value::Ptr{Cstring})::pnpbs_status

pnpbs_placement_get_edge_bands(placement, capacity, count, d_from, d_to, edges, mean,
                               deviation) =
    @ccall $(symbol(:pnpbs_placement_get_edge_bands))(
        placement::pnpbs_placement, capacity::Int64, count::Ptr{Int64}, d_from::Ptr{Cdouble},
        d_to::Ptr{Cdouble}, edges::Ptr{Int64}, mean::Ptr{Cdouble},
        deviation::Ptr{Cdouble})::pnpbs_status

pnpbs_placement_get_regions(placement, capacity, count, tags, nodes, elements, measures) =
    @ccall $(symbol(:pnpbs_placement_get_regions))(
        placement::pnpbs_placement, capacity::Int64, count::Ptr{Int64}, tags::Ptr{Int32},
        nodes::Ptr{Int64}, elements::Ptr{Int64}, measures::Ptr{Cdouble})::pnpbs_status

pnpbs_placement_get_cell_bands(placement, measure, capacity, count, d_from, d_to, number, mean,
                               worst) =
    @ccall $(symbol(:pnpbs_placement_get_cell_bands))(
        placement::pnpbs_placement, measure::Cstring, capacity::Int64, count::Ptr{Int64},
        d_from::Ptr{Cdouble}, d_to::Ptr{Cdouble}, number::Ptr{Int64}, mean::Ptr{Cdouble},
        worst::Ptr{Cdouble})::pnpbs_status

pnpbs_placement_warning_count(placement, count) =
    @ccall $(symbol(:pnpbs_placement_warning_count))(
        placement::pnpbs_placement, count::Ptr{Int32})::pnpbs_status

pnpbs_placement_get_warning(placement, index, text) =
    @ccall $(symbol(:pnpbs_placement_get_warning))(
        placement::pnpbs_placement, index::Int32, text::Ptr{Cstring})::pnpbs_status

pnpbs_placement_get_warning_data(placement, index, code, count, value, point) =
    @ccall $(symbol(:pnpbs_placement_get_warning_data))(
        placement::pnpbs_placement, index::Int32, code::Ptr{Int32}, count::Ptr{Int64},
        value::Ptr{Cdouble}, point::Ptr{Cdouble})::pnpbs_status

# ---------------------------------------------------------------- transfer -------------------
pnpbs_transfer_create(placement, n, components, values, transfer) =
    @ccall $(symbol(:pnpbs_transfer_create))(
        placement::pnpbs_placement, n::Int64, components::Int32, values::Ptr{Cdouble},
        transfer::Ptr{pnpbs_transfer})::pnpbs_status

pnpbs_transfer_create_second_order(placement, n, components, values, transfer) =
    @ccall $(symbol(:pnpbs_transfer_create_second_order))(
        placement::pnpbs_placement, n::Int64, components::Int32, values::Ptr{Cdouble},
        transfer::Ptr{pnpbs_transfer})::pnpbs_status

pnpbs_transfer_order(transfer, order, linear_nodes) =
    @ccall $(symbol(:pnpbs_transfer_order))(
        transfer::pnpbs_transfer, order::Ptr{Int32}, linear_nodes::Ptr{Int64})::pnpbs_status

pnpbs_transfer_destroy(transfer) =
    @ccall $(symbol(:pnpbs_transfer_destroy))(transfer::Ptr{pnpbs_transfer})::pnpbs_status

pnpbs_transfer_sizes(transfer, dim, components) =
    @ccall $(symbol(:pnpbs_transfer_sizes))(
        transfer::pnpbs_transfer, dim::Ptr{Int32}, components::Ptr{Int32})::pnpbs_status

pnpbs_transfer_at_nodes(transfer, placement, conserve, capacity, values) =
    @ccall $(symbol(:pnpbs_transfer_at_nodes))(
        transfer::pnpbs_transfer, placement::pnpbs_placement, conserve::Int32,
        capacity::Int64, values::Ptr{Cdouble})::pnpbs_status

pnpbs_transfer_at_points(transfer, n, coordinates, values) =
    @ccall $(symbol(:pnpbs_transfer_at_points))(
        transfer::pnpbs_transfer, n::Int64, coordinates::Ptr{Cdouble},
        values::Ptr{Cdouble})::pnpbs_status

# ---------------------------------------------------------------- distributed mesh -----------
pnpbs_mesh_create(placement, ghost_layers, mesh) =
    @ccall $(symbol(:pnpbs_mesh_create))(
        placement::pnpbs_placement, ghost_layers::Int32, mesh::Ptr{pnpbs_mesh})::pnpbs_status

pnpbs_mesh_destroy(mesh) =
    @ccall $(symbol(:pnpbs_mesh_destroy))(mesh::Ptr{pnpbs_mesh})::pnpbs_status

pnpbs_mesh_sizes(mesh, dim, corners, owned_nodes, nodes, owned_elements, elements, facets) =
    @ccall $(symbol(:pnpbs_mesh_sizes))(
        mesh::pnpbs_mesh, dim::Ptr{Int32}, corners::Ptr{Int32}, owned_nodes::Ptr{Int64},
        nodes::Ptr{Int64}, owned_elements::Ptr{Int64}, elements::Ptr{Int64},
        facets::Ptr{Int64})::pnpbs_status

pnpbs_mesh_numbering(mesh, first_node, all_nodes, first_element, all_elements) =
    @ccall $(symbol(:pnpbs_mesh_numbering))(
        mesh::pnpbs_mesh, first_node::Ptr{Int64}, all_nodes::Ptr{Int64},
        first_element::Ptr{Int64}, all_elements::Ptr{Int64})::pnpbs_status

pnpbs_mesh_get_nodes(mesh, capacity, coordinates, numbers, ids, owners, tags) =
    @ccall $(symbol(:pnpbs_mesh_get_nodes))(
        mesh::pnpbs_mesh, capacity::Int64, coordinates::Ptr{Cdouble}, numbers::Ptr{Int64},
        ids::Ptr{Int64}, owners::Ptr{Int32}, tags::Ptr{Int32})::pnpbs_status

pnpbs_mesh_get_elements(mesh, capacity, nodes, numbers, owners, tags) =
    @ccall $(symbol(:pnpbs_mesh_get_elements))(
        mesh::pnpbs_mesh, capacity::Int64, nodes::Ptr{Int32}, numbers::Ptr{Int64},
        owners::Ptr{Int32}, tags::Ptr{Int32})::pnpbs_status

pnpbs_mesh_get_connectivity(mesh, capacity, numbers) =
    @ccall $(symbol(:pnpbs_mesh_get_connectivity))(
        mesh::pnpbs_mesh, capacity::Int64, numbers::Ptr{Int64})::pnpbs_status

pnpbs_mesh_get_connectivity_int32(mesh, capacity, numbers) =
    @ccall $(symbol(:pnpbs_mesh_get_connectivity_int32))(
        mesh::pnpbs_mesh, capacity::Int64, numbers::Ptr{Int32})::pnpbs_status

pnpbs_mesh_get_facets(mesh, capacity, nodes, tags, elements, opposite, inner, owners) =
    @ccall $(symbol(:pnpbs_mesh_get_facets))(
        mesh::pnpbs_mesh, capacity::Int64, nodes::Ptr{Int32}, tags::Ptr{Int32},
        elements::Ptr{Int32}, opposite::Ptr{Int32}, inner::Ptr{Int8},
        owners::Ptr{Int32})::pnpbs_status

pnpbs_mesh_sharing_sizes(mesh, nodes, entries) =
    @ccall $(symbol(:pnpbs_mesh_sharing_sizes))(
        mesh::pnpbs_mesh, nodes::Ptr{Int64}, entries::Ptr{Int64})::pnpbs_status

pnpbs_mesh_get_sharing(mesh, nodes, entries, shared, offsets, ranks) =
    @ccall $(symbol(:pnpbs_mesh_get_sharing))(
        mesh::pnpbs_mesh, nodes::Int64, entries::Int64, shared::Ptr{Int32},
        offsets::Ptr{Int64}, ranks::Ptr{Int32})::pnpbs_status

pnpbs_mesh_write(mesh, prefix) =
    @ccall $(symbol(:pnpbs_mesh_write))(mesh::pnpbs_mesh, prefix::Cstring)::pnpbs_status

# ---------------------------------------------------------------- Voronoi cells --------------
pnpbs_voronoi_create(placement, voronoi) =
    @ccall $(symbol(:pnpbs_voronoi_create))(
        placement::pnpbs_placement, voronoi::Ptr{pnpbs_voronoi})::pnpbs_status

pnpbs_voronoi_destroy(voronoi) =
    @ccall $(symbol(:pnpbs_voronoi_destroy))(voronoi::Ptr{pnpbs_voronoi})::pnpbs_status

pnpbs_voronoi_sizes(voronoi, dim, nodes, faces) =
    @ccall $(symbol(:pnpbs_voronoi_sizes))(
        voronoi::pnpbs_voronoi, dim::Ptr{Int32}, nodes::Ptr{Int64},
        faces::Ptr{Int64})::pnpbs_status

pnpbs_voronoi_get_cells(voronoi, capacity, volumes, boundary) =
    @ccall $(symbol(:pnpbs_voronoi_get_cells))(
        voronoi::pnpbs_voronoi, capacity::Int64, volumes::Ptr{Cdouble},
        boundary::Ptr{Cdouble})::pnpbs_status

pnpbs_voronoi_get_faces(voronoi, nodes, faces, offsets, ids, numbers, areas, distances, normals) =
    @ccall $(symbol(:pnpbs_voronoi_get_faces))(
        voronoi::pnpbs_voronoi, nodes::Int64, faces::Int64, offsets::Ptr{Int64}, ids::Ptr{Int64},
        numbers::Ptr{Int64}, areas::Ptr{Cdouble}, distances::Ptr{Cdouble},
        normals::Ptr{Cdouble})::pnpbs_status

# ---------------------------------------------------------------- particles ------------------
pnpbs_particles_create(placement, body, particles) =
    @ccall $(symbol(:pnpbs_particles_create))(
        placement::pnpbs_placement, body::pnpbs_domain,
        particles::Ptr{pnpbs_particles})::pnpbs_status

pnpbs_particles_destroy(particles) =
    @ccall $(symbol(:pnpbs_particles_destroy))(particles::Ptr{pnpbs_particles})::pnpbs_status

pnpbs_particles_sizes(particles, dim, count, all) =
    @ccall $(symbol(:pnpbs_particles_sizes))(
        particles::pnpbs_particles, dim::Ptr{Int32}, count::Ptr{Int64},
        all::Ptr{Int64})::pnpbs_status

pnpbs_particles_figures(particles, left_out, moved, closest) =
    @ccall $(symbol(:pnpbs_particles_figures))(
        particles::pnpbs_particles, left_out::Ptr{Int64}, moved::Ptr{Int64},
        closest::Ptr{Cdouble})::pnpbs_status

pnpbs_particles_get(particles, capacity, x, volumes, spacing, ids, tags) =
    @ccall $(symbol(:pnpbs_particles_get))(
        particles::pnpbs_particles, capacity::Int64, x::Ptr{Cdouble}, volumes::Ptr{Cdouble},
        spacing::Ptr{Cdouble}, ids::Ptr{Int64}, tags::Ptr{Int32})::pnpbs_status

pnpbs_particles_add_output_field(particles, name, n, components, values) =
    @ccall $(symbol(:pnpbs_particles_add_output_field))(
        particles::pnpbs_particles, name::Cstring, n::Int64, components::Int32,
        values::Ptr{Cdouble})::pnpbs_status

pnpbs_particles_write(particles, n, paths, formats) =
    @ccall $(symbol(:pnpbs_particles_write))(
        particles::pnpbs_particles, n::Int32, paths::Ptr{Cstring},
        formats::Ptr{Cstring})::pnpbs_status

# ---------------------------------------------------------------- files ----------------------
pnpbs_placement_write(placement, path, elements) =
    @ccall $(symbol(:pnpbs_placement_write))(
        placement::pnpbs_placement, path::Cstring, elements::Int32)::pnpbs_status

pnpbs_placement_write_files(placement, n, paths, formats, elements) =
    @ccall $(symbol(:pnpbs_placement_write_files))(
        placement::pnpbs_placement, n::Int32, paths::Ptr{Cstring}, formats::Ptr{Cstring},
        elements::Ptr{Int32})::pnpbs_status

pnpbs_placement_add_output_field(placement, name, n, components, values) =
    @ccall $(symbol(:pnpbs_placement_add_output_field))(
        placement::pnpbs_placement, name::Cstring, n::Int64, components::Int32,
        values::Ptr{Cdouble})::pnpbs_status

pnpbs_placement_clear_output_fields(placement) =
    @ccall $(symbol(:pnpbs_placement_clear_output_fields))(
        placement::pnpbs_placement)::pnpbs_status

pnpbs_placement_write_checkpoint(placement, path) =
    @ccall $(symbol(:pnpbs_placement_write_checkpoint))(
        placement::pnpbs_placement, path::Cstring)::pnpbs_status

pnpbs_placement_read_checkpoint(placement, path) =
    @ccall $(symbol(:pnpbs_placement_read_checkpoint))(
        placement::pnpbs_placement, path::Cstring)::pnpbs_status

pnpbs_discard_unfinished_files() =
    @ccall $(symbol(:pnpbs_discard_unfinished_files))()::pnpbs_status

end
