// SPDX-License-Identifier: BSD-3-Clause
// What the samples of d in the leaves of a level's tree tell: how many nodes d asks for, and how it
// varies.
#pragma once

#include <vector>

#include "level/level.hpp"

namespace pnpbs {

// Nodes that d asks for in each leaf of ours. Collective.
std::vector<double> wanted_nodes(const Level& level);
// In all. Collective.
double expected_nodes(const Level& level);

struct SpacingVariation {
  double min = kFarAway, max = 0;
  double steepest = 0;  // growth of d per unit of length
};

// Collective.
SpacingVariation spacing_variation(const Level& level);

}  // namespace pnpbs
