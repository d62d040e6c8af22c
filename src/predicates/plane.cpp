// SPDX-License-Identifier: BSD-3-Clause
#include "predicates/plane.hpp"

#include <algorithm>
#include <utility>

#include "predicates/bit_range.hpp"
#include "predicates/expansion.hpp"
#include "predicates/wide_integer.hpp"

namespace pnpbs::predicates {

namespace {

// Range of bits in which products of four differences neither overflow nor lose low bits.
constexpr int kLowestBit = -240;
constexpr int kHighestBit = 240;

// Multiplies coordinates by a power of two, which does not change signs, to bring them into the
// range of expansions. Returns false if their bits are too far apart for that.
template <std::size_t N>
bool scale_for_expansions(std::array<Point<2>, N>& points, BitRange& range) {
  for (const Point<2>& point : points) {
    range.include(point[0]);
    range.include(point[1]);
  }
  if (range.low >= kLowestBit && range.high <= kHighestBit) return true;
  if (range.high - range.low > kHighestBit - kLowestBit) return false;
  const int shift = kHighestBit - range.high;
  for (Point<2>& point : points) {
    point = {std::ldexp(point[0], shift), std::ldexp(point[1], shift)};
  }
  return true;
}

template <class Difference>
auto turn_determinant(const std::array<Point<2>, 4>& p, const Difference& difference) {
  const auto abx = difference(p[1][0], p[0][0]), aby = difference(p[1][1], p[0][1]);
  const auto cdx = difference(p[3][0], p[2][0]), cdy = difference(p[3][1], p[2][1]);
  return std::pair{abx * cdy, aby * cdx};
}

Expansion<512> lifted_cross(const Expansion<2>& ax, const Expansion<2>& ay, const Expansion<2>& bx,
                            const Expansion<2>& by, const Expansion<2>& cx,
                            const Expansion<2>& cy) {
  return (ax * ax + ay * ay) * (bx * cy + -(by * cx));
}

WideInteger lifted_cross(const WideInteger& ax, const WideInteger& ay, const WideInteger& bx,
                         const WideInteger& by, const WideInteger& cx, const WideInteger& cy) {
  return (ax * ax + ay * ay) * (bx * cy - by * cx);
}

template <class Difference>
int in_circle_sign(const std::array<Point<2>, 4>& p, const Difference& difference) {
  const auto ax = difference(p[0][0], p[3][0]), ay = difference(p[0][1], p[3][1]);
  const auto bx = difference(p[1][0], p[3][0]), by = difference(p[1][1], p[3][1]);
  const auto cx = difference(p[2][0], p[3][0]), cy = difference(p[2][1], p[3][1]);
  return (lifted_cross(ax, ay, bx, by, cx, cy) + lifted_cross(bx, by, cx, cy, ax, ay) +
          lifted_cross(cx, cy, ax, ay, bx, by))
      .sign();
}

}  // namespace

int turn_exact(const Point<2>& a, const Point<2>& b, const Point<2>& c, const Point<2>& d) {
  std::array<Point<2>, 4> points{a, b, c, d};
  BitRange range;
  if (scale_for_expansions(points, range)) {
    const auto [left, right] = turn_determinant(points, exact_difference);
    return (left + -right).sign();
  }
  const auto wide_difference = [&range](double x, double y) {
    return WideInteger(x, range.low) - WideInteger(y, range.low);
  };
  const auto [left, right] = turn_determinant(points, wide_difference);
  return (left - right).sign();
}

int in_circle_exact(const Point<2>& a, const Point<2>& b, const Point<2>& c, const Point<2>& d) {
  std::array<Point<2>, 4> points{a, b, c, d};
  BitRange range;
  if (scale_for_expansions(points, range)) return in_circle_sign(points, exact_difference);
  return in_circle_sign(points, [&range](double x, double y) {
    return WideInteger(x, range.low) - WideInteger(y, range.low);
  });
}

// The determinant is linear in each lifted height. Its derivative by a height is, up to sign, the
// orientation of the other three points. The first point in order of ids with a non-zero derivative
// decides.
int break_tie(const Point<2>& a, const Point<2>& b, const Point<2>& c, const Point<2>& d,
              std::int64_t id_a, std::int64_t id_b, std::int64_t id_c, std::int64_t id_d) {
  struct Lifted {
    std::int64_t id;
    int which;
  };
  std::array<Lifted, 4> order{{{id_a, 0}, {id_b, 1}, {id_c, 2}, {id_d, 3}}};
  std::sort(order.begin(), order.end(),
            [](const Lifted& x, const Lifted& y) { return x.id < y.id; });
  for (const Lifted& lifted : order) {
    int derivative = 0;
    if (lifted.which == 0) derivative = orientation(b, c, d);
    if (lifted.which == 1) derivative = -orientation(a, c, d);
    if (lifted.which == 2) derivative = orientation(a, b, d);
    if (lifted.which == 3) derivative = -orientation(a, b, c);
    if (derivative != 0) return derivative;
  }
  return 0;
}

}  // namespace pnpbs::predicates
