// SPDX-License-Identifier: BSD-3-Clause
// The summary that the command prints after a run.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/types.hpp"
#include "tool/library.hpp"
#include "tool/particles.hpp"
#include "tool/ranks.hpp"
#include "tool/statistics.hpp"

namespace pnpbs::tool {

// Size of a body.
struct BodyFigures {
  Point<3> extent;
  double volume;  // 0 for surfaces
  // Area of the boundary's triangles, once there are nodes. On a sphere it is measured along the
  // sphere.
  std::optional<double> area;
};

// Measures the body. Local. Throws Failure.
BodyFigures body_figures(pnpbs_domain domain, bool filled, pnpbs_context context);

// Returns the area of the boundary on the first rank, and 0 on the others. Collective.
double boundary_area(pnpbs_placement placement, pnpbs_context context, const Ranks& ranks);

struct RunEstimate {
  std::int64_t nodes, bytes;  // bytes of each process
  double seconds;
  int processes;
  bool picture;                     // of all nodes, drawn by the first process
  std::optional<BodyFigures> body;  // empty for a domain in the plane
};

// Describes a run before it starts: the number of nodes, the memory of each process, and the time.
std::string estimate_text(const RunEstimate& run);

std::string summary_text(const Statistics& statistics, const std::optional<BodyFigures>& body,
                         const std::vector<RegionRow>& regions,
                         const std::optional<VolumeFigures>& volumes,
                         const std::optional<ParticleFigures>& particles,
                         const std::vector<std::string>& files);

}  // namespace pnpbs::tool
