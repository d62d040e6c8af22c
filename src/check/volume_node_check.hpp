// SPDX-License-Identifier: BSD-3-Clause
// What the checks of the results ask of nodes in space, whether the domain is filled or not.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "check/node_check.hpp"

namespace pnpbs {

class VolumeNodeCheck : public NodeCheck<3> {
 public:
  explicit VolumeNodeCheck(const Results<3>& results);

  // The nodes and their lists, by themselves.
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
  // Between a triangle and the surface, at its middle and those of its edges.
  double max_gap(const std::array<Point<3>, 3>& corners) const;

  const LevelGeometry<3>& geometry_;
  double resolution_ = 0;  // of the domain's level sets; 0 without any

 private:
  // Each node lies where its carrier is: on its surface, its feature edge, inside.
  void check_sides() const;
  // Of those on feature edges each comes once.
  void check_feature_nodes() const;
  const Point<3>& laid(std::size_t n) const { return geometry_.features().nodes[n].position; }
  void check_on_surface(std::int64_t i) const;
  double gap_to_facet(const Point<3>& x) const;
};

}  // namespace pnpbs
