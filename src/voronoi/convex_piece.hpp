// SPDX-License-Identifier: BSD-3-Clause
// A convex piece of a line or of a plane, which planes cut.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/space_vectors.hpp"

namespace pnpbs {

// Extent: 1 for a segment, 2 for a polygon. Memory is kept for the next piece.
template <int Dim, int Extent>
class ConvexPiece {
 public:
  void clear() { size_ = 0; }
  void add(const Point<Dim>& point) {
    make_room(size_ + 1);
    points_[size_++] = point;
  }
  bool empty() const { return size_ == 0; }
  std::span<const Point<Dim>> points() const { return std::span(points_).first(size_); }

  // Keeps the side on which value(point), which is linear, is positive. with_zero: what lies
  // wholly where it is zero is kept, too.
  template <class Value>
  void cut(const Value& value, bool with_zero) {
    std::size_t first_out = 0;  // mostly there is none
    while (first_out < size_) {
      values_[first_out] = value(points_[first_out]);
      if (!inside(values_[first_out], with_zero)) break;
      ++first_out;
    }
    if (first_out == size_) return;
    for (std::size_t i = first_out + 1; i < size_; ++i) values_[i] = value(points_[i]);
    keep_inside(with_zero);
  }

  // Length or area.
  double measure() const {
    if (size_ <= Extent) return 0;
    if constexpr (Extent == 1)
      return distance<Dim>(points_[0], points_[1]);
    else
      return area();
  }

 private:
  static bool inside(double value, bool with_zero) { return with_zero ? value >= 0 : value > 0; }

  void keep_inside(bool with_zero) {
    make_room(2 * size_);  // by rounding, more than one side may cross each way
    std::size_t kept = 0;
    bool in = inside(values_[0], with_zero);
    for (std::size_t i = 0; i < size_; ++i) {
      const std::size_t next = i + 1 < size_ ? i + 1 : 0;
      const bool next_in = inside(values_[next], with_zero);
      if (in) kept_[kept++] = points_[i];
      if (in != next_in && !(Extent == 1 && next == 0))
        kept_[kept++] = in ? crossing(i, next) : crossing(next, i);
      in = next_in;
    }
    points_.swap(kept_);
    size_ = kept;
  }

  void make_room(std::size_t points) {
    if (points <= points_.size()) return;
    points_.resize(points);
    kept_.resize(points);
    values_.resize(points);
  }

  Point<Dim> crossing(std::size_t in, std::size_t out) const {
    const double t = values_[in] / (values_[in] - values_[out]);
    Point<Dim> point;
    for (std::size_t k = 0; k < Dim; ++k)
      point[k] = points_[in][k] + t * (points_[out][k] - points_[in][k]);
    return point;
  }

  double area() const {
    Point<3> sum{};
    for (std::size_t i = 1; i + 1 < size_; ++i) {
      const Point<3> normal =
          cross(difference(points_[i], points_[0]), difference(points_[i + 1], points_[0]));
      for (std::size_t k = 0; k < 3; ++k) sum[k] += normal[k];
    }
    return 0.5 * length(sum);
  }

  // All as long as the largest piece so far.
  std::vector<Point<Dim>> points_, kept_;
  std::vector<double> values_;
  std::size_t size_ = 0;
};

}  // namespace pnpbs
