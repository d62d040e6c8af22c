// SPDX-License-Identifier: BSD-3-Clause
// The copies of a periodic domain of the plane around its cell, as one domain that is not periodic.
// Nodes are placed in the cell only. Their images lie in the copies, where inside and boundary are
// those of the cell.
#pragma once

#include <cstdint>
#include <vector>

#include "base/periodic_cell.hpp"
#include "domain/domain_base.hpp"
#include "domain/plane/curve_source.hpp"
#include "domain/plane/plane_domain.hpp"

namespace pnpbs {

struct CopiesOfCell {
  std::vector<CurveSource> sources;
  std::vector<RegionPoint<2>> region_points;
  std::vector<FixedNode<2>> fixed_nodes;
  std::vector<char>
      in_cell;  // nonzero for sources as they were given, and for the sides of the cell
};

// Returns the images of the curves within `reach` of the cell (domain/images_near_cell.hpp), and a
// boundary around the copies that contain them. Across the axes with `flat`, the sides of each copy
// are inner curves, so that no element crosses them.
CopiesOfCell copies_of_cell(const PeriodicCell<2>& cell, double reach,
                            const std::array<std::int32_t, 4>& side_tags,
                            const std::array<bool, 2>& flat,
                            const std::vector<CurveSource>& sources,
                            const std::vector<RegionPoint<2>>& region_points,
                            const std::vector<FixedNode<2>>& fixed_nodes);

// Returns the area of one period of the domain.
double area_of_cell(const PeriodicCell<2>& cell, const std::vector<BoundaryCurve>& curves,
                    const std::vector<char>& in_cell);

}  // namespace pnpbs
