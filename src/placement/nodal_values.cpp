// SPDX-License-Identifier: BSD-3-Clause
// A spacing made of the nodes there are and values at them.
#include <algorithm>
#include <array>
#include <type_traits>

#include "base/error.hpp"
#include "placement/placement_of.hpp"
#include "spacing/nodal_spacing.hpp"

namespace pnpbs {

namespace {

// Calls visit(places) for the facets of stars beside a gap, each at the owner of its node with the
// least id.
template <class Visit>
void for_rim_facets(const PlacementOf<2>& placement, const Visit& visit) {
  const Level<2>& level = placement.level();
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
        visit(std::array<std::int64_t, 2>{p, placement.place_of(star[k].first)});
    }
  }
}

template <class Visit>
void for_rim_facets(const PlacementOf<3>& placement, const Visit& visit) {
  placement.for_open_facets([&](const std::array<std::int64_t, 3>& places) { visit(places); });
}

}  // namespace

template <int Dim>
std::shared_ptr<const Spacing<Dim>> PlacementOf<Dim>::spacing_from(std::vector<double> values) {
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
  const Nodes<Dim>& nodes = level_->nodes;
  values.resize(static_cast<std::size_t>(nodes.count));
  fill_ghosts(*comm_, *exchange_pattern(), values);

  Patch<Dim> patch;
  for (std::int64_t p = 0; p < nodes.count; ++p) {
    const std::int64_t i = node_at(p);
    patch.nodes.push_back({nodes.position(i), nodes.id(i), values[static_cast<std::size_t>(p)]});
  }
  const auto row = [&](const auto& places) {
    std::array<std::int32_t, std::tuple_size_v<std::decay_t<decltype(places)>>> corners;
    std::copy(places.begin(), places.end(), corners.begin());
    std::sort(corners.begin(), corners.end(), [&](std::int32_t a, std::int32_t b) {
      return patch.nodes[static_cast<std::size_t>(a)].id <
             patch.nodes[static_cast<std::size_t>(b)].id;
    });
    return corners;
  };
  for_elements([&](const auto& places) { patch.simplices.push_back(row(places)); });
  for_rim_facets(*this, [&](const auto& places) { patch.border.push_back(row(places)); });
  return std::make_shared<NodalSpacing<Dim>>(comm_, std::move(patch));
}

// Of the members defined here.
template class PlacementOf<2>;
template class PlacementOf<3>;

}  // namespace pnpbs
