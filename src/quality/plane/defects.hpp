// SPDX-License-Identifier: BSD-3-Clause
// Repair of defects that no shift of nodes heals: nodes with four neighbours or fewer, or with
// eight or more, neighbours that both have five or both have seven, and bad triangles. Whether a
// node is one too many there, or one is missing, is tried on a copy of the nodes around.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/nodes.hpp"
#include "delaunay/delaunay_stars.hpp"
#include "method/constants.hpp"
#include "population/population.hpp"
#include "quality/plane/star_patch.hpp"

namespace pnpbs {

struct DefectRule {
  std::int64_t rounds;
  double bad_below = method::kDefectBelow;  // triangle quality, 2 r_in / R
};

// What becomes of a node hangs on the stars so many rings around it: it may go for a defect two
// rings away, which others bar within the contest, and those are judged by their patches.
inline constexpr int kDefectRings =
    method::kSurplusRings + method::kDefectContestRings + method::kPatchRings;

// Which nodes go and which come; triangles are bad below that quality. Who acts is a contest as for
// the population: of the defects within five rings the one whose repair gains most. fits(x, d): is
// a new bubble allowed at x by the domain?
PopulationChange<2> choose_defect_repairs(const Nodes<2>& nodes, const DelaunayStars& stars,
                                          double bad_below,
                                          const std::function<bool(const Point<2>&, double)>& fits);

}  // namespace pnpbs
