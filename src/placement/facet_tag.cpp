// SPDX-License-Identifier: BSD-3-Clause
#include "placement/facet_tag.hpp"

#include <algorithm>

namespace pnpbs {

NearestPoint<3> nearest_on_boundary(const Level<3>& level, const Point<3>& x, double d) {
  // Not far as a rule, and there may be many facets to a d.
  constexpr double kFirst = 1. / 64;
  const SurfaceIndex& facets = level.ground.domain().index();
  NearestPoint<3> nearest;
  for (double reach = kFirst * d; nearest.facet < 0; reach *= 2) nearest = facets.nearest(x, reach);
  return nearest;
}

std::int32_t facet_tag(const Level<3>& level, std::array<std::int64_t, 3> nodes) {
  const Nodes<3>& all = level.nodes;
  std::ranges::sort(nodes, {}, [&](std::int64_t i) { return all.id(i); });
  Point<3> middle{};
  double d = 0;
  for (const std::int64_t i : nodes) {
    if (all.carrier(i) == Carrier::surface) {
      const auto triangle = static_cast<std::size_t>(all.boundary_node(i));
      return level.ground.boundary().facets[triangle].tag;
    }
    for (std::size_t k = 0; k < 3; ++k) middle[k] += all.x[k](i) / 3;
    d = std::max(d, all.d(i));
  }
  const std::int32_t facet = nearest_on_boundary(level, middle, d).facet;
  return level.ground.boundary().facets[static_cast<std::size_t>(facet)].tag;
}

}  // namespace pnpbs
