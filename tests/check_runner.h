/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Every test that uses Check includes this header. A file of tests is a suite, which ends with
 *   TEST_SUITE(test_forces) { ... return run_suite(suite); }
 * The suites of a folder are linked into one runner. Its first argument is the name of the suite to
 * run (CMakeLists.txt). A suite runs in the runner's own process. Check forks by default, which
 * breaks programs that use MPI or have threads; ctest enforces the time limits instead. */
#ifndef PNPBS_TESTS_CHECK_RUNNER_H
#define PNPBS_TESTS_CHECK_RUNNER_H

#include <check.h>
#include <stdlib.h>

/* Check defines this macro as the old name of ck_abort_msg. The C++ library has functions of this
 * name. */
#undef fail

/* Check writes the line to a file at every assertion that holds, for the case that the process is
 * killed. In tests of all pairs this would take most of the time. Sanitizers and debuggers report
 * the line as well. */
#define _mark_point(file, line) ((void)0)

/* Sanitized code is ten times slower. Some tests then run fewer or smaller cases, if these cover
 * the same lines of the library. */
#if defined(__SANITIZE_ADDRESS__)
#define PNPBS_TESTS_SANITIZED
#elif defined(__has_feature) /* for Clang */
#if __has_feature(address_sanitizer)
#define PNPBS_TESTS_SANITIZED
#endif
#endif
#if defined(PNPBS_TESTS_SANITIZED)
#define WHEN_SANITIZED(fewer, all) (fewer)
#else
#define WHEN_SANITIZED(fewer, all) (all)
#endif

/* Declares the function of a suite that the runner calls. It returns the exit status. */
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
  /* A suite without tests fails. */
  passed = srunner_ntests_run(runner) > 0 && srunner_ntests_failed(runner) == 0;
  srunner_free(runner);
  return passed ? EXIT_SUCCESS : EXIT_FAILURE;
}

#endif
