// SPDX-License-Identifier: BSD-3-Clause
// Integers of any length, for determinants of doubles whose exponents are too far apart for
// expansions. They are simple and slow, and rarely needed.
#pragma once

#include <cstdint>
#include <vector>

namespace pnpbs {

class WideInteger {
 public:
  WideInteger() = default;

  // Constructs value / 2^lowest_bit, which must be an integer.
  WideInteger(double value, int lowest_bit);

  int sign() const { return limbs_.empty() ? 0 : (negative_ ? -1 : 1); }

  friend WideInteger operator+(const WideInteger& a, const WideInteger& b);
  friend WideInteger operator-(const WideInteger& a, const WideInteger& b);
  friend WideInteger operator*(const WideInteger& a, const WideInteger& b);

 private:
  using Limbs = std::vector<std::uint32_t>;  // Lowest limb first, without leading zeros.

  static void trim(Limbs& limbs);
  static bool less(const Limbs& a, const Limbs& b);
  static Limbs sum(const Limbs& a, const Limbs& b);
  static Limbs difference(const Limbs& larger, const Limbs& smaller);

  bool negative_ = false;
  Limbs limbs_;
};

}  // namespace pnpbs
