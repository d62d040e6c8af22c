// SPDX-License-Identifier: BSD-3-Clause
// Finds nodes that are near each other by their positions alone. Elements and walls between nodes
// do not matter.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/chunked_rows.hpp"
#include "base/types.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

// A search structure for some of the nodes of a rank, owned ones first, then ghosts.
template <int Dim>
class NearNodes {
 public:
  // Nodes i and j are near if their distance is less than radius * (d_i + d_j) / 2. `x` and `d`
  // must outlive this object. Nodes with kept[i] == 0 are excluded.
  NearNodes(std::span<const Point<Dim>> x, std::span<const double> d, std::span<const char> kept,
            double radius);

  // Calls visit(j) for the nodes near node i in any order. Node i itself may be excluded from the
  // set.
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
  // Returns a box around node i. The boxes of two near nodes intersect.
  Box<Dim> ball_box(std::size_t i) const;

  std::span<const Point<Dim>> x_;
  std::span<const double> d_;
  double half_radius_;
  std::vector<std::int32_t> nodes_;  // Node of each box of the tree.
  BoxTree<Dim> tree_;
};

// Returns for each of the first `owned` nodes the nodes near it, in the order of their ids.
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
