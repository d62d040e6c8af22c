// SPDX-License-Identifier: BSD-3-Clause
// A body from triangles that enclose it badly: with holes, turned this way and that, crossing each
// other. It is where they wind around a point more than half a time, as a level set.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "surfaces/triangulation.hpp"

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

struct RepairedBody {
  SurfaceSource surface;  // of the level set
  RepairDistances distances;
};

// By default, of the longest side of the box around the triangles.
inline constexpr double kRepairResolution = 1.0 / 64;

// `resolution`: 0 for the default. Throws Error(ErrorKind::domain) if the triangles enclose
// nothing, ErrorKind::argument if the resolution is none for this box.
RepairedBody repaired_body(const std::vector<SurfaceSource>& given, double resolution);

// What became of them, in a sentence.
std::string text_of(const RepairedBody& body);

}  // namespace pnpbs
