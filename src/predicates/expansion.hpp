// SPDX-License-Identifier: BSD-3-Clause
// Expansions: exact numbers as sums of doubles that do not overlap, in ascending order (Shewchuk
// 1997). They are exact if nothing overflows and no product falls below the normal range. They
// require rounding to nearest and no contraction by the compiler.
#pragma once

#include <algorithm>
#include <cmath>

namespace pnpbs {

struct TwoTerms {
  double high;
  double low;  // high + low is the exact result.
};

inline TwoTerms two_sum(double a, double b) {
  const double sum = a + b;
  const double b_part = sum - a;
  const double a_part = sum - b_part;
  return {sum, (a - a_part) + (b - b_part)};
}

// Returns two_sum(a, b) for |a| >= |b|, with fewer operations.
inline TwoTerms fast_two_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

inline TwoTerms two_product(double a, double b) {
  const double product = a * b;
  return {product, std::fma(a, b, -product)};
}

template <int Capacity>
struct Expansion {
  int size = 0;  // Number of terms. Zero terms are omitted, so that the number 0 has no terms.
  double terms[Capacity];

  void append(double term) {
    if (term != 0) terms[size++] = term;
  }
  int sign() const {
    if (size == 0) return 0;
    return terms[size - 1] > 0 ? 1 : -1;
  }
};

inline Expansion<2> exact_difference(double a, double b) {
  const TwoTerms difference = two_sum(a, -b);
  Expansion<2> result;
  result.append(difference.low);
  result.append(difference.high);
  return result;
}

// Merges the terms in order of magnitude (Shewchuk's fast-expansion-sum).
template <int A, int B>
Expansion<A + B> operator+(const Expansion<A>& a, const Expansion<B>& b) {
  Expansion<A + B> result;
  int i = 0, j = 0;
  const auto next = [&] {
    if (j == b.size) return a.terms[i++];
    if (i == a.size) return b.terms[j++];
    return std::fabs(a.terms[i]) < std::fabs(b.terms[j]) ? a.terms[i++] : b.terms[j++];
  };
  const int count = a.size + b.size;
  if (count == 0) return result;
  double carry = next();
  for (int k = 1; k < count; ++k) {
    const TwoTerms sum = two_sum(carry, next());
    result.append(sum.low);
    carry = sum.high;
  }
  result.append(carry);
  return result;
}

template <int A>
Expansion<A> operator-(const Expansion<A>& a) {
  Expansion<A> result;
  result.size = a.size;
  for (int i = 0; i < a.size; ++i) result.terms[i] = -a.terms[i];
  return result;
}

template <int A>
Expansion<2 * A> scaled(const Expansion<A>& a, double factor) {
  Expansion<2 * A> result;
  if (a.size == 0) return result;
  TwoTerms carry = two_product(a.terms[0], factor);
  result.append(carry.low);
  for (int i = 1; i < a.size; ++i) {
    const TwoTerms product = two_product(a.terms[i], factor);
    const TwoTerms sum = two_sum(carry.high, product.low);
    result.append(sum.low);
    carry = fast_two_sum(product.high, sum.high);
    result.append(carry.low);
  }
  result.append(carry.high);
  return result;
}

// Returns the product of a and `Count` terms of b from `first` on. The recursion halves the terms,
// so that the sums are balanced.
template <int Count, int A, int B>
Expansion<2 * A * Count> product_of_terms(const Expansion<A>& a, const Expansion<B>& b, int first) {
  if constexpr (Count == 1) {
    return first < b.size ? scaled(a, b.terms[first]) : Expansion<2 * A>{};
  } else {
    if (first >= b.size) return {};
    return product_of_terms<Count / 2>(a, b, first) +
           product_of_terms<Count - Count / 2>(a, b, first + Count / 2);
  }
}

template <int A, int B>
Expansion<2 * A * B> operator*(const Expansion<A>& a, const Expansion<B>& b) {
  return product_of_terms<B>(a, b, 0);
}

}  // namespace pnpbs
