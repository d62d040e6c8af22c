// SPDX-License-Identifier: BSD-3-Clause
// What is to be seen of a body that is cut open by whole tetrahedra.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "picture/body.hpp"
#include "picture/cut_plane.hpp"

namespace pnpbs::picture {

struct VisibleFace {
  std::array<std::int64_t, 3> corners;  // in no particular order
  std::size_t tetrahedron;  // whose face it is: one behind the plane; 0 if there is none
  bool cut;                 // its other side has been taken away; else the boundary
};

// The faces between the tetrahedra whose centroids lie behind the plane and all that does not: the
// cut, and what is left of the boundary. All triangles of surfaces alone, which are not cut.
std::vector<VisibleFace> visible_faces(const Body& body, const CutPlane& plane);

}  // namespace pnpbs::picture
