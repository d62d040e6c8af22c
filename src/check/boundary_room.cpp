// SPDX-License-Identifier: BSD-3-Clause
#include "check/boundary_room.hpp"

#include <algorithm>
#include <cmath>

#include "base/lattice.hpp"

namespace pnpbs {

namespace {

// Sum of the pushes of boundary edges above which a point of the plane is in the region. Fitted
// (see kPlaneReach).
constexpr double kEnough = 1.27;

}  // namespace

template <int Dim>
BoundaryRoom<Dim>::BoundaryRoom(const SizedTree<Dim>& map, const SpacingEvaluator<Dim>& spacing,
                                double reach)
    : map_(map), reach_(reach) {
  std::vector<Box<Dim>> boxes;
  for (std::size_t f = 0; f < map.boundary().facets.size(); ++f) {
    const FacetCorners<Dim>& corners = map.corners(static_cast<std::int32_t>(f));
    boxes.push_back({corners[0], corners[0]});
    for (const Point<Dim>& corner : corners)
      boxes.back() = joined(boxes.back(), Box<Dim>{corner, corner});
  }
  boxes_ = BoxTree<Dim>(std::move(boxes));
  if (Dim == 3) return;
  std::vector<Point<Dim>> nodes;
  for (const BoundaryNode<Dim>& node : map.boundary().nodes) nodes.push_back(node.position);
  d_.resize(nodes.size());
  spacing(std::ssize(d_), nodes.data(), d_.data());
}

template <int Dim>
bool BoundaryRoom<Dim>::any_nearer(const Point<Dim>& x, double reach) const {
  double limit = reach * reach;
  boxes_.for_near(
      x, [&] { return limit; },
      [&](std::int32_t f) {
        if (distance<Dim>(nearest_on(map_.corners(f), x), x) < reach) limit = -1;
      });
  return limit < 0;
}

// Returns the push of an edge: the mean depth, in mean d, by which its ends are within reach of x.
// It is 0 if the side of the edge that faces x is outside the domain, since its nodes are not
// visible from x then.
template <>
double BoundaryRoom<2>::push_of(std::int32_t f, const Point<2>& x, double d) const {
  constexpr double kPoint = 1.53;  // gives an isolated node the area of any other, 1 / density
  const BoundaryEdge& edge = map_.facet(f);
  const auto& [a, b] = map_.corners(f);
  const auto from = [&](std::int32_t node, const Point<2>& at) {
    const double mean = 0.5 * (d + d_[static_cast<std::size_t>(node)]);
    return std::max(0.0, reach_ - distance<2>(at, x) / mean);
  };
  if (edge.begin == edge.end) return kPoint * from(edge.begin, a);
  const double left = (b[0] - a[0]) * (x[1] - a[1]) - (b[1] - a[1]) * (x[0] - a[0]);
  if (left > 0 ? !edge.left_inside : !edge.right_inside) return 0;
  return 0.5 * (from(edge.begin, a) + from(edge.end, b));
}

template <int Dim>
bool BoundaryRoom<Dim>::holds(const Point<Dim>& x, double d) const {
  if constexpr (Dim == 3) {
    return any_nearer(x, reach_ * d);
  } else {
    double sum = 0, limit = power<2>(reach_ * d);
    boxes_.for_near(
        x, [&] { return limit; },
        [&](std::int32_t f) {
          sum += push_of(f, x, d);
          if (sum >= kEnough) limit = -1;
        });
    return sum >= kEnough;
  }
}

template class BoundaryRoom<2>;
template class BoundaryRoom<3>;

}  // namespace pnpbs
