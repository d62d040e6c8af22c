// SPDX-License-Identifier: BSD-3-Clause
// Exact sums of doubles and of products of two doubles. The sum is a fixed-point number that is
// long enough for all terms (U. Kulisch, W. Miranker, Computer Arithmetic in Theory and Practice,
// 1981), so it does not depend on the order of the terms, and only the final conversion to double
// rounds. Digits of 32 bits are stored in 64 bits, so that carries can be postponed (R. Neal, "Fast
// exact summation using small and large superaccumulators", 2015). Accumulators of threads and
// ranks are added digit by digit.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace pnpbs {

// An accumulator that adds doubles without rounding.
class ExactSum {
 public:
  // Number of digits, and number of entries: the digits and the counts of terms that are NaN, +inf
  // and -inf. All entries are integers that can be summed over ranks.
  static constexpr int kDigits = 136, kEntries = kDigits + 3;

  void add(double term);
  void add_product(double x, double y);
  void add(const ExactSum& other);

  // Normalizes the digits to 32 bits. Afterwards the entries of up to 2^30 sums can be added
  // without overflow.
  void carry();
  std::array<std::int64_t, kEntries>& entries() { return entries_; }

  // Returns the sum rounded to the nearest double, ties to even. It is NaN if a term is NaN or if
  // infinities of both signs were added, and otherwise infinite if a term is infinite or if the sum
  // exceeds the largest double. An empty sum and any sum of value 0 give +0.
  double value();

 private:
  friend class ExactProducts;
  // Digit k has the unit 2^(32 k - 2176). The smallest bit of a product of two doubles, 2^-2148,
  // lies in the first digit.
  static constexpr int kUnit = -2176;
  static constexpr int kNaN = kDigits, kInfinity = kDigits + 1, kMinusInfinity = kDigits + 2;
  static constexpr std::int64_t kTermsToCarry = std::int64_t{1} << 28;

  bool count_not_finite(double term);
  void add_bits(std::uint64_t bits, int place, bool negative);
  void carry_if_due() {
    if (++terms_ >= kTermsToCarry) carry();
  }

  std::array<std::int64_t, kEntries> entries_{};
  std::int64_t terms_ = 0;  // terms since the last carry
};

// A faster accumulator for many products. It has a 128-bit integer for each sum of two exponents,
// to which the products of the fractions are added.
class ExactProducts {
 public:
  static constexpr std::int64_t kMaxTerms = std::int64_t{1} << 20;  // 2^126 / 2^106

  void add(double x, double y);
  // Adds all products to `sum`. Called once, after the last product.
  void add_to(ExactSum& sum) const;

 private:
  __extension__ using TwoWords = __int128;
  static constexpr std::size_t kExponents = 4096;

  std::vector<TwoWords> by_exponent_ = std::vector<TwoWords>(kExponents, 0);
  ExactSum others_;  // products that are not finite
};

}  // namespace pnpbs
