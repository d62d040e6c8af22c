/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests small dihedral angles. Angles at sharp edges of the body are counted separately. The
 * others are reported to the user and, with the option min_angle, enlarged by a smaller d. If nodes
 * are too close to each other, or lie in a plane across a bar, one is removed or inserted.
 */
#include "volume_support.h"

/* ---------------------------------------------------------------- by hand --------------- */

static void difference(const double* a, const double* b, double* of) {
  int k;
  for (k = 0; k < 3; ++k) of[k] = a[k] - b[k];
}

static double dot(const double* a, const double* b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Computes the part of x - a that is orthogonal to the edge from a to b. */
static void across(const double* a, const double* b, const double* x, double* part) {
  double edge[3], way[3];
  int k;
  difference(b, a, edge);
  difference(x, a, way);
  for (k = 0; k < 3; ++k) part[k] = way[k] - dot(way, edge) / dot(edge, edge) * edge[k];
}

static double least_angle(const volume* v, int64_t t) {
  static const int edges[6][4] = {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2},
                                  {1, 2, 0, 3}, {1, 3, 0, 2}, {2, 3, 0, 1}};
  double least = 180;
  int e;
  for (e = 0; e < 6; ++e) {
    const double* x[4];
    double u[3], w[3];
    int k;
    for (k = 0; k < 4; ++k) x[k] = v->xyz + 3 * v->corners[4 * t + edges[e][k]];
    across(x[0], x[1], x[2], u);
    across(x[0], x[1], x[3], w);
    least = fmin(least, acos(dot(u, w) / sqrt(dot(u, u) * dot(w, w))) * 180 / PI);
  }
  return least;
}

static int64_t elements_below(const job* it, double angle) {
  volume v = volume_of(it->placement);
  int64_t below = 0, t;
  for (t = 0; t < v.tetrahedra; ++t) below += least_angle(&v, t) < angle;
  volume_free(&v);
  return below;
}

/* ---------------------------------------------------------------- a wedge --------------- */

/* Adds a wedge of 20 degrees. Its sharp edge lies on the y axis, from 0 to 1. */
static pnpbs_status wedge(pnpbs_domain domain, const char* data) {
  const double h = tan(20 * PI / 180);
  const double xyz[] = {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 1, 0, h, 1, 1, h};
  static const int faces[][4] = {
      {0, 1, 3, 2}, {0, 4, 5, 1}, {2, 3, 5, 4}, {0, 2, 4, 0}, {1, 5, 3, 1}};
  (void)data;
  return volume_add_quads(domain, PNPBS_BOUNDARY, 6, xyz, 5, faces);
}

static int is_at_the_edge(const volume* v, int64_t t) {
  int k, found = 0;
  for (k = 0; k < 4; ++k) {
    const int64_t i = v->corners[4 * t + k];
    const double* x = v->xyz + 3 * i;
    found |= sqrt(x[0] * x[0] + x[2] * x[2]) < v->d[i]; /* all y are between 0 and 1 */
  }
  return found;
}

START_TEST(those_at_sharp_edges_are_told_apart) {
  job it = body_job(wedge);
  double at_edge = 180, elsewhere = 180;
  volume v;
  int64_t t;
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.1));
  MUST(pnpbs_placement_set(it.placement, "min_angle", "20"));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  v = volume_of(it.placement);
  for (t = 0; t < v.tetrahedra; ++t) {
    double* least = is_at_the_edge(&v, t) ? &at_edge : &elsewhere;
    *least = fmin(*least, least_angle(&v, t));
  }
  volume_free(&v);
  ck_assert_double_lt(at_edge, 20.001);
  ck_assert_double_gt(elsewhere, 20);
  ck_assert_double_eq_tol(real_of(it.placement, "quality.min_angle_at_sharp_edges"), at_edge, 1e-6);
  ck_assert_double_eq_tol(real_of(it.placement, "quality.min_angle_elsewhere"), elsewhere, 1e-6);
  /* d has not been reduced. */
  ck_assert_int_eq(integer_of(it.placement, "unresolved_places"), 0);
  ck_assert_int_eq(warnings_with(it.placement, "dihedral angles"), 0);
  job_end(&it);
}
END_TEST

