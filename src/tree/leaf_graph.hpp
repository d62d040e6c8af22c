// SPDX-License-Identifier: BSD-3-Clause
// Graph of the interacting leaves of the background tree: two leaves are neighbours if one of them
// reaches the other. Each leaf is its own neighbour.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <utility>
#include <vector>

#include "tree/background_tree.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

// Factor by which d may grow in a leaf above its known maximum before links could be missing.
inline constexpr double kRoomForGrowth = 1.25;

// The neighbours of each leaf. A row is stored when it is first read, because a rank of many reads
// only the rows near its nodes. Several threads may read at the same time.
template <int Dim>
class LeafGraph {
 public:
  // reach[leaf] is the length up to which a leaf interacts, or 0 if it does not interact. On a
  // sphere, stretch[leaf] is the maximum stretch of the chart in the leaf. Bubbles near the
  // projection point are so large in the chart that they reach all others, so pairs must also be
  // within reach along the sphere. `tree` must outlive the graph.
  LeafGraph(const BackgroundTree<Dim>& tree, std::vector<double> reach,
            std::vector<double> stretch = {});
  LeafGraph(const LeafGraph&) = delete;
  LeafGraph& operator=(const LeafGraph&) = delete;
  ~LeafGraph() {
    for (const std::atomic<std::int32_t*>& row : rows_) delete[] row.load();
  }

  const BackgroundTree<Dim>& tree() const { return tree_; }
  double reach(std::int32_t leaf) const { return reach_[index(leaf)]; }
  const std::vector<double>& reaches() const { return reach_; }
  const std::vector<double>& stretches() const { return stretch_; }

  // Calls visit(neighbour) in Morton order.
  template <class Visit>
  void for_neighbours(std::int32_t leaf, const Visit& visit) const {
    const std::int32_t* row = rows_[index(leaf)].load(std::memory_order_acquire);
    if (!row) row = store_row(leaf);
    for (std::int32_t k = 1; k <= row[0]; ++k) visit(row[k]);
  }
  // The same without storing the row, if it has not been stored. Skips each cell of the tree for
  // which enter(cell) is false and all leaves in it.
  template <class Enter, class Visit>
  void search_neighbours(std::int32_t leaf, const Enter& enter, const Visit& visit) const;

  // Returns the number of links in the rows that have been read.
  std::int64_t stored_links() const {
    std::int64_t links = 0;
    for (const std::atomic<std::int32_t*>& row : rows_)
      if (row.load()) links += row.load()[0];
    return links;
  }

 private:
  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }
  template <class Enter, class Visit>
  void search_cell(std::int32_t c, std::int32_t leaf, const Box<Dim>& own, const Enter& enter,
                   const Visit& visit) const;
  bool linked(std::int32_t a, std::int32_t b, double squared_gap) const;
  const std::int32_t* store_row(std::int32_t leaf) const;

  const BackgroundTree<Dim>& tree_;
  std::vector<double> reach_, stretch_;
  std::vector<double> max_reach_;  // of the leaves in each cell of the tree
  // The rows, null where not stored. The first entry is the number of the following ones.
  mutable std::vector<std::atomic<std::int32_t*>> rows_;
};

template <int Dim>
LeafGraph<Dim>::LeafGraph(const BackgroundTree<Dim>& tree, std::vector<double> reach,
                          std::vector<double> stretch)
    : tree_(tree),
      reach_(std::move(reach)),
      stretch_(std::move(stretch)),
      max_reach_(max_in_cells(tree, reach_)),
      rows_(index(tree.leaf_count())) {}

// Returns whether one of two leaves with this squared gap between them reaches the other. Lists
// contain only pairs within the mean of both reaches, but stars require all nodes within the larger
// one.
template <int Dim>
bool LeafGraph<Dim>::linked(std::int32_t a, std::int32_t b, double squared_gap) const {
  if (a == b) return true;
  if (reach(b) > reach(a) || (reach(b) == reach(a) && b < a)) std::swap(a, b);
  if (reach(a) == 0) return false;
  double most = reach(a) * reach(a);
  if (!stretch_.empty()) {
    const double along = std::max(reach(a) / stretch_[index(a)], reach(b) / stretch_[index(b)]);
    most = std::min(most, along * along * stretch_[index(a)] * stretch_[index(b)]);
  }
  return squared_gap <= most;
}

template <int Dim>
template <class Enter, class Visit>
void LeafGraph<Dim>::search_neighbours(std::int32_t leaf, const Enter& enter,
                                       const Visit& visit) const {
  if (const std::int32_t* row = rows_[index(leaf)].load(std::memory_order_acquire)) {
    for (std::int32_t k = 1; k <= row[0]; ++k)
      if (enter(tree_.leaf_cell(row[k]))) visit(row[k]);
    return;
  }
  const Box<Dim> own = tree_.cell_box(tree_.leaf_cell(leaf));
  search_cell(tree_.cell_around(widened(own, max_reach_[0])), leaf, own, enter, visit);
}

template <int Dim>
template <class Enter, class Visit>
void LeafGraph<Dim>::search_cell(std::int32_t c, std::int32_t leaf, const Box<Dim>& own,
                                 const Enter& enter, const Visit& visit) const {
  if (!enter(c)) return;
  const double max = std::max(reach(leaf), max_reach_[index(c)]);
  const double gap = squared_gap<Dim>(own, tree_.cell_box(c));
  if (gap > max * max) return;
  const typename BackgroundTree<Dim>::Cell& cell = tree_.cell(c);
  if (cell.first_child < 0) {
    if (linked(leaf, cell.leaf, gap)) visit(cell.leaf);
    return;
  }
  for (int k = 0; k < BackgroundTree<Dim>::kChildren; ++k)
    search_cell(cell.first_child + k, leaf, own, enter, visit);
}

// If several threads need the same row, they compute the same entries, and the first row is kept.
template <int Dim>
const std::int32_t* LeafGraph<Dim>::store_row(std::int32_t leaf) const {
  std::vector<std::int32_t> found{0};
  search_neighbours(
      leaf, [](std::int32_t) { return true; }, [&](std::int32_t other) { found.push_back(other); });
  found[0] = static_cast<std::int32_t>(found.size()) - 1;
  auto* const row = new std::int32_t[found.size()];
  std::copy(found.begin(), found.end(), row);
  std::int32_t* there = nullptr;
  if (rows_[index(leaf)].compare_exchange_strong(there, row, std::memory_order_acq_rel)) return row;
  delete[] row;
  return there;
}

}  // namespace pnpbs
