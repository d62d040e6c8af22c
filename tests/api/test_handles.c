/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests handles: every function returns an error for a handle that is not live or of another kind.
 * Objects may be destroyed in any order, and keep alive what they need.
 */
#include "api_support.h"
#include "volume_bodies.h"

/* Buffer for the outputs of the calls below, which an error must not change. */
static union {
  double reals[64];
  int64_t integers[64];
  int32_t small[128];
  int8_t bytes[512];
  const char* texts[64];
  pnpbs_domain domain;
  pnpbs_placement placement;
  pnpbs_transfer transfer;
  pnpbs_particles particles;
} out;

static void prepare_outputs(void) {
  memset(&out, 0x5a, sizeof out);
  memset(out.bytes, 0, sizeof(void*)); /* outputs that are handles become NULL */
}

static void check_outputs(const char* name) {
  size_t i;
  for (i = 0; i < sizeof out; ++i) {
    ck_assert_msg(out.bytes[i] == (i < sizeof(void*) ? 0 : 0x5a), "%s wrote byte %d of its outputs",
                  name, (int)i);
  }
}

static const double xy[8] = {0, 0, 1, 0, 1, 1, 0, 1};
static const int64_t ends[8] = {0, 1, 1, 2, 2, 3, 3, 0};
static const double xyz[12] = {0, 0, 0, 1, 1, 1, 1, 0, 0, 0, 1, 0};
static const int64_t faces[12] = {0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2};
static const int64_t grid_size[2] = {1, 2};
static const double grid[6] = {0.5, 0.5, 1, 1, 0.2, 0.3}; /* origin, step and values */
static const int32_t periodic[3] = {1, 0, 1};
static cone a_cone = {0.1, 0, 0, 0};

static int32_t circle(int64_t n, int32_t dim, const double* t, double* points, void* user) {
  (void)dim;
  int64_t i;
  (void)user;
  for (i = 0; i < n; ++i) {
    points[2 * i] = cos(t[i]);
    points[2 * i + 1] = sin(t[i]);
  }
  return 0;
}

static int32_t no_stop(double fraction, int64_t step, int64_t nodes, double speed, void* user) {
  (void)fraction, (void)step, (void)nodes, (void)speed, (void)user;
  return 0;
}

/* ---------------------------------------------------------------- every call ------------ */

/* X(function, its arguments): a call that accepts a live handle of the right kind and dimension,
 * and may fail for other reasons. Functions that create or destroy have tests of their own. */
#define CONTEXT_CALLS(X)                          \
  X(context_set, (handle, "steps", "10"))         \
  X(context_set_int64, (handle, "steps", 10))     \
  X(context_set_double, (handle, "damping", 0.5)) \
  X(domain_create, (handle, 2, &out.domain))      \
  X(domain_create_sphere, (handle, 1.0, xyz + 3, &out.domain))
