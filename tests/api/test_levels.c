/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests coarser levels: when they are used, that a monitor can watch and stop them, and that they
 * improve the quality.
 */
#include "api_support.h"

static job graded_square(cone* d) {
  job it = square_job(1);
  MUST(pnpbs_placement_set_spacing_callback(it.placement, cone_spacing, d));
  return it;
}

START_TEST(as_many_as_pay) {
  static cone graded = {0.0048, 0.016, 0.5, 0.5}; /* about 10 000 nodes */
  static cone few = {0.06, 0.2, 0.5, 0.5};
  static cone steep = {0.002, 0.3, 0.5, 0.5};
  static const struct {
    cone* d;
    const char *key, *value;
    int levels;
  } cases[] = {
      {&graded, "levels", "2", 2},     {&graded, "levels", "1", 1}, {&graded, "levels", "0", 0},
      {&graded, "method", "paper", 0}, {&few, "levels", "2", 0},    {&steep, "levels", "2", 0},
      {&graded, "effort", "best", 2},
  };
  int k;
  for (k = 0; k < COUNT_OF(cases); ++k) {
    job it = graded_square(cases[k].d);
    MUST(pnpbs_placement_set(it.placement, cases[k].key, cases[k].value));
    MUST(pnpbs_placement_initialise(it.placement));
    ck_assert_msg(integer_of(it.placement, "levels") == cases[k].levels, "%s=%s: %d levels, not %d",
                  cases[k].key, cases[k].value, (int)integer_of(it.placement, "levels"),
                  cases[k].levels);
    job_end(&it);
  }
}
END_TEST

/* A constant d needs no coarser levels, as one lattice fills the domain. */
START_TEST(none_for_constant_spacing) {
  job it = square_job(1);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.008));
  MUST(pnpbs_placement_initialise(it.placement));
  ck_assert_int_eq(integer_of(it.placement, "levels"), 0);
  ck_assert_int_eq(integer_of(it.placement, "steps"), 0);
  job_end(&it);
}
END_TEST

/* Small holes have their corners on every level. 36 holes of twelve nodes each are few among 2500
 * nodes, but many among 600. */
START_TEST(fewer_where_the_boundary_is_fine) {
  static cone graded = {0.0048, 0.016, 0.5, 0.5};
  enum { ROW = 6, CORNERS = 12 };
  job it = graded_square(&graded);
  int k, c;
  for (k = 0; k < ROW * ROW; ++k) {
    const double x = (k % ROW + 0.5) / ROW, y = (k / ROW + 0.5) / ROW;
    double hole[2 * CORNERS];
    for (c = 0; c < CORNERS; ++c) {
      hole[2 * c] = x + 0.012 * cos(2 * c * acos(-1.0) / CORNERS);
      hole[2 * c + 1] = y + 0.012 * sin(2 * c * acos(-1.0) / CORNERS);
    }
    MUST(pnpbs_domain_add_polyline(it.domain, PNPBS_BOUNDARY, 1, CORNERS, hole, NULL, 0));
  }
  MUST(pnpbs_placement_set(it.placement, "levels", "4"));
  MUST(pnpbs_placement_initialise(it.placement));
  ck_assert_int_eq(integer_of(it.placement, "levels"), 1);
  job_end(&it);
}
END_TEST

/* Returns the quality of a set whose least spacing is multiplied by `scale`. The first row is left
 * as the bubbles have placed it. */
static quality_summary quality_with(double scale, const char* key, const char* value) {
  cone graded = {0.0048, 0.016, 0.5, 0.5};
  job it = graded_square(&graded);
  result nodes;
  quality_summary quality;
  graded.a *= scale;
  MUST(pnpbs_placement_set(it.placement, "first_row", "0"));
  MUST(pnpbs_placement_set(it.placement, key, value));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  nodes = result_of(it.placement);
  check_result(&nodes, 1);
  quality = quality_of(&nodes);
  result_free(&nodes);
  job_end(&it);
  return quality;
}

START_TEST(more_effort_is_better) {
  const double plain = 1 - quality_with(1, "effort", "default").mean,
               best = 1 - quality_with(1, "effort", "best").mean;
  ck_assert_msg(best < 0.95 * plain, "mean quality 1 - %.5f, by default 1 - %.5f", best, plain);
}
END_TEST

