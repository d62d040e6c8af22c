// SPDX-License-Identifier: BSD-3-Clause
// What a person wants to know when a run is done, in a few lines.
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

// How large a body is.
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

struct RunEstimate {
  std::int64_t nodes, bytes;  // memory of each process
  double seconds;
  int processes;
  bool picture;                     // of all nodes, drawn by the first process
  std::optional<BodyFigures> body;  // nothing: a domain in the plane
};

// Before a run: about how many nodes, how much memory of each process, how long.
std::string estimate_text(const RunEstimate& run);

std::string summary_text(const Statistics& statistics, const std::optional<BodyFigures>& body,
                         const std::optional<VolumeFigures>& volumes,
                         const std::optional<ParticleFigures>& particles,
                         const std::vector<std::string>& files);

}  // namespace pnpbs::tool
