// SPDX-License-Identifier: BSD-3-Clause
// Finds the nearest of many triangles in space.
#pragma once

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/limits.hpp"
#include "geometry/volume/triangles.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

class NearestTriangles {
 public:
  explicit NearestTriangles(std::vector<FacetCorners<3>> triangles)
      : triangles_(std::move(triangles)) {
    std::vector<Box<3>> boxes;
    for (const FacetCorners<3>& triangle : triangles_) {
      boxes.push_back(empty_box<3>());
      for (const Point<3>& corner : triangle) include(boxes.back(), corner);
    }
    tree_ = BoxTree<3>(std::move(boxes));
  }

  struct Nearest {
    std::int32_t triangle = -1;
    TrianglePoint point;
    double square = HUGE_VAL;  // Squared distance.
  };
  Nearest nearest(const Point<3>& x) const {
    Nearest found;
    tree_.for_near(
        x, [&] { return found.square; },
        [&](std::int32_t t) {
          const TrianglePoint there =
              nearest_triangle_point(triangles_[static_cast<std::size_t>(t)], x);
          const double square = squared_distance<3>(there.x, x);
          if (square < found.square) found = {t, there, square};
        });
    return found;
  }

  const std::vector<FacetCorners<3>>& triangles() const { return triangles_; }

 private:
  std::vector<FacetCorners<3>> triangles_;
  BoxTree<3> tree_;
};

}  // namespace pnpbs
