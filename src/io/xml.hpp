// SPDX-License-Identifier: BSD-3-Clause
// Text in files of XML.
#pragma once

#include <string>

namespace pnpbs::io {

// A file's name may have letters that mean something in XML.
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
