// SPDX-License-Identifier: BSD-3-Clause
// Thinning nodes that are many times too dense for d, because d has grown since they were placed or
// because they were given so: contests would take long to delete them.
#pragma once

#include <cstdint>
#include <vector>

#include "base/lattice.hpp"
#include "initial/incoming_nodes.hpp"
#include "level/level.hpp"
#include "method/constants.hpp"

namespace pnpbs {

// The spacing that a new node counts as placed for, which comes with so many others in the place of
// one in M dimensions, where the spacing was `before` and will be d: as many of them should stay.
// If that is most of them all do: the spacing may have been another where the node was before.
template <int M>
double placed_for(double before, double d, double new_nodes) {
  const double share = (power<M>(before / d) - 1) / new_nodes;
  return share > method::kMostStay ? d : d * root<M>(share);
}

// Of nodes inside, sorted by place; `begin` is each leaf's first. Collective.
template <int Dim>
void thin(const Level<Dim>& level, IncomingNodes<Dim>& inner,
          const std::vector<std::int32_t>& begin);

// Of this rank's nodes on surfaces, which it owns. Sorts them by place. Collective.
void thin_on_surfaces(const Level<3>& level, IncomingNodes<3>& on_surfaces);

}  // namespace pnpbs
