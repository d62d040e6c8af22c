// SPDX-License-Identifier: BSD-3-Clause
// The range of bits that finite doubles use, which determines the size of their exact differences
// and products.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace pnpbs {

// A double as integers: |value| = mantissa * 2^exponent.
struct BinaryParts {
  std::uint64_t mantissa;  // Less than 2^53.
  int exponent;
};

inline BinaryParts binary_parts(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const auto fraction = bits & ((std::uint64_t{1} << 52) - 1);
  const int exponent = static_cast<int>((bits >> 52) & 0x7ff);
  // Zero and subnormal numbers have no leading bit.
  const std::uint64_t leading = exponent == 0 ? 0 : 1;
  return {fraction | leading << 52, std::max(exponent, 1) - 1075};
}

// The range of bits of a set of numbers: all are multiples of 2^low and less than 2^high in
// magnitude.
struct BitRange {
  int low = 1100;
  int high = -1100;

  // Adds a number to the set. The code has no branches, because zero differences are hard to
  // predict.
  void include(double value) {
    const auto [mantissa, exponent] = binary_parts(value);
    const int beyond = mantissa == 0 ? 4096 : 0;
    const int lowest = std::countr_zero(mantissa | std::uint64_t{1} << 53);
    const int highest = static_cast<int>(std::bit_width(mantissa | 1));
    low = std::min(low, exponent + lowest + beyond);
    high = std::max(high, exponent + highest - beyond);
  }
};

}  // namespace pnpbs
