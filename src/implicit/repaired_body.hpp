// SPDX-License-Identifier: BSD-3-Clause
// Makes a valid body from triangles that enclose it badly: with holes, inconsistent orientation or
// crossings. The body is the set of points with a winding number above 1/2, as a level set.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "surfaces/triangulation.hpp"

namespace pnpbs {

// Distances between the new surface and the given triangles, at sample points at most a resolution
// apart. All are 0 if nothing was repaired.
struct RepairDistances {
  double resolution = 0;
  double to_given = 0;       // largest from the new surface, except where it closes holes
  double over_holes = 0;     // largest where it closes holes
  double mean_to_given = 0;  // area-weighted mean over the new surface
  double to_new = 0;         // largest from the given triangles
  double lost = 0;           // fraction of the given area farther than the resolution
};

// The surface of a repaired body.
struct RepairedBody {
  SurfaceSource surface;  // of the level set
  RepairDistances distances;
};

// Default resolution. [longest side of the box around the triangles]
inline constexpr double kRepairResolution = 1.0 / 64;

// Repairs the body. `resolution` 0 means the default. Throws Error(ErrorKind::domain) if the
// triangles enclose nothing or if the resolution exceeds the box.
RepairedBody repaired_body(const std::vector<SurfaceSource>& given, double resolution);

// Returns a sentence that describes the repair.
std::string text_of(const RepairedBody& body);

}  // namespace pnpbs
