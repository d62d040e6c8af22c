// SPDX-License-Identifier: BSD-3-Clause
// Small dihedral angles of the tetrahedra of a body. Angles at sharp edges of the body and in walls
// much thinner than d cannot be avoided by any nodes, and are counted apart from the others.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "level/found_nodes.hpp"
#include "level/level.hpp"

namespace pnpbs {

// The smallest dihedral angles over all ranks, in degrees, or 180 without such elements. An element
// is at a sharp edge (shape/sharp_edges.hpp) if one of its corners is less than d from it. Elements
// that connect the two sides of a thin wall (level/volume/opposite_nodes.hpp) count as such.
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

// Computes the smallest angles from the present stars. `of_all` is the smallest angle of all
// elements. All ranks must call it, and if one rank throws, all ranks throw.
LeastAngles least_angles(const Level<3>& level, double of_all);

// The elements with small angles.
struct SmallAngleElements {
  FoundNodes<3> all;             // count over all ranks, and the node with the smallest id
  std::vector<Point<3>> places;  // the corners of this rank's elements, without repetition
};

// Finds elements with an angle below so many degrees, from the present stars. Leaves out those at
// sharp edges and those that connect the two sides of a wall much thinner than d, because they
// cannot have larger angles. All ranks must call it, and if one rank throws, all ranks throw.
SmallAngleElements small_angle_elements(const Level<3>& level, double below);

}  // namespace pnpbs
