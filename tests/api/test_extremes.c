/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests the limits of domains and spacings: small domains far from the origin, tiny domains,
 * spacings far larger than the domain, and boundaries far finer than the spacing.
 */
#include "api_support.h"

static void add_loop(job* it, int64_t n, const double* xy) {
  MUST(pnpbs_domain_add_polyline(it->domain, PNPBS_BOUNDARY, 1, n, xy, NULL, 0));
}

/* Checks the results, and that the triangles fill the domain. */
static void check_job(const job* it) {
  double area;
  result nodes;
  MUST(pnpbs_placement_check(it->placement));
  MUST(pnpbs_domain_measure(it->domain, &area));
  nodes = result_of(it->placement);
  /* Coordinates of about 1e4 are rounded to 2e-12, and the domain is 1e-3 wide. */
  ck_assert_double_eq_tol(triangle_area(&nodes), area, 1e-7 * area);
  result_free(&nodes);
}

static void place_and_check(job* it, double d) {
  MUST(pnpbs_placement_set_spacing_constant(it->placement, d));
  MUST_COMPUTE(pnpbs_placement_run(it->placement));
  check_job(it);
}

/* The domain is 1e-3 wide at y = 1e4. A hole touches its outer side where rounding moves the border
 * of cells of the background tree. */
START_TEST(a_hole_that_touches_far_from_the_origin) {
  static const double spacings[] = {6.55572e-5, 5e-5, 6e-5, 7e-5, 1e-4, 3e-5};
  job it = job_begin();
  MUST(pnpbs_domain_read_poly(it.domain, PNPBS_SOURCE_DIR "/tests/api/touching_hole.poly"));
  job_place(&it);
  place_and_check(&it, spacings[_i]);
  job_end(&it);
}
END_TEST

START_TEST(small_and_far_from_the_origin) {
  static const double cases[][3] = {
      {1e-3, 1e4, -1e4}, {1e-3, 0, 1e4}, {1e-5, 1, -1}, {1e-2, 1e6, 1e6}, {1, 3e8, 1e9}};
  const double s = cases[_i][0], x = cases[_i][1], y = cases[_i][2];
  const double inner[] = {x + 0.3 * s, y + 0.2 * s, x + 0.6 * s,
                          y + 0.5 * s, x + 0.3 * s, y + 0.5 * s};
  const double fractions[] = {0.31, 0.11, 0.061};
  int k;
  for (k = 0; k < 3; ++k) {
    job it = job_begin();
    add_rectangle(it.domain, PNPBS_BOUNDARY, x, y, x + s, y + s, 1);
    add_loop(&it, 3, inner);
    job_place(&it);
    place_and_check(&it, fractions[k] * s);
    job_end(&it);
  }
}
END_TEST

static void refused_domain(double x, double y, double size, const char* word) {
  job it = job_begin();
  add_rectangle(it.domain, PNPBS_BOUNDARY, x, y, x + size, y + size, 1);
  MUST_FAIL(PNPBS_ERROR_DOMAIN, pnpbs_domain_check(it.domain), "size is", word);
  job_place(&it);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.1 * size));
  MUST_FAIL(PNPBS_ERROR_DOMAIN, pnpbs_placement_run(it.placement), "size is", word);
  job_end(&it);
}

START_TEST(domains_beyond_the_range) {
  refused_domain(0, 0, 1e-61, "less than 1e-60");
  refused_domain(0, 0, 1e-105, "less than 1e-60");
  refused_domain(0, 0, 1e-150, "less than 1e-60");
  refused_domain(1e4, 0, 1e-7, "of its distance from the origin");
  refused_domain(0, -3e12, 1, "of its distance from the origin");
}
END_TEST

START_TEST(domains_at_the_ends_of_the_range) {
  static const double sizes[] = {2e-60, 1e-40, 1e40, 5e59};
  const double s = sizes[_i];
  job it = job_begin();
  add_rectangle(it.domain, PNPBS_BOUNDARY, 0, 0, s, s, 1);
  job_place(&it);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.07 * s));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  MUST(pnpbs_placement_check(it.placement));
  ck_assert_int_gt(integer_of(it.placement, "nodes"), 200);
  job_end(&it);
}
END_TEST

/* ---------------------------------------------------------------- spacings -------------- */

static int32_t huge_on_the_right(int64_t n, int32_t dim, const double* xyz, double* d, void* user) {
  int64_t i;
  for (i = 0; i < n; ++i) d[i] = xyz[dim * i] > 0.5 ? *(const double*)user : 0.05;
  return 0;
}

