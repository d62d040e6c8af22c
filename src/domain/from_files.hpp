// SPDX-License-Identifier: BSD-3-Clause
// What files describe, added to domains. The functions throw Error and then leave the domain as it
// was.
#pragma once

#include "domain/plane/plane_domain.hpp"
#include "domain/volume/volume_domain.hpp"
#include "formats/msh_mesh.hpp"
#include "formats/poly_graph.hpp"

namespace pnpbs {

void add_poly(PlaneDomain& domain, const PolyGraph& graph);

// A mesh in a plane of constant z: its lines, and what bounds its triangles and quadrangles, as
// curves on the boundary or inside; points in physical groups as fixed nodes; physical groups of
// elements as regions; the names of groups.
void add_msh(PlaneDomain& domain, const MshMesh& mesh, double corner_angle);

// A mesh in space: its triangles and quadrangles as surfaces, on the boundary or inside; lines in
// physical groups as inner curves, points in such as fixed nodes, volumes as regions; the names of
// groups.
void add_msh(VolumeDomain& domain, const MshMesh& mesh, double feature_angle);

}  // namespace pnpbs
