// SPDX-License-Identifier: BSD-3-Clause
// Exact sums against integers of arbitrary length: results are the nearest doubles for any order of
// the terms.
#include <cfloat>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/exact_sum.hpp"
#include "geometry/exact_integer.hpp"
#include "geometry/run_suite.hpp"
#include "random.hpp"

using pnpbs::ExactSum;

namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// An exact number in units of the smallest product of two doubles.
using Exact = ExactInteger<160>;
Exact exact(double x) { return Exact(x, -2148); }
Exact exact_product(double x, double y) { return Exact(x, -1074) * Exact(y, -1074); }

bool is_even(double x) {
  int exponent;
  return std::fmod(std::ldexp(std::frexp(x, &exponent), 53), 2) == 0;
}

// Expects that no double is nearer, and that `value` is the even one of two equally near doubles.
void expect_nearest(double value, const Exact& sum) {
  quick_assert(std::isfinite(value));
  for (const double way : {-kInf, kInf}) {
    const double other = std::nextafter(value, way);
    if (!std::isfinite(other)) continue;
    const Exact beyond_middle = sum + sum - (exact(value) + exact(other));
    const int side = way > 0 ? beyond_middle.sign() : -beyond_middle.sign();
    quick_assert(side < 0 || (side == 0 && is_even(value)));
  }
}

double sum_of(const std::vector<double>& terms) {
  ExactSum sum;
  for (const double term : terms) sum.add(term);
  return sum.value();
}

bool same_bits(double a, double b) { return a == b && std::signbit(a) == std::signbit(b); }

// Returns a double with a magnitude between 2^lowest and 2^highest.
double some_double(Random& random, int lowest, int highest) {
  const double fraction = random.between(0.5, 1);
  const int exponent = lowest + static_cast<int>(random.below(highest - lowest + 1));
  return std::ldexp(random.below(2) == 0 ? fraction : -fraction, exponent);
}

}  // namespace

START_TEST(nearest_to_the_sum) {
  Random random(1);
  for (int round = 0; round < 400; ++round) {
    const int lowest = -1080 + static_cast<int>(random.below(2000));
    const int highest = std::min(lowest + 1 + static_cast<int>(random.below(400)), 1010);
    std::vector<double> terms;
    Exact sum;
    for (std::int64_t n = random.below(40); n > 0; --n) {
      terms.push_back(some_double(random, std::min(lowest, 1000), highest));
      // Often adds a term that cancels another one.
      if (random.below(3) == 0)
        terms.push_back(-terms[static_cast<std::size_t>(
            random.below(static_cast<std::int64_t>(terms.size())))]);
    }
    for (const double term : terms) sum = sum + exact(term);
    const double value = sum_of(terms);
    expect_nearest(value, sum);
    random.shuffle(terms);
    quick_assert(same_bits(value, sum_of(terms)));
  }
}
END_TEST

START_TEST(nearest_to_the_sum_of_products) {
  Random random(2);
  for (int round = 0; round < 400; ++round) {
    // Products range from far below the smallest double to values of which only the sum is finite.
    const int lowest = -1074 + static_cast<int>(random.below(1500));
    std::vector<std::pair<double, double>> factors;
    Exact sum;
    for (std::int64_t n = 1 + random.below(20); n > 0; --n) {
      const double x = some_double(random, lowest, lowest + 60);
      const double y = some_double(random, -1074, std::min(1000 - lowest - 60, 1023));
      factors.emplace_back(x, y);
      if (random.below(3) == 0) factors.emplace_back(-y, x);
    }
    for (const auto& [x, y] : factors) sum = sum + exact_product(x, y);
    ExactSum products, again;
    for (const auto& [x, y] : factors) products.add_product(x, y);
    random.shuffle(factors);
    for (const auto& [x, y] : factors) again.add_product(y, x);
    expect_nearest(products.value(), sum);
    pnpbs::ExactProducts gathered;
    for (const auto& [x, y] : factors) gathered.add(x, y);
    ExactSum of_all;
    gathered.add_to(of_all);
    quick_assert(same_bits(products.value(), of_all.value()));
    quick_assert(same_bits(products.value(), again.value()));
  }
}
END_TEST