/* Returns the least quality of five sets. */
static double least_quality_with(const char* key, const char* value) {
  double least = 1;
  int k;
  for (k = 0; k < 5; ++k) {
    const double least_of_set = quality_with(1 + 0.01 * k, key, value).least;
    if (least_of_set < least) least = least_of_set;
  }
  return least;
}

START_TEST(defects_are_repaired) {
  const double with = least_quality_with("smoothing_rounds", "10"),
               without = least_quality_with("smoothing_rounds", "0");
  ck_assert_msg(with > 0.8 && without < 0.78, "least quality %.3f, without repairs %.3f", with,
                without);
}
END_TEST

/* Repairs reduce the number of nodes with the wrong number of neighbours, and so that of imperfect
 * triangles: by a tenth, as measured on 20 sets. If levels lost nodes, the share of imperfect
 * triangles without repairs would be 0.018. */
START_TEST(defects_become_fewer) {
  double with = 0, without = 0;
  int k;
  for (k = 0; k < 10; ++k) {
    with += quality_with(1 + 0.01 * k, "topology_repairs", "3").below_95 / 10;
    without += quality_with(1 + 0.01 * k, "topology_repairs", "0").below_95 / 10;
  }
  ck_assert_msg(with < 0.95 * without && without < 0.013,
                "below 0.95 are %.5f of the triangles, without repairs %.5f", with, without);
}
END_TEST

/* ---------------------------------------------------------------- watched --------------- */

typedef struct {
  int calls, stop_at;
  double last_fraction;
  int64_t most_nodes;
} watcher;

static int32_t watch(double fraction, int64_t step, int64_t nodes, double max_speed, void* user) {
  watcher* it = user;
  (void)step;
  (void)max_speed;
  ck_assert_msg(fraction >= it->last_fraction && fraction <= 1, "the fraction went from %g to %g",
                it->last_fraction, fraction);
  /* The number of nodes increases from level to level. */
  ck_assert_msg((double)nodes > 0.95 * (double)it->most_nodes, "%d nodes after %d", (int)nodes,
                (int)it->most_nodes);
  it->last_fraction = fraction;
  if (nodes > it->most_nodes) it->most_nodes = nodes;
  return it->calls++ == it->stop_at;
}

/* If the monitor stops a run on a coarser level, the placement still has nodes of the requested
 * spacing, and the next run continues from them. */
START_TEST(they_can_be_stopped) {
  static cone graded = {0.0048, 0.016, 0.5, 0.5};
  watcher seen = {0, 1, 0, 0};
  job it = graded_square(&graded);
  int64_t nodes;
  const int by_run = _i;
  seen.stop_at = 2 * _i;
  MUST(pnpbs_placement_set_monitor(it.placement, watch, &seen));
  MUST_BE(PNPBS_STOPPED,
          by_run ? pnpbs_placement_run(it.placement) : pnpbs_placement_initialise(it.placement));
  ck_assert_int_eq(seen.calls, seen.stop_at + 1);
  ck_assert_double_lt(seen.last_fraction, 0.5);
  nodes = integer_of(it.placement, "nodes");
  ck_assert_int_gt(nodes, 10 * seen.most_nodes);
  check_placement(it.placement, 1);
  seen.last_fraction = 0;
  seen.stop_at = -1;
  MUST(pnpbs_placement_run(it.placement));
  ck_assert_double_eq(seen.last_fraction, 1);
  ck_assert_int_lt(llabs(integer_of(it.placement, "nodes") - nodes), nodes / 20);
  check_placement(it.placement, 1);
  job_end(&it);
}
END_TEST

/* A spacing callback that fails while a coarser level evaluates it. The placement must stay as it
 * was. */
typedef struct {
  int calls, fail_at;
} failing;

static int32_t failing_spacing(int64_t n, int32_t dim, const double* xyz, double* d, void* user) {
  static cone graded = {0.0048, 0.016, 0.5, 0.5};
  failing* it = user;
  if (it->calls++ == it->fail_at) return 1;
  return cone_spacing(n, dim, xyz, d, &graded);
}

static const char* const kCounted[] = {"steps",    "levels",     "inserted", "deleted",
                                       "rebuilds", "rebalances", "dropped",  "unknown_uses"};
enum { COUNTED = sizeof kCounted / sizeof *kCounted };

