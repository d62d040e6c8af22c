// SPDX-License-Identifier: BSD-3-Clause
#include "base/exact_sum.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace pnpbs {

namespace {

__extension__ using UnsignedTwoWords = unsigned __int128;

constexpr std::int64_t kDigit = std::int64_t{1} << 32;

// A finite double as an integer times a power of 2: bits * 2^exponent.
struct Parts {
  std::uint64_t bits;
  int exponent;
  bool negative;
};

Parts parts(double x) {
  const auto word = std::bit_cast<std::uint64_t>(x);
  const int exponent = static_cast<int>(word >> 52 & 0x7ff);
  const std::uint64_t fraction = word & ((std::uint64_t{1} << 52) - 1);
  // Subnormal numbers have no implicit leading bit, and their exponent is that of 2^-1022.
  return {exponent > 0 ? fraction | std::uint64_t{1} << 52 : fraction, std::max(exponent, 1) - 1075,
          word >> 63 != 0};
}

}  // namespace

bool ExactSum::count_not_finite(double term) {
  if (std::isfinite(term)) return false;
  ++entries_[std::isnan(term) ? kNaN : term > 0 ? kInfinity : kMinusInfinity];
  return true;
}

// Adds bits * 2^(place + kUnit). `place` is the index of the lowest bit in the accumulator.
void ExactSum::add_bits(std::uint64_t bits, int place, bool negative) {
  const UnsignedTwoWords shifted = static_cast<UnsignedTwoWords>(bits) << (place % 32);
  const std::int64_t digits[3] = {static_cast<std::int64_t>(shifted & (kDigit - 1)),
                                  static_cast<std::int64_t>(shifted >> 32 & (kDigit - 1)),
                                  static_cast<std::int64_t>(shifted >> 64)};
  std::int64_t* to = entries_.data() + place / 32;
  for (int k = 0; k < 3; ++k) to[k] += negative ? -digits[k] : digits[k];
}

void ExactSum::add(double term) {
  if (count_not_finite(term)) return;
  const Parts p = parts(term);
  add_bits(p.bits, p.exponent - kUnit, p.negative);
  carry_if_due();
}

void ExactSum::add_product(double x, double y) {
  if (!std::isfinite(x) || !std::isfinite(y)) {
    count_not_finite(x * y);
    return;
  }
  const Parts p = parts(x), q = parts(y);
  const UnsignedTwoWords product = static_cast<UnsignedTwoWords>(p.bits) * q.bits;
  const int place = p.exponent + q.exponent - kUnit;
  const bool negative = p.negative != q.negative;
  add_bits(static_cast<std::uint64_t>(product), place, negative);
  add_bits(static_cast<std::uint64_t>(product >> 64), place + 64, negative);
  carry_if_due();
}

void ExactSum::add(const ExactSum& other) {
  ExactSum theirs = other;
  theirs.carry();
  for (std::size_t k = 0; k < entries_.size(); ++k) entries_[k] += theirs.entries_[k];
  carry_if_due();
}

void ExactProducts::add(double x, double y) {
  constexpr std::uint64_t kLeading = std::uint64_t{1} << 52, kNotFinite = 0x7ff;
  const auto p = std::bit_cast<std::uint64_t>(x), q = std::bit_cast<std::uint64_t>(y);
  const std::uint64_t i = p >> 52 & 0x7ff, j = q >> 52 & 0x7ff;
  if (i == kNotFinite || j == kNotFinite) return others_.add_product(x, y);
  const std::uint64_t a = (p & (kLeading - 1)) | (i > 0 ? kLeading : 0);
  const std::uint64_t b = (q & (kLeading - 1)) | (j > 0 ? kLeading : 0);
  const auto product = static_cast<TwoWords>(a) * static_cast<TwoWords>(b);
  // `sign` is -1 if the signs differ and 0 otherwise; (product ^ sign) - sign then negates the
  // product without a branch.
  const auto sign = -static_cast<TwoWords>((p ^ q) >> 63);
  by_exponent_[std::max<std::uint64_t>(i, 1) + std::max<std::uint64_t>(j, 1)] +=
      (product ^ sign) - sign;
}

void ExactProducts::add_to(ExactSum& sum) const {
  for (std::size_t k = 0; k < kExponents; ++k) {
    const TwoWords found = by_exponent_[k];
    if (found == 0) continue;
    const bool negative = found < 0;
    const auto size = static_cast<UnsignedTwoWords>(negative ? -found : found);
    const int place = static_cast<int>(k) - 2 * 1075 - ExactSum::kUnit;
    sum.add_bits(static_cast<std::uint64_t>(size), place, negative);
    sum.add_bits(static_cast<std::uint64_t>(size >> 64), place + 64, negative);
    sum.carry_if_due();
  }
  sum.add(others_);
}

// Leaves all digits but the last in 0 .. 2^32 - 1; the last digit has the sign of the sum.
void ExactSum::carry() {
  std::int64_t carried = 0;
  for (int k = 0; k + 1 < kDigits; ++k) {
    const std::int64_t digit = entries_[static_cast<std::size_t>(k)] + carried;
    carried = digit >> 32;  // towards minus infinity
    entries_[static_cast<std::size_t>(k)] = digit - carried * kDigit;
  }
  entries_[kDigits - 1] += carried;
  terms_ = 0;
}

double ExactSum::value() {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  if (entries_[kNaN] > 0 || (entries_[kInfinity] > 0 && entries_[kMinusInfinity] > 0))
    return std::numeric_limits<double>::quiet_NaN();
  if (entries_[kInfinity] > 0) return kInf;
  if (entries_[kMinusInfinity] > 0) return -kInf;

  carry();
  const bool negative = entries_[kDigits - 1] < 0;
  ExactSum size = *this;
  if (negative) {
    for (int k = 0; k < kDigits; ++k)
      size.entries_[static_cast<std::size_t>(k)] = -entries_[static_cast<std::size_t>(k)];
    size.carry();
  }
  int top = kDigits - 1;
  while (top >= 0 && size.entries_[static_cast<std::size_t>(top)] == 0) --top;
  if (top < 0) return 0;

  const auto bit = [&](int place) {
    return place >= 0 && (size.entries_[static_cast<std::size_t>(place / 32)] >> (place % 32) & 1);
  };
  int high = 32 * top + 31;
  while (!bit(high)) --high;
  // `low` is the last bit that a double of this magnitude can hold.
  const int low = std::max(high - 52, -1074 - kUnit);
  std::uint64_t bits = 0;
  for (int place = high; place >= low; --place) bits = bits << 1 | (bit(place) ? 1 : 0);
  bool more = false;
  for (int place = std::min(low - 2, high); place >= 0 && !more; --place) more = bit(place);
  if (bit(low - 1) && (more || (bits & 1) != 0)) ++bits;
  const double rounded = std::ldexp(static_cast<double>(bits), low + kUnit);
  return negative ? -rounded : rounded;
}

}  // namespace pnpbs
