// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay/volume/domain_rule.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "delaunay/volume/circumsphere.hpp"

namespace pnpbs {

namespace {

// The corners' mean, added up in the order of their ids: the same bits whoever asks.
Point<3> centroid(const Tetrahedron& ordered) {
  Point<3> sum{};
  for (const VolumeNode& corner : ordered)
    for (std::size_t k = 0; k < 3; ++k) sum[k] += corner.x[k];
  for (double& along : sum) along *= 0.25;
  return sum;
}

// Is it so thin that its volume is a small part of a regular one with its longest edge?
bool is_flat_cap(const TetrahedronCorners& x) {
  constexpr double kFlat = 0.2;
  const Point<3> u = difference(x[1], x[0]), v = difference(x[2], x[0]), w = difference(x[3], x[0]);
  const double longest = longest_edge(x);
  const double regular = longest * longest * longest * std::numbers::sqrt2 / 2;  // six times
  return std::fabs(dot(u, cross(v, w))) < kFlat * regular;
}

}  // namespace

bool in_domain(const VolumeStarInput& in, const std::array<std::int64_t, 4>& nodes,
               const Tetrahedron& corners) {
  if (in.facets == nullptr) return true;
  const auto held_nodes = std::count_if(nodes.begin(), nodes.end(), [&](std::int64_t i) {
    return in.nodes.carrier(i) != Carrier::free;
  });
  if (held_nodes < 2) return true;
  const Tetrahedron t = ordered_by_id(corners);
  if (held_nodes == 4) {
    const TetrahedronCorners x{t[0].x, t[1].x, t[2].x, t[3].x};
    if (circumsphere(x).flat) return false;
    if (is_flat_cap(x) && in.on_one_surface && in.on_one_surface(nodes)) return false;
  }
  const Point<3> middle = centroid(t);
  return in.facets->inside(middle) || in.facets->on_inner_facet(middle);
}

}  // namespace pnpbs
