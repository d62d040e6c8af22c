/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests callbacks: their arguments, errors and invalid values, a monitor that stops, and the calls
 * that are allowed inside a callback.
 */
#include "api_support.h"

/* ---------------------------------------------------------------- spacing callbacks ----- */

typedef struct {
  double d, growth;    /* returned value is d (1 + growth x), except */
  double bad;          /* for this value, */
  int32_t answer;      /* with this return value, */
  int64_t bad_from;    /* from this call on, counted from 0, */
  double x, y, radius; /* everywhere if the radius is 0, else near this point */
  int64_t calls, points;
  int64_t longest; /* largest number of points in a call */
  int32_t dim;
} probe;

static probe good_probe(double d) {
  probe it;
  memset(&it, 0, sizeof it);
  it.d = it.bad = d;
  it.bad_from = INT64_MAX;
  return it;
}

static int32_t probing_spacing(int64_t n, int32_t dim, const double* xyz, double* d, void* user) {
  probe* it = user;
  const int is_bad = it->calls >= it->bad_from;
  int64_t i;
  for (i = 0; i < n; ++i) {
    const int is_near =
        it->radius == 0 || hypot(xyz[2 * i] - it->x, xyz[2 * i + 1] - it->y) < it->radius;
    d[i] = is_bad && is_near ? it->bad : it->d * (1 + it->growth * xyz[2 * i]);
  }
  ++it->calls;
  it->points += n;
  it->dim = dim;
  if (n > it->longest) it->longest = n;
  return is_bad ? it->answer : 0;
}

static job probed_square(probe* it) {
  job square = square_job(1);
  MUST(pnpbs_placement_set(square.placement, "steps", "45"));
  MUST(pnpbs_placement_set_spacing_callback(square.placement, probing_spacing, it));
  return square;
}

/* A spot of radius 0.002 with d = 0.0005 in the middle of a square where d = 0.1 elsewhere. */
static int32_t spot_in_square(int64_t n, int32_t dim, const double* xy, double* d, void* user) {
  int64_t i;
  (void)dim;
  (void)user;
  for (i = 0; i < n; ++i)
    d[i] = hypot(xy[2 * i] - 0.4137, xy[2 * i + 1] - 0.5519) < 0.002 ? 0.0005 : 0.1;
  return 0;
}

static int64_t nodes_in_spot(pnpbs_placement placement) {
  result nodes = result_of(placement);
  int64_t i, found = 0;
  for (i = 0; i < nodes.n; ++i)
    found += hypot(nodes.xy[2 * i] - 0.4137, nodes.xy[2 * i + 1] - 0.5519) < 0.002;
  result_free(&nodes);
  return found;
}

/* The spot is narrower than the distance of the samples of d: without a hint no node is in it, with
 * one it is filled. */
START_TEST(hints_show_a_spot_between_the_samples) {
  static const double hint[2] = {0.4141, 0.5517};
  job it = square_job(1);
  ck_assert_int_eq(pnpbs_placement_add_spacing_hints(it.placement, 1, hint), PNPBS_ERROR_STATE);
  MUST(pnpbs_placement_set_spacing_callback(it.placement, spot_in_square, NULL));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  ck_assert_int_eq(nodes_in_spot(it.placement), 0);
  ck_assert_int_eq(pnpbs_placement_add_spacing_hints(it.placement, -1, hint), PNPBS_ERROR_ARGUMENT);
  ck_assert_int_eq(pnpbs_placement_add_spacing_hints(it.placement, 1, NULL), PNPBS_ERROR_ARGUMENT);
  MUST(pnpbs_placement_add_spacing_hints(it.placement, 0, NULL));
  MUST(pnpbs_placement_add_spacing_hints(it.placement, 1, hint));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  ck_assert_int_gt(nodes_in_spot(it.placement), 30); /* pi r^2 / (0.866 d^2) = 58 */
  check_placement(it.placement, 1);
  job_end(&it);
}
END_TEST

static void check_good(pnpbs_placement placement) { check_placement(placement, 1); }

START_TEST(a_good_one) {
  probe asked = good_probe(0.1);
  job it = probed_square(&asked), plain = square_job(1);
  int64_t calls, entries;
  result nodes;
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  ck_assert_int_gt(asked.calls, 0);
  ck_assert_int_gt(asked.points, 100);
  ck_assert_int_gt(asked.longest, 10); /* called with batches of points */
  ck_assert_int_eq(asked.dim, 2);
  /* Copying results does not evaluate the spacing. */
  calls = asked.calls;
  nodes = result_of(it.placement);
  MUST(pnpbs_placement_adjacency_size(it.placement, &entries));
  real_of(it.placement, "d_error.mean");
  ck_assert_int_eq(asked.calls, calls);
  result_free(&nodes);
  /* A callback that returns a constant gives the nodes of that constant. */
  MUST(pnpbs_placement_set(plain.placement, "steps", "45"));
  MUST(pnpbs_placement_set_spacing_constant(plain.placement, 0.1));
  MUST_COMPUTE(pnpbs_placement_run(plain.placement));
  ck_assert_str_eq(hash_of(it.placement).text, hash_of(plain.placement).text);
  job_end(&plain);
  job_end(&it);
}
END_TEST

