// SPDX-License-Identifier: BSD-3-Clause
// The resultant forces on the bubbles of a block: sums over their adjacency lists.
#pragma once

#include <array>
#include <cmath>

#include "base/nodes.hpp"
#include "neighbors/adjacency_list.hpp"

namespace pnpbs {

// A vector for each lane of a block.
template <int Dim>
using BlockVector = std::array<std::array<double, kLanes>, Dim>;

// Positions as plain pointers, from which the compiler can infer that the arrays do not alias.
template <int Dim>
using Positions = std::array<const double*, Dim>;

template <int Dim>
Positions<Dim> positions_of(const Field<Dim>& x) {
  Positions<Dim> p;
  for (int k = 0; k < Dim; ++k) p[k] = x[k].data();
  return p;
}

// Computes the forces on the nodes self[0 .. kLanes-1] of a block. Lanes beyond the last node read
// the padding node, and their forces are not used. Each lane adds its neighbours in the order of
// the list.
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
      double square = 1e-200;  // coincident nodes exert no force; avoids 0/0
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

// Writes the node indices of block b to `self`. Lanes beyond the last node get the index of the
// padding node.
inline void block_nodes(std::int64_t b, std::int64_t count, std::int64_t (&self)[kLanes]) {
  for (int lane = 0; lane < kLanes; ++lane) {
    const std::int64_t i = b * kLanes + lane;
    self[lane] = i < count ? i : count;
  }
}

}  // namespace pnpbs
