// SPDX-License-Identifier: BSD-3-Clause
// What a person wants to know when a run is done, in a few lines.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tool/statistics.hpp"

namespace pnpbs::tool {

// Before a run: about how many nodes, how much memory of each process, how long.
std::string estimate_text(std::int64_t nodes, std::int64_t bytes, double seconds, int processes);

std::string summary_text(const Statistics& statistics, const std::vector<std::string>& files);

}  // namespace pnpbs::tool
