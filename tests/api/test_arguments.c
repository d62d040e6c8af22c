/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests invalid arguments, one by one: the status, a message that names the argument and its value,
 * unchanged outputs, and objects that can be used as before.
 */
#include <limits.h>

#include "api_support.h"

#define N NAN
#define I HUGE_VAL

static job it; /* the calls use the objects of this job */
static int32_t curve_answer;
static double curve_x;

static int32_t curve(int64_t n, int32_t dim, const double* t, double* xy, void* user) {
  (void)dim;
  int64_t i;
  (void)user;
  for (i = 0; i < n; ++i) {
    xy[2 * i] = curve_x + cos(t[i]);
    xy[2 * i + 1] = sin(t[i]);
  }
  return curve_answer;
}

/* Buffer for outputs; check_outputs checks that no byte has changed. */
static union {
  double reals[64];
  int64_t integers[64];
  int32_t small[128];
  int8_t bytes[512];
  const char* texts[64];
} out;

static void prepare_outputs(void) { memset(&out, 0x5a, sizeof out); }

static void check_outputs(const char* call) {
  size_t i;
  for (i = 0; i < sizeof out; ++i) {
    ck_assert_msg(out.bytes[i] == 0x5a, "%s wrote byte %d of its outputs", call, (int)i);
  }
}

/* ---------------------------------------------------------------- the calls ------------- */

/* The expected status, two parts of the message, the text of the call and its line. */
typedef struct {
  pnpbs_status expected;
  const char *first, *second;
  const char* text;
  int line;
} row;

static void refuse(const row* r, pnpbs_status status) {
  ck_assert_msg(status == r->expected, "line %d: %s: status %d, not %d; %s", r->line, r->text,
                (int)status, (int)r->expected, status < 0 ? MESSAGE() : "no error");
  ck_assert_msg(strstr(MESSAGE(), r->first) != NULL && strstr(MESSAGE(), r->second) != NULL,
                "line %d: %s: no \"%s\" or no \"%s\" in the message \"%s\"", r->line, r->text,
                r->first, r->second, MESSAGE());
  /* The context holds the same message as the thread. */
  ck_assert_str_eq(pnpbs_last_error(it.context), MESSAGE());
  check_outputs(r->text);
}

