// SPDX-License-Identifier: BSD-3-Clause
// The triangulation of the nodes there are as a patch, and a spacing made of values at them.
#pragma once

#include <memory>
#include <vector>

#include "results/results.hpp"
#include "spacing/nodal_patch.hpp"
#include "spacing/spacing.hpp"

namespace pnpbs {

// With one node for each place of this rank, and no values. Collective.
template <int Dim>
Patch<Dim> patch_of(Results<Dim>& results);

// The same in space, of nodes on a sphere. Collective.
Patch<2, 3> sphere_patch_of(Results<2>& results);

// d by its values at this rank's nodes, in places. Collective.
template <int Dim>
std::shared_ptr<const Spacing<Dim>> spacing_from(Results<Dim>& results, std::vector<double> values);

}  // namespace pnpbs
