// SPDX-License-Identifier: BSD-3-Clause
// Sums of doubles, and of products of two, without any rounding until the end: a fixed-point number
// long enough for all of them (U. Kulisch, W. Miranker, Computer Arithmetic in Theory and Practice,
// 1981), in which the order of the terms does not matter. Its digits hold more than their 32 bits,
// so that carries wait (R. Neal, "Fast exact summation using small and large superaccumulators",
// 2015), and accumulators of threads and ranks are added digit by digit.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace pnpbs {

class ExactSum {
 public:
  // Digits, and how many terms are NaN, +inf and -inf: integers that may be added up over ranks.
  static constexpr int kDigits = 136, kEntries = kDigits + 3;

  void add(double term);
  void add_product(double x, double y);
  void add(const ExactSum& other);

  // After carry() the entries of 2^30 sums can be added.
  void carry();
  std::array<std::int64_t, kEntries>& entries() { return entries_; }

  // The double nearest to the sum, of two equally near ones that with an even last bit; an infinity
  // if it is beyond the largest double. NaN if a term is, or there are infinities of both signs;
  // otherwise an infinity if a term is. The sum of nothing, and any sum that is 0, is +0.
  double value();

 private:
  friend class ExactProducts;
  // Digit k counts 2^(32 k - 2176); the least bit of a product of doubles, 2^-2148, is in the
  // first.
  static constexpr int kUnit = -2176;
  static constexpr int kNaN = kDigits, kInfinity = kDigits + 1, kMinusInfinity = kDigits + 2;
  static constexpr std::int64_t kTermsToCarry = std::int64_t{1} << 28;

  bool count_not_finite(double term);
  void add_bits(std::uint64_t bits, int place, bool negative);
  void carry_if_due() {
    if (++terms_ >= kTermsToCarry) carry();
  }

  std::array<std::int64_t, kEntries> entries_{};
  std::int64_t terms_ = 0;  // since the last carry
};

// Many products, much faster: whole numbers of two words, one for each sum of exponents, to which
// the products of the fractions are added.
class ExactProducts {
 public:
  static constexpr std::int64_t kMaxTerms = std::int64_t{1} << 20;  // 2^126 / 2^106

  void add(double x, double y);
  // All there are, at the end.
  void add_to(ExactSum& sum) const;

 private:
  __extension__ using TwoWords = __int128;
  static constexpr std::size_t kExponents = 4096;

  std::vector<TwoWords> by_exponent_ = std::vector<TwoWords>(kExponents, 0);
  ExactSum others_;  // that are not finite
};

}  // namespace pnpbs
