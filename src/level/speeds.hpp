// SPDX-License-Identifier: BSD-3-Clause
// How fast the nodes of a level still are: by this rest is judged.
#pragma once

#include "level/level.hpp"

namespace pnpbs {

struct Speeds {
  double max = 0, mean = 0;  // scaled: spacings per unit of time
};

// Of the nodes of all ranks; the mean, of those that move. Collective.
template <int Dim>
Speeds speeds_of(const Level<Dim>& level);

}  // namespace pnpbs
