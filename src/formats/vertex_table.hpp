// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "base/types.hpp"

namespace pnpbs {

// Numbers points in the order of their first appearance; those with equal coordinates are one.
class VertexTable {
 public:
  std::int32_t index_of(Point<3> x);
  std::vector<Point<3>> take_points() { return std::move(points_); }

 private:
  std::size_t slot_of(const Point<3>& x) const;
  void grow();

  std::vector<Point<3>> points_;
  std::vector<std::int32_t>
      slots_;  // open addressing: of a point or -1; at least half of them free
};

}  // namespace pnpbs
