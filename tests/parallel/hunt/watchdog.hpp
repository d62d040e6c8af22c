// SPDX-License-Identifier: BSD-3-Clause
//
// Tells on standard error what runs when it has not ended for long, so that a hang has a name. It
// ends nothing.
#pragma once

#include <string>

namespace hunt {

/** What runs now; an empty case leaves that as it is. Starts the time anew. */
void watch(const std::string& job, const std::string& what);

void end_watch();

}  // namespace hunt
