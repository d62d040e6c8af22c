/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests warnings and errors as data. Points belong to messages as data and are not found in their
 * text. Warnings have codes, counts, values and points, which a checkpoint keeps. Also tests
 * coordinates beyond 1e60.
 */
#include "api_support.h"

static const double R = 6371;

static job on_sphere(void) {
  const double degrees[2] = {90, 0};
  double outside[3];
  job it = {0};
  MUST(pnpbs_context_create_serial(&it.context));
  MUST(pnpbs_sphere_points(1, 1, degrees, outside));
  MUST(pnpbs_domain_create_sphere(it.context, R, outside, &it.domain));
  return it;
}

static void add_polyline_in_degrees(const job* it, int64_t n, const double* degrees) {
  double x[60];
  ck_assert_int_le(3 * n, 60);
  MUST(pnpbs_sphere_points(R, n, degrees, x));
  MUST(pnpbs_domain_add_polyline(it->domain, PNPBS_BOUNDARY, 1, n, x, NULL, 0));
}

static void expect_in_error(const job* it, pnpbs_status status, const char* part) {
  ck_assert_int_lt(status, 0);
  ck_assert_msg(strstr(pnpbs_last_error(it->context), part) != NULL, "%s",
                pnpbs_last_error(it->context));
}

/* ---------------------------------------------------------------- points ----------------- */

START_TEST(what_looks_like_a_point_is_none) {
  job it = on_sphere();
  int64_t value;
  int32_t points = -1;
  job_place(&it);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 1500));
  MUST(pnpbs_placement_initialise(it.placement));
  expect_in_error(&it, pnpbs_placement_write(it.placement, "none/run (1, 2).vtu", 0),
                  "none/run (1, 2).vtu");
  expect_in_error(&it, pnpbs_placement_read_checkpoint(it.placement, "run (1, 2).vtkhdf"),
                  "'run (1, 2).vtkhdf'");
  expect_in_error(&it, pnpbs_placement_set_spacing_file(it.placement, "field (0.5, 7).csv", NULL),
                  "field (0.5, 7).csv");
  expect_in_error(&it, pnpbs_placement_set(it.placement, "steps (1, 2)", "3"), "steps (1, 2)");
  expect_in_error(&it, pnpbs_placement_set(it.placement, "steps", "(1, 2)"), "(1, 2)");
  expect_in_error(&it, pnpbs_placement_get_int64(it.placement, "nodes (1, 2)", &value),
                  "nodes (1, 2)");
  MUST(pnpbs_last_error_data(it.context, NULL, &points));
  ck_assert_int_eq(points, 0);
  ck_assert_int_eq(pnpbs_last_error_point(it.context, 0, NULL, NULL, NULL), PNPBS_ERROR_ARGUMENT);
  ck_assert_msg(strstr(pnpbs_last_error(it.context), "nodes (1, 2)") != NULL, "kept");
  job_end(&it);
}
END_TEST

START_TEST(points_on_a_sphere) {
  const double bow[8] = {0, 0, 40, 0, 0, 30, 40, 30};
  job it = on_sphere();
  const char* message;
  double point[3], degrees[2];
  int64_t begin = -1, end = -1;
  int32_t reason = -1, points = -1;
  add_polyline_in_degrees(&it, 4, bow);
  ck_assert_int_eq(pnpbs_domain_check(it.domain), PNPBS_ERROR_DOMAIN);
  MUST(pnpbs_last_error_data(it.context, &reason, &points));
  ck_assert_int_eq(reason, PNPBS_REASON_CROSSING);
  ck_assert_int_eq(points, 1);
  MUST(pnpbs_last_error_point(it.context, 0, point, &begin, &end));
  message = pnpbs_last_error(it.context);
  ck_assert_msg(strncmp(message + begin, "(longitude 19.9998", 18) == 0, "%s", message);
  ck_assert_msg(message[end - 1] == ')', "%s", message);
  MUST(pnpbs_sphere_degrees(1, point, degrees));
  ck_assert_double_eq_tol(sqrt(point[0] * point[0] + point[1] * point[1] + point[2] * point[2]), R,
                          1e-9 * R);
  ck_assert_double_eq_tol(degrees[0], 20, 1e-3);
  ck_assert_double_eq_tol(degrees[1], 17.077, 1e-3);
  /* The following error has no points. */
  expect_in_error(&it, pnpbs_domain_add_hole(it.domain, NULL), "point");
  MUST(pnpbs_last_error_data(it.context, &reason, &points));
  ck_assert_int_eq(reason, PNPBS_REASON_OTHER);
  ck_assert_int_eq(points, 0);
  job_end(&it);
}
END_TEST