#define DOMAIN_CALLS(X)                                                               \
  X(domain_add_polyline, (handle, PNPBS_BOUNDARY, 1, 4, xy, NULL, 0.0))               \
  X(domain_add_surface, (handle, PNPBS_BOUNDARY, 4, xyz, 4, faces, NULL, 40.0))       \
  X(domain_read_surface, (handle, PNPBS_BOUNDARY, "unread.stl", 40.0))                \
  X(domain_set_role, (handle, 1, PNPBS_INNER))                                        \
  X(domain_read_msh, (handle, "unread.msh", 40.0))                                    \
  X(domain_set_tag_name, (handle, 1, 7, "rim"))                                       \
  X(domain_tag_name_count, (handle, out.small + 2))                                   \
  X(domain_get_tag_name, (handle, 0, out.small + 2, out.small + 3, out.texts + 2))    \
  X(domain_add_box, (handle, xyz, xyz + 3, 1))                                        \
  X(domain_add_ball, (handle, xyz, 1.0, 1))                                           \
  X(domain_add_cylinder, (handle, xyz, xyz + 3, 1.0, 1))                              \
  X(domain_add_box_surface, (handle, PNPBS_INNER, xyz, xyz + 3, 1))                   \
  X(domain_add_ball_surface, (handle, PNPBS_INNER, xyz, 1.0, 1))                      \
  X(domain_add_cylinder_surface, (handle, PNPBS_INNER, xyz, xyz + 3, 1.0, 1))         \
  X(domain_tag_outline, (handle, volume_ring_at, NULL, 5, out.integers))              \
  X(domain_set_corner_angle, (handle, 30.0))                                          \
  X(domain_set_snap, (handle, 1e-3))                                                  \
  X(domain_simplify, (handle, cone_spacing, &a_cone, 0.25, 2.0, NULL, NULL))          \
  X(domain_simplify_by_file, (handle, "/nowhere/d.csv", NULL, 0.25, 2.0, NULL, NULL)) \
  X(domain_add_level_set, (handle, volume_ring_at, NULL, xyz, xyz + 3, 0.5, 1))       \
  X(domain_add_offset, (handle, handle, -1, 1, NULL, NULL, 0.5, 1))                   \
  X(domain_add_arc, (handle, PNPBS_BOUNDARY, xy, 1.0, 0.0, 2 * PI, 1))                \
  X(domain_add_curve, (handle, PNPBS_BOUNDARY, circle, NULL, 0.0, 2 * PI, 1))         \
  X(domain_add_pslg, (handle, 4, xy, NULL, 4, ends, NULL, 0, NULL))                   \
  X(domain_add_hole, (handle, xy))                                                    \
  X(domain_add_region, (handle, xy, 1))                                               \
  X(domain_add_fixed_nodes, (handle, 1, xy, NULL))                                    \
  X(domain_read_poly, (handle, PNPBS_SOURCE_DIR "/examples/data/lake_victoria.poly")) \
  X(domain_parse_poly, (handle, "0 2 0 0\n0 0\n0\n", 14, "text"))                     \
  X(domain_set_filled, (handle, 1))                                                   \
  X(domain_set_repair, (handle, 0.0))                                                 \
  X(domain_set_resurfaced, (handle, 0.0))                                             \
  X(domain_set_fragment, (handle, 0))                                                 \
  X(domain_set_periodic, (handle, xyz, xyz + 3, periodic, NULL))                      \
  X(domain_check, (handle))                                                           \
  X(domain_dimension, (handle, out.small + 2))                                        \
  X(domain_bounds, (handle, out.reals + 1, out.reals + 3))                            \
  X(domain_measure, (handle, out.reals + 1))                                          \
  X(domain_distance, (handle, 0, 1, grid, out.reals + 1))                             \
  X(domain_shape_spacing, (handle, 20, 3, 1, 0, 1, grid, out.reals + 1))              \
  X(domain_regions_at, (handle, 1, grid, 1, out.small + 8))                           \
  X(domain_get_segments, (handle, 4, out.integers + 1, out.reals + 2, out.small + 40))
