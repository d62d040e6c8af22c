// SPDX-License-Identifier: BSD-3-Clause
// Integers of a few machine words, for determinants of doubles whose bits are close together. They
// do not allocate memory and do not check for overflow: the caller ensures that the numbers fit.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "predicates/bit_range.hpp"

namespace pnpbs {

// Returns value / 2^lowest_bit, which must be an integer less than 2^63 in magnitude.
inline std::int64_t word_integer(double value, int lowest_bit) {
  const auto power_of_two = [](int exponent) {
    return std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52);
  };
  const int half = lowest_bit / 2;  // The whole power of two can be outside the range of a double.
  return static_cast<std::int64_t>(value * power_of_two(-half) * power_of_two(half - lowest_bit));
}

// An integer of two words. Sums and products also have two words, so all numbers must be less than
// 2^127 in magnitude.
class ShortInteger {
 public:
  ShortInteger() = default;

  // Constructs value / 2^lowest_bit, which must be an integer less than 2^63 in magnitude.
  ShortInteger(double value, int lowest_bit) : value_(word_integer(value, lowest_bit)) {}

  int sign() const { return (value_ > 0) - (value_ < 0); }

  friend ShortInteger operator+(ShortInteger a, ShortInteger b) {
    return ShortInteger(a.value_ + b.value_);
  }
  friend ShortInteger operator-(ShortInteger a, ShortInteger b) {
    return ShortInteger(a.value_ - b.value_);
  }
  friend ShortInteger operator*(ShortInteger a, ShortInteger b) {
    return ShortInteger(a.value_ * b.value_);
  }

 private:
  __extension__ using TwoWords = __int128;

  explicit ShortInteger(TwoWords value) : value_(value) {}

  TwoWords value_ = 0;
};

// An integer of `Words` words in two's complement, lowest word first. It is less than 2^(64 Words -
// 1) in magnitude. A product has as many words as both factors together.
template <int Words>
class FixedInteger {
 public:
  FixedInteger() = default;

  // Constructs value / 2^lowest_bit, which must be an integer.
  FixedInteger(double value, int lowest_bit) {
    if constexpr (Words == 1) {
      words_[0] = static_cast<std::uint64_t>(word_integer(value, lowest_bit));
    } else {
      set(binary_parts(value), lowest_bit);
      if (value < 0) *this = FixedInteger() - *this;
    }
  }

  int sign() const {
    if (negative()) return -1;
    std::uint64_t any = 0;
    for (const std::uint64_t word : words_) any |= word;
    return any != 0 ? 1 : 0;
  }

  friend FixedInteger operator+(const FixedInteger& a, const FixedInteger& b) {
    FixedInteger result;
    TwoWords carry = 0;
    for (int i = 0; i < Words; ++i) {
      carry += TwoWords{a.words_[i]} + b.words_[i];
      result.words_[i] = static_cast<std::uint64_t>(carry);
      carry >>= 64;
    }
    return result;
  }

  friend FixedInteger operator-(const FixedInteger& a, const FixedInteger& b) {
    FixedInteger result = a;
    result.template subtract<0>(b, true);
    return result;
  }

  // The words are multiplied as unsigned numbers first. This takes a negative number as larger by
  // 2^(64 Words), which the subtractions correct.
  template <int Others>
  FixedInteger<Words + Others> operator*(const FixedInteger<Others>& other) const {
    FixedInteger<Words + Others> result;
    for (int i = 0; i < Words; ++i) {
      TwoWords carry = 0;
      for (int j = 0; j < Others; ++j) {
        carry += TwoWords{words_[i]} * other.words_[j] + result.words_[i + j];
        result.words_[i + j] = static_cast<std::uint64_t>(carry);
        carry >>= 64;
      }
      result.words_[i + Others] = static_cast<std::uint64_t>(carry);
    }
    result.template subtract<Words>(other, negative());
    result.template subtract<Others>(*this, other.negative());
    return result;
  }

 private:
  template <int>
  friend class FixedInteger;

  __extension__ using TwoWords = unsigned __int128;

  void set(const BinaryParts& value, int lowest_bit) {
    if (value.mantissa == 0) return;
    // The mantissa is put in relative to a virtual word below the lowest one. That word remains
    // empty because the value has no bits below lowest_bit.
    const int place = value.exponent - lowest_bit + 64;
    const int word = place / 64;
    const TwoWords shifted = TwoWords{value.mantissa} << (place % 64);
    if (word > 0) words_[word - 1] = static_cast<std::uint64_t>(shifted);
    if (word < Words) words_[word] = static_cast<std::uint64_t>(shifted >> 64);
  }

  bool negative() const { return (words_[Words - 1] >> 63) != 0; }

  // Subtracts `other` from the word `First` on, if `really` is true. The code has no branch,
  // because signs are hard to predict.
  template <int First, int Others>
  void subtract(const FixedInteger<Others>& other, bool really) {
    const std::uint64_t mask = std::uint64_t{0} - (really ? 1 : 0);
    std::uint64_t borrow = 0;
    for (int i = 0; i < Others; ++i) {
      const TwoWords digit = TwoWords{words_[First + i]} - (other.words_[i] & mask) - borrow;
      words_[First + i] = static_cast<std::uint64_t>(digit);
      borrow = static_cast<std::uint64_t>(digit >> 64) & 1;
    }
  }

  std::array<std::uint64_t, Words> words_{};
};

}  // namespace pnpbs
