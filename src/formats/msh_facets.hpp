// SPDX-License-Identifier: BSD-3-Clause
// What bounds and divides the domain of a mesh from Gmsh: lines in the plane, triangles and
// quadrangles in space.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "formats/msh_mesh.hpp"

namespace pnpbs {

enum class MshSides {
  one_inside,   // it bounds the domain
  both_inside,  // it lies in it
  unknown       // the file does not tell
};

struct MshFacet {
  std::array<std::int32_t, 4> corners;  // nodes of the mesh
  std::int32_t corner_count;
  std::int32_t tag;
  MshSides sides;

  std::span<const std::int32_t> nodes() const {
    return {corners.data(), static_cast<std::size_t>(corner_count)};
  }
};

// Those of a domain of this dimension. The elements that fill it tell on which side it is; else, in
// version 4.1, the entities that they bound. Where elements fill the domain, facets that the file
// leaves out are added: those of one element, and those between elements of different regions, with
// the least tag that is free. Throws Error(ErrorKind::file), also if there are none.
std::vector<MshFacet> facets_of(const MshMesh& mesh, int dimension);

}  // namespace pnpbs
