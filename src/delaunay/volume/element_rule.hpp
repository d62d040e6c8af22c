// SPDX-License-Identifier: BSD-3-Clause
// Which tetrahedra of a Delaunay triangulation are elements: a pure function of the corners, the
// same for all of them and on all ranks.
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

// The circumradius of an element is at most this times the least d of its corners: what is wider,
// nodes have not filled, or it lies outside. (In a lattice it is 0.6 d; beside a jump of d by a
// factor of four it is twice the smaller d.) The least, not the mean: so a node knows how far
// away its elements can end.
inline constexpr double kMaxRadius = 2;

// By id, so that what is computed from them in turn has the same bits whoever asks.
using Tetrahedron = std::array<VolumeNode, 4>;
Tetrahedron ordered_by_id(Tetrahedron corners);
// Of nodes where they are.
Tetrahedron tetrahedron_of(const Nodes<3>& nodes, const std::array<std::int64_t, 4>& corners);

// The corners' mean, added up in the order of their ids.
Point<3> centroid(const Tetrahedron& ordered);

// With twice the digits: of a tetrahedron that is flat but for rounding, the sphere is not.
bool is_element(const Tetrahedron& ordered);

}  // namespace pnpbs
