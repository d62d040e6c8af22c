// SPDX-License-Identifier: BSD-3-Clause
// A hexagonal lattice in a flat patch.
#pragma once

#include <cstdint>
#include <vector>

#include "domain/volume/surface.hpp"
#include "initial/volume/rank_cells.hpp"

namespace pnpbs {

// The patch's longest straight feature edge is a row of it, and if another is parallel the rows are
// fitted in between. Nodes stay `clearance` times their distance off features. Those in cells of
// this rank.
std::vector<SurfacePoint> flat_lattice(const Surface& surface, std::int32_t patch,
                                       const std::vector<std::int32_t>& facets, double d,
                                       double clearance, const RankCells& cells);

}  // namespace pnpbs
