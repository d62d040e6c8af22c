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
  bool touch;                 // some surfaces end at the surface of the box
  std::vector<char> in_cell;  // nonzero for triangles that stand for their images
  std::vector<RegionPoint<3>> region_points;
  std::vector<FixedNode<3>> fixed_nodes;
};

// Returns the images of the surfaces within `reach` of the cell (domain/images_near_cell.hpp), and
// the surface of a box around the copies that contain them. `divides` is whether surfaces are split
// where they meet.
CopiesOfSurfaces copies_of_cell(const PeriodicCell<3>& cell, double reach, bool divides,
                                const std::array<std::int32_t, 6>& side_tags,
                                const std::array<bool, 3>& flat,
                                const std::vector<SurfaceSource>& surfaces,
                                const std::vector<RegionPoint<3>>& region_points,
                                const std::vector<FixedNode<3>>& fixed_nodes);

}  // namespace pnpbs
