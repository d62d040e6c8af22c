// SPDX-License-Identifier: BSD-3-Clause
// The region near the boundary that the bubbles of boundary nodes keep free of inner nodes.
#pragma once

#include <vector>

#include "domain/domain.hpp"
#include "spacing/sized_tree.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

// The region in which no inner node comes to rest. It reaches about d/2 from the boundary where
// boundary nodes are d apart, and farther where they are closer in the plane, as vertices of the
// input may be.
template <int Dim>
class BoundaryRoom {
 public:
  // `map` must outlive this object. In the plane, d is evaluated at the boundary nodes. In space,
  // `reach` is the depth of the region. In the plane, it is the distance up to which a boundary
  // node has an effect (kPlaneReach). [d]
  BoundaryRoom(const SizedTree<Dim>& map, const SpacingEvaluator<Dim>& spacing, double reach);

  // Returns true if the region contains the point x of the domain, where the spacing is d.
  bool holds(const Point<Dim>& x, double d) const;
  // Returns true if a facet is closer to x than `reach`.
  bool any_nearer(const Point<Dim>& x, double reach) const;

  double reach() const { return reach_; }

  // Range of boundary nodes in the plane, in d. It is fitted together with kEnough to the inner
  // nodes of runs with 160 to 160 000 nodes in a square, a ring and lakes, with constant d and d
  // graded 1:30, and boundary edges between d and d/10. tests/bench/node_count_study.py measures
  // the error of the resulting numbers of nodes.
  static constexpr double kPlaneReach = 1.35;

 private:
  double push_of(std::int32_t f, const Point<Dim>& x, double d) const;  // only in the plane

  const SizedTree<Dim>& map_;
  BoxTree<Dim> boxes_;     // boxes of the facets
  std::vector<double> d_;  // spacing at the boundary nodes
  double reach_;
};

template <>
double BoundaryRoom<2>::push_of(std::int32_t f, const Point<2>& x, double d) const;

extern template class BoundaryRoom<2>;
extern template class BoundaryRoom<3>;

}  // namespace pnpbs
