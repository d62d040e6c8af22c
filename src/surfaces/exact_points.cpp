// SPDX-License-Identifier: BSD-3-Clause
#include "surfaces/exact_points.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/index.hpp"
#include "base/mixed_hash.hpp"
#include "predicates/bit_range.hpp"
#include "predicates/filter.hpp"
#include "predicates/plane.hpp"

namespace pnpbs {

namespace {

// Returns the sign of the orientation of three points whose coordinates are each rounded to the
// nearest double, or 0 if the rounding may have changed it. With coordinates up to M and
// differences up to D, a difference has an error of at most 4 u M for u = 2^-53, a product of two
// of 8 u M D + 16 u^2 M^2 + u D^2, and D is at most 2 M.
int rounded_orientation(const Point<2>& a, const Point<2>& b, const Point<2>& c) {
  const double ux = b[0] - a[0], uy = b[1] - a[1], vx = c[0] - a[0], vy = c[1] - a[1];
  const double differences = std::max({std::fabs(ux), std::fabs(uy), std::fabs(vx), std::fabs(vy)});
  const double coordinates = std::max({std::fabs(a[0]), std::fabs(a[1]), std::fabs(b[0]),
                                       std::fabs(b[1]), std::fabs(c[0]), std::fabs(c[1])});
  const double rounding = predicates::kHalfUlp * coordinates;
  const double error =
      32 * rounding * differences + 64 * rounding * rounding + predicates::kUnderflowGuard;
  const double determinant = ux * vy - uy * vx;
  return determinant > error ? 1 : -determinant > error ? -1 : 0;
}

}  // namespace

std::size_t ExactPoints::PositionHash::operator()(const Point<3>& x) const {
  std::uint64_t hash = 0;
  for (const double along : x) hash = mixed_with(hash, along + 0.0);  // -0 is 0
  return hash;
}

ExactPoints::ExactPoints(std::span<const Point<3>> given)
    : given_count_(static_cast<std::int32_t>(given.size())),
      positions_(given.begin(), given.end()),
      exact_index_(given.size(), -1),
      next_(given.size(), -1) {
  BitRange range;
  for (const Point<3>& x : given)
    for (const double along : x) range.include(along);
  lowest_bit_ = range.low;
}

void ExactPoints::use(std::int32_t p) {
  if (exact_index_[index(p)] >= 0) return;
  Homogeneous point;
  for (std::size_t k = 0; k < 3; ++k) point.x[k] = WideInteger(position(p)[k], lowest_bit_);
  point.w = WideInteger(1, 0);
  exact_index_[index(p)] = static_cast<std::int32_t>(exact_.size());
  exact_.push_back(std::move(point));
  const auto [entry, is_new] = first_.try_emplace(position(p), -1);
  next_[index(p)] = entry->second;
  entry->second = p;
}

std::int32_t ExactPoints::index_of(Homogeneous point, std::array<std::int32_t, 2> edge) {
  if (point.w.sign() < 0) {
    for (WideInteger& along : point.x) along = -std::move(along);
    point.w = -std::move(point.w);
  }
  Point<3> position;
  for (std::size_t k = 0; k < 3; ++k)
    position[k] = rounded_quotient(point.x[k], point.w, lowest_bit_);
  const auto [entry, is_new] = first_.try_emplace(position, -1);
  for (std::int32_t p = entry->second; p >= 0; p = next_[index(p)]) {
    const Homogeneous& other = exact(p);
    const auto equal = [&](std::size_t k) {
      return (point.x[k] * other.w - other.x[k] * point.w).sign() == 0;
    };
    if (equal(0) && equal(1) && equal(2)) return p;
  }
  const std::int32_t added = count();
  positions_.push_back(position);
  exact_index_.push_back(static_cast<std::int32_t>(exact_.size()));
  exact_.push_back(std::move(point));
  edges_.push_back(edge);
  next_.push_back(entry->second);
  entry->second = added;
  return added;
}

// Returns the point of the line through a and b at which a function is 0 that is linear in
// homogeneous coordinates and has the values at_a and at_b at these points.
ExactPoints::Homogeneous ExactPoints::combination(const WideInteger& at_a, std::int32_t a,
                                                  const WideInteger& at_b, std::int32_t b) const {
  const Homogeneous &p = exact(a), &q = exact(b);
  Homogeneous point;
  for (std::size_t k = 0; k < 3; ++k) point.x[k] = at_b * p.x[k] - at_a * q.x[k];
  point.w = at_b * p.w - at_a * q.w;
  return point;
}

std::int32_t ExactPoints::on_plane(std::int32_t a, std::int32_t b,
                                   const std::array<std::int32_t, 3>& plane) {
  const auto& origin = exact(plane[0]).x;
  const auto from_origin = [&](std::int32_t p) {
    const auto& x = exact(p).x;
    return std::array{x[0] - origin[0], x[1] - origin[1], x[2] - origin[2]};
  };
  const auto u = from_origin(plane[1]), v = from_origin(plane[2]);
  const std::array normal{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                          u[0] * v[1] - u[1] * v[0]};
  const auto height = [&](std::int32_t p) {
    const auto x = from_origin(p);
    return normal[0] * x[0] + normal[1] * x[1] + normal[2] * x[2];
  };
  return index_of(combination(height(a), a, height(b), b), {std::min(a, b), std::max(a, b)});
}

std::int32_t ExactPoints::on_lines(int k, std::int32_t a, std::int32_t b, std::int32_t c,
                                   std::int32_t d) {
  const WideInteger at_a = determinant(k, a, c, d), at_b = determinant(k, b, c, d);
  return index_of(combination(at_a, a, at_b, b), {std::min(a, b), std::max(a, b)});
}

// Returns the determinant of the homogeneous coordinates of three points in a projection. It has
// the sign of their orientation.
WideInteger ExactPoints::determinant(int k, std::int32_t a, std::int32_t b, std::int32_t c) const {
  const auto u = static_cast<std::size_t>((k + 1) % 3), v = static_cast<std::size_t>((k + 2) % 3);
  const Homogeneous &p = exact(a), &q = exact(b), &r = exact(c);
  return p.w * (q.x[u] * r.x[v] - r.x[u] * q.x[v]) + q.w * (r.x[u] * p.x[v] - p.x[u] * r.x[v]) +
         r.w * (p.x[u] * q.x[v] - q.x[u] * p.x[v]);
}

// Returns whether the points are known to lie on one edge between given points.
bool ExactPoints::on_one_edge(std::int32_t a, std::int32_t b, std::int32_t c) const {
  const std::int32_t last = std::max({a, b, c});
  if (is_given(last)) return false;
  const std::array<std::int32_t, 2>& edge = edges_[index(last - given_count_)];
  for (const std::int32_t p : {a, b, c}) {
    if (p == edge[0] || p == edge[1]) continue;
    if (is_given(p) || edges_[index(p - given_count_)] != edge) return false;
  }
  return true;
}

int ExactPoints::orientation(int k, std::int32_t a, std::int32_t b, std::int32_t c) const {
  if (a == b || b == c || c == a) return 0;
  const Point<2> p = projection(k, position(a)), q = projection(k, position(b)),
                 r = projection(k, position(c));
  if (is_given(a) && is_given(b) && is_given(c)) return pnpbs::orientation(p, q, r);
  if (on_one_edge(a, b, c)) return 0;
  const int sign = rounded_orientation(p, q, r);
  return sign != 0 ? sign : determinant(k, a, b, c).sign();
}

// Compares a coordinate of two points. Rounding to the nearest double keeps the order of
// coordinates, so that exact ones decide only where rounded ones are equal.
int ExactPoints::compare(int axis, std::int32_t a, std::int32_t b) const {
  const auto k = static_cast<std::size_t>(axis);
  const double x = position(a)[k], y = position(b)[k];
  if (x != y) return x < y ? -1 : 1;
  if (a == b || (is_given(a) && is_given(b))) return 0;
  return (exact(a).x[k] * exact(b).w - exact(b).x[k] * exact(a).w).sign();
}

bool ExactPoints::precedes(int k, std::int32_t a, std::int32_t b) const {
  const int first = compare((k + 1) % 3, a, b);
  return first != 0 ? first < 0 : compare((k + 2) % 3, a, b) < 0;
}

}  // namespace pnpbs
