// SPDX-License-Identifier: BSD-3-Clause
#include "level/plane/closed_sphere.hpp"

#include <algorithm>
#include <vector>

#include "predicates/plane.hpp"

namespace pnpbs {

// The stars of the three rim nodes are open only because the chart has no triangle around the
// domain. As nothing else bounds the sphere, closing these stars completes the triangulation.
void close_sphere(Level<2>& level) {
  if (!is_closed_sphere(level)) return;
  using Entry = DelaunayStars::Entry;
  std::vector<char> open(static_cast<std::size_t>(level.nodes.count), 0);
  for (std::int64_t i = 0; i < level.nodes.count; ++i)
    open[static_cast<std::size_t>(i)] = level.stars.size(i) > 0 && !level.stars.closed(i);
  level.stars.rewrite(open, [&](std::int64_t i) {
    std::vector<Entry> star;
    level.stars.for_neighbours_in_order(i, [&](std::int64_t j, bool) {
      star.push_back({j, true});
    });
    return star;
  });
}

namespace {

template <class Visit>
void for_nodes_in_margin(const Level<2>& level, const Visit& visit) {
  const PlaneDomain& domain = level.geometry.domain();
  for_each("pnpbs::for_nodes_in_margin", level.nodes.count, [&](std::int64_t i) {
    if (domain.is_in_margin(level.nodes.position(i))) visit(i);
  });
}

}  // namespace

void free_margin(Level<2>& level) {
  if (!is_closed_sphere(level)) return;
  Nodes<2>& nodes = level.nodes;
  for_nodes_in_margin(level, [&](std::int64_t i) {
    nodes.carrier(i) = nodes.moving;
    nodes.boundary_node(i) = -1;
  });
  level.margin = PatchMargin::free;
}

void hold_margin(Level<2>& level) {
  if (level.margin != PatchMargin::free) return;
  Nodes<2>& nodes = level.nodes;
  for_nodes_in_margin(level, [&](std::int64_t i) {
    nodes.carrier(i) = Carrier::fixed;
    for (int k = 0; k < 2; ++k) nodes.v[k](i) = 0;
  });
  nodes.moved();
  level.ghosts.invalidate();
  level.margin = PatchMargin::held;
}

void recognise_margin(Level<2>& level) {
  if (!is_closed_sphere(level)) return;
  const PlaneDomain& domain = level.geometry.domain();
  const Nodes<2>& nodes = level.nodes;
  const auto any = [&](const auto& is_so) {
    const std::uint64_t here = sum_of("pnpbs::recognise_margin", nodes.count, [&](std::int64_t i) {
      return domain.is_in_margin(nodes.position(i)) && is_so(i);
    });
    return level.comm->allreduce_sum(here) > 0;
  };
  level.margin = any([&](std::int64_t i) { return nodes.boundary_node(i) >= 0; })
                     ? PatchMargin::laid
                 : any([&](std::int64_t i) { return !nodes.moves(i); }) ? PatchMargin::held
                                                                        : PatchMargin::free;
}

// As seen from outside, all triangles of the sphere are counter-clockwise. The chart reverses the
// orientation of this triangle alone.
bool closes_sphere(const Level<2>& level, const std::array<std::int64_t, 3>& corners) {
  if (!is_closed_sphere(level)) return false;
  std::array<Point<2>, 3> x;
  for (std::size_t k = 0; k < 3; ++k) x[k] = level.nodes.position(corners[k]);
  const auto is_on_rim = [&](std::int64_t i) {
    const std::int32_t b = level.nodes.boundary_node(i);
    return b >= 0 && level.geometry.bounds_domain_at(b);
  };
  return std::ranges::all_of(corners, is_on_rim) && orientation(x[0], x[1], x[2]) < 0;
}

}  // namespace pnpbs
