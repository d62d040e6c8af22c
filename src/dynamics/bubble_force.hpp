// SPDX-License-Identifier: BSD-3-Clause
// The resultant force on the bubbles of a block: the sum over their adjacency lists.
#pragma once

#include <array>
#include <cmath>

#include "base/nodes.hpp"
#include "neighbors/adjacency_list.hpp"

namespace pnpbs {

template <int Dim>
using BlockVector = std::array<std::array<double, kLanes>, Dim>;

// Positions as plain pointers, so that the compiler sees that nothing aliases.
template <int Dim>
using Positions = std::array<const double*, Dim>;

template <int Dim>
Positions<Dim> positions_of(const Field<Dim>& x) {
  Positions<Dim> p;
  for (int k = 0; k < Dim; ++k) p[k] = x[k].data();
  return p;
}

// Force on nodes first .. first + kLanes - 1 (those beyond the last node read the padding and are
// not used). Each lane adds its neighbours in the order of the list.
template <int Dim, class Law>
inline void block_force(const ListBlock& list, const Law& law, const Positions<Dim>& x,
                        const double* d, const std::int64_t (&self)[kLanes],
                        BlockVector<Dim>& force) {
  std::array<double, kLanes> own_d;
  BlockVector<Dim> own, sum{};
  for (int lane = 0; lane < kLanes; ++lane) {
    own_d[lane] = d[self[lane]];
    for (int k = 0; k < Dim; ++k) own[k][lane] = x[k][self[lane]];
  }
  const std::int32_t* entries = list.entries;
  for (std::int32_t n = 0; n < list.length; ++n, entries += kLanes) {
#pragma omp simd
    for (int lane = 0; lane < kLanes; ++lane) {
      const std::int32_t j = entries[lane];
      double gap[Dim];
      double square = 1e-200;  // two nodes in one place push nowhere, instead of 0/0
      for (int k = 0; k < Dim; ++k) {
        gap[k] = own[k][lane] - x[k][j];
        square += gap[k] * gap[k];
      }
      const double distance = std::sqrt(square);
      const double desired = 0.5 * (own_d[lane] + d[j]);
      const double push = law.template per_length<Dim>(distance, desired);
      for (int k = 0; k < Dim; ++k) sum[k][lane] += push * gap[k];
    }
  }
  force = sum;
}

// The nodes of block b; lanes beyond the last node stand for the far-away one.
inline void block_nodes(std::int64_t b, std::int64_t count, std::int64_t (&self)[kLanes]) {
  for (int lane = 0; lane < kLanes; ++lane) {
    const std::int64_t i = b * kLanes + lane;
    self[lane] = i < count ? i : count;
  }
}

}  // namespace pnpbs
