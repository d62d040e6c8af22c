// SPDX-License-Identifier: BSD-3-Clause
// The surfaces near the nodes of a level in space.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/nodes.hpp"
#include "level/level_geometry.hpp"
#include "level/level_tree.hpp"
#include "neighbors/adjacency_list.hpp"
#include "neighbors/buckets.hpp"

namespace pnpbs {

template <int Dim>
class NearBoundary;

// The visibility test for lists in space. It uses the positions at the last event or, for lists
// built here, the present ones.
class VisibilityInSpace {
 public:
  // Sets `hidden` for both nodes of a tested pair that do not see each other.
  VisibilityInSpace(const Nodes<3>& nodes, const Field<3>& at, const LevelGeometry<3>& geometry,
                    NodeArray<char>& hidden)
      : nodes_(nodes), at_(at), geometry_(geometry), hidden_(hidden) {}

  bool may_occlude(std::int64_t i) const { return nodes_.carrier(i) != Carrier::free; }
  bool visible(std::int64_t i, std::int64_t j);

 private:
  bool bubbles_on_surfaces() const { return nodes_.moving == Carrier::surface; }
  SurfaceSupport place(std::int64_t i) const {
    return geometry_.place(nodes_.carrier(i), nodes_.reference_on(i));
  }
  bool in_sight(std::int64_t i, std::int64_t j) const;
  bool looks_at(std::int64_t on_boundary, std::int64_t inner) const;
  bool see_through_inside(std::int64_t i, std::int64_t j) const;

  const Nodes<3>& nodes_;
  Field<3> at_;
  const LevelGeometry<3>& geometry_;
  NodeArray<char>& hidden_;
};

// See level/near_boundary.hpp for the members.
template <>
class NearBoundary<3> {
 public:
  struct NearLeaves {
    double radius = 0;
    std::vector<double> reach;  // distance from each leaf within which facets were searched
    std::vector<char> clear;    // nonzero: there was none
  };
  static NearLeaves near_leaves(const LevelTree<3>& tree, double radius);
  void adopt(NearLeaves near) { near_ = std::move(near); }
  void reset(const LevelGeometry<3>&) {}

  // Measures the distances of the nodes that get lists.
  void build(const Nodes<3>& nodes, const Field<3>& at, const Buckets<3>& buckets,
             const SizedTree<3>& map, const LevelGeometry<3>& geometry, ListsOf listed);
  // Measures the distances of the nodes `more`, whose lists are added.
  void add(const Nodes<3>& nodes, const Buckets<3>& buckets, const SizedTree<3>& map,
           const LevelGeometry<3>& geometry, const std::vector<std::int32_t>& more);
  VisibilityInSpace visibility(const Nodes<3>& nodes, const SizedTree<3>&,
                               const LevelGeometry<3>& geometry) {
    return {nodes, at_, geometry, hidden_};
  }

  double radius() const { return near_.radius; }
  bool leaf_is_clear(std::int32_t leaf) const {
    return near_.clear[static_cast<std::size_t>(leaf)] != 0;
  }
  // Returns whether a facet is within `reach` of node i, which must have a list. If `reach` exceeds
  // the d of the node, facets up to a quarter farther away may count.
  bool within(std::int64_t i, double reach) const { return gap_(i) <= reach; }
  // Returns whether the boundary hid no node from node i in the last rebuild of the lists.
  bool sees_all(std::int64_t i) const { return hidden_(i) == 0; }
  // Returns a lower bound of the distance of free node i from all facets.
  double room(std::int64_t i, const Nodes<3>& nodes) const {
    return std::min(gap_(i), near_.radius * nodes.d(i)) -
           distance<3>(point_at<3>(at_, i), nodes.position(i));
  }
  bool constrains(const Nodes<3>& nodes, std::int64_t i, double reach) const {
    return nodes.carrier(i) == Carrier::surface || within(i, reach);
  }
  Point<3> hold_off(std::int64_t i, Nodes<3>& nodes, const SizedTree<3>& map,
                    const LevelGeometry<3>& geometry, const Point<3>& to) const;

  // Returns whether free node i may move to `to`: inside, with this clearance or no less than now.
  bool stays_clear(std::int64_t i, const Nodes<3>& nodes, const LevelGeometry<3>& geometry,
                   const Point<3>& to, double clearance) const;
  // Returns the same for the clearance from inner surfaces, if one of these is nearest.
  bool stays_clear_of_inner(std::int64_t i, const Nodes<3>& nodes, const LevelGeometry<3>& geometry,
                            const Point<3>& to, double clearance) const;

 private:
  bool far_on_the_way(std::int64_t i, const Nodes<3>& nodes, const Point<3>& to,
                      double clearance) const;

  double gap_of(std::int64_t i, const Nodes<3>& nodes, const Buckets<3>& buckets,
                const SizedTree<3>& map, const LevelGeometry<3>& geometry) const;
  Point<3> walk_on_surface(std::int64_t i, Nodes<3>& nodes, const LevelGeometry<3>& geometry,
                           const Point<3>& to) const;

  NearLeaves near_;
  Field<3> at_;
  // Distance of a free node from the nearest facet, and of a surface node from the nearest feature
  // edge; kFarAway if it exceeds the radius. A lower bound where a free node has more than its
  // clearance, and 0 if the node has no list.
  NodeArray<double> gap_;
  NodeArray<char> hidden_;  // nonzero: the boundary hides a node from this one
};

}  // namespace pnpbs
