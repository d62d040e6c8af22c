// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/plane/incident_sectors.hpp"

#include <algorithm>

#include "predicates/plane.hpp"

namespace pnpbs {

namespace {

// Returns 0 for directions in [0, 180) degrees from `centre` and 1 for the others.
int half(const Point<2>& centre, const Point<2>& x) {
  if (x[1] != centre[1]) return x[1] > centre[1] ? 0 : 1;
  return x[0] > centre[0] ? 0 : 1;
}

// Returns a positive number if direction a comes before b, counter-clockwise from the positive x
// axis, a negative one if after, and 0 if they are equal.
int before(const Point<2>& centre, const Point<2>& a, const Point<2>& b) {
  const int half_a = half(centre, a), half_b = half(centre, b);
  return half_a != half_b ? half_b - half_a : orientation(centre, a, b);
}

}  // namespace

void IncidentSectors::build(const BoundaryMesh<2>& boundary) {
  const auto position = [&](std::int32_t n) {
    return boundary.nodes[static_cast<std::size_t>(n)].position;
  };
  offset_.assign(boundary.nodes.size() + 1, 0);
  for (const BoundaryEdge& e : boundary.facets) {
    if (e.begin == e.end) continue;  // A fixed node has no sectors.
    ++offset_[static_cast<std::size_t>(e.begin) + 1];
    ++offset_[static_cast<std::size_t>(e.end) + 1];
  }
  for (std::size_t n = 0; n < boundary.nodes.size(); ++n) offset_[n + 1] += offset_[n];
  edges_.resize(static_cast<std::size_t>(offset_.back()));
  std::vector<std::int32_t> next(offset_.begin(), offset_.end() - 1);
  for (std::size_t k = 0; k < boundary.facets.size(); ++k) {
    const BoundaryEdge& e = boundary.facets[k];
    if (e.begin == e.end) continue;
    const std::int32_t index = static_cast<std::int32_t>(k);
    edges_[static_cast<std::size_t>(next[static_cast<std::size_t>(e.begin)]++)] = {e.end, index,
                                                                                   e.left_inside};
    edges_[static_cast<std::size_t>(next[static_cast<std::size_t>(e.end)]++)] = {e.begin, index,
                                                                                 e.right_inside};
  }
  for (std::size_t n = 0; n < boundary.nodes.size(); ++n) {
    const Point<2> centre = boundary.nodes[n].position;
    std::sort(edges_.begin() + offset_[n], edges_.begin() + offset_[n + 1],
              [&](const SectorEdge& a, const SectorEdge& b) {
                return before(centre, position(a.other), position(b.other)) > 0;
              });
  }
}

bool IncidentSectors::joined(std::int32_t a, std::int32_t b) const {
  for (std::int32_t k = begin(a); k < end(a); ++k)
    if (edge(k).other == b) return true;
  return false;
}

IncidentSectors::Sectors IncidentSectors::sectors_towards(const BoundaryMesh<2>& boundary,
                                                          std::int32_t node,
                                                          const Point<2>& x) const {
  const Point<2> centre = boundary.nodes[static_cast<std::size_t>(node)].position;
  // Finds the last edge that is not after the direction of x. A direction before the first edge
  // lies in the sector of the last one.
  std::int32_t sector = end(node) - 1;
  for (std::int32_t k = begin(node); k < end(node); ++k) {
    const Point<2>& far = boundary.nodes[static_cast<std::size_t>(edge(k).other)].position;
    const int x_before = before(centre, x, far);
    if (x_before == 0) return {k, k > begin(node) ? k - 1 : end(node) - 1};
    if (x_before > 0) break;
    sector = k;
  }
  return {sector, sector};
}

bool IncidentSectors::leads_inside(const BoundaryMesh<2>& boundary, std::int32_t node,
                                   const Point<2>& x) const {
  if (begin(node) == end(node)) return true;
  const Sectors sectors = sectors_towards(boundary, node, x);
  return edge(sectors.after).inside_after || edge(sectors.before).inside_after;
}

bool IncidentSectors::lets_pass(const BoundaryMesh<2>& boundary, std::int32_t node,
                                const Point<2>& x, const Point<2>& y) const {
  if (begin(node) == end(node)) return true;
  const Sectors from = sectors_towards(boundary, node, x), to = sectors_towards(boundary, node, y);
  for (const std::int32_t sector : {from.after, from.before})
    if ((sector == to.after || sector == to.before) && edge(sector).inside_after) return true;
  return false;
}

}  // namespace pnpbs
