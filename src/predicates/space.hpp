// SPDX-License-Identifier: BSD-3-Clause
// Exact signs of determinants of points in space. A floating-point filter is evaluated first
// (Shewchuk 1997), exact integers where it cannot decide.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "base/types.hpp"
#include "predicates/filter.hpp"

namespace pnpbs {

namespace predicates {

// Compute the signs of orientation, of in_sphere and of the tie-break exactly for every finite
// input. They are slow.
int orientation_exact(const Point<3>& a, const Point<3>& b, const Point<3>& c, const Point<3>& d);
int in_sphere_exact(const Point<3>& a, const Point<3>& b, const Point<3>& c, const Point<3>& d,
                    const Point<3>& e);
int break_tie(const std::array<Point<3>, 5>& points, const std::array<std::int64_t, 5>& ids);

// Relative error bounds of the two determinants in Shewchuk's order of operations. [permanent]
// To first order, in units of half an ulp, rounding of the differences contributes 3 (orientation)
// and 5 (in_sphere). Rounding of products and sums contributes 4 and 10, without that of the
// result; the bound of in_sphere has one unit to spare. The terms of second order are rounded up
// and also cover the rounding of the permanent and of its product with the bound.
constexpr double kSpaceOrientationBound = (7 + 56 * kHalfUlp) * kHalfUlp;
constexpr double kInSphereBound = (16 + 224 * kHalfUlp) * kHalfUlp;

// A sum of products and its permanent, which is the same sum with all terms positive.
struct Estimate {
  double value;
  double permanent;

  friend Estimate operator+(const Estimate& x, const Estimate& y) {
    return {x.value + y.value, x.permanent + y.permanent};
  }
  friend Estimate operator-(const Estimate& x, const Estimate& y) {
    return {x.value - y.value, x.permanent + y.permanent};
  }
  friend Estimate operator*(double factor, const Estimate& x) {
    return {factor * x.value, std::fabs(factor) * x.permanent};
  }
};

// Returns the cross product of the projections of p and q onto the plane of x and y.
inline Estimate cross(const Point<3>& p, const Point<3>& q) {
  const double left = p[0] * q[1], right = q[0] * p[1];
  return {left - right, std::fabs(left) + std::fabs(right)};
}

inline double squared_length(const Point<3>& p) { return p[0] * p[0] + p[1] * p[1] + p[2] * p[2]; }

inline Point<3> difference(const Point<3>& p, const Point<3>& q) {
  return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}

}  // namespace predicates

// Returns the sign of the volume of the tetrahedron a, b, c, d. It is > 0 if d lies on the side of
// the plane a, b, c to which (b - a) x (c - a) points, < 0 if on the other side, 0 if exactly in
// the plane. For example, it is > 0 for the origin and the unit vectors of x, y, z.
inline int orientation(const Point<3>& a, const Point<3>& b, const Point<3>& c, const Point<3>& d) {
  using predicates::cross, predicates::difference, predicates::Estimate;
  const Point<3> ad = difference(a, d), bd = difference(b, d), cd = difference(c, d);
  const Estimate volume = ad[2] * cross(cd, bd) + bd[2] * cross(ad, cd) + cd[2] * cross(bd, ad);
  const double heights = std::fabs(ad[2]) + std::fabs(bd[2]) + std::fabs(cd[2]);
  const double error = predicates::kSpaceOrientationBound * volume.permanent +
                       predicates::kUnderflowGuard * (1 + heights);
  if (volume.value > error) return 1;
  if (-volume.value > error) return -1;
  return predicates::orientation_exact(a, b, c, d);
}

// Returns > 0 if e is inside the circumsphere of a, b, c, d, < 0 if outside, 0 if exactly on it.
// The orientation of a, b, c, d must be positive.
inline int in_sphere(const Point<3>& a, const Point<3>& b, const Point<3>& c, const Point<3>& d,
                     const Point<3>& e) {
  using predicates::cross, predicates::difference, predicates::Estimate;
  const Point<3> ae = difference(a, e), be = difference(b, e);
  const Point<3> ce = difference(c, e), de = difference(d, e);
  const Estimate ab = cross(ae, be), bc = cross(be, ce), cd = cross(ce, de), da = cross(de, ae);
  const Estimate ac = cross(ae, ce), bd = cross(be, de);
  const Estimate abc = ae[2] * bc - be[2] * ac + ce[2] * ab;
  const Estimate bcd = be[2] * cd - ce[2] * bd + de[2] * bc;
  const Estimate cda = ce[2] * da + de[2] * ac + ae[2] * cd;
  const Estimate dab = de[2] * ab + ae[2] * bd + be[2] * da;
  const double lift_a = predicates::squared_length(ae), lift_b = predicates::squared_length(be);
  const double lift_c = predicates::squared_length(ce), lift_d = predicates::squared_length(de);
  const Estimate determinant = (lift_c * dab - lift_d * abc) + (lift_a * bcd - lift_b * cda);
  // The underflow error of a product is multiplied by three lengths at most.
  const double lifts = (lift_a + lift_b) + (lift_c + lift_d);
  const double error = predicates::kInSphereBound * determinant.permanent +
                       predicates::kUnderflowGuard * (1 + lifts * lifts);
  if (determinant.value > error) return 1;
  if (-determinant.value > error) return -1;
  return predicates::in_sphere_exact(a, b, c, d, e);
}

// Returns in_sphere, but never 0 if the ids are distinct and the points are not all in one plane. A
// tie is broken by a perturbation of the lifted heights |x|^2 that falls steeply with the id: the
// smallest id is lifted most. Therefore all ranks decide equally and the triangulation conforms.
// The result is antisymmetric when two points and their ids are swapped.
inline int in_sphere_perturbed(const Point<3>& a, const Point<3>& b, const Point<3>& c,
                               const Point<3>& d, const Point<3>& e, std::int64_t id_a,
                               std::int64_t id_b, std::int64_t id_c, std::int64_t id_d,
                               std::int64_t id_e) {
  const int sign = in_sphere(a, b, c, d, e);
  if (sign != 0) return sign;
  return predicates::break_tie({a, b, c, d, e}, {id_a, id_b, id_c, id_d, id_e});
}

}  // namespace pnpbs
