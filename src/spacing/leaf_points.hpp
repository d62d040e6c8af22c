// SPDX-License-Identifier: BSD-3-Clause
// The points at which d is sampled in a leaf of a growth tree: the cell_samples of its cell,
// boundary nodes and given points in it, and more points where these do not suffice.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "spacing/growth_leaf.hpp"
#include "spacing/line_of_sight.hpp"
#include "tree/leaf_cells.hpp"

namespace pnpbs {

// Computes the sample points of leaves, which may belong to any rank.
template <int Dim>
class LeafPoints {
 public:
  // `places` are additional sample points. `ways` must outlive this object.
  LeafPoints(const LineOfSight<Dim>& ways, std::vector<Point<Dim>> places);

  // Adds sample points.
  void add_places(const std::vector<Point<Dim>>& places);

  double side_of(const LeafCell<Dim>& cell) const;
  Box<Dim> box_of(const LeafCell<Dim>& cell) const;
  FineIndex<Dim> fine_index(const Point<Dim>& x) const { return root_.fine_index(x); }

  // Calls visit(n) for the boundary nodes in a cell, and then for the given points, whose numbers
  // follow those of the boundary nodes.
  template <class Visit>
  void for_nodes_in(const LeafCell<Dim>& cell, const Visit& visit) const;
  // Returns the number of cell_samples of the cell that lie in the domain.
  std::size_t samples_inside(const LeafCell<Dim>& cell) const;

  // Appends the cell_samples in the domain, the boundary nodes and the given points of the leaf.
  void add_points(const GrowthLeaf<Dim>& leaf, std::vector<Point<Dim>>& points) const;
  // Appends the points of add_points() and points of the boundary, for a leaf with few cell_samples
  // in the domain.
  void add_points_in_sliver(const GrowthLeaf<Dim>& leaf, std::vector<Point<Dim>>& points) const;
  // Appends the centres of the adjacent cells of the same size that lie in the domain.
  void add_points_beside(const GrowthLeaf<Dim>& leaf, std::vector<Point<Dim>>& points) const;
  // Appends as many points as nodes of the leaf's smallest d, in a quasi-random sequence.
  void add_probes(const GrowthLeaf<Dim>& leaf, std::vector<Point<Dim>>& points) const;

 private:
  void sort_nodes();
  const Point<Dim>& node(std::int64_t n) const;

  const LineOfSight<Dim>& ways_;
  std::vector<Point<Dim>> places_;
  BackgroundTree<Dim> root_;         // a tree of one cell, used for its index arithmetic
  std::vector<std::int64_t> nodes_;  // numbers of boundary nodes and given points, in Morton order
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
