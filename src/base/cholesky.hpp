// SPDX-License-Identifier: BSD-3-Clause
// Small systems with a symmetric, positive definite matrix, by Cholesky's factor. Only the lower
// triangle of the matrix is read, and its factor replaces it.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace pnpbs {

template <std::size_t N>
using SquareMatrix = std::array<std::array<double, N>, N>;

// Multiplies a[i][j] by scale[i] scale[j], which make the diagonal 1. False, with the matrix as it
// was, where the diagonal is not positive.
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

// False where, without what the columns before have of it, no more than `singular` is left on the
// diagonal of a column.
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

// Solves for the N numbers of a right side, in place of them.
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
