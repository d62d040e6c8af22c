// SPDX-License-Identifier: BSD-3-Clause
// Sums of doubles that do not depend on the order of the terms. Each term is rounded to a multiple
// of 2^-32, and the multiples are added as integers.
#pragma once

#include <cstdint>

namespace pnpbs {

// A 128-bit integer stored as two words, since MPI has no type for 128-bit integers.
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

// The number 1 in units of 2^-32.
inline constexpr std::int64_t kFixedPointOne = std::int64_t{1} << 32;

// Converts a value to units of 2^-32, rounded towards 0. Its magnitude must be below 2^31.
inline std::int64_t fixed_point(double value) {
  return static_cast<std::int64_t>(value * 4294967296.0);
}

// Returns the fractional part of a sum, in units of 2^-32. The result is correct for sums modulo
// 2^64, too.
inline std::int64_t fraction_of(std::int64_t units) { return units & (kFixedPointOne - 1); }

// Returns a + b modulo 2^64, without the undefined behaviour of signed overflow.
inline std::int64_t wrapping_sum(std::int64_t a, std::int64_t b) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) + static_cast<std::uint64_t>(b));
}

// A sum of doubles in units of 2^-32. It cannot overflow: terms have up to 63 bits and a sign, and
// 2^40 nodes with 2^6 pairs or elements each give 2^46 terms, whose sum has at most 109 of the 127
// bits.
class FixedPointSum {
 public:
  void add(double term) { add_units(fixed_point(term)); }
  void add_units(std::int64_t units) { units_.add(Int128::of(units)); }
  void add(const FixedPointSum& other) { units_.add(other.units_); }

  double value() const { return static_cast<double>(units_.value()) / 4294967296.0; }
  bool is_zero() const { return units_.low == 0 && units_.high == 0; }
  std::int64_t fraction() const { return fraction_of(static_cast<std::int64_t>(units_.low)); }

  Int128& units() { return units_; }
  const Int128& units() const { return units_; }

 private:
  Int128 units_;
};

}  // namespace pnpbs
