// SPDX-License-Identifier: BSD-3-Clause
// Initial inner nodes (section 2.1 of the paper): a hexagonal lattice, that is rhombic cells of 60
// and 120 degrees. Where d varies, patches of the background tree over which it is nearly constant
// each have their own lattice, all of one orientation and anchored in one point.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "spacing/domain_map.hpp"

namespace pnpbs {

// d may vary by this factor within a patch.
inline constexpr double kPatchVariation = 1.08;
// New nodes stay this many d away from the boundary.
inline constexpr double kFillClearance = 0.5;

// d in a cell of the tree, put together from its leaves.
struct SpacingSummary {
  double min = std::numeric_limits<double>::infinity();
  double max = 0;
  double area = 0, nodes = 0;  // of the leaves in the domain; nodes in units of 1 per d^2

  void add(const SpacingSummary& part);
  double spacing() const { return std::sqrt(area / nodes); }
};

// What is known of a leaf at which the tree ends before it is fine enough.
struct LeafSummary {
  std::int32_t leaf;
  SpacingSummary spacing;
};

// Of every cell of the tree, from the leaves up.
std::vector<SpacingSummary> spacing_summaries(const DomainMap<2>& map,
                                              const std::vector<LeafSummary>& unrefined);

// Of the leaves for which wanted(leaf) holds and that are not steep, in their Morton order.
std::vector<Point<2>> hexagonal_fill(const DomainMap<2>& map, const Box<2>& bounds,
                                     const std::function<bool(std::int32_t)>& wanted,
                                     const std::vector<LeafSummary>& unrefined = {});

}  // namespace pnpbs
