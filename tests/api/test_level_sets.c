/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests placements in bodies given by level sets: nodes lie where f = 0 and on its edges, normals
 * are its gradient, and callback errors and invalid input are rejected.
 */
#include "volume_support.h"

static const double low[3] = {-1.5, -1.5, -1.5}, high[3] = {1.5, 1.5, 1.5};

/* ---------------------------------------------------------------- good ones ------------- */

static int32_t unit_ball(int64_t n, int32_t dim, const double* x, double* f, void* user) {
  int64_t i;
  ck_assert_int_eq(dim, 3);
  ck_assert_int_gt(n, 0);
  for (i = 0; i < n; ++i) {
    int k;
    f[i] = -1;
    for (k = 0; k < 3; ++k) {
      ck_assert(x[3 * i + k] >= low[k] && x[3 * i + k] <= high[k]);
      f[i] += x[3 * i + k] * x[3 * i + k];
    }
  }
  *(int64_t*)user += n;
  return 0;
}

/* Nodes are far nearer to the ball than the triangles of its surface, which have the size of the
 * resolution. */
START_TEST(nodes_lie_on_the_ball) {
  const double centre[3] = {0, 0, 0}, d = 0.2;
  int64_t asked = 0, i, on_ball = 0;
  double measure, enclosed;
  job it = {NULL, NULL, NULL};
  volume v;
  MUST(pnpbs_context_create_serial(&it.context));
  MUST(pnpbs_domain_create(it.context, 3, &it.domain));
  MUST(pnpbs_domain_add_level_set(it.domain, unit_ball, &asked, low, high, 0.15, 7));
  ck_assert_int_gt(asked, 0);
  MUST(pnpbs_domain_measure(it.domain, &measure));
  ck_assert_double_eq_tol(measure, 4 * PI / 3, 0.03);
  job_place(&it);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, d));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  check_body(&it, 0.05);
  v = volume_of(it.placement);
  for (i = 0; i < v.n; ++i) {
    const double r = distance(v.xyz + 3 * i, centre);
    ck_assert_int_eq(v.tags[i], r > 1 - 0.3 * d ? 7 : 0);
    if (v.tags[i] == 7) ck_assert_double_eq_tol(r, 1, 1e-12);
    on_ball += v.tags[i] == 7;
  }
  ck_assert_int_eq(on_ball, integer_of(it.placement, "boundary_nodes"));
  ck_assert_double_eq_tol((double)on_ball, 4 * PI * 1.15 / (d * d), 0.1 * 4 * PI / (d * d));
  ck_assert_double_eq_tol(boundary_area(&v, 7, &enclosed), 4 * PI, 0.25);
  ck_assert_double_gt(real_of(it.placement, "quality.mean"), 0.85);
  volume_free(&v);
  /* A run at another spacing begins from the current nodes. */
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.75 * d));
  ck_assert_int_ge(pnpbs_placement_run(it.placement), 0);
  check_body(&it, 0.04);
  v = volume_of(it.placement);
  for (i = 0; i < v.n; ++i)
    if (v.tags[i] == 7) ck_assert_double_eq_tol(distance(v.xyz + 3 * i, centre), 1, 1e-12);
  volume_free(&v);
  job_end(&it);
}
END_TEST

START_TEST(a_ring) {
  job it = body_job(volume_ring);
  volume v;
  int64_t i;
  double f;
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.13));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  check_body(&it, 0.05);
  v = volume_of(it.placement);
  ck_assert_double_eq_tol(volume_sum(&v) / (2 * PI * PI * 0.16), 1, 0.04);
  for (i = 0; i < v.n; ++i) {
    volume_ring_at(1, 3, v.xyz + 3 * i, &f, NULL);
    ck_assert(v.tags[i] == 5 ? fabs(f) < 1e-12 : f < 0);
  }
  volume_free(&v);
  job_end(&it);
}
END_TEST

/* ---------------------------------------------------------------- edges ----------------- */

/* A level-set callback: the intersection of two unit balls, whose centres are 1 apart. */
static int32_t lens(int64_t n, int32_t dim, const double* x, double* f, void* user) {
  int64_t i;
  (void)user;
  for (i = 0; i < n; ++i) {
    const double* at = x + dim * i;
    const double yz = at[1] * at[1] + at[2] * at[2];
    const double left = at[0] + 0.5, right = at[0] - 0.5;
    f[i] = fmax(sqrt(left * left + yz), sqrt(right * right + yz)) - 1;
  }
  return 0;
}

/* Nodes on the edge lie on both balls, are as many as d requires, and have the mean of both
 * normals. */
