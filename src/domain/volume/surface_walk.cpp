// SPDX-License-Identifier: BSD-3-Clause
#include "domain/volume/surface_walk.hpp"

#include <algorithm>

#include "base/space_vectors.hpp"
#include "geometry/volume/triangles.hpp"

namespace pnpbs {

namespace {

// Most facets crossed in one move; no intended move crosses as many.
constexpr int kMaxFacets = 10000;

int next(int k) { return (k + 1) % 3; }

Point<3> edge_direction(const FacetCorners<3>& corners, int k) {
  return unit_vector(
      difference(corners[static_cast<std::size_t>(next(k))], corners[static_cast<std::size_t>(k)]));
}

// The point at which a path leaves a facet.
struct Exit {
  int k = -1;       // edge that it crosses; -1: it ends in the facet
  double part = 1;  // fraction of the path up to there
};

// Returns where the path leaves the facet. Ignores edge `entry`, through which it came.
Exit exit_of(const FacetCorners<3>& corners, const Point<3>& normal, const Point<3>& x,
             const Point<3>& move, int entry) {
  Exit exit;
  for (int k = 0; k < 3; ++k) {
    if (k == entry) continue;
    const Point<3> inward = cross(normal, edge_direction(corners, k));
    const double speed = -dot(inward, move);
    if (!(speed > 0)) continue;
    const double gap = dot(inward, difference(x, corners[static_cast<std::size_t>(k)]));
    const double part = std::max(0.0, gap) / speed;
    if (part < exit.part) exit = {k, part};
  }
  return exit;
}

// Returns the index in facet g of the edge that is edge k of facet f.
int same_edge(const Surface& surface, std::int32_t f, int k, std::int32_t g) {
  const auto& own = surface.facet(f).nodes;
  const auto& other = surface.facet(g).nodes;
  int same = 0;
  while (other[static_cast<std::size_t>(same)] != own[static_cast<std::size_t>(next(k))] ||
         other[static_cast<std::size_t>(next(same))] != own[static_cast<std::size_t>(k)])
    ++same;
  return same;
}

// Calls visit(facet) for the other facets of the patch around corner k of facet f.
template <class Visit>
void for_facets_around(const Surface& surface, std::int32_t f, int k, const Visit& visit) {
  for (const bool left : {true, false}) {
    std::int32_t at = f;
    int corner = k;
    while (true) {
      const int through = left ? (corner + 2) % 3 : corner;
      const std::int32_t to = surface.across(at, through);
      if (to == f) return;
      if (to < 0) break;
      const int entry = same_edge(surface, at, through, to);
      corner = left ? entry : next(entry);
      at = to;
      visit(at);
    }
  }
}

// The point of a facet nearest to a given point.
struct Foot {
  double squared_gap;
  SurfacePoint at;
  bool inside;  // inside the facet, so no other facet has a point as near

  bool operator<(const Foot& other) const {
    return squared_gap < other.squared_gap ||
           (squared_gap == other.squared_gap && at.facet < other.at.facet);
  }
};

Foot foot_on(const Surface& surface, std::int32_t f, const Point<3>& x) {
  const TrianglePoint nearest = nearest_triangle_point(surface.corners(f), x);
  constexpr double kMargin = 1e-12;
  const auto [v, w] = nearest.along;
  return {squared_distance<3>(nearest.x, x),
          {f, nearest.x},
          v > kMargin && w > kMargin && v + w < 1 - kMargin};
}

}  // namespace

SurfacePoint walk(const Surface& surface, const SurfacePoint& from, const Point<3>& move) {
  SurfacePoint at = from;
  Point<3> rest = part_across(move, surface.normal(at.facet));
  int entry = -1;
  for (int facets = 0; facets < kMaxFacets; ++facets) {
    const FacetCorners<3> corners = surface.corners(at.facet);
    const Point<3>& normal = surface.normal(at.facet);
    const Exit exit = exit_of(corners, normal, at.position, rest, entry);
    at.position = shifted(at.position, exit.part, rest);
    if (exit.k < 0) break;
    const std::int32_t beyond = surface.across(at.facet, exit.k);
    if (beyond < 0) break;
    const Point<3> edge = edge_direction(corners, exit.k);
    const double along = (1 - exit.part) * dot(rest, edge);
    const double out = (1 - exit.part) * -dot(rest, cross(normal, edge));
    rest = shifted(shifted({}, along, edge), -out, cross(surface.normal(beyond), edge));
    entry = same_edge(surface, at.facet, exit.k, beyond);
    at.facet = beyond;
  }
  return {at.facet, nearest_on(surface.corners(at.facet), at.position)};
}

SurfacePoint pull_back(const Surface& surface, const Point<3>& x, std::int32_t facet) {
  Foot best = foot_on(surface, facet, x);
  while (!best.inside) {
    Foot better = best;
    for (int k = 0; k < 3; ++k)
      for_facets_around(surface, best.at.facet, k,
                        [&](std::int32_t f) { better = std::min(better, foot_on(surface, f, x)); });
    if (!(better < best)) break;
    best = better;
  }
  return best.at;
}

}  // namespace pnpbs
