// SPDX-License-Identifier: BSD-3-Clause
// The statistics: one table that the report, the interface and the reference read.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "placement/placement.hpp"

namespace pnpbs {

struct StatisticRow {
  const char* name;
  const char* help;
  // Exactly one of these is set and gives the type.
  std::int64_t (*integer)(Placement&);
  double (*real)(Placement&);
  std::string (*text)(Placement&);
  bool computes = false;  // over all ranks or from lists, so it cannot be asked from a callback

  const char* type() const { return integer ? "integer" : real ? "real" : "string"; }
};

const std::vector<StatisticRow>& statistic_table();

// Throws Error(ErrorKind::key) with the nearest known name.
const StatisticRow& find_statistic(const std::string& key);

}  // namespace pnpbs
