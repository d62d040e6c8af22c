// SPDX-License-Identifier: BSD-3-Clause
// Integers of any length, for determinants of doubles whose exponents are too far apart for
// expansions. Plain and slow; hardly ever needed.
#pragma once

#include <cstdint>
#include <vector>

namespace pnpbs {

class WideInteger {
 public:
  WideInteger() = default;

  // value / 2^lowest_bit, which must be an integer.
  WideInteger(double value, int lowest_bit);

  int sign() const { return limbs_.empty() ? 0 : (negative_ ? -1 : 1); }

  friend WideInteger operator+(const WideInteger& a, const WideInteger& b);
  friend WideInteger operator-(const WideInteger& a, const WideInteger& b);
  friend WideInteger operator*(const WideInteger& a, const WideInteger& b);

 private:
  using Limbs = std::vector<std::uint32_t>;  // lowest first, no leading zeros

  static void trim(Limbs& limbs);
  static bool less(const Limbs& a, const Limbs& b);
  static Limbs sum(const Limbs& a, const Limbs& b);
  static Limbs difference(const Limbs& larger, const Limbs& smaller);

  bool negative_ = false;
  Limbs limbs_;
};

}  // namespace pnpbs
