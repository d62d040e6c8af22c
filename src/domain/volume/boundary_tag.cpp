// SPDX-License-Identifier: BSD-3-Clause
#include "domain/volume/boundary_tag.hpp"

#include <algorithm>
#include <cstddef>

#include "base/space_vectors.hpp"
#include "geometry/volume/triangles.hpp"

namespace pnpbs {

namespace {

// Finds the facet nearest to the centroid of a triangle.
class NearestFacet {
 public:
  NearestFacet(const VolumeDomain& domain, const FacetCorners<3>& triangle)
      : domain_(domain),
        middle_(centroid(triangle)),
        outward_(cross(difference(triangle[1], triangle[0]), difference(triangle[2], triangle[0]))),
        first_reach_(distance<3>(triangle[0], middle_)) {}

  // Returns the nearest facet for which count(facet) is true, or -1. Returns the first
  // of facets equally near.
  template <class Counts>
  std::int32_t of(const Counts& counts) const {
    const Box<3>& bounds = domain_.bounds();
    const double everywhere =
        length(difference(bounds.high, bounds.low)) + distance<3>(bounds.low, middle_);
    for (double reach = first_reach_;; reach *= 2) {
      double nearest_gap = reach;
      std::int32_t nearest = -1;
      domain_.index().sides().for_facets_near(middle_, reach, [&](std::int32_t f) {
        if ((domain_.filled() && !facet(f).bounds()) || !counts(f)) return;
        const FacetCorners<3> corners = corners_of(domain_.mesh(), facet(f));
        const double gap = distance<3>(nearest_on(corners, middle_), middle_);
        if (gap < nearest_gap || (gap == nearest_gap && f < nearest))
          nearest_gap = gap, nearest = f;
      });
      if (nearest >= 0 || !(reach < everywhere)) return nearest;
    }
  }

  bool faces_away(std::int32_t f) const {
    const double along = dot(facet_normal(domain_.mesh(), facet(f)), outward_);
    return facet(f).front_inside ? along > 0 : along < 0;
  }

 private:
  const BoundaryTriangle& facet(std::int32_t f) const {
    return domain_.mesh().facets[static_cast<std::size_t>(f)];
  }

  const VolumeDomain& domain_;
  Point<3> middle_, outward_;
  double first_reach_;
};

}  // namespace

std::int32_t boundary_tag(const VolumeDomain& domain, const FacetCorners<3>& triangle,
                          std::span<const std::int32_t> patches) {
  const NearestFacet nearest(domain, triangle);
  const auto common = [&](std::int32_t f) {
    const std::int32_t patch = domain.features().patch[static_cast<std::size_t>(f)];
    return std::find(patches.begin(), patches.end(), patch) != patches.end();
  };
  std::int32_t found = -1;
  if (patches.size() == 1) found = nearest.of(common);
  if (found < 0 && !patches.empty())
    found = nearest.of([&](std::int32_t f) { return common(f) && !nearest.faces_away(f); });
  if (found < 0) found = nearest.of([&](std::int32_t f) { return !nearest.faces_away(f); });
  if (found < 0) found = nearest.of([](std::int32_t) { return true; });
  return domain.mesh().facets[static_cast<std::size_t>(found)].tag;
}

}  // namespace pnpbs
