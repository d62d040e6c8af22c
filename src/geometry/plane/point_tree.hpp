// SPDX-License-Identifier: BSD-3-Clause
// A tree of nested boxes around points, which finds the points near a point or a segment for any
// distribution of points.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/types.hpp"

namespace pnpbs {

class PointTree {
 public:
  explicit PointTree(std::vector<Point<2>> points);

  // Calls found(point, distance) for all points within `reach` of segment ab; a can equal b. The
  // order depends on the points only.
  void for_each_near(const Point<2>& a, const Point<2>& b, double reach,
                     const std::function<void(std::int32_t point, double distance)>& found) const;

 private:
  struct Cell {
    Box<2> box;
    std::int32_t begin, end;  // Range in order_.
    std::int32_t child = -1;  // Index of the first of two children.
  };

  void split(std::int32_t cell);

  std::vector<Point<2>> points_;
  std::vector<std::int32_t> order_;
  std::vector<Cell> cells_;
};

}  // namespace pnpbs
