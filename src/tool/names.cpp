// SPDX-License-Identifier: BSD-3-Clause
#include "tool/names.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/small_letters.hpp"

namespace pnpbs::tool {
namespace {

// Returns the smallest number of insertions, deletions, replacements and swaps of adjacent letters.
std::size_t typing_errors(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> cost(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        cost[i][j] = i + j;
        continue;
      }
      const bool same = a[i - 1] == b[j - 1];
      cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, cost[i - 1][j - 1] + !same});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
      }
    }
  }
  return cost[a.size()][b.size()];
}

constexpr std::size_t longest_name = 64;  // longer texts resemble no name

}  // namespace

std::string nearest_name(std::string_view text, std::span<const std::string> names) {
  for (const std::string& name : names)
    if (to_lower_case(name) == to_lower_case(text)) return name;
  if (text.size() < 2 || text.size() > longest_name) return "";
  std::string nearest;
  std::size_t min = 1 + std::max<std::size_t>(1, text.size() / 3);
  for (const std::string& name : names) {
    const std::size_t errors = typing_errors(text, name);
    if (errors < min) {
      min = errors;
      nearest = name;
    }
  }
  return nearest;
}

std::string did_you_mean(std::string_view text, std::span<const std::string> names) {
  const std::string name = nearest_name(text, names);
  return name.empty() ? "" : "; did you mean " + name + "?";
}

}  // namespace pnpbs::tool
