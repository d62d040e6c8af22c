// SPDX-License-Identifier: BSD-3-Clause
// Numbers of nodes and elements of each region of the domain, and its volume.
#pragma once

#include <cstdint>
#include <vector>

#include "results/results.hpp"

namespace pnpbs {

// The elements with one region tag, over all ranks.
struct RegionFigures {
  std::int32_t tag;    // 0: elements of regions without a tag
  std::int64_t nodes;  // nodes of these elements; those of interfaces belong to several regions
  std::int64_t elements;
  double measure;  // volume, in the plane area, on a sphere area along it
};

// Returns the figures of the regions that have elements, ordered by their tags. The sums are exact,
// so they have the same bits on any number of ranks. There is at least a domain with an inside.
// Collective.
template <int Dim>
std::vector<RegionFigures> region_figures(Results<Dim>& results);

extern template std::vector<RegionFigures> region_figures(Results<2>&);
extern template std::vector<RegionFigures> region_figures(Results<3>&);

}  // namespace pnpbs