/* Invalid values, and two parts of the message about each. */
static const struct {
  double value;
  const char* words[2];
} bad_values[] = {
    {0, {"d = 0", "nodes"}},           {-0.0, {"d = -0", "nodes"}},
    {-1, {"d = -1", "nodes"}},         {NAN, {"nan", "not finite"}},
    {HUGE_VAL, {"inf", "not finite"}}, {-HUGE_VAL, {"inf", "not finite"}},
    {1e-30, {"d = 1e-30", "nodes"}},   {1e-308, {"1e-308", "nodes"}},
    {5e-324, {"5e-324", "nodes"}},     {1e-9, {"1e-09", "nodes"}},
};

/* Reads the point that the message names as "... at (x, y) ...". */
static void read_point(double* x, double* y) {
  const char* at = strstr(MESSAGE(), " at (");
  ck_assert_msg(at != NULL && sscanf(at, " at (%lf, %lf)", x, y) == 2, "no point in \"%s\"",
                MESSAGE());
}

START_TEST(bad_everywhere) {
  probe asked = good_probe(0.1);
  job it;
  double x, y;
  asked.bad = bad_values[_i].value;
  asked.bad_from = 0;
  it = probed_square(&asked);
  MUST_FAIL(PNPBS_ERROR_SPACING, pnpbs_placement_run(it.placement), bad_values[_i].words[0],
            bad_values[_i].words[1]);
  read_point(&x, &y);
  ck_assert(x >= 0 && x <= 1 && y >= 0 && y <= 1);
  ck_assert_int_eq(integer_of(it.placement, "nodes"), 0);
  asked.bad_from = INT64_MAX;
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  check_good(it.placement);
  job_end(&it);
}
END_TEST

START_TEST(bad_in_one_place) {
  probe asked = good_probe(0.05);
  job it;
  double x, y;
  asked.bad = bad_values[_i].value;
  asked.bad_from = 0;
  asked.x = 0.7, asked.y = 0.3, asked.radius = 0.1;
  it = probed_square(&asked);
  MUST_FAIL(PNPBS_ERROR_SPACING, pnpbs_placement_run(it.placement), bad_values[_i].words[0],
            bad_values[_i].words[1]);
  read_point(&x, &y);
  ck_assert_msg(hypot(x - 0.7, y - 0.3) <= 0.1, "%s", MESSAGE());
  job_end(&it);
}
END_TEST

/* Makes the callback fail at call number k, for every k, with an error or an invalid value.
 * Afterwards the placement must be as before the call, and must continue once the callback
 * succeeds. */
static void fail_at_every_call(double bad, int32_t answer, pnpbs_status expected, int by_steps) {
  int64_t k, failures = 0;
  for (k = 0;; ++k) {
    probe asked = good_probe(0.13);
    job it;
    pnpbs_status status;
    int64_t nodes;
    asked.bad = bad;
    asked.answer = answer;
    asked.bad_from = k;
    it = probed_square(&asked);
    status = by_steps ? pnpbs_placement_step(it.placement, 45) : pnpbs_placement_run(it.placement);
    if (status >= 0) {
      ck_assert_int_le(asked.calls, k);
      job_end(&it);
      break;
    }
    ++failures;
    ck_assert_msg(status == expected, "call %d: status %d; %s", (int)k, (int)status, MESSAGE());
    nodes = integer_of(it.placement, "nodes");
    if (nodes > 0) check_good(it.placement);
    asked.bad_from = INT64_MAX;
    MUST_COMPUTE(pnpbs_placement_run(it.placement));
    check_good(it.placement);
    job_end(&it);
  }
  ck_assert_int_gt(failures, 5);
}

START_TEST(answers_with_an_error) { fail_at_every_call(0.13, 5, PNPBS_ERROR_CALLBACK, 0); }
END_TEST
START_TEST(answers_with_an_error_and_nonsense) {
  fail_at_every_call(NAN, -3, PNPBS_ERROR_CALLBACK, 0);
}
END_TEST
START_TEST(answers_with_nan) { fail_at_every_call(NAN, 0, PNPBS_ERROR_SPACING, 0); }
END_TEST
START_TEST(answers_with_nothing_but_zeros) { fail_at_every_call(0, 0, PNPBS_ERROR_SPACING, 1); }
END_TEST

/* Runs, then initialises with a failure at call number k (none if k < 0), and then makes steps.
 * Returns whether the call failed. */
static int steps_after_failure(int64_t k, hash_text* hash) {
  probe asked = good_probe(0.012);
  job it;
  pnpbs_status status = 0;
  asked.growth = 2;
  it = probed_square(&asked);
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  ck_assert_int_gt(integer_of(it.placement, "levels"), 0);
  if (k >= 0) {
    asked.answer = 5;
    asked.bad_from = asked.calls + k;
    status = pnpbs_placement_initialise(it.placement);
    asked.bad_from = INT64_MAX;
  }
  if (k < 0 || status < 0) MUST_COMPUTE(pnpbs_placement_step(it.placement, 25));
  *hash = hash_of(it.placement);
  job_end(&it);
  return status < 0;
}

/* A failed initialise leaves everything as it was, wherever it fails, also on coarser levels. */
START_TEST(a_failed_initialise_leaves_all_as_it_was) {
  hash_text expected, hash;
  int64_t k = 0;
  steps_after_failure(-1, &expected);
  while (steps_after_failure(k, &hash)) {
    ck_assert_msg(strcmp(hash.text, expected.text) == 0, "other nodes after call %d", (int)k);
    k += 1 + k / 4;
  }
  ck_assert_int_gt(k, 10);
}
END_TEST

