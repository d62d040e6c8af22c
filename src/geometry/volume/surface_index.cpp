// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/volume/surface_index.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "base/space_vectors.hpp"
#include "geometry/facet_index.hpp"
#include "geometry/volume/triangles.hpp"

namespace pnpbs {

namespace {

// Returns whether the plane of the triangle is certainly farther from x than `reach`. Returns false
// if rounding leaves it undecided.
bool plane_is_beyond(const FacetCorners<3>& triangle, const Point<3>& x, double reach) {
  constexpr double kTiny = 1e-10;  // Larger squares have a relative error below 1e-9.
  const auto& [a, b, c] = triangle;
  const Point<3> ab = difference(b, a), ac = difference(c, a), ax = difference(x, a);
  const Point<3> normal = cross(ab, ac);
  const double volume = dot(normal, ax), square = volume * volume;
  return square > kTiny * dot(ab, ab) * dot(ac, ac) * dot(ax, ax) &&
         square > reach * reach * dot(normal, normal);
}

}  // namespace

SurfaceIndex::SurfaceIndex(const BoundaryMesh<3>& mesh, const Box<3>& bounds)
    : sides_(index_facets<3>(mesh, bounds)) {
  std::vector<Box<3>> boxes;
  for (const BoundaryTriangle& facet : mesh.facets) {
    const auto [a, b, c] = corners_of(mesh, facet);
    boxes.push_back(joined(joined(Box<3>{a, a}, {b, b}), {c, c}));
  }
  boxes_ = BoxTree<3>(std::move(boxes));
  for (std::size_t c = 0; c < boxes_.cell_count(); ++c)
    slabs_.push_back(slab_around(boxes_.in_cell(c)));
}

double SurfaceIndex::Slab::gap_to(const Point<3>& x) const {
  const double height = dot(normal, x);
  return std::max(height - high, low - height);
}

// Returns the slab across the mean normal of the facets. Cells of many facets have none, because
// their normals differ too much.
SurfaceIndex::Slab SurfaceIndex::slab_around(std::span<const std::int32_t> facets) const {
  constexpr std::size_t kMostFacets = 256;
  Slab slab;
  if (facets.size() > kMostFacets) return slab;
  Point<3> sum{};
  for (const std::int32_t f : facets) sum = shifted(sum, 1, area_normal(sides_.corners(f)));
  const double size = length(sum);
  if (!(size > 0)) return slab;
  slab.normal = shifted({}, 1 / size, sum);
  slab.low = slab.high = dot(slab.normal, sides_.corners(facets[0])[0]);
  for (const std::int32_t f : facets)
    for (const Point<3>& corner : sides_.corners(f)) {
      slab.low = std::min(slab.low, dot(slab.normal, corner));
      slab.high = std::max(slab.high, dot(slab.normal, corner));
    }
  return slab;
}

// Returns the nearest point of the facets closer to x than `reach`. May skip facets that are
// farther than limit(gap), where `gap` is the distance of the nearest point found so far.
template <class Limit>
NearestPoint<3> SurfaceIndex::nearest_within(const Point<3>& x, double reach,
                                             const Limit& limit) const {
  constexpr double kRounding = 1 + 1e-12;  // Facets at the same distance must not be skipped.
  constexpr double kSurely = 1 + 1e-8;
  NearestPoint<3> best{reach};
  const auto surely = [&] { return kSurely * limit(best.gap) + sides_.room(); };
  boxes_.for_near(
      x, [&] { return kRounding * limit(best.gap) * limit(best.gap); },
      [&](std::size_t cell) { return !(slabs_[cell].gap_to(x) > surely()); },
      [&](std::int32_t f) {
        if (plane_is_beyond(sides_.corners(f), x, surely())) return;
        const Point<3> q = nearest_on(sides_.corners(f), x);
        const double gap = distance<3>(q, x);
        if (gap < best.gap || (gap == best.gap && f < best.facet)) best = {gap, f, q};
      });
  return best;
}

NearestPoint<3> SurfaceIndex::nearest(const Point<3>& x, double reach) const {
  return nearest_within(x, reach, [](double gap) { return gap; });
}

double SurfaceIndex::least_clearance(const Point<3>& x, double exact, double reach) const {
  constexpr double kShare = 0.8;
  const auto limit = [exact](double gap) { return std::min(gap, std::max(exact, kShare * gap)); };
  return std::min(reach, limit(nearest_within(x, reach / kShare, limit).gap));
}

namespace {

// Returns whether the segment from x to x + until * way meets the box. Returns true if rounding
// leaves it undecided.
bool may_meet(const Box<3>& box, const Point<3>& x, const Point<3>& way, double until) {
  constexpr double kRounding = 1e-9;
  double from = 0, to = until;
  for (std::size_t k = 0; k < 3; ++k) {
    const double pad =
        kRounding * (std::fabs(x[k]) + std::fabs(box.low[k]) + std::fabs(box.high[k]));
    const double low = box.low[k] - pad - x[k], high = box.high[k] + pad - x[k];
    if (way[k] == 0) {
      if (low > 0 || high < 0) return false;
      continue;
    }
    const double a = low / way[k], b = high / way[k];
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
  return from <= to + kRounding;
}

}  // namespace

SurfaceIndex::Hit SurfaceIndex::first_hit(const Point<3>& x, const Point<3>& way,
                                          std::int32_t from) const {
  const Point<3> end = shifted(x, 1, way);
  Hit first{1};
  const auto before_first = [&](const Box<3>& box) { return may_meet(box, x, way, first.along); };
  boxes_.for_entered(before_first, [&](std::int32_t f) {
    if (f == from || !crosses(x, end, sides_.corners(f))) return;
    const auto& [a, b, c] = sides_.corners(f);
    const Point<3> normal = cross(difference(b, a), difference(c, a));
    const double along = std::clamp(dot(normal, difference(a, x)) / dot(normal, way), 0.0, 1.0);
    if (first.facet < 0 || std::tie(along, f) < std::tie(first.along, first.facet))
      first = {along, f};
  });
  return first;
}

}  // namespace pnpbs
