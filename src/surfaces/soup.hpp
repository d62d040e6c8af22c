// SPDX-License-Identifier: BSD-3-Clause
// Triangles that need not fit together, made to know their neighbours as far as they have any.
#pragma once

#include <vector>

#include "surfaces/triangulation.hpp"

namespace pnpbs {

// The triangles over common vertices: those within the tolerance of each other are one. What
// thereby has no area left is gone, and of triangles with the same corners, whichever way they
// turn, the first stays: a second one would hide at its edges who is next to whom, and one that
// turns the other way would cancel the first.
Triangulation joined_soup(const std::vector<SurfaceSource>& given, double tolerance);

}  // namespace pnpbs
