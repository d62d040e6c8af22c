// SPDX-License-Identifier: BSD-3-Clause
// A convex piece of a line or of a plane, which planes cut.
#pragma once

#include <cstddef>
#include <vector>

#include "base/space_vectors.hpp"

namespace pnpbs {

// Extent: 1 for a segment, 2 for a polygon. Memory is kept for the next piece.
template <int Dim, int Extent>
class ConvexPiece {
 public:
  void clear() { points_.clear(); }
  void add(const Point<Dim>& point) { points_.push_back(point); }
  const std::vector<Point<Dim>>& points() const { return points_; }

  // Keeps the side on which value(point), which is linear, is positive. with_zero: what lies
  // wholly where it is zero is kept, too.
  template <class Value>
  void cut(const Value& value, bool with_zero) {
    const std::size_t n = points_.size();
    if (n == 0) return;
    values_.clear();
    bool all = true;
    for (const Point<Dim>& point : points_) {
      values_.push_back(value(point));
      all = all && inside(values_.back(), with_zero);
    }
    if (all) return;
    kept_.clear();
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t next = i + 1 < n ? i + 1 : 0;
      const bool in = inside(values_[i], with_zero), next_in = inside(values_[next], with_zero);
      if (in) kept_.push_back(points_[i]);
      if (in == next_in || (Extent == 1 && next == 0)) continue;
      kept_.push_back(in ? crossing(i, next) : crossing(next, i));
    }
    points_.swap(kept_);
  }

  // Length or area.
  double measure() const {
    if (points_.size() <= Extent) return 0;
    if constexpr (Extent == 1)
      return distance<Dim>(points_[0], points_[1]);
    else
      return area();
  }

 private:
  static bool inside(double value, bool with_zero) { return with_zero ? value >= 0 : value > 0; }

  Point<Dim> crossing(std::size_t in, std::size_t out) const {
    const double t = values_[in] / (values_[in] - values_[out]);
    Point<Dim> point;
    for (std::size_t k = 0; k < Dim; ++k)
      point[k] = points_[in][k] + t * (points_[out][k] - points_[in][k]);
    return point;
  }

  double area() const {
    Point<3> sum{};
    for (std::size_t i = 1; i + 1 < points_.size(); ++i) {
      const Point<3> normal =
          cross(difference(points_[i], points_[0]), difference(points_[i + 1], points_[0]));
      for (std::size_t k = 0; k < 3; ++k) sum[k] += normal[k];
    }
    return 0.5 * length(sum);
  }

  std::vector<Point<Dim>> points_, kept_;
  std::vector<double> values_;
};

}  // namespace pnpbs
