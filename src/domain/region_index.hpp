// SPDX-License-Identifier: BSD-3-Clause
// Finds the region of the domain in which a point lies, from the facets that bound regions.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/boundary_mesh.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

// A facet and the regions on its two sides. Side 0 is left of an edge, or in front of a triangle.
template <int Dim>
struct RegionFacet {
  FacetCorners<Dim> corners;
  std::array<bool, 2> inside;        // per side: is it in the domain?
  std::array<std::int32_t, 2> tags;  // tags of the regions on both sides
};

// A spatial index of the facets between regions.
template <int Dim>
class RegionIndex {
 public:
  explicit RegionIndex(std::vector<RegionFacet<Dim>> facets);

  // Returns the tag of the region that contains x. If x is outside the domain, as the centroid of
  // an element beside a curved boundary may be, returns the tag behind the nearest boundary facet.
  // Local and thread-safe.
  std::int32_t tag_at(const Point<Dim>& x) const;

 private:
  std::int32_t tag_behind_nearest_facet(const Point<Dim>& x) const;

  std::vector<RegionFacet<Dim>> facets_;
  BoxTree<Dim> tree_;
  double beyond_ = 0;  // first coordinate beyond all facets
};

extern template class RegionIndex<2>;
extern template class RegionIndex<3>;

}  // namespace pnpbs
