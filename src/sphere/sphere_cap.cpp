// SPDX-License-Identifier: BSD-3-Clause
#include "sphere/sphere_cap.hpp"

#include <algorithm>
#include <cmath>

#include "base/space_vectors.hpp"

namespace pnpbs {

namespace {

// Generous bound of the rounding error of a result. [of the numbers that enter it]
constexpr double kRounding = 1e-13;
// Largest length of a cap other than the whole sphere. [diameter of the sphere] The planes of
// larger circles are so near the centre of the sphere that it is hard to decide on which side they
// lie, and such a cap leaves out hardly any node.
constexpr double kMostOfDiameter = 0.9;

}  // namespace

SphereCap::SphereCap(const StereographicChart& chart, const Point<2>& centre, double length)
    : chart_(chart),
      centre_(centre),
      length_(length),
      centre_stretch_(chart.stretch(centre)),
      whole_(!(length <= kMostOfDiameter * 2 * chart.radius())) {}

// The chart lengthens a chord by the square root of the stretches at both ends.
bool SphereCap::holds(const Point<2>& u) const {
  return whole_ ||
         squared_distance<2>(centre_, u) <= length_ * length_ * centre_stretch_ * chart_.stretch(u);
}

// The condition is (1 - k) |u|^2 - 2 c u + |c|^2 - 4 k R^2 <= 0 for points u of the cap around c,
// where k is length^2 times the stretch at c over 4 R^2. The left side is a sum of one function for
// each coordinate, which has its minimum where its slope is 0 or at an end of the interval.
bool SphereCap::meets(const Box<2>& box) const {
  if (whole_) return true;
  const double unit = 4 * chart_.radius() * chart_.radius(),
               k = length_ * length_ * centre_stretch_ / unit, curved = 1 - k;
  double least = dot(centre_, centre_) - k * unit, size = dot(centre_, centre_) + k * unit;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const double c = centre_[axis], low = box.low[axis], high = box.high[axis];
    const auto at = [&](double u) { return (curved * u - 2 * c) * u; };
    double here = std::min(at(low), at(high));
    if (curved > 0) here = std::min(here, at(std::clamp(c / curved, low, high)));
    least += here;
    const double far = std::max(std::fabs(low), std::fabs(high));
    size += ((1 + k) * far + 2 * std::fabs(c)) * far;
  }
  return least <= kRounding * size;
}

// The plane of the circle in space cuts the sphere in two parts. For counter-clockwise corners, the
// normal points to the part inside the circle. If this part is the smaller one, no point of it is
// farther from a corner than the diameter of the circle.
bool SphereCap::holds_circle(const Point<2>& a, const Point<2>& b) const {
  if (whole_) return true;
  const double radius = chart_.radius(), room = kRounding * radius;
  const Point<3> x = chart_.on_sphere(centre_), to_a = difference(chart_.on_sphere(a), x),
                 to_b = difference(chart_.on_sphere(b), x);
  const Point<3> across = cross(to_a, to_b);
  const double side_a = length(to_a) + room, side_b = length(to_b) + room,
               side_ab = length(difference(to_a, to_b)) + room;
  // A lower bound of twice the area is required for a safe answer.
  const double twice_area = length(across) - room * (side_a + side_b);
  if (twice_area <= 0 || dot(across, x) <= 0) return false;
  return side_a * side_b * side_ab <= length_ * twice_area;
}

}  // namespace pnpbs
