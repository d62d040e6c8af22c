// SPDX-License-Identifier: BSD-3-Clause
//
// A portable random generator. Each part of each case has a stream of its own, so that the draws of
// one part do not affect the others.
#pragma once

#include <cmath>
#include <cstdint>
#include <string_view>

namespace hunt {

class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t number, std::string_view part) {
    state_ = 0xcbf29ce484222325u;
    for (const char c : part) state_ = (state_ ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    state_ = mixed(mixed(mixed(state_) ^ seed) ^ number);
  }

  std::uint64_t bits() { return mixed(state_ += 0x9e3779b97f4a7c15u); }
  /** Returns a number in [0, 1). */
  double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  /** Returns a number with uniform distribution of its logarithm. */
  double scale(double low, double high) { return low * std::pow(high / low, unit()); }
  /** Returns an integer in [low, high]. */
  int pick(int low, int high) {
    return low + static_cast<int>(bits() % static_cast<std::uint64_t>(high - low + 1));
  }
  bool chance(double share) { return unit() < share; }

 private:
  // Applies the finalizer of SplitMix64.
  static std::uint64_t mixed(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

  std::uint64_t state_;
};

}  // namespace hunt
