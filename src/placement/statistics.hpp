// SPDX-License-Identifier: BSD-3-Clause
// The table of statistics, which the report, the interface and the reference documentation use.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "placement/placement.hpp"

namespace pnpbs {

// A statistic: its name, its description and the function that returns it.
struct StatisticRow {
  const char* name;
  const char* help;
  // Exactly one of these functions is set. It determines the type.
  std::int64_t (*integer)(Placement&);
  double (*real)(Placement&);
  std::string (*text)(Placement&);
  bool computes = false;  // collective or derived from lists, so callbacks must not use it

  const char* type() const { return integer ? "integer" : real ? "real" : "string"; }
};

const std::vector<StatisticRow>& statistic_table();

// Returns the row with this name. Throws Error(ErrorKind::key) with the nearest known name.
const StatisticRow& find_statistic(const std::string& key);

}  // namespace pnpbs
