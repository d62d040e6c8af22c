// SPDX-License-Identifier: BSD-3-Clause
// The even-odd rule: each piece of the boundary separates the inside of the domain from its
// outside.
#pragma once

#include <cstdint>
#include <vector>

namespace pnpbs {

// Two adjacent regions, and whether the boundary separates them.
struct RegionContact {
  std::int32_t a, b;
  bool by_boundary;
};

// Returns 1 for each region inside the domain and 0 for each outside. Region 0 is outside. All
// regions must be connected to it by contacts.
std::vector<char> inside_by_parity(std::size_t regions, const std::vector<RegionContact>& contacts);

}  // namespace pnpbs
