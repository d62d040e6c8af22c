// SPDX-License-Identifier: BSD-3-Clause
// Breadth-first search in the leaf graph. It skips the cells of the tree in which every leaf has
// been found, so it needs few tests for each leaf, and it stores no rows of the graph.
#pragma once

#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "tree/background_tree.hpp"
#include "tree/leaf_graph.hpp"

namespace pnpbs {

// Leaves of a tree that a search has not found yet, counted for each cell that contains them.
template <int Dim>
class UnfoundLeaves {
 public:
  // Starts with the leaves that are to be found, those with wanted(leaf).
  template <class Wanted>
  UnfoundLeaves(const BackgroundTree<Dim>& tree, const Wanted& wanted)
      : tree_(tree),
        parent_(static_cast<std::size_t>(tree.cell_count()), -1),
        left_(static_cast<std::size_t>(tree.cell_count()), 0) {
    for (std::int32_t c = 0; c < tree.cell_count(); ++c)
      for (int k = 0; tree.cell(c).first_child >= 0 && k < BackgroundTree<Dim>::kChildren; ++k)
        parent_[static_cast<std::size_t>(tree.cell(c).first_child + k)] = c;
    for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf)
      if (wanted(leaf)) add(leaf);
  }
  explicit UnfoundLeaves(const BackgroundTree<Dim>& tree)
      : UnfoundLeaves(tree, [](std::int32_t) { return true; }) {}

  bool any_in(std::int32_t cell) const { return left_[static_cast<std::size_t>(cell)] > 0; }
  bool found(std::int32_t leaf) const { return !any_in(tree_.leaf_cell(leaf)); }
  // Marks the leaf as found. Returns false if it was marked before.
  bool find(std::int32_t leaf) {
    if (found(leaf)) return false;
    change(leaf, -1);
    return true;
  }
  void add(std::int32_t leaf) { change(leaf, 1); }

 private:
  void change(std::int32_t leaf, std::int32_t by) {
    for (std::int32_t c = tree_.leaf_cell(leaf); c >= 0; c = parent_[static_cast<std::size_t>(c)])
      left_[static_cast<std::size_t>(c)] += by;
  }

  const BackgroundTree<Dim>& tree_;
  std::vector<std::int32_t> parent_, left_;
};

// A search that may be repeated from other leaves.
template <int Dim>
class HopSearch {
 public:
  // Searches for the leaves with wanted(leaf) only. `graph` must outlive the search.
  template <class Wanted>
  HopSearch(const LeafGraph<Dim>& graph, const Wanted& wanted)
      : graph_(graph), unfound_(graph.tree(), wanted) {}
  explicit HopSearch(const LeafGraph<Dim>& graph) : graph_(graph), unfound_(graph.tree()) {}

  // Calls enter(leaf, hop) once for each wanted leaf within `hops` hops of the leaves in `front`,
  // which have 0 hops and are not visited. The search continues from the leaf if the result is
  // true.
  template <class Enter>
  void run(std::vector<std::int32_t> front, int hops, const Enter& enter) {
    std::vector<std::int32_t> found, next;
    for (const std::int32_t leaf : front)
      if (unfound_.find(leaf)) found.push_back(leaf);
    for (int hop = 1; hop <= hops; ++hop) {
      next.clear();
      for (const std::int32_t leaf : front)
        graph_.search_neighbours(
            leaf, [&](std::int32_t cell) { return unfound_.any_in(cell); },
            [&](std::int32_t other) {
              unfound_.find(other);
              found.push_back(other);
              if (enter(other, hop)) next.push_back(other);
            });
      std::swap(front, next);
    }
    for (const std::int32_t leaf : found) unfound_.add(leaf);
  }

 private:
  const LeafGraph<Dim>& graph_;
  UnfoundLeaves<Dim> unfound_;
};

inline constexpr std::int32_t kUnreached = std::numeric_limits<std::int32_t>::max();

// Returns for each leaf the number of hops to the nearest one of `leaves`, or kUnreached if it is
// larger than `hops`.
template <int Dim>
std::vector<std::int32_t> hops_from(const LeafGraph<Dim>& graph,
                                    const std::vector<std::int32_t>& leaves, int hops) {
  std::vector<std::int32_t> result(static_cast<std::size_t>(graph.tree().leaf_count()), kUnreached);
  for (const std::int32_t leaf : leaves) result[static_cast<std::size_t>(leaf)] = 0;
  HopSearch<Dim>(graph).run(leaves, hops, [&](std::int32_t leaf, int hop) {
    result[static_cast<std::size_t>(leaf)] = hop;
    return true;
  });
  return result;
}

}  // namespace pnpbs
