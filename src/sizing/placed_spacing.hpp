// SPDX-License-Identifier: BSD-3-Clause
// The spacing with which a level is placed, with its local reductions.
#pragma once

#include <cstdint>
#include <vector>

#include "spacing/sizing_field.hpp"
#include "spacing/steepest_growth.hpp"

namespace pnpbs {

// Local reductions of d, at points where elements of an earlier round did not fill the domain or
// had small angles.
template <int Dim>
struct LocalReduction {
  std::vector<GrowthSource<Dim>> places;
  std::int64_t rounds = 0;
  // Number of nodes of the run before the first reduction, and the smallest d at the points where
  // it failed.
  std::int64_t start_nodes = 0;
  double least_before = 0;
  std::int64_t expected_nodes = 0;  // expected for the last round before it began
};

// The effective spacing, its local reductions, and its steepest growth without these if the user
// sets no limit.
template <int Dim>
struct PlacedSpacing {
  SizingField<Dim> d;
  LocalReduction<Dim> held;
  SteepestGrowth<Dim> steepest;
  bool steepest_is_known = false;  // read from a checkpoint, not measured again
  // Factor on d that corrects the estimated number of nodes by that of an earlier run.
  double count_factor = 1;
};

}  // namespace pnpbs
