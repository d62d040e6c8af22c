// SPDX-License-Identifier: BSD-3-Clause
// Neighbouring triangles of a surface turn the same way.
#pragma once

#include <string>
#include <vector>

#include "base/warning.hpp"
#include "surfaces/surface_edges.hpp"

namespace pnpbs {

enum class OneSided { rejected, ignored };

// Turns triangles so that they agree with their neighbours, the fewer ones of each connected
// surface, and warns if there are any. `edges` are changed accordingly. Where a surface has but one
// side, it throws Error(ErrorKind::domain), or some neighbours do not agree.
void orient_surfaces(Triangulation& surface, SurfaceEdges& edges, OneSided one_sided,
                     std::vector<Warning>& warnings);

}  // namespace pnpbs
