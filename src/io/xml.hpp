// SPDX-License-Identifier: BSD-3-Clause
// Escaping of text for XML files.
#pragma once

#include <string>

namespace pnpbs::io {

// Returns the text with the special characters of XML escaped.
inline std::string in_xml(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

}  // namespace pnpbs::io
