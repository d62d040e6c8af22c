// SPDX-License-Identifier: BSD-3-Clause
// Measures the fastest growth of the spacing, because touching bubbles must not differ too much in
// size.
#pragma once

#include <functional>
#include <vector>

#include "comm/communicator.hpp"
#include "spacing/sized_tree.hpp"
#include "spacing/spacing.hpp"
#include "sphere/embedding.hpp"

namespace pnpbs {

template <int Dim>
// The largest growth of d and a point where d grows fast.
struct SteepestGrowth {
  double growth = 0;  // [d per unit of length]
  Point<Dim> at{};    // the point with the smallest d among those with at least half of that growth
};

// Measures the growth of d between samples: the centre and the face centres of each leaf that this
// rank owns, and the boundary nodes in it. Pairs count if one of them lies inside and no boundary
// is between them. The slopes of `known` count as well. Lengths are those that users measure. The
// result is the same on any number of ranks.
// Collective.
template <int Dim>
SteepestGrowth<Dim> steepest_growth(const Communicator& comm, const SizedTree<Dim>& map,
                                    const std::function<bool(std::int32_t)>& owns_leaf,
                                    const SpacingEvaluator<Dim>& spacing,
                                    const SpacingHints<Dim>& known = {},
                                    const Embedding<Dim>& embedding = {});

}  // namespace pnpbs
