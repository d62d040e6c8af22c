// SPDX-License-Identifier: BSD-3-Clause
#include "tool/spacing_file.hpp"

#include <array>
#include <string_view>

#include "base/small_letters.hpp"

namespace pnpbs::tool {

std::optional<SpacingFile> spacing_file(const std::string& text) {
  constexpr std::array<std::string_view, 3> endings{".vtu", ".msh", ".csv"};
  const std::string small = in_small_letters(text);
  for (const std::string_view ending : endings)
    if (small.size() > ending.size() && small.ends_with(ending)) return SpacingFile{text, ""};
  for (const std::string_view ending : endings) {
    const std::size_t at = small.find(std::string(ending) + ":");
    if (at == std::string::npos || at == 0) continue;
    const std::size_t end = at + ending.size();
    return SpacingFile{text.substr(0, end), text.substr(end + 1)};
  }
  return std::nullopt;
}

}  // namespace pnpbs::tool
