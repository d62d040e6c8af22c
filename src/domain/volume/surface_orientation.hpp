// SPDX-License-Identifier: BSD-3-Clause
// Neighbouring triangles of a surface turn the same way.
#pragma once

#include <string>
#include <vector>

#include "domain/volume/surface_edges.hpp"

namespace pnpbs {

// Turns triangles so that they agree with their neighbours, the fewer ones of each connected
// surface, and warns if there are any. `edges` are changed accordingly. Throws
// Error(ErrorKind::domain) where a surface has but one side.
void orient_surfaces(Triangulation& surface, SurfaceEdges& edges,
                     std::vector<std::string>& warnings);

}  // namespace pnpbs
