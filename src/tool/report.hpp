// SPDX-License-Identifier: BSD-3-Clause
// The report of a run as JSON: the arguments and the results.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tool/arguments.hpp"
#include "tool/geo_file.hpp"
#include "tool/library.hpp"
#include "tool/particles.hpp"
#include "tool/statistics.hpp"

namespace pnpbs::tool {

// Returns the report. `geo` is nullptr for domains from other files.
std::string report_text(const Arguments& arguments, const GeoFile* geo,
                        const Statistics& statistics, const std::optional<VolumeFigures>& volumes,
                        const std::optional<ParticleFigures>& particles,
                        const std::vector<GroupName>& groups, const std::vector<RegionRow>& regions,
                        bool regions_have_volumes, const std::vector<std::string>& warnings);

}  // namespace pnpbs::tool