#define PLACEMENT_CALLS(X)                                                                        \
  X(placement_set, (handle, "steps", "10"))                                                       \
  X(placement_set_int64, (handle, "steps", 10))                                                   \
  X(placement_set_double, (handle, "damping", 0.5))                                               \
  X(placement_set_spacing_constant, (handle, 0.1))                                                \
  X(placement_set_spacing_callback, (handle, cone_spacing, &a_cone))                              \
  X(placement_set_spacing_grid, (handle, grid_size, grid, grid + 2, grid + 4))                    \
  X(placement_set_spacing_mesh, (handle, 4, xy, grid + 1, 1, faces + 3))                          \
  X(placement_set_spacing_points, (handle, 2, xy, grid + 1))                                      \
  X(placement_set_spacing_file, (handle, "unread.csv", NULL))                                     \
  X(placement_set_spacing_from_shape, (handle, 20, 3, 1, 0, 0, 0))                                \
  X(placement_set_spacing_at_nodes, (handle, 1, grid))                                            \
  X(placement_set_monitor, (handle, no_stop, NULL))                                               \
  X(placement_add_spacing_hints, (handle, 1, grid))                                               \
  X(placement_set_nodes, (handle, 1, grid, NULL))                                                 \
  X(placement_estimate, (handle, out.integers + 1, out.integers + 2, out.reals + 3))              \
  X(placement_initialise, (handle))                                                               \
  X(placement_step, (handle, 1))                                                                  \
  X(placement_adjust_population, (handle, out.integers + 1, out.integers + 2))                    \
  X(placement_rebalance, (handle))                                                                \
  X(placement_run, (handle))                                                                      \
  X(placement_dimension, (handle, out.small + 2))                                                 \
  X(placement_sphere_radius, (handle, out.reals + 1))                                             \
  X(placement_count, (handle, out.integers + 1))                                                  \
  X(placement_get_nodes,                                                                          \
    (handle, 1, out.reals + 1, out.integers + 3, out.small + 8, out.reals + 5))                   \
  X(placement_get_normals, (handle, 1, out.reals + 1))                                            \
  X(placement_adjacency_size, (handle, out.integers + 1))                                         \
  X(placement_get_adjacency, (handle, 1, out.integers + 1, out.integers + 3))                     \
  X(placement_star_size, (handle, out.integers + 1))                                              \
  X(placement_get_stars, (handle, 1, out.integers + 1, out.integers + 3, out.bytes + 32))         \
  X(placement_get_triangles, (handle, 1, out.integers + 1, out.integers + 2))                     \
  X(placement_get_boundary_edges, (handle, 1, out.integers + 1, out.integers + 2, out.small + 8)) \
  X(placement_get_element_tags, (handle, 1, out.integers + 1, out.small + 8))                     \
  X(placement_get_tetrahedra, (handle, 1, out.integers + 1, out.integers + 2))                    \
  X(placement_get_boundary_triangles,                                                             \
    (handle, 1, out.integers + 1, out.integers + 2, out.small + 8))                               \
  X(placement_ghost_count, (handle, out.integers + 1))                                            \
  X(placement_get_ghosts, (handle, 1, NULL, out.integers + 1, NULL, NULL, out.small + 8))         \
  X(placement_exchange_sizes, (handle, out.small + 2, out.integers + 2, out.integers + 3))        \
  X(placement_get_exchange, (handle, 1, 1, 1, out.small + 2, out.integers + 2, out.integers + 4,  \
                             out.integers + 5, out.integers + 7))                                 \
  X(placement_get_numbering, (handle, 1, out.integers + 1, out.integers + 2, out.integers + 3))   \
  X(placement_update_ghosts, (handle, 1, 1, out.reals + 1))                                       \
  X(placement_begin_update_ghosts, (handle, 1, 1, grid))                                          \
  X(placement_end_update_ghosts, (handle, 1, 1, out.reals + 1))                                   \
  X(placement_add_from_ghosts, (handle, 1, 1, out.reals + 1))                                     \
  X(placement_get_incident_elements,                                                              \
    (handle, 1, out.integers + 1, out.small + 2, out.integers + 3))                               \
  X(placement_get_edges, (handle, 0, out.integers + 1, out.integers + 2, NULL, NULL, NULL))       \
  X(placement_find_edges, (handle, 0, 3, NULL, out.integers + 1))                                 \
  X(placement_set_cracks, (handle, 1, out.small + 8))                                             \
  X(placement_get_crack_nodes,                                                                    \
    (handle, 1, out.integers + 1, out.integers + 2, out.integers + 3, out.integers + 4))          \
  X(placement_get_cracked_elements, (handle, 1, out.integers + 1, out.integers + 2))              \
  X(placement_get_crack_facets, (handle, 1, out.integers + 1, out.reals + 1, out.integers + 2,    \
                                 out.integers + 4, out.small + 8))                                \
  X(placement_add_output_field, (handle, "height", 1, 1, grid))                                   \
  X(placement_clear_output_fields, (handle))                                                      \
  X(placement_sum, (handle, 1, 1, grid, out.reals + 1))                                           \
  X(placement_dot, (handle, 1, 1, grid, grid + 1, out.reals + 1))                                 \
  X(placement_check, (handle))                                                                    \
  X(placement_get_int64, (handle, "nodes", out.integers + 1))                                     \
  X(placement_get_double, (handle, "d_error.mean", out.reals + 1))                                \
  X(placement_get_string, (handle, "hash", out.texts + 1))                                        \
  X(placement_get_edge_bands, (handle, 1, out.integers + 1, out.reals + 2, out.reals + 3,         \
                               out.integers + 4, out.reals + 5, out.reals + 6))                   \
  X(placement_get_regions, (handle, 1, out.integers + 1, out.small + 8, out.integers + 2,         \
                            out.integers + 3, out.reals + 5))                                     \
  X(placement_get_cell_bands, (handle, "edge_ratio", 1, out.integers + 1, out.reals + 2,          \
                               out.reals + 3, out.integers + 4, out.reals + 5, out.reals + 6))    \
  X(placement_warning_count, (handle, out.small + 2))                                             \
  X(placement_get_warning, (handle, 0, out.texts + 1))                                            \
  X(placement_get_warning_data,                                                                   \
    (handle, 0, out.small + 2, out.integers + 1, out.reals + 2, out.reals + 3))                   \
  X(placement_write, (handle, "unwritten.csv", 0))                                                \
  X(placement_write_files, (handle, 0, NULL, NULL, NULL))                                         \
  X(placement_write_checkpoint, (handle, "unwritten.vtkhdf"))                                     \
  X(placement_read_checkpoint, (handle, "unwritten.vtkhdf"))

