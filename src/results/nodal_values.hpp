// SPDX-License-Identifier: BSD-3-Clause
// The triangulation of the present nodes as a patch, and a spacing that interpolates values at
// them.
#pragma once

#include <memory>
#include <vector>

#include "results/results.hpp"
#include "spacing/nodal_patch.hpp"
#include "spacing/spacing.hpp"

namespace pnpbs {

// Returns the triangulation of this rank's nodes. Its nodes are in the order of results and have no
// values. All ranks must call it, and if one rank throws, all ranks throw.
template <int Dim>
Patch<Dim> patch_of(Results<Dim>& results);

// Returns the same with points in space, for nodes on a sphere. Collective.
Patch<2, 3> sphere_patch_of(Results<2>& results);

// Returns the spacing that interpolates `values` of d at this rank's nodes, by result index. All
// ranks must call it, and if one rank throws, all ranks throw.
template <int Dim>
std::shared_ptr<const Spacing<Dim>> spacing_from(Results<Dim>& results, std::vector<double> values);

}  // namespace pnpbs
