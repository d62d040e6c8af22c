/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests domains with hardly any room, spacings that are too large or far too small, and every
 * combination of the options that select a method.
 */
#include "api_support.h"

static void add_loop(job* it, int64_t n, const double* xy) {
  MUST(pnpbs_domain_add_polyline(it->domain, PNPBS_BOUNDARY, 1, n, xy, NULL, 0));
}

static result run(job* it, double d) {
  job_place(it);
  MUST(pnpbs_placement_set_spacing_constant(it->placement, d));
  MUST_COMPUTE(pnpbs_placement_run(it->placement));
  return result_of(it->placement);
}

/* ---------------------------------------------------------------- hardly any room ------- */

START_TEST(a_triangle_smaller_than_d) {
  static const double spacings[] = {0.1, 0.5, 1, 10, 1e6};
  const double xy[6] = {0, 0, 0.1, 0, 0.04, 0.08};
  job it = job_begin();
  result nodes;
  int64_t entries = 0, offsets[4], neighbours[6];
  add_loop(&it, 3, xy);
  nodes = run(&it, spacings[_i]);
  check_result(&nodes, 1);
  ck_assert_int_eq(nodes.n, 3);
  ck_assert_int_eq(nodes.triangles, 1);
  MUST(pnpbs_placement_adjacency_size(it.placement, &entries));
  ck_assert_int_eq(entries, 6);
  MUST(pnpbs_placement_get_adjacency(it.placement, 6, offsets, neighbours));
  ck_assert_int_eq(offsets[3], 6);
  ck_assert(isfinite(real_of(it.placement, "d_error.mean")));
  ck_assert(isfinite(real_of(it.placement, "speed.mean")));
  MUST_COMPUTE(pnpbs_placement_step(it.placement, 50));
  MUST(pnpbs_placement_adjust_population(it.placement, NULL, NULL));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  check_placement(it.placement, 1);
  result_free(&nodes);
  job_end(&it);
}
END_TEST

/* No inner node fits into the strip, so its triangles connect boundary nodes only. */
START_TEST(a_strip_narrower_than_d) {
  const double xy[8] = {0, 0, 2, 0, 2, 0.05, 0, 0.05};
  job it = job_begin();
  result nodes;
  add_loop(&it, 4, xy);
  nodes = run(&it, 0.1);
  check_result(&nodes, 1);
  ck_assert_int_eq(nodes.n, 42);
  ck_assert_int_eq(nodes.triangles, 40);
  ck_assert_double_eq_tol(triangle_area(&nodes), 0.1, 1e-13);
  result_free(&nodes);
  job_end(&it);
}
END_TEST

/* Strips of every width from none to three rows of inner nodes have correct results. */
START_TEST(strips) {
  const double width = 0.02 * (_i + 1);
  double xy[8] = {0, 0, 1, 0, 1, 0, 0, 0};
  job it = job_begin();
  result nodes;
  xy[5] = xy[7] = width;
  add_loop(&it, 4, xy);
  nodes = run(&it, 0.1);
  check_result(&nodes, 1);
  ck_assert_double_eq_tol(triangle_area(&nodes), width, 1e-13);
  if (width < 0.075) ck_assert_int_eq(nodes.n, integer_of(it.placement, "boundary_nodes"));
  if (width > 0.165) ck_assert_int_gt(nodes.n, integer_of(it.placement, "boundary_nodes"));
  result_free(&nodes);
  job_end(&it);
}
END_TEST

/* A hexagon of side d has room for one inner node, which moves to the centre. */
START_TEST(one_inner_node) {
  double xy[12];
  const double start[2] = {0.2, -0.1};
  job it = job_begin();
  result nodes;
  int64_t i, inner = -1;
  int k;
  for (k = 0; k < 6; ++k) xy[2 * k] = cos(PI * k / 3), xy[2 * k + 1] = sin(PI * k / 3);
  add_loop(&it, 6, xy);
  job_place(&it);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 1));
  MUST(pnpbs_placement_set_nodes(it.placement, 1, start, NULL));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  nodes = result_of(it.placement);
  check_result(&nodes, 1);
  ck_assert_int_eq(nodes.n, 7);
  for (i = 0; i < 7; ++i) {
    if (nodes.tags[i] == 0) inner = i;
  }
  ck_assert_int_ge(inner, 0);
  ck_assert_double_eq_tol(nodes.xy[2 * inner], 0, 0.02);
  ck_assert_double_eq_tol(nodes.xy[2 * inner + 1], 0, 0.02);
  ck_assert_int_eq(nodes.triangles, 6);
  ck_assert_double_eq_tol(real_of(it.placement, "d_error.mean"), 1, 0.02);
  result_free(&nodes);
  job_end(&it);
}
END_TEST