START_TEST(the_error_is_passed_on) {
  probe asked = good_probe(0.1);
  job it;
  asked.answer = 1234;
  asked.bad_from = 0;
  it = probed_square(&asked);
  MUST_FAIL(PNPBS_ERROR_CALLBACK, pnpbs_placement_initialise(it.placement), "spacing", "1234");
  MUST_FAIL(PNPBS_ERROR_CALLBACK, pnpbs_placement_step(it.placement, 1), "spacing", "1234");
  MUST_FAIL(PNPBS_ERROR_CALLBACK, pnpbs_placement_adjust_population(it.placement, NULL, NULL),
            "spacing", "1234");
  asked.answer = INT32_MIN;
  MUST_FAIL(PNPBS_ERROR_CALLBACK, pnpbs_placement_run(it.placement), "spacing", "-2147483648");
  job_end(&it);
}
END_TEST

/* An error leaves the nodes of a live placement as they were, for every call. */
START_TEST(a_failure_on_a_live_placement) {
  probe asked = good_probe(0.1), bad = good_probe(0.1);
  job it = probed_square(&asked);
  hash_text before;
  bad.answer = 9;
  bad.bad_from = 0;
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  before = hash_of(it.placement);
  MUST(pnpbs_placement_set_spacing_callback(it.placement, probing_spacing, &bad));
  if (_i == 0) MUST_BE(PNPBS_ERROR_CALLBACK, pnpbs_placement_run(it.placement));
  if (_i == 1) MUST_BE(PNPBS_ERROR_CALLBACK, pnpbs_placement_step(it.placement, 5));
  if (_i == 2) MUST_BE(PNPBS_ERROR_CALLBACK, pnpbs_placement_initialise(it.placement));
  if (_i == 3) {
    MUST_BE(PNPBS_ERROR_CALLBACK, pnpbs_placement_adjust_population(it.placement, NULL, NULL));
  }
  ck_assert_str_eq(hash_of(it.placement).text, before.text);
  check_good(it.placement);
  bad.bad_from = INT64_MAX;
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  check_good(it.placement);
  job_end(&it);
}
END_TEST

/* ---------------------------------------------------------------- points of evaluation -- */

typedef struct {
  double d;
  double (*outside)(double x, double y); /* distance from the domain, negative inside */
  double farthest;
  int64_t points, strangers;
} watcher;

static int32_t watching_spacing(int64_t n, int32_t dim, const double* xyz, double* d, void* user) {
  watcher* it = user;
  int64_t i;
  (void)dim;
  for (i = 0; i < n; ++i) {
    const double far_out = it->outside(xyz[2 * i], xyz[2 * i + 1]);
    d[i] = it->d;
    it->farthest = fmax(it->farthest, far_out);
    it->strangers += far_out > 1e-12;
  }
  it->points += n;
  return 0;
}

static double outside_disc(double x, double y) { return hypot(x, y) - 1; }
static double outside_ell(double x, double y) {
  const double box = fmax(fmax(-x, x - 1), fmax(-y, y - 1));
  return fmax(box, fmin(x - 0.5, y - 0.5));
}
static double outside_ring(double x, double y) { return fmax(hypot(x, y) - 1, 0.5 - hypot(x, y)); }

START_TEST(asked_inside_a_disc) {
  watcher seen = {0.07, outside_disc, -1, 0, 0};
  job it = job_begin();
  add_circle(it.domain, PNPBS_BOUNDARY, 0, 0, 1, 1);
  job_place(&it);
  MUST(pnpbs_placement_set_spacing_callback(it.placement, watching_spacing, &seen));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  MUST(pnpbs_placement_adjust_population(it.placement, NULL, NULL));
  ck_assert_int_gt(seen.points, 1000);
  ck_assert_msg(seen.strangers == 0, "%lld points outside, up to %g", (long long)seen.strangers,
                seen.farthest);
  ck_assert_msg(fabs(seen.farthest) < 1e-12, "the boundary itself was not asked");
  job_end(&it);
}
END_TEST

START_TEST(asked_inside_an_ell) {
  const double xy[12] = {0, 0, 1, 0, 1, 0.5, 0.5, 0.5, 0.5, 1, 0, 1};
  watcher seen = {0.05, outside_ell, -1, 0, 0};
  job it = job_begin();
  MUST(pnpbs_domain_add_polyline(it.domain, PNPBS_BOUNDARY, 1, 6, xy, NULL, 0));
  job_place(&it);
  MUST(pnpbs_placement_set(it.placement, "growth_limit", "0.1"));
  MUST(pnpbs_placement_set_spacing_callback(it.placement, watching_spacing, &seen));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  ck_assert_int_gt(seen.points, 1000);
  ck_assert_msg(seen.strangers == 0, "%lld points outside, up to %g", (long long)seen.strangers,
                seen.farthest);
  job_end(&it);
}
END_TEST

/* The spacing may be evaluated on boundary edges of a hole. These are chords that lie outside the
 * domain by at most d^2 / 8 R. */
