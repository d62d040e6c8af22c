# SPDX-License-Identifier: BSD-3-Clause
"""The unmodified C interface. `library()` returns an object with one function for each function of
`pnpbs.h`, with the same name and arguments, as documented in that header. The only conversions are
those that the types require. A test compares the declarations, callback types and constants, also
those of `Status`, with the header."""

from __future__ import annotations

import ctypes
import operator
import re
from typing import Any, Dict, Optional, Tuple, Type

import numpy as np

from ._library import open_library

BOUNDARY = 0
INNER = 1
OVERLAPS = {"last": 0, "first": 1, "own": 2}
BOUNDED = 0
PERIODIC = 1
FLAT = 2

DECLARATIONS = """
const char *pnpbs_status_string(pnpbs_status status);
const char *pnpbs_last_error(pnpbs_context context);
pnpbs_status pnpbs_last_error_data(pnpbs_context context, int32_t *reason, int32_t *points);
pnpbs_status pnpbs_last_error_point(pnpbs_context context, int32_t index, double *point,
    int64_t *begin, int64_t *end);
pnpbs_status pnpbs_version(int32_t *major, int32_t *minor, int32_t *patch);
const char *pnpbs_build_info(void);
const char *pnpbs_mpi_library(void);
pnpbs_status pnpbs_context_create_serial(pnpbs_context *context);
pnpbs_status pnpbs_context_create_f(int32_t comm, pnpbs_context *context);
pnpbs_status pnpbs_context_create_checked_f(int32_t comm, const char *library,
    pnpbs_context *context);
pnpbs_status pnpbs_context_destroy(pnpbs_context *context);
pnpbs_status pnpbs_finalize(void);
pnpbs_status pnpbs_context_set(pnpbs_context context, const char *key, const char *value);
pnpbs_status pnpbs_context_set_int64(pnpbs_context context, const char *key, int64_t value);
pnpbs_status pnpbs_context_set_double(pnpbs_context context, const char *key, double value);
pnpbs_status pnpbs_option_count(int32_t *count);
pnpbs_status pnpbs_option_info(int32_t index, const char **name, const char **type,
    const char **default_value, const char **range, const char **help);
pnpbs_status pnpbs_statistic_count(int32_t *count);
pnpbs_status pnpbs_statistic_info(int32_t index, const char **name, const char **type,
    const char **help);
pnpbs_status pnpbs_format_count(int32_t *count);
pnpbs_status pnpbs_format_info(int32_t index, const char **name, const char **help,
    int32_t *binary, int32_t *elements);
pnpbs_status pnpbs_domain_create(pnpbs_context context, int32_t dim, pnpbs_domain *domain);
pnpbs_status pnpbs_domain_create_sphere(pnpbs_context context, double radius, const double *outside,
    pnpbs_domain *domain);
pnpbs_status pnpbs_sphere_points(double radius, int64_t n, const double *degrees,
    double *coordinates);
pnpbs_status pnpbs_sphere_degrees(int64_t n, const double *coordinates, double *degrees);
pnpbs_status pnpbs_domain_destroy(pnpbs_domain *domain);
pnpbs_status pnpbs_domain_dimension(pnpbs_domain domain, int32_t *dim);
pnpbs_status pnpbs_domain_set_filled(pnpbs_domain domain, int32_t filled);
pnpbs_status pnpbs_domain_set_repair(pnpbs_domain domain, double resolution);
pnpbs_status pnpbs_domain_set_resurfaced(pnpbs_domain domain, double resolution);
pnpbs_status pnpbs_domain_set_fragment(pnpbs_domain domain, int32_t overlap);
pnpbs_status pnpbs_domain_set_periodic(pnpbs_domain domain, const double *low, const double *high,
                                       const int32_t *periodic, const int32_t *tags);
pnpbs_status pnpbs_domain_add_polyline(pnpbs_domain domain, int32_t role, int32_t closed,
    int64_t n, const double *coordinates, const int32_t *tags, double corner_angle);
pnpbs_status pnpbs_domain_add_surface(pnpbs_domain domain, int32_t role, int64_t vertices,
    const double *coordinates, int64_t triangles, const int64_t *corners, const int32_t *tags,
    double feature_angle);
pnpbs_status pnpbs_domain_read_surface(pnpbs_domain domain, int32_t role, const char *path,
    double feature_angle);
pnpbs_status pnpbs_domain_set_role(pnpbs_domain domain, int32_t tag, int32_t role);
pnpbs_status pnpbs_domain_read_msh(pnpbs_domain domain, const char *path, double feature_angle);
pnpbs_status pnpbs_file_dimension(const char *path, int32_t *dim);
pnpbs_status pnpbs_domain_set_tag_name(pnpbs_domain domain, int32_t dim, int32_t tag,
    const char *name);
pnpbs_status pnpbs_domain_tag_name_count(pnpbs_domain domain, int32_t *count);
pnpbs_status pnpbs_domain_get_tag_name(pnpbs_domain domain, int32_t index, int32_t *dim,
    int32_t *tag, const char **name);
pnpbs_status pnpbs_domain_add_box(pnpbs_domain domain, const double *low, const double *high,
    int32_t tag);
pnpbs_status pnpbs_domain_add_ball(pnpbs_domain domain, const double *centre, double radius,
    int32_t tag);
pnpbs_status pnpbs_domain_add_cylinder(pnpbs_domain domain, const double *begin,
    const double *end, double radius, int32_t tag);
pnpbs_status pnpbs_domain_add_box_surface(pnpbs_domain domain, int32_t role,
    const double *low, const double *high, int32_t tag);
pnpbs_status pnpbs_domain_add_ball_surface(pnpbs_domain domain, int32_t role,
    const double *centre, double radius, int32_t tag);
pnpbs_status pnpbs_domain_add_cylinder_surface(pnpbs_domain domain, int32_t role,
    const double *begin, const double *end, double radius, int32_t tag);
pnpbs_status pnpbs_domain_add_level_set(pnpbs_domain domain, pnpbs_level_set_fn level_set,
    void *user, const double *low, const double *high, double resolution, int32_t tag);
pnpbs_status pnpbs_domain_add_arc(pnpbs_domain domain, int32_t role, const double *centre,
    double radius, double begin, double end, int32_t tag);
pnpbs_status pnpbs_domain_add_curve(pnpbs_domain domain, int32_t role, pnpbs_curve_fn curve,
    void *user, double begin, double end, int32_t tag);
pnpbs_status pnpbs_domain_add_pslg(pnpbs_domain domain, int64_t vertices,
    const double *coordinates, const int32_t *vertex_tags, int64_t segments,
    const int64_t *segment_ends, const int32_t *segment_tags, int64_t holes,
    const double *hole_points);
pnpbs_status pnpbs_domain_add_hole(pnpbs_domain domain, const double *point);
pnpbs_status pnpbs_domain_add_region(pnpbs_domain domain, const double *point, int32_t tag);
pnpbs_status pnpbs_domain_add_fixed_nodes(pnpbs_domain domain, int64_t n,
    const double *coordinates, const int32_t *tags);
pnpbs_status pnpbs_domain_read_poly(pnpbs_domain domain, const char *path);
pnpbs_status pnpbs_domain_parse_poly(pnpbs_domain domain, const char *text, int64_t length,
    const char *name);
pnpbs_status pnpbs_domain_tag_outline(pnpbs_domain domain, pnpbs_level_set_fn level_set,
    void *user, int32_t tag, int64_t *count);
pnpbs_status pnpbs_domain_set_corner_angle(pnpbs_domain domain, double corner_angle);
pnpbs_status pnpbs_domain_set_snap(pnpbs_domain domain, double length);
pnpbs_status pnpbs_domain_simplify(pnpbs_domain domain, pnpbs_spacing_fn spacing, void *user,
    double tolerance, double smallest, int64_t *vertices, int64_t *curves);
pnpbs_status pnpbs_domain_simplify_by_file(pnpbs_domain domain, const char *path,
    const char *field, double tolerance, double smallest, int64_t *vertices, int64_t *curves);
pnpbs_status pnpbs_domain_add_offset(pnpbs_domain domain, pnpbs_domain body, double low,
    double high, pnpbs_spacing_fn spacing, void *user, double resolution, int32_t tag);
pnpbs_status pnpbs_domain_check(pnpbs_domain domain);
pnpbs_status pnpbs_domain_bounds(pnpbs_domain domain, double *low, double *high);
pnpbs_status pnpbs_domain_measure(pnpbs_domain domain, double *measure);
pnpbs_status pnpbs_domain_distance(pnpbs_domain domain, int32_t tag, int64_t n,
    const double *coordinates, double *distances);
pnpbs_status pnpbs_domain_regions_at(pnpbs_domain domain, int64_t n, const double *coordinates,
    int32_t columns, int32_t *tags);
pnpbs_status pnpbs_domain_shape_spacing(pnpbs_domain domain, double nodes_per_turn,
    double nodes_across, double nodes_per_edge, double growth, int64_t n,
    const double *coordinates, double *d);
pnpbs_status pnpbs_domain_get_segments(pnpbs_domain domain, int64_t capacity, int64_t *count,
    double *segments, int32_t *tags);
pnpbs_status pnpbs_placement_create(pnpbs_context context, pnpbs_domain domain,
    pnpbs_placement *placement);
pnpbs_status pnpbs_placement_destroy(pnpbs_placement *placement);
pnpbs_status pnpbs_placement_set(pnpbs_placement placement, const char *key, const char *value);
pnpbs_status pnpbs_placement_set_int64(pnpbs_placement placement, const char *key, int64_t value);
pnpbs_status pnpbs_placement_set_double(pnpbs_placement placement, const char *key, double value);
pnpbs_status pnpbs_placement_set_spacing_constant(pnpbs_placement placement, double d);
pnpbs_status pnpbs_placement_set_spacing_callback(pnpbs_placement placement,
    pnpbs_spacing_fn spacing, void *user);
pnpbs_status pnpbs_placement_set_spacing_grid(pnpbs_placement placement, const int64_t *size,
    const double *origin, const double *step, const double *values);
pnpbs_status pnpbs_placement_set_spacing_mesh(pnpbs_placement placement, int64_t n,
    const double *coordinates, const double *d, int64_t elements, const int64_t *corners);
pnpbs_status pnpbs_placement_set_spacing_points(pnpbs_placement placement, int64_t n,
    const double *coordinates, const double *d);
pnpbs_status pnpbs_placement_set_spacing_file(pnpbs_placement placement, const char *path,
    const char *field);
pnpbs_status pnpbs_placement_set_spacing_from_shape(pnpbs_placement placement,
    double nodes_per_turn, double nodes_across, double nodes_per_edge, double growth,
    double min_spacing, double max_spacing);
pnpbs_status pnpbs_placement_set_spacing_at_nodes(pnpbs_placement placement, int64_t n,
    const double *d);
pnpbs_status pnpbs_placement_add_spacing_hints(pnpbs_placement placement, int64_t n,
                                               const double *coordinates);
pnpbs_status pnpbs_placement_set_monitor(pnpbs_placement placement, pnpbs_monitor_fn monitor,
    void *user);
pnpbs_status pnpbs_placement_set_nodes(pnpbs_placement placement, int64_t n,
    const double *coordinates, const int64_t *ids);
pnpbs_status pnpbs_placement_estimate(pnpbs_placement placement, int64_t *nodes, int64_t *bytes,
    double *seconds);
pnpbs_status pnpbs_placement_initialise(pnpbs_placement placement);
pnpbs_status pnpbs_placement_step(pnpbs_placement placement, int64_t n);
pnpbs_status pnpbs_placement_adjust_population(pnpbs_placement placement, int64_t *inserted,
    int64_t *deleted);
pnpbs_status pnpbs_placement_rebalance(pnpbs_placement placement);
pnpbs_status pnpbs_placement_run(pnpbs_placement placement);
pnpbs_status pnpbs_placement_dimension(pnpbs_placement placement, int32_t *dim);
pnpbs_status pnpbs_placement_sphere_radius(pnpbs_placement placement, double *radius);
pnpbs_status pnpbs_placement_count(pnpbs_placement placement, int64_t *nodes);
pnpbs_status pnpbs_placement_get_nodes(pnpbs_placement placement, int64_t capacity,
    double *coordinates, int64_t *ids, int32_t *tags, double *spacing);
pnpbs_status pnpbs_placement_get_normals(pnpbs_placement placement, int64_t capacity,
    double *normals);
pnpbs_status pnpbs_placement_ghost_count(pnpbs_placement placement, int64_t *ghosts);
pnpbs_status pnpbs_placement_get_ghosts(pnpbs_placement placement, int64_t capacity,
    double *coordinates, int64_t *ids, int32_t *tags, double *spacing, int32_t *owners);
pnpbs_status pnpbs_placement_exchange_sizes(pnpbs_placement placement, int32_t *neighbours,
    int64_t *sends, int64_t *receives);
pnpbs_status pnpbs_placement_get_exchange(pnpbs_placement placement, int32_t neighbours,
    int64_t sends, int64_t receives, int32_t *ranks, int64_t *send_offsets, int64_t *send_nodes,
    int64_t *receive_offsets, int64_t *receive_nodes);
pnpbs_status pnpbs_placement_get_numbering(pnpbs_placement placement, int64_t capacity,
    int64_t *first, int64_t *count, int64_t *ghost_numbers);
pnpbs_status pnpbs_placement_update_ghosts(pnpbs_placement placement, int64_t n,
    int32_t components, double *values);
pnpbs_status pnpbs_placement_begin_update_ghosts(pnpbs_placement placement, int64_t n,
    int32_t components, const double *values);
pnpbs_status pnpbs_placement_end_update_ghosts(pnpbs_placement placement, int64_t n,
    int32_t components, double *values);
pnpbs_status pnpbs_placement_add_from_ghosts(pnpbs_placement placement, int64_t n,
    int32_t components, double *values);
pnpbs_status pnpbs_placement_sum(pnpbs_placement placement, int64_t n, int32_t components,
    const double *values, double *sums);
pnpbs_status pnpbs_placement_dot(pnpbs_placement placement, int64_t n, int32_t components,
    const double *x, const double *y, double *products);
pnpbs_status pnpbs_placement_adjacency_size(pnpbs_placement placement, int64_t *entries);
pnpbs_status pnpbs_placement_get_adjacency(pnpbs_placement placement, int64_t capacity,
    int64_t *offsets, int64_t *neighbours);
pnpbs_status pnpbs_placement_star_size(pnpbs_placement placement, int64_t *entries);
pnpbs_status pnpbs_placement_get_stars(pnpbs_placement placement, int64_t capacity,
    int64_t *offsets, int64_t *neighbours, int8_t *triangle);
pnpbs_status pnpbs_placement_get_triangles(pnpbs_placement placement, int64_t capacity,
    int64_t *count, int64_t *triangles);
pnpbs_status pnpbs_placement_get_tetrahedra(pnpbs_placement placement, int64_t capacity,
    int64_t *count, int64_t *tetrahedra);
pnpbs_status pnpbs_placement_get_element_tags(pnpbs_placement placement, int64_t capacity,
    int64_t *count, int32_t *tags);
pnpbs_status pnpbs_placement_get_incident_elements(pnpbs_placement placement, int64_t capacity,
    int64_t *count, int32_t *corners, int64_t *elements);
pnpbs_status pnpbs_placement_get_edges(pnpbs_placement placement, int64_t capacity,
    int64_t *count, int64_t *straight, int64_t *ends, int64_t *numbers, double *midpoints);
pnpbs_status pnpbs_placement_find_edges(pnpbs_placement placement, int64_t n, int32_t corners,
    const int64_t *cells, int64_t *edges);
pnpbs_status pnpbs_placement_set_cracks(pnpbs_placement placement, int32_t n,
    const int32_t *tags);
pnpbs_status pnpbs_placement_get_crack_nodes(pnpbs_placement placement, int64_t capacity,
    int64_t *count, int64_t *all, int64_t *nodes, int64_t *numbers);
pnpbs_status pnpbs_placement_get_cracked_elements(pnpbs_placement placement, int64_t capacity,
    int64_t *count, int64_t *elements);
pnpbs_status pnpbs_placement_get_crack_facets(pnpbs_placement placement, int64_t capacity,
    int64_t *count, double *covered, int64_t *front, int64_t *back, int32_t *tags);
pnpbs_status pnpbs_placement_get_boundary_triangles(pnpbs_placement placement, int64_t capacity,
    int64_t *count, int64_t *triangles, int32_t *tags);
pnpbs_status pnpbs_placement_get_boundary_edges(pnpbs_placement placement, int64_t capacity,
    int64_t *count, int64_t *edges, int32_t *tags);
pnpbs_status pnpbs_placement_check(pnpbs_placement placement);
pnpbs_status pnpbs_placement_get_int64(pnpbs_placement placement, const char *key,
    int64_t *value);
pnpbs_status pnpbs_placement_get_double(pnpbs_placement placement, const char *key,
    double *value);
pnpbs_status pnpbs_placement_get_string(pnpbs_placement placement, const char *key,
    const char **value);
pnpbs_status pnpbs_placement_get_edge_bands(pnpbs_placement placement, int64_t capacity,
    int64_t *count, double *d_from, double *d_to, int64_t *edges, double *mean,
    double *deviation);
pnpbs_status pnpbs_placement_get_regions(pnpbs_placement placement, int64_t capacity,
    int64_t *count, int32_t *tags, int64_t *nodes, int64_t *elements, double *measures);
pnpbs_status pnpbs_placement_get_cell_bands(pnpbs_placement placement, const char *measure,
    int64_t capacity, int64_t *count, double *d_from, double *d_to, int64_t *number, double *mean,
    double *worst);
pnpbs_status pnpbs_placement_warning_count(pnpbs_placement placement, int32_t *count);
pnpbs_status pnpbs_placement_get_warning(pnpbs_placement placement, int32_t index,
    const char **text);
pnpbs_status pnpbs_placement_get_warning_data(pnpbs_placement placement, int32_t index,
    int32_t *code, int64_t *count, double *value, double *point);
pnpbs_status pnpbs_transfer_create(pnpbs_placement placement, int64_t n, int32_t components,
    const double *values, pnpbs_transfer *transfer);
pnpbs_status pnpbs_transfer_create_second_order(pnpbs_placement placement, int64_t n,
    int32_t components, const double *values, pnpbs_transfer *transfer);
pnpbs_status pnpbs_transfer_order(pnpbs_transfer transfer, int32_t *order, int64_t *linear_nodes);
pnpbs_status pnpbs_transfer_destroy(pnpbs_transfer *transfer);
pnpbs_status pnpbs_transfer_sizes(pnpbs_transfer transfer, int32_t *dim, int32_t *components);
pnpbs_status pnpbs_transfer_at_nodes(pnpbs_transfer transfer, pnpbs_placement placement,
    int32_t conserve, int64_t capacity, double *values);
pnpbs_status pnpbs_transfer_at_points(pnpbs_transfer transfer, int64_t n,
    const double *coordinates, double *values);
pnpbs_status pnpbs_mesh_create(pnpbs_placement placement, int32_t ghost_layers, pnpbs_mesh *mesh);
pnpbs_status pnpbs_mesh_destroy(pnpbs_mesh *mesh);
pnpbs_status pnpbs_mesh_sizes(pnpbs_mesh mesh, int32_t *dim, int32_t *corners,
    int64_t *owned_nodes, int64_t *nodes, int64_t *owned_elements, int64_t *elements,
    int64_t *facets);
pnpbs_status pnpbs_mesh_numbering(pnpbs_mesh mesh, int64_t *first_node, int64_t *all_nodes,
    int64_t *first_element, int64_t *all_elements);
pnpbs_status pnpbs_mesh_get_nodes(pnpbs_mesh mesh, int64_t capacity, double *coordinates,
    int64_t *numbers, int64_t *ids, int32_t *owners, int32_t *tags);
pnpbs_status pnpbs_mesh_get_elements(pnpbs_mesh mesh, int64_t capacity, int32_t *nodes,
    int64_t *numbers, int32_t *owners, int32_t *tags);
pnpbs_status pnpbs_mesh_get_connectivity(pnpbs_mesh mesh, int64_t capacity, int64_t *numbers);
pnpbs_status pnpbs_mesh_get_connectivity_int32(pnpbs_mesh mesh, int64_t capacity,
    int32_t *numbers);
pnpbs_status pnpbs_mesh_get_facets(pnpbs_mesh mesh, int64_t capacity, int32_t *nodes,
    int32_t *tags, int32_t *elements, int32_t *opposite, int8_t *inner, int32_t *owners);
pnpbs_status pnpbs_mesh_sharing_sizes(pnpbs_mesh mesh, int64_t *nodes, int64_t *entries);
pnpbs_status pnpbs_mesh_get_sharing(pnpbs_mesh mesh, int64_t nodes, int64_t entries,
    int32_t *shared, int64_t *offsets, int32_t *ranks);
pnpbs_status pnpbs_mesh_write(pnpbs_mesh mesh, const char *prefix);
pnpbs_status pnpbs_voronoi_create(pnpbs_placement placement, pnpbs_voronoi *voronoi);
pnpbs_status pnpbs_voronoi_destroy(pnpbs_voronoi *voronoi);
pnpbs_status pnpbs_voronoi_sizes(pnpbs_voronoi voronoi, int32_t *dim, int64_t *nodes,
    int64_t *faces);
pnpbs_status pnpbs_voronoi_get_cells(pnpbs_voronoi voronoi, int64_t capacity, double *volumes,
    double *boundary);
pnpbs_status pnpbs_voronoi_get_faces(pnpbs_voronoi voronoi, int64_t nodes, int64_t faces,
    int64_t *offsets, int64_t *ids, int64_t *numbers, double *areas, double *distances,
    double *normals);
pnpbs_status pnpbs_particles_create(pnpbs_placement placement, pnpbs_domain body,
    pnpbs_particles *particles);
pnpbs_status pnpbs_particles_destroy(pnpbs_particles *particles);
pnpbs_status pnpbs_particles_sizes(pnpbs_particles particles, int32_t *dim, int64_t *count,
    int64_t *all);
pnpbs_status pnpbs_particles_figures(pnpbs_particles particles, int64_t *left_out, int64_t *moved,
    double *closest);
pnpbs_status pnpbs_particles_get(pnpbs_particles particles, int64_t capacity, double *x,
    double *volumes, double *spacing, int64_t *ids, int32_t *tags);
pnpbs_status pnpbs_particles_add_output_field(pnpbs_particles particles, const char *name,
    int64_t n, int32_t components, const double *values);
pnpbs_status pnpbs_particles_write(pnpbs_particles particles, int32_t n, const char *const *paths,
    const char *const *formats);
pnpbs_status pnpbs_placement_write(pnpbs_placement placement, const char *path, int32_t elements);
pnpbs_status pnpbs_placement_write_files(pnpbs_placement placement, int32_t n,
    const char *const *paths, const char *const *formats, const int32_t *elements);
pnpbs_status pnpbs_placement_add_output_field(pnpbs_placement placement, const char *name,
    int64_t n, int32_t components, const double *values);
pnpbs_status pnpbs_placement_clear_output_fields(pnpbs_placement placement);
pnpbs_status pnpbs_placement_write_checkpoint(pnpbs_placement placement, const char *path);
pnpbs_status pnpbs_placement_read_checkpoint(pnpbs_placement placement, const char *path);
pnpbs_status pnpbs_discard_unfinished_files(void);
"""