#define TRANSFER_CALLS(X)                                      \
  X(transfer_sizes, (handle, out.small + 2, out.small + 3))    \
  X(transfer_order, (handle, out.small + 2, out.integers + 2)) \
  X(transfer_at_nodes, (handle, target, 0, 1, out.reals + 1))  \
  X(transfer_at_points, (handle, 1, grid, out.reals + 1))

#define PARTICLES_CALLS(X)                                                                      \
  X(particles_sizes, (handle, out.small + 2, out.integers + 2, out.integers + 3))               \
  X(particles_figures, (handle, out.integers + 1, out.integers + 2, out.reals + 3))             \
  X(particles_get,                                                                              \
    (handle, 1, out.reals + 1, out.reals + 4, out.reals + 5, out.integers + 6, out.small + 14)) \
  X(particles_add_output_field, (handle, "mass", 1, 1, grid))                                   \
  X(particles_write, (handle, 0, NULL, NULL))

/* The placement to which fields are transferred. */
static pnpbs_placement target;

/* Defines each call as a function of a pointer that may not be a handle. */
#define CALL_IT(Handle, name, arguments)            \
  static pnpbs_status call_##name(void* anything) { \
    const Handle handle = (Handle)anything;         \
    return pnpbs_##name arguments;                  \
  }
#define CALL_CONTEXT(name, arguments) CALL_IT(pnpbs_context, name, arguments)
#define CALL_DOMAIN(name, arguments) CALL_IT(pnpbs_domain, name, arguments)
#define CALL_PLACEMENT(name, arguments) CALL_IT(pnpbs_placement, name, arguments)
#define CALL_TRANSFER(name, arguments) CALL_IT(pnpbs_transfer, name, arguments)
#define CALL_PARTICLES(name, arguments) CALL_IT(pnpbs_particles, name, arguments)
CONTEXT_CALLS(CALL_CONTEXT)
DOMAIN_CALLS(CALL_DOMAIN)
PLACEMENT_CALLS(CALL_PLACEMENT)
TRANSFER_CALLS(CALL_TRANSFER)
PARTICLES_CALLS(CALL_PARTICLES)

/* The kind of the first argument of each function. */
typedef enum { CONTEXT, DOMAIN, PLACEMENT, TRANSFER, PARTICLES } kind;

static const struct {
  const char* name;
  kind takes;
  pnpbs_status (*call)(void*);
} calls[] = {
#define ROW_CONTEXT(name, arguments) {"pnpbs_" #name, CONTEXT, call_##name},
#define ROW_DOMAIN(name, arguments) {"pnpbs_" #name, DOMAIN, call_##name},
#define ROW_PLACEMENT(name, arguments) {"pnpbs_" #name, PLACEMENT, call_##name},
#define ROW_TRANSFER(name, arguments) {"pnpbs_" #name, TRANSFER, call_##name},
#define ROW_PARTICLES(name, arguments) {"pnpbs_" #name, PARTICLES, call_##name},
    CONTEXT_CALLS(ROW_CONTEXT) DOMAIN_CALLS(ROW_DOMAIN) PLACEMENT_CALLS(ROW_PLACEMENT)
        TRANSFER_CALLS(ROW_TRANSFER) PARTICLES_CALLS(ROW_PARTICLES)};

