// SPDX-License-Identifier: BSD-3-Clause
// The copies of a periodic domain in space around its cell, as surfaces of one domain that is not
// periodic. Nodes are placed in the cell only. Their images lie in the copies, where inside and
// boundary are those of the cell.
#pragma once

#include <array>
#include <vector>

#include "base/periodic_cell.hpp"
#include "domain/domain_base.hpp"
#include "surfaces/triangulation.hpp"

namespace pnpbs {

struct CopiesOfSurfaces {
  std::vector<SurfaceSource> surfaces;
  std::vector<char> in_cell;  // nonzero for surfaces as they were given
  std::vector<RegionPoint<3>> region_points;
  std::vector<FixedNode<3>> fixed_nodes;
};

// Returns so many copies on each side, and the surface of a box around all of them. Surfaces that
// cross this box are left out; they are about as far from the cell as it is.
CopiesOfSurfaces copies_of_cell(const PeriodicCell<3>& cell, const Image<3>& copies,
                                const std::array<std::int32_t, 6>& side_tags,
                                const std::vector<SurfaceSource>& surfaces,
                                const std::vector<RegionPoint<3>>& region_points,
                                const std::vector<FixedNode<3>>& fixed_nodes);

}  // namespace pnpbs
