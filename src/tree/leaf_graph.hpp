// SPDX-License-Identifier: BSD-3-Clause
// Graph of the interacting leaves of the background tree: two leaves are neighbours if one of them
// reaches the other. The rows are compressed, and each leaf is its own neighbour.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/chunked_rows.hpp"
#include "tree/background_tree.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

// The neighbours of each leaf.
template <int Dim>
class LeafGraph {
 public:
  // Builds the graph. reach[leaf] is the length up to which a leaf interacts, or 0 if it does not
  // interact. On a sphere, stretch[leaf] is the maximum stretch of the chart in the leaf. Bubbles
  // near the projection point are so large in the chart that they reach all others, so pairs must
  // also be within reach along the sphere.
  void build(const BackgroundTree<Dim>& tree, const std::vector<double>& reach,
             const std::vector<double>& stretch = {});

  std::int32_t begin(std::int32_t leaf) const { return offset_[index(leaf)]; }
  std::int32_t end(std::int32_t leaf) const { return offset_[index(leaf) + 1]; }
  std::int32_t neighbour(std::int32_t k) const { return neighbours_[index(k)]; }

  // Calls visit(neighbour) in Morton order.
  template <class Visit>
  void for_neighbours(std::int32_t leaf, const Visit& visit) const {
    for (std::int32_t k = begin(leaf); k < end(leaf); ++k) visit(neighbour(k));
  }

 private:
  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

  std::vector<std::int32_t> offset_;
  std::vector<std::int32_t> neighbours_;
};

// Factor by which d may grow in a leaf above its known maximum before links could be missing.
inline constexpr double kRoomForGrowth = 1.25;

// A leaf graph together with the reaches that it was built for.
template <int Dim>
struct LeafLinks {
  LeafLinks(const BackgroundTree<Dim>& tree, std::vector<double> reaches,
            std::vector<double> stretches = {})
      : reach(std::move(reaches)), stretch(std::move(stretches)) {
    graph.build(tree, reach, stretch);
  }
  std::vector<double> reach, stretch;  // see LeafGraph
  LeafGraph<Dim> graph;
};

// Every leaf searches as far as it reaches itself, and a pair is linked if either leaf finds the
// other. Lists contain only pairs within the mean of both reaches, but stars require all nodes
// within the larger one.
template <int Dim>
void LeafGraph<Dim>::build(const BackgroundTree<Dim>& tree, const std::vector<double>& reach,
                           const std::vector<double>& stretch) {
  const std::int32_t leaves = tree.leaf_count();
  ChunkedRows<std::int32_t> seen;  // has each pair in the row of the leaf with the larger reach
  seen.build("pnpbs::LeafGraph::look", leaves, [&] {
    return [&](std::int64_t row, std::vector<std::int32_t>& out) {
      const auto a = static_cast<std::int32_t>(row);
      const double reach_a = reach[index(a)];
      if (reach_a == 0) return;
      const Box<Dim> own = tree.cell_box(tree.leaf_cell(a));
      tree.for_leaves_in(widened(own, reach_a), [&](std::int32_t b) {
        const double reach_b = reach[index(b)];
        if (a == b || reach_b > reach_a || (reach_b == reach_a && b < a)) return;
        double most = reach_a * reach_a;
        if (!stretch.empty()) {
          const double along = std::max(reach_a / stretch[index(a)], reach_b / stretch[index(b)]);
          most = std::min(most, along * along * stretch[index(a)] * stretch[index(b)]);
        }
        if (squared_gap<Dim>(own, tree.cell_box(tree.leaf_cell(b))) > most) return;
        out.push_back(b);
      });
    };
  });
  std::int64_t links = leaves;
  for (std::int32_t a = 0; a < leaves; ++a) links += 2 * std::ssize(seen.row(a));
  require_fits_rank(links, "links of leaves");
  offset_.assign(index(leaves) + 1, 0);
  for (std::int32_t a = 0; a < leaves; ++a) {
    offset_[index(a) + 1] += 1 + static_cast<std::int32_t>(seen.row(a).size());
    for (const std::int32_t b : seen.row(a)) ++offset_[index(b) + 1];
  }
  for (std::int32_t b = 0; b < leaves; ++b) offset_[index(b) + 1] += offset_[index(b)];
  neighbours_.resize(index(offset_.back()));
  neighbours_.shrink_to_fit();
  std::vector<std::int32_t> next(offset_.begin(), offset_.end() - 1);
  const auto link = [&](std::int32_t a, std::int32_t b) {
    neighbours_[index(next[index(a)]++)] = b;
  };
  for (std::int32_t a = 0; a < leaves; ++a) {
    link(a, a);
    for (const std::int32_t b : seen.row(a)) {
      link(a, b);
      link(b, a);
    }
  }
  for_each("pnpbs::LeafGraph::sort", leaves, [&](std::int64_t b) {
    const auto leaf = static_cast<std::int32_t>(b);
    std::sort(neighbours_.begin() + begin(leaf), neighbours_.begin() + end(leaf));
  });
}

}  // namespace pnpbs