/* The tables above contain every function that the header declares, except those that create and
 * destroy. */
START_TEST(every_function_is_here) {
  FILE* header = fopen(PNPBS_SOURCE_DIR "/include/pnpbs/pnpbs.h", "r");
  char line[200];
  int found = 0;
  ck_assert_ptr_nonnull(header);
  while (fgets(line, sizeof line, header) != NULL) {
    char name[100];
    int i;
    if (sscanf(line, "PNPBS_API pnpbs_status %99[a-z0-9_](pnpbs_", name) != 1) continue;
    if (strstr(name, "_create") != NULL || strstr(name, "_destroy") != NULL) continue;
    if (strncmp(name, "pnpbs_context_", 14) != 0 && strncmp(name, "pnpbs_domain_", 13) != 0 &&
        strncmp(name, "pnpbs_placement_", 16) != 0 && strncmp(name, "pnpbs_transfer_", 15) != 0 &&
        strncmp(name, "pnpbs_particles_", 16) != 0) {
      continue;
    }
    ++found;
    for (i = 0; i < COUNT_OF(calls) && strcmp(calls[i].name, name) != 0; ++i) {
    }
    ck_assert_msg(i < COUNT_OF(calls), "%s is not tested", name);
  }
  fclose(header);
  ck_assert_int_eq(found + 2, COUNT_OF(calls)); /* plus pnpbs_domain_create and .._create_sphere */
}
END_TEST

/* ---------------------------------------------------------------- not live -------------- */

static void must_be_refused(int row, void* handle, const char* what) {
  pnpbs_status status;
  const char* kinds[] = {"context", "domain", "placement", "transfer", "particles"};
  prepare_outputs();
  MUST_BE(PNPBS_ERROR_ARGUMENT, pnpbs_option_count(NULL)); /* sets another message */
  status = calls[row].call(handle);
  ck_assert_msg(status == PNPBS_ERROR_HANDLE, "%s of %s: status %d", calls[row].name, what,
                (int)status);
  ck_assert_msg(strstr(MESSAGE(), kinds[calls[row].takes]) != NULL,
                "%s of %s: the message is \"%s\"", calls[row].name, what, MESSAGE());
  check_outputs(calls[row].name);
}

/* Returns a transfer from the nodes of a job. Places them if there are none. */
static pnpbs_transfer some_transfer(const job* it) {
  double values[300] = {0};
  pnpbs_transfer transfer = NULL;
  int64_t n;
  MUST(pnpbs_placement_count(it->placement, &n));
  if (n == 0) {
    MUST(pnpbs_placement_set_spacing_constant(it->placement, 0.3));
    MUST_COMPUTE(pnpbs_placement_run(it->placement));
    MUST(pnpbs_placement_count(it->placement, &n));
  }
  ck_assert_int_lt(n, COUNT_OF(values));
  MUST(pnpbs_transfer_create(it->placement, n, 1, values, &transfer));
  return transfer;
}

/* Returns a square around that of a job, larger by half of the spacing 0.3 of its nodes on each
 * side. */
static pnpbs_domain body_around(const job* it) {
  static const double corners[8] = {-0.15, -0.15, 1.15, -0.15, 1.15, 1.15, -0.15, 1.15};
  pnpbs_domain body = NULL;
  MUST(pnpbs_domain_create(it->context, 2, &body));
  MUST(pnpbs_domain_add_polyline(body, PNPBS_BOUNDARY, 1, 4, corners, NULL, 0.0));
  return body;
}

/* Returns particles of the nodes that some_transfer places. */
static pnpbs_particles some_particles(const job* it) {
  pnpbs_domain body = body_around(it);
  pnpbs_particles particles = NULL;
  MUST(pnpbs_particles_create(it->placement, body, &particles));
  MUST(pnpbs_domain_destroy(&body));
  return particles;
}

