// SPDX-License-Identifier: BSD-3-Clause
#include "predicates/space.hpp"

#include <algorithm>

#include "predicates/bit_range.hpp"
#include "predicates/expansion.hpp"
#include "predicates/fixed_integer.hpp"
#include "predicates/wide_integer.hpp"

namespace pnpbs::predicates {

namespace {

template <std::size_t Count, class Number>
using Vectors = std::array<std::array<Number, 3>, Count>;

// Exact difference vectors from one point to others, and the range of bits that they use. Each
// component is the sum of two terms, the second of which is mostly 0. The range is narrower than
// that of the coordinates if the points are near each other and far from the origin.
template <std::size_t Count>
struct Differences {
  Vectors<Count, TwoTerms> terms;
  BitRange range;
};

// Magnitude below which two_sum does not overflow.
constexpr double kMaxSum = 0x1p1020;

template <std::size_t Count>
Differences<Count> exact_differences(const std::array<Point<3>, Count>& points,
                                     const Point<3>& from) {
  Differences<Count> result;
  for (std::size_t i = 0; i < Count; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      TwoTerms terms = two_sum(points[i][k], -from[k]);
      if (!(std::fabs(terms.high) < kMaxSum)) terms = {points[i][k], -from[k]};
      result.range.include(terms.high);
      if (terms.low != 0) result.range.include(terms.low);
      result.terms[i][k] = terms;
    }
  }
  return result;
}

template <class Number, std::size_t Count>
Vectors<Count, Number> integers(const Differences<Count>& differences) {
  Vectors<Count, Number> result;
  const int lowest = differences.range.low;
  for (std::size_t i = 0; i < Count; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const TwoTerms& terms = differences.terms[i][k];
      result[i][k] = Number(terms.high, lowest);
      if (terms.low != 0) result[i][k] = result[i][k] + Number(terms.low, lowest);
    }
  }
  return result;
}

// Largest bit range of the terms for which the determinants below fit into integers of `Words`
// words per factor. A difference has one bit more than its terms. At most 72 products of five
// differences are added (4 volumes of 6 products, and lifts of 3), which takes 7 bits. ShortInteger
// has 127 bits in all: 5 * 24 + 7.
constexpr int kShortBits = 23;
template <int Words>
constexpr int kFixedBits = 64 * Words - 3;

template <class Sign, std::size_t Count>
int exact_sign(const std::array<Point<3>, Count>& points, const Point<3>& from, const Sign& sign) {
  const Differences<Count> differences = exact_differences(points, from);
  const int bits = differences.range.high - differences.range.low;
  if (bits <= kShortBits) return sign(integers<ShortInteger>(differences));
  if (bits <= kFixedBits<1>) return sign(integers<FixedInteger<1>>(differences));
  if (bits <= kFixedBits<2>) return sign(integers<FixedInteger<2>>(differences));
  return sign(integers<WideInteger>(differences));
}

// Returns the cross product of the projections of p and q onto the plane of x and y.
template <class Number>
auto integer_cross(const std::array<Number, 3>& p, const std::array<Number, 3>& q) {
  return p[0] * q[1] - q[0] * p[1];
}

template <class Number>
auto integer_lift(const std::array<Number, 3>& p) {
  return p[0] * p[0] + p[1] * p[1] + p[2] * p[2];
}

template <class Number>
int orientation_sign(const Vectors<3, Number>& from_d) {
  const auto& [a, b, c] = from_d;
  return (a[2] * integer_cross(c, b) + b[2] * integer_cross(a, c) + c[2] * integer_cross(b, a))
      .sign();
}

template <class Number>
int in_sphere_sign(const Vectors<4, Number>& from_e) {
  const auto& [a, b, c, d] = from_e;
  const auto ab = integer_cross(a, b), bc = integer_cross(b, c), cd = integer_cross(c, d);
  const auto da = integer_cross(d, a), ac = integer_cross(a, c), bd = integer_cross(b, d);
  const auto abc = a[2] * bc - b[2] * ac + c[2] * ab;
  const auto bcd = b[2] * cd - c[2] * bd + d[2] * bc;
  const auto cda = c[2] * da + d[2] * ac + a[2] * cd;
  const auto dab = d[2] * ab + a[2] * bd + b[2] * da;
  return ((integer_lift(c) * dab - integer_lift(d) * abc) +
          (integer_lift(a) * bcd - integer_lift(b) * cda))
      .sign();
}

}  // namespace

int orientation_exact(const Point<3>& a, const Point<3>& b, const Point<3>& c, const Point<3>& d) {
  return exact_sign(std::array{a, b, c}, d,
                    [](const auto& from_d) { return orientation_sign(from_d); });
}

int in_sphere_exact(const Point<3>& a, const Point<3>& b, const Point<3>& c, const Point<3>& d,
                    const Point<3>& e) {
  return exact_sign(std::array{a, b, c, d}, e,
                    [](const auto& from_e) { return in_sphere_sign(from_e); });
}

// As in the plane, the heights |x|^2 of the points are perturbed symbolically, that of the smallest
// id most. The derivative of the determinant by a height is, up to sign, the orientation of the
// other four points.
int break_tie(const std::array<Point<3>, 5>& points, const std::array<std::int64_t, 5>& ids) {
  std::array<int, 5> order{0, 1, 2, 3, 4};
  const auto by_id = [&ids](int x, int y) { return ids[x] < ids[y]; };
  // The first one decides in most cases.
  for (auto next = order.begin(); next != order.end(); ++next) {
    std::iter_swap(next, std::min_element(next, order.end(), by_id));
    const auto other = [&](int k) { return points[k < *next ? k : k + 1]; };
    const int volume = orientation(other(0), other(1), other(2), other(3));
    if (volume != 0) return *next % 2 == 0 ? -volume : volume;
  }
  return 0;
}

}  // namespace pnpbs::predicates
