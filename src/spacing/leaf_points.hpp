// SPDX-License-Identifier: BSD-3-Clause
// The points of a leaf at which d is sampled: a pattern in its cell, nodes of the boundary and
// given places in it, and others where these do not suffice.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "spacing/growth_leaf.hpp"
#include "spacing/line_of_sight.hpp"
#include "tree/leaf_cells.hpp"

namespace pnpbs {

template <int Dim>
class LeafPoints {
 public:
  LeafPoints(const LineOfSight<Dim>& ways, std::vector<Point<Dim>> places);

  void add_places(const std::vector<Point<Dim>>& places);

  double side_of(const LeafCell<Dim>& cell) const;
  Box<Dim> box_of(const LeafCell<Dim>& cell) const;
  FineIndex<Dim> fine_index(const Point<Dim>& x) const { return root_.fine_index(x); }

  // visit(n) for the nodes of the boundary in a cell, then, from their number on, the places.
  template <class Visit>
  void for_nodes_in(const LeafCell<Dim>& cell, const Visit& visit) const;
  std::size_t samples_inside(const LeafCell<Dim>& cell) const;

  // The points inside at which d is sampled, then the boundary nodes and places.
  void add_points(const GrowthLeaf<Dim>& leaf, std::vector<Point<Dim>>& points) const;
  // For a leaf with few samples inside: all that add_points() adds, and points of the boundary.
  void add_points_in_sliver(const GrowthLeaf<Dim>& leaf, std::vector<Point<Dim>>& points) const;
  // The middles of the leaves beside it, if they were as large, as far as they are inside.
  void add_points_beside(const GrowthLeaf<Dim>& leaf, std::vector<Point<Dim>>& points) const;
  // As many as the nodes that the least d of the leaf asks for, far from any pattern.
  void add_probes(const GrowthLeaf<Dim>& leaf, std::vector<Point<Dim>>& points) const;

 private:
  void sort_nodes();
  const Point<Dim>& node(std::int64_t n) const;

  const LineOfSight<Dim>& ways_;
  std::vector<Point<Dim>> places_;
  BackgroundTree<Dim> root_;         // one cell, for its arithmetic
  std::vector<std::int64_t> nodes_;  // of the boundary, then the places, in Morton order
  std::vector<FineIndex<Dim>> fine_of_nodes_;
};

template <int Dim>
template <class Visit>
void LeafPoints<Dim>::for_nodes_in(const LeafCell<Dim>& cell, const Visit& visit) const {
  auto node = std::lower_bound(fine_of_nodes_.begin(), fine_of_nodes_.end(), cell.first(),
                               morton_before<static_cast<std::size_t>(Dim)>);
  for (; node != fine_of_nodes_.end() && cell.holds(*node); ++node)
    visit(nodes_[static_cast<std::size_t>(node - fine_of_nodes_.begin())]);
}

extern template class LeafPoints<2>;
extern template class LeafPoints<3>;

}  // namespace pnpbs
