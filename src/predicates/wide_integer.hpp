// SPDX-License-Identifier: BSD-3-Clause
// Integers of any length, for determinants of doubles whose exponents are too far apart for
// expansions, and for points that are constructed exactly. They are simple and slow.
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

  friend WideInteger operator-(WideInteger a) {
    a.negative_ = !a.negative_;
    return a;
  }
  friend WideInteger operator+(const WideInteger& a, const WideInteger& b);
  friend WideInteger operator-(const WideInteger& a, const WideInteger& b);
  friend WideInteger operator*(const WideInteger& a, const WideInteger& b);

  // Returns the double nearest to 2^exponent a / b, which must be in the normal range or 0. b must
  // not be 0. Ties are rounded to even.
  friend double rounded_quotient(const WideInteger& a, const WideInteger& b, int exponent);

 private:
  using Limbs = std::vector<std::uint64_t>;  // Lowest limb first, without leading zeros.

  static void trim(Limbs& limbs);
  static bool less(const Limbs& a, const Limbs& b);
  static Limbs sum(const Limbs& a, const Limbs& b);
  static Limbs difference(const Limbs& larger, const Limbs& smaller);
  static Limbs product(const Limbs& a, const Limbs& b);
  static Limbs shifted(const Limbs& limbs, int bits);
  static int bit_length(const Limbs& limbs);
  static WideInteger added(const WideInteger& a, const Limbs& b, bool negative_b);

  bool negative_ = false;
  Limbs limbs_;
};

}  // namespace pnpbs
