// SPDX-License-Identifier: BSD-3-Clause
// Elements whose nodes are doubled along cracks, which are inner curves in the plane and inner
// surfaces in space. The elements around a node fall into sectors, which cracks separate. One
// sector keeps the node, and each other one gets a copy of it. So the two sides of a crack share no
// node except at its tip, where the elements around a node form a single sector. The elements of a
// periodic domain have copies in the same way, where the torus is cut open (periodic_cut.hpp).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "results/results.hpp"

namespace pnpbs {

// A copy of a node on a crack or of a periodic domain.
struct CrackCopy {
  std::int64_t node;    // result index of the original; in a periodic domain perhaps of an image
  std::int64_t number;  // 0, 1, ... over all ranks, in the order of the ids of the originals
  Image<3> periods{};   // from the cell of a periodic domain to the copy
};

// A facet of a crack, or one of the boundary or of another inner curve or surface that has a copy
// among its corners. Side 0 of a crack is left of a curve, or in front of a surface.
template <int Dim>
struct CrackFacet {
  std::array<std::int64_t, Dim> places;  // result indices that Results::for_facets() passes
  // For each side, indices into Cracks::copies(), or -1 for originals. Both are equal where the
  // facet is on no crack, and where all of its corners are at the tip.
  std::array<std::array<std::int64_t, Dim>, 2> copies;
  std::int32_t tag = 0;  // of the crack; 0 on no crack
  // For each side, the periods from `places` to the corners of the facet. Both are equal where a
  // periodic domain is not cut along the facet.
  std::array<Image<3>, 2> periods{};
  std::array<std::int32_t, 2> side_tags{};  // on a flat side of a periodic domain, else 0

  bool is_flat_side() const { return is_open() && periods[0] != periods[1]; }
  bool is_open() const { return copies[0] != copies[1]; }
};

// The elements, facets and copies of nodes of this rank along cracks.
template <int Dim>
class Cracks {
 public:
  // The copies of owned nodes, and then those of ghosts that this rank's elements and facets refer
  // to; each in the order of their numbers.
  const std::vector<CrackCopy>& copies() const { return copies_; }
  std::int64_t owned() const { return owned_; }  // number of copies of owned nodes
  std::int64_t all() const { return all_; }      // number of copies over all ranks
  // Returns the area of the facets of cracks over that of their surfaces, on all ranks; 1 in the
  // plane. Where facets are missing, elements connect the two sides.
  double covered() const { return covered_; }
  // The facets, among those that this rank visits in Results::for_facets(), ordered by their
  // places.
  const std::vector<CrackFacet<Dim>>& facets() const { return facets_; }
  // Returns null for other facets.
  const CrackFacet<Dim>* facet(const std::array<std::int64_t, Dim>& places) const {
    const auto found = std::ranges::lower_bound(facets_, places, {}, &CrackFacet<Dim>::places);
    return found != facets_.end() && found->places == places ? &*found : nullptr;
  }

  // Returns the periods from the cell of a periodic domain to an owned node in its elements. They
  // are 0, unless all elements at the node have it beyond the cell.
  Image<3> periods(std::int64_t place) const {
    const auto found = std::ranges::lower_bound(moved_, place, {}, &CrackCopy::node);
    return found != moved_.end() && found->node == place ? found->periods : Image<3>{};
  }

  // Returns for each corner of an element its index in copies(), or -1 if it is the original node.
  // `places` are the result indices that Results::for_elements() passes.
  std::array<std::int64_t, Dim + 1> copies_in(
      const std::array<std::int64_t, Dim + 1>& places) const {
    std::array<std::int64_t, Dim + 1> none;
    none.fill(-1);
    const auto found = std::ranges::lower_bound(elements_, places, {}, &Element::places);
    return found != elements_.end() && found->places == places ? found->copies : none;
  }

 private:
  template <int>
  friend class CrackMaker;
  template <int>
  friend class PeriodicCutMaker;

  // An element with a copy among its corners.
  struct Element {
    std::array<std::int64_t, Dim + 1> places, copies;
  };

  std::vector<CrackCopy> copies_;
  std::vector<Element> elements_;  // ordered by their places
  std::vector<CrackFacet<Dim>> facets_;
  std::vector<CrackCopy> moved_;  // owned nodes that no element has in the cell; no copies
  std::int64_t owned_ = 0, all_ = 0;
  double covered_ = 1;
};

// Returns the cracks along the inner curves or surfaces with these tags. The result is the same on
// any number of ranks. Throws Error(ErrorKind::argument) if no inner curve or surface has one of
// the tags. Collective; all ranks must pass the same tags.
template <int Dim>
Cracks<Dim> make_cracks(Results<Dim>& results, const std::vector<std::int32_t>& tags);

extern template Cracks<2> make_cracks(Results<2>&, const std::vector<std::int32_t>&);
extern template Cracks<3> make_cracks(Results<3>&, const std::vector<std::int32_t>&);

}  // namespace pnpbs
