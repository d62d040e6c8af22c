// SPDX-License-Identifier: BSD-3-Clause
// Integers of arbitrary length with schoolbook arithmetic, as a reference for the library's exact
// arithmetic. They have a sign and digits of base 2^32.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/quick_assert.hpp"

template <int Capacity>
class ExactInteger {
 public:
  ExactInteger() = default;
  ExactInteger(const ExactInteger& other) { *this = other; }
  ExactInteger& operator=(const ExactInteger& other) {
    sign_ = other.sign_;
    size_ = other.size_;
    std::copy_n(other.digits_, size_, digits_);
    return *this;
  }

  // value / 2^unit, which must be an integer.
  ExactInteger(double value, int unit) {
    int exponent;
    const double fraction = std::frexp(std::fabs(value), &exponent);
    auto whole = static_cast<std::uint64_t>(std::ldexp(fraction, 53));
    exponent -= 53 + unit;
    for (; exponent < 0 && whole != 0; ++exponent, whole /= 2) quick_assert(whole % 2 == 0);
    if (whole == 0) return;
    sign_ = value < 0 ? -1 : 1;
    append_zeros(exponent / 32);
    std::uint64_t carry = 0;
    for (const std::uint64_t part : {whole & 0xffffffff, whole >> 32}) {
      carry += part << (exponent % 32);
      append(carry & 0xffffffff);
      carry >>= 32;
    }
    append(carry);
    trim();
  }

  int sign() const { return sign_; }

  ExactInteger operator-() const {
    ExactInteger result = *this;
    result.sign_ = -sign_;
    return result;
  }

  friend ExactInteger operator+(const ExactInteger& a, const ExactInteger& b) {
    if (a.sign_ == 0) return b;
    if (b.sign_ == 0) return a;
    if (a.sign_ == b.sign_) return sum(a, b);
    return a.exceeds(b) ? rest(a, b) : rest(b, a);
  }
  friend ExactInteger operator-(const ExactInteger& a, const ExactInteger& b) { return a + -b; }

  friend ExactInteger operator*(const ExactInteger& a, const ExactInteger& b) {
    ExactInteger result;
    result.sign_ = a.sign_ * b.sign_;
    if (result.sign_ == 0) return result;
    result.append_zeros(a.size_ + b.size_);
    for (int i = 0; i < a.size_; ++i) {
      std::uint64_t carry = 0;
      for (int j = 0; j < b.size_; ++j) {
        carry += std::uint64_t{a.digits_[i]} * b.digits_[j] + result.digits_[i + j];
        result.digits_[i + j] = static_cast<std::uint32_t>(carry);
        carry >>= 32;
      }
      result.digits_[i + b.size_] = static_cast<std::uint32_t>(carry);
    }
    result.trim();
    return result;
  }

 private:
  void append(std::uint64_t digit) {
    quick_assert(size_ < Capacity);
    digits_[size_++] = static_cast<std::uint32_t>(digit);
  }
  void append_zeros(int count) {
    for (int i = 0; i < count; ++i) append(0);
  }
  void trim() {
    while (size_ > 0 && digits_[size_ - 1] == 0) --size_;
  }
  std::uint32_t digit(int i) const { return i < size_ ? digits_[i] : 0; }

  bool exceeds(const ExactInteger& other) const {
    int i = std::max(size_, other.size_) - 1;
    while (i >= 0 && digit(i) == other.digit(i)) --i;
    return i >= 0 && digit(i) > other.digit(i);
  }

  static ExactInteger sum(const ExactInteger& a, const ExactInteger& b) {
    ExactInteger result;
    result.sign_ = a.sign_;
    std::uint64_t carry = 0;
    for (int i = 0; i < std::max(a.size_, b.size_); ++i) {
      carry += std::uint64_t{a.digit(i)} + b.digit(i);
      result.append(carry & 0xffffffff);
      carry >>= 32;
    }
    if (carry != 0) result.append(carry);
    return result;
  }

  // Returns larger - smaller.
  static ExactInteger rest(const ExactInteger& larger, const ExactInteger& smaller) {
    ExactInteger result;
    std::uint64_t borrowed = 0;
    for (int i = 0; i < larger.size_; ++i) {
      const std::uint64_t taken = smaller.digit(i) + borrowed;
      borrowed = larger.digits_[i] < taken ? 1 : 0;
      result.append((borrowed << 32) + larger.digits_[i] - taken);
    }
    result.trim();
    result.sign_ = result.size_ > 0 ? larger.sign_ : 0;
    return result;
  }

  int sign_ = 0;
  int size_ = 0;  // number of digits, lowest first; the last one is not 0
  std::uint32_t digits_[Capacity];
};
