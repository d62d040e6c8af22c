// SPDX-License-Identifier: BSD-3-Clause
// Where the physical groups of the elements lie that fill the domain of a mesh from Gmsh.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/msh_mesh.hpp"

namespace pnpbs {

struct MshRegionPoint {
  Point<3> point;
  std::int32_t tag;  // of the group
  std::string name;
};

// One in each part of a group of elements of this dimension: what facets of the mesh divide are
// several. None where all elements are in one group, or all in none.
std::vector<MshRegionPoint> region_points_of(const MshMesh& mesh, int dimension);

}  // namespace pnpbs
