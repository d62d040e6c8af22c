// SPDX-License-Identifier: BSD-3-Clause
// Nodes on the edges of level sets: where these truly run, not on the chords between the vertices
// of their triangles, and how the surface looks on both sides.
#pragma once

#include <array>

#include "domain/volume/feature_nodes.hpp"
#include "domain/volume/volume_domain.hpp"

namespace pnpbs {

// Those between corners move onto the edges of f. One for which no edge is found as near as nodes
// may be to the facets stays.
void put_on_creases(const VolumeDomain& domain, FeatureNodes& laid);

// The gradients of f beside a node on its edge, of length 1; 0 for other nodes.
std::array<Point<3>, 2> normals_beside(const VolumeDomain& domain, const FeatureNode& node);

}  // namespace pnpbs
