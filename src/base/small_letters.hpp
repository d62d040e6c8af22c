// SPDX-License-Identifier: BSD-3-Clause
// Conversion of ASCII letters to lower case, independent of the locale.
#pragma once

#include <string>
#include <string_view>

namespace pnpbs {

constexpr char to_lower_case(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

inline std::string to_lower_case(std::string_view text) {
  std::string small(text);
  for (char& c : small) c = to_lower_case(c);
  return small;
}

}  // namespace pnpbs
