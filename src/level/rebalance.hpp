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
// Repartitions before a phase that has work at few of the nodes, so that this work is balanced as
// well. `rare_work` has the work of the phase for each node of the rank; the entries of ghosts are
// not used. Does nothing if the work is balanced (option rebalance_above), or is too little, or if
// no much better partition is found. Otherwise there are no ghosts, lists and stars afterwards, and
// the stars are stored for the next search. All ranks must call it, and if one rank throws, all
// ranks throw.
template <int Dim>
void rebalance_for(Level<Dim>& level, const View<std::int64_t>& rare_work);

}  // namespace pnpbs
