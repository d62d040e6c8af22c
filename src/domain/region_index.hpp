// SPDX-License-Identifier: BSD-3-Clause
// Finds the region of the domain in which a point lies, from the facets that bound regions.
#pragma once

#include <array>
#include <cstdint>
#include <map>
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

  // Writes the tags of up to `columns` regions to `tags`: that of tag_at(), and in increasing order
  // those of the other regions whose facets are within 1e-6 of the size of the domain. The last
  // entries repeat the first one where there are fewer. Local and thread-safe.
  void tags_at(const Point<Dim>& x, std::int32_t columns, std::int32_t* tags) const;
  // Returns a facet by its index, which is that of the facet of the mesh.
  const RegionFacet<Dim>& facet(std::int32_t f) const {
    return facets_[static_cast<std::size_t>(f)];
  }
  // Returns the volume of the regions with each tag. Only in space.
  std::map<std::int32_t, double> volumes() const;

 private:
  std::int32_t tag_behind_nearest_facet(const Point<Dim>& x) const;

  std::vector<RegionFacet<Dim>> facets_;
  BoxTree<Dim> tree_;
  double beyond_ = 0;  // first coordinate beyond all facets
  double near_ = 0;    // distance up to which facets are near a point
};

template <>
std::map<std::int32_t, double> RegionIndex<3>::volumes() const;

extern template class RegionIndex<2>;
extern template class RegionIndex<3>;

}  // namespace pnpbs
