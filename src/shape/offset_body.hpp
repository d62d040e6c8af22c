// SPDX-License-Identifier: BSD-3-Clause
// Adds bodies bounded by two distances from the boundary of another body: its interior at some
// depth, or a layer around it.
#pragma once

#include <cstdint>
#include <optional>

#include "domain/domain.hpp"

namespace pnpbs {

// Limits of the signed distance to the boundary of a body, negative inside.
template <int Dim>
struct Offset {
  // Limits in units of d at the point, or of length if there is no `spacing`. `low` may be
  // -infinity.
  double low, high;
  std::optional<LocalSpacingEvaluator<Dim>> spacing;  // d, if limits are in units of d
  double resolution;  // resolution of level sets; 0: derived from the smallest d
  std::int32_t tag;   // tag of the new boundary
};

// Add the offset body to a domain. `body` must be checked. Throw Error(ErrorKind::argument), with
// the argument and its value, or Error(ErrorKind::domain) if no point lies between the limits.
void add_offset(PlaneDomain& domain, const PlaneDomain& body, const Offset<2>& offset);
void add_offset(VolumeDomain& domain, const VolumeDomain& body, const Offset<3>& offset);

}  // namespace pnpbs
