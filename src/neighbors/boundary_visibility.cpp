// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/boundary_visibility.hpp"

#include <algorithm>

namespace pnpbs {

namespace {

// Returns the boundary nodes at the ends of the edges near x, sorted.
std::vector<std::int32_t> boundary_nodes_near(const SizedTree<2>& map, const Point<2>& x,
                                              double reach) {
  std::vector<std::int32_t> near;
  map.for_facets_near(x, reach, [&](std::int32_t e) {
    for (const std::int32_t node : {map.facet(e).begin, map.facet(e).end}) near.push_back(node);
  });
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  return near;
}

// Returns true if the sorted row contains the number. On a fine boundary the numbers are mostly
// consecutive, which the first test exploits.
bool holds(const std::vector<std::int32_t>& row, std::int32_t number) {
  const std::int64_t place = std::int64_t{number} - row.front();
  if (0 <= place && place < std::ssize(row) && row[static_cast<std::size_t>(place)] == number)
    return true;
  return std::binary_search(row.begin(), row.end(), number);
}

}  // namespace

void BoundaryVisibility::reset(std::size_t boundary_nodes) {
  seen_.assign(boundary_nodes, {});
  reach_.assign(boundary_nodes, 0);
}

void BoundaryVisibility::look(const Nodes<2>& nodes, const NearEdges& near_edges,
                              const SizedTree<2>& map, const IncidentSectors& sectors) {
  constexpr std::int64_t kChunk = 256;
  const std::int64_t chunks = (nodes.count + kChunk - 1) / kChunk;
  for_each("pnpbs::BoundaryVisibility::look", chunks, [&](std::int64_t chunk) {
    const std::int64_t last = std::min((chunk + 1) * kChunk, nodes.count);
    for (std::int64_t i = chunk * kChunk; i < last; ++i)
      if (nodes.boundary_node(i) >= 0) look_from(nodes, i, near_edges, map, sectors);
  });
}

void BoundaryVisibility::look_from(const Nodes<2>& nodes, std::int64_t i,
                                   const NearEdges& near_edges, const SizedTree<2>& map,
                                   const IncidentSectors& sectors) {
  constexpr double kRounding = 1 + 1e-9;
  const std::int32_t b = nodes.boundary_node(i);
  const auto index = static_cast<std::size_t>(b);
  const double reach = near_edges.radius() * nodes.d(i);
  if (reach_[index] == reach) return;
  const Point<2> x = nodes.position(i);
  std::vector<std::int32_t> seen = boundary_nodes_near(map, x, kRounding * reach);
  std::erase_if(seen, [&](std::int32_t c) {
    const Point<2>& y = map.boundary().nodes[static_cast<std::size_t>(c)].position;
    if (c == b) return false;  // never queried, and keeps the numbers consecutive
    return distance<2>(x, y) > kRounding * reach ||
           !visible_between(map, sectors, x, b, y, c, near_edges.edges_of(i));
  });
  seen_[index] = std::move(seen);
  reach_[index] = reach;
}

bool BoundaryVisibility::sees(std::int32_t b, std::int32_t c) const {
  constexpr std::size_t kFew = 32;
  const std::vector<std::int32_t>& row = seen_[static_cast<std::size_t>(b)];
  if (row.size() > kFew) return holds(row, c);
  // Short rows, of about ten numbers, are compared with SIMD.
  bool seen = false;
  for (const std::int32_t other : row) seen = seen | (other == c);
  return seen;
}

// In the chart of a whole sphere, the last bubbles beside the projection point are so large that
// all others are within their radius. The links of their leaves change when nodes move to other
// leaves, and the lists must not depend on the moment of their construction. Pairs that are far
// apart along the sphere are therefore never listed. The next shells of nodes are within twice the
// radius, and such bubbles are several times as far away from all nodes that move.
bool VisibilityPastEdges::far_along_sphere(std::int64_t i, std::int64_t j) const {
  const Embedding<2>& embedding = map.boundary().embedding;
  const Point<2> x = near_edges.place_of(i), y = near_edges.place_of(j);
  const double stretch_x = embedding.stretch(x), stretch_y = embedding.stretch(y);
  const double along = std::max(nodes.d(i) / stretch_x, nodes.d(j) / stretch_y);
  const double far = 2 * near_edges.radius() * along;
  return squared_distance<2>(x, y) > far * far * stretch_x * stretch_y;
}

bool VisibilityPastEdges::sees_past_edges(std::int64_t wide, std::int64_t other) const {
  const std::int32_t b = nodes.boundary_node(wide), c = nodes.boundary_node(other);
  if (b >= 0 && c >= 0) return boundary_visibility.sees(b, c);
  if (b >= 0 && near_edges.leaves_boundary_behind(wide, b, other))
    return sectors.leads_inside(map.boundary(), b, near_edges.place_of(other));
  if (c >= 0 && near_edges.leaves_boundary_behind(other, c, wide))
    return sectors.leads_inside(map.boundary(), c, near_edges.place_of(wide));
  return near_edges.visible_past_edges(nodes, map, sectors, wide, other, wide);
}

}  // namespace pnpbs
