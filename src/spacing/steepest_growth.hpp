// SPDX-License-Identifier: BSD-3-Clause
// Where the spacing grows fastest: bubbles that touch must not differ too much in size.
#pragma once

#include <functional>
#include <vector>

#include "comm/communicator.hpp"
#include "spacing/domain_map.hpp"
#include "spacing/spacing.hpp"

namespace pnpbs {

// Growth of d, per unit of length, that nodes follow. On a spacing graded from a line
// (docs/method.md) the worst triangle has a quality of 0.82 up to 0.3, 0.69 at 0.5 and 0.14 at 1.
inline constexpr double kGrowthFollowed = 0.3;

template <int Dim>
struct SteepestGrowth {
  double growth = 0;  // of d, per unit of length
  Point<Dim> at{};    // the finest of the places where it is at least half of that
};

// By samples in the middle and on the sides of the leaves that this rank owns, and at the boundary
// nodes in them: of each pair with one inside the domain and no boundary between. The same on any
// number of ranks. Collective.
template <int Dim>
SteepestGrowth<Dim> steepest_growth(const Communicator& comm, const DomainMap<Dim>& map,
                                    const std::function<bool(std::int32_t)>& owns_leaf,
                                    const SpacingEvaluator<Dim>& spacing,
                                    const KnownValues<Dim>& known = {});

}  // namespace pnpbs
