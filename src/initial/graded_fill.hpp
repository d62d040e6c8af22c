// SPDX-License-Identifier: BSD-3-Clause
// Initial inner nodes where d grows so fast that no lattice fits: leaves of the background tree are
// cut into cells of about d, and along their Morton order a node comes wherever the sum of the
// nodes that d asks for passes a whole number. So the density is right from cell to cell, which the
// population control would take long to mend; the distances settle in a few steps.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "spacing/sized_tree.hpp"

namespace pnpbs {

template <int Dim>
class GradedFill {
 public:
  // Of the leaves that lattice_fill leaves out, as d varies too much in them, and for which
  // wanted(leaf) holds.
  GradedFill(const SizedTree<Dim>& map, const std::function<bool(std::int32_t)>& wanted);

  // The centres of the cells in the domain, and d there, which is asked by the caller.
  const std::vector<Point<Dim>>& centres() const { return centres_; }
  // Nodes wanted in each leaf of the tree, in units of 2^-32: sums of these that come out the same
  // in any order. Their sums over the leaves before a leaf are what `place` begins with.
  std::vector<std::int64_t> wanted_nodes(const std::vector<double>& d) const;
  std::vector<Point<Dim>> place(const std::vector<double>& d,
                                const std::vector<std::int64_t>& before) const;

 private:
  struct Leaf {
    std::int32_t leaf;
    double cell_side;
    std::size_t first, end;  // its cells
  };

  const SizedTree<Dim>& map_;
  std::vector<Leaf> leaves_;
  std::vector<Point<Dim>> centres_;
};

extern template class GradedFill<2>;
extern template class GradedFill<3>;

}  // namespace pnpbs