class _Array:
    """The type of an array argument: a NumPy array in C order, `ctypes.byref` of a number, or
    None."""

    dtype: Optional[np.dtype[Any]] = None

    @classmethod
    def from_param(cls, value: Any) -> Any:
        if isinstance(value, np.ndarray):
            if value.dtype != cls.dtype or not value.flags.c_contiguous:
                raise TypeError(f"a C-contiguous array of {cls.dtype} was expected")
            value = value.ctypes.data
        return ctypes.c_void_p.from_param(value)


def _array_of(dtype: str) -> Type[_Array]:
    return type(f"_ArrayOf_{dtype}", (_Array,), {"dtype": np.dtype(dtype)})


class _Number:
    """The type of a numeric argument. Errors name the argument, which ctypes alone does not."""

    name: str
    kind: str

    @classmethod
    def wrong(cls, value: Any) -> TypeError:
        return TypeError(f"{cls.name} is {value!r}; {cls.kind} was expected")


class _Real(_Number):
    kind = "a real number"

    @classmethod
    def from_param(cls, value: Any) -> Any:
        try:
            return ctypes.c_double.from_param(value)
        except TypeError:
            raise cls.wrong(value) from None


class _Integer(_Number):
    """The type of an integer argument. It raises OverflowError for numbers that do not fit; ctypes
    alone truncates them."""

    bits: int
    kind = "an integer"

    @classmethod
    def from_param(cls, value: Any) -> Any:
        try:
            number = operator.index(value)
        except TypeError:
            raise cls.wrong(value) from None
        if not -(1 << cls.bits - 1) <= number < 1 << cls.bits - 1:
            raise OverflowError(f"{cls.name} is {number}, which does not fit into {cls.bits} bits")
        return ctypes.c_int32(number) if cls.bits == 32 else ctypes.c_int64(number)