START_TEST(in_the_plane_there_are_no_sharp_edges) {
  job it = square_job(1);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.1));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  ck_assert_double_eq(real_of(it.placement, "quality.min_angle_at_sharp_edges"), 180);
  ck_assert_double_eq(real_of(it.placement, "quality.min_angle_elsewhere"),
                      real_of(it.placement, "quality.min_angle"));
  job_end(&it);
}
END_TEST

/* ---------------------------------------------------------------- nodes that come and go - */

/* Adds a roof over a square, whose ridge is a tenth of d long. */
static pnpbs_status roof(pnpbs_domain domain, const char* data) {
  const double xyz[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.495, 0.5, 0.5, 0.505, 0.5, 0.5};
  static const int faces[][4] = {
      {0, 3, 2, 1}, {0, 1, 5, 4}, {2, 3, 4, 5}, {1, 2, 5, 1}, {3, 0, 4, 3}};
  (void)data;
  return volume_add_quads(domain, PNPBS_BOUNDARY, 6, xyz, 5, faces);
}

/* Adds the same roof, with both ends of the ridge as fixed nodes. */
static pnpbs_status roof_with_nodes(pnpbs_domain domain, const char* data) {
  const double xyz[] = {0.495, 0.5, 0.5, 0.505, 0.5, 0.5};
  const pnpbs_status status = roof(domain, data);
  return status < 0 ? status : pnpbs_domain_add_fixed_nodes(domain, 2, xyz, NULL);
}

START_TEST(one_end_of_a_short_edge_leaves) {
  job it = body_job(roof), given = body_job(roof_with_nodes);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.1));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  ck_assert_int_eq(integer_of(it.placement, "left_out"), 1);
  ck_assert_int_eq(warnings_with(it.placement, "left out: 1 nodes of corners"), 1);
  ck_assert_int_eq(elements_below(&it, 15), 0);
  ck_assert_int_eq(integer_of(it.placement, "unresolved_places"), 0);
  ck_assert_int_eq(pnpbs_placement_check(it.placement), PNPBS_OK);
  MUST(pnpbs_placement_set_spacing_constant(given.placement, 0.1));
  MUST_COMPUTE(pnpbs_placement_run(given.placement));
  ck_assert_int_eq(integer_of(given.placement, "left_out"), 0);
  job_end(&given);
  job_end(&it);
}
END_TEST

/* Adds a plate as thick as a quarter of d. No nodes are removed, although its upper and lower edges
 * run close to each other. */
static pnpbs_status plate(pnpbs_domain domain, const char* data) {
  const double low[] = {0, 0, 0}, high[] = {1, 1, 0.025};
  (void)data;
  return pnpbs_domain_add_box(domain, low, high, 1);
}

START_TEST(edges_beside_each_other_keep_their_nodes) {
  job it = body_job(plate);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.1));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  ck_assert_int_gt(elements_below(&it, 15), 0);
  ck_assert_int_eq(integer_of(it.placement, "left_out"), 0);
  job_end(&it);
}
END_TEST

/* Adds a bar as thick as d with oblique ends. Four nodes on its edges lie nearly in a plane across
 * it. */
static pnpbs_status bar(pnpbs_domain domain, const char* data) {
  const double xyz[] = {0,   0, 0, 0,    0.08, 0, 0,   0.08, 0.08, 0,    0, 0.08,
                        0.5, 0, 0, 0.54, 0.08, 0, 0.5, 0.08, 0.08, 0.54, 0, 0.08};
  static const int faces[][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                 {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  (void)data;
  return volume_add_quads(domain, PNPBS_BOUNDARY, 8, xyz, 6, faces);
}

START_TEST(a_flat_element_across_a_bar_gets_a_node) {
  job it = body_job(bar);
  int64_t inner = 0, t;
  volume v;
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.1));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  ck_assert_int_eq(elements_below(&it, 15), 0);
  ck_assert_int_eq(pnpbs_placement_check(it.placement), PNPBS_OK);
  v = volume_of(it.placement);
  for (t = 0; t < v.n; ++t) {
    const double* x = v.xyz + 3 * t;
    inner += x[1] > 0.01 && x[1] < 0.07 && x[2] > 0.01 && x[2] < 0.07 && x[0] > 0.01 && x[0] < 0.49;
  }
  volume_free(&v);
  ck_assert_int_ge(inner, 1);
  ck_assert_int_le(inner, 2);
  job_end(&it);
}
END_TEST

