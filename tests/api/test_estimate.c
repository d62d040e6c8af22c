/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests estimates of nodes, memory and time, and runs that would need more memory than is
 * available.
 */
#include "volume_support.h"

static job lake_job(void) {
  job it = job_begin();
  MUST(pnpbs_domain_read_poly(it.domain, PNPBS_SOURCE_DIR "/examples/data/lake_victoria.poly"));
  job_place(&it);
  return it;
}

static void expect_nodes(job* it, double tolerance) {
  int64_t nodes, bytes, placed;
  double seconds;
  MUST(pnpbs_placement_estimate(it->placement, &nodes, &bytes, &seconds));
  ck_assert_int_eq(integer_of(it->placement, "nodes"), 0); /* an estimate places no node */
  ck_assert_int_ge(pnpbs_placement_run(it->placement), PNPBS_OK);
  placed = integer_of(it->placement, "nodes");
  ck_assert_msg(fabs((double)nodes / (double)placed - 1) < tolerance, "%d expected, %d placed",
                (int)nodes, (int)placed);
  ck_assert_int_gt(bytes, 222 * nodes);
  ck_assert_int_lt(bytes, 300 * nodes + 100000000);
  ck_assert_double_gt(seconds, 0);
  job_end(it);
}

START_TEST(near_what_comes) {
  cone slope = {0.004, 0.03, 0.2, 0.3};
  job it = square_job(1);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.02));
  expect_nodes(&it, 0.02);
  it = square_job(1);
  MUST(pnpbs_placement_set_spacing_callback(it.placement, cone_spacing, &slope));
  expect_nodes(&it, 0.02);
  it = lake_job();
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 4));
  expect_nodes(&it, 0.02);
}
END_TEST

/* The estimate is close in space: for a constant d, and for a d that grows from the middle of the
 * body, from a line through it, from a point on a facet far larger than d there, and from a whole
 * side. */
START_TEST(near_what_comes_in_space) {
  static const struct {
    volume_body body;
    struct volume_spacing d;
  } cases[] = {{volume_unit_box, VOLUME_CONSTANT(0.1)},
               {volume_bracket, VOLUME_GRADED(0.8, 0.05, 62, 14, NAN)},
               {volume_eros, VOLUME_GRADED(0.018, 0.08, 0, 0.1, 0)},
               {volume_unit_box, VOLUME_GRADED(0.01, 0.3, 2.0 / 3, 1.0 / 3, 0)},
               {volume_unit_box, VOLUME_GRADED(0.03, 0.2, NAN, NAN, 0)}};
  struct volume_spacing d = cases[_i].d;
  job it = body_job(cases[_i].body);
  MUST(pnpbs_placement_set_spacing_callback(it.placement, volume_spacing_at, &d));
  expect_nodes(&it, 0.08);
}
END_TEST

/* The estimate works for more nodes than could be placed, takes no noticeable time, and leaves the
 * nodes as they are. */
START_TEST(of_a_hundred_billion_nodes) {
  job it = square_job(1);
  int64_t nodes, bytes;
  double seconds;
  hash_text before;
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.1));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  before = hash_of(it.placement);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, sqrt(1.1547e-11)));
  MUST(pnpbs_placement_estimate(it.placement, &nodes, &bytes, &seconds));
  ck_assert_double_eq_tol((double)nodes, 1e11, 1e8);
  ck_assert_str_eq(hash_of(it.placement).text, before.text);
  MUST(pnpbs_placement_estimate(it.placement, NULL, NULL, NULL));
  job_end(&it);
}
END_TEST

START_TEST(what_is_missing) {
  job it = square_job(1);
  MUST_FAIL(PNPBS_ERROR_STATE, pnpbs_placement_estimate(it.placement, NULL, NULL, NULL),
            "no spacing", "set_spacing");
  job_end(&it);
}
END_TEST

/* The option allows so small a share of the memory that it is not enough. */
START_TEST(too_little_memory) {
  job it = square_job(1);
  hash_text before;
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.1));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  before = hash_of(it.placement);
  MUST(pnpbs_placement_set(it.placement, "max_memory", "1e-9"));
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.02));
  MUST_FAIL(PNPBS_ERROR_MEMORY, pnpbs_placement_run(it.placement), "would need", "max_memory");
  ck_assert_str_eq(hash_of(it.placement).text, before.text);
  MUST_FAIL(PNPBS_ERROR_MEMORY, pnpbs_placement_initialise(it.placement), "nodes", "max_memory");
  MUST(pnpbs_placement_estimate(it.placement, NULL, NULL, NULL));
  MUST(pnpbs_placement_set(it.placement, "max_memory", "0"));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  ck_assert_int_gt(integer_of(it.placement, "nodes"), 2000);
  job_end(&it);
}
END_TEST

TEST_SUITE(test_estimate) {
  Suite* suite = suite_create("estimate");
  TCase* tests = tcase_create("estimate");
  tcase_add_test(tests, near_what_comes);
  tcase_add_loop_test(tests, near_what_comes_in_space, 0, WHEN_SANITIZED(2, 5));
  tcase_add_test(tests, of_a_hundred_billion_nodes);
  tcase_add_test(tests, what_is_missing);
  tcase_add_test(tests, too_little_memory);
  tcase_set_timeout(tests, 0);
  suite_add_tcase(suite, tests);
  return run_suite(suite);
}
