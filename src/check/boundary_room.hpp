// SPDX-License-Identifier: BSD-3-Clause
// The room that the nodes of the boundary take inside.
#pragma once

#include <vector>

#include "domain/domain.hpp"
#include "spacing/sized_tree.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

// No inner node comes to rest there. Where the boundary's nodes are d apart they keep others off
// for about half of d; where they are closer in the plane, as vertices of the input are, for more.
template <int Dim>
class BoundaryRoom {
 public:
  // The map stays the caller's. d is asked at the boundary's nodes in the plane. In space the room
  // reaches so far, in d.
  BoundaryRoom(const SizedTree<Dim>& map, const SpacingEvaluator<Dim>& spacing, double reach);

  // Does it hold x, which is inside, where the spacing is d?
  bool holds(const Point<Dim>& x, double d) const;
  // Is any facet that near to x?
  bool any_nearer(const Point<Dim>& x, double reach) const;

  double reach() const { return reach_; }

  // In the plane: how far nodes of the boundary act, in d. Fitted, like kEnough, to the inner nodes
  // of runs with 160 to 160 000 nodes in square, ring and lakes, d even and graded 1:30, edges of
  // the boundary from d down to a tenth of it. tests/bench/node_count_study.py tells how near
  // numbers of nodes come with it.
  static constexpr double kPlaneReach = 1.35;

 private:
  double push_of(std::int32_t f, const Point<Dim>& x, double d) const;  // in the plane alone

  const SizedTree<Dim>& map_;
  BoxTree<Dim> boxes_;     // of the facets
  std::vector<double> d_;  // at the boundary's nodes
  double reach_;
};

template <>
double BoundaryRoom<2>::push_of(std::int32_t f, const Point<2>& x, double d) const;

extern template class BoundaryRoom<2>;
extern template class BoundaryRoom<3>;

}  // namespace pnpbs
