// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay/volume/element_rule.hpp"

#include <algorithm>
#include <cstddef>

#include "predicates/expansion.hpp"

namespace pnpbs {

namespace {

// Numbers of 106 bits. Errors are relative to the terms of a sum.
TwoTerms operator+(const TwoTerms& a, const TwoTerms& b) {
  const TwoTerms sum = two_sum(a.high, b.high);
  return fast_two_sum(sum.high, sum.low + (a.low + b.low));
}

TwoTerms operator-(const TwoTerms& a, const TwoTerms& b) { return a + TwoTerms{-b.high, -b.low}; }

TwoTerms operator*(const TwoTerms& a, const TwoTerms& b) {
  const TwoTerms product = two_product(a.high, b.high);
  return fast_two_sum(product.high, product.low + (a.high * b.low + a.low * b.high));
}

using Vector = std::array<TwoTerms, 3>;

Vector from_to(const Point<3>& p, const Point<3>& q) {
  return {two_sum(q[0], -p[0]), two_sum(q[1], -p[1]), two_sum(q[2], -p[2])};
}

TwoTerms accurate_dot(const Vector& p, const Vector& q) {
  return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
}

Vector accurate_cross(const Vector& p, const Vector& q) {
  return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}

}  // namespace

Tetrahedron ordered_by_id(Tetrahedron corners) {
  std::sort(corners.begin(), corners.end(),
            [](const VolumeNode& a, const VolumeNode& b) { return a.id < b.id; });
  return corners;
}

Tetrahedron tetrahedron_of(const Nodes<3>& nodes, const std::array<std::int64_t, 4>& corners) {
  Tetrahedron tetrahedron;
  for (std::size_t k = 0; k < 4; ++k)
    tetrahedron[k] = {nodes.position(corners[k]), nodes.d(corners[k]), nodes.id(corners[k])};
  return tetrahedron;
}

Point<3> centroid(const Tetrahedron& ordered) {
  Point<3> sum{};
  for (const VolumeNode& corner : ordered)
    for (std::size_t k = 0; k < 3; ++k) sum[k] += corner.x[k];
  for (double& along : sum) along *= 0.25;
  return sum;
}

bool is_element(const Tetrahedron& ordered) {
  const auto& [a, b, c, d] = ordered;
  const Vector u = from_to(a.x, b.x), v = from_to(a.x, c.x), w = from_to(a.x, d.x);
  const Vector vw = accurate_cross(v, w), wu = accurate_cross(w, u), uv = accurate_cross(u, v);
  const TwoTerms uu = accurate_dot(u, u), vv = accurate_dot(v, v), ww = accurate_dot(w, w);
  // Squared length of the vector to the circumcentre times twelve volumes.
  double square = 0;
  const double twelve_volumes = 2 * accurate_dot(u, vw).high;
  for (std::size_t k = 0; k < 3; ++k) {
    const double along = (uu * vw[k] + vv * wu[k] + ww * uv[k]).high;
    square += along * along;
  }
  const double limit = kMaxRadius * std::min({a.d, b.d, c.d, d.d}) * twelve_volumes;
  return square <= limit * limit;
}

}  // namespace pnpbs
