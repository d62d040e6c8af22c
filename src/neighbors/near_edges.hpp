// SPDX-License-Identifier: BSD-3-Clause
// The boundary edges near each node of a plane domain. Edges separate pairs of nodes, and inner
// nodes keep a distance from them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "base/chunked_rows.hpp"
#include "base/nodes.hpp"
#include "geometry/boxes_apart.hpp"
#include "geometry/plane/incident_sectors.hpp"
#include "neighbors/buckets.hpp"
#include "spacing/sized_tree.hpp"

namespace pnpbs {

// For each node: the boundary edges within radius * d_i, and the distance to the nearest one.
class NearEdges {
 public:
  // Finds the edges near each leaf. Called once per level. `links` are the links of the leaves.
  void prepare(const SizedTree<2>& map, const LeafGraph<2>& links, double radius);

  // Finds the edges within radius * d_i of each node at its position in `at`. Called at every
  // rebuild of the lists. During a run, `at` has the positions of the last event, so that the
  // result does not depend on the time of the rebuild. Edges of boundary nodes, which do not move,
  // are found only once.
  void build(const Nodes<2>& nodes, const Field<2>& at, const Buckets<2>& buckets,
             const SizedTree<2>& map);

  // Returns true if no edge is near any point of this leaf.
  bool leaf_is_clear(std::int32_t leaf) const {
    const auto l = static_cast<std::size_t>(leaf);
    return leaf_offset_[l] == leaf_offset_[l + 1];
  }

  // Returns true if an edge is within radius * d_i of node i.
  bool any(std::int64_t i) const { return any_(i) != 0; }

  // Returns true if an edge is within `reach` of node i, which must be at most radius * d_i.
  bool edge_within(std::int64_t i, double reach) const { return any(i) && gap_(i) <= reach; }

  // Returns true if node i surely keeps more than `clearance` from all edges and crosses none when
  // it moves from `from` to `to`. Node i must have edges near it. The test uses only the stored
  // distance and the displacement since then, so false is inconclusive.
  bool stays_clear(std::int64_t i, const Point<2>& from, const Point<2>& to,
                   double clearance) const {
    constexpr double kRounding = 1 + 1e-8;
    const double come = distance<2>(place_of(i), to);
    return gap_(i) > kRounding * (come + std::max(clearance, distance<2>(from, to)));
  }

  std::span<const std::int32_t> edges_of(std::int64_t i) const { return edges_.row(i); }

  // Returns true if all nodes are at the positions that build() used.
  bool built_where_nodes_are(const Nodes<2>& nodes) const {
    return sum_of("pnpbs::NearEdges::built_where_nodes_are", nodes.count, [&](std::int64_t i) {
             return at_[0](i) != nodes.x[0](i) || at_[1](i) != nodes.x[1](i);
           }) == 0;
  }

  double radius() const { return radius_; }

  // Returns the position of node i that build() used.
  Point<2> place_of(std::int64_t i) const { return point_at<2>(at_, i); }

  // Returns true if no edge is near enough to nodes i and j to intersect the segment between them.
  // The distances of the two nodes from an intersecting edge add up to at most its length.
  bool surely_visible(std::int64_t i, std::int64_t j) const {
    return shorter_than(i, j, gap_(i) + gap_(j));
  }

  // Returns true if the segment from node i, which is boundary node b, to inner node j surely meets
  // no part of the boundary except edges of b.
  bool leaves_boundary_behind(std::int64_t i, std::int32_t b, std::int64_t j) const {
    return shorter_than(i, j, at_boundary_nodes_[static_cast<std::size_t>(b)].beyond + gap_(j));
  }

  // Returns true if none of the edges near node `wide`, which is i or j, separates nodes i and j.
  bool visible_past_edges(const Nodes<2>& nodes, const SizedTree<2>& map,
                          const IncidentSectors& sectors, std::int64_t i, std::int64_t j,
                          std::int64_t wide) const;