/* A wedge of one degree has nodes only where there is room. */
START_TEST(a_wedge) {
  const double xy[6] = {0, 0, 1, 0, 1, 0.0175};
  job it = job_begin();
  result nodes;
  add_loop(&it, 3, xy);
  nodes = run(&it, 0.01);
  check_result(&nodes, 1);
  ck_assert_double_eq_tol(triangle_area(&nodes), 0.5 * 0.0175, 1e-14);
  result_free(&nodes);
  job_end(&it);
}
END_TEST

/* Domains far from the origin, tiny domains and huge ones have correct results. */
START_TEST(scales) {
  static const double cases[][3] = {{1e-6, 0, 0},  {1e6, 0, 0},  {1, 1e6, -1e6},
                                    {1e-50, 0, 0}, {1e50, 0, 0}, {1, 1e9, 1e9}};
  const double s = cases[_i][0], x = cases[_i][1], y = cases[_i][2];
  job it = job_begin(), plain = square_job(1);
  result nodes;
  add_rectangle(it.domain, PNPBS_BOUNDARY, x, y, x + s, y + s, 1);
  MUST(pnpbs_placement_set_spacing_constant(plain.placement, 0.125));
  MUST_COMPUTE(pnpbs_placement_run(plain.placement));
  nodes = run(&it, 0.125 * s);
  if (s > 1e-100 && s < 1e100) {
    check_result(&nodes, 1); /* beyond these limits the arithmetic of the check fails */
    ck_assert(fabs(quality_of(&nodes).mean - 1) < 0.1);
  }
  ck_assert_msg(fabs((double)nodes.n / (double)integer_of(plain.placement, "nodes") - 1) < 0.1,
                "%d nodes", (int)nodes.n);
  ck_assert_int_eq(nodes.n - nodes.entries / 2 + nodes.triangles, 1);
  ck_assert_double_eq_tol(real_of(it.placement, "d_error.mean"),
                          real_of(plain.placement, "d_error.mean"), 0.06);
  result_free(&nodes);
  job_end(&it);
  job_end(&plain);
}
END_TEST

/* ---------------------------------------------------------------- too large, too small -- */

START_TEST(more_nodes_than_allowed) {
  job it = square_job(1);
  cone tip = {1e-6, 1, 0.5, 0.5};
  MUST(pnpbs_placement_set(it.placement, "max_nodes", "1000"));
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.01));
  MUST_FAIL(PNPBS_ERROR_SPACING, pnpbs_placement_run(it.placement), "0.01", "1000");
  ck_assert_int_eq(integer_of(it.placement, "nodes"), 0);
  /* The boundary nodes alone exceed the limit. */
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 1e-4));
  MUST_FAIL(PNPBS_ERROR_SPACING, pnpbs_placement_run(it.placement), "1e-04", "1000");
  /* This spacing requires 10^15 nodes or more, beyond any limit. The error takes no noticeable
   * time. */
  MUST(pnpbs_placement_set(it.placement, "max_nodes", "2000000000"));
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 1e-9));
  MUST_FAIL(PNPBS_ERROR_SPACING, pnpbs_placement_run(it.placement), "1e-09", "nodes");
  MUST(pnpbs_placement_set(it.placement, "max_nodes", "1000"));
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.05));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  check_placement(it.placement, 1);
  /* A fine tip in a coarse field is not an error. */
  MUST(pnpbs_placement_set_spacing_callback(it.placement, cone_spacing, &tip));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  check_placement(it.placement, 1);
  job_end(&it);
}
END_TEST

START_TEST(a_spacing_larger_than_a_feature) {
  job it = job_begin();
  result nodes;
  int32_t warnings = 0, k;
  int found = 0;
  add_rectangle(it.domain, PNPBS_BOUNDARY, 0, 0, 1, 1, 1);
  add_rectangle(it.domain, PNPBS_BOUNDARY, 0.5, 0.5, 0.51, 0.51, 2);
  nodes = run(&it, 0.1);
  check_result(&nodes, 0);
  MUST(pnpbs_placement_warning_count(it.placement, &warnings));
  for (k = 0; k < warnings; ++k) {
    const char* text = NULL;
    MUST(pnpbs_placement_get_warning(it.placement, k, &text));
    found += strstr(text, "larger than features of the boundary") != NULL;
  }
  ck_assert_int_gt(found, 0);
  result_free(&nodes);
  job_end(&it);
}
END_TEST

/* A spacing callback with a jump by a factor of 25. */
static int32_t coarse_beside_fine(int64_t n, int32_t dim, const double* xyz, double* d,
                                  void* user) {
  int64_t i;
  (void)user;
  for (i = 0; i < n; ++i) d[i] = xyz[dim * i] < 0.52 ? 0.3 : 0.012;
  return 0;
}

