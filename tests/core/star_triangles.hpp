// SPDX-License-Identifier: BSD-3-Clause
// The triangles of a level's stars, and invariants that hold for any nodes.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "level_run.hpp"
#include "predicates/plane.hpp"
#include "quick_assert.hpp"

// Three indices of nodes in increasing order.
using Triangle = std::array<std::int64_t, 3>;

inline Triangle sorted(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

// Returns the index of each boundary node.
inline std::vector<std::int64_t> boundary_places(const pnpbs::Level<2>& level) {
  std::vector<std::int64_t> places(level.geometry.boundary().nodes.size(), -1);
  for (std::int64_t i = 0; i < level.nodes.count; ++i)
    if (!level.nodes.moves(i)) places[static_cast<std::size_t>(level.nodes.boundary_node(i))] = i;
  return places;
}

// Returns the triangles. Expects that each is counter-clockwise and in the stars of all three
// corners, and that every boundary edge is in the stars of its ends.
inline std::vector<Triangle> star_triangles(const pnpbs::Level<2>& level) {
  const pnpbs::Nodes<2>& nodes = level.nodes;
  std::map<Triangle, int> found;
  for (std::int64_t i = 0; i < nodes.count; ++i)
    level.stars.for_simplices(i, [&](const pnpbs::DelaunayStars::Corners& others) {
      const std::int64_t j = others[0], k = others[1];
      quick_assert_msg(
          pnpbs::orientation(nodes.position(i), nodes.position(j), nodes.position(k)) > 0,
          "a triangle of node %lld at (%.17g, %.17g) is flat or turned over",
          static_cast<long long>(nodes.id(i)), nodes.x[0](i), nodes.x[1](i));
      ++found[sorted({i, j, k})];
    });
  std::vector<Triangle> triangles;
  for (const auto& [t, times] : found) {
    quick_assert_msg(times == 3, "triangle (%.17g, %.17g) (%.17g, %.17g) (%.17g, %.17g): %d stars",
                     nodes.x[0](t[0]), nodes.x[1](t[0]), nodes.x[0](t[1]), nodes.x[1](t[1]),
                     nodes.x[0](t[2]), nodes.x[1](t[2]), times);
    triangles.push_back(t);
  }
  const std::vector<std::int64_t> places = boundary_places(level);
  for (const pnpbs::BoundaryEdge& e : level.geometry.boundary().facets) {
    if (e.begin == e.end) continue;
    const std::int64_t a = places[static_cast<std::size_t>(e.begin)];
    const std::int64_t b = places[static_cast<std::size_t>(e.end)];
    for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, a}}) {
      bool there = false;
      level.stars.for_neighbours(from, [&, to = to](std::int64_t j) { there = there || j == to; });
      quick_assert_msg(there, "a boundary edge is missing at (%.17g, %.17g)", nodes.x[0](from),
                       nodes.x[1](from));
    }
  }
  return triangles;
}
