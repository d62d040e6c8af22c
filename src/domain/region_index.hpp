// SPDX-License-Identifier: BSD-3-Clause
// In which region of the domain a point lies, by the facets that bound regions.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/boundary_mesh.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

// A facet, and what is on its two sides: first on the left of an edge, or in front of a triangle.
template <int Dim>
struct RegionFacet {
  FacetCorners<Dim> corners;
  std::array<bool, 2> inside;        // the domain
  std::array<std::int32_t, 2> tags;  // of the regions
};

template <int Dim>
class RegionIndex {
 public:
  explicit RegionIndex(std::vector<RegionFacet<Dim>> facets);

  // The tag of the region that x lies in; where that is outside the domain, as the middle of an
  // element can be beside a curved boundary, of the region behind the nearest facet. Any thread may
  // ask.
  std::int32_t tag_at(const Point<Dim>& x) const;

 private:
  std::int32_t tag_beside(const Point<Dim>& x) const;

  std::vector<RegionFacet<Dim>> facets_;
  BoxTree<Dim> tree_;
  double beyond_ = 0;  // in the first direction all facets end before it
};

extern template class RegionIndex<2>;
extern template class RegionIndex<3>;

}  // namespace pnpbs
