// SPDX-License-Identifier: BSD-3-Clause
// Where the spacing grows fastest: bubbles that touch must not differ too much in size.
#pragma once

#include <functional>
#include <vector>

#include "comm/communicator.hpp"
#include "spacing/sized_tree.hpp"
#include "spacing/spacing.hpp"
#include "sphere/embedding.hpp"

namespace pnpbs {

template <int Dim>
struct SteepestGrowth {
  double growth = 0;  // of d, per unit of length
  Point<Dim> at{};    // the finest of the places where it is at least half of that
};

// By samples in the middle and on the sides of the leaves that this rank owns, and at the boundary
// nodes in them: of each pair with one inside the domain and no boundary between. The same on any
// number of ranks. Lengths are those that users measure. Collective.
template <int Dim>
SteepestGrowth<Dim> steepest_growth(const Communicator& comm, const SizedTree<Dim>& map,
                                    const std::function<bool(std::int32_t)>& owns_leaf,
                                    const SpacingEvaluator<Dim>& spacing,
                                    const SpacingHints<Dim>& known = {},
                                    const Embedding<Dim>& embedding = {});

}  // namespace pnpbs
