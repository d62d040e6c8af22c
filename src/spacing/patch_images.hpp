// SPDX-License-Identifier: BSD-3-Clause
// The images of a patch of a periodic domain.
#pragma once

#include "base/periodic_cell.hpp"
#include "spacing/nodal_patch.hpp"

namespace pnpbs {

// Adds images of the simplices, so that the patches of all ranks cover the cell, and images of the
// border facets, so that the facet nearest to each point of the cell is among them. The images of
// nodes have the values of these. Does nothing if the cell has no periodic axis.
template <int Dim>
void add_images(Patch<Dim>& patch, const PeriodicCell<Dim>& cell);

extern template void add_images(Patch<2>&, const PeriodicCell<2>&);
extern template void add_images(Patch<3>&, const PeriodicCell<3>&);

}  // namespace pnpbs
