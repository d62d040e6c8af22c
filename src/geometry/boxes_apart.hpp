// SPDX-License-Identifier: BSD-3-Clause
// A fast test that excludes most pairs of a segment and a facet before they are compared exactly.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace pnpbs {

// Returns whether the bounding boxes of segment pq and of the facet are disjoint.
template <std::size_t Dim>
bool boxes_are_apart(const std::array<double, Dim>& p, const std::array<double, Dim>& q,
                     const std::array<std::array<double, Dim>, Dim>& facet) {
  bool apart = false;
  for (std::size_t k = 0; k < Dim; ++k) {
    double low = facet[0][k], high = low;
    for (std::size_t corner = 1; corner < Dim; ++corner) {
      low = std::min(low, facet[corner][k]);
      high = std::max(high, facet[corner][k]);
    }
    apart = apart | (std::max(p[k], q[k]) < low) | (high < std::min(p[k], q[k]));
  }
  return apart;
}

}  // namespace pnpbs
