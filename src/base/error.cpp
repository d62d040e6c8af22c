// SPDX-License-Identifier: BSD-3-Clause
#include "base/error.hpp"

#include <charconv>

namespace pnpbs {

std::string number_text(double value) {
  char text[40];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return std::string(text, end);
}

}  // namespace pnpbs
