// SPDX-License-Identifier: BSD-3-Clause
// The boundary near the nodes of a level in the plane: its edges, and which nodes they hide from
// each other.
#pragma once

#include <utility>

#include "level/level_geometry.hpp"
#include "level/level_tree.hpp"
#include "neighbors/boundary_visibility.hpp"
#include "neighbors/near_edges.hpp"

namespace pnpbs {

template <int Dim>
class NearBoundary;

// See level/near_boundary.hpp for the members.
template <>
class NearBoundary<2> {
 public:
  using NearLeaves = NearEdges;
  static NearLeaves near_leaves(const LevelTree<2>& tree, double radius);
  void adopt(NearLeaves edges) { edges_ = std::move(edges); }
  void reset(const LevelGeometry<2>& geometry) {
    visibility_.reset(geometry.boundary().nodes.size());
  }

  void build(const Nodes<2>& nodes, const Field<2>& at, const Buckets<2>& buckets,
             const SizedTree<2>& map, const LevelGeometry<2>& geometry);
  VisibilityPastEdges visibility(const Nodes<2>& nodes, const SizedTree<2>& map,
                                 const LevelGeometry<2>& geometry) const {
    return {nodes, edges_, visibility_, map, geometry.sectors()};
  }

  double radius() const { return edges_.radius(); }
  bool leaf_is_clear(std::int32_t leaf) const { return edges_.leaf_is_clear(leaf); }
  bool within(std::int64_t i, double reach) const { return edges_.edge_within(i, reach); }
  // Returns whether the boundary may block node i in steps that lead no farther than `reach`.
  bool constrains(const Nodes<2>&, std::int64_t i, double reach) const { return within(i, reach); }
  Point<2> hold_off(std::int64_t i, const Nodes<2>& nodes, const SizedTree<2>& map,
                    const LevelGeometry<2>& geometry, const Point<2>& to) const;

  const NearEdges& edges() const { return edges_; }

 private:
  NearEdges edges_;
  BoundaryVisibility visibility_;
};

}  // namespace pnpbs
