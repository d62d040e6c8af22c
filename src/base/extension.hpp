// SPDX-License-Identifier: BSD-3-Clause
// What the name of a file tells about its format.
#pragma once

#include <string>
#include <string_view>

#include "base/small_letters.hpp"

namespace pnpbs {

// The extension without its dot, in small letters; empty if there is none.
inline std::string extension_of(std::string_view path) {
  const std::size_t dot = path.rfind('.');
  if (dot == std::string_view::npos || path.find('/', dot) != std::string_view::npos) return "";
  return in_small_letters(path.substr(dot + 1));
}

}  // namespace pnpbs
