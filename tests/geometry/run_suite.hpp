// SPDX-License-Identifier: BSD-3-Clause
// Runs one suite with these tests.
#pragma once

#include <initializer_list>

#include "check_runner.h"

inline int run_suite(const char* name, std::initializer_list<const TTest*> tests) {
  Suite* suite = suite_create(name);
  TCase* all = tcase_create(name);
  tcase_set_timeout(all, 0);  // ctest has a timeout
  for (const TTest* test : tests) tcase_add_test(all, test);
  suite_add_tcase(suite, all);
  return run_suite(suite);
}
