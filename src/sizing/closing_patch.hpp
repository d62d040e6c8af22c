// SPDX-License-Identifier: BSD-3-Clause
// Makes the nodes that close a whole sphere: a placement of its own, in a disc around the point
// that the sphere is projected from, as it is seen from the other side.
#pragma once

#include <memory>

#include "domain/domain.hpp"
#include "spacing/sizing_field.hpp"

namespace pnpbs {

// The domain itself or, of a whole sphere, one that is closed for this spacing in its chart. Every
// rank makes the same patch; the spacing is asked for the same points everywhere. Throws
// Error(ErrorKind::domain) where curves or fixed nodes lie in the patch, and ::spacing where d is
// more than kMostAtPoint allows. Collective.
std::shared_ptr<const PlaneDomain> closed_for(const std::shared_ptr<const PlaneDomain>& domain,
                                              const Spacing<2>& spacing);
std::shared_ptr<const VolumeDomain> closed_for(const std::shared_ptr<const VolumeDomain>& domain,
                                               const Spacing<3>& spacing);

// Can it be closed for this spacing, with what the user gives inside? Other domains need not be.
bool can_be_closed(const PlaneDomain& domain, const Spacing<2>& spacing);
bool can_be_closed(const VolumeDomain& domain, const Spacing<3>& spacing);

// The same before the spacing is multiplied for so many nodes, if any number is wanted: as if it
// were even then. Collective.
std::shared_ptr<const PlaneDomain> closed_before_sizing(
    const std::shared_ptr<const PlaneDomain>& domain, const SizingField<2>& spacing,
    double wanted_nodes);
std::shared_ptr<const VolumeDomain> closed_before_sizing(
    const std::shared_ptr<const VolumeDomain>& domain, const SizingField<3>& spacing,
    double wanted_nodes);

// The factor on the spacing for which a whole sphere is closed; 1 for other domains. Collective.
double factor_closed_for(const PlaneDomain& domain, const Spacing<2>& spacing);
double factor_closed_for(const VolumeDomain& domain, const Spacing<3>& spacing);

}  // namespace pnpbs