 private:
  // Returns true if the distance between two nodes is surely less than `length`.
  bool shorter_than(std::int64_t i, std::int64_t j, double length) const {
    constexpr double kRounding = 1 - 1e-9;
    const double x = at_[0](i) - at_[0](j), y = at_[1](i) - at_[1](j);
    return x * x + y * y < (kRounding * length) * (kRounding * length);
  }

  class Finder;  // finds the edges near nodes
  // The edges near a boundary node.
  struct Found {
    double reach = 0;  // search radius; 0 if not searched yet
    double nearest = 0;
    double beyond = 0;  // distance of the nearest edge or node of the boundary but its own
    std::vector<std::int32_t> edges;
  };
  void gather_near(const SizedTree<2>& map, const LeafGraph<2>& links, std::int32_t leaf,
                   std::vector<std::int32_t>& near) const;
  void add_box(const Point<2>& a, const Point<2>& b, double reach);

  double radius_ = 0;
  Field<2> at_;
  std::vector<double> leaf_reach_;         // search radius of each leaf
  std::vector<std::int32_t> leaf_offset_;  // compressed rows: edges near each leaf
  std::vector<std::int32_t> leaf_edges_;
  std::array<std::vector<double>, 2> low_, high_;  // boxes of leaf_edges_, slightly enlarged
  std::vector<Found> at_boundary_nodes_;           // by boundary node
  ChunkedRows<std::int32_t> edges_;
  View<char> any_;
  View<double> gap_;  // distance to the nearest edge, at most radius * d
};

// Returns true if the straight segment from x to y stays inside the domain. `edges` must have all
// edges that can lie between the points. boundary_x and boundary_y are the indices of boundary
// nodes, or -1 for inner nodes.
template <class Edges>
bool visible_between(const SizedTree<2>& map, const IncidentSectors& sectors, const Point<2>& x,
                     std::int32_t boundary_x, const Point<2>& y, std::int32_t boundary_y,
                     const Edges& edges);

}  // namespace pnpbs

#include "predicates/plane.hpp"

namespace pnpbs {

template <class Edges>
bool visible_between(const SizedTree<2>& map, const IncidentSectors& sectors, const Point<2>& x,
                     std::int32_t boundary_x, const Point<2>& y, std::int32_t boundary_y,
                     const Edges& edges) {
  if (boundary_x >= 0 && boundary_y >= 0 && sectors.joined(boundary_x, boundary_y)) return true;
  if (boundary_x >= 0 && !sectors.leads_inside(map.boundary(), boundary_x, y)) return false;
  if (boundary_y >= 0 && !sectors.leads_inside(map.boundary(), boundary_y, x)) return false;
  // A segment that passes exactly through a boundary node continues only within one sector of the
  // node.
  const auto stops = [&](const Point<2>& node, std::int32_t boundary_node) {
    const int k = x[0] != y[0] ? 0 : 1;
    if (!(std::min(x[k], y[k]) < node[k] && node[k] < std::max(x[k], y[k]))) return false;
    return !sectors.lets_pass(map.boundary(), boundary_node, x, y);
  };
  const std::span<const std::int32_t> row(edges);
  for (std::size_t k = 0; k < row.size(); ++k) {
    if (const std::size_t off = map.facet_blocks().facets_off_segment(row, k, x, y)) {
      k += off - 1;
      continue;
    }
    const std::int32_t e = row[k];
    if (boxes_are_apart(x, y, map.corners(e))) continue;  // true for most edges
    const auto& [a, b] = map.corners(e);
    const std::int32_t begin = map.facet(e).begin, end = map.facet(e).end;
    // The orientation of an end that is x or y itself is known to be 0, and exact predicates are
    // slow.
    const int side_a = begin == boundary_x || begin == boundary_y ? 0 : orientation(x, y, a);
    const int side_b = end == boundary_x || end == boundary_y ? 0 : orientation(x, y, b);
    if (side_a * side_b < 0 && orientation(a, b, x) * orientation(a, b, y) < 0) return false;
    if (side_a == 0 && stops(a, begin)) return false;
    if (side_b == 0 && stops(b, end)) return false;
  }
  return true;
}

}  // namespace pnpbs
