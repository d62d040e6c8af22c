// SPDX-License-Identifier: BSD-3-Clause
// Tests of many numbers side by side, a bit for each.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace pnpbs {

inline constexpr std::size_t kGroup = 8, kWord = 64;

// Bits of those among the first n <= kWord numbers for which test(k) holds.
template <class Test>
inline std::uint64_t bits_where(std::size_t n, const Test& test) {
  std::uint64_t bits = 0;
#pragma omp simd reduction(| : bits)
  for (std::size_t k = 0; k < n; ++k) bits |= static_cast<std::uint64_t>(test(k)) << k;
  return bits;
}

// The same for those of n numbers from the first one on; tests are done in whole groups.
template <class Test>
inline std::uint64_t bits_where(std::size_t first, std::size_t n, const Test& test) {
  const std::size_t left = std::min(kWord, n - first);
  return bits_where((left + kGroup - 1) & ~(kGroup - 1),
                    [&](std::size_t k) { return test(first + k); }) &
         (~std::uint64_t{0} >> (kWord - left));
}

}  // namespace pnpbs
