// SPDX-License-Identifier: BSD-3-Clause
// The boundary edges near each node: they separate pairs, and inner nodes keep off them.
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

class NearEdges {
 public:
  // Once per level: which edges come near which leaf. The links tell which leaves are near it.
  void prepare(const SizedTree<2>& map, const LeafLinks<2>& links, double radius);

  // At every rebuild of the lists: the edges within radius * d_i of each node, the nodes being at
  // `at`. During the run that is where they were at the last event, so that it does not matter
  // when the lists are made. Those of boundary nodes, which do not move, are found once.
  void build(const Nodes<2>& nodes, const Field<2>& at, const Buckets<2>& buckets,
             const SizedTree<2>& map);

  // Is no edge near any place in this leaf?
  bool leaf_is_clear(std::int32_t leaf) const {
    const auto l = static_cast<std::size_t>(leaf);
    return leaf_offset_[l] == leaf_offset_[l + 1];
  }

  bool any(std::int64_t i) const { return any_(i) != 0; }

  // Does an edge come nearer to node i than this, if that is no more than radius * d_i?
  bool edge_within(std::int64_t i, double reach) const { return any(i) && gap_(i) <= reach; }

  // Does node i, which has edges near it, stay clear of all of them by more than `clearance` and by
  // more than the way itself when it goes from one point to another? As far as its gap and how far
  // it has come since tell: true is sure, false is not.
  bool stays_clear(std::int64_t i, const Point<2>& from, const Point<2>& to,
                   double clearance) const {
    constexpr double kRounding = 1 + 1e-8;
    const double come = distance<2>(place_of(i), to);
    return gap_(i) > kRounding * (come + std::max(clearance, distance<2>(from, to)));
  }

  std::span<const std::int32_t> edges_of(std::int64_t i) const { return edges_.row(i); }

  // Are the nodes where they were for build()?
  bool built_where_nodes_are(const Nodes<2>& nodes) const {
    return sum_of("pnpbs::NearEdges::built_where_nodes_are", nodes.count, [&](std::int64_t i) {
             return at_[0](i) != nodes.x[0](i) || at_[1](i) != nodes.x[1](i);
           }) == 0;
  }

  double radius() const { return radius_; }

  // Where node i was for build().
  Point<2> place_of(std::int64_t i) const { return point_at<2>(at_, i); }

  // Is no edge near enough to the two nodes to meet the way between them? Whatever meets it has
  // distances from the two that add up to no more than its length.
  bool surely_visible(std::int64_t i, std::int64_t j) const {
    return shorter_than(i, j, gap_(i) + gap_(j));
  }

  // Does the way from boundary node b, the number of node i, to inner node j meet nothing of the
  // boundary but perhaps b's own edges?
  bool leaves_boundary_behind(std::int64_t i, std::int32_t b, std::int64_t j) const {
    return shorter_than(i, j, at_boundary_nodes_[static_cast<std::size_t>(b)].beyond + gap_(j));
  }

  // Does none of the edges near node `wide` separate nodes i and j?
  bool visible_past_edges(const Nodes<2>& nodes, const SizedTree<2>& map,
                          const IncidentSectors& sectors, std::int64_t i, std::int64_t j,
                          std::int64_t wide) const;

 private:
  // Is the way between two nodes surely shorter than that?
  bool shorter_than(std::int64_t i, std::int64_t j, double length) const {
    constexpr double kRounding = 1 - 1e-9;
    const double x = at_[0](i) - at_[0](j), y = at_[1](i) - at_[1](j);
    return x * x + y * y < (kRounding * length) * (kRounding * length);
  }

  class Finder;  // of the edges near nodes
  struct Found {
    double reach = 0;  // how far was looked; 0: not yet
    double nearest = 0;
    double beyond = 0;  // to the nearest edge or node of the boundary that is not its own
    std::vector<std::int32_t> edges;
  };
  void gather_near(const SizedTree<2>& map, const LeafLinks<2>& links, std::int32_t leaf,
                   std::vector<std::int32_t>& near) const;
  void add_box(const Point<2>& a, const Point<2>& b, double reach);

  double radius_ = 0;
  Field<2> at_;
  std::vector<double> leaf_reach_;         // how far from the leaf its edges were gathered
  std::vector<std::int32_t> leaf_offset_;  // edges near each leaf
  std::vector<std::int32_t> leaf_edges_;
  std::array<std::vector<double>, 2> low_, high_;  // boxes of leaf_edges_, a little too large
  std::vector<Found> at_boundary_nodes_;           // by number
  ChunkedRows<std::int32_t> edges_;
  View<char> any_;
  View<double> gap_;  // to the nearest edge, radius * d if none is nearer
};

// Does the straight way between two nodes stay inside the domain, as far as `edges` (all that can
// lie between them) tell? Boundary nodes are given by their index, inner ones by -1.
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
  // Past a boundary node that lies exactly on the way it goes only within one sector.
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
    if (boxes_are_apart(x, y, map.corners(e))) continue;  // most are
    const auto& [a, b] = map.corners(e);
    const std::int32_t begin = map.facet(e).begin, end = map.facet(e).end;
    // Of ends that are x or y themselves this much is known, and exact arithmetic is slow.
    const int side_a = begin == boundary_x || begin == boundary_y ? 0 : orientation(x, y, a);
    const int side_b = end == boundary_x || end == boundary_y ? 0 : orientation(x, y, b);
    if (side_a * side_b < 0 && orientation(a, b, x) * orientation(a, b, y) < 0) return false;
    if (side_a == 0 && stops(a, begin)) return false;
    if (side_b == 0 && stops(b, end)) return false;
  }
  return true;
}

}  // namespace pnpbs
