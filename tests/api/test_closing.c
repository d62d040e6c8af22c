/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests bodies that are rough compared with d. The boundary of the tetrahedra must still be one
 * closed surface with the topology of the body. Otherwise the run and the check must report it.
 */
#include "volume_support.h"

/* ---------------------------------------------------------------- bodies ---------------- */

/* Adds a cube with a slit of this width and depth that is open at the top and whose tip is at `x`.
 */
static void add_slit_cube(pnpbs_domain domain, double width, double depth, double x) {
  enum { kSides = 7 };
  const double outline[kSides][2] = {{x, 1 - depth}, {x - width / 2, 1}, {0, 1}, {0, 0}, {1, 0},
                                     {1, 1},         {x + width / 2, 1}};
  double xyz[2 * kSides][3];
  int64_t corners[4 * kSides][3], n = 0;
  int k;
  for (k = 0; k < 2 * kSides; ++k) {
    xyz[k][0] = outline[k % kSides][0];
    xyz[k][1] = outline[k % kSides][1];
    xyz[k][2] = k / kSides;
  }
  for (k = 0; k < kSides; ++k) { /* the end faces are triangulated from the tip */
    const int64_t next = (k + 1) % kSides,
                  side[2][3] = {{k, next, next + kSides}, {k, next + kSides, k + kSides}},
                  ends[2][3] = {{0, next, k}, {kSides, k + kSides, next + kSides}};
    memcpy(corners[n], side, sizeof side);
    n += 2;
    if (k == 0 || next == 0) continue;
    memcpy(corners[n], ends, sizeof ends);
    n += 2;
  }
  MUST(pnpbs_domain_add_surface(domain, PNPBS_BOUNDARY, 2 * kSides, xyz[0], n, corners[0], NULL,
                                40));
}

/* ---------------------------------------------------------------- what closes ----------- */

static int by_ends(const void* a, const void* b) {
  const int64_t *p = a, *q = b;
  return p[0] != q[0] ? (p[0] < q[0] ? -1 : 1) : (p[1] > q[1]) - (p[1] < q[1]);
}

/* Collects the edges of the boundary triangles. Returns the number of edges that do not have
 * exactly two triangles. */
static int64_t open_edges(const volume* v, int64_t* edges) {
  int64_t(*ends)[2] = malloc((size_t)(3 * v->triangles) * sizeof *ends);
  int64_t t, e = 0, wrong = 0;
  int k;
  for (t = 0; t < v->triangles; ++t)
    for (k = 0; k < 3; ++k, ++e) {
      const int64_t a = v->sides[3 * t + k], b = v->sides[3 * t + (k + 1) % 3];
      ends[e][0] = a < b ? a : b;
      ends[e][1] = a < b ? b : a;
    }
  qsort(ends, (size_t)e, sizeof *ends, by_ends);
  *edges = 0;
  for (t = 0; t < e;) {
    int64_t next = t;
    while (next < e && by_ends(ends[t], ends[next]) == 0) ++next;
    wrong += next - t != 2;
    ++*edges;
    t = next;
  }
  free(ends);
  return wrong;
}

/* Checks that the nodes of the boundary triangles are those on the surface, and that the triangles
 * form a sphere: two at each edge, and the Euler characteristic 2. The characteristic is smaller if
 * two sheets share a node. */
static void check_closed(const volume* v) {
  char* on_boundary = calloc((size_t)v->n, 1);
  int64_t i, t, edges, nodes = 0;
  for (t = 0; t < 3 * v->triangles; ++t) on_boundary[v->sides[t]] = 1;
  for (i = 0; i < v->n; ++i) {
    ck_assert_int_eq(on_boundary[i], v->tags[i] != 0);
    nodes += on_boundary[i];
  }
  ck_assert_int_eq(open_edges(v, &edges), 0);
  ck_assert_int_eq(nodes - edges + v->triangles, 2); /* the Euler characteristic of a sphere */
  free(on_boundary);
}

static void check_is_closed(const job* it) {
  volume v;
  ck_assert_int_eq(pnpbs_placement_check(it->placement), PNPBS_OK);
  ck_assert_int_eq(warnings_with(it->placement, "torn"), 0);
  v = volume_of(it->placement);
  check_closed(&v);
  volume_free(&v);
}

/* Runs and checks that the body is closed. The status may be that d is missed, as bodies that are
 * rough compared with d need not follow it. */
static void run_and_check_closed(const job* it) {
  const pnpbs_status status = pnpbs_placement_run(it->placement);
  ck_assert_msg(status >= 0 && status != PNPBS_STOPPED && status != PNPBS_NOT_CONFORMING,
                "status %d: %s", (int)status, MESSAGE());
  check_is_closed(it);
}

START_TEST(rough_bodies_close) {
  static const double cases[][3] = {{0.6, 5, 0.2}, {0.6, 6, 0.3}, {0.8, 8, 0.2}};
  job it = rough_job(cases[_i][0], cases[_i][1], cases[_i][2]);
  run_and_check_closed(&it);
  job_end(&it);
}
END_TEST

