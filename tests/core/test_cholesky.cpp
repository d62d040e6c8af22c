// SPDX-License-Identifier: BSD-3-Clause
// Solutions by Cholesky factorisation against known solutions and Gaussian elimination; singular
// and indefinite matrices.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/cholesky.hpp"
#include "geometry/run_suite.hpp"
#include "quick_assert.hpp"
#include "random.hpp"

namespace {

using pnpbs::SquareMatrix;

template <std::size_t N>
using Numbers = std::array<double, N>;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

template <std::size_t N>
Numbers<N> times(const SquareMatrix<N>& a, const Numbers<N>& x) {
  Numbers<N> b{};
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t j = 0; j < N; ++j) b[i] += a[i][j] * x[j];
  return b;
}

// Fills the upper triangle with NaN, which no function may read.
template <std::size_t N>
void spoil_upper_triangle(SquareMatrix<N>& a) {
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t j = i + 1; j < N; ++j) a[i][j] = kNaN;
}

// Solves by elimination with pivoting, which makes no assumption about the matrix.
template <std::size_t N>
Numbers<N> eliminated(SquareMatrix<N> a, Numbers<N> b) {
  for (std::size_t k = 0; k < N; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k; i < N; ++i)
      if (std::fabs(a[i][k]) > std::fabs(a[pivot][k])) pivot = i;
    std::swap(a[k], a[pivot]);
    std::swap(b[k], b[pivot]);
    for (std::size_t i = k + 1; i < N; ++i) {
      const double factor = a[i][k] / a[k][k];
      for (std::size_t j = k; j < N; ++j) a[i][j] -= factor * a[k][j];
      b[i] -= factor * b[k];
    }
  }
  for (std::size_t k = N; k-- > 0;) {
    for (std::size_t j = k + 1; j < N; ++j) b[k] -= a[k][j] * b[j];
    b[k] /= a[k][k];
  }
  return b;
}

// Returns a lower triangular matrix of small integers times its transpose.
template <std::size_t N>
SquareMatrix<N> matrix_of_whole_factor(Random& random) {
  SquareMatrix<N> factor{}, a{};
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t j = 0; j < i; ++j) factor[i][j] = static_cast<double>(random.below(7) - 3);
    factor[i][i] = static_cast<double>(random.below(4) + 1);
  }
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t j = 0; j < N; ++j)
      for (std::size_t k = 0; k < N; ++k) a[i][j] += factor[i][k] * factor[j][k];
  return a;
}

// Returns a positive definite matrix with a dominant diagonal.
template <std::size_t N>
SquareMatrix<N> some_matrix(Random& random) {
  SquareMatrix<N> a;
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t j = 0; j < i; ++j) a[i][j] = a[j][i] = random.between(-1, 1);
    a[i][i] = static_cast<double>(N) + random.between(0, 1);
  }
  return a;
}

// Checks that integer systems are solved without rounding errors.
template <std::size_t N>
void check_whole_numbers() {
  Random random(N);
  for (int n = 0; n < 300; ++n) {
    SquareMatrix<N> a = matrix_of_whole_factor<N>(random);
    Numbers<N> x;
    for (double& each : x) each = static_cast<double>(random.below(21) - 10);
    Numbers<N> b = times(a, x);
    spoil_upper_triangle(a);
    quick_assert(pnpbs::factor_cholesky(a));
    pnpbs::solve_factored(a, b.data());
    quick_assert(b == x);
  }
}

// Checks systems in units from 1e-20 to 1e20.
template <std::size_t N>
void check_scaled() {
  Random random(10 + N);
  for (int n = 0; n < 300; ++n) {
    SquareMatrix<N> a = some_matrix<N>(random), wide = a;
    Numbers<N> b, units, scale;
    for (double& each : b) each = random.between(-1, 1);
    for (double& each : units) each = std::pow(10, random.between(-20, 20));
    const Numbers<N> expected = eliminated(a, b);
    for (std::size_t i = 0; i < N; ++i)
      for (std::size_t j = 0; j < N; ++j) wide[i][j] *= units[i] * units[j];
    spoil_upper_triangle(wide);
    quick_assert(pnpbs::scale_to_unit_diagonal(wide, scale));
    for (std::size_t i = 0; i < N; ++i) {
      quick_assert(std::fabs(wide[i][i] - 1) < 1e-15);
      b[i] *= units[i] * scale[i];
    }
    quick_assert(pnpbs::factor_cholesky(wide, 1e-7));
    pnpbs::solve_factored(wide, b.data());
    for (std::size_t i = 0; i < N; ++i)
      quick_assert(std::fabs(b[i] * scale[i] * units[i] - expected[i]) < 1e-14);
  }
}

}  // namespace

START_TEST(whole_numbers) {
  check_whole_numbers<1>();
  check_whole_numbers<2>();
  check_whole_numbers<3>();
  check_whole_numbers<5>();
  check_whole_numbers<9>();
}
END_TEST

START_TEST(rows_of_any_scale) {
  check_scaled<2>();
  check_scaled<3>();
  check_scaled<9>();
}
END_TEST

START_TEST(what_has_no_factor) {
  const auto refused = [](SquareMatrix<2> a, double singular) {
    return !pnpbs::factor_cholesky(a, singular);
  };
  ck_assert(refused({{{0, 0}, {0, 1}}}, 0) && refused({{{-1, 0}, {0, 1}}}, 0));
  ck_assert(refused({{{1, 1}, {1, 1}}}, 0) && refused({{{1, 2}, {2, 1}}}, 0));
  ck_assert(refused({{{1, 0}, {kNaN, 1}}}, 0));
  // 1e-6 or 1e-8 of the second column is linearly independent of the first.
  const double near = std::sqrt(1 - 1e-6), nearer = std::sqrt(1 - 1e-8);
  ck_assert(!refused({{{1, near}, {near, 1}}}, 1e-7) &&
            refused({{{1, nearer}, {nearer, 1}}}, 1e-7));
  ck_assert(!refused({{{1, nearer}, {nearer, 1}}}, 0));
  for (const double diagonal : {0.0, -1.0, kNaN}) {
    SquareMatrix<2> a{{{4, 0}, {1, diagonal}}};
    Numbers<2> scale;
    ck_assert(!pnpbs::scale_to_unit_diagonal(a, scale));
    ck_assert(a[0][0] == 4 && a[1][0] == 1);
  }
}
END_TEST

TEST_SUITE(test_cholesky) {
  return run_suite("Cholesky's factor", {whole_numbers, rows_of_any_scale, what_has_no_factor});
}