START_TEST(asked_inside_a_ring) {
  watcher seen = {0.07, outside_ring, -1, 0, 0};
  job it = job_begin();
  add_circle(it.domain, PNPBS_BOUNDARY, 0, 0, 1, 1);
  add_circle(it.domain, PNPBS_BOUNDARY, 0, 0, 0.5, 2);
  job_place(&it);
  MUST(pnpbs_placement_set_spacing_callback(it.placement, watching_spacing, &seen));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  ck_assert_msg(seen.farthest <= 1.05 * 0.07 * 0.07 / (8 * 0.5), "%lld points outside, up to %g",
                (long long)seen.strangers, seen.farthest);
  job_end(&it);
}
END_TEST

/* ---------------------------------------------------------------- the monitor ----------- */

typedef struct {
  pnpbs_placement placement;
  int calls, stop_at; /* stops from this call on, counted from 0 */
  double last_fraction;
  int64_t last_step;
} monitor;

static int32_t watching_monitor(double fraction, int64_t step, int64_t nodes, double max_speed,
                                void* user) {
  monitor* it = user;
  ck_assert_msg(fraction >= it->last_fraction && fraction <= 1, "the fraction went from %g to %g",
                it->last_fraction, fraction);
  ck_assert_int_ge(step, it->last_step);
  ck_assert(isfinite(max_speed) && max_speed >= 0);
  ck_assert_int_eq(nodes, integer_of(it->placement, "nodes"));
  ck_assert_int_eq(step, integer_of(it->placement, "steps"));
  it->last_fraction = fraction;
  it->last_step = step;
  return it->calls++ >= it->stop_at ? 1 : 0;
}

static job watched_square(monitor* watch) {
  job it = square_job(1);
  memset(watch, 0, sizeof *watch);
  watch->placement = it.placement;
  watch->stop_at = 1000000;
  MUST(pnpbs_placement_set(it.placement, "tolerance_mean", "0"));
  MUST(pnpbs_placement_set(it.placement, "steps", "100"));
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.1));
  MUST(pnpbs_placement_set_monitor(it.placement, watching_monitor, watch));
  return it;
}

START_TEST(it_is_told_to_the_end) {
  monitor watch;
  job it = watched_square(&watch);
  MUST_BE(PNPBS_NOT_CONVERGED, pnpbs_placement_run(it.placement));
  ck_assert_int_ge(watch.calls, 5);
  ck_assert_double_eq(watch.last_fraction, 1);
  ck_assert_int_eq(watch.last_step, integer_of(it.placement, "steps"));
  watch.last_fraction = 0;
  watch.calls = 0;
  MUST_BE(PNPBS_NOT_CONVERGED, pnpbs_placement_step(it.placement, 60));
  ck_assert_int_ge(watch.calls, 3);
  ck_assert_double_eq(watch.last_fraction, 1);
  /* A monitor can be removed. */
  watch.calls = 0;
  MUST(pnpbs_placement_set_monitor(it.placement, NULL, NULL));
  MUST_BE(PNPBS_NOT_CONVERGED, pnpbs_placement_run(it.placement));
  ck_assert_int_eq(watch.calls, 0);
  job_end(&it);
}
END_TEST

static int32_t monitor_of_the_fill(double fraction, int64_t step, int64_t nodes, double max_speed,
                                   void* user) {
  int* calls = user;
  (void)max_speed;
  if (nodes > 0) return 1;
  ck_assert(fraction == 0 && step == 0);
  ++*calls;
  return 1;
}

/* The monitor can stop the fill of millions of nodes, long before the first step. */
START_TEST(it_stops_the_first_nodes) {
  job it = square_job(1);
  int64_t nodes = -1;
  const char* text = NULL;
  int calls = 0;
  MUST(pnpbs_placement_set(it.placement, "max_memory", "0"));
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.0003));
  MUST(pnpbs_placement_set_monitor(it.placement, monitor_of_the_fill, &calls));
  MUST_BE(PNPBS_STOPPED, pnpbs_placement_run(it.placement));
  ck_assert_int_eq(calls, 1);
  MUST(pnpbs_placement_count(it.placement, &nodes));
  ck_assert_int_eq(nodes, 0);
  MUST(pnpbs_placement_get_string(it.placement, "stop_reason", &text));
  ck_assert_str_eq(text, "monitor");
  /* The placement can be used afterwards. */
  MUST(pnpbs_placement_set_monitor(it.placement, NULL, NULL));
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.1));
  ck_assert_int_ge(pnpbs_placement_run(it.placement), 0);
  check_good(it.placement);
  job_end(&it);
}
END_TEST

/* The monitor can also stop a run between events that are far apart. */
START_TEST(it_stops_between_events) {
  monitor watch;
  job it = watched_square(&watch);
  MUST(pnpbs_placement_set(it.placement, "steps", "1000000000"));
  MUST(pnpbs_placement_set(it.placement, "event_interval", "1000000"));
  watch.stop_at = 1;
  MUST_BE(PNPBS_STOPPED, pnpbs_placement_run(it.placement));
  ck_assert_int_eq(watch.calls, 2);
  ck_assert_int_gt(watch.last_step, 0);
  check_good(it.placement);
  job_end(&it);
}
END_TEST

