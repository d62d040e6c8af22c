// SPDX-License-Identifier: BSD-3-Clause
// Vacancies on surfaces: points where a node is missing although the bubbles rest. Each node around
// has only one neighbour too few, and beside a feature not even that, so the overlap ratio does not
// show it.
#pragma once

#include <cstdint>

#include "level/level.hpp"

namespace pnpbs {

// Inserts nodes in the vacancies of the level's surfaces. Surface nodes must be those that move.
// Returns the number of nodes over all ranks. All ranks must call it, and if one rank throws, all
// ranks throw.
std::int64_t fill_vacancies(Level<3>& level);

}  // namespace pnpbs
