// SPDX-License-Identifier: BSD-3-Clause
// Which regions are inside, where each piece of the boundary leads from outside in or from inside
// out.
#pragma once

#include <cstdint>
#include <vector>

namespace pnpbs {

// Two regions that touch; across the boundary or not.
struct RegionContact {
  std::int32_t a, b;
  bool by_boundary;
};

// Of each region: 1 inside, 0 not. Region 0 is outside, and contacts lead from there to all.
std::vector<char> inside_by_parity(std::size_t regions, const std::vector<RegionContact>& contacts);

}  // namespace pnpbs