_BITS = {"int32_t": 32, "int64_t": 64}


def _argument(c_type: str, name: str) -> Any:
    """Returns the type of an argument for `function.argtypes`."""
    if c_type in _BITS:
        return type(f"_{c_type}_{name}", (_Integer,), {"bits": _BITS[c_type], "name": name})
    if c_type == "double":
        return type(f"_double_{name}", (_Real,), {"name": name})
    return ctypes_of(c_type)


_NUMBERS: Dict[str, Any] = {"int32_t": ctypes.c_int32, "int64_t": ctypes.c_int64,
                            "double": ctypes.c_double, "pnpbs_status": ctypes.c_int}
_ARRAYS = {"int8_t": _array_of("int8"), "int32_t": _array_of("int32"),
           "int64_t": _array_of("int64"), "double": _array_of("float64")}


def ctypes_of(c_type: str) -> Any:
    """Returns the ctypes type of a C type as written in the header."""
    if c_type in _NUMBERS:
        return _NUMBERS[c_type]
    if c_type == "const char *":
        return ctypes.c_char_p
    pointee = c_type.removeprefix("const ").removesuffix(" *")
    # Handles, callbacks, and outputs that are passed by `ctypes.byref`.
    return _ARRAYS.get(pointee, ctypes.c_void_p)