START_TEST(parts_of_threads_and_ranks) {
  Random random(3);
  std::vector<double> terms;
  for (int n = 0; n < 500; ++n) terms.push_back(some_double(random, -300, 300));
  const double whole = sum_of(terms);
  for (int parts = 1; parts < 20; ++parts) {
    std::vector<ExactSum> sums(static_cast<std::size_t>(parts));
    for (const double term : terms) sums[static_cast<std::size_t>(random.below(parts))].add(term);
    ExactSum by_threads, by_ranks;
    for (ExactSum& sum : sums) {
      by_threads.add(sum);
      sum.carry();
      for (std::size_t k = 0; k < sum.entries().size(); ++k)
        by_ranks.entries()[k] += sum.entries()[k];
    }
    ck_assert(same_bits(by_threads.value(), whole));
    ck_assert(same_bits(by_ranks.value(), whole));
  }
}
END_TEST

// Adds the largest fractions as often as allowed, and values that are not finite.
START_TEST(many_products) {
  pnpbs::ExactProducts gathered;
  for (std::int64_t k = 0; k < pnpbs::ExactProducts::kMaxTerms; ++k) gathered.add(DBL_MAX, -1.75);
  ExactSum sum;
  sum.add_product(DBL_MAX, 1.75 * static_cast<double>(pnpbs::ExactProducts::kMaxTerms));
  sum.add(3.5);
  gathered.add_to(sum);
  ck_assert(sum.value() == 3.5);
  gathered.add(2, kInf);
  gathered.add_to(sum);
  ck_assert(sum.value() == kInf);
  gathered.add(0, kInf);
  gathered.add_to(sum);
  ck_assert(std::isnan(sum.value()));
}
END_TEST

// Doubles a sum 60 times, beyond any possible number of terms: digits never overflow.
START_TEST(very_many_terms) {
  for (const double term : {DBL_MAX, -DBL_MAX, DBL_TRUE_MIN, -DBL_TRUE_MIN, 1 / 3.0}) {
    ExactSum sum;
    sum.add(term);
    for (int k = 0; k < 60; ++k) sum.add(ExactSum(sum));
    ck_assert(same_bits(sum.value(), std::ldexp(term, 60)));
    sum.add(term);
    for (int k = 0; k < 60; ++k) sum.add_product(term, -std::ldexp(1, k));
    ck_assert(same_bits(sum.value(), 2 * term));
  }
}
END_TEST

START_TEST(what_is_not_finite) {
  ck_assert(same_bits(sum_of({}), 0));
  ck_assert(same_bits(sum_of({-0.0, -0.0}), 0));
  ck_assert(same_bits(sum_of({1e300, 1, -1e300, -1}), 0));
  ck_assert(sum_of({1, 1e100, 1, -1e100}) == 2);
  ck_assert(sum_of({DBL_MAX, DBL_MAX, -DBL_MAX}) == DBL_MAX);
  ck_assert(sum_of({DBL_MAX, DBL_MAX}) == kInf && sum_of({-DBL_MAX, -DBL_MAX}) == -kInf);
  // Half a unit in the last place above DBL_MAX is a tie with infinity, whose last bit counts as
  // even.
  ck_assert(sum_of({DBL_MAX, 0x1p970}) == kInf);
  ck_assert(sum_of({DBL_MAX, 0x1p970, -DBL_TRUE_MIN}) == DBL_MAX);
  ck_assert(sum_of({kInf, -DBL_MAX, -DBL_MAX}) == kInf && sum_of({1, -kInf}) == -kInf);
  ck_assert(std::isnan(sum_of({kInf, 1, -kInf})) && std::isnan(sum_of({kInf, kNaN, kInf})));
  const auto product = [](double x, double y) {
    ExactSum sum;
    sum.add_product(x, y);
    return sum.value();
  };
  ck_assert(product(DBL_MAX, -2) == -kInf && product(-kInf, -2) == kInf);
  ck_assert(std::isnan(product(kInf, 0)) && std::isnan(product(kNaN, kInf)));
  ck_assert(same_bits(product(-DBL_TRUE_MIN, DBL_TRUE_MIN), -0.0));
  ck_assert(same_bits(product(DBL_TRUE_MIN, 0.5), 0) && product(DBL_TRUE_MIN, 0.75) > 0);
}
END_TEST

TEST_SUITE(test_exact_sum) {
  return run_suite("exact sums",
                   {nearest_to_the_sum, nearest_to_the_sum_of_products, parts_of_threads_and_ranks,
                    many_products, very_many_terms, what_is_not_finite});
}
