// SPDX-License-Identifier: BSD-3-Clause
// Solves small systems with a symmetric, positive definite matrix by Cholesky factorization. Only
// the lower triangle of the matrix is read, and the factor overwrites it.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace pnpbs {

// An N x N matrix, stored by rows.
template <std::size_t N>
using SquareMatrix = std::array<std::array<double, N>, N>;

// Scales the matrix to a unit diagonal: a[i][j] becomes a[i][j] scale[i] scale[j]. Returns false
// and leaves the matrix unchanged if an entry of the diagonal is not positive.
template <std::size_t N>
bool scale_to_unit_diagonal(SquareMatrix<N>& a, std::array<double, N>& scale) {
  for (std::size_t i = 0; i < N; ++i) {
    if (!(a[i][i] > 0)) return false;
    scale[i] = 1 / std::sqrt(a[i][i]);
  }
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t j = 0; j <= i; ++j) a[i][j] = a[i][j] * scale[i] * scale[j];
  return true;
}

// Replaces the lower triangle by the Cholesky factor. Returns false if a pivot is at most
// `singular`; the matrix is then partly overwritten.
template <std::size_t N>
bool factor_cholesky(SquareMatrix<N>& a, double singular = 0) {
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = a[i][j];
      for (std::size_t k = 0; k < j; ++k) sum -= a[i][k] * a[j][k];
      if (i == j && !(sum > singular)) return false;
      a[i][j] = i == j ? std::sqrt(sum) : sum / a[j][j];
    }
  return true;
}

// Solves factor factor^T x = b. `b` has N entries, and the solution overwrites it.
template <std::size_t N>
void solve_factored(const SquareMatrix<N>& factor, double* b) {
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t k = 0; k < i; ++k) b[i] -= factor[i][k] * b[k];
    b[i] /= factor[i][i];
  }
  for (std::size_t i = N; i-- > 0;) {
    for (std::size_t k = i + 1; k < N; ++k) b[i] -= factor[k][i] * b[k];
    b[i] /= factor[i][i];
  }
}

}  // namespace pnpbs
