// SPDX-License-Identifier: BSD-3-Clause
// The facets of a mesh from Gmsh as a triangulated surface.
#pragma once

#include <vector>

#include "formats/msh_facets.hpp"
#include "formats/surface_triangles.hpp"

namespace pnpbs {

// Of the facets that have these sides. Throws Error(ErrorKind::file) for quadrangles that cannot be
// divided.
SurfaceTriangles triangles_of(const MshMesh& mesh, const std::vector<MshFacet>& facets,
                              MshSides sides);

}  // namespace pnpbs
