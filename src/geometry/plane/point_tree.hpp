// SPDX-License-Identifier: BSD-3-Clause
// Points sorted into nested boxes, to find those near a point or a segment, however unevenly they
// lie.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/types.hpp"

namespace pnpbs {

class PointTree {
 public:
  explicit PointTree(std::vector<Point<2>> points);

  // Tells all points within `reach` of the segment ab (a may equal b), with their distance, in an
  // order that depends on nothing but the points.
  void for_each_near(const Point<2>& a, const Point<2>& b, double reach,
                     const std::function<void(std::int32_t point, double distance)>& found) const;

 private:
  struct Cell {
    Box<2> box;
    std::int32_t begin, end;  // in order_
    std::int32_t child = -1;  // the first of two
  };

  void split(std::int32_t cell);

  std::vector<Point<2>> points_;
  std::vector<std::int32_t> order_;
  std::vector<Cell> cells_;
};

}  // namespace pnpbs
