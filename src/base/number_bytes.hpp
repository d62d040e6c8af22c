// SPDX-License-Identifier: BSD-3-Clause
// Numbers as they stand in binary files.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace pnpbs {

template <class Number>
Number number_from_bytes(const char* bytes, std::endian order) {
  std::array<char, sizeof(Number)> field;
  std::memcpy(field.data(), bytes, sizeof(Number));
  if (order != std::endian::native) std::reverse(field.begin(), field.end());
  return std::bit_cast<Number>(field);
}

}  // namespace pnpbs
