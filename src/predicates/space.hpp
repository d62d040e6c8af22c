// SPDX-License-Identifier: BSD-3-Clause
// Exact signs of determinants of points in space, as plane.hpp has them in the plane: a
// floating-point filter first (Shewchuk 1997), exact integers where it cannot decide.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "base/types.hpp"
#include "predicates/filter.hpp"

namespace pnpbs {

namespace predicates {

// Exact, slower, for every finite input.
int orientation_exact(const Point<3>& a, const Point<3>& b, const Point<3>& c, const Point<3>& d);
int in_sphere_exact(const Point<3>& a, const Point<3>& b, const Point<3>& c, const Point<3>& d,
                    const Point<3>& e);
int break_tie(const std::array<Point<3>, 5>& points, const std::array<std::int64_t, 5>& ids);

// Shewchuk's, for his order of the operations, which is that of the code below. To first order, in
// half ulps of the permanent: 3 and 5 for the differences that are multiplied, 4 and 10 for the
// roundings of products and sums that come upon them (but for that of the result itself; the
// longer determinant has one to spare). The terms of second order are rounded up, and with them
// the roundings of the permanent and of its product with the bound.
constexpr double kSpaceOrientationBound = (7 + 56 * kHalfUlp) * kHalfUlp;
constexpr double kInSphereBound = (16 + 224 * kHalfUlp) * kHalfUlp;

// A sum of products, and the same with all its terms taken positive (its permanent).
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

// p x q in the plane of x and y.
inline Estimate cross(const Point<3>& p, const Point<3>& q) {
  const double left = p[0] * q[1], right = q[0] * p[1];
  return {left - right, std::fabs(left) + std::fabs(right)};
}

inline double squared_length(const Point<3>& p) { return p[0] * p[0] + p[1] * p[1] + p[2] * p[2]; }

inline Point<3> difference(const Point<3>& p, const Point<3>& q) {
  return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}

}  // namespace predicates

// The sign of the volume of the tetrahedron a, b, c, d: > 0 if d lies on the side of the plane
// a, b, c to which (b - a) x (c - a) points (from there, a, b, c turn counter-clockwise: the right
// hand's rule), < 0 on the other, 0 exactly in the plane. So it is > 0 for the origin and the
// unit vectors of x, y, z.
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

// For a, b, c, d of positive orientation: > 0 if e lies inside their circumsphere, < 0 outside, 0
// exactly on it.
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
  // What a product loses by underflow is multiplied by three lengths at most.
  const double lifts = (lift_a + lift_b) + (lift_c + lift_d);
  const double error = predicates::kInSphereBound * determinant.permanent +
                       predicates::kUnderflowGuard * (1 + lifts * lifts);
  if (determinant.value > error) return 1;
  if (-determinant.value > error) return -1;
  return predicates::in_sphere_exact(a, b, c, d, e);
}

// The same, but never 0 for distinct ids and not all in one plane: a tie is broken by perturbing
// the points' lifted heights |x|^2 by amounts that fall steeply with the id (the smallest id is
// lifted most), so that all ranks decide alike and the triangulation conforms. Antisymmetric
// under swapping two points (with their ids), invariant under even permutations.
inline int in_sphere_perturbed(const Point<3>& a, const Point<3>& b, const Point<3>& c,
                               const Point<3>& d, const Point<3>& e, std::int64_t id_a,
                               std::int64_t id_b, std::int64_t id_c, std::int64_t id_d,
                               std::int64_t id_e) {
  const int sign = in_sphere(a, b, c, d, e);
  if (sign != 0) return sign;
  return predicates::break_tie({a, b, c, d, e}, {id_a, id_b, id_c, id_d, id_e});
}

}  // namespace pnpbs