START_TEST(handles_that_are_not_live) {
  job live = square_job(1), dead = square_job(1);
  job copy = dead;
  pnpbs_transfer transfer = some_transfer(&live), dead_transfer = some_transfer(&live);
  const pnpbs_transfer dead_copy = dead_transfer;
  pnpbs_particles particles = some_particles(&live), dead_particles = some_particles(&live);
  const pnpbs_particles copy_of_particles = dead_particles;
  int never = 0;
  job_end(&dead);
  MUST(pnpbs_transfer_destroy(&dead_transfer));
  ck_assert_ptr_null(dead_transfer);
  MUST(pnpbs_particles_destroy(&dead_particles));
  ck_assert_ptr_null(dead_particles);
  target = live.placement;
  must_be_refused(_i, NULL, "NULL");
  must_be_refused(_i, &never, "an address");
  must_be_refused(_i, (void*)(intptr_t)1, "1");
  must_be_refused(_i, (void*)(intptr_t)-1, "-1");
  must_be_refused(_i, copy.context, "a destroyed context");
  must_be_refused(_i, copy.domain, "a destroyed domain");
  must_be_refused(_i, copy.placement, "a destroyed placement");
  must_be_refused(_i, dead_copy, "a destroyed transfer");
  must_be_refused(_i, copy_of_particles, "destroyed particles");
  if (calls[_i].takes != CONTEXT) must_be_refused(_i, live.context, "a context");
  if (calls[_i].takes != DOMAIN) must_be_refused(_i, live.domain, "a domain");
  if (calls[_i].takes != PLACEMENT) must_be_refused(_i, live.placement, "a placement");
  if (calls[_i].takes != TRANSFER) must_be_refused(_i, transfer, "a transfer");
  if (calls[_i].takes != PARTICLES) must_be_refused(_i, particles, "particles");
  MUST(pnpbs_transfer_destroy(&transfer));
  MUST(pnpbs_particles_destroy(&particles));
  job_end(&live);
}
END_TEST

START_TEST(placements_of_nothing) {
  job live = square_job(1), dead = square_job(1);
  job copy = dead;
  pnpbs_placement placement = NULL;
  job_end(&dead);
  MUST_FAIL(PNPBS_ERROR_HANDLE, pnpbs_placement_create(live.context, NULL, &placement), "domain",
            "not live");
  ck_assert_ptr_null(placement);
  MUST_FAIL(PNPBS_ERROR_HANDLE, pnpbs_placement_create(live.context, copy.domain, &placement),
            "domain", "not live");
  MUST_FAIL(PNPBS_ERROR_HANDLE, pnpbs_placement_create(copy.context, live.domain, &placement),
            "context", "not live");
  MUST_FAIL(PNPBS_ERROR_HANDLE,
            pnpbs_placement_create(live.context, (pnpbs_domain)(void*)live.placement, &placement),
            "domain", "not live");
  MUST_FAIL(PNPBS_ERROR_HANDLE,
            pnpbs_placement_create((pnpbs_context)(void*)live.domain, live.domain, &placement),
            "context", "not live");
  ck_assert_ptr_null(placement);
  job_end(&live);
}
END_TEST

/* A domain of another context could be in use by another thread, as one thread uses a context at a
 * time. */
START_TEST(a_domain_of_another_context) {
  job one = square_job(1), other = square_job(1);
  pnpbs_placement placement = NULL;
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_placement_create(one.context, other.domain, &placement),
            "domain", "context");
  ck_assert_ptr_null(placement);
  job_end(&one);
  job_end(&other);
}
END_TEST

/* A transfer requires a live placement of the same context. */
START_TEST(transfers_to_nothing) {
  job one = square_job(1), other = square_job(1);
  pnpbs_transfer transfer = some_transfer(&one), elsewhere = some_transfer(&other);
  double value = 0;
  MUST_FAIL(PNPBS_ERROR_HANDLE, pnpbs_transfer_at_nodes(transfer, NULL, 0, 0, &value), "placement",
            "not live");
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_transfer_at_nodes(transfer, other.placement, 0, 0, &value),
            "placement", "context");
  MUST(pnpbs_transfer_destroy(&transfer));
  MUST_FAIL(PNPBS_ERROR_HANDLE, pnpbs_transfer_create(NULL, 0, 1, &value, &transfer), "placement",
            "not live");
  ck_assert_ptr_null(transfer);
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_transfer_create(one.placement, 0, 1, &value, NULL),
            "transfer", "NULL");
  /* A transfer remains usable when its placement and its context are destroyed. */
  job_end(&other);
  value = 1;
  MUST(pnpbs_transfer_at_points(elsewhere, 1, xy, &value));
  ck_assert_double_eq(value, 0);
  MUST(pnpbs_transfer_destroy(&elsewhere));
  job_end(&one);
}
END_TEST

