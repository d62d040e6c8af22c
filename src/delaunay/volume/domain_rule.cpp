// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay/volume/domain_rule.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "delaunay/volume/circumsphere.hpp"

namespace pnpbs {

namespace {

// Is it so thin that its volume is a small part of a regular one with its longest edge?
bool is_flat_cap(const TetrahedronCorners& x) {
  constexpr double kFlat = 0.2;
  const Point<3> u = difference(x[1], x[0]), v = difference(x[2], x[0]), w = difference(x[3], x[0]);
  const double longest = longest_edge(x);
  const double regular = longest * longest * longest * std::numbers::sqrt2 / 2;  // six times
  return std::fabs(dot(u, cross(v, w))) < kFlat * regular;
}

// Is a flat one on the boundary? (In a wall of one element, nodes of both its sides may lie in a
// plane across it: what is between them there is an element, however flat.)
bool on_boundary(const VolumeStarInput& in, const TetrahedronCorners& x, const Point<3>& middle) {
  constexpr double kSurely = 1e-6;  // far above rounding
  const double reach = kSurely * longest_edge(x);
  return in.facets->clearance(middle, reach) < reach || !in.facets->inside(middle);
}

// Is it nearer to a free node, which is inside, than any facet is? For nodes that are where the
// corners are: elsewhere their room is another.
bool beside_free_node(const VolumeStarInput& in, const std::array<std::int64_t, 4>& nodes,
                      const Tetrahedron& corners, const Point<3>& x) {
  constexpr double kSurely = 0.999;
  if (!in.room) return false;
  for (std::size_t k = 0; k < 4; ++k)
    if (in.nodes.carrier(nodes[k]) == Carrier::free &&
        corners[k].x == in.nodes.position(nodes[k]) &&
        distance<3>(corners[k].x, x) < kSurely * in.room(nodes[k]))
      return true;
  return false;
}

std::int64_t held_among(const VolumeStarInput& in, const std::array<std::int64_t, 4>& nodes) {
  return std::count_if(nodes.begin(), nodes.end(),
                       [&](std::int64_t i) { return in.nodes.carrier(i) != Carrier::free; });
}

}  // namespace

bool in_domain(const VolumeStarInput& in, const std::array<std::int64_t, 4>& nodes,
               const Tetrahedron& corners) {
  if (in.facets == nullptr) return true;
  const std::int64_t held_nodes = held_among(in, nodes);
  if (held_nodes < 2) return true;
  const Tetrahedron t = ordered_by_id(corners);
  if (held_nodes == 4) {
    const TetrahedronCorners x{t[0].x, t[1].x, t[2].x, t[3].x};
    if (circumsphere(x).flat) return !on_boundary(in, x, centroid(t));
    if (is_flat_cap(x) && in.on_one_surface && in.on_one_surface(nodes)) return false;
  }
  const Point<3> middle = centroid(t);
  return beside_free_node(in, nodes, corners, middle) || in.facets->inside(middle) ||
         in.facets->on_inner_facet(middle);
}

bool in_domain(const VolumeStarInput& in, const std::array<std::int64_t, 4>& nodes) {
  return held_among(in, nodes) < 2 || in_domain(in, nodes, tetrahedron_of(in.nodes, nodes));
}

}  // namespace pnpbs
