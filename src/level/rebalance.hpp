// SPDX-License-Identifier: BSD-3-Clause
// The balance of the work between the ranks of a level.
#pragma once

#include "level/level.hpp"

namespace pnpbs {

// Returns the largest over the mean of the work of the ranks, as counted after the last event.
// Collective.
template <int Dim>
double imbalance_of(const Level<Dim>& level);

// Repartitions by the counted work and migrates the nodes. All ranks must call it, and if one rank
// throws, all ranks throw.
template <int Dim>
void rebalance(Level<Dim>& level);

}  // namespace pnpbs