START_TEST(it_stops) {
  monitor watch;
  job it = watched_square(&watch);
  const char* text = NULL;
  int64_t steps;
  watch.stop_at = _i;
  MUST_BE(PNPBS_STOPPED, pnpbs_placement_run(it.placement));
  ck_assert_int_eq(watch.calls, _i + 1);
  steps = integer_of(it.placement, "steps");
  ck_assert_int_gt(steps, 0);
  ck_assert_int_lt(steps, 100 + (_i == 4));
  MUST(pnpbs_placement_get_string(it.placement, "stop_reason", &text));
  ck_assert_str_eq(text, "monitor");
  check_good(it.placement);
  /* The next run continues to the end. */
  watch.stop_at = 1000000;
  watch.last_fraction = 0;
  MUST_BE(PNPBS_NOT_CONVERGED, pnpbs_placement_run(it.placement));
  ck_assert_int_eq(integer_of(it.placement, "steps"), steps + 100);
  check_good(it.placement);
  /* Steps can be stopped as well. */
  watch.stop_at = 0;
  watch.last_fraction = 0;
  MUST_BE(PNPBS_STOPPED, pnpbs_placement_step(it.placement, 1000));
  check_good(it.placement);
  job_end(&it);
}
END_TEST

/* ---------------------------------------------------------------- calls from inside ----- */

static job inside; /* the job whose callback runs */
static int times_inside, quiet;
static int64_t batches_inside;

static int32_t small_curve(int64_t n, int32_t dim, const double* t, double* xy, void* user) {
  (void)dim;
  int64_t i;
  (void)user;
  for (i = 0; i < n; ++i) xy[2 * i] = 0.3 + 0.1 * cos(t[i]), xy[2 * i + 1] = 0.3 + 0.1 * sin(t[i]);
  return 0;
}

static int32_t no_stop(double fraction, int64_t step, int64_t nodes, double speed, void* user) {
  (void)fraction, (void)step, (void)nodes, (void)speed, (void)user;
  return 0;
}

/* Tries all calls that change, compute or destroy. None is allowed inside a callback. */
static void try_what_is_not_allowed(void) {
  static const double xy[8] = {0.4, 0.4, 0.6, 0.4, 0.6, 0.6, 0.4, 0.6};
  static const int64_t ends[8] = {0, 1, 1, 2, 2, 3, 3, 0}, size[2] = {1, 1};
  pnpbs_context c = inside.context;
  pnpbs_domain d = inside.domain, new_domain = NULL;
  pnpbs_placement p = inside.placement, new_placement = NULL;
  int64_t offsets[500], entries = -1;
  double real = NAN;
  pnpbs_transfer transfer = NULL;
#define REFUSED(call) MUST_FAIL(PNPBS_ERROR_STATE, call, "callback", "")
  REFUSED(pnpbs_finalize());
  REFUSED(pnpbs_context_set(c, "steps", "10"));
  REFUSED(pnpbs_context_set_int64(c, "steps", 10));
  REFUSED(pnpbs_context_set_double(c, "damping", 1));
  REFUSED(pnpbs_domain_create(c, 2, &new_domain));
  REFUSED(pnpbs_domain_add_polyline(d, PNPBS_BOUNDARY, 1, 4, xy, NULL, 0));
  REFUSED(pnpbs_domain_add_arc(d, PNPBS_INNER, xy, 0.1, 0, 1, 1));
  REFUSED(pnpbs_domain_add_curve(d, PNPBS_INNER, small_curve, NULL, 0, 1, 1));
  REFUSED(pnpbs_domain_add_pslg(d, 4, xy, NULL, 4, ends, NULL, 0, NULL));
  REFUSED(pnpbs_domain_add_hole(d, xy));
  REFUSED(pnpbs_domain_add_fixed_nodes(d, 1, xy, NULL));
  REFUSED(pnpbs_domain_read_poly(d, PNPBS_SOURCE_DIR "/examples/data/lake_victoria.poly"));
  REFUSED(pnpbs_domain_parse_poly(d, "0", 1, "text"));
  REFUSED(pnpbs_domain_destroy(&inside.domain));
  REFUSED(pnpbs_context_destroy(&inside.context));
  if (p == NULL) { /* while the domain is being built, since a check would evaluate its curves */
    REFUSED(pnpbs_domain_check(d));
    return;
  }
  REFUSED(pnpbs_placement_create(c, d, &new_placement));
  REFUSED(pnpbs_placement_set(p, "steps", "10"));
  REFUSED(pnpbs_placement_set_int64(p, "steps", 10));
  REFUSED(pnpbs_placement_set_double(p, "damping", 1));
  REFUSED(pnpbs_placement_set_spacing_constant(p, 1));
  REFUSED(pnpbs_placement_set_spacing_callback(p, cone_spacing, NULL));
  REFUSED(pnpbs_placement_set_spacing_grid(p, size, xy, xy, xy));
  REFUSED(pnpbs_placement_set_spacing_mesh(p, 4, xy, xy, 1, ends));
  REFUSED(pnpbs_placement_set_spacing_points(p, 1, xy, xy));
  REFUSED(pnpbs_placement_set_spacing_file(p, "unread.csv", NULL));
  REFUSED(pnpbs_placement_set_spacing_at_nodes(p, 1, xy));
  REFUSED(pnpbs_placement_set_monitor(p, no_stop, NULL));
  REFUSED(pnpbs_placement_set_nodes(p, 1, xy, NULL));
  REFUSED(pnpbs_placement_initialise(p));
  REFUSED(pnpbs_placement_step(p, 1));
  REFUSED(pnpbs_placement_adjust_population(p, NULL, NULL));
  REFUSED(pnpbs_placement_rebalance(p));
  REFUSED(pnpbs_placement_run(p));
  REFUSED(pnpbs_placement_adjacency_size(p, &entries));
  REFUSED(pnpbs_placement_get_adjacency(p, 500, offsets, offsets));
  REFUSED(pnpbs_placement_star_size(p, &entries));
  REFUSED(pnpbs_placement_get_stars(p, 500, offsets, offsets, NULL));
  REFUSED(pnpbs_placement_get_triangles(p, 0, &entries, NULL));
  REFUSED(pnpbs_placement_check(p));
  REFUSED(pnpbs_placement_ghost_count(p, &entries));
  REFUSED(pnpbs_placement_get_ghosts(p, 0, NULL, NULL, NULL, NULL, NULL));
  REFUSED(pnpbs_placement_exchange_sizes(p, NULL, NULL, &entries));
  REFUSED(pnpbs_placement_get_exchange(p, 0, 0, 0, NULL, NULL, NULL, NULL, NULL));
  REFUSED(pnpbs_placement_get_numbering(p, 0, &entries, NULL, NULL));
  REFUSED(pnpbs_placement_update_ghosts(p, 1, 1, &real));
  REFUSED(pnpbs_placement_begin_update_ghosts(p, 1, 1, xy));
  REFUSED(pnpbs_placement_end_update_ghosts(p, 1, 1, &real));
  REFUSED(pnpbs_placement_sum(p, 1, 1, xy, &real));
  REFUSED(pnpbs_placement_dot(p, 1, 1, xy, xy, &real));
  REFUSED(pnpbs_transfer_create(p, 1, 1, xy, &transfer));
  REFUSED(pnpbs_transfer_create_second_order(p, 1, 1, xy, &transfer));
  REFUSED(pnpbs_placement_get_double(p, "d_error.mean", &real));
  REFUSED(pnpbs_placement_destroy(&inside.placement));
#undef REFUSED
  ck_assert_ptr_null(new_domain);
  ck_assert_ptr_null(new_placement);
  ck_assert_ptr_null(transfer);
  ck_assert_int_eq(entries, -1);
  ck_assert(isnan(real));
}