/* ---------------------------------------------------------------- a smaller d ----------- */

/* Runs with d = 6 mm on a bracket with steps of 1 mm. */
static job coarse_bracket(const char* min_angle) {
  job it = body_job(volume_bracket);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 6)); /* d, in mm */
  MUST(pnpbs_placement_set(it.placement, "min_angle", min_angle));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  return it;
}

START_TEST(they_are_enlarged) {
  job it = coarse_bracket("0"), enlarged = coarse_bracket("15");
  ck_assert_int_gt(elements_below(&it, 15), 0);
  ck_assert_int_eq(integer_of(it.placement, "unresolved_places"), 0);
  ck_assert_int_eq(elements_below(&enlarged, 15), 0);
  ck_assert_int_gt(integer_of(enlarged.placement, "unresolved_places"), 0);
  ck_assert_int_eq(warnings_with(enlarged.placement, "is reduced there"), 1);
  ck_assert_int_eq(warnings_with(enlarged.placement, "dihedral angles"), 0);
  ck_assert_double_lt((double)integer_of(enlarged.placement, "nodes"),
                      1.3 * (double)integer_of(it.placement, "nodes"));
  check_body(&enlarged, 0.02);
  job_end(&enlarged);
  job_end(&it);
}
END_TEST

/* More rounds never give more small angles, as a round without an improvement is discarded. */
START_TEST(the_best_round_counts) {
  const int last = WHEN_SANITIZED(1, 6);
  int64_t small_before = INT64_MAX, steps_before = 0;
  hash_text hash_before = {""};
  int rounds;
  for (rounds = 0; rounds <= last; ++rounds) {
    job it = rough_job(0.4, 6, 0.3);
    int64_t small, steps;
    char text[2] = {(char)('0' + rounds), 0};
    MUST(pnpbs_placement_set(it.placement, "min_angle", "25"));
    MUST(pnpbs_placement_set(it.placement, "conforming_rounds", text));
    MUST_COMPUTE(pnpbs_placement_run(it.placement));
    ck_assert_int_eq(pnpbs_placement_check(it.placement), PNPBS_OK);
    small = elements_below(&it, 25);
    steps = integer_of(it.placement, "steps");
    ck_assert_int_le(small, small_before);
    ck_assert_int_eq(warnings_with(it.placement, "dihedral angles below 25"), small > 0);
    if (small == small_before) ck_assert_str_eq(hash_of(it.placement).text, hash_before.text);
    ck_assert_int_ge(steps, steps_before); /* steps of all rounds */
    small_before = small;
    steps_before = steps;
    hash_before = hash_of(it.placement);
    /* The placement can continue afterwards. */
    if (rounds == last) {
      MUST_COMPUTE(pnpbs_placement_step(it.placement, 10));
      MUST_COMPUTE(pnpbs_placement_run(it.placement));
      ck_assert_int_eq(pnpbs_placement_check(it.placement), PNPBS_OK);
    }
    job_end(&it);
  }
}
END_TEST

typedef struct {
  pnpbs_placement placement;
  int64_t turns;      /* calls in rounds after the first */
  pnpbs_status saved; /* status of a checkpoint in one of these rounds */
} trial;

