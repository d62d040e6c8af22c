// SPDX-License-Identifier: BSD-3-Clause
#include "level/plane/elements_on_boundary.hpp"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "base/execution.hpp"
#include "base/found_indices.hpp"

namespace pnpbs {

namespace {

using Corners = DelaunayStars::Corners;

// A whole sphere has no boundary: that of its patch is none of the domain.
bool is_on_boundary(const Level<2>& level, std::int64_t i) {
  const std::int32_t b = level.nodes.boundary_node(i);
  return b >= 0 && !level.geometry.domain().is_whole_sphere() && level.geometry.bounds_domain_at(b);
}

// Calls visit(corners) for the elements around node i with all nodes on the boundary.
template <class Visit>
void for_elements_on_boundary(const Level<2>& level, std::int64_t i, const Visit& visit) {
  if (!level.nodes.owned(i) || !is_on_boundary(level, i)) return;
  level.stars.for_simplices(i, [&](const Corners& others) {
    if (is_on_boundary(level, others[0]) && is_on_boundary(level, others[1])) visit(others);
  });
}

// Ends of an edge, the one with the smaller id first; -1 if there is no edge.
using Edge = std::array<std::int64_t, 2>;

// Returns the longest edge of an element that is on no curve, the last of equals by id.
Edge longest_inner_edge(const Level<2>& level, const std::array<std::int64_t, 3>& corners) {
  const Nodes<2>& nodes = level.nodes;
  std::tuple<double, std::int64_t, std::int64_t> longest{-1, -1, -1};
  Edge edge{-1, -1};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [i, j] = std::minmax(corners[k], corners[(k + 1) % 3],
                                    [&](auto a, auto b) { return nodes.id(a) < nodes.id(b); });
    if (level.geometry.on_one_edge(nodes, i, j)) continue;
    const std::tuple length{squared_distance<2>(nodes.position(i), nodes.position(j)), nodes.id(i),
                            nodes.id(j)};
    if (length > longest) longest = length, edge = {i, j};
  }
  return edge;
}

}  // namespace

std::int64_t elements_on_boundary(const Level<2>& level) {
  const Nodes<2>& nodes = level.nodes;
  const auto own = sum_of("pnpbs::elements_on_boundary", nodes.count, [&](std::int64_t i) {
    std::int64_t count = 0;
    for_elements_on_boundary(level, i, [&](const Corners& others) {
      count += nodes.id(i) < std::min(nodes.id(others[0]), nodes.id(others[1]));
    });
    return count;
  });
  return static_cast<std::int64_t>(level.comm->allreduce_sum(own));
}

PopulationChange<2> nodes_in_elements_on_boundary(const Level<2>& level) {
  const Nodes<2>& nodes = level.nodes;
  // An edge of two elements is found twice.
  const auto other_ends = [&](std::int64_t i) {
    std::vector<std::int64_t> ends;
    for_elements_on_boundary(level, i, [&](const Corners& others) {
      const auto [first, second] = longest_inner_edge(level, {i, others[0], others[1]});
      if (first == i && std::ranges::find(ends, second) == ends.end()) ends.push_back(second);
    });
    return ends;
  };
  PopulationChange<2> change;
  for (const std::int64_t i : indices_where("pnpbs::nodes_in_elements_on_boundary", nodes.count,
                                            [&](std::int64_t k) { return !other_ends(k).empty(); }))
    for (const std::int64_t j : other_ends(i)) {
      const Point<2> a = nodes.position(i), b = nodes.position(j);
      change.born.push_back({{0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])}, nodes.id(i), nodes.d(i)});
      change.parents.push_back(static_cast<std::int32_t>(i));
    }
  return change;
}

}  // namespace pnpbs
