// SPDX-License-Identifier: BSD-3-Clause
// The stars of a block of nodes at once, one node per SIMD lane, as far as plain floating point can
// prove them; the rest is left to hull_star, which gives the same stars where both give one.
#pragma once

#include <cstdint>

#include "neighbors/adjacency_list.hpp"

namespace pnpbs {

inline constexpr int kMaxListed = 16;  // longer lists are left to hull_star

// Least sine, about, of the angle between two neighbours next to each other: their cross product,
// in which rounding loses 2^-51 of the terms, is then right to 1e-10.
inline constexpr double kMinTurn = 1e-5;
// Least turn of three inverted points, relative to the terms of the determinant. Rounding loses
// less than 2^-49 of them.
inline constexpr double kMinBend = 1e-13;

struct BlockHullStars {
  bool found[kLanes];
  std::int32_t size[kLanes];  // of those found
  // Counter-clockwise from the nearest neighbour (of several, the one with the smallest id).
  std::int32_t node[kMaxListed][kLanes];
};

// x, y: positions of all nodes; entry `pad` of a list is none. `reach` is how far from each node
// its list is complete, or 0 for a lane to leave out.
void find_block_hull_stars(const ListBlock& list, std::int32_t pad, const double* x,
                           const double* y, const std::int64_t (&self)[kLanes],
                           const double (&reach)[kLanes], BlockHullStars& stars);

}  // namespace pnpbs