/* Particles require a live placement and a live body of the same context. */
START_TEST(particles_of_nothing) {
  job one = square_job(1), other = square_job(1);
  pnpbs_transfer transfer = some_transfer(&one); /* this places the nodes */
  pnpbs_domain body = body_around(&one), elsewhere = body_around(&other);
  pnpbs_particles particles = NULL;
  int64_t count = 0;
  MUST_FAIL(PNPBS_ERROR_HANDLE, pnpbs_particles_create(NULL, body, &particles), "placement",
            "not live");
  MUST_FAIL(PNPBS_ERROR_HANDLE,
            pnpbs_particles_create((pnpbs_placement)(void*)body, body, &particles), "placement",
            "not live");
  ck_assert(pnpbs_particles_create(one.placement, NULL, &particles) < 0);
  ck_assert_ptr_nonnull(strstr(MESSAGE(), "body"));
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_particles_create(one.placement, elsewhere, &particles),
            "body", "context");
  ck_assert_ptr_null(particles);
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_particles_create(one.placement, body, NULL), "particles",
            "NULL");
  /* Particles remain usable when their placement, body and context are destroyed. */
  MUST(pnpbs_particles_create(one.placement, body, &particles));
  MUST(pnpbs_transfer_destroy(&transfer));
  MUST(pnpbs_domain_destroy(&body));
  job_end(&one);
  MUST(pnpbs_particles_sizes(particles, NULL, &count, NULL));
  ck_assert_int_gt(count, 0);
  MUST(pnpbs_particles_destroy(&particles));
  MUST(pnpbs_domain_destroy(&elsewhere));
  job_end(&other);
}
END_TEST

/* ---------------------------------------------------------------- destroying ------------ */

START_TEST(destroying_nothing) {
  pnpbs_context context = NULL;
  pnpbs_domain domain = NULL;
  pnpbs_placement placement = NULL;
  pnpbs_transfer transfer = NULL;
  pnpbs_particles particles = NULL;
  MUST(pnpbs_transfer_destroy(NULL));
  MUST(pnpbs_transfer_destroy(&transfer));
  MUST(pnpbs_particles_destroy(NULL));
  MUST(pnpbs_particles_destroy(&particles));
  MUST(pnpbs_context_destroy(NULL));
  MUST(pnpbs_context_destroy(&context));
  MUST(pnpbs_domain_destroy(NULL));
  MUST(pnpbs_domain_destroy(&domain));
  MUST(pnpbs_placement_destroy(NULL));
  MUST(pnpbs_placement_destroy(&placement));
}
END_TEST

START_TEST(destroying_twice) {
  job it = square_job(1);
  job copy = it;
  job_end(&it);
  ck_assert_ptr_null(it.context);
  ck_assert_ptr_null(it.domain);
  ck_assert_ptr_null(it.placement);
  job_end(&it); /* all are NULL already */
  MUST_FAIL(PNPBS_ERROR_HANDLE, pnpbs_context_destroy(&copy.context), "context", "destroyed");
  MUST_FAIL(PNPBS_ERROR_HANDLE, pnpbs_domain_destroy(&copy.domain), "domain", "destroyed");
  MUST_FAIL(PNPBS_ERROR_HANDLE, pnpbs_placement_destroy(&copy.placement), "placement", "destroyed");
}
END_TEST