START_TEST(spacings_far_larger_than_the_domain) {
  static double huge[] = {3, 1e6, 1e150, 1e155, 1e299, 1.7e308};
  job it = square_job(1);
  int32_t warnings;
  const char* text;
  MUST(pnpbs_placement_set_spacing_constant(it.placement, huge[_i]));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  check_placement(it.placement, 1);
  ck_assert_int_eq(integer_of(it.placement, "nodes"), 4);
  MUST(pnpbs_placement_warning_count(it.placement, &warnings));
  ck_assert_int_eq(warnings, 1);
  MUST(pnpbs_placement_get_warning(it.placement, 0, &text));
  ck_assert_ptr_ne(strstr(text, "larger than features of the boundary"), NULL);
  /* Then d becomes one that fits, and later one that is huge in half of the domain. */
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.1));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  check_placement(it.placement, 1);
  ck_assert_int_gt(integer_of(it.placement, "nodes"), 100);
  MUST(pnpbs_placement_set_spacing_callback(it.placement, huge_on_the_right, &huge[_i]));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  MUST(pnpbs_placement_check(it.placement));
  job_end(&it);
}
END_TEST

/* ---------------------------------------------------------------- fine boundaries ------- */

static void add_fine_circle(job* it, int n) {
  double* xy = malloc(2 * (size_t)n * sizeof *xy);
  int i;
  for (i = 0; i < n; ++i) {
    xy[2 * i] = cos(2 * PI * i / n);
    xy[2 * i + 1] = sin(2 * PI * i / n);
  }
  add_loop(it, n, xy);
  free(xy);
}

/* A circle has tens to hundreds of segments per spacing. The number of inner nodes must be as in a
 * circle with edges of length d, and the time must grow with the number of pairs of a node and an
 * edge within d of it, not with its square. */
START_TEST(a_boundary_far_finer_than_the_spacing) {
  static const struct {
    int segments;
    double d;
    int least, most; /* bounds of the number of inner nodes */
  } cases[] = {{5000, 0.2, 40, 110}, {2500, 0.1, 200, 350}, {20000, 0.1, 200, 350}};
  job it = job_begin();
  pnpbs_status status;
  int inner;
  add_fine_circle(&it, cases[_i].segments);
  job_place(&it);
  MUST(pnpbs_placement_set_int64(it.placement, "steps", 40));
  MUST(pnpbs_placement_set_spacing_constant(it.placement, cases[_i].d));
  /* Some edges from the small bubbles of the boundary to the inside are far longer than the d of
   * these bubbles. */
  status = pnpbs_placement_run(it.placement);
  ck_assert_msg(status == PNPBS_NOT_CONVERGED || status == PNPBS_SPACING_MISSED, "status %d; %s",
                (int)status, status < 0 ? MESSAGE() : "no error");
  check_job(&it);
  inner = (int)integer_of(it.placement, "nodes") - cases[_i].segments;
  ck_assert_int_ge(inner, cases[_i].least);
  ck_assert_int_le(inner, cases[_i].most);
  job_end(&it);
}
END_TEST

/* A boundary that is too fine to be finished in time is rejected at once, with a reason. */
START_TEST(a_boundary_too_fine_for_the_spacing) {
  job it = job_begin();
  add_fine_circle(&it, 60000);
  job_place(&it);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.1));
  MUST_FAIL(PNPBS_ERROR_SPACING, pnpbs_placement_run(it.placement), "60000 of its edges", "954.9");
  job_end(&it);
}
END_TEST

/* There is no room for inner nodes, so every boundary node has all others within its range. */
START_TEST(a_boundary_too_fine_and_nothing_within) {
  static const double spacings[] = {1, 3, 1e200};
  job it = job_begin();
  add_fine_circle(&it, 4000);
  job_place(&it);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, spacings[_i]));
  MUST_FAIL(PNPBS_ERROR_SPACING, pnpbs_placement_run(it.placement), "4000 of its edges",
            "smaller d");
  job_end(&it);
  /* A circle of some hundred segments is not too fine. */
  it = job_begin();
  add_fine_circle(&it, 300);
  job_place(&it);
  MUST(pnpbs_placement_set_int64(it.placement, "steps", 20));
  place_and_check(&it, spacings[_i]);
  ck_assert_int_ge(integer_of(it.placement, "nodes"), 300);
  ck_assert_int_le(integer_of(it.placement, "nodes"), 310);
  job_end(&it);
}
END_TEST

TEST_SUITE(test_extremes) {
  Suite* suite = suite_create("extremes");
  TCase* places = tcase_create("places");
  TCase* spacings = tcase_create("spacings");
  tcase_add_loop_test(places, a_hole_that_touches_far_from_the_origin, 0, 6);
  tcase_add_loop_test(places, small_and_far_from_the_origin, 0, 5);
  tcase_add_test(places, domains_beyond_the_range);
  tcase_add_loop_test(places, domains_at_the_ends_of_the_range, 0, 4);
  suite_add_tcase(suite, places);
  tcase_add_loop_test(spacings, spacings_far_larger_than_the_domain, 0, 6);
  tcase_add_loop_test(spacings, a_boundary_far_finer_than_the_spacing, 0, WHEN_SANITIZED(2, 3));
  tcase_add_test(spacings, a_boundary_too_fine_for_the_spacing);
  tcase_add_loop_test(spacings, a_boundary_too_fine_and_nothing_within, 0, 3);
  suite_add_tcase(suite, spacings);
  return run_suite(suite);
}
