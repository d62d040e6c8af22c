// SPDX-License-Identifier: BSD-3-Clause
// Lines of text. They end in LF, in CR LF, or in CR alone as on old Macs.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace pnpbs {

inline bool is_line_end(char c) { return c == '\n' || c == '\r'; }

// Removes the first line and its end from the text. Returns the line without its end.
inline std::string_view take_line(std::string_view& text) {
  const auto end = std::find_if(text.begin(), text.end(), is_line_end);
  const std::string_view line = text.substr(0, static_cast<std::size_t>(end - text.begin()));
  text.remove_prefix(line.size());
  text.remove_prefix(text.starts_with("\r\n") ? 2 : std::min<std::size_t>(text.size(), 1));
  return line;
}

// Returns how many lines end in the text.
inline std::int64_t count_line_ends(std::string_view text) {
  std::int64_t count = 0;
  for (std::size_t i = 0; i < text.size(); ++i)
    count += is_line_end(text[i]) && !text.substr(i).starts_with("\r\n");
  return count;
}

}  // namespace pnpbs
