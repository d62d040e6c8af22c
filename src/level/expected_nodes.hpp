// SPDX-License-Identifier: BSD-3-Clause
// What the samples of d in the leaves of a level's tree tell: how many nodes d asks for, and how it
// varies.
#pragma once

#include <vector>

#include "level/level.hpp"

namespace pnpbs {

// Nodes that d asks for in each leaf of ours. Collective.
template <int Dim>
std::vector<double> wanted_nodes(const Level<Dim>& level);
// In all. Collective.
template <int Dim>
double expected_nodes(const Level<Dim>& level);

struct SpacingVariation {
  double min = kFarAway, max = 0;
  double steepest = 0;  // growth of d per unit of length
};

// Collective.
template <int Dim>
SpacingVariation spacing_variation(const Level<Dim>& level);

}  // namespace pnpbs
