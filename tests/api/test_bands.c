/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests that d is followed in every band of d: the mean edge length over d is 1 in each of them. A
 * force that leaves stress compresses coarse regions beside a fine line to half of their d. A mean
 * over all edges, or a spacing that grows from a point, does not show this.
 */
#include "api_support.h"

typedef struct {
  double fine, growth, coarse;
  double (*distance)(double x, double y);
} graded;

static double from_line(double x, double y) {
  (void)x;
  return fabs(y - 0.5);
}
static double from_side(double x, double y) {
  (void)x;
  return y;
}
static double from_point(double x, double y) { return hypot(x - 0.4, y - 0.45); }
static double from_points(double x, double y) {
  return fmin(hypot(x - 0.3, y - 0.4), hypot(x - 0.75, y - 0.7));
}

static int32_t graded_spacing(int64_t n, int32_t dim, const double* xyz, double* d, void* user) {
  const graded* g = user;
  int64_t i;
  for (i = 0; i < n; ++i)
    d[i] = fmin(g->fine + g->growth * g->distance(xyz[dim * i], xyz[dim * i + 1]), g->coarse);
  return 0;
}

enum { BANDS = 8, FEWEST = 200 };

/* Expects that the mean of edge length over d is 1 within the tolerance in each band. The mean is
 * over the edges of all triangles that have an end inside; edges between two triangles count twice.
 */
static void expect_bands_at_d(const result* r, const graded* g, double tolerance) {
  double sum[BANDS] = {0}, count[BANDS] = {0};
  const double width = log(g->coarse / g->fine) / BANDS;
  int64_t t;
  int k, bands = 0;
  for (t = 0; t < r->triangles; ++t)
    for (k = 0; k < 3; ++k) {
      const int64_t a = r->corners[3 * t + k], b = r->corners[3 * t + (k + 1) % 3];
      const double d = 0.5 * (r->d[a] + r->d[b]);
      const int band = (int)fmax(0, fmin(BANDS - 1, log(d / g->fine) / width));
      if (r->on_boundary[a] && r->on_boundary[b]) continue;
      sum[band] += hypot(r->xy[2 * a] - r->xy[2 * b], r->xy[2 * a + 1] - r->xy[2 * b + 1]) / d;
      count[band] += 1;
    }
  for (k = 0; k < BANDS; ++k) {
    if (count[k] < 2 * FEWEST) continue;
    ++bands;
    ck_assert_msg(fabs(sum[k] / count[k] - 1) < tolerance, "band %d of %d: %.4f d over %d edges", k,
                  BANDS, sum[k] / count[k], (int)count[k] / 2);
  }
  ck_assert_int_ge(bands, 5);
}

START_TEST(the_mean_edge_is_d_in_every_band) {
  static graded cases[] = {
      {0.002, 0.2, 0.08, from_line},    {0.0008, 0.1, 0.04, from_side},
      {0.0005, 0.05, 0.02, from_point}, {0.001, 0.05, 0.02, from_points},
      {0.001, 0.1, 0.05, from_line},
  };
  int k;
  for (k = 0; k < COUNT_OF(cases); ++k) {
    job it = square_job(1);
    result r;
    MUST(pnpbs_placement_set_spacing_callback(it.placement, graded_spacing, &cases[k]));
    MUST_COMPUTE(pnpbs_placement_run(it.placement));
    r = result_of(it.placement);
    check_result(&r, 1);
    expect_bands_at_d(&r, &cases[k], 0.015); /* 0.01, plus scatter of the mean */
    result_free(&r);
    job_end(&it);
  }
}
END_TEST

/* ---------------------------------------------------------------- steep spacings -------- */

static int32_t jump(int64_t n, int32_t dim, const double* xyz, double* d, void* user) {
  const double fine = *(const double*)user;
  int64_t i;
  for (i = 0; i < n; ++i) d[i] = xyz[dim * i] > 0.503 ? 1 : fine;
  return 0;
}

/* Returns the expected number of nodes in the unit square, 2 / sqrt(3) per d^2, for a d that jumps
 * at x = 0.503 and grows by g beside it. */
static double nodes_beside_jump(double fine, double g) {
  const double far = fine + g * (1 - 0.503);
  return 2 / sqrt(3.) * (0.503 / (fine * fine) + (1 / fine - 1 / far) / g);
}

static int warnings_with(pnpbs_placement placement, const char* words) {
  int32_t warnings = 0, k;
  int found = 0;
  MUST(pnpbs_placement_warning_count(placement, &warnings));
  for (k = 0; k < warnings; ++k) {
    const char* text = NULL;
    MUST(pnpbs_placement_get_warning(placement, k, &text));
    found += strstr(text, words) != NULL;
  }
  return found;
}

/* Returns the x of the point that the warning about steep growth names, or NaN. */
static double steep_at(pnpbs_placement placement) {
  int32_t warnings = 0, k;
  double x = NAN;
  MUST(pnpbs_placement_warning_count(placement, &warnings));
  for (k = 0; k < warnings; ++k) {
    const char* text = NULL;
    MUST(pnpbs_placement_get_warning(placement, k, &text));
    text = strstr(text, "per unit of length near (");
    if (text) x = atof(strchr(text, '(') + 1);
  }
  return x;
}

/* Nodes cannot follow a jump. So by default d grows beside it at a rate that nodes can follow, and
 * a warning names the point. */
