// SPDX-License-Identifier: BSD-3-Clause
// Fixed-point sums against integers of arbitrary length, also beyond 64 bits.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/execution.hpp"
#include "base/fixed_point.hpp"
#include "geometry/exact_integer.hpp"
#include "random.hpp"
#include "run_kernel_suite.hpp"

using pnpbs::FixedPointSum;

namespace {

// An exact number in units of 2^-32.
using Exact = ExactInteger<8>;

Exact exact(double whole) { return Exact(whole, 0); }

// Rounds a term towards 0.
Exact rounded(double term) { return exact(std::trunc(std::ldexp(term, 32))); }

Exact exact(const FixedPointSum& sum) {
  const auto high = static_cast<std::int64_t>(sum.units().high);
  return exact(std::ldexp(static_cast<double>(high >> 32), 96)) +
         exact(std::ldexp(static_cast<double>(high & 0xffffffff), 64)) +
         exact(std::ldexp(static_cast<double>(sum.units().low >> 32), 32)) +
         exact(static_cast<double>(sum.units().low & 0xffffffff));
}

bool same(const Exact& a, const Exact& b) { return (a - b).sign() == 0; }

// Returns whether no double is nearer.
bool nearest(double value, const Exact& sum) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  const double whole = std::ldexp(value, 32);
  const auto beyond_middle = [&](double other) {
    return (sum + sum - exact(whole) - Exact(std::floor(other), 0)).sign();
  };
  return beyond_middle(std::nextafter(whole, kInf)) <= 0 &&
         beyond_middle(std::nextafter(whole, -kInf)) >= 0;
}

std::vector<double> random_terms(Random& random, double size, int count) {
  std::vector<double> terms;
  for (int n = 0; n < count; ++n) terms.push_back(random.between(-0.25 * size, size));
  return terms;
}

}  // namespace

// The sum of 20 terms of any magnitude is doubled 42 times, which corresponds to 2^40 nodes with
// 2^6 terms each.
START_TEST(sums_of_any_size_are_exact) {
  Random random(17);
  for (const double size : {1.0, 1e3, 0x1p31}) {
    for (int sample = 0; sample < 200; ++sample) {
      FixedPointSum sum;
      Exact reference;
      for (const double term : random_terms(random, size, 20)) {
        sum.add(term);
        reference = reference + rounded(term);
      }
      for (int doubled = 0; doubled < 42; ++doubled) {
        sum.add(FixedPointSum(sum));
        reference = reference + reference;
        quick_assert(same(exact(sum), reference));
        quick_assert(nearest(sum.value(), reference));
      }
    }
  }
}
END_TEST

START_TEST(order_does_not_matter) {
  Random random(3);
  std::vector<double> terms = random_terms(random, 0x1p30, 1000);
  double first = 0;
  for (int round = 0; round < 10; ++round) {
    FixedPointSum sum;
    for (const double term : terms) sum.add(term);
    if (round == 0) first = sum.value();
    ck_assert_double_eq(sum.value(), first);
    random.shuffle(terms);
  }
}
END_TEST

// Sums that fit in 64 bits equal those of earlier versions, with which hashes were recorded.
START_TEST(sums_of_64_bits_are_the_same) {
  Random random(5);
  for (int sample = 0; sample < 1000; ++sample) {
    FixedPointSum sum;
    std::int64_t units = 0;
    for (const double term : random_terms(random, std::ldexp(1.0, sample % 25), 20)) {
      sum.add(term);
      units += pnpbs::fixed_point(term);
    }
    ck_assert_double_eq(sum.value(), static_cast<double>(units) / 4294967296.0);
    ck_assert_int_eq(sum.fraction(), units - (units >> 32) * (std::int64_t{1} << 32));
  }
}
END_TEST

// Sums that have lost the part beyond 64 bits keep their fraction.
START_TEST(fractions_of_wrapped_sums) {
  FixedPointSum sum;
  std::int64_t wrapped = 0;
  Random random(7);
  for (int n = 0; n < 1000; ++n) {
    const double term = random.between(0, 0x1p31);
    sum.add(term);
    wrapped = pnpbs::wrapping_sum(wrapped, pnpbs::fixed_point(term));
    ck_assert_int_eq(pnpbs::fraction_of(wrapped), sum.fraction());
  }
  ck_assert_double_gt(sum.value(), 0x1p31);
}
END_TEST

START_TEST(kernels_sum_beyond_64_bits) {
  constexpr std::int64_t kTerms = 100'000;
  const FixedPointSum sum = pnpbs::fixed_point_sum_of(
      "sum", kTerms, [](std::int64_t i) { return i % 2 == 0 ? 0x1p30 : 0x1p-32; });
  const Exact half = exact(static_cast<double>(kTerms) / 2);
  ck_assert(same(exact(sum), half * exact(0x1p62) + half));
  ck_assert_double_eq(sum.value(), static_cast<double>(kTerms) / 2 * 0x1p30);
}
END_TEST

TEST_SUITE(test_fixed_point) {
  return run_kernel_suite("fixed_point", {sums_of_any_size_are_exact, order_does_not_matter,
                                          sums_of_64_bits_are_the_same, fractions_of_wrapped_sums,
                                          kernels_sum_beyond_64_bits});
}
