// SPDX-License-Identifier: BSD-3-Clause
// Small dihedral angles of the tetrahedra of a body: those at edges where the body itself is sharp,
// and in walls much thinner than d, which no nodes can avoid, apart from the others.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "level/found_nodes.hpp"
#include "level/level.hpp"

namespace pnpbs {

// In degrees, over all ranks; 180 if there are no elements of the kind. Of an element at a sharp
// edge (shape/sharp_edges.hpp), a corner is less than d from it; those that connect the two sides
// of a thin wall (level/volume/opposite_nodes.hpp) count as such.
struct LeastAngles {
  double at_sharp_edges = 180, elsewhere = 180;

  void add(double angle, bool at_edge) {
    double& of_kind = at_edge ? at_sharp_edges : elsewhere;
    of_kind = std::min(of_kind, angle);
  }
  void add(const LeastAngles& other) {
    add(other.at_sharp_edges, true);
    add(other.elsewhere, false);
  }
};

// From the stars there are, with the least angle of all elements. Collective.
LeastAngles least_angles(const Level<3>& level, double of_all);

struct SmallAngleElements {
  FoundNodes<3> all;             // over all ranks, at their nodes with the least ids
  std::vector<Point<3>> places;  // the corners of this rank's, each once
};

// Elements with an angle below so many degrees, but neither those at sharp edges nor those that
// connect the two sides of a wall much thinner than d, which cannot have larger ones. From the
// stars there are. Collective.
SmallAngleElements small_angle_elements(const Level<3>& level, double below);

}  // namespace pnpbs
