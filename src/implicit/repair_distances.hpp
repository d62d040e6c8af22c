// SPDX-License-Identifier: BSD-3-Clause
// How far the surface of a repaired body and the triangles given are from each other.
#pragma once

namespace pnpbs {

// Taken at points on both, apart by no more than the resolution. All 0 where nothing is repaired.
struct RepairDistances {
  double resolution = 0;
  double to_given = 0;       // the largest of the new surface, but where it closes holes
  double over_holes = 0;     // the largest where it does: what is nearest lies beside, not below
  double mean_to_given = 0;  // by area, of all the new surface
  double to_new = 0;         // the largest of the triangles given
  double lost = 0;           // share of the area given that is farther than the resolution
};

}  // namespace pnpbs