/* The coarse side begins with far too many nodes, which are pressed into its corners. Of coincident
 * nodes, the one with the smallest id stays. */
START_TEST(a_crowded_corner) {
  static const char* const options[][2] = {
      {"steps", "40"}, {"steps", "60"}, {"sweeps", "4"}, {"topology_repairs", "2"}};
  job it = square_job(1);
  result nodes;
  int64_t i, j;
  MUST(pnpbs_placement_set_spacing_callback(it.placement, coarse_beside_fine, NULL));
  MUST(pnpbs_placement_set(it.placement, "growth_limit", "0"));
  MUST(pnpbs_placement_set(it.placement, "sweeps", "0"));
  MUST(pnpbs_placement_set(it.placement, options[_i][0], options[_i][1]));
  ck_assert_int_ge(pnpbs_placement_run(it.placement), PNPBS_OK); /* no nodes can follow d */
  ck_assert_int_gt(integer_of(it.placement, "deleted"), 20);
  nodes = result_of(it.placement);
  check_result(&nodes, 1);
  for (i = 0; i < nodes.n; ++i)
    for (j = 0; j < i; ++j) { /* nodes are in the order of their ids */
      const double gap =
          hypot(nodes.xy[2 * i] - nodes.xy[2 * j], nodes.xy[2 * i + 1] - nodes.xy[2 * j + 1]);
      /* A node that the last repairs shift across the jump then has another d. */
      if (nodes.tags[i] == 0 && nodes.tags[j] == 0 && fabs(nodes.xy[2 * i] - 0.52) > 0.012)
        ck_assert_msg(gap >= 0.19 * nodes.d[i], "nodes at (%g, %g) and (%g, %g), %.3f d apart",
                      nodes.xy[2 * i], nodes.xy[2 * i + 1], nodes.xy[2 * j], nodes.xy[2 * j + 1],
                      gap / nodes.d[i]);
    }
  result_free(&nodes);
  job_end(&it);
}
END_TEST

/* Far from rest, one repair may insert a node that another repair deletes. The rounds must still
 * end. */
START_TEST(rounds_of_repairs_end) {
  static const char* const rounds[] = {"30", "60"};
  int64_t inserted[2], deleted[2];
  int k;
  for (k = 0; k < 2; ++k) {
    job it = square_job(1);
    MUST(pnpbs_placement_set_spacing_callback(it.placement, coarse_beside_fine, NULL));
    MUST(pnpbs_placement_set(it.placement, "growth_limit", "0"));
    MUST(pnpbs_placement_set(it.placement, "steps", "0"));
    MUST(pnpbs_placement_set(it.placement, "topology_repairs", rounds[k]));
    ck_assert_int_ge(pnpbs_placement_run(it.placement), PNPBS_OK); /* no nodes can follow d */
    inserted[k] = integer_of(it.placement, "inserted");
    deleted[k] = integer_of(it.placement, "deleted");
    job_end(&it);
  }
  ck_assert_int_gt(inserted[0] + deleted[0], 20);
  ck_assert_int_eq(inserted[1], inserted[0]);
  ck_assert_int_eq(deleted[1], deleted[0]);
}
END_TEST

/* ---------------------------------------------------------------- methods --------------- */

typedef struct {
  const char* options[12]; /* pairs of key and value */
  double mean, least;      /* lower bounds of the quality */
} method;

static const method methods[] = {
    {{NULL}, 0.95, 0.5},
    {{"method", "default", NULL}, 0.95, 0.5},
    {{"method", "paper", NULL}, 0.93, 0.4},
    {{"law", "cubic", NULL}, 0.93, 0.4},
    {{"scheme", "predictor_corrector", NULL}, 0.93, 0.4},
    {{"law", "cubic", "scheme", "predictor_corrector", "time_step", "0.5", "damping", "0.7", NULL},
     0.93,
     0.4},
    {{"law", "cubic", "finish", "runge_kutta", NULL}, 0.93, 0.4},
    {{"finish", "runge_kutta", NULL}, 0.93, 0.4},
    {{"method", "paper", "law", "push", NULL}, 0.93, 0.4},
    {{"method", "paper", "scheme", "damped", NULL}, 0.93, 0.4},
    {{"method", "paper", "finish", "none", NULL}, 0.93, 0.4},
    {{"sweeps", "0", NULL}, 0.93, 0.4},
    {{"population_share", "0", NULL}, 0.93, 0.4},
    {{"list_radius", "3", "adjacency_radius", "3", NULL}, 0.95, 0.5},
    {{"rest_length", "0.8", NULL}, 0.9, 0.2},
    {{"rest_length", "1.4", NULL}, 0.8, 0.1},
    {{"event_interval", "1", "steps", "60", NULL}, 0.93, 0.4},
    {{"event_interval", "1000000", NULL}, 0.93, 0.4},
    {{"time_step", "0.001", "steps", "40", NULL}, 0.9, 0.2},
    {{"time_step", "2", "max_move", "0.2", "damping", "0", NULL}, 0.5, 0},
    {{"delete_above", "6", "insert_below", "6", NULL}, 0.9, 0.2},
};