/* Tries all queries. Nodes are in the order of their ids, and as many as reported. */
static void try_what_is_allowed(void) {
  int32_t number = 0;
  const char *name = NULL, *text = NULL;
  pnpbs_placement p = inside.placement;
  int64_t n = -1, i;
  double *xy, *d, low[2], high[2];
  int64_t* ids;
  int32_t* tags;
  MUST(pnpbs_version(&number, NULL, NULL));
  ck_assert_ptr_nonnull(pnpbs_build_info());
  ck_assert_ptr_nonnull(pnpbs_mpi_library());
  ck_assert_ptr_nonnull(pnpbs_last_error(inside.context));
  ck_assert_str_eq(pnpbs_status_string(PNPBS_OK), "done");
  MUST(pnpbs_option_count(&number));
  MUST(pnpbs_option_info(0, &name, NULL, NULL, NULL, NULL));
  MUST(pnpbs_statistic_count(&number));
  MUST(pnpbs_statistic_info(0, &name, NULL, NULL));
  if (p == NULL) return;
  MUST(pnpbs_domain_check(inside.domain));
  MUST(pnpbs_domain_bounds(inside.domain, low, high));
  ck_assert_double_eq(high[0], 1);
  MUST(pnpbs_domain_measure(inside.domain, low));
  MUST(pnpbs_domain_get_segments(inside.domain, 0, &n, NULL, NULL));
  MUST(pnpbs_placement_count(p, &n));
  xy = malloc((size_t)(2 * n + 1) * sizeof *xy);
  d = malloc((size_t)(n + 1) * sizeof *d);
  ids = malloc((size_t)(n + 1) * sizeof *ids);
  tags = malloc((size_t)(n + 1) * sizeof *tags);
  MUST(pnpbs_placement_get_nodes(p, n, xy, ids, tags, d));
  for (i = 0; i < n; ++i) {
    ck_assert(i == 0 || ids[i - 1] < ids[i]);
    ck_assert(isfinite(xy[2 * i]) && isfinite(xy[2 * i + 1]));
    ck_assert_msg(d[i] > 0, "d of node %lld is %g", (long long)i, d[i]);
  }
  free(xy);
  free(d);
  free(ids);
  free(tags);
  MUST(pnpbs_placement_get_boundary_edges(p, 0, &i, NULL, NULL));
  ck_assert_int_eq(integer_of(p, "nodes"), n);
  ck_assert_double_ge(real_of(p, "speed.mean"), 0);
  ck_assert_double_ge(real_of(p, "seconds.total"), 0);
  MUST(pnpbs_placement_get_string(p, "version", &text));
  ck_assert_str_eq(text, PNPBS_VERSION_STRING);
  ck_assert_str_ne(hash_of(p).text, "");
  MUST(pnpbs_placement_warning_count(p, &number));
}

static void look_around(void) {
  if (quiet) return;
  ++times_inside;
  try_what_is_not_allowed();
  try_what_is_allowed();
}

static int32_t curious_spacing(int64_t n, int32_t dim, const double* xyz, double* d, void* user) {
  int64_t i;
  (void)dim, (void)xyz, (void)user;
  look_around();
  for (i = 0; i < n; ++i) d[i] = 0.1;
  ++batches_inside;
  return 0;
}

static int32_t curious_monitor(double fraction, int64_t step, int64_t nodes, double max_speed,
                               void* user) {
  (void)fraction, (void)step, (void)nodes, (void)max_speed, (void)user;
  look_around();
  return 0;
}

