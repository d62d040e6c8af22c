// SPDX-License-Identifier: BSD-3-Clause
// Finds the stars of a block of nodes at the same time, one node per SIMD lane. It covers the stars
// that plain floating point can prove. The others are left to hull_star, and the results of both
// are identical where both succeed.
#pragma once

#include <cstdint>

#include "neighbors/adjacency_list.hpp"

namespace pnpbs {

inline constexpr int kMaxListed = 16;  // Longest list that is handled here.

// Approximate minimum of the sine of the angle between consecutive neighbours. The cross product,
// in which rounding loses 2^-51 of the terms, then has a relative error of 1e-10.
inline constexpr double kMinTurn = 1e-5;
// Minimum turn of three inverted points. [terms of the determinant] Rounding loses less than 2^-49
// of them.
inline constexpr double kMinBend = 1e-13;

struct BlockHullStars {
  bool found[kLanes];
  std::int32_t size[kLanes];  // Valid if found.
  // Counter-clockwise from the nearest neighbour; of several, from the one with the smallest id.
  std::int32_t node[kMaxListed][kLanes];
};

// Finds stars. `x` and `y` are the positions of all nodes. The entry `pad` of a list is not a node.
// `reach` is the distance within which the list of each node is complete, or 0 for a lane to skip.
void find_block_hull_stars(const ListBlock& list, std::int32_t pad, const double* x,
                           const double* y, const std::int64_t (&self)[kLanes],
                           const double (&reach)[kLanes], BlockHullStars& stars);

}  // namespace pnpbs