/* Stops the run in the second round. */
static int32_t stop_in_a_trial(double fraction, int64_t step, int64_t nodes, double max_speed,
                               void* user) {
  trial* it = user;
  (void)fraction, (void)step, (void)nodes, (void)max_speed;
  if (integer_of(it->placement, "unresolved_places") == 0) return 0;
  if (it->turns++ == 1) it->saved = pnpbs_placement_write_checkpoint(it->placement, "no.vtkhdf");
  return it->turns > 2;
}

/* A stop in a round restores the best result so far. */
START_TEST(a_stop_in_a_round_leaves_the_best_one) {
  job first = rough_job(0.4, 6, 0.3), stopped = rough_job(0.4, 6, 0.3);
  trial it = {stopped.placement, 0, PNPBS_OK};
  MUST(pnpbs_placement_set(first.placement, "min_angle", "0"));
  MUST_COMPUTE(pnpbs_placement_run(first.placement));
  MUST(pnpbs_placement_set(stopped.placement, "min_angle", "25"));
  MUST(pnpbs_placement_set_monitor(stopped.placement, stop_in_a_trial, &it));
  MUST_BE(PNPBS_STOPPED, pnpbs_placement_run(stopped.placement));
  ck_assert_int_eq(it.turns, 3);
  ck_assert_int_eq(it.saved, PNPBS_ERROR_STATE); /* the round may be discarded */
  ck_assert_str_eq(hash_of(stopped.placement).text, hash_of(first.placement).text);
  ck_assert_int_eq(integer_of(stopped.placement, "unresolved_places"), 0);
  ck_assert_int_eq(integer_of(stopped.placement, "finished"), 0);
  ck_assert_int_eq(pnpbs_placement_check(stopped.placement), PNPBS_OK);
  MUST(pnpbs_placement_set_monitor(stopped.placement, NULL, NULL));
  MUST_COMPUTE(pnpbs_placement_run(stopped.placement));
  ck_assert_int_gt(integer_of(stopped.placement, "unresolved_places"), 0);
  job_end(&stopped);
  job_end(&first);
}
END_TEST

/* By default, elements with angles below 2 degrees are enlarged. If the user sets 0, a warning
 * mentions them. */
START_TEST(a_user_is_told) {
  job it = rough_job(0.3, 8, 0.3), enlarged = rough_job(0.3, 8, 0.3);
  MUST(pnpbs_placement_set(it.placement, "min_angle", "0"));
  MUST_COMPUTE(pnpbs_placement_run(enlarged.placement));
  ck_assert_int_gt(integer_of(enlarged.placement, "unresolved_places"), 0);
  ck_assert_int_eq(warnings_with(enlarged.placement, "min_angle"), 0);
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  ck_assert_int_gt(elements_below(&it, 2), 0);
  ck_assert_int_eq(warnings_with(it.placement, "dihedral angles below 2 degrees: "), 1);
  ck_assert_int_eq(warnings_with(it.placement, "min_angle"), 1);
  ck_assert_int_lt(elements_below(&enlarged, 2), elements_below(&it, 2));
  job_end(&enlarged);
  job_end(&it);
}
END_TEST

TEST_SUITE(test_element_angles) {
  Suite* suite = suite_create("element angles");
  TCase *angles = tcase_create("angles"), *changes = tcase_create("changes");
  tcase_set_timeout(angles, 0);
  tcase_add_test(angles, those_at_sharp_edges_are_told_apart);
  tcase_add_test(angles, in_the_plane_there_are_no_sharp_edges);
  tcase_add_test(changes, one_end_of_a_short_edge_leaves);
  tcase_add_test(changes, edges_beside_each_other_keep_their_nodes);
  tcase_add_test(changes, a_flat_element_across_a_bar_gets_a_node);
  if (WHEN_SANITIZED(0, 1)) tcase_add_test(angles, they_are_enlarged);
  tcase_add_test(angles, the_best_round_counts);
  tcase_add_test(angles, a_stop_in_a_round_leaves_the_best_one);
  tcase_add_test(angles, a_user_is_told);
  suite_add_tcase(suite, angles);
  tcase_set_timeout(changes, 0);
  suite_add_tcase(suite, changes);
  return run_suite(suite);
}
