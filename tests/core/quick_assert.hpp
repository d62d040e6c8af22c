// SPDX-License-Identifier: BSD-3-Clause
// Check writes something down at every ck_assert, which is slow in inner loops. These do so only
// when they fail.
#pragma once

#include "check_runner.h"

#define quick_assert_msg(condition, ...)         \
  do {                                           \
    if (!(condition)) ck_abort_msg(__VA_ARGS__); \
  } while (0)

#define quick_assert(...) quick_assert_msg((__VA_ARGS__), "%s", #__VA_ARGS__)
