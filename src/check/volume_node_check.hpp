// SPDX-License-Identifier: BSD-3-Clause
// Checks of the nodes in space that bodies and surfaces alone have in common.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "check/node_check.hpp"

namespace pnpbs {

// Checks of nodes on surfaces, on features and inside.
class VolumeNodeCheck : public NodeCheck<3> {
 public:
  explicit VolumeNodeCheck(const Results<3>& results);

  // Checks nodes and lists without regard to elements.
  void check_nodes_and_lists() const {
    check_ids();
    check_places();
    check_sides();
    check_feature_nodes();
    check_lists();
  }

 protected:
  using Three = std::array<std::int64_t, 3>;

  bool is_feature_node(std::int64_t i) const {
    return nodes_.boundary_node(i) >= 0 && nodes_.carrier(i) != Carrier::surface;
  }
  double gap_to_surface(const Point<3>& x) const {
    return geometry_.domain().index().clearance(x, std::numeric_limits<double>::infinity());
  }
  std::array<Point<3>, 3> positions_at(const Three& places) const;
  // Returns the largest distance of a triangle from the surface, sampled at its centroid and edge
  // midpoints.
  double max_gap(const std::array<Point<3>, 3>& corners) const;

  const LevelGeometry<3>& geometry_;
  double resolution_ = 0;  // largest of the domain's level sets; 0 if it has none

 private:
  // Checks that each node lies on its carrier: a surface, a feature edge, or the inside.
  void check_sides() const;
  // Checks that each node on feature edges occurs once.
  void check_feature_nodes() const;
  const Point<3>& laid(std::size_t n) const { return geometry_.features().nodes[n].position; }
  void check_on_surface(std::int64_t i) const;
  double gap_to_facet(const Point<3>& x) const;
};

}  // namespace pnpbs
