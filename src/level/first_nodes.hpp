// SPDX-License-Identifier: BSD-3-Clause
// First inner nodes where there were none (section 2.1).
#pragma once

#include <functional>

#include "level/level.hpp"

namespace pnpbs {

// Calls beat() again and again: if it throws on one rank, all throw. Collective.
void fill(
    Level& level, const std::function<void()>& beat = [] {});

}  // namespace pnpbs
