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

// Of the sphere that a domain is on, if it is on one; as long as the domain is there.
inline const StereographicChart* chart_of(const PlaneDomain& domain) { return domain.chart(); }
inline const StereographicChart* chart_of(const VolumeDomain&) { return nullptr; }
// In the chart of a sphere: see StereographicChart::varies_much_in.
inline bool chart_varies(const PlaneDomain& domain, const Box<2>& box) {
  return domain.chart() && domain.chart()->varies_much_in(box);
}
inline bool chart_varies(const VolumeDomain&, const Box<3>&) { return false; }

}  // namespace pnpbs
