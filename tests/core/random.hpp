// SPDX-License-Identifier: BSD-3-Clause
// A pseudo-random generator with the same numbers on every platform.
#pragma once

#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "base/types.hpp"

class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}

  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(bits_() >> 11) * 0x1p-53;
  }
  std::int64_t below(std::int64_t n) {
    return static_cast<std::int64_t>(bits_() % static_cast<std::uint64_t>(n));
  }
  template <int Dim>
  pnpbs::Point<Dim> point(const pnpbs::Box<Dim>& box) {
    pnpbs::Point<Dim> x;
    for (int k = 0; k < Dim; ++k) x[k] = between(box.low[k], box.high[k]);
    return x;
  }
  template <class Items>
  void shuffle(Items& items) {
    for (std::size_t n = items.size(); n > 1; --n)
      std::swap(items[n - 1], items[static_cast<std::size_t>(below(static_cast<std::int64_t>(n)))]);
  }

 private:
  std::mt19937_64 bits_;
};
