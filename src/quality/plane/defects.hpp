// SPDX-License-Identifier: BSD-3-Clause
// Repair of defects that moving nodes cannot heal: nodes with at most four or at least eight
// neighbours, pairs of neighbours that both have five or both have seven, and bad triangles.
// Deleting or inserting a node is tried on a copy of the surrounding nodes.
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

// Parameters of the repair.
struct DefectRule {
  std::int64_t rounds;
  double bad_below = method::kDefectBelow;  // bound of bad triangles [quality, 2 r_in / R]
};

// Depth of the stars on which the fate of a node depends. [rings] A node may be deleted for a
// defect two rings away. Other defects within the contest's radius may outbid that defect, and
// these are judged by their patches.
inline constexpr int kDefectRings =
    method::kSurplusRings + method::kDefectContestRings + method::kPatchRings;

// Returns the nodes to delete and to insert. Triangles with a quality below `bad_below` are
// defects. A contest as in the population control selects the repairs: among the defects within
// five rings only the one with the largest gain is repaired. fits(x, d) returns whether the domain
// allows a new bubble at x.
PopulationChange<2> choose_defect_repairs(const Nodes<2>& nodes, const DelaunayStars& stars,
                                          double bad_below,
                                          const std::function<bool(const Point<2>&, double)>& fits);

}  // namespace pnpbs
