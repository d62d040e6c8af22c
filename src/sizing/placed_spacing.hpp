// SPDX-License-Identifier: BSD-3-Clause
// The spacing with which a level is placed.
#pragma once

#include <cstdint>
#include <vector>

#include "spacing/sizing_field.hpp"
#include "spacing/steepest_growth.hpp"

namespace pnpbs {

// Where the spacing is held down, since there the elements of an earlier round did not fill the
// domain, or had small angles.
template <int Dim>
struct LocalReduction {
  std::vector<GrowthSource<Dim>> places;
  std::int64_t rounds = 0;
  // Of the round before the first of these: its nodes, and the least d at the places it left.
  std::int64_t start_nodes = 0;
  double least_before = 0;
  std::int64_t expected_nodes = 0;  // of the last of these rounds, before it began
};

// The spacing as it counts, the places where it is held down, and how steep it is without these
// where the user sets no limit.
template <int Dim>
struct PlacedSpacing {
  SizingField<Dim> d;
  LocalReduction<Dim> held;
  SteepestGrowth<Dim> steepest;
  bool steepest_is_known = false;  // from a checkpoint: it is not measured again
  double count_factor = 1;         // on d, by the number of nodes that a run came to before
};

}  // namespace pnpbs
