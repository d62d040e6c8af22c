// SPDX-License-Identifier: BSD-3-Clause
// The surface of a level set as triangles, closed and two-sided: each crossed cell of the lattice
// is cut into six tetrahedra around its diagonal, which conform from cell to cell, and these are
// cut where f = 0.
#pragma once

#include "implicit/level_set.hpp"
#include "surfaces/triangulation.hpp"

namespace pnpbs {

// Vertices are where f = 0, triangles within the order of the resolution squared of it. Sharp edges
// are cut off: see level_set_creases.hpp. Throws Error(ErrorKind::domain).
SurfaceSource level_set_surface(const LevelSet& set, std::int32_t tag);

}  // namespace pnpbs
