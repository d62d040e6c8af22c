// SPDX-License-Identifier: BSD-3-Clause
// Comparison of the volumes of the elements of each region with that of the region.
#pragma once

#include <cstdint>
#include <vector>

#include "check/element_measure.hpp"
#include "results/results.hpp"

namespace pnpbs {

// The volumes of the regions with one tag. The chord error is that of the faces along the surfaces
// around them.
struct RegionMeasure {
  std::int32_t tag = 0;
  ElementMeasure measure;
  std::vector<Point<3>> corners;  // of the faces of this rank to other regions
};

// Returns the measures of the regions whose elements are far off their volume
// (ElementMeasure::far_off), in ascending order of tags. Requires prepare_stars(). Collective.
std::vector<RegionMeasure> regions_far_off(const Results<3>& results);

}  // namespace pnpbs
