// SPDX-License-Identifier: BSD-3-Clause
// The stereographic projection of a sphere from one of its points, the projection centre (J.
// Snyder, Map projections: a working manual, U.S. Geological Survey Professional Paper 1395, 1987,
// section 21).
// It preserves angles, and maps circles to circles. Therefore bubbles of the sphere are bubbles of
// the plane whose spacing is multiplied by the stretch, and the Delaunay triangles of the nodes are
// the same in both.
#pragma once

#include <array>
#include <cstdint>

#include "base/types.hpp"

namespace pnpbs {

class StereographicChart {
 public:
  // Constructs the chart of the sphere about the origin whose projection centre is in the direction
  // `from`, which must not be 0.
  StereographicChart(double radius, const Point<3>& from);

  bool operator==(const StereographicChart&) const = default;

  double radius() const { return radius_; }
  Point<3> projection_centre() const;  // The projection centre, on the sphere.

  // Returns the image of the point of the sphere on the ray from the origin through x. It is
  // infinite for the projection centre.
  Point<2> in_chart(const Point<3>& x) const;
  // Returns the point of the sphere with image u. It is exact up to rounding.
  Point<3> on_sphere(const Point<2>& u) const;

  // Returns the ratio of a length in the chart to the same length on the sphere. It is 1 opposite
  // the projection centre and larger everywhere else.
  double stretch(const Point<2>& u) const;
  // Values of d that are known at points with this stretch or more are not converted to the chart,
  // because these points are too close to the projection centre.
  static constexpr double kMaxStretch = 1e12;
  double min_stretch_in(const Box<2>& box) const;
  double max_stretch_in(const Box<2>& box) const;
  // Returns whether the largest stretch in the box is more than four times the smallest.
  bool varies_much_in(const Box<2>& box) const;
  // Returns the relative growth of the stretch per length in the chart.
  double relative_growth(const Point<2>& u) const;
  // Returns the distance along the sphere between two points of the chart.
  double distance(const Point<2>& u, const Point<2>& v) const;

 private:
  double radius_;
  // Right-handed, seen from outside; up_ is opposite the projection centre.
  Point<3> east_, north_, up_;
};

// Calls work(begin, count, x) for batches of points of the chart, where x are their points in
// space.
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
