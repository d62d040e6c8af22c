// SPDX-License-Identifier: BSD-3-Clause
// What the trials of a repair draw at random: all of it follows from the bits of a lot, so that
// every rank and thread draws the same.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "base/mixed_hash.hpp"
#include "base/space_vectors.hpp"

namespace pnpbs {

inline double unit_interval(std::uint64_t bits) {
  return static_cast<double>(bits >> 11) * 0x1p-53;
}

// A direction that follows from the bits alone.
inline Point<3> direction_from(std::uint64_t bits) {
  while (true) {
    Point<3> v;
    for (double& along : v) {
      bits = mixed(bits);
      along = 2 * unit_interval(bits) - 1;
    }
    const double length = std::sqrt(dot(v, v));
    if (length > 1 || length < 0.1) continue;
    for (double& along : v) along /= length;
    return v;
  }
}

inline std::uint64_t bits_of(double x) { return std::bit_cast<std::uint64_t>(x); }

inline std::uint64_t bits_of_trial(std::uint64_t lot, int trial) {
  return mixed(lot + 1 + static_cast<std::uint64_t>(trial));
}

}  // namespace pnpbs
