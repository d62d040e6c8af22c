// SPDX-License-Identifier: BSD-3-Clause
// The speeds of the nodes of a level, which decide whether the bubbles rest.
#pragma once

#include "level/level.hpp"

namespace pnpbs {

// The largest and the mean speed.
struct Speeds {
  double max = 0, mean = 0;  // scaled speeds: spacings per unit of time
};

// Returns the speeds over all ranks. The mean is over the nodes that move. Collective.
template <int Dim>
Speeds speeds_of(const Level<Dim>& level);

}  // namespace pnpbs