static job job_of(const method* m) {
  job it = square_job(1);
  int k;
  for (k = 0; m->options[k] != NULL; k += 2) {
    MUST(pnpbs_placement_set(it.placement, m->options[k], m->options[k + 1]));
  }
  return it;
}

/* Each method runs with a uniform spacing and one graded by 1 : 4. */
START_TEST(methods_run) {
  cone slope = {0.04, 0.12, 0, 0};
  int k;
  for (k = 0; k < 2; ++k) {
    job it = job_of(&methods[_i]);
    result nodes;
    quality_summary q;
    double error;
    if (k == 0) MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.06));
    if (k == 1) MUST(pnpbs_placement_set_spacing_callback(it.placement, cone_spacing, &slope));
    MUST_COMPUTE(pnpbs_placement_run(it.placement));
    nodes = result_of(it.placement);
    check_result(&nodes, 1);
    ck_assert_double_eq_tol(triangle_area(&nodes), 1, 1e-12);
    q = quality_of(&nodes);
    error = real_of(it.placement, "d_error.mean");
    ck_assert_msg(q.mean >= methods[_i].mean - 0.02 * k && q.least >= methods[_i].least - 0.1 * k,
                  "%s quality: mean %.4f, least %.3f", k ? "graded" : "uniform", q.mean, q.least);
    ck_assert_msg(methods[_i].mean < 0.93 || (error > 0.85 && error < 1.05),
                  "%s: mean nearest neighbour at %.3f d", k ? "graded" : "uniform", error);
    result_free(&nodes);
    job_end(&it);
  }
}
END_TEST

/* method=paper equals the options that it stands for. */
START_TEST(the_paper_is_a_preset) {
  static const char* const options[][2] = {
      {"law", "cubic"},       {"scheme", "predictor_corrector"}, {"finish", "runge_kutta"},
      {"sweeps", "0"},        {"smoothing_rounds", "0"},         {"steps", "50"},
      {"list_radius", "1.7"},
  };
  job it = square_job(1), plain = square_job(1), other = square_job(1);
  int k;
  MUST(pnpbs_placement_set(it.placement, "method", "paper"));
  MUST(pnpbs_placement_set(plain.placement, "method", "paper"));
  for (k = 0; k < COUNT_OF(options); ++k) {
    MUST(pnpbs_placement_set(it.placement, options[k][0], options[k][1]));
  }
  MUST(pnpbs_placement_set(plain.placement, "steps", "50"));
  MUST(pnpbs_placement_set(other.placement, "steps", "50"));
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.07));
  MUST(pnpbs_placement_set_spacing_constant(plain.placement, 0.07));
  MUST(pnpbs_placement_set_spacing_constant(other.placement, 0.07));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  MUST_COMPUTE(pnpbs_placement_run(plain.placement));
  MUST_COMPUTE(pnpbs_placement_run(other.placement));
  ck_assert_str_eq(hash_of(it.placement).text, hash_of(plain.placement).text);
  ck_assert_str_ne(hash_of(it.placement).text, hash_of(other.placement).text);
  job_end(&it);
  job_end(&plain);
  job_end(&other);
}
END_TEST

TEST_SUITE(test_small) {
  Suite* suite = suite_create("small domains and methods");
  TCase* room = tcase_create("room");
  TCase* method_cases = tcase_create("methods");
  tcase_add_loop_test(room, a_triangle_smaller_than_d, 0, 5);
  tcase_add_test(room, a_strip_narrower_than_d);
  tcase_add_loop_test(room, strips, 0, 13);
  tcase_add_test(room, one_inner_node);
  tcase_add_test(room, a_wedge);
  tcase_add_loop_test(room, scales, 0, 6);
  tcase_add_test(room, more_nodes_than_allowed);
  tcase_add_test(room, a_spacing_larger_than_a_feature);
  tcase_add_loop_test(room, a_crowded_corner, 0, WHEN_SANITIZED(1, 4));
  tcase_add_test(room, rounds_of_repairs_end);
  suite_add_tcase(suite, room);
  tcase_add_loop_test(method_cases, methods_run, 0, COUNT_OF(methods));
  tcase_add_test(method_cases, the_paper_is_a_preset);
  suite_add_tcase(suite, method_cases);
  return run_suite(suite);
}
