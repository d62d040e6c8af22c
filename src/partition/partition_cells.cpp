// SPDX-License-Identifier: BSD-3-Clause
#include "partition/partition_cells.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

#include "comm/records.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

namespace {

// Cells per rank. With 100, METIS balances to 3 %.
constexpr std::int64_t kCellsPerRank = 250;

// Depth of a cell and its index among the cells of that depth.
template <int Dim>
using CellKey = std::pair<std::int32_t, std::array<std::uint32_t, Dim>>;

// Work and spacing of all cells of the tree, accumulated from the leaves of this rank.
struct OwnCells {
  std::vector<std::int64_t> work, rare_work;
  std::vector<double> max_spacing;
  std::vector<char> own;  // 1 if this rank owns all leaves of the cell

  template <int Dim>
  OwnCells(const BackgroundTree<Dim>& tree, const LeafFunctions& leaves) {
    const auto cells = static_cast<std::size_t>(tree.cell_count());
    work.assign(cells, 0);
    rare_work.assign(cells, 0);
    max_spacing.assign(cells, 0);
    own.assign(cells, 1);
    for (std::int32_t c = tree.cell_count() - 1; c >= 0; --c) {
      const auto at = static_cast<std::size_t>(c);
      const typename BackgroundTree<Dim>::Cell& cell = tree.cell(c);
      if (cell.first_child < 0) {
        own[at] = leaves.owned(cell.leaf);
        if (own[at]) work[at] = leaves.work(cell.leaf);
        if (own[at] && leaves.rare_work) rare_work[at] = leaves.rare_work(cell.leaf);
        max_spacing[at] = leaves.max_spacing(cell.leaf);
        continue;
      }
      for (int k = 0; k < BackgroundTree<Dim>::kChildren; ++k) {
        const auto child = static_cast<std::size_t>(cell.first_child + k);
        work[at] += work[child];
        rare_work[at] += rare_work[child];
        max_spacing[at] = std::max(max_spacing[at], max_spacing[child]);
        own[at] = own[at] && own[child];
      }
    }
  }
};

// Appends to `found` the largest cells of this rank with at most `share` of work, below cell c.
template <int Dim>
void put_together(const BackgroundTree<Dim>& tree, const OwnCells& known, std::int64_t share,
                  std::int32_t c, Bytes& found) {
  const auto at = static_cast<std::size_t>(c);
  const typename BackgroundTree<Dim>::Cell& cell = tree.cell(c);
  const bool leaf = cell.first_child < 0;
  if (known.own[at] && (leaf || known.work[at] <= share)) {
    pack(found, PartitionCell<Dim>{cell.index, cell.depth, known.work[at], known.max_spacing[at],
                                   known.rare_work[at]});
  } else if (!leaf) {
    for (int k = 0; k < BackgroundTree<Dim>::kChildren; ++k)
      put_together<Dim>(tree, known, share, cell.first_child + k, found);
  }
}

}  // namespace

// Adds the images of the cells of a periodic domain as far as the tree extends.
template <int Dim>
std::vector<PartitionCell<Dim>> PartitionCells<Dim>::with_images(
    const TreeBounds<Dim>& bounds, std::vector<PartitionCell<Dim>> cells) {
  if (!bounds.cell.any()) return cells;
  BackgroundTree<Dim> root;
  root.build(bounds, [](const auto&, std::int32_t, std::int32_t, const auto&) {});
  const std::size_t own = cells.size();
  root.for_images([&](const Image<Dim>& image) {
    if (image == Image<Dim>{}) return;
    for (std::size_t c = 0; c < own; ++c) {
      PartitionCell<Dim> copy = cells[c];
      const auto index = root.moved_index({copy.index, copy.depth, -1, -1}, image);
      if (!index) continue;
      copy.index = *index;
      copy.work = copy.rare_work = 0;
      if (boxes_meet(root.box_of(copy.index, copy.depth), bounds.box)) cells.push_back(copy);
    }
  });
  return cells;
}

template <int Dim>
Image<Dim> PartitionCells<Dim>::image_of(std::int32_t c) const {
  const typename BackgroundTree<Dim>::Cell& cell = tree_.cell(tree_.leaf_cell(c));
  Image<Dim> image;
  image.fill(PeriodicCell<Dim>::kFarthest);
  return cell.depth < tree_.depth_of_periods() ? image : tree_.image_of(cell);
}

template <int Dim>
PartitionCells<Dim>::PartitionCells(const TreeBounds<Dim>& bounds,
                                    const std::vector<PartitionCell<Dim>>& given) {
  const std::vector<PartitionCell<Dim>> cells = with_images(bounds, given);
  std::set<CellKey<Dim>> above;  // all ancestors of the given cells
  for (const PartitionCell<Dim>& cell : cells) {
    CellKey<Dim> key{cell.depth, cell.index};
    while (key.first > 0) {
      --key.first;
      for (std::uint32_t& index : key.second) index /= 2;
      if (!above.insert(key).second) break;
    }
  }
  tree_.build(bounds, [&](const BackgroundTree<Dim>& tree, std::int32_t first, std::int32_t last,
                          std::vector<char>& split) {
    for (std::int32_t c = first; c < last; ++c)
      split[static_cast<std::size_t>(c - first)] =
          above.count({tree.cell(c).depth, tree.cell(c).index}) > 0;
  });
  work_.assign(static_cast<std::size_t>(count()), 0);
  rare_work_.assign(static_cast<std::size_t>(count()), 0);
  max_spacing_.assign(static_cast<std::size_t>(count()), 0);
  for (const PartitionCell<Dim>& cell : cells) {
    const Box<Dim> box = tree_.box_of(cell.index, cell.depth);
    const auto leaf = static_cast<std::size_t>(at(middle_of<Dim>(box.low, box.high)));
    work_[leaf] = cell.work;
    rare_work_[leaf] = cell.rare_work;
    max_spacing_[leaf] = cell.max_spacing;
  }
}

template <int Dim>
std::vector<PartitionCell<Dim>> cells_of_equal_work(const Communicator& comm,
                                                    const BackgroundTree<Dim>& tree,
                                                    const LeafFunctions& leaves) {
  const OwnCells known(tree, leaves);
  const auto mine = static_cast<std::uint64_t>(known.work[0]);  // work of the root
  const auto total = static_cast<std::int64_t>(comm.allreduce_sum(mine));
  Bytes found;
  put_together<Dim>(tree, known, total / (kCellsPerRank * comm.size()), 0, found);
  std::vector<PartitionCell<Dim>> cells;
  for_records<PartitionCell<Dim>>(comm.allgather(found),
                                  [&](const PartitionCell<Dim>& cell) { cells.push_back(cell); });
  return cells;
}

template class PartitionCells<2>;
template class PartitionCells<3>;
template std::vector<PartitionCell<2>> cells_of_equal_work(const Communicator&,
                                                           const BackgroundTree<2>&,
                                                           const LeafFunctions&);
template std::vector<PartitionCell<3>> cells_of_equal_work(const Communicator&,
                                                           const BackgroundTree<3>&,
                                                           const LeafFunctions&);

}  // namespace pnpbs