static int32_t curious_curve(int64_t n, int32_t dim, const double* t, double* xy, void* user) {
  (void)dim;
  look_around();
  return small_curve(n, dim, t, xy, user);
}

/* Queries inside callbacks do not change the result of a run. */
START_TEST(only_questions_from_inside) {
  hash_text with, without;
  int k;
  for (k = 0; k < 2; ++k) {
    quiet = k == 1;
    times_inside = 0;
    inside = square_job(1);
    MUST(pnpbs_placement_set(inside.placement, "steps", "65"));
    MUST(pnpbs_placement_set_spacing_callback(inside.placement, curious_spacing, NULL));
    MUST(pnpbs_placement_set_monitor(inside.placement, curious_monitor, NULL));
    MUST(pnpbs_placement_initialise(inside.placement));
    MUST_COMPUTE(pnpbs_placement_step(inside.placement, 30));
    MUST(pnpbs_placement_adjust_population(inside.placement, NULL, NULL));
    MUST_COMPUTE(pnpbs_placement_run(inside.placement));
    ck_assert_int_eq(times_inside > 10, !quiet);
    check_good(inside.placement);
    if (k == 0) with = hash_of(inside.placement);
    if (k == 1) without = hash_of(inside.placement);
    job_end(&inside);
  }
  ck_assert_str_eq(with.text, without.text);
}
END_TEST

/* Querying nodes inside a callback leaves no stale data behind. */
START_TEST(nodes_after_nodes_from_inside) {
  job plain = square_job(1);
  result asked, not_asked;
  cone slope = {0.06, 0.1, 0, 0};
  int k;
  quiet = 0;
  inside = square_job(1);
  for (k = 0; k < 2; ++k) {
    job* it = k == 0 ? &inside : &plain;
    MUST(pnpbs_placement_set_spacing_callback(it->placement, cone_spacing, &slope));
    if (k == 0) MUST(pnpbs_placement_set_monitor(it->placement, curious_monitor, NULL));
    MUST_COMPUTE(pnpbs_placement_step(it->placement, 39)); /* covers an event and steps after it */
  }
  asked = result_of(inside.placement);
  not_asked = result_of(plain.placement);
  check_result(&asked, 1);
  ck_assert_int_eq(asked.n, not_asked.n);
  ck_assert_mem_eq(asked.ids, not_asked.ids, (size_t)asked.n * sizeof *asked.ids);
  ck_assert_mem_eq(asked.xy, not_asked.xy, 2 * (size_t)asked.n * sizeof *asked.xy);
  ck_assert_mem_eq(asked.tags, not_asked.tags, (size_t)asked.n * sizeof *asked.tags);
  result_free(&asked);
  result_free(&not_asked);
  job_end(&inside);
  job_end(&plain);
}
END_TEST

START_TEST(only_questions_from_inside_a_curve) {
  quiet = 0;
  times_inside = 0;
  inside = job_begin();
  add_rectangle(inside.domain, PNPBS_BOUNDARY, 0, 0, 1, 1, 1);
  MUST(pnpbs_domain_add_curve(inside.domain, PNPBS_INNER, curious_curve, NULL, 0, 2 * PI, 5));
  ck_assert_int_gt(times_inside, 0);
  quiet = 1;
  MUST(pnpbs_domain_check(inside.domain));
  quiet = 0;
  job_place(&inside);
  MUST(pnpbs_placement_set_spacing_constant(inside.placement, 0.1));
  times_inside = 0;
  MUST_COMPUTE(pnpbs_placement_run(inside.placement));
  ck_assert_int_gt(times_inside, 0);
  check_good(inside.placement);
  job_end(&inside);
}
END_TEST

/* A callback may use another context without restriction. */
static int32_t busy_spacing(int64_t n, int32_t dim, const double* xyz, double* d, void* user) {
  (void)dim, (void)xyz;
  if (batches_inside++ == 0) {
    job* other = user;
    MUST(pnpbs_placement_set_spacing_constant(other->placement, 0.2));
    MUST_COMPUTE(pnpbs_placement_run(other->placement));
    check_good(other->placement);
  }
  while (n-- > 0) d[n] = 0.2;
  return 0;
}

START_TEST(another_context_from_inside) {
  job it = square_job(1), other = square_job(1);
  batches_inside = 0;
  MUST(pnpbs_placement_set_spacing_callback(it.placement, busy_spacing, &other));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  ck_assert_int_gt(batches_inside, 1);
  ck_assert_str_eq(hash_of(it.placement).text, hash_of(other.placement).text);
  job_end(&it);
  job_end(&other);
}
END_TEST

/* ---------------------------------------------------------------- curve callbacks ------- */

typedef struct {
  int64_t calls, bad_from;
  int32_t answer;
  double offset;      /* added to the points of a bad call */
  double least, most; /* range of the parameters */
} curve_probe;

static int32_t probing_curve(int64_t n, int32_t dim, const double* t, double* xy, void* user) {
  (void)dim;
  curve_probe* it = user;
  const int is_bad = it->calls >= it->bad_from;
  int64_t i;
  for (i = 0; i < n; ++i) {
    xy[2 * i] = 0.5 + 0.3 * cos(t[i]) + (is_bad ? it->offset : 0);
    xy[2 * i + 1] = 0.5 + 0.2 * sin(t[i]);
    it->least = fmin(it->least, t[i]);
    it->most = fmax(it->most, t[i]);
  }
  ++it->calls;
  return is_bad ? it->answer : 0;
}

