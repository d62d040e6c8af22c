// SPDX-License-Identifier: BSD-3-Clause
// Vacancies on surfaces: places for a node that is missing though the bubbles rest. Each of those
// around has but one neighbour too few, and where a feature is beside them, not even that.
#pragma once

#include <cstdint>

#include "level/level.hpp"

namespace pnpbs {

// Puts nodes into the vacancies of the level's surfaces, on which its nodes move. Returns how many,
// of all ranks. Collective.
std::int64_t fill_vacancies(Level<3>& level);

}  // namespace pnpbs
