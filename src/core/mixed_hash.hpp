// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace pnpbs {

// Scrambles 64 bits: the finaliser of SplitMix64 (G. Steele, D. Lea, C. Flood, OOPSLA 2014).
inline std::uint64_t mixed(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

}  // namespace pnpbs
