// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "domain/volume/volume_domain.hpp"
#include "formats/msh_mesh.hpp"

namespace pnpbs {

// Adds what the mesh describes: its triangles and quadrangles as surfaces, on the boundary or
// inside; lines in physical groups as inner curves, points in such as fixed nodes; the names of
// groups. Throws Error and then leaves the domain as it was.
void add_msh(VolumeDomain& domain, const MshMesh& mesh, double feature_angle);

}  // namespace pnpbs
