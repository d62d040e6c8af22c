// SPDX-License-Identifier: BSD-3-Clause
// What a person wants to know when a run is done, in a few lines.
#pragma once

#include <string>
#include <vector>

#include "tool/statistics.hpp"

namespace pnpbs::tool {

std::string summary_text(const Statistics& statistics, const std::vector<std::string>& files);

}  // namespace pnpbs::tool
