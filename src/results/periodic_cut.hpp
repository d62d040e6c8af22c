// SPDX-License-Identifier: BSD-3-Clause
// The elements of a periodic domain, cut open to lie in and beside its cell. Each element of the
// torus occurs once, at the place where the least of its corners along each periodic axis is in the
// cell. So elements extend beyond the upper sides of the cell only, and the corners there are
// copies of nodes: their partners in the cell, moved by whole periods.
#pragma once

#include "results/cracks.hpp"

namespace pnpbs {

// Returns by how many periods an element is moved from the corners with these ids to its place.
template <int Dim, class Ids>
Image<Dim> periods_to_cell(const PeriodicCell<Dim>& cell, const Ids& ids) {
  Image<Dim> least{};
  bool any = false;
  for (const std::int64_t id : ids) {
    const Image<Dim> image = cell.image_of_id(id);
    for (std::size_t k = 0; k < Dim; ++k) least[k] = any ? std::min(least[k], image[k]) : image[k];
    any = true;
  }
  for (std::int32_t& periods : least) periods = -periods;
  return least;
}

// Returns the copies of the nodes in the elements and facets. The result is the same on any number
// of ranks. Collective.
template <int Dim>
Cracks<Dim> make_periodic_cut(Results<Dim>& results);

extern template Cracks<2> make_periodic_cut(Results<2>&);
extern template Cracks<3> make_periodic_cut(Results<3>&);

}  // namespace pnpbs
