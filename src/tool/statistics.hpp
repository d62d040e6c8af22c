// SPDX-License-Identifier: BSD-3-Clause
// All statistics of a placement, read once.
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

class Statistics {
 public:
  explicit Statistics(pnpbs_placement placement);

  const std::vector<std::pair<std::string, StatisticValue>>& all() const { return values_; }

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
};

}  // namespace pnpbs::tool
