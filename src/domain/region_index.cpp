// SPDX-License-Identifier: BSD-3-Clause
#include "domain/region_index.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "base/index.hpp"
#include "base/limits.hpp"
#include "geometry/plane/edges.hpp"
#include "geometry/volume/triangles.hpp"

namespace pnpbs {

namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr double kNear = 1e-6;

Point<2> normal_of(const FacetCorners<2>& edge) {
  return {edge[0][1] - edge[1][1], edge[1][0] - edge[0][0]};
}
Point<3> normal_of(const FacetCorners<3>& triangle) { return area_normal(triangle); }

// Returns the distance from x to the plane of the facet along the first axis.
template <int Dim>
double distance_along_axis(const FacetCorners<Dim>& facet, const Point<Dim>& x) {
  const Point<Dim> normal = normal_of(facet);
  Point<Dim> to;
  for (std::size_t k = 0; k < Dim; ++k) to[k] = facet[0][k] - x[k];
  return dot(normal, to) / normal[0];
}

// Returns 0 if x lies on the first side of the facet, else 1.
std::size_t side_of(const FacetCorners<2>& edge, const Point<2>& x) {
  return orientation(edge[0], edge[1], x) > 0 ? 0 : 1;
}
std::size_t side_of(const FacetCorners<3>& triangle, const Point<3>& x) {
  return orientation(triangle[0], triangle[1], triangle[2], x) > 0 ? 0 : 1;
}

}  // namespace

template <int Dim>
RegionIndex<Dim>::RegionIndex(std::vector<RegionFacet<Dim>> facets) : facets_(std::move(facets)) {
  std::vector<Box<Dim>> boxes;
  Box<Dim> all = empty_box<Dim>();
  for (const RegionFacet<Dim>& facet : facets_) {
    Box<Dim> box = empty_box<Dim>();
    for (const Point<Dim>& corner : facet.corners) include<Dim>(box, corner);
    boxes.push_back(box);
    all = joined(all, box);
  }
  beyond_ = all.high[0] + size_of(all);
  near_ = kNear * size_of(all);
  tree_ = BoxTree<Dim>(std::move(boxes));
}

// Casts a ray along the first axis. The first facet that it crosses determines the region.
template <int Dim>
std::int32_t RegionIndex<Dim>::tag_at(const Point<Dim>& x) const {
  Point<Dim> end = x;
  end[0] = beyond_;
  double nearest = kFar;
  const RegionFacet<Dim>* first = nullptr;
  tree_.for_meeting({x, end}, [&](std::int32_t f) {
    const RegionFacet<Dim>& facet = facets_[index(f)];
    if (!crosses(x, end, facet.corners)) return;
    const double way = distance_along_axis<Dim>(facet.corners, x);
    if (first && !(way < nearest || (way == nearest && &facet < first))) return;
    nearest = way;
    first = &facet;
  });
  if (!first) return tag_behind_nearest_facet(x);
  const std::size_t side = side_of(first->corners, x);
  return first->inside[side] ? first->tags[side] : tag_behind_nearest_facet(x);
}

template <int Dim>
void RegionIndex<Dim>::tags_at(const Point<Dim>& x, std::int32_t columns,
                               std::int32_t* tags) const {
  std::fill_n(tags, columns, tag_at(x));
  if (columns == 1) return;
  std::vector<std::int32_t> others;
  tree_.for_near(
      x, [&] { return near_ * near_; },
      [&](std::int32_t f) {
        const RegionFacet<Dim>& facet = facets_[index(f)];
        if (distance<Dim>(nearest_on(facet.corners, x), x) > near_) return;
        for (std::size_t side = 0; side < 2; ++side)
          if (facet.inside[side] && facet.tags[side] != tags[0]) others.push_back(facet.tags[side]);
      });
  std::ranges::sort(others);
  others.erase(std::unique(others.begin(), others.end()), others.end());
  std::copy_n(others.begin(), std::min(std::ssize(others), std::ptrdiff_t{columns} - 1), tags + 1);
}

template <int Dim>
std::int32_t RegionIndex<Dim>::tag_behind_nearest_facet(const Point<Dim>& x) const {
  double nearest = kFar;
  const RegionFacet<Dim>* best = nullptr;
  tree_.for_near(
      x, [&] { return nearest * nearest; },
      [&](std::int32_t f) {
        const RegionFacet<Dim>& facet = facets_[index(f)];
        if (facet.inside[0] == facet.inside[1]) return;
        const double gap = distance<Dim>(nearest_on(facet.corners, x), x);
        if (best && !(gap < nearest || (gap == nearest && &facet < best))) return;
        nearest = gap;
        best = &facet;
      });
  return best ? best->tags[best->inside[0] ? 0 : 1] : 0;
}

// Sums the pyramids between the facets and the low corner of their box.
template <>
std::map<std::int32_t, double> RegionIndex<3>::volumes() const {
  Box<3> box = empty_box<3>();
  for (const RegionFacet<3>& facet : facets_)
    for (const Point<3>& corner : facet.corners) include<3>(box, corner);
  std::map<std::int32_t, double> volumes;
  for (const auto& [corners, inside, tags] : facets_) {
    const Point<3> a = difference(corners[0], box.low), b = difference(corners[1], box.low),
                   c = difference(corners[2], box.low);
    const double volume = dot(a, cross(b, c)) / 6;
    if (inside[0]) volumes[tags[0]] -= volume;
    if (inside[1]) volumes[tags[1]] += volume;
  }
  return volumes;
}

template class RegionIndex<2>;
template class RegionIndex<3>;

}  // namespace pnpbs
