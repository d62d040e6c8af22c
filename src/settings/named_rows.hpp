// SPDX-License-Identifier: BSD-3-Clause
// Rows of tables, by the names that users give.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"

namespace pnpbs {

// The name in `names` that is nearest to `key` (fewest letters changed), for messages.
std::string nearest_name(std::string_view key, const std::vector<std::string>& names);

// Throws Error(ErrorKind::key) with the nearest known name; `what` it is a name of: "option".
template <class Row>
const Row& row_named(const std::string& key, const std::vector<Row>& table,
                     const std::string& what) {
  std::vector<std::string> names;
  for (const Row& row : table) {
    if (key == row.name) return row;
    names.emplace_back(row.name);
  }
  throw Error(ErrorKind::key, "unknown " + what + " \"" + key + "\"; the nearest known one is \"" +
                                  nearest_name(key, names) + "\"");
}

}  // namespace pnpbs
