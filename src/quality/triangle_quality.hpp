// SPDX-License-Identifier: BSD-3-Clause
// Quality and angles of triangles in the plane and in space.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/space_vectors.hpp"
#include "base/types.hpp"

namespace pnpbs {

// Returns the quality 2 r_in / R of a triangle: 1 if equilateral, 0 if degenerate, negative if
// oriented clockwise.
inline double triangle_quality(const Point<2>& a, const Point<2>& b, const Point<2>& c) {
  const double twice_area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  const double ab = distance<2>(a, b), bc = distance<2>(b, c), ca = distance<2>(c, a);
  const double product = ab * bc * ca * (ab + bc + ca);
  return product > 0 ? 4 * twice_area * std::fabs(twice_area) / product : 0.0;
}

// Returns the quality 2 r_in / R of a triangle in space, which is never negative.
inline double triangle_quality(const Point<3>& a, const Point<3>& b, const Point<3>& c) {
  const Point<3> normal = cross(difference(b, a), difference(c, a));
  const double ab = distance<3>(a, b), bc = distance<3>(b, c), ca = distance<3>(c, a);
  const double product = ab * bc * ca * (ab + bc + ca);
  return product > 0 ? 4 * dot(normal, normal) / product : 0.0;
}

// Returns the dot product of b - a and c - a.
template <std::size_t Dim>
double dot_from(const std::array<double, Dim>& a, const std::array<double, Dim>& b,
                const std::array<double, Dim>& c) {
  double product = 0;
  for (std::size_t k = 0; k < Dim; ++k) product += (b[k] - a[k]) * (c[k] - a[k]);
  return product;
}

// Returns the cosine of the angle at a.
template <std::size_t Dim>
double angle_cosine(const std::array<double, Dim>& a, const std::array<double, Dim>& b,
                    const std::array<double, Dim>& c) {
  return dot_from(a, b, c) /
         (distance<static_cast<int>(Dim)>(a, b) * distance<static_cast<int>(Dim)>(a, c));
}

// Returns whether an angle with this cosine exceeds 90 degrees by more than rounding errors.
inline bool is_obtuse(double cosine) { return cosine < -1e-10; }

// Returns whether the angle at a is obtuse. Avoids square roots in most cases.
template <std::size_t Dim>
bool is_obtuse_at(const std::array<double, Dim>& a, const std::array<double, Dim>& b,
                  const std::array<double, Dim>& c) {
  return dot_from(a, b, c) < 0 && is_obtuse(angle_cosine(a, b, c));
}

// A lower bound of triangle quality that can be tested without square roots.
class QualityBound {
 public:
  explicit QualityBound(double quality) {
    constexpr double kMargin = 1e-9;  // far above the rounding errors of both formulas
    const double bound = quality > 0 ? quality * (1 + kMargin) : 0;
    factor_ = 3.0 / 16.0 * bound * bound;
  }

  // Returns 1 if a triangle certainly has a quality above the bound, given a lower bound of twice
  // its area and upper bounds of its squared side lengths. This uses a + b + c <= sqrt(3 (a^2 + b^2
  // + c^2)), which is sharp for equilateral triangles. Lengths should be of the order of 1.
  std::int32_t surely_met(double twice_area, double aa, double bb, double cc) const {
    const double square = twice_area * std::fabs(twice_area);
    const double product = (aa * bb) * (cc * (aa + bb + cc));
    return square * std::fabs(square) > factor_ * product + kTiny ? 1 : 0;
  }

 private:
  static constexpr double kTiny = 1e-200;  // smaller products may have lost digits to underflow
  double factor_;
};

}  // namespace pnpbs
