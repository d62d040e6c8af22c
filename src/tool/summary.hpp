// SPDX-License-Identifier: BSD-3-Clause
// What a person wants to know when a run is done, in a few lines.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tool/body_figures.hpp"
#include "tool/particles.hpp"
#include "tool/statistics.hpp"

namespace pnpbs::tool {

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
