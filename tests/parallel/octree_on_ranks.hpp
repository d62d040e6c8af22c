// SPDX-License-Identifier: BSD-3-Clause
// An octree over the unit cube, complete on every rank, and its partition.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>
#include <vector>

#include "comm/communicator.hpp"
#include "partition/distribution.hpp"
#include "partition/partition.hpp"
#include "partition/partition_cells.hpp"
#include "tree/background_tree.hpp"

namespace octree {

using pnpbs::BackgroundTree;
using pnpbs::Point;

using Function = std::function<double(const Point<3>& x)>;

// Returns a tree in which no leaf is wider than `width` at its centre.
inline BackgroundTree<3> refined_to(const Function& width) {
  BackgroundTree<3> tree;
  tree.build(pnpbs::Box<3>{{0, 0, 0}, {1, 1, 1}}, [&](const BackgroundTree<3>& grown,
                                                      std::int32_t first, std::int32_t last,
                                                      std::vector<char>& split) {
    for (std::int32_t c = first; c < last; ++c)
      split[static_cast<std::size_t>(c - first)] = grown.cell_side(c) > width(grown.cell_centre(c));
  });
  return tree;
}

// Returns the largest d in each leaf. It is at a corner, as the spacings here are convex functions.
inline std::vector<double> max_spacings(const BackgroundTree<3>& tree, const Function& spacing) {
  std::vector<double> max(static_cast<std::size_t>(tree.leaf_count()), 0);
  for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf) {
    const pnpbs::Box<3> box = tree.cell_box(tree.leaf_cell(leaf));
    for (unsigned corner = 0; corner < 8; ++corner) {
      Point<3> x;
      for (std::size_t k = 0; k < 3; ++k) x[k] = (corner >> k & 1) ? box.high[k] : box.low[k];
      double& d = max[static_cast<std::size_t>(leaf)];
      d = std::max(d, spacing(x));
    }
  }
  return max;
}

// Returns ten units of work per expected node, and none for leaves outside the domain, which have
// no d.
inline std::vector<std::int64_t> leaf_work(const BackgroundTree<3>& tree,
                                           const std::vector<double>& d) {
  std::vector<std::int64_t> work;
  for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf) {
    const double side = tree.cell_side(tree.leaf_cell(leaf));
    const double leaf_d = d[static_cast<std::size_t>(leaf)];
    work.push_back(leaf_d > 0 ? 1 + std::llround(10 * std::pow(side / leaf_d, 3)) : 0);
  }
  return work;
}

// Returns cells of equal work. Each rank knows only the leaves that a first partition has assigned
// to it.
inline std::vector<pnpbs::PartitionCell<3>> equal_cells(const pnpbs::Communicator& comm,
                                                        const BackgroundTree<3>& tree,
                                                        const std::vector<double>& d) {
  const std::vector<std::int64_t> work = leaf_work(tree, d);
  const std::vector<std::int32_t> owner = pnpbs::cut_morton_order(work, comm.size());
  const auto at = [](std::int32_t leaf) { return static_cast<std::size_t>(leaf); };
  return pnpbs::cells_of_equal_work<3>(
      comm, tree,
      {[&](std::int32_t leaf) { return owner[at(leaf)] == comm.rank(); },
       [&](std::int32_t leaf) { return work[at(leaf)]; },
       [&](std::int32_t leaf) { return d[at(leaf)]; }, nullptr});
}

// Returns a distribution of the tree by METIS. The distribution points to the tree, which must not
// move.
inline pnpbs::Distribution<3> distributed(const pnpbs::Communicator& comm,
                                          const BackgroundTree<3>& tree,
                                          const std::vector<double>& d, double radius) {
  pnpbs::PartitionCells<3> cells(pnpbs::Box<3>{{0, 0, 0}, {1, 1, 1}}, equal_cells(comm, tree, d));
  std::vector<std::int32_t> owner = pnpbs::cut_by_metis(cells, comm.size(), 1);
  const std::vector<char> all(static_cast<std::size_t>(cells.count()), 1);
  pnpbs::Distribution<3> distribution(std::move(cells), std::move(owner), comm.rank(), comm.size());
  distribution.take_leaves(&tree, all);
  std::vector<double> reach;
  for (const double leaf_d : d) reach.push_back(pnpbs::kRoomForGrowth * radius * leaf_d);
  distribution.link_leaves(std::make_shared<const pnpbs::LeafGraph<3>>(tree, std::move(reach)));
  return distribution;
}

}  // namespace octree
