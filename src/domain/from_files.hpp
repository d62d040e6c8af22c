// SPDX-License-Identifier: BSD-3-Clause
// Adds the contents of mesh and geometry files to domains. If a function throws Error, it leaves
// the domain unchanged.
#pragma once

#include "domain/plane/plane_domain.hpp"
#include "domain/volume/volume_domain.hpp"
#include "formats/msh_mesh.hpp"
#include "formats/poly_graph.hpp"

namespace pnpbs {

// Adds a planar straight-line graph with its holes and regions, as .poly files have them.
void add_poly(PlaneDomain& domain, const PolyGraph& graph);

// Adds a mesh in a plane of constant z. Lines, and edges that bound triangles and quadrangles,
// become boundary or inner curves. Points in physical groups become fixed nodes, and physical
// groups of elements become regions. Names of groups are kept. `corner_angle` is in degrees.
void add_msh(PlaneDomain& domain, const MshMesh& mesh, double corner_angle);

// Adds a mesh in space. Triangles and quadrangles become boundary or inner surfaces, and lines in
// physical groups become inner curves. Points in physical groups become fixed nodes, and groups of
// volumes become regions. Names of groups are kept. `feature_angle` is in degrees.
void add_msh(VolumeDomain& domain, const MshMesh& mesh, double feature_angle);

}  // namespace pnpbs
