// SPDX-License-Identifier: BSD-3-Clause
// A spacing made of the nodes there are and values at them.
#include <algorithm>

#include "base/error.hpp"
#include "placement/placement.hpp"
#include "spacing/nodal_spacing.hpp"

namespace pnpbs {

namespace {

// Edges of stars beside a gap, each at the owner of its node with the lesser id.
template <class Visit>
void for_rim_edges(const Placement& placement, const Visit& visit) {
  const Level& level = placement.level();
  const Nodes<2>& nodes = level.nodes;
  std::vector<std::pair<std::int64_t, bool>> star;
  for (std::int64_t p = 0; p < placement.count(); ++p) {
    const std::int64_t i = placement.node_at(p);
    star.clear();
    level.stars.for_neighbours_in_order(
        i, [&](std::int64_t j, bool triangle) { star.emplace_back(j, triangle); });
    for (std::size_t k = 0; k < star.size(); ++k) {
      const bool closed = star[k].second && star[k > 0 ? k - 1 : star.size() - 1].second;
      if (!closed && nodes.id(i) < nodes.id(star[k].first))
        visit(p, placement.place_of(star[k].first));
    }
  }
}

}  // namespace

std::shared_ptr<const Spacing<2>> Placement::spacing_from(std::vector<double> values) {
  const auto ids = [this] {
    std::vector<std::int64_t> all;
    for (std::int64_t p = 0; p < count(); ++p) all.push_back(level_->nodes.id(node_at(p)));
    return all;
  };
  prepare_order();
  const std::vector<std::int64_t> before = ids();
  prepare_stars();
  if (ids() != before)
    throw Error(ErrorKind::state,
                "nodes have changed their ranks since the computation before failed: ask for the "
                "nodes again, and give the values at them");
  const Nodes<2>& nodes = level_->nodes;
  values.resize(static_cast<std::size_t>(nodes.count));
  fill_ghosts(*comm_, exchange_pattern(), values);

  Patch<2> patch;
  for (std::int64_t p = 0; p < nodes.count; ++p) {
    const std::int64_t i = node_at(p);
    patch.nodes.push_back({nodes.position(i), nodes.id(i), values[static_cast<std::size_t>(p)]});
  }
  const auto row = [&](auto... places) {
    std::array<std::int32_t, sizeof...(places)> corners{static_cast<std::int32_t>(places)...};
    std::sort(corners.begin(), corners.end(), [&](std::int32_t a, std::int32_t b) {
      return patch.nodes[static_cast<std::size_t>(a)].id <
             patch.nodes[static_cast<std::size_t>(b)].id;
    });
    return corners;
  };
  for_triangles([&](auto a, auto b, auto c) { patch.simplices.push_back(row(a, b, c)); });
  for_rim_edges(*this, [&](auto a, auto b) { patch.border.push_back(row(a, b)); });
  return std::make_shared<NodalSpacing<2>>(comm_, std::move(patch));
}

}  // namespace pnpbs
