// SPDX-License-Identifier: BSD-3-Clause
// Which nodes are near each other by their places alone: elements do not matter, nor does a wall
// between them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/chunked_rows.hpp"
#include "base/types.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

// Some of the nodes that a rank knows: those it owns come first, then its ghosts.
template <int Dim>
class NearNodes {
 public:
  // Nodes i and j are near if they are less than radius * (d_i + d_j) / 2 apart. x and d must
  // outlive it; those with kept[i] == 0 do not count.
  NearNodes(std::span<const Point<Dim>> x, std::span<const double> d, std::span<const char> kept,
            double radius);

  // Calls visit(j) for those near node i, whether i itself counts or not. In any order.
  template <class Visit>
  void for_near(std::int64_t i, const Visit& visit) const {
    const std::size_t n = static_cast<std::size_t>(i);
    tree_.for_meeting(ball_box(n), [&](std::int32_t b) {
      const std::size_t j = static_cast<std::size_t>(nodes_[static_cast<std::size_t>(b)]);
      if (j == n) return;
      const double reach = half_radius_ * (d_[n] + d_[j]);
      if (squared_distance<Dim>(x_[n], x_[j]) < reach * reach) visit(static_cast<std::int32_t>(j));
    });
  }

 private:
  // Those of two nodes meet if they are near.
  Box<Dim> ball_box(std::size_t i) const;

  std::span<const Point<Dim>> x_;
  std::span<const double> d_;
  double half_radius_;
  std::vector<std::int32_t> nodes_;  // of the tree's boxes
  BoxTree<Dim> tree_;
};

// Those near each of the first `owned` nodes, in the order of their ids.
template <int Dim>
ChunkedRows<std::int32_t> near_rows(const NearNodes<Dim>& near, std::int64_t owned,
                                    std::span<const std::int64_t> ids);

extern template class NearNodes<2>;
extern template class NearNodes<3>;
extern template ChunkedRows<std::int32_t> near_rows(const NearNodes<2>&, std::int64_t,
                                                    std::span<const std::int64_t>);
extern template ChunkedRows<std::int32_t> near_rows(const NearNodes<3>&, std::int64_t,
                                                    std::span<const std::int64_t>);

}  // namespace pnpbs