def declarations(text: str) -> Dict[str, Tuple[str, Tuple[Tuple[str, str], ...]]]:
    """Parses declarations "result name(type argument, ...);". Returns {name: (result, ((type,
    argument), ...))}."""
    found = {}
    for declaration in text.split(";"):
        match = re.fullmatch(r"\s*(.*?[\s*])(pnpbs_\w+)\((.*)\)", declaration, re.S)
        if match:
            pieces = [] if match[3] == "void" else match[3].split(",")
            arguments = [a for a in (re.fullmatch(r"\s*(.*?[\s*])(\w+)\s*", piece, re.S)
                                     for piece in pieces) if a]
            found[match[2]] = (match[1].strip(), tuple((a[1].strip(), a[2]) for a in arguments))
    return found


def declared(opened: ctypes.CDLL, text: str) -> ctypes.CDLL:
    """Declares results and arguments of the functions in `text` for an opened library, and returns
    the library."""
    for name, (result, arguments) in declarations(text).items():
        function = getattr(opened, name)
        function.restype = ctypes_of(result)
        function.argtypes = [_argument(*argument) for argument in arguments]
    return opened


# Types of callbacks. The last argument is `user`, which closures of Python do not need.
_DOUBLES = ctypes.POINTER(ctypes.c_double)
CALLBACKS: Dict[str, Any] = {
    "pnpbs_curve_fn": ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_int64, ctypes.c_int32, _DOUBLES,
                                       _DOUBLES, ctypes.c_void_p),
    "pnpbs_level_set_fn": ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_int64, ctypes.c_int32, _DOUBLES,
                                           _DOUBLES, ctypes.c_void_p),
    "pnpbs_spacing_fn": ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_int64, ctypes.c_int32, _DOUBLES,
                                         _DOUBLES, ctypes.c_void_p),
    "pnpbs_monitor_fn": ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_double, ctypes.c_int64,
                                         ctypes.c_int64, ctypes.c_double, ctypes.c_void_p),
}

_opened: Optional[ctypes.CDLL] = None


def library() -> ctypes.CDLL:
    """Returns the library with declared functions. The first call opens it."""
    global _opened
    if _opened is None:
        _opened = declared(open_library(), DECLARATIONS)
    return _opened