START_TEST(nodes_lie_on_the_edge_of_a_lens) {
  const double d = 0.2, rim = sqrt(0.75);
  const int filled = _i == 0;
  job it = {NULL, NULL, NULL};
  int64_t i, on_rim = 0;
  double* normals;
  volume v;
  MUST(pnpbs_context_create_serial(&it.context));
  MUST(pnpbs_domain_create(it.context, 3, &it.domain));
  MUST(pnpbs_domain_add_level_set(it.domain, lens, NULL, low, high, 0.2, 3));
  MUST(pnpbs_domain_set_filled(it.domain, filled));
  job_place(&it);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, d));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  MUST(pnpbs_placement_check(it.placement));
  v = volume_of(it.placement);
  normals = malloc((size_t)v.n * 3 * sizeof *normals);
  ck_assert_ptr_nonnull(normals);
  MUST(pnpbs_placement_get_normals(it.placement, v.n, normals));
  for (i = 0; i < v.n; ++i) {
    const double *x = v.xyz + 3 * i, *normal = normals + 3 * i;
    const double r = hypot(x[1], x[2]), side = x[0] > 0 ? 0.5 : -0.5;
    double f;
    if (v.tags[i] == 0) continue;
    if (fabs(x[0]) < 0.1 * d) {
      ++on_rim;
      ck_assert_double_eq_tol(x[0], 0, 1e-8);
      ck_assert_double_eq_tol(r, rim, 1e-8);
      ck_assert_double_eq_tol(normal[0], 0, 1e-5);
      ck_assert_double_eq_tol(normal[1], x[1] / rim, 1e-5);
      ck_assert_double_eq_tol(normal[2], x[2] / rim, 1e-5);
    } else {
      lens(1, 3, x, &f, NULL);
      ck_assert_double_eq_tol(f, 0, 1e-14);
      ck_assert_double_eq_tol(normal[0], x[0] + side, 1e-8);
      ck_assert_double_eq_tol(normal[1], x[1], 1e-8);
      ck_assert_double_eq_tol(normal[2], x[2], 1e-8);
    }
  }
  ck_assert_double_eq_tol((double)on_rim, 2 * PI * rim / d, 2);
  free(normals);
  volume_free(&v);
  job_end(&it);
}
END_TEST

/* The normal of a cavity in a box points into the cavity. */
START_TEST(normals_of_a_cavity) {
  const double corner[3] = {2, 2, 2}, other[3] = {-2, -2, -2};
  job it = {NULL, NULL, NULL};
  int64_t i, asked = 0;
  double* normals;
  volume v;
  MUST(pnpbs_context_create_serial(&it.context));
  MUST(pnpbs_domain_create(it.context, 3, &it.domain));
  MUST(pnpbs_domain_add_box(it.domain, other, corner, 1));
  MUST(pnpbs_domain_add_level_set(it.domain, unit_ball, &asked, low, high, 0.3, 7));
  MUST(pnpbs_domain_set_filled(it.domain, 1));
  job_place(&it);
  MUST(pnpbs_placement_set(it.placement, "steps", "5"));
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.5));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  v = volume_of(it.placement);
  normals = malloc((size_t)v.n * 3 * sizeof *normals);
  ck_assert_ptr_nonnull(normals);
  MUST(pnpbs_placement_get_normals(it.placement, v.n, normals));
  for (i = 0; i < 3 * v.n; ++i)
    if (v.tags[i / 3] == 7) ck_assert_double_eq_tol(normals[i], -v.xyz[i], 1e-8);
  free(normals);
  volume_free(&v);
  job_end(&it);
}
END_TEST

/* ---------------------------------------------------------------- bad ones -------------- */

typedef struct {
  int64_t calls, bad_from;
  int32_t answer;
  double value; /* returned by bad calls */
} level_set_probe;

static int32_t probed(int64_t n, int32_t dim, const double* x, double* f, void* user) {
  level_set_probe* it = user;
  const int is_bad = it->calls++ >= it->bad_from;
  int64_t i;
  for (i = 0; i < n; ++i) {
    f[i] = sqrt(x[dim * i] * x[dim * i] + x[dim * i + 1] * x[dim * i + 1] +
                x[dim * i + 2] * x[dim * i + 2]) -
           1;
    if (is_bad && it->answer == 0) f[i] = it->value;
  }
  return is_bad ? it->answer : 0;
}

/* The callback fails at each of its calls in turn, when the level set is added and in the run. The
 * domain and the nodes must stay as they were. */