START_TEST(points_in_the_plane) {
  const double bow[8] = {0, 0, 2, 2, 2, 0, 0, 2};
  job it = {0};
  double point[3];
  int64_t begin, end;
  MUST(pnpbs_context_create_serial(&it.context));
  MUST(pnpbs_domain_create(it.context, 2, &it.domain));
  MUST(pnpbs_domain_add_polyline(it.domain, PNPBS_BOUNDARY, 1, 4, bow, NULL, 0));
  ck_assert_int_eq(pnpbs_domain_check(it.domain), PNPBS_ERROR_DOMAIN);
  MUST(pnpbs_last_error_point(it.context, 0, point, &begin, &end));
  ck_assert(point[0] == 1 && point[1] == 1 && isnan(point[2]));
  ck_assert_int_eq(strncmp(pnpbs_last_error(it.context) + begin, "(1, 1)", (size_t)(end - begin)),
                   0);
  /* The message of this thread has the same point. */
  MUST(pnpbs_last_error_point(NULL, 0, point, &begin, &end));
  ck_assert(point[0] == 1 && point[1] == 1);
  job_end(&it);
}
END_TEST

/* ---------------------------------------------------------------- warnings --------------- */

typedef struct {
  int32_t code;
  int64_t count;
  double value, point[3];
} warning;

static int32_t warnings_of(pnpbs_placement placement) {
  int32_t count = -1;
  MUST(pnpbs_placement_warning_count(placement, &count));
  return count;
}

static warning warning_at(pnpbs_placement placement, int32_t k) {
  warning it;
  MUST(pnpbs_placement_get_warning_data(placement, k, &it.code, &it.count, &it.value, it.point));
  return it;
}

/* Returns the first warning with this code. */
static warning warning_of(pnpbs_placement placement, int32_t code) {
  const int32_t count = warnings_of(placement);
  int32_t k;
  for (k = 0; k < count; ++k)
    if (warning_at(placement, k).code == code) return warning_at(placement, k);
  ck_abort_msg("no warning %d among %d", (int)code, (int)count);
}

static int32_t steep(int64_t n, int32_t dim, const double* x, double* d, void* user) {
  int64_t i;
  (void)user;
  for (i = 0; i < n; ++i) d[i] = fmin(0.02 + 2 * fabs(x[dim * i] - 0.5), 0.2);
  return 0;
}

START_TEST(codes_and_numbers) {
  job it = square_job(1);
  warning found;
  ck_assert_int_eq(pnpbs_placement_get_warning_data(it.placement, 0, NULL, NULL, NULL, NULL),
                   PNPBS_ERROR_ARGUMENT);
  MUST(pnpbs_placement_set_spacing_callback(it.placement, steep, NULL));
  MUST(pnpbs_placement_initialise(it.placement));
  found = warning_of(it.placement, PNPBS_WARNING_GROWTH);
  ck_assert_double_eq_tol(found.value, 2, 0.1);
  ck_assert_double_eq_tol(found.point[0], 0.5, 0.15);
  ck_assert(isnan(found.point[2]));
  ck_assert_int_eq(found.count, 0);
  MUST(pnpbs_placement_get_warning_data(it.placement, 0, NULL, NULL, NULL, NULL));
  job_end(&it);
}
END_TEST

/* The first warning names a point, the second one does not. */
START_TEST(numbers_with_and_without_a_point) {
  const double slit[10] = {0, 0, 1, 0, 1, 0.01, 1, 1, 0, 1}, unused[2] = {0.5, 0.5};
  job it = {0};
  warning found;
  MUST(pnpbs_context_create_serial(&it.context));
  MUST(pnpbs_domain_create(it.context, 2, &it.domain));
  MUST(pnpbs_domain_add_polyline(it.domain, PNPBS_BOUNDARY, 1, 5, slit, NULL, 0));
  MUST(pnpbs_domain_add_pslg(it.domain, 1, unused, NULL, 0, NULL, NULL, 0, NULL));
  job_place(&it);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.1));
  MUST(pnpbs_placement_initialise(it.placement));
  found = warning_of(it.placement, PNPBS_WARNING_FEATURE_UNRESOLVED);
  ck_assert_int_eq(found.count, 1);
  ck_assert_double_eq_tol(found.value, 0.1, 1e-12); /* 0.01 / d */
  ck_assert(found.point[0] == 1 && found.point[1] == 0 && isnan(found.point[2]));
  found = warning_of(it.placement, PNPBS_WARNING_UNUSED_VERTICES);
  ck_assert(isnan(found.point[0]) && isnan(found.point[1]) && isnan(found.point[2]));
  job_end(&it);
}
END_TEST

START_TEST(warnings_on_a_sphere) {
  const double coast[10] = {0, 0, 40, 0, 40, 0.2, 40, 30, 0, 30};
  job it = on_sphere();
  warning found;
  double degrees[2];
  add_polyline_in_degrees(&it, 5, coast);
  job_place(&it);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 300));
  MUST(pnpbs_placement_initialise(it.placement));
  found = warning_of(it.placement, PNPBS_WARNING_FEATURE_UNRESOLVED);
  MUST(pnpbs_sphere_degrees(1, found.point, degrees));
  ck_assert_double_eq_tol(degrees[0], 40, 1e-6);
  ck_assert_double_eq_tol(degrees[1], 0.1, 0.11);
  ck_assert_double_eq_tol(found.value, 0.2 * PI / 180 * R / 300, 1e-3);
  job_end(&it);
}
END_TEST

