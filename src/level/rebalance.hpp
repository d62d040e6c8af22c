// SPDX-License-Identifier: BSD-3-Clause
// The balance of work between the ranks of a level.
#pragma once

#include "level/level.hpp"

namespace pnpbs {

// Largest over mean of the work that ranks own, as it was counted after the last event. Collective.
template <int Dim>
double imbalance_of(const Level<Dim>& level);

// Another partition, by the work counted; the nodes migrate. Collective.
template <int Dim>
void rebalance(Level<Dim>& level);

}  // namespace pnpbs
