// SPDX-License-Identifier: BSD-3-Clause
// Conversion of numbers from the bytes of binary files.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace pnpbs {

// Returns the number that is stored at `bytes` in the given byte order. `bytes` need not be
// aligned.
template <class Number>
Number number_from_bytes(const char* bytes, std::endian order) {
  std::array<char, sizeof(Number)> field;
  std::memcpy(field.data(), bytes, sizeof(Number));
  if (order != std::endian::native) std::reverse(field.begin(), field.end());
  return std::bit_cast<Number>(field);
}

}  // namespace pnpbs