START_TEST(a_jump_is_limited) {
  static double fine[] = {0.01, 0.004};
  job it = square_job(1);
  result r;
  int64_t i, estimate = 0;
  MUST(pnpbs_placement_set_spacing_callback(it.placement, jump, &fine[_i]));
  MUST(pnpbs_placement_estimate(it.placement, &estimate, NULL, NULL));
  MUST_COMPUTE(pnpbs_placement_run(it.placement)); /* not PNPBS_SPACING_MISSED */
  ck_assert_double_eq_tol(steep_at(it.placement), 0.503, 4 * fine[_i]);
  ck_assert_int_eq(warnings_with(it.placement, "limited to 0.3; set the option growth_limit"), 1);
  r = result_of(it.placement);
  check_result(&r, 1);
  ck_assert_double_eq_tol((double)r.n / nodes_beside_jump(fine[_i], 0.3), 1, 0.03);
  ck_assert_double_eq_tol((double)estimate / nodes_beside_jump(fine[_i], 0.3), 1, 0.1);
  ck_assert_double_ge(quality_of(&r).least, 0.6);
  for (i = 0; i < r.n; ++i) {
    const double exact = fine[_i] + 0.3 * fmax(0, r.xy[2 * i] - 0.503);
    const double most = (r.xy[2 * i] > 0.503 + 4 * fine[_i] ? 1.4 : 2) * exact;
    ck_assert_msg(r.d[i] >= exact * (1 - 1e-9) && r.d[i] <= most, "at x = %g d is %g", r.xy[2 * i],
                  r.d[i]);
  }
  result_free(&r);
  job_end(&it);
}
END_TEST

/* Setting the option is the user's decision: a smaller limit gives no warning. Without a limit, a
 * warning explains the consequences. */
START_TEST(a_jump_as_the_user_wants_it) {
  static double fine = 0.01;
  job it = square_job(1);
  int64_t limited;
  MUST(pnpbs_placement_set_spacing_callback(it.placement, jump, &fine));
  MUST(pnpbs_placement_set(it.placement, "growth_limit", "0.1"));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  ck_assert_int_eq(warnings_with(it.placement, "growth"), 0);
  limited = integer_of(it.placement, "nodes");
  ck_assert_double_eq_tol((double)limited / nodes_beside_jump(fine, 0.1), 1, 0.03);
  MUST(pnpbs_placement_set(it.placement, "growth_limit", "0"));
  ck_assert_int_ge(pnpbs_placement_run(it.placement), PNPBS_OK);
  ck_assert_double_eq_tol(steep_at(it.placement), 0.503, 4 * fine);
  ck_assert_int_eq(warnings_with(it.placement, "limit its growth (option growth_limit"), 1);
  ck_assert_int_lt(integer_of(it.placement, "nodes"), limited);
  job_end(&it);
}
END_TEST

/* A d that grows slowly is used as given, to the last bit. */
START_TEST(slow_growth_is_not_limited) {
  static graded d = {0.004, 0.29, 0.08, from_line};
  hash_text hashes[2];
  int k;
  for (k = 0; k < 2; ++k) {
    job it = square_job(1);
    MUST(pnpbs_placement_set_spacing_callback(it.placement, graded_spacing, &d));
    if (k == 1) MUST(pnpbs_placement_set(it.placement, "growth_limit", "0"));
    MUST_COMPUTE(pnpbs_placement_run(it.placement));
    ck_assert_int_eq(warnings_with(it.placement, "growth"), 0);
    hashes[k] = hash_of(it.placement);
    job_end(&it);
  }
  ck_assert_str_eq(hashes[0].text, hashes[1].text);
}
END_TEST

/* The number of nodes does not depend on the start: it equals that of a fresh run. */
START_TEST(the_population_forgets) {
  static cone d = {0.012, 0.03, 0.5, 0.5};
  int64_t fresh, after;
  int k;
  job it = square_job(1);
  MUST(pnpbs_placement_set_spacing_callback(it.placement, cone_spacing, &d));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  fresh = integer_of(it.placement, "nodes");
  for (k = 0; k < 2; ++k) { /* starts with twice, then with half as many nodes */
    static cone other = {0.008, 0.02, 0.2, 0.7};
    other.a = k == 0 ? 0.008 : 0.018;
    MUST(pnpbs_placement_set_spacing_callback(it.placement, cone_spacing, &other));
    MUST_COMPUTE(pnpbs_placement_run(it.placement));
    MUST(pnpbs_placement_set_spacing_callback(it.placement, cone_spacing, &d));
    MUST_COMPUTE(pnpbs_placement_run(it.placement));
    after = integer_of(it.placement, "nodes");
    ck_assert_msg(llabs((long long)(after - fresh)) <= 0.015 * (double)fresh,
                  "%d nodes, %d in a run of its own", (int)after, (int)fresh);
  }
  job_end(&it);
}
END_TEST

TEST_SUITE(test_bands) {
  Suite* suite = suite_create("bands");
  TCase* tests = tcase_create("bands");
  tcase_add_test(tests, the_mean_edge_is_d_in_every_band);
  tcase_add_loop_test(tests, a_jump_is_limited, 0, WHEN_SANITIZED(1, 2));
  tcase_add_test(tests, a_jump_as_the_user_wants_it);
  tcase_add_test(tests, slow_growth_is_not_limited);
  tcase_add_test(tests, the_population_forgets);
  suite_add_tcase(suite, tests);
  return run_suite(suite);
}
