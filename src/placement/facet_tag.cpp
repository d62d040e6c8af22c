// SPDX-License-Identifier: BSD-3-Clause
#include "placement/facet_tag.hpp"

#include <algorithm>
#include <limits>

namespace pnpbs {

std::int32_t facet_tag(const Level<3>& level, std::array<std::int64_t, 3> nodes) {
  const Nodes<3>& all = level.nodes;
  std::ranges::sort(nodes, {}, [&](std::int64_t i) { return all.id(i); });
  constexpr double kAnywhere = std::numeric_limits<double>::infinity();
  Point<3> middle{};
  for (const std::int64_t i : nodes) {
    if (all.carrier(i) == Carrier::surface) {
      const auto triangle = static_cast<std::size_t>(all.boundary_node(i));
      return level.ground.boundary().facets[triangle].tag;
    }
    for (std::size_t k = 0; k < 3; ++k) middle[k] += all.x[k](i) / 3;
  }
  const std::int32_t facet = level.ground.domain().index().nearest(middle, kAnywhere).facet;
  return level.ground.boundary().facets[static_cast<std::size_t>(facet)].tag;
}

}  // namespace pnpbs