START_TEST(torn_bodies_are_told) {
  job it = unresolved_job();
  static const char* const told[] = {"is torn at ", "has the Euler characteristic ",
                                     " pieces, that of the domain of ",
                                     "the tetrahedra have the volume "};
  const char* which = NULL;
  size_t k;
  MUST(pnpbs_placement_set(it.placement, "conforming_rounds", "0"));
  ck_assert_int_eq(pnpbs_placement_run(it.placement), PNPBS_NOT_CONFORMING);
  for (k = 0; k < sizeof told / sizeof told[0]; ++k)
    if (warnings_with(it.placement, told[k]) == 1) {
      ck_assert_ptr_null(which);
      which = told[k];
    }
  ck_assert_ptr_nonnull(which);
  ck_assert_int_eq(pnpbs_placement_check(it.placement), PNPBS_NOT_CONFORMING);
  ck_assert_ptr_nonnull(strstr(MESSAGE(), which));
  ck_assert_ptr_nonnull(strstr(MESSAGE(), "pnpbs_domain_set_resurfaced"));
  job_end(&it);
}
END_TEST

/* The message about a torn body advises to remove features that d does not resolve. The repaired
 * body is then closed at the same d. */
START_TEST(repaired_to_the_spacing_it_closes) {
  const double d = 0.4;
  job it = repaired_job(0.7, 6.5, d, d);
  pnpbs_status status;
  MUST(pnpbs_placement_set(it.placement, "conforming_rounds", "0"));
  status = pnpbs_placement_run(it.placement);
  ck_assert_msg(status >= 0 && status != PNPBS_NOT_CONFORMING, "status %d", (int)status);
  check_is_closed(&it);
  job_end(&it);
}
END_TEST

START_TEST(torn_bodies_are_mended) {
  job it = unresolved_job();
  run_and_check_closed(&it);
  ck_assert_int_gt(integer_of(it.placement, "unresolved_places"), 0);
  job_end(&it);
}
END_TEST

/* If the walls of a slit are nearer to each other than d, other elements are chosen until the
 * boundary closes. No node needs to be inserted. */
START_TEST(a_slit_closes) {
  const double half_angle = 8.4428 / 2 * 3.14159265358979 / 180, depth = 0.5497;
  job it = {NULL, NULL, NULL};
  MUST(pnpbs_context_create_serial(&it.context));
  MUST(pnpbs_domain_create(it.context, 3, &it.domain));
  add_slit_cube(it.domain, 2 * depth * tan(half_angle), depth, 0.5203);
  job_place(&it);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.08));
  MUST(pnpbs_placement_set(it.placement, "conforming_rounds", "0"));
  run_and_check_closed(&it);
  job_end(&it);
}
END_TEST

/* The same holds if the surface is rough. */
START_TEST(a_rough_body_closes_at_once) {
  job it = rough_job(0.4, 8, 0.3);
  MUST(pnpbs_placement_set(it.placement, "conforming_rounds", "0"));
  run_and_check_closed(&it);
  job_end(&it);
}
END_TEST

/* If inner nodes prevent the boundary from closing, they are deleted. */
START_TEST(blocking_nodes_leave) {
  job it = rough_job(0.5, 6.5, 0.32);
  MUST(pnpbs_placement_set(it.placement, "conforming_rounds", "0"));
  run_and_check_closed(&it);
  ck_assert_int_gt(integer_of(it.placement, "deleted"), 0);
  job_end(&it);
}
END_TEST

/* ---------------------------------------------------------------- rounds ---------------- */

typedef struct {
  double fraction, stop_from; /* stops after the first step from this fraction on, once */
  int64_t step;
  int falls, stopped;
} progress;

static int32_t follow(double fraction, int64_t step, int64_t nodes, double speed, void* data) {
  progress* seen = data;
  const int stepped = step > seen->step;
  (void)nodes, (void)speed;
  seen->falls += fraction < seen->fraction;
  seen->fraction = fraction;
  seen->step = step;
  if (seen->stopped || !stepped || fraction < seen->stop_from) return 0;
  seen->stopped = 1;
  return 1;
}

/* In a run that holds d down where the body is torn, the reported fraction never decreases. The
 * monitor can stop the run in any of its parts, and the next run continues from there. */
START_TEST(rounds_are_monitored) {
  static const double stops[] = {2, 0.9, 0.9001, 0.91};
  progress seen = {0, stops[_i], 0, 0, 0};
  job it = unresolved_job();
  MUST(pnpbs_placement_set_monitor(it.placement, follow, &seen));
  if (seen.stop_from > 1) {
    run_and_check_closed(&it);
    ck_assert_double_eq(seen.fraction, 1);
  } else {
    ck_assert_int_eq(pnpbs_placement_run(it.placement), PNPBS_STOPPED);
    ck_assert(seen.stopped);
    MUST(pnpbs_placement_set_monitor(it.placement, NULL, NULL));
    run_and_check_closed(&it);
  }
  ck_assert_int_eq(seen.falls, 0);
  if (seen.stop_from > 1) ck_assert_int_gt(integer_of(it.placement, "unresolved_places"), 0);
  job_end(&it);
}
END_TEST

