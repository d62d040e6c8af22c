// SPDX-License-Identifier: BSD-3-Clause
// The patch of nodes that closes a whole sphere: nodes of a separate placement in a disc around the
// projection point, as seen in the chart of the opposite side.
#pragma once

#include <memory>

#include "domain/domain.hpp"
#include "spacing/sizing_field.hpp"

namespace pnpbs {

// Returns the domain itself, or for a whole sphere one that is closed by a patch for this spacing
// in its chart. Every rank makes the same patch and evaluates the spacing at the same points.
// Throws Error(ErrorKind::domain) if curves or fixed nodes lie in the patch, and
// Error(ErrorKind::spacing) if d exceeds kMostAtPoint.
// Collective.
std::shared_ptr<const PlaneDomain> closed_domain(const std::shared_ptr<const PlaneDomain>& domain,
                                                 const Spacing<2>& spacing);
std::shared_ptr<const VolumeDomain> closed_domain(const std::shared_ptr<const VolumeDomain>& domain,
                                                  const Spacing<3>& spacing);

// Returns whether a whole sphere can be closed for this spacing, with the user's curves and nodes
// outside of the patch. Returns true for all other domains.
bool can_be_closed(const PlaneDomain& domain, const Spacing<2>& spacing);
bool can_be_closed(const VolumeDomain& domain, const Spacing<3>& spacing);

// Returns closed_domain() for a spacing that is still to be multiplied for `wanted_nodes` nodes:
// the patch is that of the uniform spacing with this number of nodes. If `wanted_nodes` is 0, the
// spacing itself is used.
// Collective.
std::shared_ptr<const PlaneDomain> closed_before_sizing(
    const std::shared_ptr<const PlaneDomain>& domain, const SizingField<2>& spacing,
    double wanted_nodes);
std::shared_ptr<const VolumeDomain> closed_before_sizing(
    const std::shared_ptr<const VolumeDomain>& domain, const SizingField<3>& spacing,
    double wanted_nodes);

// Returns the factor on the spacing for which a whole sphere is closed; 1 for other domains.
// Collective.
double factor_closed_for(const PlaneDomain& domain, const Spacing<2>& spacing);
double factor_closed_for(const VolumeDomain& domain, const Spacing<3>& spacing);

}  // namespace pnpbs
