// SPDX-License-Identifier: BSD-3-Clause
// Which leaves of the background tree interact: those of which one reaches the other. Compressed
// rows; each leaf is among its own neighbours.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "tree/background_tree.hpp"

namespace pnpbs {

template <int Dim>
class LeafGraph {
 public:
  // reach[leaf]: 0 for a leaf that interacts with nothing.
  void build(const BackgroundTree<Dim>& tree, const std::vector<double>& reach);

  std::int32_t begin(std::int32_t leaf) const { return offset_[index(leaf)]; }
  std::int32_t end(std::int32_t leaf) const { return offset_[index(leaf) + 1]; }
  std::int32_t neighbour(std::int32_t k) const { return neighbours_[index(k)]; }

  // In Morton order.
  template <class Visit>
  void for_neighbours(std::int32_t leaf, const Visit& visit) const {
    for (std::int32_t k = begin(leaf); k < end(leaf); ++k) visit(neighbour(k));
  }

 private:
  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

  std::vector<std::int32_t> offset_;
  std::vector<std::int32_t> neighbours_;
};

// d may grow in a leaf by this factor above what is known of it before a link could be missing.
inline constexpr double kRoomForGrowth = 1.25;

// The graph for bubbles that reach so far from each leaf.
template <int Dim>
struct LeafLinks {
  LeafLinks(const BackgroundTree<Dim>& tree, std::vector<double> reaches)
      : reach(std::move(reaches)) {
    graph.build(tree, reach);
  }
  std::vector<double> reach;
  LeafGraph<Dim> graph;
};

template <int Dim>
double squared_gap(const Box<Dim>& a, const Box<Dim>& b) {
  double sum = 0;
  for (int k = 0; k < Dim; ++k) {
    const double gap = std::max({0.0, a.low[k] - b.high[k], b.low[k] - a.high[k]});
    sum += gap * gap;
  }
  return sum;
}

// Every leaf looks as far as it reaches itself; a pair is linked if either sees the other. (Pairs
// of bubbles reach half as far each, but the stars must know of every bubble that near.)
template <int Dim>
void LeafGraph<Dim>::build(const BackgroundTree<Dim>& tree, const std::vector<double>& reach) {
  const std::int32_t leaves = tree.leaf_count();
  std::vector<std::pair<std::int32_t, std::int32_t>> links;
  links.reserve(10 * static_cast<std::size_t>(leaves));  // what a graded tree needs, or nearly
  for (std::int32_t a = 0; a < leaves; ++a) {
    links.emplace_back(a, a);
    const double reach_a = reach[index(a)];
    if (reach_a == 0) continue;
    const Box<Dim> own = tree.cell_box(tree.leaf_cell(a));
    Box<Dim> around = own;
    for (int k = 0; k < Dim; ++k) {
      around.low[k] -= reach_a;
      around.high[k] += reach_a;
    }
    tree.for_leaves_in(around, [&](std::int32_t b) {
      const double reach_b = reach[index(b)];
      if (a == b || reach_b > reach_a || (reach_b == reach_a && b < a)) return;
      if (squared_gap<Dim>(own, tree.cell_box(tree.leaf_cell(b))) > reach_a * reach_a) return;
      links.emplace_back(a, b);
      links.emplace_back(b, a);
    });
  }
  offset_.assign(static_cast<std::size_t>(leaves) + 1, 0);
  for (const auto& link : links) ++offset_[index(link.first) + 1];
  for (std::int32_t b = 0; b < leaves; ++b) offset_[index(b) + 1] += offset_[index(b)];
  neighbours_.resize(links.size());
  std::vector<std::int32_t> next(offset_.begin(), offset_.end() - 1);
  neighbours_.shrink_to_fit();
  for (const auto& link : links) neighbours_[index(next[index(link.first)]++)] = link.second;
  for (std::int32_t b = 0; b < leaves; ++b)
    std::sort(neighbours_.begin() + offset_[index(b)], neighbours_.begin() + offset_[index(b) + 1]);
}

}  // namespace pnpbs