/* The number of start nodes that a run dropped remains available after further rounds. */
START_TEST(rounds_keep_what_was_left_out) {
  static const double xyz[] = {0, 0, 0, 9, 9, 9};
  job it = unresolved_job();
  MUST(pnpbs_placement_set_nodes(it.placement, 2, xyz, NULL));
  run_and_check_closed(&it);
  ck_assert_int_gt(integer_of(it.placement, "unresolved_places"), 0);
  ck_assert_int_eq(integer_of(it.placement, "dropped"), 1);
  job_end(&it);
}
END_TEST

/* Returns the largest growth of d between any two nodes, per unit of length. */
static double steepest(const volume* v) {
  double growth = 0;
  int64_t i, j;
  for (i = 0; i < v->n; ++i)
    for (j = 0; j < i; ++j)
      growth = fmax(growth, fabs(v->d[i] - v->d[j]) / distance(v->xyz + 3 * i, v->xyz + 3 * j));
  return growth;
}

/* d grows from the points where it is held down at a rate that nodes can follow, even without
 * another limit of growth. */
START_TEST(held_spacing_grows_gently) {
  job it = unresolved_job();
  volume v;
  MUST(pnpbs_placement_set(it.placement, "growth_limit", "0"));
  run_and_check_closed(&it);
  ck_assert_int_gt(integer_of(it.placement, "unresolved_places"), 0);
  v = volume_of(it.placement);
  ck_assert_double_gt(steepest(&v), 0.1);
  ck_assert_double_le(steepest(&v), 0.3 + 1e-9);
  volume_free(&v);
  job_end(&it);
}
END_TEST

static int32_t rough_level_set(int64_t n, int32_t dim, const double* x, double* value, void* user) {
  int64_t i;
  (void)dim, (void)user;
  for (i = 0; i < n; ++i, x += 3)
    value[i] = sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]) - 1 -
               0.4 * sin(11 * x[0]) * sin(11 * x[1] + 1) * sin(11 * x[2] + 2);
  return 0;
}

static double finest(const volume* v) {
  double least = v->d[0];
  int64_t i;
  for (i = 0; i < v->n; ++i) least = fmin(least, v->d[i]);
  return least;
}

/* d is not held below the resolution of a level set, since its triangles do not represent anything
 * smaller. (With more rounds the body closes.) */
START_TEST(held_spacing_ends_at_the_resolution) {
  static const double low[] = {-2, -2, -2}, high[] = {2, 2, 2};
  job it = {NULL, NULL, NULL};
  volume v;
  MUST(pnpbs_context_create_serial(&it.context));
  MUST(pnpbs_domain_create(it.context, 3, &it.domain));
  MUST(pnpbs_domain_add_level_set(it.domain, rough_level_set, NULL, low, high, 0.26, 1));
  job_place(&it);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.36));
  MUST(pnpbs_placement_set(it.placement, "conforming_rounds", "2"));
  ck_assert_int_eq(pnpbs_placement_run(it.placement), PNPBS_NOT_CONFORMING);
  ck_assert_int_gt(integer_of(it.placement, "unresolved_places"), 0);
  v = volume_of(it.placement);
  ck_assert_double_eq_tol(finest(&v), 0.26, 1e-3);
  ck_assert_double_ge(finest(&v), 0.26);
  volume_free(&v);
  job_end(&it);
}
END_TEST

TEST_SUITE(test_closing) {
  Suite* suite = suite_create("closing");
  TCase* tests = tcase_create("closing");
  tcase_set_timeout(tests, 0);
  tcase_add_loop_test(tests, rough_bodies_close, 0, WHEN_SANITIZED(1, 3));
  tcase_add_test(tests, a_slit_closes);
  tcase_add_test(tests, a_rough_body_closes_at_once);
  tcase_add_test(tests, blocking_nodes_leave);
  tcase_add_test(tests, torn_bodies_are_told);
  if (WHEN_SANITIZED(0, 1)) tcase_add_test(tests, repaired_to_the_spacing_it_closes);
  /* Sanitized code does not need these two tests, as rounds_are_monitored covers them. */
  if (WHEN_SANITIZED(0, 1)) tcase_add_test(tests, torn_bodies_are_mended);
  tcase_add_loop_test(tests, rounds_are_monitored, 0, WHEN_SANITIZED(2, 4));
  tcase_add_test(tests, rounds_keep_what_was_left_out);
  if (WHEN_SANITIZED(0, 1)) tcase_add_test(tests, held_spacing_grows_gently);
  tcase_add_test(tests, held_spacing_ends_at_the_resolution);
  suite_add_tcase(suite, tests);
  return run_suite(suite);
}
