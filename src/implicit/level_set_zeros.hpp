// SPDX-License-Identifier: BSD-3-Clause
// Where a level set is 0 between two points.
#pragma once

#include <vector>

#include "implicit/level_set.hpp"

namespace pnpbs {

// f is negative at one end alone.
struct CrossedSegment {
  Point<3> begin, end;
  double f_begin, f_end;
};

// A point of each where f = 0, or where it changes its sign.
std::vector<Point<3>> zeros_on(const LevelSet& set, const std::vector<CrossedSegment>& segments);

}  // namespace pnpbs