#define REFUSE(status, first, second, call)                               \
  do {                                                                    \
    const row r = {PNPBS_ERROR_##status, first, second, #call, __LINE__}; \
    prepare_outputs();                                                    \
    refuse(&r, (call));                                                   \
  } while (0)

/* REFUSE for calls without a context. */
#define REFUSE_ANYWHERE(status, first, second, call)      \
  do {                                                    \
    prepare_outputs();                                    \
    MUST_FAIL(PNPBS_ERROR_##status, call, first, second); \
    check_outputs(#call);                                 \
  } while (0)

static void set_up(void) {
  it = square_job(1);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.15));
  MUST(pnpbs_placement_set(it.placement, "steps", "20"));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
}

static void tear_down(void) {
  double area = 0;
  /* The errors must not have changed anything. */
  MUST(pnpbs_domain_measure(it.domain, &area));
  ck_assert_double_eq(area, 1);
  check_placement(it.placement, 1);
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  check_placement(it.placement, 1);
  job_end(&it);
}

START_TEST(no_context) {
  REFUSE_ANYWHERE(ARGUMENT, "context", "NULL", pnpbs_context_create_serial(NULL));
  REFUSE_ANYWHERE(ARGUMENT, "context", "NULL", pnpbs_context_create_f(0, NULL));
  REFUSE_ANYWHERE(ARGUMENT, "context", "NULL", pnpbs_context_create_checked_f(0, "", NULL));
  REFUSE_ANYWHERE(ARGUMENT, "count", "NULL", pnpbs_option_count(NULL));
  REFUSE_ANYWHERE(ARGUMENT, "count", "NULL", pnpbs_statistic_count(NULL));
  REFUSE_ANYWHERE(
      ARGUMENT, "index = -1", " 0 .. ",
      pnpbs_option_info(-1, out.texts, out.texts + 1, out.texts + 2, out.texts + 3, out.texts + 4));
  REFUSE_ANYWHERE(ARGUMENT, "index = 1000", " 0 .. ",
                  pnpbs_option_info(1000, out.texts, NULL, NULL, NULL, NULL));
  REFUSE_ANYWHERE(ARGUMENT, "index = -1", " 0 .. ",
                  pnpbs_statistic_info(-1, out.texts, out.texts + 1, out.texts + 2));
  REFUSE_ANYWHERE(ARGUMENT, "index = 2147483647", " 0 .. ",
                  pnpbs_statistic_info(INT32_MAX, out.texts, NULL, NULL));
}
END_TEST

START_TEST(options) {
  pnpbs_context c = it.context;
  pnpbs_placement p = it.placement;
  REFUSE(ARGUMENT, "key", "NULL", pnpbs_context_set(c, NULL, "1"));
  REFUSE(ARGUMENT, "value", "NULL", pnpbs_context_set(c, "steps", NULL));
  REFUSE(ARGUMENT, "key", "NULL", pnpbs_context_set_int64(c, NULL, 1));
  REFUSE(ARGUMENT, "key", "NULL", pnpbs_context_set_double(c, NULL, 1));
  REFUSE(KEY, "\"stpes\"", "\"steps\"", pnpbs_context_set(c, "stpes", "1"));
  REFUSE(KEY, "\"\"", "nearest", pnpbs_context_set(c, "", "1"));
  REFUSE(KEY, "\"Steps\"", "\"steps\"", pnpbs_context_set_int64(c, "Steps", 1));
  REFUSE(KEY, "\"damping \"", "\"damping\"", pnpbs_context_set_double(c, "damping ", 1));
  REFUSE(ARGUMENT, "steps", "\"many\"", pnpbs_context_set(c, "steps", "many"));
  REFUSE(ARGUMENT, "steps", "\"1.5\"", pnpbs_context_set(c, "steps", "1.5"));
  REFUSE(ARGUMENT, "steps", "\"\"", pnpbs_context_set(c, "steps", ""));
  REFUSE(ARGUMENT, "steps", "\" 5\"", pnpbs_context_set(c, "steps", " 5"));
  REFUSE(ARGUMENT, "steps", "\"5 \"", pnpbs_context_set(c, "steps", "5 "));
  REFUSE(ARGUMENT, "steps", "\"+-0\"", pnpbs_context_set(c, "steps", "+-0"));
  REFUSE(ARGUMENT, "steps", "\"0x10\"", pnpbs_context_set(c, "steps", "0x10"));
  REFUSE(ARGUMENT, "steps", "\"99999999999999999999\"",
         pnpbs_context_set(c, "steps", "99999999999999999999"));
  REFUSE(ARGUMENT, "steps", "-1", pnpbs_context_set_int64(c, "steps", -1));
  REFUSE(ARGUMENT, "steps", "9223372036854775807", pnpbs_context_set_int64(c, "steps", INT64_MAX));
  REFUSE(ARGUMENT, "steps", "1.5", pnpbs_context_set_double(c, "steps", 1.5));
  REFUSE(ARGUMENT, "steps", "nan", pnpbs_context_set_double(c, "steps", N));
  REFUSE(ARGUMENT, "steps", "1e+300", pnpbs_context_set_double(c, "steps", 1e300));
  REFUSE(ARGUMENT, "damping", "\"0,7\"", pnpbs_context_set(c, "damping", "0,7"));
  REFUSE(ARGUMENT, "damping", "\"nan\"", pnpbs_context_set(c, "damping", "nan"));
  REFUSE(ARGUMENT, "damping", "\"inf\"", pnpbs_context_set(c, "damping", "inf"));
  REFUSE(ARGUMENT, "damping", "\"1e999\"", pnpbs_context_set(c, "damping", "1e999"));
  REFUSE(ARGUMENT, "damping", "nan", pnpbs_context_set_double(c, "damping", N));
  REFUSE(ARGUMENT, "damping", "inf", pnpbs_context_set_double(c, "damping", I));
  REFUSE(ARGUMENT, "damping", "-1", pnpbs_context_set_int64(c, "damping", -1));
  REFUSE(ARGUMENT, "method", "default | paper", pnpbs_context_set(c, "method", "Paper"));
  REFUSE(ARGUMENT, "method", "\"1\"", pnpbs_context_set_int64(c, "method", 1));
  REFUSE(ARGUMENT, "method", "\"0.5\"", pnpbs_context_set_double(c, "method", 0.5));
  REFUSE(STATE, "threads", "before", pnpbs_context_set(c, "threads", "7"));

  REFUSE(ARGUMENT, "key", "NULL", pnpbs_placement_set(p, NULL, "1"));
  REFUSE(ARGUMENT, "value", "NULL", pnpbs_placement_set(p, "steps", NULL));
  REFUSE(ARGUMENT, "key", "NULL", pnpbs_placement_set_int64(p, NULL, 1));
  REFUSE(ARGUMENT, "key", "NULL", pnpbs_placement_set_double(p, NULL, 1));
  REFUSE(KEY, "\"sweep\"", "\"sweeps\"", pnpbs_placement_set(p, "sweep", "1"));
  REFUSE(KEY, "\"maxnodes\"", "\"max_nodes\"", pnpbs_placement_set_int64(p, "maxnodes", 1));
  REFUSE(KEY, "\"dampin\"", "\"damping\"", pnpbs_placement_set_double(p, "dampin", 1));
  REFUSE(ARGUMENT, "sweeps", "\"-1\"", pnpbs_placement_set(p, "sweeps", "-1"));
  REFUSE(ARGUMENT, "sweeps", "-7", pnpbs_placement_set_int64(p, "sweeps", -7));
  REFUSE(ARGUMENT, "centroidal_sweeps", "-1", pnpbs_placement_set(p, "centroidal_sweeps", "-1"));
  REFUSE(ARGUMENT, "obtuse_rounds", "-1", pnpbs_placement_set(p, "obtuse_rounds", "-1"));
  REFUSE(ARGUMENT, "centroidal_sweeps", "10001",
         pnpbs_placement_set_int64(p, "centroidal_sweeps", 10001));
  REFUSE(ARGUMENT, "rest_length", "9.5", pnpbs_placement_set_double(p, "rest_length", 9.5));
  REFUSE(STATE, "threads", "context", pnpbs_placement_set(p, "threads", "2"));
  REFUSE(STATE, "threads", "context", pnpbs_placement_set_int64(p, "threads", 2));
}
END_TEST

START_TEST(creating) {
  pnpbs_domain domain = NULL;
  pnpbs_placement placement = NULL;
  REFUSE(ARGUMENT, "domain", "NULL", pnpbs_domain_create(it.context, 2, NULL));
  REFUSE(ARGUMENT, "dim = 4", "2 or 3", pnpbs_domain_create(it.context, 4, &domain));
  REFUSE(ARGUMENT, "dim = 1", "2", pnpbs_domain_create(it.context, 1, &domain));
  REFUSE(ARGUMENT, "dim = 0", "2", pnpbs_domain_create(it.context, 0, &domain));
  REFUSE(ARGUMENT, "dim = -2", "2", pnpbs_domain_create(it.context, -2, &domain));
  REFUSE(ARGUMENT, "placement", "NULL", pnpbs_placement_create(it.context, it.domain, NULL));
  ck_assert_ptr_null(domain);
  ck_assert_ptr_null(placement);
}
END_TEST

START_TEST(polylines) {
  const double square[8] = {0, 0, 1, 0, 1, 1, 0, 1};
  const double nan_y[8] = {0, 0, 1, 0, 1, N, 0, 1};
  const double endless[8] = {0, 0, 1, 0, 1, 1, -I, 1};
  const double huge[8] = {0, 0, 1, 0, 1e200, 1, 0, 1};
  const double twice[8] = {0, 0, 1, 0, 1, 0, 0, 1};
  const double repeated[8] = {0, 0, 1, 0, 1, 1, 0, 0};
  const int32_t tags[4] = {1, 2, 0, 4};
  pnpbs_domain d = it.domain;
  REFUSE(ARGUMENT, "role", "2", pnpbs_domain_add_polyline(d, 2, 1, 4, square, NULL, 0));
  REFUSE(ARGUMENT, "role", "-1", pnpbs_domain_add_polyline(d, -1, 1, 4, square, NULL, 0));
  REFUSE(ARGUMENT, "n ", "-5", pnpbs_domain_add_polyline(d, 0, 1, -5, square, NULL, 0));
  REFUSE(ARGUMENT, "n ", "2", pnpbs_domain_add_polyline(d, 0, 1, 2, square, NULL, 0));
  REFUSE(ARGUMENT, "n ", "1", pnpbs_domain_add_polyline(d, 0, 0, 1, square, NULL, 0));
  REFUSE(ARGUMENT, "n ", "0", pnpbs_domain_add_polyline(d, 0, 0, 0, square, NULL, 0));
  REFUSE(ARGUMENT, "n ", "9223372036854775807",
         pnpbs_domain_add_polyline(d, 0, 0, INT64_MAX, square, NULL, 0));
  REFUSE(ARGUMENT, "coordinates", "NULL", pnpbs_domain_add_polyline(d, 0, 1, 4, NULL, NULL, 0));
  REFUSE(ARGUMENT, "coordinates[2][1]", "nan",
         pnpbs_domain_add_polyline(d, 0, 1, 4, nan_y, NULL, 0));
  REFUSE(ARGUMENT, "coordinates[3][0]", "-inf",
         pnpbs_domain_add_polyline(d, 0, 1, 4, endless, NULL, 0));
  REFUSE(ARGUMENT, "coordinates[2][0]", "1e+200",
         pnpbs_domain_add_polyline(d, 0, 1, 4, huge, NULL, 0));
  REFUSE(ARGUMENT, "vertices 1 and 2", "(1, 0)",
         pnpbs_domain_add_polyline(d, 0, 1, 4, twice, NULL, 0));
  REFUSE(ARGUMENT, "vertex 3", "(0, 0)", pnpbs_domain_add_polyline(d, 0, 1, 4, repeated, NULL, 0));
  REFUSE(ARGUMENT, "tags[2]", "0", pnpbs_domain_add_polyline(d, 0, 1, 4, square, tags, 0));
  REFUSE(ARGUMENT, "corner_angle", "-1", pnpbs_domain_add_polyline(d, 0, 1, 4, square, NULL, -1));
  REFUSE(ARGUMENT, "corner_angle", "181", pnpbs_domain_add_polyline(d, 0, 1, 4, square, NULL, 181));
  REFUSE(ARGUMENT, "corner_angle", "nan", pnpbs_domain_add_polyline(d, 0, 1, 4, square, NULL, N));
}
END_TEST

START_TEST(arcs) {
  const double o[2] = {0.5, 0.5}, bad_x[2] = {N, 0}, bad_y[2] = {0, I};
  pnpbs_domain d = it.domain;
  REFUSE(ARGUMENT, "role", "7", pnpbs_domain_add_arc(d, 7, o, 1, 0, 1, 1));
  REFUSE(ARGUMENT, "centre", "NULL", pnpbs_domain_add_arc(d, 1, NULL, 1, 0, 1, 1));
  REFUSE(ARGUMENT, "centre[0]", "nan", pnpbs_domain_add_arc(d, 1, bad_x, 1, 0, 1, 1));
  REFUSE(ARGUMENT, "centre[1]", "inf", pnpbs_domain_add_arc(d, 1, bad_y, 1, 0, 1, 1));
  REFUSE(ARGUMENT, "radius", "0", pnpbs_domain_add_arc(d, 1, o, 0, 0, 1, 1));
  REFUSE(ARGUMENT, "radius", "-2", pnpbs_domain_add_arc(d, 1, o, -2, 0, 1, 1));
  REFUSE(ARGUMENT, "radius", "nan", pnpbs_domain_add_arc(d, 1, o, N, 0, 1, 1));
  REFUSE(ARGUMENT, "radius", "inf", pnpbs_domain_add_arc(d, 1, o, I, 0, 1, 1));
  REFUSE(ARGUMENT, "begin", "nan", pnpbs_domain_add_arc(d, 1, o, 1, N, 1, 1));
  REFUSE(ARGUMENT, "end", "inf", pnpbs_domain_add_arc(d, 1, o, 1, 0, I, 1));
  REFUSE(ARGUMENT, "begin and end", "3", pnpbs_domain_add_arc(d, 1, o, 1, 3, 3, 1));
  REFUSE(ARGUMENT, "end - begin", "7", pnpbs_domain_add_arc(d, 1, o, 1, 0, 7, 1));
  REFUSE(ARGUMENT, "end - begin", "-8", pnpbs_domain_add_arc(d, 1, o, 1, 4, -4, 1));
  REFUSE(ARGUMENT, "tag", "0", pnpbs_domain_add_arc(d, 1, o, 1, 0, 1, 0));
}
END_TEST

START_TEST(curves) {
  pnpbs_domain d = it.domain;
  REFUSE(ARGUMENT, "curve", "NULL", pnpbs_domain_add_curve(d, 1, NULL, NULL, 0, 1, 1));
  REFUSE(ARGUMENT, "role", "3", pnpbs_domain_add_curve(d, 3, curve, NULL, 0, 1, 1));
  REFUSE(ARGUMENT, "begin", "nan", pnpbs_domain_add_curve(d, 1, curve, NULL, N, 1, 1));
  REFUSE(ARGUMENT, "end", "-inf", pnpbs_domain_add_curve(d, 1, curve, NULL, 0, -I, 1));
  REFUSE(ARGUMENT, "begin and end", "2", pnpbs_domain_add_curve(d, 1, curve, NULL, 2, 2, 1));
  REFUSE(ARGUMENT, "tag", "0", pnpbs_domain_add_curve(d, 1, curve, NULL, 0, 1, 0));
  curve_answer = 17;
  REFUSE(CALLBACK, "curve", "17", pnpbs_domain_add_curve(d, 1, curve, NULL, 0, 1, 1));
  curve_answer = 0;
  curve_x = N;
  REFUSE(ARGUMENT, "curve", "nan", pnpbs_domain_add_curve(d, 1, curve, NULL, 0, 1, 1));
  curve_x = 0;
}
END_TEST

START_TEST(graphs) {
  const double xy[6] = {0, 0, 1, 0, 0, 1}, bad[6] = {0, 0, 1, 0, N, 1}, hole[2] = {0.2, I};
  const int64_t ends[6] = {0, 1, 1, 2, 2, 0}, below[6] = {0, 1, 1, -1, 2, 0},
                beyond[6] = {0, 1, 1, 2, 3, 0}, same[6] = {0, 1, 1, 1, 2, 0};
  pnpbs_domain d = it.domain;
  REFUSE(ARGUMENT, "vertices", "-1",
         pnpbs_domain_add_pslg(d, -1, xy, NULL, 3, ends, NULL, 0, NULL));
  REFUSE(ARGUMENT, "segments", "-3",
         pnpbs_domain_add_pslg(d, 3, xy, NULL, -3, ends, NULL, 0, NULL));
  REFUSE(ARGUMENT, "holes", "-2", pnpbs_domain_add_pslg(d, 3, xy, NULL, 3, ends, NULL, -2, xy));
  REFUSE(ARGUMENT, "vertices", "9223372036854775807",
         pnpbs_domain_add_pslg(d, INT64_MAX, xy, NULL, 3, ends, NULL, 0, NULL));
  REFUSE(ARGUMENT, "coordinates", "NULL",
         pnpbs_domain_add_pslg(d, 3, NULL, NULL, 3, ends, NULL, 0, NULL));
  REFUSE(ARGUMENT, "segment_ends", "NULL",
         pnpbs_domain_add_pslg(d, 3, xy, NULL, 3, NULL, NULL, 0, NULL));
  REFUSE(ARGUMENT, "hole_points", "NULL",
         pnpbs_domain_add_pslg(d, 3, xy, NULL, 3, ends, NULL, 1, NULL));
  REFUSE(ARGUMENT, "coordinates[2][0]", "nan",
         pnpbs_domain_add_pslg(d, 3, bad, NULL, 3, ends, NULL, 0, NULL));
  REFUSE(ARGUMENT, "hole_points[0][1]", "inf",
         pnpbs_domain_add_pslg(d, 3, xy, NULL, 3, ends, NULL, 1, hole));
  REFUSE(ARGUMENT, "segment_ends[1][1]", "-1",
         pnpbs_domain_add_pslg(d, 3, xy, NULL, 3, below, NULL, 0, NULL));
  REFUSE(ARGUMENT, "segment_ends[2][0]", "3",
         pnpbs_domain_add_pslg(d, 3, xy, NULL, 3, beyond, NULL, 0, NULL));
  REFUSE(ARGUMENT, "segment_ends[1]", "1",
         pnpbs_domain_add_pslg(d, 3, xy, NULL, 3, same, NULL, 0, NULL));
}
END_TEST

START_TEST(points_and_files) {
  const double bad[2] = {0.5, N}, good[2] = {0.5, 0.5};
  const int32_t no_tag = 0;
  pnpbs_domain d = it.domain;
  REFUSE(ARGUMENT, "point", "NULL", pnpbs_domain_add_hole(d, NULL));
  REFUSE(ARGUMENT, "point[1]", "nan", pnpbs_domain_add_hole(d, bad));
  REFUSE(ARGUMENT, "n ", "-1", pnpbs_domain_add_fixed_nodes(d, -1, good, NULL));
  REFUSE(ARGUMENT, "coordinates", "NULL", pnpbs_domain_add_fixed_nodes(d, 1, NULL, NULL));
  REFUSE(ARGUMENT, "coordinates[0][1]", "nan", pnpbs_domain_add_fixed_nodes(d, 1, bad, NULL));
  REFUSE(ARGUMENT, "tags[0]", "0", pnpbs_domain_add_fixed_nodes(d, 1, good, &no_tag));

  REFUSE(ARGUMENT, "path", "NULL", pnpbs_domain_read_poly(d, NULL));
  REFUSE(FILE, "no/such.poly", "", pnpbs_domain_read_poly(d, "no/such.poly"));
  REFUSE(FILE, PNPBS_SOURCE_DIR, "", pnpbs_domain_read_poly(d, PNPBS_SOURCE_DIR));
  REFUSE(ARGUMENT, "text", "NULL", pnpbs_domain_parse_poly(d, NULL, 3, "a text"));
  REFUSE(ARGUMENT, "length", "-3", pnpbs_domain_parse_poly(d, "0 0", -3, "a text"));
  REFUSE(FILE, "a text", "", pnpbs_domain_parse_poly(d, "", 0, "a text"));
  REFUSE(FILE, "a text", "3", pnpbs_domain_parse_poly(d, "3 2 0 0\n1 0 0\n2 x 0\n", 20, "a text"));
  REFUSE(FILE, "3", "", pnpbs_domain_parse_poly(d, "3 2 0 0\n1 0 0\n2 x 0\n", 20, NULL));

  REFUSE(ARGUMENT, "low", "NULL", pnpbs_domain_bounds(d, NULL, out.reals));
  REFUSE(ARGUMENT, "high", "NULL", pnpbs_domain_bounds(d, out.reals, NULL));
  REFUSE(ARGUMENT, "measure", "NULL", pnpbs_domain_measure(d, NULL));
  REFUSE(ARGUMENT, "dim", "NULL", pnpbs_domain_dimension(d, NULL));
  REFUSE(ARGUMENT, "count", "NULL",
         pnpbs_domain_get_segments(d, 9, NULL, out.reals, out.small + 90));
}
END_TEST

START_TEST(segments_of_the_domain) {
  int64_t n = 0;
  REFUSE(ARGUMENT, "capacity", "-4", pnpbs_domain_get_segments(it.domain, -4, &n, out.reals, NULL));
  REFUSE(CAPACITY, "capacity = 3", "4",
         pnpbs_domain_get_segments(it.domain, 3, &n, out.reals, out.small + 100));
  REFUSE(CAPACITY, "capacity = 0", "4",
         pnpbs_domain_get_segments(it.domain, 0, &n, NULL, out.small + 100));
}
END_TEST

START_TEST(spacings) {
  const int64_t size[2] = {2, 2}, no_size[2] = {2, 0}, bad_size[2] = {-2, 2};
  const double o[2] = {0, 0}, h[2] = {1, 1}, v[4] = {0.1, 0.1, 0.1, 0.1};
  const double bad_o[2] = {0, N}, bad_h[2] = {0, 1}, back_h[2] = {1, -1}, far_h[2] = {1, I};
  const double zero[4] = {0.1, 0, 0.1, 0.1}, below[4] = {0.1, 0.1, -3, 0.1},
               unknown[4] = {0.1, 0.1, 0.1, N};
  pnpbs_placement p = it.placement;
  REFUSE(SPACING, "d = 0", "greater", pnpbs_placement_set_spacing_constant(p, 0));
  REFUSE(SPACING, "d = -1", "greater", pnpbs_placement_set_spacing_constant(p, -1));
  REFUSE(SPACING, "nan", "finite", pnpbs_placement_set_spacing_constant(p, N));
  REFUSE(SPACING, "inf", "finite", pnpbs_placement_set_spacing_constant(p, I));
  REFUSE(ARGUMENT, "spacing", "NULL", pnpbs_placement_set_spacing_callback(p, NULL, NULL));
  REFUSE(ARGUMENT, "size", "NULL", pnpbs_placement_set_spacing_grid(p, NULL, o, h, v));
  REFUSE(ARGUMENT, "origin", "NULL", pnpbs_placement_set_spacing_grid(p, size, NULL, h, v));
  REFUSE(ARGUMENT, "step", "NULL", pnpbs_placement_set_spacing_grid(p, size, o, NULL, v));
  REFUSE(ARGUMENT, "values", "NULL", pnpbs_placement_set_spacing_grid(p, size, o, h, NULL));
  REFUSE(ARGUMENT, "size[1] = 0", "1", pnpbs_placement_set_spacing_grid(p, no_size, o, h, v));
  REFUSE(ARGUMENT, "size[0] = -2", "1", pnpbs_placement_set_spacing_grid(p, bad_size, o, h, v));
  REFUSE(ARGUMENT, "origin[1]", "nan", pnpbs_placement_set_spacing_grid(p, size, bad_o, h, v));
  REFUSE(ARGUMENT, "step[0] = 0", "greater",
         pnpbs_placement_set_spacing_grid(p, size, o, bad_h, v));
  REFUSE(ARGUMENT, "step[1] = -1", "greater",
         pnpbs_placement_set_spacing_grid(p, size, o, back_h, v));
  REFUSE(ARGUMENT, "step[1]", "inf", pnpbs_placement_set_spacing_grid(p, size, o, far_h, v));
  REFUSE(SPACING, "values[0][1] = 0 at (1, 0)", "greater",
         pnpbs_placement_set_spacing_grid(p, size, o, h, zero));
  REFUSE(SPACING, "values[1][0] = -3", "greater",
         pnpbs_placement_set_spacing_grid(p, size, o, h, below));
  REFUSE(SPACING, "values[1][1]", "nan", pnpbs_placement_set_spacing_grid(p, size, o, h, unknown));
}
END_TEST

START_TEST(spacings_from_fields) {
  const double xy[8] = {0, 0, 1, 0, 1, 1, 0, 1}, flat[6] = {0, 0, 0.25, 0, 0.5, 0},
               bad_xy[6] = {0, 0, 1, N, 1, 1}, far_xy[6] = {9, 9, 10, 9, 10, 11},
               same[4] = {0.5, 0.5, 0.5, 0.5};
  const double v[4] = {0.1, 0.2, 0.1, 0.1}, zero[3] = {0.1, 0, 0.1}, unknown[3] = {0.1, 0.1, N};
  const int64_t c[6] = {0, 1, 2, 0, 2, 3}, over[3] = {0, 1, 3}, under[3] = {0, -1, 2};
  pnpbs_placement p = it.placement;
  REFUSE(ARGUMENT, "n is 0", "1", pnpbs_placement_set_spacing_mesh(p, 0, xy, v, 1, c));
  REFUSE(ARGUMENT, "n is -7", "1", pnpbs_placement_set_spacing_points(p, -7, xy, v));
  REFUSE(ARGUMENT, "n is 4294967296", "2^31",
         pnpbs_placement_set_spacing_points(p, INT64_C(4294967296), xy, v));
  REFUSE(ARGUMENT, "coordinates", "NULL", pnpbs_placement_set_spacing_mesh(p, 3, NULL, v, 1, c));
  REFUSE(ARGUMENT, "coordinates", "NULL", pnpbs_placement_set_spacing_points(p, 3, NULL, v));
  REFUSE(ARGUMENT, "argument d", "NULL", pnpbs_placement_set_spacing_mesh(p, 3, xy, NULL, 1, c));
  REFUSE(ARGUMENT, "elements is 0", "1", pnpbs_placement_set_spacing_mesh(p, 3, xy, v, 0, c));
  REFUSE(ARGUMENT, "corners", "NULL", pnpbs_placement_set_spacing_mesh(p, 3, xy, v, 1, NULL));
  REFUSE(ARGUMENT, "corners[0][2] = 3", "0 .. 2",
         pnpbs_placement_set_spacing_mesh(p, 3, xy, v, 1, over));
  REFUSE(ARGUMENT, "corners[0][1] = -1", "0 .. 2",
         pnpbs_placement_set_spacing_mesh(p, 3, xy, v, 1, under));
  REFUSE(ARGUMENT, "corners[1][2] = 3", "3 nodes",
         pnpbs_placement_set_spacing_mesh(p, 3, xy, v, 2, c));
  REFUSE(ARGUMENT, "corners[0]", "flat", pnpbs_placement_set_spacing_mesh(p, 3, flat, v, 1, c));
  REFUSE(ARGUMENT, "coordinates[1]", "nan",
         pnpbs_placement_set_spacing_mesh(p, 3, bad_xy, v, 1, c));
  REFUSE(SPACING, "d[1]", "= 0: ", pnpbs_placement_set_spacing_mesh(p, 3, xy, zero, 1, c));
  REFUSE(SPACING, "d[2]", "nan", pnpbs_placement_set_spacing_points(p, 3, xy, unknown));
  REFUSE(SPACING, "from (9, 9) to (10, 11)", "unit",
         pnpbs_placement_set_spacing_mesh(p, 3, far_xy, v, 1, c));
  REFUSE(ARGUMENT, "path", "NULL", pnpbs_placement_set_spacing_file(p, NULL, NULL));
  REFUSE(FILE, "no.vtu", "No such", pnpbs_placement_set_spacing_file(p, "no.vtu", ""));
  REFUSE(FILE, "no.stl", ".vtu, .msh or .csv", pnpbs_placement_set_spacing_file(p, "no.stl", ""));
  REFUSE(SPACING, "d[0] = 0.1 and argument d[1] = 0.2", "(0.5, 0.5)",
         pnpbs_placement_set_spacing_points(p, 2, same, v));
}
END_TEST

START_TEST(given_nodes) {
  const double xy[4] = {0.25, 0.5, 0.75, 0.5}, bad[4] = {0.25, 0.5, I, 0.5};
  const int64_t same[2] = {7, 7}, below[2] = {7, -8}, last[2] = {3, INT64_MAX};
  pnpbs_placement p = it.placement;
  REFUSE(ARGUMENT, "n ", "-1", pnpbs_placement_set_nodes(p, -1, xy, NULL));
  REFUSE(ARGUMENT, "coordinates", "NULL", pnpbs_placement_set_nodes(p, 2, NULL, NULL));
  REFUSE(ARGUMENT, "coordinates[1]", "inf", pnpbs_placement_set_nodes(p, 2, bad, NULL));
  REFUSE(ARGUMENT, "ids[1]", "-8", pnpbs_placement_set_nodes(p, 2, xy, below));
  REFUSE(ARGUMENT, "ids", "7", pnpbs_placement_set_nodes(p, 2, xy, same));
  /* With the largest id in use, no id is left for new nodes. */
  REFUSE(ARGUMENT, "ids[1]", "9223372036854775807", pnpbs_placement_set_nodes(p, 2, xy, last));
}
END_TEST

START_TEST(computing) {
  pnpbs_placement p = it.placement;
  REFUSE(ARGUMENT, "n ", "-1", pnpbs_placement_step(p, -1));
  REFUSE(ARGUMENT, "n ", "-9223372036854775808", pnpbs_placement_step(p, INT64_MIN));
}
END_TEST

START_TEST(getting_nodes) {
  pnpbs_placement p = it.placement;
  int64_t n = integer_of(p, "nodes");
  char need[40];
  snprintf(need, sizeof need, "%lld", (long long)n);
  REFUSE(ARGUMENT, "nodes", "NULL", pnpbs_placement_count(p, NULL));
  REFUSE(ARGUMENT, "dim", "NULL", pnpbs_placement_dimension(p, NULL));
  REFUSE(ARGUMENT, "radius", "NULL", pnpbs_placement_sphere_radius(p, NULL));
  REFUSE(CAPACITY, "capacity = 3", need,
         pnpbs_placement_get_nodes(p, 3, out.reals, out.integers + 20, NULL, NULL));
  REFUSE(CAPACITY, "capacity = 0", need,
         pnpbs_placement_get_nodes(p, 0, out.reals, NULL, NULL, NULL));
  REFUSE(CAPACITY, "capacity", need, pnpbs_placement_get_nodes(p, n - 1, NULL, NULL, NULL, NULL));
  REFUSE(ARGUMENT, "capacity", "-1", pnpbs_placement_get_nodes(p, -1, out.reals, NULL, NULL, NULL));
  MUST(pnpbs_placement_get_nodes(p, n, NULL, NULL, NULL, NULL));
  MUST(pnpbs_placement_get_nodes(p, INT64_MAX, NULL, NULL, NULL, NULL));
}
END_TEST

START_TEST(getting_neighbours) {
  pnpbs_placement p = it.placement;
  int64_t n = integer_of(p, "nodes"), entries = 0, stars = 0, count = 0;
  int64_t* offsets = malloc((size_t)(n + 1) * sizeof *offsets);
  char need[40], need_stars[40], need_triangles[40], need_edges[40];
  ck_assert_ptr_nonnull(offsets);
  memset(offsets, 0x77, (size_t)(n + 1) * sizeof *offsets);
  MUST(pnpbs_placement_adjacency_size(p, &entries));
  snprintf(need, sizeof need, "%lld", (long long)entries);
  REFUSE(ARGUMENT, "entries", "NULL", pnpbs_placement_adjacency_size(p, NULL));
  REFUSE(ARGUMENT, "offsets", "NULL", pnpbs_placement_get_adjacency(p, 8, NULL, out.integers));
  REFUSE(ARGUMENT, "neighbours", "NULL", pnpbs_placement_get_adjacency(p, entries, offsets, NULL));
  REFUSE(CAPACITY, "capacity = 8", need,
         pnpbs_placement_get_adjacency(p, 8, offsets, out.integers));
  REFUSE(CAPACITY, "capacity", need,
         pnpbs_placement_get_adjacency(p, entries - 1, offsets, out.integers));
  REFUSE(CAPACITY, "capacity = 0", need, pnpbs_placement_get_adjacency(p, 0, offsets, NULL));
  REFUSE(ARGUMENT, "capacity", "-8", pnpbs_placement_get_adjacency(p, -8, offsets, out.integers));

  MUST(pnpbs_placement_star_size(p, &stars));
  snprintf(need_stars, sizeof need_stars, "%lld", (long long)stars);
  REFUSE(ARGUMENT, "entries", "NULL", pnpbs_placement_star_size(p, NULL));
  REFUSE(ARGUMENT, "offsets", "NULL", pnpbs_placement_get_stars(p, 8, NULL, out.integers, NULL));
  REFUSE(ARGUMENT, "neighbours", "NULL", pnpbs_placement_get_stars(p, stars, offsets, NULL, NULL));
  REFUSE(CAPACITY, "capacity", need_stars,
         pnpbs_placement_get_stars(p, stars - 1, offsets, out.integers, out.bytes + 400));
  REFUSE(ARGUMENT, "capacity", "-8",
         pnpbs_placement_get_stars(p, -8, offsets, out.integers, out.bytes + 400));
  for (count = 0; count <= n; ++count) ck_assert_int_eq(offsets[count], 0x7777777777777777);
  free(offsets);

  MUST(pnpbs_placement_get_triangles(p, 0, &count, NULL));
  snprintf(need_triangles, sizeof need_triangles, "%lld", (long long)count);
  REFUSE(ARGUMENT, "count", "NULL", pnpbs_placement_get_triangles(p, 9, NULL, out.integers));
  REFUSE(CAPACITY, "capacity = 9", need_triangles,
         pnpbs_placement_get_triangles(p, 9, &count, out.integers));
  REFUSE(CAPACITY, "capacity = 0", need_triangles,
         pnpbs_placement_get_triangles(p, 0, &count, out.integers));
  REFUSE(ARGUMENT, "capacity", "-9", pnpbs_placement_get_triangles(p, -9, &count, out.integers));

  MUST(pnpbs_placement_get_boundary_edges(p, 0, &count, NULL, NULL));
  snprintf(need_edges, sizeof need_edges, "%lld", (long long)count);
  REFUSE(ARGUMENT, "count", "NULL",
         pnpbs_placement_get_boundary_edges(p, 9, NULL, out.integers, NULL));
  REFUSE(CAPACITY, "capacity = 9", need_edges,
         pnpbs_placement_get_boundary_edges(p, 9, &count, out.integers, NULL));
  REFUSE(CAPACITY, "capacity = 0", need_edges,
         pnpbs_placement_get_boundary_edges(p, 0, &count, NULL, out.small));
  REFUSE(ARGUMENT, "capacity", "-9",
         pnpbs_placement_get_boundary_edges(p, -9, &count, out.integers, NULL));
}
END_TEST

START_TEST(edges) {
  pnpbs_placement p = it.placement;
  int64_t count = -1, straight = -1, wrong[6] = {0, 1, 2, 0, 1, INT64_MAX};
  char need[32];
  MUST(pnpbs_placement_get_edges(p, 0, &count, &straight, NULL, NULL, NULL));
  ck_assert_int_eq(straight, 0);
  snprintf(need, sizeof need, "%lld", (long long)count);
  REFUSE(ARGUMENT, "count", "NULL", pnpbs_placement_get_edges(p, 0, NULL, NULL, NULL, NULL, NULL));
  REFUSE(CAPACITY, "capacity = 9", need,
         pnpbs_placement_get_edges(p, 9, &count, NULL, out.integers, NULL, NULL));
  REFUSE(CAPACITY, "capacity = 0", need,
         pnpbs_placement_get_edges(p, 0, &count, NULL, NULL, NULL, out.reals));
  MUST(pnpbs_placement_find_edges(p, 0, 3, NULL, NULL));
  REFUSE(ARGUMENT, "n", "-1", pnpbs_placement_find_edges(p, -1, 3, wrong, out.integers));
  REFUSE(ARGUMENT, "corners", "5", pnpbs_placement_find_edges(p, 1, 5, wrong, out.integers));
  REFUSE(ARGUMENT, "cells", "NULL", pnpbs_placement_find_edges(p, 1, 3, NULL, out.integers));
  REFUSE(ARGUMENT, "edges", "NULL", pnpbs_placement_find_edges(p, 1, 3, wrong, NULL));
  REFUSE(ARGUMENT, "cells[1]", "9223372036854775807",
         pnpbs_placement_find_edges(p, 2, 3, wrong, out.integers + 1));
}
END_TEST

START_TEST(statistics_and_warnings) {
  pnpbs_placement p = it.placement;
  REFUSE(ARGUMENT, "key", "NULL", pnpbs_placement_get_int64(p, NULL, out.integers));
  REFUSE(ARGUMENT, "key", "NULL", pnpbs_placement_get_double(p, NULL, out.reals));
  REFUSE(ARGUMENT, "key", "NULL", pnpbs_placement_get_string(p, NULL, out.texts));
  REFUSE(ARGUMENT, "value", "NULL", pnpbs_placement_get_int64(p, "nodes", NULL));
  REFUSE(ARGUMENT, "value", "NULL", pnpbs_placement_get_double(p, "speed.mean", NULL));
  REFUSE(ARGUMENT, "value", "NULL", pnpbs_placement_get_string(p, "hash", NULL));
  REFUSE(KEY, "\"nodse\"", "\"nodes\"", pnpbs_placement_get_int64(p, "nodse", out.integers));
  REFUSE(KEY, "\"speed.men\"", "\"speed.mean\"",
         pnpbs_placement_get_double(p, "speed.men", out.reals));
  REFUSE(KEY, "\"Hash\"", "\"hash\"", pnpbs_placement_get_string(p, "Hash", out.texts));
  REFUSE(KEY, "\"hash\"", "string", pnpbs_placement_get_int64(p, "hash", out.integers));
  REFUSE(KEY, "\"nodes\"", "integer", pnpbs_placement_get_double(p, "nodes", out.reals));
  REFUSE(KEY, "\"d_error.mean\"", "real", pnpbs_placement_get_string(p, "d_error.mean", out.texts));

  REFUSE(ARGUMENT, "count", "NULL", pnpbs_placement_warning_count(p, NULL));
  REFUSE(ARGUMENT, "index = -1", "0 warnings", pnpbs_placement_get_warning(p, -1, out.texts));
  REFUSE(ARGUMENT, "index = 0", "0 warnings", pnpbs_placement_get_warning(p, 0, out.texts));
  REFUSE(ARGUMENT, "text", "NULL", pnpbs_placement_get_warning(p, 0, NULL));
}
END_TEST

/* ---------------------------------------------------------------- states ---------------- */

/* Checks queries before there are nodes, and before there is a spacing. */
START_TEST(nothing_yet) {
  job empty = square_job(1);
  pnpbs_placement p = empty.placement;
  int64_t n = 7, size = 7;
  int32_t warnings = 7;
  const char* text = NULL;
  MUST(pnpbs_placement_count(p, &n));
  ck_assert_int_eq(n, 0);
  MUST(pnpbs_placement_get_nodes(p, 0, NULL, NULL, NULL, NULL));
  MUST(pnpbs_placement_warning_count(p, &warnings));
  ck_assert_int_eq(warnings, 0);
  n = 7;
  MUST(pnpbs_placement_get_boundary_edges(p, 0, &n, NULL, NULL));
  ck_assert_int_eq(n, 0);
  ck_assert_int_eq(integer_of(p, "nodes"), 0);
  ck_assert_int_eq(integer_of(p, "boundary_nodes"), 0);
  ck_assert_int_eq(integer_of(p, "steps"), 0);
  ck_assert_double_eq(real_of(p, "speed.largest"), 0);
  MUST(pnpbs_placement_get_string(p, "stop_reason", &text));
  ck_assert_str_eq(text, "none");
  ck_assert_str_eq(hash_of(p).text, "0000000000000000");
  MUST_FAIL(PNPBS_ERROR_STATE, pnpbs_placement_adjacency_size(p, &size), "no nodes", "");
  MUST_FAIL(PNPBS_ERROR_STATE, pnpbs_placement_star_size(p, &size), "no nodes", "");
  MUST_FAIL(PNPBS_ERROR_STATE, pnpbs_placement_get_triangles(p, 0, &size, NULL), "no nodes", "");
  MUST_FAIL(PNPBS_ERROR_STATE, pnpbs_placement_get_edges(p, 0, &size, NULL, NULL, NULL, NULL),
            "no nodes", "");
  ck_assert_int_eq(size, 7);
  MUST_FAIL(PNPBS_ERROR_STATE, pnpbs_placement_check(p), "no nodes", "");
  MUST_FAIL(PNPBS_ERROR_STATE, pnpbs_placement_get_double(p, "d_error.mean", &(double){0}),
            "no nodes", "");
  MUST_FAIL(PNPBS_ERROR_STATE, pnpbs_placement_initialise(p), "set_spacing", "");
  MUST_FAIL(PNPBS_ERROR_STATE, pnpbs_placement_step(p, 1), "set_spacing", "");
  MUST_FAIL(PNPBS_ERROR_STATE, pnpbs_placement_run(p), "set_spacing", "");
  MUST_FAIL(PNPBS_ERROR_STATE, pnpbs_placement_adjust_population(p, NULL, NULL), "set_spacing", "");
  MUST_FAIL(PNPBS_ERROR_STATE, pnpbs_placement_rebalance(p), "set_spacing", "");
  MUST(pnpbs_placement_set_spacing_constant(p, 0.2));
  MUST_COMPUTE(pnpbs_placement_run(p));
  check_placement(p, 1);
  job_end(&empty);
}
END_TEST

START_TEST(domains_that_are_none) {
  job bad = job_begin();
  double low[2] = {7, 7}, area = 7;
  const double open[6] = {0, 0, 1, 0, 1, 1}, tie[8] = {0, 0, 1, 1, 1, 0, 0, 1};
  MUST_FAIL(PNPBS_ERROR_DOMAIN, pnpbs_domain_check(bad.domain), "no curves", "");
  MUST_BE(PNPBS_ERROR_DOMAIN, pnpbs_domain_bounds(bad.domain, low, low));
  MUST_BE(PNPBS_ERROR_DOMAIN, pnpbs_domain_measure(bad.domain, &area));
  ck_assert_double_eq(low[0], 7);
  ck_assert_double_eq(area, 7);
  job_place(&bad);
  MUST(pnpbs_placement_set_spacing_constant(bad.placement, 0.2));
  MUST_BE(PNPBS_ERROR_DOMAIN, pnpbs_placement_run(bad.placement));
  MUST(pnpbs_domain_add_polyline(bad.domain, PNPBS_BOUNDARY, 0, 3, open, NULL, 0));
  MUST_FAIL(PNPBS_ERROR_DOMAIN, pnpbs_placement_run(bad.placement), "not closed", "(0, 0)");
  job_end(&bad);

  bad = job_begin();
  MUST(pnpbs_domain_add_polyline(bad.domain, PNPBS_BOUNDARY, 1, 4, tie, NULL, 0));
  MUST_FAIL(PNPBS_ERROR_DOMAIN, pnpbs_domain_check(bad.domain), "cross", "(0.5, 0.5)");
  job_place(&bad);
  MUST(pnpbs_placement_set_spacing_constant(bad.placement, 0.2));
  MUST_FAIL(PNPBS_ERROR_DOMAIN, pnpbs_placement_initialise(bad.placement), "cross", "(0.5, 0.5)");
  ck_assert_int_eq(integer_of(bad.placement, "nodes"), 0);
  job_end(&bad);
}
END_TEST

/* Each context keeps its own message. */
START_TEST(last_errors) {
  job one = square_job(1), other = square_job(1);
  char first[200];
  ck_assert_str_eq(pnpbs_last_error(one.context), "");
  MUST_BE(PNPBS_ERROR_KEY, pnpbs_context_set(one.context, "stpes", "1"));
  ck_assert_str_eq(pnpbs_last_error(other.context), "");
  snprintf(first, sizeof first, "%s", pnpbs_last_error(one.context));
  MUST_BE(PNPBS_ERROR_SPACING, pnpbs_placement_set_spacing_constant(other.placement, -1));
  ck_assert_str_eq(pnpbs_last_error(one.context), first);
  ck_assert_ptr_nonnull(strstr(pnpbs_last_error(other.context), "d = -1"));
  ck_assert_str_eq(pnpbs_last_error(NULL), pnpbs_last_error(other.context));
  /* A successful call does not clear the message. */
  MUST(pnpbs_placement_set_spacing_constant(other.placement, 1));
  ck_assert_ptr_nonnull(strstr(pnpbs_last_error(other.context), "d = -1"));
  job_end(&one);
  job_end(&other);
}
END_TEST

/* ---------------------------------------------------------------- the rest -------------- */

START_TEST(status_strings) {
#define CHECK_STATUS(name, value, text)              \
  ck_assert_int_eq(name, value);                     \
  ck_assert_str_eq(pnpbs_status_string(name), text); \
  ck_assert_str_ne(pnpbs_status_string(name), "");
  PNPBS_STATUS_LIST(CHECK_STATUS)
#undef CHECK_STATUS
  ck_assert_ptr_nonnull(pnpbs_status_string((pnpbs_status)7));
  ck_assert_ptr_nonnull(pnpbs_status_string((pnpbs_status)-100));
}
END_TEST

START_TEST(versions) {
  int32_t major = -1, minor = -1, patch = -1;
  char text[40];
  const char* name = NULL;
  MUST(pnpbs_version(&major, &minor, &patch));
  MUST(pnpbs_version(NULL, NULL, NULL));
  snprintf(text, sizeof text, "%d.%d.%d", (int)major, (int)minor, (int)patch);
  ck_assert_str_eq(text, PNPBS_VERSION_STRING);
  snprintf(text, sizeof text, "%d.%d.%d", PNPBS_VERSION_MAJOR, PNPBS_VERSION_MINOR,
           PNPBS_VERSION_PATCH);
  ck_assert_str_eq(text, PNPBS_VERSION_STRING);
  MUST(pnpbs_placement_get_string(it.placement, "version", &name));
  ck_assert_str_eq(name, PNPBS_VERSION_STRING);
  ck_assert_ptr_nonnull(strstr(pnpbs_build_info(), "version: " PNPBS_VERSION_STRING "\n"));
  ck_assert_ptr_nonnull(strstr(pnpbs_build_info(), "Kokkos: "));
  ck_assert_ptr_nonnull(strstr(pnpbs_build_info(), "MPI: "));
  ck_assert_ptr_nonnull(strstr(pnpbs_build_info(), "HDF5: "));
  ck_assert_ptr_nonnull(pnpbs_mpi_library());
}
END_TEST

/* MPI is not initialised here, so no communicator can be converted. */
START_TEST(no_mpi) {
  pnpbs_context context = (pnpbs_context)(void*)&context;
  const pnpbs_status expected =
      pnpbs_mpi_library()[0] != '\0' ? PNPBS_ERROR_MPI : PNPBS_ERROR_UNSUPPORTED;
  MUST_FAIL(expected, pnpbs_context_create_f(0, &context), "MPI", "");
  ck_assert_ptr_null(context);
  MUST_FAIL(expected, pnpbs_context_create_checked_f(0, "MPICH Version: 1.0", &context), "MPI", "");
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_context_create_checked_f(0, NULL, &context), "library",
            "NULL");
  ck_assert_ptr_null(context);
}
END_TEST

