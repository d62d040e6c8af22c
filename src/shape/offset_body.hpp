// SPDX-License-Identifier: BSD-3-Clause
// The body between two distances from the boundary of another: what is left of it some way inside,
// or a layer around it.
#pragma once

#include <cstdint>
#include <optional>

#include "domain/domain.hpp"

namespace pnpbs {

template <int Dim>
struct Offset {
  // Of the signed distance to the boundary, negative inside, over d where the point is; low may be
  // -infinity.
  double low, high;
  std::optional<LocalSpacingEvaluator<Dim>> spacing;  // d; none: distances as they are
  double resolution;                                  // of level sets; 0: by the least d
  std::int32_t tag;
};

// Adds it to a domain. The body has been checked. They throw Error(ErrorKind::argument) naming the
// argument and its value, or Error(ErrorKind::domain) if there is nothing between these distances.
void add_offset(PlaneDomain& domain, const PlaneDomain& body, const Offset<2>& offset);
void add_offset(VolumeDomain& domain, const VolumeDomain& body, const Offset<3>& offset);

}  // namespace pnpbs
