// SPDX-License-Identifier: BSD-3-Clause
#include "predicates/wide_integer.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "predicates/bit_range.hpp"

namespace pnpbs {

namespace {

__extension__ using TwoWords = unsigned __int128;

std::uint64_t low_word(TwoWords x) { return static_cast<std::uint64_t>(x); }

}  // namespace

WideInteger::WideInteger(double value, int lowest_bit) {
  if (value == 0) return;
  negative_ = value < 0;
  auto [mantissa, exponent] = binary_parts(value);
  const int zeros = std::countr_zero(mantissa);  // Bits below lowest_bit are zero.
  mantissa >>= zeros;
  const int shift = exponent + zeros - lowest_bit;
  limbs_.assign(static_cast<std::size_t>(shift / 64) + 2, 0);
  const TwoWords shifted = TwoWords{mantissa} << (shift % 64);
  limbs_[limbs_.size() - 2] = low_word(shifted);
  limbs_.back() = low_word(shifted >> 64);
  trim(limbs_);
}

void WideInteger::trim(Limbs& limbs) {
  while (!limbs.empty() && limbs.back() == 0) limbs.pop_back();
}

bool WideInteger::less(const Limbs& a, const Limbs& b) {
  if (a.size() != b.size()) return a.size() < b.size();
  return std::lexicographical_compare(a.rbegin(), a.rend(), b.rbegin(), b.rend());
}

WideInteger::Limbs WideInteger::sum(const Limbs& a, const Limbs& b) {
  Limbs result(std::max(a.size(), b.size()) + 1, 0);
  TwoWords carry = 0;
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (i < a.size()) carry += a[i];
    if (i < b.size()) carry += b[i];
    result[i] = low_word(carry);
    carry >>= 64;
  }
  trim(result);
  return result;
}

WideInteger::Limbs WideInteger::difference(const Limbs& larger, const Limbs& smaller) {
  Limbs result(larger.size(), 0);
  std::uint64_t borrow = 0;
  for (std::size_t i = 0; i < result.size(); ++i) {
    const TwoWords digit =
        TwoWords{larger[i]} - (i < smaller.size() ? smaller[i] : std::uint64_t{0}) - borrow;
    result[i] = low_word(digit);
    borrow = low_word(digit >> 64) & 1;
  }
  trim(result);
  return result;
}

WideInteger::Limbs WideInteger::product(const Limbs& a, const Limbs& b) {
  Limbs result(a.size() + b.size(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::uint64_t carry = 0;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const TwoWords digit = TwoWords{a[i]} * b[j] + result[i + j] + carry;
      result[i + j] = low_word(digit);
      carry = low_word(digit >> 64);
    }
    result[i + b.size()] = carry;
  }
  trim(result);
  return result;
}

WideInteger::Limbs WideInteger::shifted(const Limbs& limbs, int bits) {
  const auto words = static_cast<std::size_t>(bits / 64);
  Limbs result(limbs.size() + words + 1, 0);
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    const TwoWords digit = TwoWords{limbs[i]} << (bits % 64);
    result[i + words] |= low_word(digit);
    result[i + words + 1] = low_word(digit >> 64);
  }
  trim(result);
  return result;
}

int WideInteger::bit_length(const Limbs& limbs) {
  if (limbs.empty()) return 0;
  return static_cast<int>(64 * limbs.size()) - std::countl_zero(limbs.back());
}

WideInteger WideInteger::added(const WideInteger& a, const Limbs& b, bool negative_b) {
  WideInteger result;
  if (a.negative_ == negative_b) {
    result.limbs_ = sum(a.limbs_, b);
    result.negative_ = a.negative_;
  } else if (less(a.limbs_, b)) {
    result.limbs_ = difference(b, a.limbs_);
    result.negative_ = negative_b;
  } else {
    result.limbs_ = difference(a.limbs_, b);
    result.negative_ = a.negative_;
  }
  return result;
}

WideInteger operator+(const WideInteger& a, const WideInteger& b) {
  return WideInteger::added(a, b.limbs_, b.negative_);
}

WideInteger operator-(const WideInteger& a, const WideInteger& b) {
  return WideInteger::added(a, b.limbs_, !b.negative_);
}

WideInteger operator*(const WideInteger& a, const WideInteger& b) {
  WideInteger result;
  result.negative_ = a.negative_ != b.negative_;
  result.limbs_ = WideInteger::product(a.limbs_, b.limbs_);
  return result;
}

// The numbers are shifted so that the quotient has 63 or 64 bits and the highest bit of b is the
// highest one of a word. The quotient is then one digit of a long division (Knuth, algorithm D).
double rounded_quotient(const WideInteger& a, const WideInteger& b, int exponent) {
  using Limbs = WideInteger::Limbs;
  if (a.sign() == 0) return 0;
  const int length = WideInteger::bit_length(b.limbs_);
  const int shift = 63 + length - WideInteger::bit_length(a.limbs_);
  const int shift_b = std::max(-shift, 0);
  const int fill = (64 - (length + shift_b) % 64) % 64;
  const Limbs divisor = WideInteger::shifted(b.limbs_, shift_b + fill);
  Limbs rest = WideInteger::shifted(a.limbs_, std::max(shift, 0) + fill);
  rest.resize(divisor.size() + 1, 0);
  const std::uint64_t top = rest.back(), first = divisor.back();
  std::uint64_t quotient = ~std::uint64_t{0};
  if (top < first) quotient = low_word((TwoWords{top} << 64 | rest[divisor.size() - 1]) / first);
  WideInteger::trim(rest);
  Limbs product = WideInteger::product(divisor, {quotient});
  while (WideInteger::less(rest, product)) {  // at most twice
    product = WideInteger::difference(product, divisor);
    --quotient;
  }
  // The lowest bit is far below the last one of a double. It stands for all bits of the rest.
  if (WideInteger::less(product, rest)) quotient |= 1;
  const double magnitude = std::ldexp(static_cast<double>(quotient), exponent - shift);
  return a.negative_ != b.negative_ ? -magnitude : magnitude;
}

}  // namespace pnpbs