typedef struct {
  int64_t counts[COUNTED];
  char stop_reason[32];
} figures;

static figures figures_of(pnpbs_placement placement) {
  figures f;
  const char* text = NULL;
  int k;
  memset(&f, 0, sizeof f);
  for (k = 0; k < COUNTED; ++k) f.counts[k] = integer_of(placement, kCounted[k]);
  MUST(pnpbs_placement_get_string(placement, "stop_reason", &text));
  strncpy(f.stop_reason, text, sizeof f.stop_reason - 1);
  return f;
}

/* The statistics do not include a failed call. */
START_TEST(a_failure_tells_nothing) {
  failing f = {0, -1};
  job it = square_job(1);
  figures before, after;
  int calls, k, c;
  MUST(pnpbs_placement_set_spacing_callback(it.placement, failing_spacing, &f));
  MUST(pnpbs_placement_initialise(it.placement));
  calls = f.calls;
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  before = figures_of(it.placement);
  for (k = 1; k < 4; ++k) {
    f.calls = 0;
    f.fail_at = calls * k / 4;
    MUST_BE(PNPBS_ERROR_CALLBACK, pnpbs_placement_initialise(it.placement));
    after = figures_of(it.placement);
    for (c = 0; c < COUNTED; ++c)
      ck_assert_msg(after.counts[c] == before.counts[c], "%s was %d, is %d", kCounted[c],
                    (int)before.counts[c], (int)after.counts[c]);
    ck_assert_str_eq(after.stop_reason, before.stop_reason);
  }
  job_end(&it);
}
END_TEST

/* Calls that initialise first return PNPBS_STOPPED if the monitor stops that, and do nothing else.
 */
START_TEST(adjustments_can_be_stopped) {
  static cone graded = {0.0048, 0.016, 0.5, 0.5};
  watcher seen = {0, 1, 0, 0};
  job it = graded_square(&graded);
  seen.stop_at = 0;
  MUST(pnpbs_placement_set_monitor(it.placement, watch, &seen));
  MUST_BE(PNPBS_STOPPED, _i ? pnpbs_placement_adjust_population(it.placement, NULL, NULL)
                            : pnpbs_placement_rebalance(it.placement));
  ck_assert_int_eq(seen.calls, 1);
  check_placement(it.placement, 1);
  MUST(pnpbs_placement_set_monitor(it.placement, NULL, NULL));
  MUST(pnpbs_placement_run(it.placement));
  check_placement(it.placement, 1);
  job_end(&it);
}
END_TEST

START_TEST(a_failure_leaves_nothing) {
  failing f = {0, -1};
  job it = square_job(1);
  int calls, k;
  hash_text hash;
  MUST(pnpbs_placement_set_spacing_callback(it.placement, failing_spacing, &f));
  MUST(pnpbs_placement_initialise(it.placement));
  calls = f.calls;
  hash = hash_of(it.placement);
  ck_assert_int_eq(integer_of(it.placement, "levels"), 2);
  for (k = 1; k < 4; ++k) {
    f.calls = 0;
    f.fail_at = calls * k / 4;
    MUST_BE(PNPBS_ERROR_CALLBACK, pnpbs_placement_initialise(it.placement));
    f.fail_at = -1;
    ck_assert_str_eq(hash_of(it.placement).text, hash.text);
  }
  MUST(pnpbs_placement_run(it.placement));
  check_placement(it.placement, 1);
  job_end(&it);
}
END_TEST

TEST_SUITE(test_levels) {
  Suite* suite = suite_create("levels");
  TCase* tests = tcase_create("levels");
  tcase_add_test(tests, as_many_as_pay);
  tcase_add_test(tests, none_for_constant_spacing);
  tcase_add_test(tests, fewer_where_the_boundary_is_fine);
  tcase_add_test(tests, more_effort_is_better);
  tcase_add_test(tests, defects_are_repaired);
  tcase_add_test(tests, defects_become_fewer);
  tcase_add_loop_test(tests, they_can_be_stopped, 0, 2);
  tcase_add_test(tests, a_failure_leaves_nothing);
  tcase_add_test(tests, a_failure_tells_nothing);
  tcase_add_loop_test(tests, adjustments_can_be_stopped, 0, 2);
  suite_add_tcase(suite, tests);
  return run_suite(suite);
}
