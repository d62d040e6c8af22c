// SPDX-License-Identifier: BSD-3-Clause
// Pseudo-random numbers for the trials of a repair. All of them are derived from the bits of a lot,
// so every rank and every thread draws the same.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "base/mixed_hash.hpp"
#include "base/space_vectors.hpp"

namespace pnpbs {

// Returns a number in [0, 1).
inline double unit_interval(std::uint64_t bits) {
  return static_cast<double>(bits >> 11) * 0x1p-53;
}

// Returns a unit vector that is uniformly distributed over all directions.
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

// Returns the bits of one trial of an attempt with this lot.
inline std::uint64_t bits_of_trial(std::uint64_t lot, int trial) {
  return mixed(lot + 1 + static_cast<std::uint64_t>(trial));
}

}  // namespace pnpbs
