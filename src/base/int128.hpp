// SPDX-License-Identifier: BSD-3-Clause
// Whole numbers of 128 bits as plain words, which messages can carry: MPI has none.
#pragma once

#include <cstdint>

namespace pnpbs {

struct Int128 {
  __extension__ using Value = __int128;

  std::uint64_t low = 0, high = 0;  // two's complement

  static Int128 of(Value value) {
    return {static_cast<std::uint64_t>(value), static_cast<std::uint64_t>(value >> 64)};
  }
  Value value() const { return static_cast<Value>(high) << 64 | low; }
  void add(const Int128& other) {
    const std::uint64_t before = low;
    low += other.low;
    high += other.high + (low < before ? 1 : 0);
  }
};

}  // namespace pnpbs
