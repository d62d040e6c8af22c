// SPDX-License-Identifier: BSD-3-Clause
//
// Conversion of numbers to text.
#pragma once

#include <charconv>
#include <cstdint>
#include <cstdio>
#include <string>

namespace hunt {

/** Returns a short text, for options. */
inline std::string text_of(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

/** Returns the shortest decimal number with the same bits. */
inline std::string decimal_text(double value) {
  char text[40];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

/** Returns all bits as hexadecimal floating point. */
inline std::string exact_text(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%a", value);
  return text;
}

inline std::string hexadecimal(std::uint64_t value) {
  char text[24];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value));
  return text;
}

}  // namespace hunt