START_TEST(curves_fail_at_every_call) {
  int64_t k;
  int failed_adding = 0, failed_later = 0;
  for (k = 0;; ++k) {
    curve_probe asked = {0, 0, 0, 0, 1e9, -1e9};
    job it = job_begin();
    pnpbs_status status;
    double area = 0;
    asked.bad_from = k;
    asked.answer = 77;
    add_rectangle(it.domain, PNPBS_BOUNDARY, 0, 0, 1, 1, 1);
    status = pnpbs_domain_add_curve(it.domain, PNPBS_BOUNDARY, probing_curve, &asked, 0, 2 * PI, 3);
    if (status != PNPBS_OK) {
      /* The domain must be unchanged. */
      ck_assert_int_eq(status, PNPBS_ERROR_CALLBACK);
      ck_assert_ptr_nonnull(strstr(MESSAGE(), "77"));
      MUST(pnpbs_domain_measure(it.domain, &area));
      ck_assert_double_eq(area, 1);
      ++failed_adding;
      job_end(&it);
      continue;
    }
    job_place(&it);
    MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.1));
    status = pnpbs_placement_run(it.placement);
    if (status >= 0) {
      ck_assert_double_eq(asked.least, 0);
      ck_assert_double_eq(asked.most, 2 * PI);
      check_placement(it.placement, 0);
      job_end(&it);
      break;
    }
    ck_assert_int_eq(status, PNPBS_ERROR_CALLBACK);
    ck_assert_ptr_nonnull(strstr(MESSAGE(), "77"));
    ck_assert_int_eq(integer_of(it.placement, "nodes"), 0);
    ++failed_later;
    asked.bad_from = INT64_MAX;
    MUST_COMPUTE(pnpbs_placement_run(it.placement));
    check_placement(it.placement, 0);
    job_end(&it);
  }
  ck_assert_int_gt(failed_adding, 0);
  ck_assert_int_gt(failed_later, 0);
}
END_TEST

/* A curve callback may return invalid points in a later call, after the checks of the first one. */
START_TEST(curves_give_nonsense) {
  int64_t k;
  for (k = 0;; ++k) {
    curve_probe asked = {0, 0, 0, 0, 1e9, -1e9};
    job it = job_begin();
    pnpbs_status status;
    asked.bad_from = k;
    asked.offset = NAN;
    add_rectangle(it.domain, PNPBS_BOUNDARY, 0, 0, 1, 1, 1);
    status = pnpbs_domain_add_curve(it.domain, PNPBS_BOUNDARY, probing_curve, &asked, 0, 2 * PI, 3);
    if (status == PNPBS_OK) {
      job_place(&it);
      MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.1));
      status = pnpbs_placement_run(it.placement);
    }
    job_end(&it);
    if (status >= 0) {
      ck_assert_int_le(asked.calls, k);
      break;
    }
    ck_assert_str_ne(MESSAGE(), "");
    ck_assert_int_ne(status, PNPBS_ERROR_INTERNAL);
  }
  ck_assert_int_gt(k, 2);
}
END_TEST

TEST_SUITE(test_callbacks) {
  Suite* suite = suite_create("callbacks");
  TCase* spacing = tcase_create("spacing");
  TCase* stopping = tcase_create("monitor");
  TCase* within = tcase_create("from inside");
  TCase* curves = tcase_create("curves");
  tcase_add_test(spacing, a_good_one);
  tcase_add_test(spacing, hints_show_a_spot_between_the_samples);
  tcase_add_loop_test(spacing, bad_everywhere, 0, COUNT_OF(bad_values));
  tcase_add_loop_test(spacing, bad_in_one_place, 0, COUNT_OF(bad_values));
  tcase_add_test(spacing, answers_with_an_error);
  tcase_add_test(spacing, answers_with_an_error_and_nonsense);
  tcase_add_test(spacing, answers_with_nan);
  tcase_add_test(spacing, answers_with_nothing_but_zeros);
  tcase_add_test(spacing, a_failed_initialise_leaves_all_as_it_was);
  tcase_add_test(spacing, the_error_is_passed_on);
  tcase_add_loop_test(spacing, a_failure_on_a_live_placement, 0, 4);
  tcase_add_test(spacing, asked_inside_a_disc);
  tcase_add_test(spacing, asked_inside_an_ell);
  tcase_add_test(spacing, asked_inside_a_ring);
  suite_add_tcase(suite, spacing);
  tcase_add_test(stopping, it_is_told_to_the_end);
  tcase_add_test(stopping, it_stops_the_first_nodes);
  tcase_add_test(stopping, it_stops_between_events);
  tcase_add_loop_test(stopping, it_stops, 0, 5);
  suite_add_tcase(suite, stopping);
  tcase_add_test(within, only_questions_from_inside);
  tcase_add_test(within, nodes_after_nodes_from_inside);
  tcase_add_test(within, only_questions_from_inside_a_curve);
  tcase_add_test(within, another_context_from_inside);
  suite_add_tcase(suite, within);
  tcase_add_test(curves, curves_fail_at_every_call);
  tcase_add_test(curves, curves_give_nonsense);
  suite_add_tcase(suite, curves);
  return run_suite(suite);
}
