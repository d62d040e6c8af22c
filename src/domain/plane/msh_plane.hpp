// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "domain/plane/plane_domain.hpp"
#include "formats/msh_mesh.hpp"

namespace pnpbs {

// Adds what the mesh describes, which must lie in a plane of constant z: its lines, and what bounds
// its triangles and quadrangles, as curves on the boundary or inside; points in physical groups as
// fixed nodes; the names of groups. Throws Error and then leaves the domain as it was.
void add_msh(PlaneDomain& domain, const MshMesh& mesh, double corner_angle);

}  // namespace pnpbs
