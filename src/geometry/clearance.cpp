// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/clearance.hpp"

#include <algorithm>
#include <limits>

#include "geometry/plane/edges.hpp"
#include "geometry/volume/triangles.hpp"
#include "method/constants.hpp"

namespace pnpbs {

namespace {

template <int Dim>
double nearest_facet(const FacetIndex<Dim>& index, std::span<const std::int32_t> facets,
                     const Point<Dim>& x, Point<Dim>& nearest) {
  double min = std::numeric_limits<double>::infinity();
  for (const std::int32_t f : facets) {
    const Point<Dim> q = nearest_on(index.corners(f), x);
    const double gap = distance<Dim>(q, x);
    if (gap < min) {
      min = gap;
      nearest = q;
    }
  }
  return min;
}

template <int Dim>
bool may_touch_any(const FacetIndex<Dim>& index, std::span<const std::int32_t> facets,
                   const Point<Dim>& from, const Point<Dim>& to) {
  return std::any_of(facets.begin(), facets.end(),
                     [&](std::int32_t f) { return may_touch(from, to, index.corners(f)); });
}

// Returns whether every facet is farther from `to` than `wanted` and than the length of the move,
// so that the move cannot meet it.
template <int Dim>
bool clear_of_all(const FacetIndex<Dim>& index, std::span<const std::int32_t> facets,
                  const Point<Dim>& from, const Point<Dim>& to, double wanted) {
  constexpr double kRounding = 1 + 1e-9;
  const double square = kRounding * std::max(wanted * wanted, squared_distance<Dim>(to, from));
  return std::none_of(facets.begin(), facets.end(), [&](std::int32_t f) {
    return squared_distance<Dim>(to, nearest_on(index.corners(f), to)) < square;
  });
}

}  // namespace

template <int Dim>
ClearPosition<Dim> clear_position(const FacetIndex<Dim>& index,
                                  std::span<const std::int32_t> facets,
                                  const std::type_identity_t<Point<Dim>>& from,
                                  const std::type_identity_t<Point<Dim>>& to, double d) {
  const double wanted = method::kBoundaryClearance * d;
  if (clear_of_all<Dim>(index, facets, from, to, wanted)) return {to, true};  // Nearly always.
  Point<Dim> x = may_touch_any<Dim>(index, facets, from, to) ? from : to;
  Point<Dim> wall{};
  double gap = nearest_facet<Dim>(index, facets, x, wall);
  // A corner has up to Dim facets, each of which takes one push. One more push is needed because
  // one facet can push the node back towards another.
  for (int round = 0; round < Dim + 1 && gap < wanted && gap > 0; ++round) {
    const double stretch = wanted / gap;
    Point<Dim> away;
    for (std::size_t k = 0; k < Dim; ++k) away[k] = wall[k] + (x[k] - wall[k]) * stretch;
    if (may_touch_any<Dim>(index, facets, x, away)) break;
    x = away;
    gap = nearest_facet<Dim>(index, facets, x, wall);
  }
  return {x, gap >= method::kMinClearance * d};
}

template ClearPosition<2> clear_position(const FacetIndex<2>&, std::span<const std::int32_t>,
                                         const Point<2>&, const Point<2>&, double);
template ClearPosition<3> clear_position(const FacetIndex<3>&, std::span<const std::int32_t>,
                                         const Point<3>&, const Point<3>&, double);

}  // namespace pnpbs
