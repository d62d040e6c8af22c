/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What every test by Check includes. A file of tests is a suite: it ends with
 *
 *   TEST_SUITE(test_forces) { ... return run_suite(suite); }
 *
 * The suites of a folder are linked into one runner, which runs the one that its first argument
 * names (CMakeLists.txt). A suite runs in the runner's own process: forking, Check's default,
 * breaks programs that use MPI or have threads running; ctest's own limits stand in for it.
 */
#ifndef PNPBS_TESTS_CHECK_RUNNER_H
#define PNPBS_TESTS_CHECK_RUNNER_H

#include <check.h>
#include <stdlib.h>

/* Check's old name for ck_abort_msg, a macro; the C++ library has functions of that name. */
#undef fail

/* With every assertion that holds, Check writes the line to a file, in case the process is killed:
 * in tests of all pairs that takes most of the time. Sanitizers and debuggers tell the line as
 * well. */
#define _mark_point(file, line) ((void)0)

/* Sanitized code is ten times slower, so some tests take fewer or smaller cases with it: those that
 * run the same lines of the library. */
#if defined(__SANITIZE_ADDRESS__)
#define PNPBS_TESTS_SANITIZED
#elif defined(__has_feature) /* Clang's */
#if __has_feature(address_sanitizer)
#define PNPBS_TESTS_SANITIZED
#endif
#endif
#if defined(PNPBS_TESTS_SANITIZED)
#define WHEN_SANITIZED(fewer, all) (fewer)
#else
#define WHEN_SANITIZED(fewer, all) (all)
#endif

/* The function of a suite that its runner calls; it returns the exit status. */
#if defined(__cplusplus)
#define TEST_SUITE(name) int name(int, char**)
#else
#define TEST_SUITE(name)           \
  int name(int argc, char** argv); \
  int name(__attribute__((unused)) int argc, __attribute__((unused)) char** argv)
#endif

static inline int run_suite(Suite* suite) {
  SRunner* runner = srunner_create(suite);
  int passed;
  srunner_set_fork_status(runner, CK_NOFORK);
  srunner_run_all(runner, CK_NORMAL);
  /* A suite that has lost its tests has not passed. */
  passed = srunner_ntests_run(runner) > 0 && srunner_ntests_failed(runner) == 0;
  srunner_free(runner);
  return passed ? EXIT_SUCCESS : EXIT_FAILURE;
}

#endif
