// SPDX-License-Identifier: BSD-3-Clause
//
// Reports on standard error what runs if it takes long, so that a hang can be identified. It does
// not end the process.
#pragma once

#include <string>

namespace hunt {

/** Sets the current activity and restarts the timer. An empty case leaves the case unchanged. */
void watch(const std::string& job, const std::string& what);

void end_watch();

}  // namespace hunt
