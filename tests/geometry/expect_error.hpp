// SPDX-License-Identifier: BSD-3-Clause
// Checks that something is refused, and how.
#pragma once

#include <functional>
#include <initializer_list>
#include <string>

#include "check_runner.h"
#include "core/error.hpp"

// `action` must throw an Error with this status whose message holds all these parts.
inline void expect_error(pnpbs_status status, std::initializer_list<const char*> parts,
                         const std::function<void()>& action) {
  try {
    action();
  } catch (const pnpbs::Error& error) {
    const std::string message = error.what();
    ck_assert_msg(error.status() == status, "status %d for: %s", error.status(), message.c_str());
    for (const char* part : parts) {
      ck_assert_msg(message.find(part) != std::string::npos, "no '%s' in: %s", part,
                    message.c_str());
    }
    return;
  }
  ck_abort_msg("nothing was thrown, expected an error with '%s'",
               parts.size() > 0 ? *parts.begin() : "");
}
