// SPDX-License-Identifier: BSD-3-Clause
// Inner nodes keep off the boundary.
#pragma once

#include <span>
#include <type_traits>

#include "geometry/facet_index.hpp"

namespace pnpbs {

template <int Dim>
struct ClearPosition {
  Point<Dim> position;
  bool clear;  // false: the node should go at the next population event
};

// Where a node that wants to move from `from` to `to` may go: pushed off the facets (all that can
// be met on the way, in the order of their indices) to the clearance, never across one.
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
