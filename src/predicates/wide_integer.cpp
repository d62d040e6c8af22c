// SPDX-License-Identifier: BSD-3-Clause
#include "predicates/wide_integer.hpp"

#include <algorithm>
#include <cmath>

namespace pnpbs {

WideInteger::WideInteger(double value, int lowest_bit) {
  if (value == 0) return;
  negative_ = value < 0;
  int exponent = 0;
  const double fraction = std::frexp(std::fabs(value), &exponent);
  auto mantissa = static_cast<std::uint64_t>(std::ldexp(fraction, 53));
  int shift = exponent - 53 - lowest_bit;
  while (shift < 0) {  // Bits below lowest_bit are zero.
    mantissa >>= 1;
    ++shift;
  }
  limbs_.assign(static_cast<std::size_t>(shift / 32) + 3, 0);
  for (int bit = 0; bit < 53; ++bit) {
    const int place = shift + bit;
    if ((mantissa >> bit) & 1u) limbs_[static_cast<std::size_t>(place / 32)] |= 1u << (place % 32);
  }
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
  std::uint64_t carry = 0;
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (i < a.size()) carry += a[i];
    if (i < b.size()) carry += b[i];
    result[i] = static_cast<std::uint32_t>(carry);
    carry >>= 32;
  }
  trim(result);
  return result;
}

WideInteger::Limbs WideInteger::difference(const Limbs& larger, const Limbs& smaller) {
  Limbs result(larger.size(), 0);
  std::int64_t borrow = 0;
  for (std::size_t i = 0; i < result.size(); ++i) {
    std::int64_t digit = static_cast<std::int64_t>(larger[i]) + borrow;
    if (i < smaller.size()) digit -= smaller[i];
    borrow = digit < 0 ? -1 : 0;
    result[i] = static_cast<std::uint32_t>(digit);
  }
  trim(result);
  return result;
}

WideInteger operator+(const WideInteger& a, const WideInteger& b) {
  WideInteger result;
  if (a.negative_ == b.negative_) {
    result.limbs_ = WideInteger::sum(a.limbs_, b.limbs_);
    result.negative_ = a.negative_;
  } else if (WideInteger::less(a.limbs_, b.limbs_)) {
    result.limbs_ = WideInteger::difference(b.limbs_, a.limbs_);
    result.negative_ = b.negative_;
  } else {
    result.limbs_ = WideInteger::difference(a.limbs_, b.limbs_);
    result.negative_ = a.negative_;
  }
  return result;
}

WideInteger operator-(const WideInteger& a, const WideInteger& b) {
  WideInteger negated = b;
  negated.negative_ = !b.negative_;
  return a + negated;
}

WideInteger operator*(const WideInteger& a, const WideInteger& b) {
  WideInteger result;
  result.negative_ = a.negative_ != b.negative_;
  result.limbs_.assign(a.limbs_.size() + b.limbs_.size(), 0);
  for (std::size_t i = 0; i < a.limbs_.size(); ++i) {
    std::uint64_t carry = 0;
    for (std::size_t j = 0; j < b.limbs_.size(); ++j) {
      carry += static_cast<std::uint64_t>(a.limbs_[i]) * b.limbs_[j] + result.limbs_[i + j];
      result.limbs_[i + j] = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
    result.limbs_[i + b.limbs_.size()] = static_cast<std::uint32_t>(carry);
  }
  WideInteger::trim(result.limbs_);
  return result;
}

}  // namespace pnpbs
