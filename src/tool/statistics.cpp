// SPDX-License-Identifier: BSD-3-Clause
#include "tool/statistics.hpp"

namespace pnpbs::tool {
namespace {

StatisticValue read(pnpbs_placement placement, const LibraryStatistic& statistic) {
  const char* name = statistic.name.c_str();
  std::int64_t integer = 0;
  double real = 0;
  const char* text = "";
  if (statistic.type == "integer" && pnpbs_placement_get_int64(placement, name, &integer) >= 0) {
    return integer;
  }
  if (statistic.type == "real" && pnpbs_placement_get_double(placement, name, &real) >= 0) {
    return real;
  }
  if (statistic.type == "string" && pnpbs_placement_get_string(placement, name, &text) >= 0) {
    return std::string(text);
  }
  return {};
}

}  // namespace

Statistics::Statistics(pnpbs_placement placement) {
  for (const LibraryStatistic& statistic : library_statistics()) {
    values_.emplace_back(statistic.name, read(placement, statistic));
  }
}

}  // namespace pnpbs::tool
