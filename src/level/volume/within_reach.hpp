// SPDX-License-Identifier: BSD-3-Clause
// Which ghosts are near to owned nodes, whatever lies between them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/execution.hpp"
#include "level/level.hpp"
#include "partition/known_region.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

// Ghosts and owned nodes that are nearer to each other than the sum of their reaches, in units of
// d.
class WithinReach {
 public:
  WithinReach(const Nodes<3>& nodes, double reach) : nodes_(nodes), reach_(reach) {
    std::vector<Box<3>> boxes;
    for (std::int64_t i = 0; i < nodes.count; ++i)
      if (nodes.owned(i)) {
        owned_.push_back(i);
        boxes.push_back(box_around<3>(nodes.position(i), reach_ * nodes.d(i)));
      }
    tree_ = BoxTree<3>(std::move(boxes));
  }

  // Those not reached yet, which are from now on.
  std::vector<std::int64_t> ghosts(std::vector<char>& reached) const {
    std::vector<char> near(reached.size(), 0);
    for_each("pnpbs::WithinReach::ghosts", nodes_.count, [&](std::int64_t i) {
      if (!reached[static_cast<std::size_t>(i)]) near[static_cast<std::size_t>(i)] = is_near(i);
    });
    std::vector<std::int64_t> found;
    for (std::size_t i = 0; i < near.size(); ++i)
      if (near[i]) {
        found.push_back(static_cast<std::int64_t>(i));
        reached[i] = 1;
      }
    return found;
  }

  // Calls visit(owned node, distance) for how far the others must be known: by the largest d of
  // those that are.
  template <class Visit>
  void for_reaches(const KnownRegion<3>& known, const Level<3>& level, const Visit& visit) const {
    for (const std::int64_t i : owned_) {
      const double own = reach_ * nodes_.d(i);
      double reach = 2 * own;
      level.tree->tree().for_leaves_in(box_around<3>(nodes_.position(i), reach),
                                       [&](std::int32_t leaf) {
                                         const double there = level.map().leaf_max_spacing(leaf);
                                         reach = std::max(reach, own + reach_ * there);
                                       });
      if (!known.covers(level.tree->tree(), box_around<3>(nodes_.position(i), reach)))
        visit(i, reach);
    }
  }

 private:
  bool is_near(std::int64_t ghost) const {
    const Point<3> x = nodes_.position(ghost);
    const double reach = reach_ * nodes_.d(ghost);
    double square = reach * reach;
    bool near = false;
    tree_.for_near(
        x, [&] { return square; },
        [&](std::int32_t b) {
          const std::int64_t i = owned_[static_cast<std::size_t>(b)];
          if (distance<3>(nodes_.position(i), x) > reach + reach_ * nodes_.d(i)) return;
          near = true;
          square = -1;  // that is enough
        });
    return near;
  }

  const Nodes<3>& nodes_;
  double reach_;
  std::vector<std::int64_t> owned_;
  BoxTree<3> tree_;
};

}  // namespace pnpbs
