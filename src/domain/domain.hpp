// SPDX-License-Identifier: BSD-3-Clause
// The type of the user's domain in the plane and in space, and its area or volume.
#pragma once

#include <type_traits>

#include "domain/plane/plane_domain.hpp"
#include "domain/volume/volume_domain.hpp"

namespace pnpbs {

template <int Dim>
using Domain = std::conditional_t<Dim == 2, PlaneDomain, VolumeDomain>;

// Returns the area or volume of the inside; 0 for surfaces alone. Requires a checked domain.
inline double measure_of(const PlaneDomain& domain) { return domain.area(); }
inline double measure_of(const VolumeDomain& domain) { return domain.volume(); }

}  // namespace pnpbs
