/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests KOKKOS_ variables with invalid values, at which Kokkos would end the process. The library
 * must check them first and return an error that names the variable.
 */
#define _POSIX_C_SOURCE 200809L
#include <string.h>

#include "check_runner.h"
#include "small_job.h"

static const char* const bad[][2] = {
    {"KOKKOS_NUM_THREADS", "banana"},       {"KOKKOS_NUM_THREADS", ""},
    {"KOKKOS_NUM_THREADS", "2x"},           {"KOKKOS_NUM_THREADS", "0"},
    {"KOKKOS_NUM_THREADS", "-3"},           {"KOKKOS_NUM_THREADS", "99999999999999999999"},
    {"KOKKOS_DEVICE_ID", "first"},          {"KOKKOS_DEVICE_ID", "-1"},
    {"KOKKOS_DISABLE_WARNINGS", "perhaps"}, {"KOKKOS_PRINT_CONFIGURATION", "perhaps"},
    {"KOKKOS_TUNE_INTERNALS", "perhaps"},   {"KOKKOS_MAP_DEVICE_ID_BY", "chance"},
};

START_TEST(an_error_that_names_it) {
  const char* name = bad[_i][0];
  small_job_result result;
  ck_assert_int_eq(setenv(name, bad[_i][1], 1), 0);
  result = small_job(&linked_library, NULL);
  ck_assert_int_eq(unsetenv(name), 0);
  ck_assert_msg(result.status == PNPBS_ERROR_KOKKOS, "%s=%s: status %d, %s", name, bad[_i][1],
                (int)result.status, result.message);
  ck_assert_msg(strstr(result.message, name) != NULL, "the message does not name %s: %s", name,
                result.message);
}
END_TEST

/* Kokkos has not started yet, so a valid environment works afterwards. The valid variable must be
 * obeyed. */
START_TEST(then_it_works) {
  small_job_result result;
  ck_assert_int_eq(setenv("KOKKOS_NUM_THREADS", "2", 1), 0);
  ck_assert_int_eq(unsetenv("OMP_NUM_THREADS"), 0);
  result = small_job(&linked_library, NULL);
  ck_assert_msg(result.status >= 0, "%s", result.message);
  ck_assert_int_eq(result.threads, 2);
}
END_TEST

int main(void) {
  Suite* suite = suite_create("linkage: bad environment");
  TCase* cases = tcase_create("environment");
  tcase_add_loop_test(cases, an_error_that_names_it, 0, (int)(sizeof bad / sizeof bad[0]));
  tcase_add_test(cases, then_it_works);
  suite_add_tcase(suite, cases);
  return run_suite(suite);
}
