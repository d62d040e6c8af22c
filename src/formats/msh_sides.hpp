// SPDX-License-Identifier: BSD-3-Clause
// The sides of elements of a mesh from Gmsh, by which elements touch.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <vector>

#include "formats/msh_mesh.hpp"

namespace pnpbs::msh_sides {

inline constexpr std::int32_t kNone = std::numeric_limits<std::int32_t>::max();

// Corners of the facets of each shape; -1: no fourth one.
using Sides = std::vector<std::array<int, 4>>;

inline const Sides& sides_of(MshShape shape) {
  static const std::map<MshShape, Sides> sides{
      {MshShape::triangle, {{0, 1, -1, -1}, {1, 2, -1, -1}, {2, 0, -1, -1}}},
      {MshShape::quadrangle, {{0, 1, -1, -1}, {1, 2, -1, -1}, {2, 3, -1, -1}, {3, 0, -1, -1}}},
      {MshShape::tetrahedron, {{0, 2, 1, -1}, {0, 1, 3, -1}, {1, 2, 3, -1}, {0, 3, 2, -1}}},
      {MshShape::hexahedron,
       {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}},
      {MshShape::prism, {{0, 2, 1, -1}, {3, 4, 5, -1}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}},
      {MshShape::pyramid,
       {{0, 3, 2, 1}, {0, 1, 4, -1}, {1, 2, 4, -1}, {2, 3, 4, -1}, {3, 0, 4, -1}}}};
  return sides.at(shape);
}

// Nodes of a side; kNone: no fourth one.
using Key = std::array<std::int32_t, 4>;

inline Key key_of(Key corners) {
  std::sort(corners.begin(), corners.end());
  return corners;
}

// Of corners.
inline std::int32_t count_of(const Key& corners) {
  return static_cast<std::int32_t>(std::find(corners.begin(), corners.end(), kNone) -
                                   corners.begin());
}

// Calls visit(shape, corners, region).
template <class Visit>
void for_cells(const MshMesh& mesh, int dimension, const Visit& visit) {
  for (std::size_t shape = 0; shape < kMshShapes; ++shape) {
    if (kMshDimensions[shape] != dimension) continue;
    const auto corners = static_cast<std::size_t>(kMshCorners[shape]);
    const MshCells& cells = mesh.cells[shape];
    for (std::size_t e = 0; e < cells.count(); ++e)
      visit(static_cast<MshShape>(shape), std::span(cells.corners).subspan(corners * e, corners),
            static_cast<std::size_t>(cells.regions[e]));
  }
}

}  // namespace pnpbs::msh_sides
