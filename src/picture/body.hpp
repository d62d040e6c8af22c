// SPDX-License-Identifier: BSD-3-Clause
// The body or the surfaces that pictures show.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "delaunay/volume/circumsphere.hpp"

namespace pnpbs::picture {

// Nodes with the tetrahedra of a body, or with the triangles of a surface mesh.
struct Body {
  std::vector<Point<3>> positions;                      // of nodes
  std::vector<double> spacing;                          // d at the nodes
  std::vector<std::array<std::int64_t, 4>> tetrahedra;  // corners, as indices of nodes
  std::vector<std::array<std::int64_t, 3>> boundary;    // triangles, as indices of their corners

  // Returns whether there are no tetrahedra: the boundary is a surface mesh.
  bool is_surface_mesh() const { return tetrahedra.empty(); }
  std::size_t size() const { return positions.size(); }
  const Point<3>& at(std::int64_t node) const { return positions[static_cast<std::size_t>(node)]; }
  TetrahedronCorners corners(std::size_t tetrahedron) const {
    const auto& [a, b, c, d] = tetrahedra[tetrahedron];
    return {at(a), at(b), at(c), at(d)};
  }
};

}  // namespace pnpbs::picture
