// SPDX-License-Identifier: BSD-3-Clause
// Exact signs of determinants of points in the plane. A floating-point filter is evaluated first,
// exact expansions where it cannot decide. Method: J. R. Shewchuk, "Adaptive precision
// floating-point arithmetic and fast robust geometric predicates", Discrete Comput. Geom. 18 (1997)
// 305-363. The filters are inline because they decide almost always and are evaluated hundreds of
// millions of times.
#pragma once

#include <cmath>
#include <cstdint>

#include "base/types.hpp"
#include "predicates/filter.hpp"

namespace pnpbs {

namespace predicates {

// Compute the signs of turn, of in_circle and of the tie-break exactly for every finite input. They
// are slow.
int turn_exact(const Point<2>& a, const Point<2>& b, const Point<2>& c, const Point<2>& d);
int in_circle_exact(const Point<2>& a, const Point<2>& b, const Point<2>& c, const Point<2>& d);
int break_tie(const Point<2>& a, const Point<2>& b, const Point<2>& c, const Point<2>& d,
              std::int64_t id_a, std::int64_t id_b, std::int64_t id_c, std::int64_t id_d);

constexpr double kOrientationBound = (3 + 16 * kHalfUlp) * kHalfUlp;
constexpr double kInCircleBound = (10 + 96 * kHalfUlp) * kHalfUlp;

}  // namespace predicates

// Returns the sign of the cross product of b - a and d - c: > 0 if the direction from c to d points
// to the left of that from a to b, < 0 if to the right, 0 if the two are parallel or one has length
// 0.
inline int turn(const Point<2>& a, const Point<2>& b, const Point<2>& c, const Point<2>& d) {
  const double left = (b[0] - a[0]) * (d[1] - c[1]);
  const double right = (b[1] - a[1]) * (d[0] - c[0]);
  const double determinant = left - right;
  const double error = predicates::kOrientationBound * (std::fabs(left) + std::fabs(right)) +
                       predicates::kUnderflowGuard;
  if (determinant > error) return 1;
  if (-determinant > error) return -1;
  return predicates::turn_exact(a, b, c, d);
}

// Returns > 0 if a, b, c are counter-clockwise, < 0 if clockwise, 0 if exactly on a line.
inline int orientation(const Point<2>& a, const Point<2>& b, const Point<2>& c) {
  return turn(c, a, c, b);
}

// Returns > 0 if d is inside the circumcircle of a, b, c, < 0 if outside, 0 if exactly on it. a, b,
// c must be counter-clockwise.
inline int in_circle(const Point<2>& a, const Point<2>& b, const Point<2>& c, const Point<2>& d) {
  const double ax = a[0] - d[0], ay = a[1] - d[1];
  const double bx = b[0] - d[0], by = b[1] - d[1];
  const double cx = c[0] - d[0], cy = c[1] - d[1];
  const double bc = bx * cy, cb = by * cx;
  const double ca = cx * ay, ac = cy * ax;
  const double ab = ax * by, ba = ay * bx;
  const double lift_a = ax * ax + ay * ay;
  const double lift_b = bx * bx + by * by;
  const double lift_c = cx * cx + cy * cy;
  const double determinant = lift_a * (bc - cb) + lift_b * (ca - ac) + lift_c * (ab - ba);
  const double permanent = lift_a * (std::fabs(bc) + std::fabs(cb)) +
                           lift_b * (std::fabs(ca) + std::fabs(ac)) +
                           lift_c * (std::fabs(ab) + std::fabs(ba));
  const double error = predicates::kInCircleBound * permanent +
                       predicates::kUnderflowGuard * (1 + lift_a + lift_b + lift_c);
  if (determinant > error) return 1;
  if (-determinant > error) return -1;
  return predicates::in_circle_exact(a, b, c, d);
}

// Returns in_circle, but never 0 if the ids are distinct and the points are not all on a line. A
// tie is broken by a perturbation of the lifted heights |x|^2 that falls steeply with the id: the
// smallest id is lifted most. Therefore all ranks decide equally and the triangulation conforms.
// The result is antisymmetric when two points and their ids are swapped.
inline int in_circle_perturbed(const Point<2>& a, const Point<2>& b, const Point<2>& c,
                               const Point<2>& d, std::int64_t id_a, std::int64_t id_b,
                               std::int64_t id_c, std::int64_t id_d) {
  const int sign = in_circle(a, b, c, d);
  if (sign != 0) return sign;
  return predicates::break_tie(a, b, c, d, id_a, id_b, id_c, id_d);
}

// Returns whether the open segments ab and cd intersect in exactly one point. Segments that touch
// at an end or overlap on a line do not cross properly.
inline bool cross_properly(const Point<2>& a, const Point<2>& b, const Point<2>& c,
                           const Point<2>& d) {
  return orientation(a, b, c) * orientation(a, b, d) < 0 &&
         orientation(c, d, a) * orientation(c, d, b) < 0;
}

}  // namespace pnpbs
