// SPDX-License-Identifier: BSD-3-Clause
#include "settings/named_rows.hpp"

#include <algorithm>
#include <numeric>

namespace pnpbs {

std::string nearest_name(std::string_view key, const std::vector<std::string>& names) {
  std::string nearest;
  std::size_t fewest = static_cast<std::size_t>(-1);
  for (const std::string& name : names) {
    // Computes the Levenshtein distance with a single row of the table.
    std::vector<std::size_t> row(name.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < key.size(); ++i) {
      std::size_t diagonal = row[0]++;
      for (std::size_t j = 0; j < name.size(); ++j) {
        const std::size_t change = diagonal + (key[i] != name[j]);
        diagonal = row[j + 1];
        row[j + 1] = std::min({change, row[j] + 1, row[j + 1] + 1});
      }
    }
    if (row.back() < fewest) {
      fewest = row.back();
      nearest = name;
    }
  }
  return nearest;
}

}  // namespace pnpbs