/* A spacing callback: the paper's law compresses coarse regions beside a fine line, which causes
 * warnings. */
static int32_t fine_line(int64_t n, int32_t dim, const double* x, double* d, void* user) {
  int64_t i;
  (void)user;
  for (i = 0; i < n; ++i) d[i] = fmin(0.001 + 0.2 * fabs(x[dim * i + 1] - 0.5), 0.1);
  return 0;
}

START_TEST(in_checkpoints) {
  static const char path[] = PNPBS_TEST_WORK_DIR "/warnings.vtkhdf";
  job it = square_job(1), then = square_job(1);
  const job* both[2];
  int32_t k;
  warning a, b;
  both[0] = &it, both[1] = &then;
  for (k = 0; k < 2; ++k) {
    MUST(pnpbs_placement_set_spacing_callback(both[k]->placement, fine_line, NULL));
    MUST(pnpbs_placement_set(both[k]->placement, "method", "paper"));
  }
  ck_assert_int_eq(pnpbs_placement_run(it.placement), PNPBS_SPACING_MISSED);
  if (pnpbs_placement_write_checkpoint(it.placement, path) == PNPBS_ERROR_UNSUPPORTED) return;
  MUST(pnpbs_placement_read_checkpoint(then.placement, path));
  ck_assert_int_eq(warnings_of(it.placement), warnings_of(then.placement));
  ck_assert_int_gt(warning_of(then.placement, PNPBS_WARNING_SPACING_MISSED).count, 0);
  for (k = 0; k < warnings_of(it.placement); ++k) {
    char text[2000];
    const char* other;
    a = warning_at(it.placement, k);
    b = warning_at(then.placement, k);
    ck_assert_int_eq(a.code, b.code);
    ck_assert_int_eq(a.count, b.count);
    ck_assert(a.value == b.value || (isnan(a.value) && isnan(b.value)));
    ck_assert(a.point[0] == b.point[0] || (isnan(a.point[0]) && isnan(b.point[0])));
    MUST(pnpbs_placement_get_warning(it.placement, k, &other));
    snprintf(text, sizeof text, "%s", other);
    MUST(pnpbs_placement_get_warning(then.placement, k, &other));
    ck_assert_str_eq(text, other);
  }
  job_end(&it);
  job_end(&then);
}
END_TEST

/* ---------------------------------------------------------------- coordinates ------------ */

/* The first point is at a distance of 2, and the second one is not a number. The message names
 * both. */
START_TEST(coordinates_beyond_all_limits) {
  const double wrong[3] = {1e308, -1e308, NAN};
  job it = square_job(1);
  pnpbs_transfer transfer = NULL;
  double *values, out[2];
  int64_t n;
  size_t k;
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.2));
  MUST(pnpbs_placement_initialise(it.placement));
  MUST(pnpbs_placement_count(it.placement, &n));
  values = calloc((size_t)n, sizeof *values);
  ck_assert(values);
  MUST(pnpbs_transfer_create(it.placement, n, 1, values, &transfer));
  free(values);
  for (k = 0; k < 3; ++k) {
    const double x[4] = {0.5, 0.5, 0.5, wrong[k]};
    const char* const part =
        k == 0 ? "coordinates[1][1] is 1e+308" : "argument coordinates[1][1] is ";
    ck_assert_int_eq(pnpbs_transfer_at_points(transfer, 2, x, out), PNPBS_ERROR_ARGUMENT);
    expect_in_error(&it, PNPBS_ERROR_ARGUMENT, part);
    ck_assert_int_eq(pnpbs_domain_distance(it.domain, 0, 2, x, out), PNPBS_ERROR_ARGUMENT);
    expect_in_error(&it, PNPBS_ERROR_ARGUMENT, part);
    ck_assert_int_eq(pnpbs_domain_shape_spacing(it.domain, 20, 3, 1, 0, 2, x, out),
                     PNPBS_ERROR_ARGUMENT);
    expect_in_error(&it, PNPBS_ERROR_ARGUMENT, part);
  }
  pnpbs_transfer_destroy(&transfer);
  job_end(&it);
}
END_TEST

TEST_SUITE(test_messages) {
  Suite* suite = suite_create("messages");
  TCase* all = tcase_create("all");
  tcase_add_test(all, what_looks_like_a_point_is_none);
  tcase_add_test(all, points_on_a_sphere);
  tcase_add_test(all, points_in_the_plane);
  tcase_add_test(all, codes_and_numbers);
  tcase_add_test(all, numbers_with_and_without_a_point);
  tcase_add_test(all, warnings_on_a_sphere);
  tcase_add_test(all, in_checkpoints);
  tcase_add_test(all, coordinates_beyond_all_limits);
  tcase_set_timeout(all, 0);
  suite_add_tcase(suite, all);
  return run_suite(suite);
}
