// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay/volume/domain_rule.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>

#include "delaunay/volume/circumsphere.hpp"

namespace pnpbs {

namespace {

// Returns whether the volume is a small fraction of that of a regular tetrahedron with the same
// longest edge.
bool is_flat_cap(const TetrahedronCorners& x) {
  constexpr double kFlat = 0.2;
  const Point<3> u = difference(x[1], x[0]), v = difference(x[2], x[0]), w = difference(x[3], x[0]);
  const double longest = longest_edge(x);
  // Six times the volume.
  const double regular = longest * longest * longest * std::numbers::sqrt2 / 2;
  return std::fabs(dot(u, cross(v, w))) < kFlat * regular;
}

// Returns the two edges without a common end that cross in the projection along `up`, the upper one
// first. Returns nothing if one corner is projected into the face of the others.
using EdgePair = std::array<std::array<std::size_t, 2>, 2>;
std::optional<EdgePair> crossing_edges(const TetrahedronCorners& x, const Point<3>& up) {
  constexpr std::array<std::array<std::size_t, 4>, 3> kPairs{
      {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}}};
  for (const auto& [a, b, c, d] : kPairs) {
    const Point<3> ab = difference(x[b], x[a]), cd = difference(x[d], x[c]),
                   ac = difference(x[c], x[a]), across = cross(ab, cd);
    const double square = dot(across, across);
    const double on_ab = dot(cross(ac, cd), across), on_cd = dot(cross(ac, ab), across);
    if (!(on_ab > 0 && on_ab < square && on_cd > 0 && on_cd < square)) continue;
    const bool cd_above = dot(ac, across) * dot(across, up) > 0;
    return cd_above ? EdgePair{{{c, d}, {a, b}}} : EdgePair{{{a, b}, {c, d}}};
  }
  return std::nullopt;
}

// Returns whether the surface without this flat element has the same nodes and feature edges.
// Without it, the edge that crosses its outer edge replaces the outer edge.
bool can_go(const VolumeStarInput& in, const std::array<std::int64_t, 4>& nodes,
            const TetrahedronCorners& x, const Point<3>& middle) {
  if (!in.joined) return true;
  constexpr double kOnSurface = 1e-6;  // Far above rounding.
  const double longest = longest_edge(x);
  const NearestPoint<3> above = in.nearest(middle, longest);
  if (above.gap < kOnSurface * longest) return true;
  const std::optional<EdgePair> edges = crossing_edges(x, difference(above.x, middle));
  if (!edges) return false;
  const auto& outer = edges->front();
  return !in.joined(nodes[outer[0]], nodes[outer[1]]);
}

// Returns whether a flat element lies in or beyond the boundary. In a wall of one element, nodes of
// both sides can lie in one plane across the wall. The elements between them are part of the
// domain, however flat they are.
bool on_boundary(const VolumeStarInput& in, const TetrahedronCorners& x, const Point<3>& middle) {
  constexpr double kSurely = 1e-6;  // Far above rounding.
  const double reach = kSurely * longest_edge(x);
  return in.facets->clearance(middle, reach) < reach || !in.facets->inside(middle);
}

// Returns whether x is nearer to a free node, which is inside, than any facet is. Only nodes at the
// positions of their corners are considered, because `room` is valid for these positions only.
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

// Returns the nodes in the order of their ids.
std::array<std::int64_t, 4> ordered(std::array<std::int64_t, 4> nodes, const Nodes<3>& of) {
  std::ranges::sort(nodes, {}, [&](std::int64_t i) { return of.id(i); });
  return nodes;
}

std::int64_t held_among(const VolumeStarInput& in, const std::array<std::int64_t, 4>& nodes) {
  return std::count_if(nodes.begin(), nodes.end(),
                       [&](std::int64_t i) { return in.nodes.carrier(i) != Carrier::free; });
}

}  // namespace

bool lies_in_boundary(const VolumeStarInput& in, const Tetrahedron& ordered) {
  const TetrahedronCorners x{ordered[0].x, ordered[1].x, ordered[2].x, ordered[3].x};
  return circumsphere(x).flat && on_boundary(in, x, centroid(ordered));
}

bool in_domain(const VolumeStarInput& in, const std::array<std::int64_t, 4>& nodes,
               const Tetrahedron& corners) {
  if (in.facets == nullptr) return true;
  const std::int64_t held_nodes = held_among(in, nodes);
  if (held_nodes < 2) return true;
  const Tetrahedron t = ordered_by_id(corners);
  const Point<3> middle = centroid(t);
  if (held_nodes == 4) {
    if (in.changed_labels != nullptr && in.changed_labels->any())
      if (const bool* label = in.changed_labels->find({t[0].id, t[1].id, t[2].id, t[3].id}))
        return *label;
    const TetrahedronCorners x{t[0].x, t[1].x, t[2].x, t[3].x};
    if (circumsphere(x).flat) return !on_boundary(in, x, middle);
    if (is_flat_cap(x) && in.on_one_surface && in.on_one_surface(nodes) &&
        can_go(in, ordered(nodes, in.nodes), x, middle))
      return false;
  }
  return beside_free_node(in, nodes, corners, middle) || in.facets->inside(middle) ||
         in.facets->on_inner_facet(middle);
}

bool in_domain(const VolumeStarInput& in, const std::array<std::int64_t, 4>& nodes) {
  return held_among(in, nodes) < 2 || in_domain(in, nodes, tetrahedron_of(in.nodes, nodes));
}

}  // namespace pnpbs
