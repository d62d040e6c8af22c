// SPDX-License-Identifier: BSD-3-Clause
// What users describe, in the plane and in space.
#pragma once

#include <type_traits>

#include "domain/plane/plane_domain.hpp"
#include "domain/volume/volume_domain.hpp"

namespace pnpbs {

template <int Dim>
using Domain = std::conditional_t<Dim == 2, PlaneDomain, VolumeDomain>;

// Area or volume of the inside; surfaces alone have none.
inline double measure_of(const PlaneDomain& domain) { return domain.area(); }
inline double measure_of(const VolumeDomain& domain) { return domain.volume(); }

}  // namespace pnpbs
