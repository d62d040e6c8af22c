// SPDX-License-Identifier: BSD-3-Clause
// How large a body is.
#pragma once

#include <optional>

#include "base/types.hpp"
#include "tool/library.hpp"
#include "tool/ranks.hpp"

namespace pnpbs::tool {

struct BodyFigures {
  Point<3> extent;
  double volume;  // 0 of surfaces alone
  // Of its boundary's triangles, when there are nodes; of a sphere, along it.
  std::optional<double> area;
};

// Local. Throws Failure.
BodyFigures body_figures(pnpbs_domain domain, bool filled, pnpbs_context context);

// On the first rank; 0 on the others. Collective.
double boundary_area(pnpbs_placement placement, pnpbs_context context, const Ranks& ranks);

}  // namespace pnpbs::tool
