// SPDX-License-Identifier: BSD-3-Clause
// The boundary mesh of a volume from triangulated surfaces.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "geometry/boundary_mesh.hpp"

namespace pnpbs {

enum class SurfaceRole {
  boundary,  // closed, their normals pointing out of the domain: of a cavity, into it
  inner,     // nodes follow it, but the domain is on both sides
  by_place   // as given: whichever of the two each triangle is where it lies
};

// Adds nodes and triangles, whose corners are indices into the nodes given. A node has the tag of
// the first of its triangles.
void add_surface(BoundaryMesh<3>& mesh, SurfaceRole role, std::span<const Point<3>> nodes,
                 std::span<const std::array<std::int32_t, 3>> triangles,
                 std::span<const std::int32_t> tags);

}  // namespace pnpbs