TEST_SUITE(test_arguments) {
  Suite* suite = suite_create("arguments");
  TCase* cases = tcase_create("arguments");
  tcase_add_checked_fixture(cases, set_up, tear_down);
  tcase_add_test(cases, no_context);
  tcase_add_test(cases, options);
  tcase_add_test(cases, creating);
  tcase_add_test(cases, polylines);
  tcase_add_test(cases, arcs);
  tcase_add_test(cases, curves);
  tcase_add_test(cases, graphs);
  tcase_add_test(cases, points_and_files);
  tcase_add_test(cases, segments_of_the_domain);
  tcase_add_test(cases, spacings);
  tcase_add_test(cases, spacings_from_fields);
  tcase_add_test(cases, spacings_from_fields);
  tcase_add_test(cases, given_nodes);
  tcase_add_test(cases, computing);
  tcase_add_test(cases, getting_nodes);
  tcase_add_test(cases, getting_neighbours);
  tcase_add_test(cases, edges);
  tcase_add_test(cases, statistics_and_warnings);
  tcase_add_test(cases, nothing_yet);
  tcase_add_test(cases, domains_that_are_none);
  tcase_add_test(cases, last_errors);
  tcase_add_test(cases, status_strings);
  tcase_add_test(cases, versions);
  tcase_add_test(cases, no_mpi);
  suite_add_tcase(suite, cases);
  return run_suite(suite);
}
