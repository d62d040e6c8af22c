// SPDX-License-Identifier: BSD-3-Clause
// Lookup of table rows by the names that users give.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"

namespace pnpbs {

// Returns the entry of `names` with the smallest edit distance to `key`, for error messages.
std::string nearest_name(std::string_view key, const std::vector<std::string>& names);

// Returns the row with this name. Throws Error(ErrorKind::key) with the nearest known name if there
// is none. `what` is the kind of name in the message, such as "option".
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
