// SPDX-License-Identifier: BSD-3-Clause
// Triangulates the surface of a level set; the result is closed and two-sided. Each crossed cell of
// the lattice is divided into six tetrahedra around its diagonal, which conform between cells, and
// the tetrahedra are cut at f = 0.
#pragma once

#include "implicit/level_set.hpp"
#include "surfaces/triangulation.hpp"

namespace pnpbs {

// Returns triangles with vertices at f = 0. They are within the order of the squared resolution of
// the surface, but cut off sharp edges, which level_set_creases.hpp restores. Throws
// Error(ErrorKind::domain).
SurfaceSource level_set_surface(const LevelSet& set, std::int32_t tag);

}  // namespace pnpbs
