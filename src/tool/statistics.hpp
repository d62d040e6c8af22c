// SPDX-License-Identifier: BSD-3-Clause
// All statistics of a placement, read once by all ranks.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "tool/library.hpp"

namespace pnpbs::tool {

// monostate: the library has no value.
using StatisticValue = std::variant<std::monostate, std::int64_t, double, std::string>;

// Edge length over d where d is in a band.
struct EdgeBand {
  double from, to;  // of d
  std::int64_t edges;
  double mean, deviation;
};

// What pnpbs_placement_get_cell_bands measures.
struct CellFigure {
  std::int64_t number;
  double mean, worst;
};

// Of the Voronoi cells where d is in a band.
struct CellBand {
  double from, to;  // of d
  CellFigure edge_ratio, area_ratio, dual_offset;
};

class Statistics {
 public:
  explicit Statistics(pnpbs_placement placement);

  const std::vector<std::pair<std::string, StatisticValue>>& all() const { return values_; }

  // Reads what the system counts of memory again: it may have become more.
  void renew_memory(pnpbs_placement placement);

  const std::vector<EdgeBand>& edge_bands() const { return edge_bands_; }
  const std::vector<CellBand>& cell_bands() const { return cell_bands_; }

  // nullptr if there is none of this name and type.
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
