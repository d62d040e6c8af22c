// SPDX-License-Identifier: BSD-3-Clause
// The region in which a rank has every node, owned or as a ghost. It consists of leaves of the
// background tree and of boxes whose nodes other ranks have sent.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "tree/background_tree.hpp"

namespace pnpbs {

// A known region. The default is the whole domain.
template <int Dim>
class KnownRegion {
 public:
  KnownRegion() = default;  // everywhere
  // Marks as known the leaves whose nodes this rank has, and the leaves outside the domain, which
  // have no nodes.
  KnownRegion(const BackgroundTree<Dim>& tree, std::vector<char> known_leaves);

  bool is_everywhere() const { return unknown_in_.empty(); }
  // Returns whether a leaf in this cell of the tree is unknown. Leaves that are covered by several
  // boxes together count as unknown.
  bool unknown_in(std::int32_t cell) const {
    return !is_everywhere() && unknown_in_[static_cast<std::size_t>(cell)] != 0;
  }
  // Adds a box in which all nodes are known. The leaves inside the box become known.
  void add(const BackgroundTree<Dim>& tree, const Box<Dim>& box) {
    boxes_.push_back(box);
    if (is_everywhere()) return;
    tree.for_leaves_in(box, [&](std::int32_t leaf) {
      const std::int32_t cell = tree.leaf_cell(leaf);
      if (contains(box, tree.cell_box(cell))) unknown_in_[static_cast<std::size_t>(cell)] = 0;
    });
  }

  // Calls visit(leaf) for each unknown leaf with meets(its cell). If meets() holds for a cell, it
  // must hold for all cells around it.
  template <class Meets, class Visit>
  void for_unknown_leaves(const BackgroundTree<Dim>& tree, const Meets& meets,
                          const Visit& visit) const {
    const auto look = [&](std::int32_t cell) { return unknown_in(cell) && meets(cell); };
    if (!is_everywhere()) tree.for_leaves_in(tree.cell_box(0), look, visit);
  }

  // Returns whether the whole box is known.
  bool covers(const BackgroundTree<Dim>& tree, const Box<Dim>& box) const {
    return covers(tree, box, [](std::int32_t) { return true; });
  }
  // Returns whether the part of the box is known that lies in cells with matters(cell).
  template <class Matters>
  bool covers(const BackgroundTree<Dim>& tree, const Box<Dim>& box, const Matters& matters) const {
    if (is_everywhere()) return true;
    if (std::any_of(boxes_.begin(), boxes_.end(),
                    [&](const Box<Dim>& known) { return contains(known, box); }))
      return true;
    bool all = true;
    const auto look = [&](std::int32_t cell) {
      return all && unknown_in_[static_cast<std::size_t>(cell)] != 0 && matters(cell);
    };
    tree.for_leaves_in(box, look, [&](std::int32_t) { all = false; });
    return all;
  }

 private:
  static bool contains(const Box<Dim>& outer, const Box<Dim>& inner) {
    for (int k = 0; k < Dim; ++k)
      if (inner.low[k] < outer.low[k] || inner.high[k] > outer.high[k]) return false;
    return true;
  }

  // For each cell of the tree, whether it contains an unknown leaf. Cells above leaves that a box
  // covers stay marked. Empty if everything is known.
  std::vector<char> unknown_in_;
  std::vector<Box<Dim>> boxes_;
};

template <int Dim>
KnownRegion<Dim>::KnownRegion(const BackgroundTree<Dim>& tree, std::vector<char> known_leaves) {
  for (char& known : known_leaves) known = !known;
  unknown_in_ = max_in_cells(tree, known_leaves);
}

}  // namespace pnpbs
