// SPDX-License-Identifier: BSD-3-Clause
// Assertions for inner loops. Check records every ck_assert, which is slow; these call Check only
// on failure.
#pragma once

#include "check_runner.h"

#define quick_assert_msg(condition, ...)         \
  do {                                           \
    if (!(condition)) ck_abort_msg(__VA_ARGS__); \
  } while (0)

#define quick_assert(...) quick_assert_msg((__VA_ARGS__), "%s", #__VA_ARGS__)
