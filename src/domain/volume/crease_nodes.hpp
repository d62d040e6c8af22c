// SPDX-License-Identifier: BSD-3-Clause
// Nodes on the edges of level sets: where these truly run, not on the chords between the vertices
// of their triangles, and how the surface looks on both sides.
#pragma once

#include <array>

#include "domain/volume/feature_nodes.hpp"
#include "domain/volume/volume_domain.hpp"

namespace pnpbs {

// Those between corners move onto the edges of f, but one for which none is found within reach.
void put_on_creases(const ResolvedVolume& volume, FeatureNodes& laid, double reach);

// The gradients of f beside a node on its edge, of length 1; 0 for other nodes.
std::array<Point<3>, 2> normals_beside(const ResolvedVolume& volume, const FeatureNode& node);

}  // namespace pnpbs
