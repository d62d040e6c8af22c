// SPDX-License-Identifier: BSD-3-Clause
// Hashes of numbers, which do not depend on the processor or the standard library.
#pragma once

#include <bit>
#include <cstdint>

namespace pnpbs {

// Scrambles 64 bits by the finalizer of SplitMix64 (G. Steele, D. Lea, C. Flood, OOPSLA 2014).
inline std::uint64_t mixed(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

// Combines a hash with every bit of a value.
inline std::uint64_t mixed_with(std::uint64_t hash, double value) {
  return mixed(hash ^ std::bit_cast<std::uint64_t>(value));
}

}  // namespace pnpbs
