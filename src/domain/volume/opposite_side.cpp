// SPDX-License-Identifier: BSD-3-Clause
#include "domain/volume/opposite_side.hpp"

#include <cmath>

#include "base/space_vectors.hpp"

namespace pnpbs {

std::optional<SurfacePoint> opposite_side(const Surface& surface, const SurfaceIndex& index,
                                          const SurfacePoint& at, SideOfFacet side, double reach) {
  constexpr double kParallel = 0.9;   // smallest cosine between the normals of the two facets
  constexpr double kOffFacet = 1e-6;  // offset that excludes the facets around the point [reach]
  const Point<3>& normal = surface.normal(at.facet);
  const double ahead = side == SideOfFacet::front ? reach : -reach;
  const Point<3> from = shifted(at.position, kOffFacet * ahead, normal);
  const Point<3> way = shifted({}, ahead, normal);
  const SurfaceIndex::Hit hit = index.first_hit(from, way, at.facet);
  if (hit.facet < 0 || surface.patch(hit.facet) < 0) return std::nullopt;
  if (std::fabs(dot(normal, surface.normal(hit.facet))) < kParallel) return std::nullopt;
  return SurfacePoint{hit.facet, shifted(from, hit.along, way)};
}

}  // namespace pnpbs
