// SPDX-License-Identifier: BSD-3-Clause
// The rule that decides which tetrahedra of a Delaunay triangulation are elements. It is a pure
// function of the corners, so that all corners and all ranks decide equally.
#pragma once

#include <array>
#include <cstdint>

#include "base/nodes.hpp"

namespace pnpbs {

struct VolumeNode {
  Point<3> x;
  double d;
  std::int64_t id;
};

// Maximum circumradius of an element. [least d of its corners] A wider tetrahedron lies outside or
// where nodes are missing. In a lattice, the circumradius is 0.6 d; beside a jump of d by a factor
// of four, it is twice the smaller d. The least d is used and not the mean, so that the own d of a
// node bounds the distance to the corners of its elements.
inline constexpr double kMaxRadius = 2;

// Corners in the order of their ids. Computations in this order have bitwise equal results on all
// ranks.
using Tetrahedron = std::array<VolumeNode, 4>;
Tetrahedron ordered_by_id(Tetrahedron corners);
// Returns the tetrahedron of the present positions of nodes.
Tetrahedron tetrahedron_of(const Nodes<3>& nodes, const std::array<std::int64_t, 4>& corners);

// Returns the mean of the corners, summed up in the order of their ids.
Point<3> centroid(const Tetrahedron& ordered);

// Returns whether the tetrahedron is an element. The computation has twice the digits of a double,
// because the circumsphere of a tetrahedron that is flat up to rounding is otherwise wrong.
bool is_element(const Tetrahedron& ordered);

}  // namespace pnpbs
