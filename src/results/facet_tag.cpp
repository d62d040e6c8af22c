// SPDX-License-Identifier: BSD-3-Clause
#include "results/facet_tag.hpp"

#include <algorithm>
#include <vector>

#include "domain/volume/boundary_tag.hpp"

namespace pnpbs {

namespace {

// Returns the patches that meet at node i. There are none at a free node, which can be on the
// boundary of the tetrahedra where triangles of the surface are missing.
std::vector<std::int32_t> patches_at(const Level<3>& level, std::int64_t i) {
  std::vector<std::int32_t> patches;
  if (level.nodes.carrier(i) == Carrier::free) return patches;
  level.geometry.surface().for_sides(
      level.geometry.place(level.nodes.carrier(i), level.nodes.boundary_node(i)),
      [&](const SurfaceSide& side) { patches.push_back(side.patch); });
  return patches;
}

}  // namespace

std::vector<std::int32_t> common_patches(const Level<3>& level,
                                         std::span<const std::int64_t> nodes) {
  std::vector<std::int32_t> common = patches_at(level, nodes[0]);
  std::ranges::sort(common);
  common.erase(std::unique(common.begin(), common.end()), common.end());
  for (const std::int64_t i : nodes.subspan(1)) {
    const std::vector<std::int32_t> there = patches_at(level, i);
    std::erase_if(
        common, [&](std::int32_t patch) { return std::ranges::find(there, patch) == there.end(); });
  }
  return common;
}

std::int32_t facet_tag(const Level<3>& level, const std::array<std::int64_t, 3>& nodes) {
  const Nodes<3>& all = level.nodes;
  std::array<std::int64_t, 3> by_id = nodes;
  std::ranges::sort(by_id, {}, [&](std::int64_t i) { return all.id(i); });
  for (const std::int64_t i : by_id)
    if (all.carrier(i) == Carrier::surface)
      return level.geometry.boundary().facets[static_cast<std::size_t>(all.boundary_node(i))].tag;
  FacetCorners<3> corners;
  for (std::size_t k = 0; k < 3; ++k) corners[k] = all.position(nodes[k]);
  return boundary_tag(level.geometry.domain(), corners, common_patches(level, nodes));
}

}  // namespace pnpbs
