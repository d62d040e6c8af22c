// SPDX-License-Identifier: BSD-3-Clause
#include "placement/node_normal.hpp"

#include "base/space_vectors.hpp"

namespace pnpbs {

Point<3> node_normal(const Level<3>& level, std::int64_t i) {
  constexpr double kAgainst = 1e-6;  // the length of what is left of unit vectors that cancel
  Point<3> sum{};
  if (level.nodes.carrier(i) == Carrier::free) return sum;
  level.ground.surface().for_sides(
      level.ground.place(level.nodes.carrier(i), level.nodes.boundary_node(i)),
      [&](const SurfaceSide& side) { sum = shifted(sum, 1, side.normal); });
  return length(sum) > kAgainst ? unit_vector(sum) : Point<3>{};
}

}  // namespace pnpbs
