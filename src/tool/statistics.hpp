// SPDX-License-Identifier: BSD-3-Clause
// All statistics of a placement, read at once. Collective.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "tool/library.hpp"

namespace pnpbs::tool {

// The value of a statistic; monostate means that the library has no value.
using StatisticValue = std::variant<std::monostate, std::int64_t, double, std::string>;

// Edge length over d, for edges where d lies in a band.
struct EdgeBand {
  double from, to;  // bounds of d
  std::int64_t edges;
  double mean, deviation;
};

// A quantity that pnpbs_placement_get_cell_bands measures.
struct CellFigure {
  std::int64_t number;
  double mean, worst;
};

// Quality of the Voronoi cells where d lies in a band.
struct CellBand {
  double from, to;  // bounds of d
  CellFigure edge_ratio, area_ratio, dual_offset;
};

// The nodes and elements with one region tag.
struct RegionRow {
  std::int32_t tag;  // 0: elements of regions without a tag
  std::string name;  // empty if it has none
  std::int64_t nodes, elements;
  double measure;  // volume or area
};

// Returns the regions that have elements, or none if no region of the domain has a tag. `dimension`
// is that of the elements. Collective. Throws Failure.
std::vector<RegionRow> region_rows(pnpbs_placement placement, pnpbs_domain domain, int dimension,
                                   pnpbs_context context);

class Statistics {
 public:
  explicit Statistics(pnpbs_placement placement);

  const std::vector<std::pair<std::string, StatisticValue>>& all() const { return values_; }

  // Reads the memory statistics again, which may have grown.
  void renew_memory(pnpbs_placement placement);

  const std::vector<EdgeBand>& edge_bands() const { return edge_bands_; }
  const std::vector<CellBand>& cell_bands() const { return cell_bands_; }

  // Returns nullptr if there is no statistic with this name and type.
  template <typename Value>
  const Value* find(const std::string& name) const {
    for (const auto& [key, value] : values_) {
      if (key == name) return std::get_if<Value>(&value);
    }
    return nullptr;
  }

 private:
  std::vector<std::pair<std::string, StatisticValue>> values_;
  std::vector<EdgeBand> edge_bands_;
  std::vector<CellBand> cell_bands_;
};

}  // namespace pnpbs::tool
