// SPDX-License-Identifier: BSD-3-Clause
// Checks that an action fails with a certain error.
#pragma once

#include <functional>
#include <initializer_list>
#include <string>

#include "base/error.hpp"
#include "check_runner.h"

// Expects that `action` throws an Error of this kind whose message contains all these parts.
inline void expect_error(pnpbs::ErrorKind kind, std::initializer_list<const char*> parts,
                         const std::function<void()>& action) {
  try {
    action();
  } catch (const pnpbs::Error& error) {
    const std::string message = error.what();
    ck_assert_msg(error.kind() == kind, "kind %d for: %s", static_cast<int>(error.kind()),
                  message.c_str());
    for (const char* part : parts) {
      ck_assert_msg(message.find(part) != std::string::npos, "no '%s' in: %s", part,
                    message.c_str());
    }
    return;
  }
  ck_abort_msg("nothing was thrown, expected an error with '%s'",
               parts.size() > 0 ? *parts.begin() : "");
}