START_TEST(failing_at_every_call) {
  const pnpbs_status expected = _i == 0 ? PNPBS_ERROR_CALLBACK : PNPBS_ERROR_DOMAIN;
  int failed_adding = 0, failed_later = 0;
  int64_t k;
  for (k = 0;; ++k) {
    level_set_probe asked = {0, k, _i == 0 ? 77 : 0, NAN};
    pnpbs_status status;
    double measure;
    job it = {NULL, NULL, NULL};
    MUST(pnpbs_context_create_serial(&it.context));
    MUST(pnpbs_domain_create(it.context, 3, &it.domain));
    status = pnpbs_domain_add_level_set(it.domain, probed, &asked, low, high, 0.4, 1);
    if (status < 0) {
      ck_assert_int_eq(status, expected);
      ck_assert_ptr_nonnull(strstr(MESSAGE(), _i == 0 ? "77" : "nan"));
      MUST_FAIL(PNPBS_ERROR_DOMAIN, pnpbs_domain_measure(it.domain, &measure), "no surfaces", "");
      ++failed_adding;
      job_end(&it);
      continue;
    }
    job_place(&it);
    MUST(pnpbs_placement_set(it.placement, "steps", "5"));
    MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.4));
    status = pnpbs_placement_run(it.placement);
    if (status >= 0) {
      job_end(&it);
      break;
    }
    ck_assert_int_eq(status, expected);
    ck_assert_ptr_nonnull(strstr(MESSAGE(), _i == 0 ? "77" : "nan"));
    ck_assert_int_eq(integer_of(it.placement, "nodes"), 0);
    ++failed_later;
    asked.bad_from = INT64_MAX;
    ck_assert_int_ge(pnpbs_placement_run(it.placement), 0);
    MUST(pnpbs_placement_check(it.placement));
    job_end(&it);
  }
  ck_assert_int_gt(failed_adding, 3);
  ck_assert_int_gt(failed_later, 1);
}
END_TEST

START_TEST(bad_input) {
  level_set_probe good = {0, INT64_MAX, 0, 0};
  const double flat[3] = {1.5, -1.5, 1.5}, half[3] = {0, 0, 0};
  pnpbs_context context;
  pnpbs_domain body, plate;
  MUST(pnpbs_context_create_serial(&context));
  MUST(pnpbs_domain_create(context, 3, &body));
  MUST(pnpbs_domain_create(context, 2, &plate));
#define REFUSED(status, first, second, ...) \
  MUST_FAIL(PNPBS_ERROR_##status, pnpbs_domain_add_level_set(__VA_ARGS__), first, second)
  REFUSED(ARGUMENT, "level_set", "NULL", body, NULL, NULL, low, high, 0.4, 1);
  REFUSED(ARGUMENT, "low", "NULL", body, probed, &good, NULL, high, 0.4, 1);
  REFUSED(ARGUMENT, "high", "NULL", body, probed, &good, low, NULL, 0.4, 1);
  REFUSED(ARGUMENT, "high[1]", "-1.5", body, probed, &good, low, flat, 0.4, 1);
  REFUSED(ARGUMENT, "resolution", "0", body, probed, &good, low, high, 0, 1);
  REFUSED(ARGUMENT, "resolution", "nan", body, probed, &good, low, high, NAN, 1);
  REFUSED(ARGUMENT, "resolution", "4", body, probed, &good, low, high, 4, 1);
  REFUSED(ARGUMENT, "tag", "0", body, probed, &good, low, high, 0.4, 0);
  REFUSED(ARGUMENT, "domain", "two dimensions", plate, probed, &good, low, high, 0.4, 1);
  ck_assert_int_eq(good.calls, 0);
  REFUSED(DOMAIN, "level set 0", "on the border", body, probed, &good, low, half, 0.4, 1);
#undef REFUSED
  MUST(pnpbs_domain_destroy(&body));
  MUST(pnpbs_domain_destroy(&plate));
  MUST(pnpbs_context_destroy(&context));
}
END_TEST

TEST_SUITE(test_level_sets) {
  Suite* suite = suite_create("level sets");
  TCase* good = tcase_create("good");
  TCase* bad = tcase_create("bad");
  tcase_add_test(good, nodes_lie_on_the_ball);
  tcase_add_test(good, a_ring);
  tcase_add_loop_test(good, nodes_lie_on_the_edge_of_a_lens, 0, 2);
  tcase_add_test(good, normals_of_a_cavity);
  tcase_add_loop_test(bad, failing_at_every_call, 0, 2);
  tcase_add_test(bad, bad_input);
  tcase_set_timeout(good, 0);
  tcase_set_timeout(bad, 0);
  suite_add_tcase(suite, good);
  suite_add_tcase(suite, bad);
  return run_suite(suite);
}
