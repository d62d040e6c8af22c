// SPDX-License-Identifier: BSD-3-Clause
// A sphere but for one point of it as a plane: the stereographic projection from that point (J.
// Snyder, Map projections: a working manual, U.S. Geological Survey Professional Paper 1395, 1987,
// section 21). It keeps angles, and circles are circles. So bubbles of the sphere are bubbles of
// the plane, of the spacing times the stretch there, and the Delaunay triangles of the nodes are
// the same in both.
#pragma once

#include <array>
#include <cstdint>

#include "base/types.hpp"

namespace pnpbs {

class StereographicChart {
 public:
  // About the origin of space; from the point of the sphere in the direction `from`, which is not
  // 0.
  StereographicChart(double radius, const Point<3>& from);

  bool operator==(const StereographicChart&) const = default;

  double radius() const { return radius_; }
  Point<3> projected_from() const;  // on the sphere

  // Of a point in space, which is taken along the ray from the origin. Infinite for the point that
  // is projected from.
  Point<2> in_chart(const Point<3>& x) const;
  // Exact but for rounding.
  Point<3> on_sphere(const Point<2>& u) const;

  // A length in the chart over that on the sphere: 1 opposite to the point projected from, and more
  // everywhere else.
  double stretch(const Point<2>& u) const;
  // Where it is this or more, so near to that point, the chart has no place for what is known of d.
  static constexpr double kMostStretch = 1e12;
  double least_stretch_in(const Box<2>& box) const;
  double most_stretch_in(const Box<2>& box) const;
  // Is it so different in the box that a few samples of a length there tell nothing of the others?
  bool varies_much_in(const Box<2>& box) const;
  // By how much the stretch grows, over itself, per length in the chart.
  double relative_growth(const Point<2>& u) const;
  // Along the sphere, between points of the chart.
  double distance(const Point<2>& u, const Point<2>& v) const;

 private:
  double radius_;
  Point<3> east_, north_, up_;  // right-handed, seen from outside; up: away from the point
};

// A function of points in space at points of the chart, so many in one call.
template <class Work>
void for_points_on_sphere(const StereographicChart& chart, std::int64_t n, const Point<2>* u,
                          const Work& work) {
  constexpr std::int64_t kAtOnce = 1024;
  std::array<Point<3>, kAtOnce> x;
  for (std::int64_t begin = 0; begin < n; begin += kAtOnce) {
    const std::int64_t count = n - begin < kAtOnce ? n - begin : kAtOnce;
    for (std::int64_t i = 0; i < count; ++i)
      x[static_cast<std::size_t>(i)] = chart.on_sphere(u[begin + i]);
    work(begin, count, x.data());
  }
}

}  // namespace pnpbs
