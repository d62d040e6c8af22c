// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace pnpbs {

// Of so many places, for the first of which a condition holds and for the rest not: how many it
// holds for, by bisection.
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
