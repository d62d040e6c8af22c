// SPDX-License-Identifier: BSD-3-Clause
// Inner nodes keep 0.4 d off the boundary.
#pragma once

#include <span>

#include "domain/domain_map.hpp"

namespace pnpbs {

inline constexpr double kBoundaryClearance = 0.4;  // in units of d
// With less than this there is no room: a wedge or gap narrower than 0.7 d.
inline constexpr double kLeastClearance = 0.35;

struct ClearPosition {
  Point<2> position;
  bool clear;  // false: the node should go at the next population event
};

// Where a node that wants to move from `from` to `to` may go: pushed off the edges (all that can
// be met on the way, in the order of their indices) to the clearance, never across one.
ClearPosition clear_position(const DomainMap& map, std::span<const std::int32_t> edges,
                             const Point<2>& from, const Point<2>& to, double d);

}  // namespace pnpbs
