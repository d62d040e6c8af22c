// SPDX-License-Identifier: BSD-3-Clause
// The thinning of nodes that are many times too dense for d, because d has grown since they were
// placed or because the user gave them so. Contests would take long to delete them.
#pragma once

#include <cstdint>
#include <vector>

#include "base/lattice.hpp"
#include "initial/incoming_nodes.hpp"
#include "level/level.hpp"
#include "method/constants.hpp"

namespace pnpbs {

// Returns the spacing that a new node counts as placed for. Refinement adds new_nodes of them per
// old node in M dimensions, where the spacing was `before` and will be d. Thinning then keeps as
// many of them as d requires. If that is most of them, all are kept, because the spacing may have
// been different at the old node.
template <int M>
double placed_for(double before, double d, double new_nodes) {
  const double share = (power<M>(before / d) - 1) / new_nodes;
  return share > method::kMostStay ? d : d * root<M>(share);
}

// Thins inner nodes, sorted by sort_by_leaf(). `begin` has the first index of each leaf. All ranks
// must call it, and if one rank throws, all ranks throw.
template <int Dim>
void thin(const Level<Dim>& level, IncomingNodes<Dim>& inner,
          const std::vector<std::int32_t>& begin);

// Thins nodes on surfaces that this rank owns, and sorts them by sort_by_leaf(). All ranks must
// call it, and if one rank throws, all ranks throw.
void thin_on_surfaces(const Level<3>& level, IncomingNodes<3>& on_surfaces);

}  // namespace pnpbs
