// SPDX-License-Identifier: BSD-3-Clause
// Inserts the edges and corners of a level set's surface, where the gradient of f jumps, into its
// triangulation.
#pragma once

#include "implicit/level_set.hpp"
#include "surfaces/triangulation.hpp"

namespace pnpbs {

// Cuts the triangles of the surface along its edges. Where triangles would turn over or cross, the
// surface stays rounded, with a warning.
void add_creases(const LevelSet& set, SurfaceSource& surface);

}  // namespace pnpbs
