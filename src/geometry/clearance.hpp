// SPDX-License-Identifier: BSD-3-Clause
// Keeps inner nodes at a distance from the boundary.
#pragma once

#include <span>
#include <type_traits>

#include "geometry/facet_index.hpp"

namespace pnpbs {

template <int Dim>
struct ClearPosition {
  Point<Dim> position;
  bool clear;  // If false, the next population event deletes the node.
};

// Returns the position of a node that moves from `from` towards `to`. The node is pushed off the
// facets to the clearance and never crosses one. `facets` must contain all facets that the move can
// meet, in ascending order.
template <int Dim>
ClearPosition<Dim> clear_position(const FacetIndex<Dim>& index,
                                  std::span<const std::int32_t> facets,
                                  const std::type_identity_t<Point<Dim>>& from,
                                  const std::type_identity_t<Point<Dim>>& to, double d);

extern template ClearPosition<2> clear_position(const FacetIndex<2>&, std::span<const std::int32_t>,
                                                const Point<2>&, const Point<2>&, double);
extern template ClearPosition<3> clear_position(const FacetIndex<3>&, std::span<const std::int32_t>,
                                                const Point<3>&, const Point<3>&, double);

}  // namespace pnpbs
