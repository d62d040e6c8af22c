/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests shapes that d does not resolve: a warning reports them, and the option `resolve` corrects
 * it.
 */
#include "volume_support.h"

static pnpbs_status wedge(pnpbs_domain domain, const char* data) {
  const double angle = acos(-1.0) / 9, c = cos(angle), s = sin(angle);
  const double xyz[6][3] = {{0, 0, 0}, {1, 0, 0}, {c, s, 0}, {0, 0, 1}, {1, 0, 1}, {c, s, 1}};
  const int sides[5][4] = {{0, 2, 1, 0}, {3, 4, 5, 3}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
  (void)data;
  return volume_add_quads(domain, PNPBS_BOUNDARY, 6, xyz[0], 5, sides);
}

/* Runs with d as given, or refined as the option says. */
static job run_in(volume_body body, double d, const char* resolve) {
  job it = body_job(body);
  MUST(pnpbs_placement_set_spacing_constant(it.placement, d));
  MUST(pnpbs_placement_set(it.placement, "conforming_rounds", "0"));
  MUST(pnpbs_placement_set(it.placement, "resolve", resolve));
  ck_assert_int_ge(pnpbs_placement_run(it.placement), 0);
  return it;
}

START_TEST(nothing_is_missing) {
  static const volume_body bodies[] = {volume_unit_ball, volume_unit_box, volume_l_block};
  static const double d[] = {0.15, 0.12, 0.1};
  job it = run_in(bodies[_i], d[_i], "0");
  ck_assert_int_eq(integer_of(it.placement, "missing_faces"), 0);
  ck_assert_int_eq(warnings_with(it.placement, "missing_faces"), 0);
  ck_assert_int_eq(warnings_with(it.placement, "in no tetrahedron"), 0);
  job_end(&it);
}
END_TEST

/* A slot as wide as a third or a sixth of d has nodes opposite to each other on its sides. */
START_TEST(a_thin_slot) {
  static const double d[] = {0.12, 0.24};
  job it = run_in(volume_slotted, d[_i], "0");
  ck_assert_int_eq(integer_of(it.placement, "missing_faces"), 0);
  check_body(&it, 1e-12);
  job_end(&it);
  it = run_in(volume_slotted, d[_i], "1");
  ck_assert_int_eq(integer_of(it.placement, "missing_faces"), 0);
  ck_assert_int_eq(warnings_with(it.placement, "does not resolve the shape"), 0);
  check_body(&it, 1e-12);
  job_end(&it);
}
END_TEST

START_TEST(a_sharp_wedge) {
  job it = run_in(wedge, 0.15, "0"), resolved = run_in(wedge, 0.15, "1");
  ck_assert_int_eq(integer_of(resolved.placement, "missing_faces"), 0);
  ck_assert_int_gt(integer_of(resolved.placement, "nodes"), integer_of(it.placement, "nodes"));
  check_body(&resolved, 1e-12);
  job_end(&it);
  job_end(&resolved);
}
END_TEST

/* The option can be set after a run, which builds the level again. */
START_TEST(set_later) {
  job it = run_in(volume_slotted, 0.12, "0");
  const int64_t before = integer_of(it.placement, "nodes");
  MUST(pnpbs_placement_set(it.placement, "resolve", "1"));
  ck_assert_int_ge(pnpbs_placement_run(it.placement), 0);
  ck_assert_int_gt(integer_of(it.placement, "nodes"), before);
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_placement_set(it.placement, "resolve", "2"), "resolve",
            "0 .. 1");
  job_end(&it);
}
END_TEST

/* By default d is held down where the boundary is torn, and only there. Without rounds d stays as
 * given. */
START_TEST(held_down_where_torn) {
  job as_given = unresolved_job(), it = unresolved_job();
  MUST(pnpbs_placement_set(as_given.placement, "conforming_rounds", "0"));
  MUST_BE(PNPBS_NOT_CONFORMING, pnpbs_placement_run(as_given.placement));
  MUST_BE(PNPBS_NOT_CONFORMING, pnpbs_placement_check(as_given.placement));
  ck_assert_int_eq(integer_of(as_given.placement, "unresolved_places"), 0);
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  MUST_BE(PNPBS_OK, pnpbs_placement_check(it.placement));
  ck_assert_int_gt(integer_of(it.placement, "unresolved_places"), 0);
  ck_assert_int_eq(warnings_with(it.placement, "the spacing did not resolve the shape at"), 1);
  ck_assert_int_lt(integer_of(it.placement, "nodes"), 3 * integer_of(as_given.placement, "nodes"));
  check_body(&it, 0.05); /* the boundary is coarse at its bumps */

  /* A new spacing does not keep the reduced values. */
  MUST(pnpbs_placement_set_spacing_constant(it.placement, 0.2));
  MUST(pnpbs_placement_set(it.placement, "conforming_rounds", "0"));
  ck_assert_int_ge(pnpbs_placement_run(it.placement), 0);
  ck_assert_int_eq(integer_of(it.placement, "unresolved_places"), 0);
  ck_assert_int_eq(warnings_with(it.placement, "did not resolve"), 0);
  job_end(&it);
  job_end(&as_given);
}
END_TEST

/* The same holds on surfaces, where triangles do not join. */
START_TEST(held_down_on_surfaces) {
  job as_given = unresolved_surface_job(), it = unresolved_surface_job();
  MUST(pnpbs_placement_set(as_given.placement, "conforming_rounds", "0"));
  MUST_BE(PNPBS_NOT_CONFORMING, pnpbs_placement_run(as_given.placement));
  MUST_BE(PNPBS_NOT_CONFORMING, pnpbs_placement_check(as_given.placement));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  MUST_BE(PNPBS_OK, pnpbs_placement_check(it.placement));
  ck_assert_int_gt(integer_of(it.placement, "unresolved_places"), 0);
  job_end(&it);
  job_end(&as_given);
}
END_TEST

START_TEST(coarser_than_the_body) {
  job it = run_in(volume_unit_box, 3, "0");
  ck_assert_int_eq(warnings_with(it.placement,
                                 "the spacing is 3 or more, the longest side of the "
                                 "domain 1:"),
                   1);
  ck_assert_int_eq(warnings_with(it.placement, "0.25 or less"), 1);
  job_end(&it);
  it = run_in(volume_unit_box, 0.3, "0");
  ck_assert_int_eq(warnings_with(it.placement, "longest side"), 0);
  job_end(&it);
}
END_TEST

TEST_SUITE(test_resolving) {
  Suite* suite = suite_create("resolving");
  TCase* tests = tcase_create("resolving");
  tcase_set_timeout(tests, 0);
  tcase_add_loop_test(tests, nothing_is_missing, 0, 3);
  tcase_add_loop_test(tests, a_thin_slot, 0, 2);
  tcase_add_test(tests, a_sharp_wedge);
  tcase_add_test(tests, set_later);
  if (WHEN_SANITIZED(0, 1)) tcase_add_test(tests, held_down_where_torn);
  tcase_add_test(tests, held_down_on_surfaces);
  tcase_add_test(tests, coarser_than_the_body);
  suite_add_tcase(suite, tests);
  return run_suite(suite);
}
