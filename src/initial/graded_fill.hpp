// SPDX-License-Identifier: BSD-3-Clause
// Places initial inner nodes where d grows too fast for a lattice. Leaves of the background tree
// are divided into cells about as wide as d. The number of nodes that d requires is summed over the
// cells in Morton order, and a node is placed where the sum passes an integer. The density is then
// right cell by cell, which population control would need long to correct; distances settle in a
// few steps.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "spacing/sized_tree.hpp"

namespace pnpbs {

// A fill of the leaves in which d varies too much for a lattice.
template <int Dim>
class GradedFill {
 public:
  // Divides those leaves that lattice_fill() omits and for which wanted(leaf) is true.
  GradedFill(const SizedTree<Dim>& map, const std::function<bool(std::int32_t)>& wanted);

  // Returns the centres of the cells in the domain. The caller evaluates d there.
  const std::vector<Point<Dim>>& centres() const { return centres_; }
  // Returns the number of nodes wanted in each leaf of the tree, in units of 2^-32, so that sums do
  // not depend on their order. `d` has the values at centres().
  std::vector<std::int64_t> wanted_nodes(const std::vector<double>& d) const;
  // Returns the nodes. `before` has for each leaf the sum of wanted nodes over all leaves before
  // it, over all ranks.
  std::vector<Point<Dim>> place(const std::vector<double>& d,
                                const std::vector<std::int64_t>& before) const;

 private:
  struct Leaf {
    std::int32_t leaf;
    double cell_side;
    std::size_t first, end;  // range of its cells in centres_
  };

  const SizedTree<Dim>& map_;
  std::vector<Leaf> leaves_;
  std::vector<Point<Dim>> centres_;
};

extern template class GradedFill<2>;
extern template class GradedFill<3>;

}  // namespace pnpbs
