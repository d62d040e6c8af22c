// SPDX-License-Identifier: BSD-3-Clause
// Bisection for the end of a leading range of indices.
#pragma once

#include <cstdint>

namespace pnpbs {

// Returns the number of indices i in 0 <= i < places for which holds(i) is true, by bisection. The
// condition must hold for a leading range of indices and for no other.
template <class Holds>
std::int64_t leading_count(std::int64_t places, const Holds& holds) {
  std::int64_t known = 0, end = places;
  while (known < end) {
    const std::int64_t middle = known + (end - known) / 2;
    if (holds(middle))
      known = middle + 1;
    else
      end = middle;
  }
  return known;
}

}  // namespace pnpbs
