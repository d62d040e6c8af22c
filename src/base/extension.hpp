// SPDX-License-Identifier: BSD-3-Clause
// File name extensions, which determine the format of a file.
#pragma once

#include <string>
#include <string_view>

#include "base/small_letters.hpp"

namespace pnpbs {

// Returns the extension in lower case without its dot, or an empty text if the path has none.
inline std::string extension_of(std::string_view path) {
  const std::size_t dot = path.rfind('.');
  if (dot == std::string_view::npos || path.find('/', dot) != std::string_view::npos) return "";
  return to_lower_case(path.substr(dot + 1));
}

}  // namespace pnpbs
