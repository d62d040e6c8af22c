/* SPDX-License-Identifier: BSD-3-Clause
 *
 * How every Check runner ends: all suites in this very process. Forking, Check's default, breaks
 * programs that use MPI or have threads running; ctest's own limits stand in for it.
 */
#ifndef PNPBS_TESTS_CHECK_RUNNER_H
#define PNPBS_TESTS_CHECK_RUNNER_H

#include <check.h>
#include <stdlib.h>

/* Check's old name for ck_abort_msg, a macro; the C++ library has functions of that name. */
#undef fail

static inline int run_suite(Suite* suite) {
  SRunner* runner = srunner_create(suite);
  int failed;
  srunner_set_fork_status(runner, CK_NOFORK);
  srunner_run_all(runner, CK_NORMAL);
  failed = srunner_ntests_failed(runner);
  srunner_free(runner);
  return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

#endif
