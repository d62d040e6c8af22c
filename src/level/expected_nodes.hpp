// SPDX-License-Identifier: BSD-3-Clause
// Estimates from the samples of d in the leaves of a level's tree: the number of nodes, and how d
// varies.
#pragma once

#include <vector>

#include "level/level.hpp"

namespace pnpbs {

// Returns the number of nodes that d requires in each leaf, 0 in leaves of other ranks. Collective.
template <int Dim>
std::vector<double> wanted_nodes(const Level<Dim>& level);
// Returns their sum over all ranks. Collective.
template <int Dim>
double expected_nodes(const Level<Dim>& level);

// The range of d in the domain, and its largest growth.
struct SpacingVariation {
  double min = kFarAway, max = 0;
  double steepest = 0;  // largest growth of d per unit of length
};

// Measures d over all ranks. Collective.
template <int Dim>
SpacingVariation spacing_variation(const Level<Dim>& level);

}  // namespace pnpbs
