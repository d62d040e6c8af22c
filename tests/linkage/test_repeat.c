/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests a process that uses the library repeatedly and ends it before its own end.
 */
#include "check_runner.h"
#include "small_job.h"

START_TEST(three_times) {
  small_job_result first = {PNPBS_OK, "", 0, 0};
  int i;
  for (i = 0; i < 3; ++i) {
    /* The number of threads is set once, and later contexts have the same number. */
    small_job_result result = small_job(&linked_library, i == 0 ? "2" : NULL);
    ck_assert_msg(result.status >= 0, "job %d: %s", i, result.message);
    ck_assert_int_gt(result.nodes, 2500);
    ck_assert_int_eq(result.threads, 2);
    if (i == 0) first = result;
    ck_assert_int_eq(result.nodes, first.nodes);
  }
}
END_TEST

/* Kokkos is ended while a placement exists. The placement can then be queried and destroyed, but
 * not run. */
START_TEST(nothing_after_finalize) {
  const double corners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  pnpbs_context context = NULL;
  pnpbs_domain domain = NULL;
  pnpbs_placement placement = NULL;
  int64_t nodes = 0;
  small_job_result result;
  ck_assert_int_eq(pnpbs_context_create_serial(&context), PNPBS_OK);
  ck_assert_int_eq(pnpbs_domain_create(context, 2, &domain), PNPBS_OK);
  ck_assert_int_eq(
      pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, &corners[0][0], NULL, 0.0), PNPBS_OK);
  ck_assert_int_eq(pnpbs_placement_create(context, domain, &placement), PNPBS_OK);
  ck_assert_int_eq(pnpbs_placement_set_spacing_constant(placement, 0.02), PNPBS_OK);
  ck_assert_int_ge(pnpbs_placement_run(placement), PNPBS_OK);

  ck_assert_int_eq(pnpbs_finalize(), PNPBS_OK);
  ck_assert_int_eq(pnpbs_finalize(), PNPBS_OK);

  ck_assert_int_eq(pnpbs_placement_run(placement), PNPBS_ERROR_KOKKOS);
  ck_assert_str_ne(pnpbs_last_error(context), "");
  pnpbs_placement_count(placement, &nodes); /* may succeed or fail, but not crash */
  ck_assert_int_eq(pnpbs_placement_destroy(&placement), PNPBS_OK);
  ck_assert_int_eq(pnpbs_domain_destroy(&domain), PNPBS_OK);
  ck_assert_int_eq(pnpbs_context_destroy(&context), PNPBS_OK);

  result = small_job(&linked_library, NULL);
  ck_assert_int_eq(result.status, PNPBS_ERROR_KOKKOS);
  ck_assert_str_ne(result.message, "");
}
END_TEST

int main(void) {
  Suite* suite = suite_create("linkage: repeated use");
  TCase* cases = tcase_create("repeat");
  tcase_add_test(cases, three_times);
  tcase_add_test(cases, nothing_after_finalize);
  suite_add_tcase(suite, cases);
  return run_suite(suite);
}