START_TEST(destroying_another_kind) {
  job it = square_job(1);
  pnpbs_context context = (pnpbs_context)(void*)it.placement;
  pnpbs_domain domain = (pnpbs_domain)(void*)it.context;
  pnpbs_placement placement = (pnpbs_placement)(void*)it.domain;
  MUST_BE(PNPBS_ERROR_HANDLE, pnpbs_context_destroy(&context));
  MUST_BE(PNPBS_ERROR_HANDLE, pnpbs_domain_destroy(&domain));
  MUST_BE(PNPBS_ERROR_HANDLE, pnpbs_placement_destroy(&placement));
  job_end(&it);
}
END_TEST

/* Handles are not used again, so an old one never refers to a new object. */
START_TEST(handles_are_new) {
  job old = square_job(1);
  const job copy = old;
  job next;
  job_end(&old);
  next = square_job(1);
  ck_assert_ptr_ne(next.context, copy.context);
  ck_assert_ptr_ne(next.domain, copy.domain);
  ck_assert_ptr_ne(next.placement, copy.placement);
  job_end(&next);
}
END_TEST

static void destroy_one(job* it, int which) {
  if (which == 0) MUST(pnpbs_context_destroy(&it->context));
  if (which == 1) MUST(pnpbs_domain_destroy(&it->domain));
  if (which == 2) MUST(pnpbs_placement_destroy(&it->placement));
}

/* The remaining objects can be used, and their messages can be read. */
static void use_what_is_left(const job* it) {
  int64_t nodes = 0;
  if (it->context != NULL) MUST(pnpbs_context_set(it->context, "steps", "25"));
  if (it->domain != NULL) {
    double area = 0;
    MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_domain_add_hole(it->domain, NULL), "point", "NULL");
    MUST(pnpbs_domain_measure(it->domain, &area));
    ck_assert_double_eq(area, 1);
  }
  if (it->placement != NULL) {
    MUST(pnpbs_placement_set_spacing_constant(it->placement, 0.2));
    MUST_FAIL(PNPBS_ERROR_KEY, pnpbs_placement_set(it->placement, "step", "1"), "step", "steps");
    MUST(pnpbs_placement_count(it->placement, &nodes));
    ck_assert_int_gt(nodes, 20);
  }
}

START_TEST(any_order) {
  static const int orders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2},
                                   {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  job it = square_job(1);
  int k;
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.2));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  for (k = 0; k < 3; ++k) {
    destroy_one(&it, orders[_i][k]);
    /* A placement without its context and domain computes as before. */
    if (it.placement != NULL && it.domain == NULL) {
      MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.15));
      MUST_COMPUTE(pnpbs_placement_run(it.placement));
      check_placement(it.placement, 1);
    }
    use_what_is_left(&it);
  }
  job_end(&it); /* all are NULL already */
}
END_TEST

START_TEST(two_placements_in_one_domain) {
  job it = square_job(1);
  pnpbs_placement other = NULL;
  MUST(pnpbs_placement_create(it.context, it.domain, &other));
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.2));
  MUST(pnpbs_placement_set_spacing_constant(other, 0.1));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  MUST_COMPUTE(pnpbs_placement_run(other));
  ck_assert_int_gt(integer_of(other, "nodes"), 2 * integer_of(it.placement, "nodes"));
  job_end(&it);
  check_placement(other, 1);
  MUST(pnpbs_placement_destroy(&other));
}
END_TEST

TEST_SUITE(test_handles) {
  Suite* suite = suite_create("handles");
  TCase* live = tcase_create("not live");
  TCase* ends_of = tcase_create("destroying");
  tcase_add_test(live, every_function_is_here);
  tcase_add_loop_test(live, handles_that_are_not_live, 0, COUNT_OF(calls));
  tcase_add_test(live, placements_of_nothing);
  tcase_add_test(live, a_domain_of_another_context);
  tcase_add_test(live, transfers_to_nothing);
  tcase_add_test(live, particles_of_nothing);
  suite_add_tcase(suite, live);
  tcase_add_test(ends_of, destroying_nothing);
  tcase_add_test(ends_of, destroying_twice);
  tcase_add_test(ends_of, destroying_another_kind);
  tcase_add_test(ends_of, handles_are_new);
  tcase_add_loop_test(ends_of, any_order, 0, 6);
  tcase_add_test(ends_of, two_placements_in_one_domain);
  suite_add_tcase(suite, ends_of);
  return run_suite(suite);
}
