// SPDX-License-Identifier: BSD-3-Clause
#include "domain/clearance.hpp"

#include <algorithm>
#include <limits>

#include "domain/segments.hpp"
#include "predicates/plane.hpp"

namespace pnpbs {

namespace {

double nearest_edge(const DomainMap& map, std::span<const std::int32_t> edges, const Point<2>& x,
                    Point<2>& nearest) {
  double least = std::numeric_limits<double>::infinity();
  for (std::int32_t e : edges) {
    const Point<2> q = nearest_on_segment(map.edge_begin(e), map.edge_end(e), x);
    const double gap = distance<2>(q, x);
    if (gap < least) {
      least = gap;
      nearest = q;
    }
  }
  return least;
}

bool crosses_any(const DomainMap& map, std::span<const std::int32_t> edges, const Point<2>& from,
                 const Point<2>& to) {
  for (std::int32_t e : edges) {
    const Point<2>&a = map.edge_begin(e), &b = map.edge_end(e);
    if (orientation(a, b, from) * orientation(a, b, to) <= 0 &&
        orientation(from, to, a) * orientation(from, to, b) <= 0)
      return true;
  }
  return false;
}

// Is every edge farther from `to` than `wanted`, and too far to be met on the way there?
bool clear_of_all(const DomainMap& map, std::span<const std::int32_t> edges, const Point<2>& from,
                  const Point<2>& to, double wanted) {
  constexpr double kRounding = 1 + 1e-9;
  double square = wanted * wanted, way = 0;
  for (int k = 0; k < 2; ++k) way += (to[k] - from[k]) * (to[k] - from[k]);
  square = kRounding * std::max(square, way);
  for (std::int32_t e : edges)
    if (squared_distance_to_segment(map.edge_begin(e), map.edge_end(e), to) < square) return false;
  return true;
}

}  // namespace

ClearPosition clear_position(const DomainMap& map, std::span<const std::int32_t> edges,
                             const Point<2>& from, const Point<2>& to, double d) {
  const double wanted = kBoundaryClearance * d;
  if (clear_of_all(map, edges, from, to, wanted)) return {to, true};  // nearly always
  Point<2> x = crosses_any(map, edges, from, to) ? from : to;
  Point<2> wall{};
  double gap = nearest_edge(map, edges, x, wall);
  for (int round = 0; round < 3 && gap < wanted && gap > 0; ++round) {
    const double stretch = wanted / gap;
    const Point<2> away{wall[0] + (x[0] - wall[0]) * stretch, wall[1] + (x[1] - wall[1]) * stretch};
    if (crosses_any(map, edges, x, away)) break;
    x = away;
    gap = nearest_edge(map, edges, x, wall);
  }
  return {x, gap >= kLeastClearance * d};
}

}  // namespace pnpbs
